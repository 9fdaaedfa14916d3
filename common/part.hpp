// A part of a run's rays, for many processes that share a run.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace navjit::common {

/// The rays of a run are divided into `of` stretches, one behind the other and of one length but
/// for a ray; this is the stretch `number`, from 1 on.
struct Part {
  std::uint64_t number = 1, of = 1;

  /// The first ray of the stretch, and the first behind it, in a run of so many rays.
  std::uint64_t begin(std::uint64_t rays) const { return edge(rays, number - 1); }
  std::uint64_t end(std::uint64_t rays) const { return edge(rays, number); }
  bool whole() const { return of == 1; }

 private:
  std::uint64_t edge(std::uint64_t rays, std::uint64_t parts) const {
    const std::uint64_t longer = rays % of;  // so many of the first stretches have a ray more
    return rays / of * parts + (parts < longer ? parts : longer);
  }
};

/// "3/100": the third of a hundred. Throws UsageError for what is no part.
Part parse_part(std::string_view text);
std::string part_text(const Part& part);

}  // namespace navjit::common

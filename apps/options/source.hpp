// Which rays a command shoots.
#pragma once

#include <optional>
#include <string>

#include "common/numbers.hpp"
#include "common/rays.hpp"

namespace CLI {
class App;
}

namespace navjit::apps {

/// Pseudorapidities beyond it are directions along the axis to the last bit.
constexpr double largest_eta = 15;

struct RayOptions {
  std::string rays{};  ///< a CSV file, or a count
  common::RaySource source{};

  /// The CSV file; empty where `rays` is a count.
  std::string file() const { return common::looks_like_number(rays) ? std::string() : rays; }
};

/// Which rays these are, in one line: equal where all options are.
std::string text_of(const RayOptions& options);

/// --rays, and the options of add_source. Rays of a file have their own starts and directions: with
/// one of those options beside them the command line is refused.
void add_rays(CLI::App& command, RayOptions& options);

/// --part K/N: of all rays, those of one process of many; nothing where it is not given.
void add_part(CLI::App& command, std::optional<common::Part>& part);

/// Where random rays start and where they go: --seed, --origin, --eta, --aim.
void add_source(CLI::App& command, common::RaySource& source);

}  // namespace navjit::apps

// The line that shows how a run goes, on terminals only.
#pragma once

#include <cstdint>
#include <string>

namespace navjit::apps {

struct RunProgress {
  double seconds = 0;
  std::uint64_t rays = 0, of_rays = 0;
  double steps_per_second = 0;
  std::size_t hot = 0, compiling = 0, swapped = 0;  ///< scenes
};

/// The line, in fewer than `columns`: what does not fit is left out from the end.
std::string progress_line(const RunProgress& progress, std::size_t columns);

}  // namespace navjit::apps

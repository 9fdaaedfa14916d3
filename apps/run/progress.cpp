#include "apps/run/progress.hpp"

#include <cstdio>

namespace navjit::apps {

std::string progress_line(const RunProgress& p, std::size_t columns) {
  char parts[3][80];
  std::snprintf(parts[0], sizeof parts[0], "%.1f s  %llu of %llu rays", p.seconds,
                static_cast<unsigned long long>(p.rays),
                static_cast<unsigned long long>(p.of_rays));
  std::snprintf(parts[1], sizeof parts[1], "  %.3f M steps/s", p.steps_per_second / 1e6);
  std::snprintf(parts[2], sizeof parts[2], "  %zu hot, %zu compiling, %zu swapped", p.hot,
                p.compiling, p.swapped);
  std::string line;
  for (const char* part : parts) {
    if (line.size() + std::string_view(part).size() >= columns) break;
    line += part;
  }
  return line;
}

}  // namespace navjit::apps

#include "apps/run/progress.hpp"

#include <cstdio>
#include <string_view>

#include "common/progress_line.hpp"

namespace navjit::apps {

std::string progress_line(const RunProgress& p, std::size_t columns) {
  char parts[4][80];
  std::snprintf(parts[0], sizeof parts[0], "%.1f s  %llu of %llu rays", p.seconds,
                static_cast<unsigned long long>(p.rays),
                static_cast<unsigned long long>(p.of_rays));
  const std::string left = common::percent_and_left(p.rays, p.of_rays, p.seconds);
  std::snprintf(parts[1], sizeof parts[1], "%s%s", left.empty() ? "" : "  ", left.c_str());
  std::snprintf(parts[2], sizeof parts[2], "  %.3f M steps/s", p.steps_per_second / 1e6);
  std::snprintf(parts[3], sizeof parts[3], "  %zu hot, %zu compiling, %zu swapped", p.hot,
                p.compiling, p.swapped);
  std::string line;
  for (const char* part : parts) {
    if (line.size() + std::string_view(part).size() >= columns) break;
    line += part;
  }
  return line;
}

}  // namespace navjit::apps

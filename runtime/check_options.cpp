#include "runtime/check_options.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include "navjit/errors.hpp"

namespace navjit {
namespace {

std::string text_of(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

void require(bool fine, const char* option, double value, const char* what) {
  if (fine) return;
  throw UsageError(std::string("RuntimeOptions::") + option + " is " + text_of(value) + ": " +
                   what);
}

void require_structure(const bvh::Structure& boxes, const char* option) {
  require(boxes.method <= bvh::Method::wide_tree, option, static_cast<double>(boxes.method),
          "it is no bvh::Method");
  require(boxes.clustering <= bvh::Clustering::furthest, option,
          static_cast<double>(boxes.clustering), "it is no bvh::Clustering");
  require(boxes.groups_per_cluster <= 8, option, boxes.groups_per_cluster,
          "1 to 8 groups per cluster are possible, or 0");
}

}  // namespace

RuntimeOptions checked(RuntimeOptions options) {
  if (options.budget) {
    require(*options.budget > 0 && std::isfinite(*options.budget), "budget", *options.budget,
            "mm above 0 are needed");
  }
  const SpecialiserOptions& s = options.specialiser;
  for (const auto& [option, value] : {std::pair("specialiser.poll_ms", s.poll_ms),
                                      {"specialiser.recheck_ms", s.recheck_ms},
                                      {"specialiser.compile_weight", s.compile_weight},
                                      {"specialiser.module_ms", s.module_ms},
                                      {"specialiser.compile_first_ms", s.compile_first_ms},
                                      {"specialiser.compile_share", s.compile_share},
                                      {"specialiser.wait_ms", s.wait_ms},
                                      {"specialiser.half_life_s", s.half_life_s}}) {
    require(value >= 0, option, value, "a number of 0 or more is needed");
  }
  require(s.optimisation >= 0 && s.optimisation <= 3, "specialiser.optimisation", s.optimisation,
          "0 to 3 are possible");
  require(s.nice >= 0 && s.nice <= 19, "specialiser.nice", s.nice, "0 to 19 are possible");
  require(options.jit >= JitMode::off && options.jit <= JitMode::shadow, "jit",
          static_cast<double>(options.jit), "it is no JitMode");
  using Force = GeometryOptions::Force;
  require(options.geometry.force <= Force::bvh, "geometry.force",
          static_cast<double>(options.geometry.force), "it is no way to search");
  if (options.geometry.boxes) require_structure(*options.geometry.boxes, "geometry.boxes");
  for (const auto& [volume, boxes] : options.geometry.boxes_of) {
    require_structure(boxes, "geometry.boxes_of");
  }
  std::string& directory = options.cache.directory;
  if (!directory.empty()) {
    std::error_code error;
    const std::filesystem::path now = std::filesystem::absolute(directory, error);
    if (!error) directory = now.string();
  }
  return options;
}

}  // namespace navjit

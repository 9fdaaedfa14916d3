// VecGeom as an engine: the program vecgeom_trace in processes of their own, since VecGeom may
// crash or hang on what it is given.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/accuracy/made.hpp"
#include "apps/accuracy/track.hpp"

namespace navjit::accuracy {

/// Numbers as `%.17g`, directions as they are. Throws Error if it cannot be written.
void write_rays(const std::filesystem::path& path, std::span<const Ray> rays);

class VecGeom {
 public:
  struct Options {
    std::string program;                  ///< vecgeom_trace
    std::string detector;                 ///< as VecGeom is to read it
    std::string navigator = "automatic";  ///< or simple, abbox, hybrid, bvh
    double seconds = 300;                 ///< for each call; then it is taken to hang
  };
  explicit VecGeom(Options options) : options_(std::move(options)) {}

  /// The program beside the running one, if there is one.
  static std::optional<std::string> beside_this_program();

  /// Steps of all rays; a ray that starts outside has none. Directions are taken as given. Returns
  /// why it failed, or nothing.
  std::string trace(std::span<const Ray> rays, const std::function<void(MadeRay&)>& sink) const;
  /// ns for a step that gets on, median over repetitions. Returns why it failed, or nothing.
  std::string time(std::span<const Ray> rays, int repetitions, double& ns_per_step) const;
  /// ns for a ray, likewise.
  std::string time_of_rays(std::span<const Ray> rays, int repetitions, double& ns_per_ray) const;
  /// Ends of legs, as far as it came.
  std::string follow(const Track& track, std::vector<LegEnd>& ends) const;

 private:
  struct Times {
    double ns_per_step = 0;  ///< median, zero steps included
    double steps = 0, zero = 0;
  };
  std::string times(std::span<const Ray> rays, int repetitions, Times& times) const;

  Options options_;
};

}  // namespace navjit::accuracy

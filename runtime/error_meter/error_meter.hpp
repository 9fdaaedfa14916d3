// How far from a surface steps end, measured against the same detector at 113 bits. Programs for
// production do without (without_reference.cpp). Private to runtime/.
#pragma once

#include <memory>
#include <optional>

#include "geometry/navigation/geometry.hpp"
#include "navjit/detail/profile.hpp"

namespace navjit {

/// For one thread. Geometry and context have to outlive it.
class ErrorMeter {
 public:
  ErrorMeter(const Geometry& geometry, const kernels::Context& context);
  ~ErrorMeter();

  /// Whether this program can measure at all.
  static bool available();

  /// How far off a surface the scene's present navigator ends the step from this state, mm. Nothing
  /// where the step ends at its limit, or nothing can be measured.
  std::optional<double> error_at(const Sample& sample);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace navjit

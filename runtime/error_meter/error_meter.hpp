// Measures how far from a surface steps end, against the same detector at 113 bits. Programs for
// production do not have it (without_reference.cpp). Private to runtime/.
#pragma once

#include <memory>
#include <optional>

#include "geometry/navigation/geometry.hpp"
#include "navjit/detail/profile.hpp"

namespace navjit {

/// For use by one thread. Geometry and context must outlive it.
class ErrorMeter {
 public:
  ErrorMeter(const Geometry& geometry, const kernels::Context& context);
  ~ErrorMeter();

  /// Whether this program can measure at all.
  static bool available();

  /// How far off a surface the scene's present navigator ends the step from this state, mm. Nothing
  /// if the step ends at its limit, or if nothing can be measured.
  std::optional<double> error_at(const Sample& sample);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace navjit

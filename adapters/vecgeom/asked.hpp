// Asks one thread's navigator what VecGeom's interfaces ask, in VecGeom's unit.
#pragma once

#include <VecGeom/base/Vector3D.h>

#include "adapters/vecgeom/paths.hpp"
#include "adapters/vecgeom/threads.hpp"
#include "navjit/navigator.hpp"

namespace navjit::vecgeom {

using Vector = ::vecgeom::Vector3D<double>;

/// The navigator and the safety estimator of one world share it.
struct Asked {
  const Paths& paths;
  const ThreadNavigators& navigators;
  double mm;    ///< VecGeom's unit of length, mm
  double unit;  ///< 1 / mm

  Vec3 point(const Vector& p) const { return {mm * p.x(), mm * p.y(), mm * p.z()}; }
  static Vec3 direction(const Vector& d) { return {d.x(), d.y(), d.z()}; }

  double safety(Navigator& navigator, const State& state, const Vector& p) const {
    return unit * navigator.safety(state, point(p));
  }
  Step step(Navigator& navigator, const State& state, const Vector& p, const Vector& d,
            double limit) const {
    return navigator.step(state, point(p), direction(d), mm * limit);
  }
  /// The length in VecGeom's unit; where the limit was reached it is exactly that limit.
  double length(const Step& step, double limit) const {
    return step.boundary ? unit * step.length : limit;
  }
};

}  // namespace navjit::vecgeom

// What VecGeom's interfaces ask for, of one thread's navigator, in VecGeom's unit.
#pragma once

#include <VecGeom/base/Vector3D.h>

#include "adapters/vecgeom/paths.hpp"
#include "adapters/vecgeom/threads.hpp"
#include "navjit/navigator.hpp"

namespace navjit::vecgeom {

using Vector = ::vecgeom::Vector3D<double>;

/// Shared by the navigator and the safety estimator of one world.
struct Asked {
  const Paths& paths;
  const ThreadNavigators& navigators;
  double mm;    ///< of VecGeom's unit of length
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
  /// In VecGeom's unit; a limit that was reached is that limit.
  double length(const Step& step, double limit) const {
    return step.boundary ? unit * step.length : limit;
  }
};

}  // namespace navjit::vecgeom

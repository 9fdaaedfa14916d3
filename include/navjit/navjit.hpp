// All of navjit: read a detector or make one in code, navigate it.
//
//   auto detector = navjit::read_gdml("detector.gdml");
//   navjit::Runtime runtime{detector};
//   auto navigator = runtime.navigator();  // one per thread
//   for (auto state = navigator.locate(point, direction); state.inside();) {
//     const auto step = navigator.step(state, point, direction, physics_limit);
//     point += step.length * direction;
//     state = step.next;
//   }
//
// Lengths are mm, angles rad, densities g/cm3 unless said otherwise. Functions that are called
// thread-safe may be called by any number of threads at once; others by one thread at a time for
// each object. Everything that is thrown is a navjit::Error or std::bad_alloc.
#pragma once

#include "navjit/basket.hpp"
#include "navjit/builder.hpp"
#include "navjit/cache.hpp"
#include "navjit/detector.hpp"
#include "navjit/errors.hpp"
#include "navjit/foreign_solid.hpp"
#include "navjit/gdml.hpp"
#include "navjit/log.hpp"
#include "navjit/material.hpp"
#include "navjit/navigator.hpp"
#include "navjit/observation.hpp"
#include "navjit/options.hpp"
#include "navjit/report.hpp"
#include "navjit/root.hpp"
#include "navjit/runtime.hpp"
#include "navjit/solids.hpp"
#include "navjit/state.hpp"
#include "navjit/step_profile.hpp"
#include "navjit/surface.hpp"
#include "navjit/transformation.hpp"
#include "navjit/vector.hpp"
#include "navjit/version.hpp"
#include "navjit/volume.hpp"

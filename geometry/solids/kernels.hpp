// All kernels in the order they build on one another. Kernels include nothing themselves.
#pragma once

// clang-format off
#include "geometry/kernels/prelude.h"
#include "geometry/kernels/convex.h"
#include "geometry/kernels/box.h"
#include "geometry/kernels/trd.h"
#include "geometry/kernels/trap.h"
#include "geometry/kernels/hull.h"
#include "geometry/kernels/facets.h"
#include "geometry/kernels/wedge.h"
#include "geometry/kernels/tube.h"
#include "geometry/kernels/cone.h"
#include "geometry/kernels/orb.h"
#include "geometry/kernels/sphere.h"
#include "geometry/kernels/stack.h"
#include "geometry/kernels/polycone.h"
#include "geometry/kernels/polyhedra.h"
#include "geometry/kernels/pairs.h"
#include "geometry/kernels/torus.h"
#include "geometry/kernels/quadric.h"
#include "geometry/kernels/twisted_tube.h"
#include "geometry/kernels/twisted_trap.h"
#include "geometry/kernels/arb8.h"
#include "geometry/kernels/cuttube.h"
#include "geometry/kernels/scaled.h"
#include "geometry/kernels/boolean.h"
// clang-format on

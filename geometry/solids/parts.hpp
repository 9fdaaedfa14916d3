// Kernels that several solids are made of. Kernels include nothing themselves: each is included
// once, after those that it uses, by a header of this folder.
#pragma once

#include "navjit/detail/vectors.h"

#include "geometry/kernels/prelude.h"

#include "geometry/kernels/lanes.h"

#include "geometry/kernels/nearest_face.h"

#include "geometry/kernels/convex.h"

#include "geometry/kernels/faces.h"

#include "geometry/kernels/wedge.h"

#include "geometry/kernels/pairs.h"

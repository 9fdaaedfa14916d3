// Boxes, eight to a block (kernels/boxes.h), for code that is compiled with the library.
#pragma once

#include "geometry/solids/solid.hpp"

// clang-format off
#include "geometry/kernels/grid.h"
#include "geometry/kernels/boxes.h"
// clang-format on

// The scene template and its parts (kernels/scene.h), for code that is compiled with the library.
#pragma once

#include "geometry/navigation/navigation_stack.hpp"
#include "geometry/navigation/neighbours.hpp"

// clang-format off
#include "geometry/kernels/four_boxes.h"
#include "geometry/kernels/slabs.h"
#include "geometry/kernels/nest.h"
#include "geometry/kernels/rings.h"
#include "geometry/kernels/wires.h"
#include "geometry/kernels/frames.h"
#include "geometry/kernels/apart.h"
#include "geometry/kernels/bound_solids.h"
#include "geometry/kernels/constants.h"
#include "geometry/kernels/daughters.h"
#include "geometry/kernels/classes.h"
#include "geometry/kernels/search_few.h"
#include "geometry/kernels/searches.h"
#include "geometry/kernels/layers.h"
#include "geometry/kernels/scan.h"
#include "geometry/kernels/scan_groups.h"
#include "geometry/kernels/constant_searches.h"
#include "geometry/kernels/scene.h"
#include "geometry/kernels/shared_leaf.h"
// clang-format on

// Cuts a polygon in space into triangles. Private to geometry/surface.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "navjit/vector.hpp"

namespace navjit::surface {

/// Triangles, as numbers of corners, that fill a polygon of three corners or more and run around in
/// the same sense. It need be neither convex nor quite planar. Empty if there is no way to cut it,
/// for example if it crosses itself.
std::vector<std::array<std::size_t, 3>> cut(std::span<const Vec3> polygon);

}  // namespace navjit::surface

// The shells of a surface: its closed parts. Private to geometry/surface.
#pragma once

#include <cstdint>
#include <vector>

#include "navjit/surface.hpp"

namespace navjit::surface {

/// The numbers of the triangles of each shell. Bodies that share an edge or a corner, but are
/// closed without one another, are two shells; those that share whole triangles are one. The
/// triangles have to close on one another.
std::vector<std::vector<std::uint32_t>> split(const std::vector<Surface::Triangle>& triangles);

/// The numbers of the triangles that lie upon another one of the same plane, which faces as they do
/// and shares an edge with them, in order: two parts overlap there, or one is there twice, cut in
/// two ways. The volume below them counts twice.
std::vector<std::uint32_t> upon_others(const Surface& surface);

}  // namespace navjit::surface

// Makes triangles close on one another. Private to geometry/solids.
#pragma once

#include <string>
#include <vector>

#include "geometry/solids/solid.hpp"

namespace navjit::detail {

/// What was wrong with triangles that did not close, and what was done.
struct Closing {
  std::size_t open_edges = 0;  ///< see open_edges()
  std::size_t doubled = 0;     ///< facets left out, since another has the same corners
  std::size_t turned = 0;      ///< facets that faced the other way than their neighbours
  std::size_t added = 0;       ///< facets that span what was still open
};

/// How many edges do not run as often one way as the other: 0 if the facets close on one another.
std::size_t open_edges(const std::vector<kernels::Facet>& facets);

/// Triangles that close on one another stay as they are. Otherwise, those with the corners of
/// another one are left out; those that face the other way than most of the area that they are
/// connected with are turned; and each loop of edges that is still open is spanned by triangles
/// from one of its corners: along a T-junction or a crack these have hardly any area. The result is
/// closed, whatever was given.
Closing close_facets(const std::vector<Vec3>& corners, std::vector<kernels::Facet>& facets);

/// What was done, in words: "12 of its edges are open; left out 1 doubled facet, ...". Empty for
/// facets that were closed.
std::string describe(const Closing& closing);

}  // namespace navjit::detail

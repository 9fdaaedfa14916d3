// Rays of all the kinds that find faults: in the open, deep in the tree, along axes, from corners
// and from surfaces.
#pragma once

#include <cstdint>

#include "geometry/model/world.hpp"
#include "runtime/transport.hpp"

namespace navjit::campaign {

/// Ray number `index` of a seed; it depends on nothing else. Of ten rays, four start uniformly in
/// the world's box, four in the box of a random touchable, and two are awkward: from a corner, a
/// middle or the surface of a random touchable's solid, or along one of its axes.
Ray make_ray(const World& world, std::uint64_t seed, std::uint64_t index);

/// The same, but every eighth ray grazes: it passes a solid's surface from afar, as near to a
/// tangent as rounding allows, or starts within a few tolerances of the end of a solid's box and
/// runs nearly along that end. Who is right about such a ray is often arguable, and navigators
/// still have to agree on it.
Ray make_grazing_ray(const World& world, std::uint64_t seed, std::uint64_t index);

/// Only rays that start in the world's box or in that of a random touchable, half of them each.
Ray make_plain_ray(const World& world, std::uint64_t seed, std::uint64_t index);

}  // namespace navjit::campaign

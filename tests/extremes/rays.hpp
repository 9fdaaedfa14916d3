// Rays that are likely to find faults, made with 113 bits from the detector itself.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/model/world.hpp"
#include "runtime/transport.hpp"

namespace navjit::extremes {

/// Rays from anywhere to anywhere, with directions of unit length.
std::vector<Ray> plain_rays(const World& world, std::size_t count, std::uint64_t seed);

/// For random surfaces of the world's daughters: starts on and about them, within the tolerance and
/// beyond it, with directions along the surface to 1e-15, across it, and any others.
std::vector<Ray> rays_on_surfaces(const World& world, std::size_t count, std::uint64_t seed);

/// Rays near tangents of the same surfaces, from far away. They pass inside and outside by 1e-15 of
/// the world's size, by a tolerance, and by more.
std::vector<Ray> grazing_rays(const World& world, std::size_t count, std::uint64_t seed);

/// Rays from the corners and the middles of edges and faces of the boxes around daughters, and from
/// their centres, with the directions of odd_directions(). The corners of a box are also corners of
/// many solids.
std::vector<Ray> rays_from_corners(const World& world, std::size_t count, std::uint64_t seed);

/// Rays through the centres of the world's daughters, and past them by denormals and more, along
/// their axes, in their planes z = 0, and in any direction. They start near and far away.
std::vector<Ray> rays_past_centres(const World& world, std::size_t count, std::uint64_t seed);

/// Directions with zeros of both signs, denormals, along axes, planes and diagonals, and nearly so.
const std::vector<Vec3>& odd_directions();

/// The rays with directions whose length differs from 1 by up to `by`.
std::vector<Ray> not_quite_unit(std::vector<Ray> rays, double by);

}  // namespace navjit::extremes

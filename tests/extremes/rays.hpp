// Rays that ask for trouble, made at 113 bits from the detector itself.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/model/world.hpp"
#include "runtime/transport.hpp"

namespace navjit::extremes {

/// From anywhere to anywhere, directions of unit length.
std::vector<Ray> plain_rays(const World& world, std::size_t count, std::uint64_t seed);

/// For random surfaces of the world's daughters: starts at and about them, to within and beyond the
/// tolerance, heading along the surface to 1e-15, across it, and anywhere.
std::vector<Ray> rays_on_surfaces(const World& world, std::size_t count, std::uint64_t seed);

/// Tangents of the same surfaces that start far off and pass by within and without by 1e-15 of the
/// world's size, a tolerance, and more.
std::vector<Ray> grazing_rays(const World& world, std::size_t count, std::uint64_t seed);

/// Starts at the corners, edge and face middles of the boxes around daughters, and at their
/// centres, with the directions of odd_directions(). What are corners of a box are corners of many
/// solids.
std::vector<Ray> rays_from_corners(const World& world, std::size_t count, std::uint64_t seed);

/// Through the centres of the world's daughters, and past them by denormals and more, along their
/// axes, in their planes z = 0, and anywhere. Starts are far off and near.
std::vector<Ray> rays_past_centres(const World& world, std::size_t count, std::uint64_t seed);

/// Zeros of both signs, denormals, along axes, planes and diagonals, and nearly so.
const std::vector<Vec3>& odd_directions();

/// The rays with directions longer or shorter than 1 by up to `by`.
std::vector<Ray> not_quite_unit(std::vector<Ray> rays, double by);

}  // namespace navjit::extremes

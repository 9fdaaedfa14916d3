// Surfaces of triangles from files, as CAD programs write them: STL and OBJ.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/errors.hpp"
#include "navjit/solids.hpp"
#include "navjit/vector.hpp"

namespace NAVJIT_API navjit {

/// A surface (STL, OBJ) that is unreadable or encloses nothing: "FILE:LINE: problem; what to do".
struct SurfaceError : Error {
  using Error::Error;
};

/// Triangles between corners that they share.
struct Surface {
  /// Numbers of corners, anticlockwise seen from outside.
  using Triangle = std::array<std::uint32_t, 3>;
  std::vector<Vec3> corners{};  ///< mm
  std::vector<Triangle> triangles{};
  /// Of each triangle, for messages: its line in the file, or its number among a file's facets.
  /// Empty for a surface that comes from no file.
  std::vector<std::size_t> origins{};
  bool origins_are_lines = false;
};

/// How a surface file is read.
struct SurfaceOptions {
  double unit = 1;                               ///< of the file's numbers, mm
  std::size_t max_bytes = std::size_t{1} << 30;  ///< a longer file is refused
  std::size_t max_triangles = 2'000'000;         ///< a surface of more is refused
};

/// Reads binary or ASCII STL, or Wavefront OBJ (of which faces alone count; those of more than
/// three corners are cut into triangles). The name says which it is (.stl, .obj). Corners at one
/// and the same place become one; triangles that have nothing between their corners are left out.
/// The normals that a file gives are not looked at: corners run anticlockwise about the true one.
/// Throws SurfaceError, which names file and line (of binary STL the facet). Thread-safe.
Surface read_surface(const std::filesystem::path& path, const SurfaceOptions& options = {});

/// What keeps a surface from being closed and oriented: its first edge that is not run along as
/// often one way as the other, and how many such edges there are; empty if none. Thread-safe.
std::string open_at(const Surface& surface);

/// Turns what is inside out in a closed surface: shells (parts that are closed without the others)
/// that enclose less than nothing together with those whose boxes meet theirs. A shell that faces
/// inwards in one that faces outwards is a hole, and stays. Triangles that are there twice are left
/// out. Returns what was done, a sentence each, and names shells that overlap others, and triangles
/// that lie upon others of a shell: the volume is then not exact. Throws GeometryError where
/// open_at() finds something. Thread-safe for different surfaces.
std::vector<std::string> mend_shells(Surface& surface);

/// The body that a closed surface encloses. If all of the surface faces inwards it is turned.
/// Throws GeometryError where open_at() finds something. Thread-safe.
Solid make_tessellated(std::string name, const Surface& surface);

}  // namespace navjit

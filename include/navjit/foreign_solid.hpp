// Solids that the library has no mathematics for: they answer for themselves.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "navjit/solids.hpp"
#include "navjit/vector.hpp"

namespace NAVJIT_API navjit {

/// Where a point is, seen from a solid.
enum class PointSide : std::uint8_t { outside, surface, inside };

/// The mathematics of a solid, written by who uses the library: of another engine's solid, of a
/// shape that there is no maker for. All is in the solid's own frame; points and lengths are mm,
/// directions unit vectors. Any number of threads call it at once, and it throws nothing. The same
/// numbers have to give the same answer each time.
class ForeignSolid {
 public:
  virtual ~ForeignSolid() = default;

  /// Points within tolerance() of the surface are on it.
  virtual PointSide inside(const Vec3& p) const = 0;
  /// The way to the next crossing into the solid; infinity if there is none. From outside or from
  /// the surface, where a direction that heads in has 0 to go.
  virtual double distance_to_in(const Vec3& p, const Vec3& direction) const = 0;
  /// The way to the next crossing out of the solid. From inside or from the surface, where a
  /// direction that heads out has 0 to go.
  virtual double distance_to_out(const Vec3& p, const Vec3& direction) const = 0;
  /// At most the distance from a point outside to the surface.
  virtual double safety_to_in(const Vec3& p) const = 0;
  /// At most the distance from a point inside to the surface.
  virtual double safety_to_out(const Vec3& p) const = 0;
  /// The outward unit normal of the face that the point is nearest to.
  virtual Vec3 normal(const Vec3& p) const = 0;

  /// How near to the surface a point is on it, mm.
  virtual double tolerance() const { return 1e-9; }
  /// mm^3; not a number where it is not known.
  virtual double volume() const { return std::numeric_limits<double>::quiet_NaN(); }
  /// Any text, other for solids that differ: by it a profile knows the detector again.
  virtual std::string key() const { return {}; }

 protected:
  ForeignSolid() = default;
  ForeignSolid(const ForeignSolid&) = default;
  ForeignSolid& operator=(const ForeignSolid&) = default;
};

/// The solid within the box `extent`, which has to contain it. It may be an operand of booleans, be
/// placed and be scaled like any other. No code is compiled for volumes that it is the solid of, or
/// of a daughter; it has no form in 113 bits and none in GDML. Throws GeometryError if there is no
/// solid or no box.
Solid make_foreign(std::string name, std::shared_ptr<const ForeignSolid> solid,
                   const Extent& extent);

}  // namespace navjit

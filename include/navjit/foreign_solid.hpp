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

/// The mathematics of a solid, written by the user of the library: for a solid of another engine,
/// or a shape that there is no maker for. Everything is in the solid's own frame; points and
/// lengths are mm, directions unit vectors. Any number of threads call it at once, and it must
/// throw nothing. The same numbers have to give the same answer each time.
class ForeignSolid {
 public:
  virtual ~ForeignSolid() = default;

  /// Points within tolerance() of the surface are on it.
  virtual PointSide inside(const Vec3& p) const = 0;
  /// The way to the next crossing into the solid; infinity if there is none. Asked from outside or
  /// from the surface; there the way is 0 for a direction that heads in.
  virtual double distance_to_in(const Vec3& p, const Vec3& direction) const = 0;
  /// The way to the next crossing out of the solid. Asked from inside or from the surface; there
  /// the way is 0 for a direction that heads out.
  virtual double distance_to_out(const Vec3& p, const Vec3& direction) const = 0;
  /// At most the distance from a point outside to the surface.
  virtual double safety_to_in(const Vec3& p) const = 0;
  /// At most the distance from a point inside to the surface.
  virtual double safety_to_out(const Vec3& p) const = 0;
  /// The outward unit normal of the face that the point is nearest to.
  virtual Vec3 normal(const Vec3& p) const = 0;

  /// Points that are no farther than this from the surface are on it, mm.
  virtual double tolerance() const { return 1e-9; }
  /// mm^3; not a number where the volume is not known.
  virtual double volume() const { return std::numeric_limits<double>::quiet_NaN(); }
  /// Any text that differs where solids differ: by it a profile recognises the detector.
  virtual std::string key() const { return {}; }

 protected:
  ForeignSolid() = default;
  ForeignSolid(const ForeignSolid&) = default;
  ForeignSolid& operator=(const ForeignSolid&) = default;
};

/// Makes a solid of it; the box `extent` has to contain it. It may be an operand of booleans, be
/// placed and be scaled like any other. No code is compiled for volumes that have it as their own
/// solid or as that of a daughter; it cannot be computed with 113 bits, nor be written as GDML.
/// Throws GeometryError if there is no solid or no box.
Solid make_foreign(std::string name, std::shared_ptr<const ForeignSolid> solid,
                   const Extent& extent);

}  // namespace navjit

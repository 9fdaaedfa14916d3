// The generic navigator: it answers for any scene, and its answers are right by definition.
// Specialised navigators have to give the same bits.
#pragma once

#include <limits>

#include "geometry/navigation/geometry.hpp"

namespace navjit::generic {

/// Brings the stack to the deepest touchable that holds the global point; depth -1 if it is outside
/// the world. On a face the direction decides; without one (all zero) the first volume in file
/// order with that face. Where volumes overlap, the last in file order holds the point.
void locate(const Geometry&, NavigationStack&, const Vec3& point, const Vec3& direction);

/// The same, but searched for from the stack's touchable, first outwards and then inwards: where
/// several hold the point (on faces, in overlaps) it is one of those nearest to it in the tree.
void locate_from(const Geometry&, NavigationStack&, const Vec3& point, const Vec3& direction);

/// One step from a global point (mm) along a unit direction, at most `limit` mm. Returns the length
/// and leaves the stack at the next touchable; `stack.boundary` says whether a boundary ended the
/// step. The stack must not be outside the world.
double step(const Geometry&, NavigationStack&, const Vec3& point, const Vec3& direction,
            double limit);

/// The first part of locate(): into the world volume, or outside. Returns whether it is inside.
bool enter(const Geometry&, NavigationStack&, const Vec3& point, const Vec3& direction);

/// The first part of locate_from(), for a stack that is in the world: leaves all levels that do not
/// hold the point. Returns whether any level does.
bool ascend(const Geometry&, NavigationStack&, const Vec3& point, const Vec3& direction);

/// Relocation after a crossing; see kernels::RelocateFunction.
void relocate(const Geometry&, NavigationStack&, const Vec3& point, const Vec3& direction,
              int blocked);

/// The same after a step of length zero. Rounding must not lead back into what has just
/// been left at the same place: so daughters have to contain the point in their own frames,
/// too.
void relocate_in_own_frames(const Geometry&, NavigationStack&, const Vec3& point,
                            const Vec3& direction, int blocked);

/// A lower bound (mm, >= 0) of the distance from a global point to the nearest boundary of the
/// innermost volume or of its daughters; `enough` if that is less.
double safety(const Geometry&, const NavigationStack&, const Vec3& point,
              double enough = std::numeric_limits<double>::infinity());

/// Rebuilds the stack for a touchable; reuses the levels that it shares with the present one.
void restore(const Geometry&, NavigationStack&, TouchableId touchable);

/// The dispatch entry of the generic navigator, for a Context whose `geometry` is a Geometry.
extern const kernels::DispatchEntry dispatch_entry;

}  // namespace navjit::generic

// The steps of a ray held against the detector at 113 bits.
#pragma once

#include <cstdint>

#include "apps/accuracy/made.hpp"
#include "geometry/reference/wide_geometry.hpp"

namespace navjit::accuracy {

/// What was found out about one step.
struct JudgedStep {
  std::size_t step;  ///< number within the ray
  VolumeId volume;   ///< in which it was made, by the reference where the engine tells names alone
  VolumeId surface;  ///< whose surface ended it, by the reference
  bool measured;  ///< whether the errors below are known and mean something: not where the engine
                  ///< and the reference part with either right
  double error;   ///< |length - the reference's from the same point|, mm
  double ulp;     ///< last bit of the coordinates' magnitude (WideAnswer), mm
  double across;  ///< how much farther from a surface it ended than the reference's, mm. Where
                  ///< the ray grazes, this is what rounding can be blamed for, not `error`
  double reference;   ///< the reference's length, mm
  bool wrong_volume;  ///< the engine claims a volume that is not there, beyond the tolerance
  bool wrong_end;     ///< it ended where no surface is, or passed one, beyond the tolerance
};

struct JudgedRay {
  std::vector<JudgedStep> steps;
  bool stuck = false;
  bool lost = false;           ///< it did not end where the world does, nor in a volume that
                               ///< sticks out of the world there
  std::uint64_t skipped = 0;   ///< steps too short to be judged
  std::uint64_t arguable = 0;  ///< steps that differ from the reference's, with either right: along
                               ///< an edge, a tangent or a face, or where the file has overlaps;
                               ///< and last steps that end outside of the world, in a volume that
                               ///< sticks out of it
};

struct Tolerances {
  /// Nearer than this to a surface nothing is claimed, mm. Engines that push need more.
  double surface;
  /// Shorter steps are not judged, mm.
  double shortest = 0;
};
/// Of our own engines: four times the world's tolerance, for the rounding of the point, of the
/// frames, of the surface, and of the tolerance's own edge.
Tolerances own_tolerances(const World& world);
/// Of VecGeom, which moves points on by 1e-6 mm: nearer than twice that to a surface it claims
/// nothing.
Tolerances vecgeom_tolerances(const World& world);

/// Judges all steps of a ray whose engine tells touchables: each against the reference's step from
/// the very same point, direction and touchable.
JudgedRay judge_ray(const reference::WideGeometry& reference, const Ray& ray, const MadeRay& made,
                    const Tolerances& tolerances);

/// Judges a ray whose engine tells names of volumes alone, and whose starts may be off by a push:
/// the touchable is looked up in the middle of each step, and the reference goes on from there.
JudgedRay judge_named_ray(const reference::WideGeometry& reference, const Ray& ray,
                          const MadeRay& made, const Tolerances& tolerances);

}  // namespace navjit::accuracy

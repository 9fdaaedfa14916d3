// navjit inside VecGeom: VecGeom's own loop over its own volumes and states, answered by navjit.
//
//   vgdml::Frontend::Load("detector.gdml", false);       // or volumes made in code; closed
//   navjit::vecgeom::Navigation navigation;              // takes the GeoManager's world
//   navigation.attach();                                 // LogicalVolume::SetNavigator for all
//   ...
//   step = volume->GetNavigator()->ComputeStepAndPropagatedState(point, direction, limit, in, out);
//
// docs/vecgeom.md describes all of it.
#pragma once

#include <VecGeom/navigation/NavigationState.h>
#include <VecGeom/navigation/VNavigator.h>
#include <VecGeom/navigation/VSafetyEstimator.h>
#include <VecGeom/volumes/LogicalVolume.h>
#include <VecGeom/volumes/PlacedVolume.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "navjit/navjit.hpp"

#ifdef VECGEOM_USE_NAVINDEX
#error "navjit answers in VecGeom's paths: configure VecGeom without VECGEOM_USE_NAVINDEX"
#endif

namespace navjit::vecgeom {

/// Gives the material of a volume: made in the builder, or made before for another volume.
using MaterialOf =
    std::function<DetectorBuilder::MaterialId(DetectorBuilder&, const ::vecgeom::LogicalVolume&)>;

/// How VecGeom's world is converted.
struct Options {
  /// VecGeom's unit of length in mm. 0: what GeoManager::GetMillimeterUnit() gives, which the GDML
  /// reader sets (by default a unit is a cm, and this is 10). Geometry made in code has whatever
  /// unit its author had in mind. Navigation is the same with any unit, except for its tolerance,
  /// which is a length.
  double mm_per_unit = 0;
  /// Empty: one material without a name for all volumes. Navigation reads no material.
  MaterialOf material{};
  RuntimeOptions runtime{};
};

/// VecGeom's world, navigated by navjit. One object serves all threads: each thread that asks gets
/// a navjit::Navigator, which this object owns, and which another thread gets when that thread
/// ends. Functions are for one thread at a time, unless said otherwise; those of the navigator and
/// of the safety estimator may be called by any number of threads at once.
///
/// The user data of the detector's volumes and placements are the addresses of VecGeom's.
class Navigation {
 public:
  /// Converts the GeoManager's world, which has to be closed and must stay. Throws UsageError if
  /// there is none, and GeometryError, which names the volume, if a shape has no kernel or if its
  /// dimensions make no solid.
  explicit Navigation(Options options = {});
  Navigation(const Navigation&) = delete;
  Navigation& operator=(const Navigation&) = delete;
  /// Detaches. No thread may be in the navigator, nor use it from then on.
  ~Navigation();

  /// Sets navigator and safety estimator of all volumes of the world except assemblies; or of the
  /// given volumes only, such as those that are hot in the report of an earlier run. Throws
  /// UsageError if one is not in the world, or is an assembly.
  void attach();
  void attach(std::span<const ::vecgeom::LogicalVolume* const> volumes);
  /// Gives the volumes back what they had before attach(), which is never another of these objects.
  /// Volumes whose navigator was changed since then keep theirs.
  void detach();

  /// The navigator that volumes are given: it serves all volumes of the world.
  const ::vecgeom::VNavigator& navigator() const;
  const ::vecgeom::VSafetyEstimator& safety_estimator() const;

  /// The deepest volume that holds a point (VecGeom's unit), written into the state; false if the
  /// point is outside. On faces the direction decides. Thread-safe. Throws UsageError if a number
  /// is not finite, or if the state has too little room.
  bool locate(const ::vecgeom::Vector3D<double>& point,
              const ::vecgeom::Vector3D<double>& direction,
              ::vecgeom::NavigationState& state) const;

  /// Converts VecGeom's state to navjit's, and back. Thread-safe. `write` throws UsageError if the
  /// state is of another detector, or if `out` has too little room.
  State state(const ::vecgeom::NavigationState& state) const;
  void write(const State& state, ::vecgeom::NavigationState& out) const;

  /// The number of a volume in the detector; nothing if it is not in the world or is an assembly.
  std::optional<VolumeId> volume(const ::vecgeom::LogicalVolume& volume) const;

  /// Names of volumes that were left out, with everything in them, because they hold no point, such
  /// as intersections of shapes that are apart. No track is ever in one.
  const std::vector<std::string>& empty_volumes() const;

  double mm_per_unit() const;
  const Detector& detector() const;
  Runtime& runtime();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace navjit::vecgeom

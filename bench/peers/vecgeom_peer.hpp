#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "flight.hpp"
#include "navjit/detail/expected.hpp"

namespace navjit::peers {

/// How VecGeom searches the daughters of a volume. Whatever is chosen, a volume without daughters
/// gets the simple navigator.
enum class VecGeomNavigator {
  simple,
  abbox,
  hybrid,
  bvh,
  automatic,  ///< by number of daughters: simple up to 4, abbox up to 12, hybrid above
};

/// A straight ray: mm, unit direction.
struct Ray {
  double position[3];
  double direction[3];
};

/// A straight part of a track: unit direction, mm.
struct Leg {
  double direction[3];
  double length;
};

/// Where a track was after a leg.
struct LegEnd {
  double position[3];
  std::uint64_t boundaries;  ///< crossed since the start
};

/// One step of a ray.
struct Segment {
  std::uint32_t ray;     ///< index into the rays traced
  std::uint32_t volume;  ///< index into VecGeomPeer::names()
  double length;         ///< mm; negative if the ray got stuck here and was given up

  bool stuck() const { return length < 0; }
};

/// VecGeom, to be measured beside navjit.
///
/// VecGeom keeps its geometry in a singleton, so a process can load one world, once.
///
/// VecGeom trusts its input: on a file that it does not understand it may abort, crash, hang or
/// silently build another geometry than the file describes. load() refuses what can be recognised
/// beforehand; give it unknown files only in a process that may die. No call on an object may
/// overlap with use(); the other functions are const and may run in parallel.
class VecGeomPeer {
 public:
  /// Steps, their summed length in mm, rays given up.
  struct Totals {
    std::uint64_t steps = 0;
    double length = 0;
    std::uint64_t stuck = 0;
    std::uint64_t zero_steps = 0;  ///< those of `steps` that did not move the ray
  };

  /// Located starting points, for one_step() and safety().
  class States {
   public:
    States(States&&) noexcept;
    States& operator=(States&&) noexcept;
    ~States();

    std::size_t size() const;
    /// Points that lie outside the world; the measurements skip them.
    std::size_t outside() const;
    /// Index into names() of the volume in which point i lies, or -1 if it lies outside the world.
    std::int64_t volume(std::size_t i) const;

   private:
    friend class VecGeomPeer;
    struct Impl;
    explicit States(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
  };

  /// Reads a GDML file, lengths in mm, and installs the automatic navigator. Fails if
  /// VecGeom refuses the file, or if the file holds something that VecGeom silently drops.
  static Expected<std::unique_ptr<VecGeomPeer>> load(const std::string& gdml_file);

  VecGeomPeer(const VecGeomPeer&) = delete;
  VecGeomPeer& operator=(const VecGeomPeer&) = delete;
  ~VecGeomPeer();

  /// Names of the logical volumes, also of the world, as in the GDML file;
  /// mirrored copies have `_refl` appended. They are not necessarily
  /// unique.
  const std::vector<std::string>& names() const { return names_; }

  /// Installs navigators for all volumes, with the level locators and safety estimators that belong
  /// to them.
  void use(VecGeomNavigator navigator);

  /// Every step of every ray until it leaves the world. A ray that starts outside has none; one
  /// that makes 100 zero steps in a row, or `max_steps_per_ray` steps, ends with a stuck segment.
  std::vector<Segment> trace(std::span<const Ray> rays, std::uint64_t max_steps_per_ray) const;

  /// The same loop with nothing recorded, for timing. It includes locating the starts.
  Totals transport(std::span<const Ray> rays, std::uint64_t max_steps_per_ray) const;

  /// Carries one track along its legs, from a point within the world. Ends early if the track is
  /// stuck or leaves the world.
  std::vector<LegEnd> follow(const double (&start)[3], std::span<const Leg> legs) const;

  /// Makes flights. If `safety` is set it asks for the safety before each step that does not start
  /// on a boundary, and adds it to `safeties`, mm.
  Totals fly(std::span<const Flight> flights, bool safety, double& safeties) const;

  /// Locates the rays' starting points.
  States prepare_states(std::span<const Ray> rays) const;

  /// One step and the relocation after it for every ray, from states prepared for the same rays. If
  /// all states are in one volume, its navigator is looked up only once.
  Totals one_step(const States& states, std::span<const Ray> rays) const;

  /// Sum in mm of the isotropic safeties at the starting points of the rays.
  double safety(const States& states, std::span<const Ray> rays) const;

 private:
  VecGeomPeer() = default;

  std::vector<std::string> names_;
  std::vector<std::uint32_t> index_of_id_;  // by VecGeom's number of a volume: index into names_
  int state_depth_ = 0;
  bool has_hybrid_ = false;
  bool has_bvh_ = false;
};

}  // namespace navjit::peers

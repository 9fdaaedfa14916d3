// What a run observes of a detector, and the detector without what it does not.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "navjit/detail/api.hpp"
#include "navjit/detector.hpp"
#include "navjit/navigator.hpp"
#include "navjit/vector.hpp"

namespace NAVJIT_API navjit {

/// Which boundaries a run wants to see. Fewer boundaries are fewer steps (docs/observation.md).
struct Observation {
  /// What makes a boundary count.
  enum class Kind : std::uint8_t {
    all,        ///< every boundary
    materials,  ///< where the material or the region changes, and those of volumes that count
    budget,     ///< those that change what rays go through by more than `budget`, and as above
    mixtures,   ///< as materials, where volumes are homogenised as long as a mean ray changes by
                ///< no more than `budget`
  };
  /// What a budget is counted in.
  enum class Unit : std::uint8_t {
    radiation_lengths,
    grams_per_cm2,
    relative,  ///< to what a ray goes through, in radiation lengths; for mixtures: a mean ray
  };
  Kind kind = Kind::all;
  /// Logical volumes that count by name, beside those that GDML marks (SensDet). All that have the
  /// name do.
  std::vector<std::string> volumes{};
  /// For Kind::budget: no ray through the world may change by more than this. For Kind::mixtures:
  /// the mean over rays of how much each changes, measured, is no more than this.
  double budget = 0;
  Unit unit = Unit::radiation_lengths;
  /// For Kind::mixtures: the rays that the mean is over.
  struct Rays {
    /// Where all start, mm; nothing: isotropic ones through points of the box in the world that
    /// holds most touchables.
    std::optional<Vec3> origin{};
    /// Pseudorapidity about +z of those from an origin, evenly; nothing: isotropic.
    std::optional<std::pair<double, double>> eta{};

    friend bool operator==(const Rays&, const Rays&) = default;
  };
  Rays rays{};

  friend bool operator==(const Observation&, const Observation&) = default;
};

/// "all", or "materials" or "budget:E" (radiation lengths), then volumes after commas. Throws
/// UsageError for what is neither.
Observation parse_observation(std::string_view text);
/// The inverse.
std::string observation_text(const Observation& observation);

/// What became of the placements that nothing observes.
struct ObservationReport {
  /// What was done to placements of one volume in one mother.
  struct Entry {
    std::string volume, mother;
    std::uint64_t placements = 0;
    double bound = 0;  ///< radiation lengths: how much all of these change any ray at the most
    std::string why;   ///< of what was left: why. Empty for what was dissolved
  };
  std::uint64_t invisible = 0;  ///< placements that nothing observes, in volumes of their own
                                ///< material or, with a budget, of one that may stand for it
  std::uint64_t dissolved = 0;  ///< those of them that are no more
  std::uint64_t sampled = 0;    ///< those of them whose surroundings were sampled, and not proved
  std::uint64_t placements_before = 0, placements_after = 0;  ///< of all volumes
  TouchableId touchables_before = 0, touchables_after = 0;
  /// In the unit of the budget (radiation lengths, where it is relative): how much what is left may
  /// differ from the original along any ray. Proved.
  double bound = 0;
  /// A volume that is homogenised, with what it is made of now.
  struct Mixture {
    std::string volume, material;
    std::uint32_t number = 0;       ///< of the material, in ObservedDetector::detector()
    double density = 0;             ///< g/cm3
    double radiation_length = 0;    ///< mm
    std::vector<std::string> of{};  ///< the daughters' volumes that are part of it with all in them
    std::uint64_t placements = 0;   ///< of these daughters
    /// So much of it was one of the original's materials.
    struct Part {
      std::uint32_t material;  ///< its number in the original
      double share;            ///< of the volume
    };
    std::vector<Part> parts{};  ///< what it was
    double bound = 0;           ///< how much all touchables of it may change any ray
  };
  std::vector<Mixture> mixtures{};
  /// By how much rays change that had no say in what is mixed: measured, in the same unit.
  struct Measured {
    std::uint64_t rays = 0;
    double whole = 0;       ///< mean of what a ray goes through in the original
    double mean = 0;        ///< mean over rays of the absolute value of the change
    double mean_error = 0;  ///< one standard deviation of it
    double signed_mean = 0, signed_error = 0;  ///< mean of the change itself
    /// 99%, 99.9% and all of the rays change by no more.
    double of_99_percent = 0, of_999_permille = 0, largest = 0;
  };
  Measured measured{};
  std::vector<Entry> gone{};  ///< in file order of the mothers
  std::vector<Entry> left{};  ///< likewise; steps do not end on them, but cost as they did
};

/// A detector and what is left of it for a run that does not look at everything. Volumes,
/// materials, their numbers and names are those of the original; what nothing observes is not in
/// the tree any more, where that changes no material along any ray (or no more than the budget).
/// Copies share all. All functions may be called by any number of threads.
///
///   navjit::ObservedDetector seen{world, {.kind = navjit::Observation::Kind::materials}};
///   navjit::Runtime runtime{seen.detector()};
///   auto navigator = runtime.navigator();
///   ... auto step = seen.step(navigator, state, point, direction, limit); ...
class ObservedDetector {
 public:
  /// Looks at every volume once, and asks where volumes might overlap. Throws GeometryError if a
  /// name is that of no volume, or a budget is not positive.
  explicit ObservedDetector(const Detector& original, const Observation& observation = {});

  /// To be navigated. Where all is observed it is the original.
  const Detector& detector() const;
  const Detector& original() const;
  const Observation& observation() const;
  const ObservationReport& report() const;

  /// Whether a step from one volume into another ends: their material, region or tags differ, or
  /// one of them is observed itself.
  bool counts(VolumeId from, VolumeId to) const {
    return from >= classes_size_ || to >= classes_size_ || classes_[from] != classes_[to] ||
           (classes_[from] & always) != 0;
  }
  /// Whether all boundaries of the volume count: it is observed itself, or in several regions.
  bool observed(VolumeId volume) const {
    return volume < classes_size_ && (classes_[volume] & always) != 0;
  }
  /// A step of a navigator of detector() that ends on boundaries that count only: as
  /// Navigator::step() as often as it takes. Throws as that.
  Step step(Navigator& navigator, const State& state, const Vec3& point, const Vec3& direction,
            double limit = std::numeric_limits<double>::infinity()) const {
    // One place to return from, so that the step is made where it is returned.
    Step made = navigator.step(state, point, direction, limit);
    if (made.boundary && made.next.inside() && !counts(state.volume(), made.next.volume())) {
      made = walk_on(navigator, made, point, direction, limit);
    }
    return made;
  }

  /// The touchable of the original that a state of detector() is: its path, its copy numbers. A
  /// track may be deeper in it, in a daughter that nothing observes. Outside for outside. Throws
  /// UsageError if the state is of another detector.
  State original(const State& state) const;
  /// The deepest touchable of the original at a point in the state, daughters that nothing observes
  /// included; on a face the direction decides. Throws likewise, and if a number is not finite.
  State original(const State& state, const Vec3& point, const Vec3& direction) const;

  /// Zero steps in a row after which walking on would not come to an end: where volumes overlap.
  static constexpr int most_standing = 100;

  struct Data;  ///< the library's own

 private:
  static constexpr std::uint32_t always = std::uint32_t{1} << 31;

  Step walk_on(Navigator& navigator, Step made, const Vec3& point, const Vec3& direction,
               double limit) const;

  std::shared_ptr<const Data> data_;
  const std::uint32_t* classes_ = nullptr;  ///< of each volume; in the data
  std::size_t classes_size_ = 0;
};

/// A navigator that sees what is observed and no more.
class ObservedNavigator {
 public:
  /// Refers to both; the navigator is one of a Runtime of seen.detector().
  ObservedNavigator(const ObservedDetector& seen, Navigator& navigator)
      : seen_(seen), navigator_(navigator) {}
  /// As Navigator::locate(), in ObservedDetector::detector().
  State locate(const Vec3& point, const Vec3& direction) {
    return navigator_.locate(point, direction);
  }
  /// As ObservedDetector::step().
  Step step(const State& state, const Vec3& point, const Vec3& direction,
            double limit = std::numeric_limits<double>::infinity()) {
    return seen_.step(navigator_, state, point, direction, limit);
  }

 private:
  const ObservedDetector& seen_;
  Navigator& navigator_;
};

inline Step ObservedDetector::walk_on(Navigator& navigator, Step made, const Vec3& point,
                                      const Vec3& direction, double limit) const {
  int standing = 0;
  for (State at = made.next;;) {
    const double left = limit - made.length;
    const Step more =
        navigator.step(at, point + made.length * direction, direction, left > 0 ? left : 0);
    standing = more.length > 0 ? 0 : standing + 1;
    made = {made.length + more.length, more.boundary, more.next};
    if (!more.boundary || !more.next.inside() || standing == most_standing ||
        counts(at.volume(), more.next.volume())) {
      return made;
    }
    at = more.next;
  }
}

}  // namespace navjit

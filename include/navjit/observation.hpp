// What a run observes of a detector, and the detector without what the run does not observe.
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
#include "navjit/detail/standing.hpp"
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
  /// Logical volumes that count by name, in addition to those that GDML marks (SensDet). A name
  /// stands for all volumes that have it.
  std::vector<std::string> volumes{};
  /// For Kind::budget: no ray through the world may change by more than this. For Kind::mixtures:
  /// the change of a ray, measured, is no more than this in the mean over rays.
  double budget = 0;
  Unit unit = Unit::radiation_lengths;
  /// For Kind::mixtures: the rays over which the mean is taken.
  struct Rays {
    /// Where all rays start, mm. If there is nothing, they are isotropic, and go through points of
    /// the box in the world that holds most touchables.
    std::optional<Vec3> origin{};
    /// Range of pseudorapidity about +z, evenly filled from `origin`; nothing: isotropic.
    std::optional<std::pair<double, double>> eta{};

    friend bool operator==(const Rays&, const Rays&) = default;
  };
  Rays rays{};

  friend bool operator==(const Observation&, const Observation&) = default;
};

/// "all", "materials", "budget:E" or "mixtures:E" (docs/observation.md says which E and which
/// rays), then volumes after commas. Throws UsageError for any other text.
Observation parse_observation(std::string_view text);
/// The inverse of parse_observation().
std::string observation_text(const Observation& observation);

/// What became of the placements that nothing observes.
struct ObservationReport {
  /// What was done to placements of one volume in one mother.
  struct Entry {
    std::string volume, mother;
    std::uint64_t placements = 0;
    double bound = 0;  ///< the most that all of these together change any ray, radiation lengths
    std::string why;   ///< the reason for what was left; empty for what was dissolved
  };
  std::uint64_t invisible = 0;  ///< placements that nothing observes, in volumes of their own
                                ///< material or, with a budget, of one that may stand for it
  std::uint64_t dissolved = 0;  ///< those of them that were taken out of the tree
  std::uint64_t sampled = 0;    ///< those of them whose surroundings were sampled, and not proved
  std::uint64_t placements_before = 0, placements_after = 0;  ///< of all volumes
  TouchableId touchables_before = 0, touchables_after = 0;
  /// A proved bound, in the unit of the budget (radiation lengths, where that is relative): how
  /// much what is left may differ from the original along any ray.
  double bound = 0;
  /// A volume that is homogenised, with what it is made of now.
  struct Mixture {
    std::string volume, material;
    std::uint32_t number = 0;       ///< of the material, in ObservedDetector::detector()
    double density = 0;             ///< g/cm3
    double radiation_length = 0;    ///< mm
    std::vector<std::string> of{};  ///< daughters that are part of it, by volume, with all in them
    std::uint64_t placements = 0;   ///< of these daughters
    /// How much of the mixture was one of the original's materials.
    struct Part {
      std::uint32_t material;  ///< its number in the original
      double share;            ///< its share of the volume
    };
    std::vector<Part> parts{};  ///< the materials that it was
    double bound = 0;           ///< how much all its touchables together may change any ray
  };
  std::vector<Mixture> mixtures{};
  /// How much those rays change that had no say in what is mixed: measured, in the same unit.
  struct Measured {
    std::uint64_t rays = 0;
    double whole = 0;       ///< mean of what a ray goes through in the original
    double mean = 0;        ///< mean over rays of the absolute value of the change
    double mean_error = 0;  ///< one standard deviation of it
    double signed_mean = 0, signed_error = 0;  ///< mean of the change itself
    /// 99%, 99.9% and all of the rays change by no more than these.
    double of_99_percent = 0, of_999_permille = 0, largest = 0;
  };
  Measured measured{};
  std::vector<Entry> gone{};  ///< in file order of the mothers
  std::vector<Entry> left{};  ///< likewise; steps do not end on them, but they cost as before
};

/// A detector and what is left of it for a run that does not look at everything. Volumes,
/// materials, their numbers and names are those of the original. What nothing observes is no longer
/// in the tree, if that changes no material along any ray (or no more than the budget). Copies
/// share everything. All functions may be called by any number of threads.
///
///   navjit::ObservedDetector seen{world, {.kind = navjit::Observation::Kind::materials}};
///   navjit::Runtime runtime{seen.detector()};
///   auto navigator = runtime.navigator();
///   ... auto step = seen.step(navigator, state, point, direction, limit); ...
class ObservedDetector {
 public:
  /// Looks at every volume once, and checks where volumes might overlap. Throws GeometryError if a
  /// name is that of no volume, or if a budget is not positive.
  explicit ObservedDetector(const Detector& original, const Observation& observation = {});

  /// The detector to navigate. Where everything is observed it is the original.
  const Detector& detector() const;
  const Detector& original() const;
  const Observation& observation() const;
  const ObservationReport& report() const;

  /// Whether a step from one volume into another ends between them: their material, region or tags
  /// differ, or one of them is observed itself.
  bool counts(VolumeId from, VolumeId to) const {
    return from >= classes_size_ || to >= classes_size_ || classes_[from] != classes_[to] ||
           (classes_[from] & always) != 0;
  }
  /// Whether all boundaries of the volume count: it is observed itself, or is in several regions.
  bool observed(VolumeId volume) const {
    return volume < classes_size_ && (classes_[volume] & always) != 0;
  }
  /// A step of a navigator of detector() that ends only on boundaries that count: it repeats
  /// Navigator::step() as often as it takes. Where a ray is stuck (docs/tolerance.md) it ends
  /// where the ray last got ahead, whether that boundary counts or not. Throws as that does.
  Step step(Navigator& navigator, const State& state, const Vec3& point, const Vec3& direction,
            double limit = std::numeric_limits<double>::infinity()) const {
    // One place to return from, so that the step is built where it is returned.
    Step made = navigator.step(state, point, direction, limit);
    if (made.boundary && made.next.inside() && !counts(state.volume(), made.next.volume())) {
      made = walk_on(navigator, made, point, direction, limit);
    }
    return made;
  }

  /// The touchable of the original that a state of detector() stands for: it has the path and the
  /// copy numbers. A track may be deeper in it, in a daughter that nothing observes. Outside for a
  /// state outside. Throws UsageError if the state is of another detector.
  State original(const State& state) const;
  /// The deepest touchable of the original at a point in the state, daughters that nothing observes
  /// included; on a face the direction decides. Throws likewise, and if a number is not finite.
  State original(const State& state, const Vec3& point, const Vec3& direction) const;

  struct Data;  ///< of the library's own

 private:
  static constexpr std::uint32_t always = std::uint32_t{1} << 31;

  Step walk_on(Navigator& navigator, Step made, const Vec3& point, const Vec3& direction,
               double limit) const;

  std::shared_ptr<const Data> data_;
  const std::uint32_t* classes_ = nullptr;  ///< of each volume; in `data_`
  std::size_t classes_size_ = 0;
  double tolerance_ = 0;  ///< of detector(), mm
};

/// A navigator that sees what is observed and no more.
class ObservedNavigator {
 public:
  /// Refers to both arguments; the navigator has to be one of a Runtime of seen.detector().
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
  detail::Standing standing;
  Step ahead = made;  // up to where the ray last got ahead
  for (State at = made.next;;) {
    const double left = limit - made.length;
    const Step more =
        navigator.step(at, point + made.length * direction, direction, left > 0 ? left : 0);
    made = {made.length + more.length, more.boundary, more.next};
    if (!more.boundary || !more.next.inside() || counts(at.volume(), more.next.volume())) {
      return made;
    }
    standing.count(more.length, tolerance_);
    // Without the steps that went nowhere: a hundred of them together may be long enough to hide
    // from the caller that the ray is stuck.
    if (standing.stuck()) return ahead;
    if (standing.steps == 0) ahead = made;
    at = more.next;
  }
}

}  // namespace navjit

// Random states of every volume: VecGeom's interface over navjit answers with navjit's own bits in
// VecGeom's own paths, and nearly as VecGeom's own navigators do.
//
// NAVJIT_VECGEOM_STATES: how many states for each volume, by default 300 (docs/vecgeom.md has a
// million). NAVJIT_VECGEOM_REPORT: prints a line for each difference from VecGeom.
#include <VecGeom/navigation/GlobalLocator.h>
#include <VecGeom/volumes/UnplacedTorus2.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/adapters/vecgeom/states.hpp"
#include "tests/adapters/vecgeom/worlds.hpp"

namespace navjit {
namespace {

using tests::OwnedState;
using tests::StateMaker;
using ::vecgeom::NavigationState;
using Vector = ::vecgeom::Vector3D<double>;

struct Case {
  const char* name;
  const char* file;
  double unit;         ///< VecGeom's length of a mm
  double unexplained;  ///< the most of steps that may differ from VecGeom's without a known reason
  int share = 1;       ///< of the states: one in so many
};

void PrintTo(const Case& of, std::ostream* out) { *out << of.name; }

bool same(double a, double b) { return kernels::same_bits(a, b); }

/// VecGeom's booleans push points by 1e-6 of its unit (tests/reference/vecgeom_test.cpp); booleans
/// within others do so several times.
constexpr double most_difference = 3.1e-6;
/// After a boundary VecGeom looks for a point that is this much further on, in its unit.
constexpr double vecgeom_push = 1e-6;

/// The reason why VecGeom's step is another one, so far as it is known.
enum Why { copy, overlap, missed, edge, torus, own_look_up, unknown, reasons };
constexpr const char* names[reasons] = {
    "a copy of the placement that was left",
    "volumes overlap there",
    "VecGeom misses a volume that holds the point",
    "an edge that VecGeom's push passes",
    "a torus segment, beyond whose ends VecGeom takes points for inside",
    "another length, and VecGeom's own look-up of a point between is for navjit's",
    "not known"};

struct Counts {
  std::uint64_t states = 0, steps = 0, volumes = 0, without = 0;
  std::uint64_t others[reasons] = {};
  double worst = 0;  ///< mm, of the lengths that count as equal
};

bool holds(const NavigationState& path, const Vector& point) {
  return !path.IsOutside() && path.Top()->UnplacedContains(path.GlobalToLocal(point));
}

bool begins(const NavigationState& path, const NavigationState& with) {
  bool same = path.GetCurrentLevel() >= with.GetCurrentLevel();
  for (int l = 0; same && l < with.GetCurrentLevel(); ++l) same = path.At(l) == with.At(l);
  return same;
}

/// Whether the track is still in the same place at a point between the two ends: this is so if and
/// only if navjit's step is the longer one.
Why why_length(const NavigationState& in, NavigationState& found, const Vector& point,
               const Vector& direction, double ours, double its) {
  found.Clear();
  ::vecgeom::GlobalLocator::LocateGlobalPoint(::vecgeom::GeoManager::Instance().GetWorld(),
                                              point + 0.5 * (ours + its) * direction, found, true);
  return found.HasSamePathAsOther(in) == (ours > its) ? own_look_up : unknown;
}

Why why_elsewhere(const NavigationState& in, const NavigationState& ours,
                  const NavigationState& its, const Vector& end, const Vector& direction,
                  double push) {
  const Vector beyond = end + push * direction;
  // VecGeom enters no placement of which the track has left a touchable, in another one neither.
  if (ours.GetCurrentLevel() > its.GetCurrentLevel() && begins(ours, its) &&
      ours.At(its.GetCurrentLevel()) == in.Top())
    return copy;
  const auto* segment =
      its.IsOutside()
          ? nullptr
          : dynamic_cast<const ::vecgeom::UnplacedTorus2*>(its.Top()->GetUnplacedVolume());
  if (segment && segment->dphi() < ::vecgeom::kTwoPi) return torus;
  if (!holds(ours, beyond)) {
    const bool nearer = holds(ours, end + 0.1 * push * direction) ||
                        holds(ours, end + 0.01 * push * direction) ||
                        holds(ours, end + 0.001 * push * direction);
    return nearer && holds(its, beyond) ? edge : unknown;
  }
  if (begins(ours, its)) return missed;
  if (!begins(its, ours) && holds(its, beyond)) return overlap;
  return unknown;
}

class VecGeomAnswers : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const std::string file = tests::detector_file(GetParam().file);
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
    tests::load_world(file, GetParam().unit);
    if (HasFatalFailure()) return;
    navigation_ =
        std::make_unique<vecgeom::Navigation>(vecgeom::Options{.runtime = {.jit = JitMode::wait}});
    mm_ = navigation_->mm_per_unit();
  }

  Vector vector(const Vec3& v) const { return {v.x, v.y, v.z}; }
  std::string name_of(const State& state) const {
    return state.inside() ? navigation_->detector().path_of(state) : "outside";
  }

  std::unique_ptr<vecgeom::Navigation> navigation_;
  double mm_ = 0;
};

TEST_P(VecGeomAnswers, AreNavjitsOwn) {
  if (IsSkipped() || HasFatalFailure()) return;
  const char* wanted = std::getenv("NAVJIT_VECGEOM_STATES");
  const bool report = std::getenv("NAVJIT_VECGEOM_REPORT") != nullptr;
  const int states = (wanted ? std::atoi(wanted) : 300) / GetParam().share;
  const Detector& detector = navigation_->detector();
  EXPECT_DOUBLE_EQ(mm_ * GetParam().unit, 1);

  Runtime generic{detector, {.jit = JitMode::off}};
  Navigator direct = generic.navigator();
  Navigator makes = generic.navigator();
  StateMaker maker{detector, makes, 17};
  const ::vecgeom::VNavigator& adapter = navigation_->navigator();
  const ::vecgeom::VSafetyEstimator& safeties = navigation_->safety_estimator();
  OwnedState in, out, right, other;
  Counts counts;

  for (VolumeId volume = 0; volume < detector.volumes(); ++volume) {
    if (detector.volume(volume).touchables == 0) continue;
    std::uint64_t made = 0;
    for (int i = 0; i < states; ++i) {
      const auto start = maker.make(volume);
      if (!start) {
        if (made == 0 && i > 20) break;  // a volume that its daughters fill
        continue;
      }
      ++made;
      State state = start->state;
      // In VecGeom's unit, so that both are asked for the same point: as the adapter multiplies.
      Vector point = vector(start->point) / mm_;
      const Vector direction = vector(start->direction);
      navigation_->write(state, *in);
      ASSERT_EQ(navigation_->state(*in), state);
      // From within, and then from the boundary that was met.
      for (int steps = 0; steps < 2 && state.inside(); ++steps) {
        const Vec3 p{mm_ * point.x(), mm_ * point.y(), mm_ * point.z()};
        ++counts.states;
        const double safe = direct.safety(state, p);
        ASSERT_TRUE(same(safeties.ComputeSafety(point, *in), 1 / mm_ * safe));
        const bool limited = i % 3 == 0;
        const double limit = limited ? maker.between(0, 50) / mm_ : ::vecgeom::kInfLength;
        const Step step = direct.step(state, p, start->direction, mm_ * limit);
        const double length =
            adapter.ComputeStepAndPropagatedState(point, direction, limit, *in, *out);
        ASSERT_TRUE(same(length, step.boundary ? 1 / mm_ * step.length : limit));
        ASSERT_EQ(out->IsOnBoundary(), step.boundary);
        ASSERT_EQ(navigation_->state(*out), step.next);
        navigation_->write(step.next, *right);
        ASSERT_TRUE(out->HasSamePathAsOther(*right));
        // A lower bound, in this direction at least.
        if (step.boundary) {
          ASSERT_LE(safe, step.length + detector.tolerance());
        }

        // The variants answer alike.
        double its_safety = -1;
        ASSERT_TRUE(same(adapter.ComputeStepAndSafetyAndPropagatedState(
                             point, direction, limit, *in, *other, true, its_safety),
                         length));
        ASSERT_TRUE(same(its_safety, 1 / mm_ * safe));
        ASSERT_TRUE(other->HasSamePathAsOther(*out));
        ASSERT_TRUE(same(adapter.ComputeStep(point, direction, limit, *in, *other), length));
        ASSERT_EQ(other->IsOnBoundary(), step.boundary);
        // VecGeom's meaning: the daughter that was hit, or where the track was.
        const int depth = in->GetCurrentLevel();
        ASSERT_GE(other->GetCurrentLevel(), depth);
        if (out->GetCurrentLevel() >= other->GetCurrentLevel()) {
          bool below = true;
          for (int l = 0; l < depth; ++l) below = below && out->At(l) == in->At(l);
          for (int l = depth; below && l < other->GetCurrentLevel(); ++l)
            ASSERT_EQ(other->At(l), out->At(l));
          if (below && out->GetCurrentLevel() > depth) {
            ASSERT_GT(other->GetCurrentLevel(), depth);
          }
        }
        in->CopyTo(&*other);
        its_safety = -1;
        ASSERT_TRUE(same(
            adapter.ComputeStepAndSafety(point, direction, limit, *other, true, its_safety, false),
            length));
        ASSERT_TRUE(same(its_safety, 1 / mm_ * safe));
        ASSERT_TRUE(other->HasSamePathAsOther(*in));

        // VecGeom's own, from within: on boundaries it pushes and remembers.
        if (steps == 0) {
          ++counts.steps;
          const ::vecgeom::VNavigator* own = in->Top()->GetLogicalVolume()->GetNavigator();
          const double its =
              own->ComputeStepAndPropagatedState(point, direction, limit, *in, *other);
          const double difference = std::abs(its - length);
          std::optional<Why> why;
          if (!(difference <= most_difference)) {
            why = why_length(*in, *right, point, direction, length, its);
          } else {
            counts.worst = std::max(counts.worst, mm_ * difference);
            if (!other->HasSamePathAsOther(*out)) {
              why = why_elsewhere(*in, *out, *other, point + length * direction, direction,
                                  vecgeom_push);
            }
          }
          if (why) ++counts.others[*why];
          if (report && why) {
            std::printf("%s: %s to %s, %.12g; VecGeom: to %s, %.12g\n", names[*why],
                        detector.path_of(state).c_str(), name_of(step.next).c_str(), length,
                        name_of(navigation_->state(*other)).c_str(), its);
          }
        }
        point += length * direction;
        state = step.next;
        out->CopyTo(&*in);
      }
    }
    ++(made > 0 ? counts.volumes : counts.without);
  }
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "%s: %llu volumes (%llu more filled by their daughters), %llu states. %llu steps from within "
      "beside VecGeom's; lengths differ by at most %.2g mm, but for:\n",
      GetParam().name, number(counts.volumes), number(counts.without), number(counts.states),
      number(counts.steps), counts.worst);
  for (int why = 0; why < reasons; ++why) {
    if (counts.others[why] > 0) std::printf("  %llu: %s\n", number(counts.others[why]), names[why]);
  }
  EXPECT_GT(counts.volumes, 0U);
  EXPECT_LE(static_cast<double>(counts.others[unknown]),
            GetParam().unexplained * static_cast<double>(counts.steps));
}

INSTANTIATE_TEST_SUITE_P(Detectors, VecGeomAnswers,
                         ::testing::Values(Case{"shashlik", "shashlik.gdml", 1, 1e-6},
                                           Case{"shashlik_cm", "shashlik.gdml", 0.1, 1e-6},
                                           Case{"absorber", "absorber.gdml", 1, 1e-6},
                                           Case{"scenes", "scenes.gdml", 1, 1e-6},
                                           Case{"LHCb", "lhcb/LHCb_Upgrade_onlyECALandHCAL.gdml", 1,
                                                1e-3},
                                           Case{"testEm3", "testem3/testEm3.gdml", 1, 1e-6},
                                           Case{"TileCal", "atlas/TileTB_2B1EB.gdml", 1, 1e-6},
                                           Case{"Mu2e", "mu2e/mu2e.gdml", 1, 5e-5, 30},
                                           Case{"preshower", "cms/preshower_sf.gdml", 1, 1e-6},
                                           Case{"SimpleCMS", "celeritas/simple-cms.gdml", 1, 1e-6}),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace navjit

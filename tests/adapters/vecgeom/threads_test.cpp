// Many threads are in VecGeom's loop over one navigator while the code behind it is replaced.
#include <VecGeom/navigation/GlobalLocator.h>

#include <atomic>
#include <random>
#include <thread>

#include "tests/adapters/vecgeom/worlds.hpp"

namespace navjit {
namespace {

using tests::OwnedState;
using ::vecgeom::NavigationState;
using Vector = ::vecgeom::Vector3D<double>;

struct Sums {
  std::uint64_t steps = 0;
  double length = 0, safeties = 0;
  friend bool operator==(const Sums&, const Sums&) = default;
};

/// VecGeom's own loop, by the navigator of the volume that a ray is in.
Sums fly(const vecgeom::Navigation& navigation, std::uint64_t seed, int rays) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  OwnedState first, second;
  NavigationState *in = &*first, *out = &*second;
  Sums sums;
  for (int i = 0; i < rays; ++i) {
    Vector point(0, 0, 0);
    const Vector direction = Vector(0.05 * normal(random), 0.05 * normal(random), 1).Normalized();
    navigation.locate(point, direction, *in);
    for (int n = 0; n < 10000 && !in->IsOutside(); ++n) {
      const auto* volume = in->Top()->GetLogicalVolume();
      const double length = volume->GetNavigator()->ComputeStepAndPropagatedState(
          point, direction, ::vecgeom::kInfLength, *in, *out);
      sums.safeties +=
          volume->GetSafetyEstimator()->ComputeSafety(point + 0.5 * length * direction, *in);
      point += length * direction;
      sums.length += length;
      ++sums.steps;
      std::swap(in, out);
    }
  }
  return sums;
}

class VecGeomThreads : public ::testing::Test {
 protected:
  void SetUp() override { tests::load_world(tests::detector_file("shashlik.gdml")); }
};

TEST_F(VecGeomThreads, AnswerAlikeWhileCodeIsSwapped) {
  constexpr int threads = 4, rays = 400;
  Sums right[threads];
  {
    vecgeom::Navigation generic{{.runtime = {.jit = JitMode::off}}};
    generic.attach();
    for (int t = 0; t < threads; ++t) right[t] = fly(generic, t, rays);
  }
  EXPECT_GT(right[0].steps, 10000U);

  // Polled often, so that scenes are swapped while they are in use.
  vecgeom::Options options;
  options.runtime.specialiser.poll_ms = 1;
  options.runtime.specialiser.min_steps = 200;
  vecgeom::Navigation navigation{options};
  navigation.attach();
  std::atomic<int> different = 0;
  const auto round = [&] {
    std::vector<std::thread> running;
    for (int t = 0; t < threads; ++t) {
      running.emplace_back([&, t] { different += fly(navigation, t, rays) == right[t] ? 0 : 1; });
    }
    for (std::thread& thread : running) thread.join();
  };
  for (int i = 0; i < 40; ++i) {  // threads come and go; their navigators stay
    round();
    if (i > 4 && navigation.runtime().specialised() > 5) break;
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(navigation.runtime().specialised(), 0U);
  navigation.runtime().wait_until_idle();
  round();
  EXPECT_EQ(different, 0);
}

TEST_F(VecGeomThreads, ANavigationMayGoAndAnotherComeBesideThreadsThatStay) {
  // The thread keeps an address of a navigator that is gone; it must not be used.
  std::vector<Sums> sums;
  for (int i = 0; i < 3; ++i) {
    vecgeom::Navigation one{{.runtime = {.jit = JitMode::off}}};
    vecgeom::Navigation two{{.runtime = {.jit = JitMode::off}}};
    one.attach();
    sums.push_back(fly(one, 1, 20));
    two.attach();
    sums.push_back(fly(two, 1, 20));
    one.attach();
    sums.push_back(fly(one, 1, 20));
  }
  for (const Sums& each : sums) EXPECT_EQ(each, sums[0]);
}

}  // namespace
}  // namespace navjit

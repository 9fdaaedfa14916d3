// VecGeom's own loop, first with its own navigators, then over navjit: the loop is the same.
//
//   vecgeom_loop DETECTOR.gdml [RAYS]
#include <VecGeom/gdml/Frontend.h>
#include <VecGeom/management/GeoManager.h>
#include <VecGeom/navigation/NavigationState.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <navjit/vecgeom.hpp>
#include <random>
#include <utility>

namespace {

using Vector = vecgeom::Vector3D<double>;

struct Totals {
  long steps = 0;
  double length = 0;
};

/// Rays from the origin, forward: what a program that is built on VecGeom does.
Totals fly(const navjit::vecgeom::Navigation& start, int rays) {
  auto* in = vecgeom::NavigationState::MakeInstance(vecgeom::GeoManager::Instance().getMaxDepth());
  auto* out = vecgeom::NavigationState::MakeInstance(vecgeom::GeoManager::Instance().getMaxDepth());
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Totals totals;
  for (int i = 0; i < rays; ++i) {
    Vector point(0, 0, 0);
    const Vector direction = Vector(0.1 * normal(random), 0.1 * normal(random), 1).Normalized();
    start.locate(point, direction, *in);
    for (int n = 0; n < 100000 && !in->IsOutside(); ++n) {
      const auto* navigator = in->Top()->GetLogicalVolume()->GetNavigator();
      const double step = navigator->ComputeStepAndPropagatedState(point, direction,
                                                                   vecgeom::kInfLength, *in, *out);
      point += step * direction;
      totals.length += step;
      ++totals.steps;
      std::swap(in, out);
    }
  }
  vecgeom::NavigationState::ReleaseInstance(in);
  vecgeom::NavigationState::ReleaseInstance(out);
  return totals;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Totals print(const char* what, const navjit::vecgeom::Navigation& start, int rays) {
  const double before = thread_seconds();  // the compiler has a thread of its own
  const Totals totals = fly(start, rays);
  const double seconds = thread_seconds() - before;
  std::printf("%-22s %10ld steps, %.9g mm, %.1f ns a step\n", what, totals.steps,
              start.mm_per_unit() * totals.length,
              1e9 * seconds / static_cast<double>(totals.steps));
  return totals;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: vecgeom_loop DETECTOR.gdml [RAYS]\n");
    return 2;
  }
  const int rays = argc > 2 ? std::atoi(argv[2]) : 1000;
  if (rays < 1) {
    std::fprintf(stderr, "vecgeom_loop: RAYS is a number above 0\n");
    return 2;
  }
  if (!vgdml::Frontend::Load(argv[1], false)) return 1;  // in cm, as VecGeom does by default

  navjit::vecgeom::Navigation navigation;
  const Totals own = print("VecGeom's navigators:", navigation, rays);
  navigation.attach();
  const Totals ours = print("navjit:", navigation, rays);
  navigation.runtime().wait_until_idle();  // a simulation would not wait
  print("navjit, specialised:", navigation, rays);

  // VecGeom leaves out what it enters from a copy of the same placement; otherwise they agree.
  if (std::abs(own.length - ours.length) < 1e-3 * own.length) return 0;
  std::fprintf(stderr, "vecgeom_loop: the lengths differ: VecGeom is stuck or wrong somewhere\n");
  return 1;
} catch (const navjit::Error& error) {
  std::fprintf(stderr, "vecgeom_loop: %s\n", error.what());
  return 1;
}

// The least that a simulation needs: read a detector, shoot rays through it, print where the time
// went. Usage: minimal DETECTOR.gdml [RAYS]
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>

#include <navjit/navjit.hpp>

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: minimal DETECTOR.gdml [RAYS]\n");
    return 2;
  }
  const int rays = argc > 2 ? std::atoi(argv[2]) : 100000;
  navjit::Runtime runtime{navjit::read_gdml(argv[1])};
  navjit::Navigator navigator = runtime.navigator();  // one per thread

  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss;
  double total = 0;
  for (int ray = 0; ray < rays; ++ray) {
    navjit::Vec3 direction{gauss(random), gauss(random), gauss(random)};
    direction = (1 / norm(direction)) * direction;
    navjit::Vec3 point{0, 0, 0};
    // A simulation's physics would set the limit of each step; here tracks go straight out.
    for (navjit::State state = navigator.locate(point, direction); state.inside();) {
      const double physics_limit = 1000;  // mm
      const navjit::Step step = navigator.step(state, point, direction, physics_limit);
      point += step.length * direction;
      total += step.length;
      state = step.next;
    }
  }

  const navjit::RuntimeReport report = runtime.final_report();
  std::printf("%d rays, %llu steps, %.6g mm\n", rays, static_cast<unsigned long long>(report.steps),
              total);
  for (const navjit::SceneReport& scene : report.scenes) {
    if (scene.share < 0.01) break;
    std::printf("%5.1f %%  %-12s %6.1f -> %6.1f ns/step  %s\n", 100 * scene.share,
                binding_name(scene.binding), scene.generic_ns_per_step,
                scene.specialised_ns_per_step, scene.volume.c_str());
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "minimal: %s\n", error.what());
  return 1;
}

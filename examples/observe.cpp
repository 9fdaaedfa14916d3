// A simulation that looks at its calorimeter cells and at materials, and at no other boundary.
// Usage: observe DETECTOR.gdml VOLUME [RAYS]
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>

#include <navjit/navjit.hpp>

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fprintf(stderr, "usage: observe DETECTOR.gdml VOLUME [RAYS]\n");
    return 2;
  }
  const navjit::Detector detector = navjit::read_gdml(argv[1]);

  // What is sensitive, beside what the file marks, in three lines.
  navjit::Observation observation{.kind = navjit::Observation::Kind::materials};
  observation.volumes = {argv[2]};
  const navjit::ObservedDetector seen{detector, observation};

  const navjit::VolumeId cell = *detector.find_volume(argv[2]);
  navjit::Runtime runtime{seen.detector()};
  navjit::Navigator navigator = runtime.navigator();
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss;
  double in_cells = 0;
  std::size_t steps = 0;
  std::string last = "none";
  for (int ray = argc > 3 ? std::atoi(argv[3]) : 10000; ray > 0; --ray) {
    navjit::Vec3 direction{gauss(random), gauss(random), gauss(random)};
    direction = (1 / norm(direction)) * direction;
    navjit::Vec3 point{0, 0, 0};
    for (navjit::State state = navigator.locate(point, direction); state.inside(); ++steps) {
      const navjit::Step step = seen.step(navigator, state, point, direction);
      if (state.volume() == cell) {
        in_cells += step.length;
        last = detector.path_of(seen.original(state));  // with the copies of all levels
      }
      point += step.length * direction;
      state = step.next;
    }
  }
  std::printf("%llu of %llu placements that nobody sees are dissolved\n",
              static_cast<unsigned long long>(seen.report().dissolved),
              static_cast<unsigned long long>(seen.report().invisible));
  std::printf("%zu steps, %.6g mm in %s, the last in %s\n", steps, in_cells, argv[2], last.c_str());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "observe: %s\n", error.what());
  return 1;
}

// The part of arrays.py that is in C++: arrays of points are located, stepped and asked for their
// safety, and rays are followed to their end. Usage: arrays DETECTOR.gdml RAYS.bin (N times x, y,
// z, u, v, w). Prints the processor time of each part, s.
#include <cstdio>
#include <exception>
#include <fstream>
#include <vector>

#include <navjit/navjit.hpp>

#include "runtime/processor_time.hpp"

namespace {

using namespace navjit;

struct Rays {
  std::vector<Vec3> points, directions;
};

Rays read_rays(const char* path) {
  Rays rays;
  std::ifstream in(path, std::ios::binary);
  for (double ray[6]; in.read(reinterpret_cast<char*>(ray), sizeof ray);) {
    rays.points.push_back({ray[0], ray[1], ray[2]});
    rays.directions.push_back({ray[3], ray[4], ray[5]});
  }
  return rays;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: arrays DETECTOR.gdml RAYS.bin\n");
    return 2;
  }
  const Detector detector = read_gdml(argv[1]);
  Runtime runtime{detector, {.jit = JitMode::wait}};
  Navigator navigator = runtime.navigator();
  const auto [points, directions] = read_rays(argv[2]);
  const std::size_t count = points.size();
  std::vector<double> radiation(detector.volumes());
  for (VolumeId v = 0; v < detector.volumes(); ++v) {
    const double length = detector.material(detector.volume(v)).radiation_length;
    radiation[v] = length > 0 ? 1 / length : 0;
  }
  // Twice, since the first time the memory is new, and so is the profile.
  for (int turn = 0; turn < 2; ++turn) {
    double begun = thread_seconds();
    std::vector<State> states(count);
    for (std::size_t i = 0; i < count; ++i) states[i] = navigator.locate(points[i], directions[i]);
    const double locate = thread_seconds() - begun;

    begun = thread_seconds();
    std::vector<double> lengths(count);
    std::vector<char> boundaries(count);
    std::vector<State> next(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!states[i].inside()) continue;
      const Step step = navigator.step(states[i], points[i], directions[i]);
      lengths[i] = step.length;
      boundaries[i] = step.boundary;
      next[i] = step.next;
    }
    const double step = thread_seconds() - begun;

    begun = thread_seconds();
    std::vector<double> safeties(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (states[i].inside()) safeties[i] = navigator.safety(states[i], points[i]);
    }
    const double safety = thread_seconds() - begun;

    begun = thread_seconds();
    std::vector<double> budgets(count);
    const std::size_t rays = count / 10;
    for (std::size_t i = 0; i < rays; ++i) {
      Vec3 point = points[i];
      int left = 100000;
      for (State state = navigator.locate(point, directions[i]); state.inside() && --left > 0;) {
        const Step made = navigator.step(state, point, directions[i]);
        budgets[i] += made.length * radiation[state.volume()];
        point += made.length * directions[i];
        state = made.next;
      }
    }
    const double scan = thread_seconds() - begun;
    if (turn > 0) std::printf("%.6f %.6f %.6f %.6f\n", locate, step, safety, scan);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "arrays: %s\n", error.what());
  return 1;
}

// A toy simulation outside navjit: scattering, step limits, safety, surface normals and local
// coordinates, on two threads. Without and with the JIT the results have the same bits.
#include <navjit/navjit.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <random>
#include <thread>

namespace {

navjit::Detector detector() {
  navjit::DetectorBuilder builder;
  const auto air = builder.material({.name = "Air", .density = 0.0012});
  const auto hall = builder.volume("hall", navjit::make_box("hall", 500, 500, 500), air);
  const auto plate = builder.volume("plate", navjit::make_box("plate", 200, 200, 4), air);
  const auto pipe = builder.volume("pipe", navjit::make_tube("pipe", 0, 30, 4, 0, 7), air);
  builder.place(pipe, plate, navjit::placed_at({20, -10, 0}), 0);
  for (int i = 0; i < 40; ++i) {
    builder.place(plate, hall, navjit::placed_at({0, 0, -390 + 20.0 * i}, {0, 0, 0.3 * i}), i);
  }
  return builder.build(hall);
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

navjit::Vec3 random_direction(std::mt19937_64& random, const navjit::Vec3& near, double angle) {
  const navjit::Vec3 away{uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5};
  const navjit::Vec3 direction = near + angle * away;
  return (1 / norm(direction)) * direction;
}

/// All bits of all answers about one thread's particles, mixed into one number.
std::uint64_t transport(navjit::Navigator navigator, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uint64_t bits = 0;
  const auto mix = [&](double x) {
    bits = (std::rotl(bits, 7) ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15;
  };
  for (int particle = 0; particle < 400; ++particle) {
    navjit::Vec3 point{0, 0, -450}, direction = random_direction(random, {0, 0, 1}, 0.5);
    navjit::State state = navigator.locate(point, direction);
    for (int steps = 0; state.inside() && steps < 1000; ++steps) {
      const double safety = navigator.safety(state, point);
      const navjit::Step step = navigator.step(state, point, direction, 1 + 10 * uniform(random));
      point += step.length * direction;
      mix(step.length + safety);
      if (step.boundary) mix(navigator.boundary_normal(state, step.next, point).x);
      state = step.next;
      if (state.inside()) mix(navigator.to_local(state, point).y);
      if (!step.boundary) direction = random_direction(random, direction, 0.3);
    }
  }
  return bits;
}

struct Outcome {
  std::array<std::uint64_t, 2> bits{};  ///< of two threads
  std::size_t specialised = 0, compiled = 0;
};

Outcome run(const navjit::Detector& world, navjit::JitMode jit) {
  // Faster or not, specialised navigators are used: their bits are what counts here.
  navjit::Runtime runtime{world, {.jit = jit, .specialiser = {.keep_only_faster = false}}};
  Outcome outcome;
  {
    std::jthread one([&] { outcome.bits[0] = transport(runtime.navigator(), 1); });
    std::jthread other([&] { outcome.bits[1] = transport(runtime.navigator(), 2); });
  }
  for (const navjit::SceneReport& scene : runtime.report().scenes) {
    outcome.compiled += scene.origin == navjit::CodeOrigin::compiler ? 1 : 0;
  }
  outcome.specialised = runtime.specialised();
  return outcome;
}

}  // namespace

int main() try {
  const navjit::Detector world = detector();
  const Outcome off = run(world, navjit::JitMode::off);
  const Outcome on = run(world, navjit::JitMode::on);
  const Outcome wait = run(world, navjit::JitMode::wait);
  const bool equal = off.bits == on.bits && off.bits == wait.bits;
  std::printf("navjit %s: %s; %zu scenes specialised, %zu of them compiled\n", navjit::version(),
              equal ? "equal to the last bit" : "DIFFERENT", wait.specialised, wait.compiled);
  return equal && off.specialised == 0 && wait.specialised > 0 ? 0 : 1;
} catch (const navjit::Error& error) {
  std::fprintf(stderr, "simulation: %s\n", error.what());
  return 1;
}

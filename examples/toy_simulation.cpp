// A toy simulation: particles scatter their way through a detector made in code, on two threads,
// with limits from physics, safety spheres, surface crossings and local coordinates. It runs twice,
// without and with specialised navigators, and what it finds is the same to the last bit.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <random>
#include <thread>
#include <vector>

#include <navjit/navjit.hpp>

namespace {

using navjit::Vec3;

/// A calorimeter of lead plates and scintillator tiles in a hall of air.
navjit::Detector calorimeter() {
  navjit::DetectorBuilder builder;
  const auto hydrogen = builder.element({.name = "H", .z = 1, .a = 1.008});
  const auto carbon = builder.element({.name = "C", .z = 6, .a = 12.011});
  const auto nitrogen = builder.element({.name = "N", .z = 7, .a = 14.007});
  const auto oxygen = builder.element({.name = "O", .z = 8, .a = 15.999});
  const auto pb = builder.element({.name = "Pb", .z = 82, .a = 207.2});
  const auto air = builder.material(
      {.name = "Air", .density = 0.0012, .elements = {{nitrogen, 0.76}, {oxygen, 0.24}}});
  const auto lead = builder.material({.name = "Lead", .density = 11.35, .elements = {{pb, 1}}});
  const auto plastic = builder.material(
      {.name = "Polystyrene", .density = 1.05, .elements = {{hydrogen, 0.0774}, {carbon, 0.9226}}});
  const auto hall = builder.volume("hall", navjit::make_box("hall", 1000, 1000, 1000), air);
  const auto tower = builder.volume("tower", navjit::make_box("tower", 60, 60, 200), air);
  const auto plate = builder.volume("plate", navjit::make_box("plate", 60, 60, 2), lead);
  const auto tile = builder.volume("tile", navjit::make_box("tile", 60, 60, 4), plastic);
  const auto fibre = builder.volume("fibre", navjit::make_tube("fibre", 0, 0.5, 4, 0, 7), plastic);
  for (int i = 0; i < 25; ++i) {
    const int column = i % 5, row = i / 5;
    builder.place(fibre, tile, navjit::placed_at({-48 + 24.0 * column, -48 + 24.0 * row, 0}), i);
  }
  for (int layer = 0; layer < 30; ++layer) {
    builder.place(plate, tower, navjit::placed_at({0, 0, -190 + 13.0 * layer}), layer);
    builder.place(tile, tower, navjit::placed_at({0, 0, -184 + 13.0 * layer}), layer);
  }
  for (int i = 0; i < 9; ++i) {
    const int column = i % 3, row = i / 3;
    const navjit::Vec3 centre{-140 + 140.0 * column, -140 + 140.0 * row, 300};
    builder.place(tower, hall, navjit::placed_at(centre, {0, 0.02 * i, 0.1 * i}), i);
  }
  builder.set_user_data(tile, 1);  // sensitive
  return builder.build(hall);
}

struct Totals {
  double length = 0, in_tiles = 0;  ///< mm
  double local_z = 0;               ///< mm, of entries into tiles, in their own frames
  long steps = 0, entries = 0, answered_by_sphere = 0;

  /// To the last bit.
  bool operator==(const Totals& other) const {
    using Bits = std::array<std::uint64_t, sizeof(Totals) / sizeof(std::uint64_t)>;
    return std::bit_cast<Bits>(*this) == std::bit_cast<Bits>(other);
  }
};

/// The same distributions with every standard library.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Vec3 normalised(const Vec3& v) { return (1 / norm(v)) * v; }

/// One particle, from the origin into the towers.
void transport(navjit::Navigator& navigator, const navjit::Detector& detector,
               std::mt19937_64& random, Totals& totals) {
  Vec3 point{0, 0, 0};
  Vec3 direction = normalised({uniform(random) - 0.5, uniform(random) - 0.5, 1});
  navjit::SafetySphere sphere;
  navjit::State state = navigator.locate(point, direction);
  for (int n = 0; state.inside() && n < 2000; ++n) {
    // Physics sets the limit: the less, the shorter the radiation length is.
    const double x0 = detector.material(state).radiation_length;
    const double limit = x0 * (0.01 + 0.05 * uniform(random));
    // Within the sphere around an earlier point there is nothing to be asked.
    if (sphere.safety(state, point) <= limit) sphere = navigator.safety_sphere(state, point);
    const bool known = limit < sphere.safety(state, point);
    const navjit::Step step = navigator.step(state, point, direction, limit, sphere);
    const bool sensitive = detector.volume(state).user_data == 1;
    totals.answered_by_sphere += known ? 1 : 0;
    totals.in_tiles += sensitive ? step.length : 0;
    totals.length += step.length;
    ++totals.steps;
    point += step.length * direction;
    state = step.next;
    if (step.boundary) {
      if (state.inside() && detector.volume(state).user_data == 1) {
        ++totals.entries;
        totals.local_z += navigator.to_local(state, point).z;
      }
      continue;
    }
    // Scattering turns the direction, and displaces the point, but not beyond the safety.
    const double angle = 0.05;
    direction = normalised(direction + angle * Vec3{uniform(random) - 0.5, uniform(random) - 0.5,
                                                    uniform(random) - 0.5});
    const double most = sphere.safety(state, point);
    point +=
        0.1 * std::min(most, step.length) * Vec3{uniform(random) - 0.5, uniform(random) - 0.5, 0};
  }
}

Totals run(const navjit::Detector& detector, navjit::JitMode jit) {
  navjit::Runtime runtime{detector, {.jit = jit}};
  constexpr int threads = 2, particles = 1500;
  std::vector<Totals> by_thread(threads);
  std::vector<std::jthread> workers;
  workers.reserve(threads);
  for (int t = 0; t < threads; ++t) {
    workers.emplace_back([&, t] {
      navjit::Navigator navigator = runtime.navigator();  // one per thread
      for (int i = 0; i < particles; ++i) {
        std::mt19937_64 random(static_cast<unsigned>(t * particles + i));
        transport(navigator, detector, random, by_thread[static_cast<std::size_t>(t)]);
      }
    });
  }
  workers.clear();  // joins
  Totals sum;
  for (const Totals& one : by_thread) {
    sum.length += one.length;
    sum.in_tiles += one.in_tiles;
    sum.local_z += one.local_z;
    sum.steps += one.steps;
    sum.entries += one.entries;
    sum.answered_by_sphere += one.answered_by_sphere;
  }
  std::printf("%zu scenes specialised, %ld steps, %ld of them within safety spheres\n",
              runtime.specialised(), sum.steps, sum.answered_by_sphere);
  return sum;
}

}  // namespace

int main() try {
  const navjit::Detector detector = calorimeter();
  const Totals generic = run(detector, navjit::JitMode::off);
  const Totals specialised = run(detector, navjit::JitMode::wait);
  std::printf("%.6f mm in all, %.6f mm in tiles, %ld entries, mean local z %.6f mm\n",
              generic.length, generic.in_tiles, generic.entries,
              generic.local_z / static_cast<double>(generic.entries));
  const bool equal = generic == specialised;
  std::printf("with and without specialised navigators: %s\n",
              equal ? "equal to the last bit" : "DIFFERENT");
  return equal ? 0 : 1;
} catch (const navjit::Error& error) {
  std::fprintf(stderr, "toy_simulation: %s\n", error.what());
  return 1;
}

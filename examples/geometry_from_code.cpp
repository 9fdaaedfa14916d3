// A detector made in code, and what can be asked of it: the tree, frames, materials, user data.
#include <cmath>
#include <cstdio>
#include <vector>

#include <navjit/navjit.hpp>

int main() try {
  navjit::DetectorBuilder builder;
  const auto chromium = builder.element({.name = "Cr", .z = 24, .a = 51.996});
  const auto iron = builder.element({.name = "Fe", .z = 26, .a = 55.845});
  const auto nickel = builder.element({.name = "Ni", .z = 28, .a = 58.693});
  const auto nitrogen = builder.element({.name = "N", .z = 7, .a = 14.007});
  const auto oxygen = builder.element({.name = "O", .z = 8, .a = 15.999});
  const auto air = builder.material({.name = "Air",
                                     .density = 0.0012,
                                     .state = navjit::MaterialState::gas,
                                     .elements = {{nitrogen, 0.76}, {oxygen, 0.24}}});
  const auto steel =
      builder.material({.name = "Steel",
                        .density = 7.9,
                        .elements = {{iron, 0.7}, {chromium, 0.19}, {nickel, 0.11}}});
  // A wall with a hole, and bolts around the hole.
  const auto hall = builder.volume("hall", navjit::make_box("hall", 500, 500, 500), air);
  const auto solid = navjit::make_subtraction("wall", navjit::make_box("slab", 300, 300, 20),
                                              navjit::make_tube("hole", 0, 100, 30, 0, 7));
  const auto wall = builder.volume("wall", solid, steel);
  const auto bolt = builder.volume("bolt", navjit::make_tube("bolt", 0, 8, 20, 0, 7), steel);
  const auto at =
      builder.place(wall, hall, navjit::placed_at({0, 0, 200}, {0, 0.1, 0}), 1, "wall_1");
  for (int i = 0; i < 12; ++i) {
    const double phi = 2 * 3.14159265358979 * i / 12;
    builder.place(bolt, wall, navjit::placed_at({150 * std::cos(phi), 150 * std::sin(phi), 0}), i);
  }
  builder.add_auxiliary(bolt, {.type = "colour", .value = "red"});
  builder.set_user_data(hall, at, 42);
  const navjit::Detector detector = builder.build(hall);

  navjit::Runtime runtime{detector, {.jit = navjit::JitMode::off}};
  navjit::Navigator navigator = runtime.navigator();
  const navjit::State there = detector.state_at(std::vector<std::uint32_t>{at, 3});
  const navjit::Vec3 centre = navigator.to_global(there, {0, 0, 0});
  const navjit::State found = navigator.locate(centre);
  std::printf("%s at (%.3f, %.3f, %.3f)\n", detector.path_of(found).c_str(), centre.x, centre.y,
              centre.z);
  std::printf("copy %d of '%s' (%s, %s), of %s: %.2f g/cm3, X0 %.2f mm\n",
              detector.copy_number(found), detector.volume(found).name.c_str(),
              navjit::kind_name(detector.volume(found).solid.kind),
              navjit::find_auxiliary(detector.volume(found).auxiliaries, "colour")->value.c_str(),
              detector.material(found).name.c_str(), detector.material(found).density,
              detector.material(found).radiation_length);
  const navjit::State mother = detector.mother(found);
  std::printf("in '%s', user data %llu\n", detector.placement(mother)->name.c_str(),
              static_cast<unsigned long long>(detector.placement(mother)->user_data));
  return found == there ? 0 : 1;
} catch (const navjit::Error& error) {
  std::fprintf(stderr, "geometry_from_code: %s\n", error.what());
  return 1;
}

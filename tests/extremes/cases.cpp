#include "tests/extremes/cases.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/extremes/rays.hpp"
#include "tests/extremes/scene_text.hpp"
#include "tests/extremes/special_scenes.hpp"

namespace navjit::extremes {
namespace {

using Rays = std::vector<Ray>;
using MakeRays = std::function<Rays(const World&)>;

void append(Rays& a, const Rays& b) { a.insert(a.end(), b.begin(), b.end()); }

/// Some of everything.
MakeRays mixed(std::size_t count, std::uint64_t seed) {
  return [=](const World& world) {
    Rays rays = plain_rays(world, count / 4, seed);
    append(rays, rays_on_surfaces(world, count / 4, seed + 1));
    append(rays, grazing_rays(world, count / 4, seed + 2));
    append(rays, rays_from_corners(world, count / 4, seed + 3));
    return rays;
  };
}

std::string power(const char* words, double value) {
  char text[100];
  std::snprintf(text, sizeof text, "%s%.0e", words, value);
  return text;
}

/// Rays in which one of the six numbers, each in turn, is one of the values.
Rays with_bad_numbers(const World& world, const std::vector<double>& values) {
  Rays rays;
  for (const double bad : values) {
    for (int i = 0; i < 6; ++i) {
      Ray ray = plain_rays(world, 1, static_cast<std::uint64_t>(i) + 1)[0];
      double* numbers[6] = {&ray.position.x,  &ray.position.y,  &ray.position.z,
                            &ray.direction.x, &ray.direction.y, &ray.direction.z};
      *numbers[i] = bad;
      rays.push_back(ray);
    }
  }
  return rays;
}

}  // namespace

std::vector<Case> all_cases(bool full) {
  const std::size_t few = full ? 2000 : 200, many = full ? 8000 : 600;
  const std::string usual = every_solid(1, false), usual_for_vecgeom = every_solid(1, true);
  std::vector<Case> cases;
  const auto add = [&](std::string name, std::string gdml, std::string for_vecgeom, MakeRays rays) {
    cases.push_back({std::move(name), std::move(gdml), std::move(for_vecgeom), std::move(rays)});
  };
  using Values = std::vector<double>;
  for (const double scale :
       full ? Values{1e-6, 1e-4, 1e-2, 1, 1e2, 1e4, 1e6} : Values{1e-6, 1, 1e6}) {
    add(power("all solids, scaled by ", scale), every_solid(scale, false), every_solid(scale, true),
        mixed(few, 1));
  }
  for (const double away : full ? Values{1e5, 1e7, 1e9} : Values{1e5, 1e9}) {
    const Vec3 centre{away, -away, away};
    add(power("all solids, from the origin along each axis by mm ", away),
        every_solid(1, false, centre), every_solid(1, true, centre), mixed(few, 2));
  }
  add("grazing and tangent, to 1e-15", usual, usual_for_vecgeom,
      [=](const World& world) { return grazing_rays(world, many, 3); });
  add("starts on surfaces, within the tolerance and beyond", usual, usual_for_vecgeom,
      [=](const World& world) { return rays_on_surfaces(world, many, 4); });
  add("starts on corners, edges and vertices; zeros of both signs, denormals", usual,
      usual_for_vecgeom, [=](const World& world) { return rays_from_corners(world, many, 5); });
  for (const double by : full ? Values{1e-15, 1e-12, 1e-9, 1e-6} : Values{1e-15, 1e-6}) {
    add(power("directions not quite unit, by ", by), usual, usual_for_vecgeom,
        [=](const World& world) { return not_quite_unit(mixed(few, 6)(world), by); });
  }
  add("shells a micrometre thick at 10 m", thin_shells(), "", mixed(few, 7));
  add("tori nearly degenerate", odd_tori(true), odd_tori(false), [=](const World& world) {
    Rays rays = mixed(many, 8)(world);
    append(rays, rays_past_centres(world, many / 4, 14));
    append(rays, {{{325, 0, 0}, {1, 0, 5e-324}},  // once stuck
                  {{325, 0, 0}, {1, 0x1.87e92154ef7acp-665, 0}},
                  {{0x1.38000000180d4p+5, 0, 0},
                   {1, -0x0.012688b70e62bp-1022, -0x0.012688b70e62bp-1022}}});
    return rays;
  });
  add("cones nearly cylinders, and nearly points", odd_cones(), "", mixed(many, 9));
  add("wedges nearly closed, and nearly nothing", odd_wedges(), "", mixed(many, 10));
  add("volumes face to face, and flush with their mother", touching_volumes(), "", mixed(many, 11));
  add("daughters that fill their mothers, 30 levels", nested_copies(), "", mixed(few, 12));
  add("the same volume twice in one place", doubled_volumes(), "", mixed(few, 13));
  cases.back().for_vecgeom = false;
  const int slabs = full ? 1000 : 100;
  add(full ? "chains of 1e6 boundaries" : "chains of 1e5 boundaries", chain(1000, slabs), "",
      chain_rays);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  add("a number of the ray is NaN or infinite", usual, usual_for_vecgeom, [=](const World& world) {
    return with_bad_numbers(world, {nan, infinity, -infinity});
  });
  cases.back().refused = true;
  return cases;
}

}  // namespace navjit::extremes

// Random chambers of wires: rows of parallel tubes or bars.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "navjit/vector.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::tests {

/// How wires are strung. Lengths in mm.
struct Stringing {
  int wires = 60, layers = 1;
  double pitch = 2, radius = 0.3, half = 60;
  Vec3 angles{0, 0, 0};  ///< the wires' local z is along them
  double turn = 0;       ///< of the row about the wires, rad
  Vec3 middle{0, 0, 0};
  double jitter = 0;         ///< along and across the row
  double skew = 0;           ///< of each wire's angles, rad
  double second_pitch = 0;   ///< of the other half of the wires; 0: the same
  double missing = 0;        ///< share of wires
  bool bars = false;         ///< boxes
  bool hollow = false;       ///< tubes with a bore, some of them cut to a segment
  bool cut_at_frame = true;  ///< lengths fall off to both ends of the row
};

/// Unit vectors along the wires, along a row, and across the rows.
struct WireAxes {
  Vec3 along, across, normal;
};

inline WireAxes axes_of(const Stringing& s) {
  double r[9];
  rotation_from_angles(s.angles.x, s.angles.y, s.angles.z, r);
  const Vec3 x{r[0], r[1], r[2]}, y{r[3], r[4], r[5]}, z{r[6], r[7], r[8]};
  const double c = std::cos(s.turn), t = std::sin(s.turn);
  return {z, c * x + t * y, c * y + -t * x};
}

/// Strings wires in a mother, each a volume of its own. Returns how many.
inline int string_wires(World& world, VolumeId mother, const Stringing& s,
                        std::mt19937_64& random) {
  const WireAxes axes = axes_of(s);
  const int half = s.wires / 2;
  int strung = 0;
  for (int layer = 0; layer < s.layers; ++layer) {
    for (int i = 0; i < s.wires; ++i) {
      if (uniform(random, 0, 1) < s.missing) continue;
      const double step = s.second_pitch > 0 && i > half ? s.second_pitch : s.pitch;
      const double at = (i - half) * step + (layer % 2) * s.pitch / 2;
      const double off = (layer - (s.layers - 1) / 2.0) * (0.9 * s.pitch);
      const double length =
          s.cut_at_frame ? s.half * (1.02 - std::abs(2.0 * i / s.wires - 1)) : s.half;
      const auto shake = [&] { return s.jitter > 0 ? uniform(random, -s.jitter, s.jitter) : 0.0; };
      const Vec3 middle = s.middle + (at + shake()) * axes.across + (off + shake()) * axes.normal +
                          (s.cut_at_frame ? 0.05 * at : 0.0) * axes.along;
      const std::string name = "wire" + std::to_string(world.volumes.size());
      const bool segment = s.hollow && i % 3 == 0;
      const VolumeId wire =
          add_volume(world, name,
                     s.bars ? make_box(name, s.radius, 0.6 * s.radius, length)
                            : make_tube(name, s.hollow ? 0.6 * s.radius : 0, s.radius, length, 0.3,
                                        segment ? 4.0 : 7.0));
      const auto askew = [&] { return s.skew > 0 ? uniform(random, -s.skew, s.skew) : 0.0; };
      place(world, mother, wire, middle, {s.angles.x + askew(), s.angles.y + askew(), s.angles.z});
      ++strung;
    }
  }
  return strung;
}

/// The kinds of chambers that tests try.
inline std::vector<std::pair<std::string, Stringing>> stringings() {
  std::vector<std::pair<std::string, Stringing>> all;
  const auto add = [&](const char* name, auto change) {
    Stringing s;
    change(s);
    all.emplace_back(name, s);
  };
  add("along z", [](Stringing&) {});
  add("oblique", [](Stringing& s) { s.angles = {0.95, 0, 0}; });
  add("anyhow", [](Stringing& s) { s.angles = {0.4, 0.7, -1.1}, s.turn = 0.5; });
  add("jittered", [](Stringing& s) { s.angles = {0.95, 0, 0}, s.jitter = 0.2; });
  add("askew", [](Stringing& s) { s.angles = {0.2, 0.4, 0}, s.skew = 1e-3, s.radius = 0.5; });
  add("staggered layers", [](Stringing& s) { s.layers = 4, s.radius = 0.9, s.turn = 0.3; });
  add("layers along x", [](Stringing& s) { s.layers = 3, s.angles = {0, M_PI / 2, 0}; });
  add("bars", [](Stringing& s) { s.bars = true, s.angles = {0.95, 0, 0}, s.radius = 0.8; });
  add("bars anyhow", [](Stringing& s) { s.bars = true, s.angles = {1, 2, 3}, s.turn = 0.4; });
  add("overlapping", [](Stringing& s) { s.radius = 1.4, s.angles = {0.3, 0, 0.2}; });
  add("touching", [](Stringing& s) { s.radius = 1, s.cut_at_frame = false; });
  add("missing", [](Stringing& s) { s.missing = 0.2, s.angles = {0, 0.6, 0}; });
  add("two pitches", [](Stringing& s) { s.second_pitch = 3.1, s.angles = {0.95, 0, 0}; });
  add("hollow", [](Stringing& s) { s.hollow = true, s.radius = 0.9, s.layers = 2; });
  return all;
}

/// A ray for number `i`: in any direction, along wires, along rows, or nearly so, from the middle
/// of the chamber, or from a wire's surface if one is given.
inline std::pair<Vec3, Vec3> ray_among_wires(std::mt19937_64& random, const Stringing& s, int i) {
  const WireAxes axes = axes_of(s);
  const double spread = i % 2 == 0 ? s.half : 2 * s.radius;
  Vec3 p = s.middle + uniform(random, -s.half, s.half) * axes.across +
           uniform(random, -s.half, s.half) * axes.along +
           uniform(random, -spread, spread) * axes.normal;
  Vec3 d = random_direction(random);
  const double tilt = i % 3 == 0 ? 0 : i % 3 == 1 ? 1e-9 : uniform(random, -0.05, 0.05);
  const auto turned = [&](const Vec3& to) {
    d = to + tilt * d;
    d = (1 / norm(d)) * d;
  };
  switch (i % 9) {
    case 1:
      turned(axes.along);
      break;
    case 2:
      turned(axes.across);
      break;
    case 3:
      turned(-1.0 * axes.across);
      break;
    case 4:
      turned(axes.normal);
      break;
    case 5:  // along a row's tangent plane
      turned(axes.across);
      p += (s.radius - dot(p - s.middle, axes.normal)) * axes.normal;
      break;
    case 6:  // along a wire's surface
      turned(axes.along);
      p += (std::round(dot(p - s.middle, axes.across) / s.pitch) * s.pitch + s.radius -
            dot(p - s.middle, axes.across)) *
               axes.across -
           dot(p - s.middle, axes.normal) * axes.normal;
      break;
    default:
      break;
  }
  return {p, d};
}

}  // namespace navjit::tests

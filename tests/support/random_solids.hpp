// Solids and frames drawn at random.
#pragma once

#include <cmath>
#include <cstring>
#include <random>

#include "geometry/model/random.hpp"
#include "geometry/solids/solid.hpp"

namespace navjit {

inline Solid random_primitive(std::mt19937_64& random) {
  const auto size = [&] { return uniform(random, 0.5, 4); };
  switch (random() % 5) {
    case 0:
      return make_box("s", size(), size(), size());
    case 1:
      return make_tube("s", 0.3, 0.5 + size(), size(), 0.2, uniform(random, 1, 6.2));
    case 2:
      return make_cone("s", 0.1, size(), 0.2, size(), size(), 0, 6.283185307179586);
    case 3:
      return make_orb("s", size());
    default:
      return make_trd("s", size(), size(), size(), size(), size());
  }
}

inline SolidFrame random_frame(std::mt19937_64& random) {
  SolidFrame frame;
  for (double& t : frame.translation) t = uniform(random, -3, 3);
  if (random() % 2 == 0) {
    const double a = uniform(random, 0, 6);
    const double c = std::cos(a), s = std::sin(a);
    const double turn[9] = {c, s, 0, -s, c, 0, 0, 0, 1};
    std::memcpy(frame.rotation, turn, sizeof turn);
  }
  return frame;
}

}  // namespace navjit

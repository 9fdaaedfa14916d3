#include "geometry/solids/moved_box.hpp"

#include <cmath>

namespace navjit {

Extent moved_box(const Extent& e, const double (&translation)[3], const double (&rotation)[9]) {
  // The centre is moved, half lengths go through |rotation|.
  const double centre[3] = {(e.min.x + e.max.x) / 2, (e.min.y + e.max.y) / 2,
                            (e.min.z + e.max.z) / 2};
  const double half[3] = {(e.max.x - e.min.x) / 2, (e.max.y - e.min.y) / 2,
                          (e.max.z - e.min.z) / 2};
  double low[3], high[3];
  for (int i = 0; i < 3; ++i) {
    double c = translation[i], h = 0;
    for (int j = 0; j < 3; ++j) {
      c += rotation[3 * j + i] * centre[j];
      h += std::abs(rotation[3 * j + i]) * half[j];
    }
    low[i] = c - h;
    high[i] = c + h;
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

}  // namespace navjit

#include "geometry/check/chords.hpp"

#include "navjit/vector.hpp"

namespace navjit {

std::vector<Chord> chords_along(const kernels::AnySolid<double>& solid, const Vec3& p,
                                const Vec3& v, double reach, double tolerance) {
  std::vector<Chord> chords;
  const Direction d = kernels::make_direction(v.x, v.y, v.z);
  double path = 0;
  for (int turn = 0; turn < 32; ++turn) {
    const double in = distance_to_in(solid, p + path * v, d, tolerance);
    if (!(path + in < reach)) break;
    const double enter = path + in;
    const double out = distance_to_out(solid, p + enter * v, d, tolerance);
    if (!(enter + out < reach)) break;
    chords.push_back({enter, enter + out});
    if (!(in + out > 0)) break;
    path = enter + out;
  }
  return chords;
}

}  // namespace navjit

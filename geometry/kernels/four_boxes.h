// Boxes along the axes of one frame, four at once. Each lane has the bits of the kernel for one box
// (box.h).
namespace navjit::kernels {

/// Centres and half lengths, mm. Empty lanes have half lengths of -infinity.
struct FourBoxes {
  Doubles x, y, z, hx, hy, hz;
};

inline Doubles larger_of_four(Doubles a, Doubles b) { return a > b ? a : b; }
inline Doubles smaller_of_four(Doubles a, Doubles b) { return a < b ? a : b; }

/// ascending(p, v) of each lane.
inline Doubles ascending_four(Doubles p, double v) {
  const unsigned long long sign = __builtin_bit_cast(unsigned long long, v) & 1ULL << 63;
  return __builtin_bit_cast(Doubles, __builtin_bit_cast(Words, p) ^ Words{sign, sign, sign, sign});
}

/// distance_to_entry of each box.
inline Doubles distances_to_entry(const FourBoxes& s, const Vec3<double>& p,
                                  const Direction<double>& v, double tol) {
  const Doubles x = ascending_four(p.x - s.x, v.x), y = ascending_four(p.y - s.y, v.y),
                z = ascending_four(p.z - s.z, v.z);
  const double rate_x = absolute(v.inverse_x), rate_y = absolute(v.inverse_y),
               rate_z = absolute(v.inverse_z);
  const Doubles until =
      smaller_of_four((s.hx - tol - x) * rate_x,
                      smaller_of_four((s.hy - tol - y) * rate_y, (s.hz - tol - z) * rate_z));
  const Doubles before_x = -s.hx - x, before_y = -s.hy - y, before_z = -s.hz - z;
  Doubles enter = four_of(-1);
  enter = before_x > tol ? before_x * rate_x : enter;
  enter = before_y > tol ? larger_of_four(before_y * rate_y, enter) : enter;
  enter = before_z > tol ? larger_of_four(before_z * rate_z, enter) : enter;
  return ((enter < until) & (until > 0)) ? enter : four_of(infinity<double>());
}

/// Updates `best` and `hit` with the nearest of the boxes, with the result of asking one after the
/// other. `v` is oblique.
template <int n>
inline void nearest_of_boxes(const FourBoxes (&boxes)[n], const Vec3<double>& p,
                             const Direction<double>& v, double tol, double& best, int& hit) {
  Doubles t[n], least = four_of(infinity<double>());
  for (int i = 0; i < n; ++i) {
    t[i] = distances_to_entry(boxes[i], p, v, tol);
    least = smaller_of_four(t[i], least);
  }
  const double nearest = smaller(smaller(least[0], least[2]), smaller(least[1], least[3]));
  if (!(nearest < best)) return;
  unsigned bits = 0;
  for (int i = 0; i < n; ++i) {
    bits |= bits_of(__builtin_bit_cast(Words, t[i] == nearest)) << (lanes_of_four * i);
  }
  best = nearest;
  hit = __builtin_ctz(bits);
}

/// The last of the daughters, other than `blocked`, that contains the point; -1 for none. `v` is
/// oblique, and all half lengths are larger than the tolerance.
template <int n>
inline int last_box_at(const FourBoxes (&boxes)[n], const Vec3<double>& p,
                       const Direction<double>& v, double tol, int blocked) {
  unsigned bits = 0;
  for (int i = 0; i < n; ++i) {
    const FourBoxes& s = boxes[i];
    const Doubles x = ascending_four(p.x - s.x, v.x), y = ascending_four(p.y - s.y, v.y),
                  z = ascending_four(p.z - s.z, v.z);
    const Doubles ahead = smaller_of_four(s.hx - x, smaller_of_four(s.hy - y, s.hz - z));
    const Doubles before = larger_of_four(-s.hx - x, larger_of_four(-s.hy - y, -s.hz - z));
    bits |= bits_of(__builtin_bit_cast(Words, (ahead > tol) & (before <= tol)))
            << (lanes_of_four * i);
  }
  if (blocked >= 0) bits &= ~(1U << blocked);
  return bits == 0 ? -1 : 31 - __builtin_clz(bits);
}

}  // namespace navjit::kernels

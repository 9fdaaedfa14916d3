// Four sides that are not quite flat, and what a plane near each can tell about them. Corners that
// are given to a tenth of a millimetre make most sides of real solids twist by as much. A twisted
// side takes a quadratic equation where its plane takes a quotient.
namespace navjit::kernels {

/// The planes near four sides. Each has an outward unit normal (a, b, c) and an offset d, as in
/// Plane. The bounds hold within a box that is somewhat larger than the solid. There a side is no
/// farther from its plane than `reach`, mm. A line whose direction times the normal is more than
/// `lean` in magnitude crosses the side at most once, and in the same sense as the plane. A side
/// that twists too much for this to be useful has an infinite reach.
template <class Real>
struct SidePlanes {
  FourOf<Real> a, b, c, d;
  FourOf<Real> reach, lean;
};

template <class Real>
constexpr Real number_of(const FourOf<Real>& four, int lane) {
  return lane < 2 ? lane == 0 ? four.a : four.b : lane == 2 ? four.c : four.d;
}
/// The signed distance to the plane of one side.
template <class Real>
constexpr Real plane_distance(const SidePlanes<Real>& s, int side, const Vec3<Real>& p) {
  return number_of(s.a, side) * p.x + number_of(s.b, side) * p.y + number_of(s.c, side) * p.z +
         number_of(s.d, side);
}

/// The signed distances of a point to all planes, and the normals times a direction.
inline FaceLanes<Doubles> planes_near(const SidePlanes<double>& s, const Vec3<double>& p,
                                      const Direction<double>& v) {
  const Doubles a = lanes_from(s.a), b = lanes_from(s.b), c = lanes_from(s.c);
  return {a * p.x + b * p.y + c * p.z + lanes_from(s.d), a * v.x + b * v.y + c * v.z};
}

/// A point that is farther than this from a plane is not on the side either, and is behind or
/// before both.
inline Doubles clear_of(const SidePlanes<double>& s, double tol) {
  return lanes_from(s.reach) + 2 * tol;
}

/// Gives the lanes in ascending order of their numbers.
struct SmallestFirst {
  Doubles lanes;

  /// The lane of the smallest.
  int next() const {
    int at = lanes[1] < lanes[0] ? 1 : 0;
    const int other = lanes[3] < lanes[2] ? 3 : 2;
    at = lanes[other] < lanes[at] ? other : at;
    return at;
  }
  void drop(int lane) { lanes[lane] = infinity<double>(); }
};

/// For a start within the box: by lane, a path before which the side is not left. It is 0 where the
/// side itself has to be asked.
inline Doubles earliest_exits(const FaceLanes<Doubles>& f, const Doubles& clear) {
  const Doubles depth = -(f.beyond + clear), never = four_of(infinity<double>());
  const Doubles ahead = f.nv > 0 ? depth / f.nv : never;
  return depth > 0 ? ahead : four_of(0);
}

/// How a ray from outside comes to the space between four sides, as far as their planes tell.
struct Entry {
  static constexpr int unknown = -1, at_once = 4;

  double earliest;  ///< the ray is not between the sides before this path; infinity: it never is
  int side;         ///< the side it enters by; at_once: it is behind all at `earliest`
};

/// Where the ray is between four sides after `from` >= 0 and before `until`. The side by which it
/// enters is known if the ray is behind all other sides by then, and leaves none of them before it
/// has surely entered.
inline Entry entry_by_planes(const FaceLanes<Doubles>& f, const Doubles& clear, const Doubles& lean,
                             double from, double until) {
  const double forever = infinity<double>();
  const Doubles none = four_of(-forever), all = four_of(forever);
  const auto in = f.nv < 0;
  const auto out = f.nv > 0;
  const Doubles before = f.beyond - clear, behind = f.beyond + clear;
  // A ray along the plane is behind it for ever, or never.
  const Doubles never = before > 0 ? all : none, surely = behind < 0 ? none : all;
  const Doubles early = in ? before / -f.nv : out ? none : never;
  const Doubles late = in ? behind / -f.nv : out ? none : surely;
  const Doubles left_early = out ? -behind / f.nv : all, left_late = out ? -before / f.nv : all;
  const double earliest = largest_lane(early), last = -largest_lane(-left_late);
  if (larger(earliest, from) > smaller(last, until)) return {forever, Entry::unknown};
  const double first_left = -largest_lane(-left_early);
  if (earliest <= from) {
    const bool is_between = (largest_lane(late) <= from) & (from <= first_left);
    return {from, is_between ? Entry::at_once : Entry::unknown};
  }
  int side = 0;
  for (int i = 1; i < lanes_of_four; ++i) side = early[i] > early[side] ? i : side;
  Doubles others = late;
  others[side] = -forever;
  const bool is_known = (largest_lane(others) <= earliest) & (late[side] <= first_left) &
                        (late[side] < until) & (f.nv[side] < -lean[side]);
  return {earliest, is_known ? side : Entry::unknown};
}

}  // namespace navjit::kernels

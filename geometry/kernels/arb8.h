// Two convex quadrilaterals across z with their corners joined by straight lines. The sides are
// flat or twisted: hyperbolic paraboloids, which a line may cross twice.
namespace navjit::kernels {

/// The side (a x + b y + c z + d) z + e x + f y + g = 0; the value is negative within. A flat side
/// has a = b = c = 0.
template <class Real>
struct TwistedFace {
  Real a, b, c, d, e, f, g;
};

template <class Real>
struct Arb8 {
  Real hz;      ///< half length, mm
  Real hx, hy;  ///< the solid is within |x| <= hx, |y| <= hy, mm
  TwistedFace<Real> first, second, third, fourth;
  SidePlanes<Real> planes;  ///< the bounds hold in a box larger by a thirty-second
};

template <>
inline constexpr bool uses_vectors<Arb8<double>> = true;

template <class Real>
constexpr const TwistedFace<Real>& side_of(const Arb8<Real>& s, int number) {
  return number < 2 ? number == 0 ? s.first : s.second : number == 2 ? s.third : s.fourth;
}

template <class Real>
QuadraticForm<Real> form_at(const TwistedFace<Real>& s, const Vec3<Real>& p,
                            const Direction<Real>& v) {
  const Real across = s.a * p.x + s.b * p.y, rate = s.a * v.x + s.b * v.y + s.c * v.z;
  const Real gx = s.a * p.z + s.e, gy = s.b * p.z + s.f, gz = across + 2 * s.c * p.z + s.d;
  return {rate * v.z,
          (gx * v.x + gy * v.y + gz * v.z) / 2,
          (across + s.c * p.z + s.d) * p.z + s.e * p.x + s.f * p.y + s.g,
          gx * gx + gy * gy + gz * gz,
          absolute(s.c),
          s.a * s.a + s.b * s.b + s.c * s.c};
}

template <class Real>
Side inside(const Arb8<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, absolute(p.z) - s.hz, tol);
  side = worse(side, face_distance(s.first, p), tol);
  side = worse(side, face_distance(s.second, p), tol);
  side = worse(side, face_distance(s.third, p), tol);
  return worse(side, face_distance(s.fourth, p), tol);
}

template <class Real>
bool contains(const Arb8<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return !beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol) &&
         in_form(form_at(s.first, p, v), tol) && in_form(form_at(s.second, p, v), tol) &&
         in_form(form_at(s.third, p, v), tol) && in_form(form_at(s.fourth, p, v), tol);
}

/// Is the point, seen along z, in a box somewhat larger than the one around the solid?
template <class Real>
constexpr bool is_near(const Arb8<Real>& s, const Vec3<Real>& p) {
  const Real room = Real(1) / 64;
  return (absolute(p.x) <= s.hx + room * s.hx) & (absolute(p.y) <= s.hy + room * s.hy);
}

/// distance_to_in by the spans behind each side.
template <class Real>
Real entry_by_spans(const Arb8<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real shift = approach(s.hx, s.hy, -s.hz, s.hz, p, v);
  if (!(shift < infinity<Real>())) return infinity<Real>();
  const Vec3<Real> q = shift > 0 ? advance(p, v, shift) : p;
  const SpanPair<Real> body[] = {one_span(slab_span(-s.hz, s.hz, p, v, tol)),
                                 moved_by(form_spans(s.first, q, v, tol), shift),
                                 moved_by(form_spans(s.second, q, v, tol), shift),
                                 moved_by(form_spans(s.third, q, v, tol), shift),
                                 moved_by(form_spans(s.fourth, q, v, tol), shift)};
  const SpanPair<Real> hole[] = {no_spans<Real>()};
  const Real t = first_entry(body, hole);
  if (t < 0) return distance_from_within(s, p, tol);
  // At an end that is an edge or a point the sides there say nothing but rounding, so that a ray
  // along the end would come into the solid 1e17 mm away.
  return t < infinity<Real>() && is_near(s, advance(p, v, t)) ? t : infinity<Real>();
}
template <class Real>
Real distance_to_in(const Arb8<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return entry_by_spans(s, p, v, tol);
}

template <class Real>
Real distance_to_out(const Arb8<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real leave = leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, infinity<Real>());
  leave = leave_form(s.first, p, v, tol, leave);
  leave = leave_form(s.second, p, v, tol, leave);
  leave = leave_form(s.third, p, v, tol, leave);
  return leave_form(s.fourth, p, v, tol, leave);
}

// The same functions for double, by planes near the sides. Only the sides that their planes do not
// decide are asked.

inline bool contains(const Arb8<double>& s, const Vec3<double>& p, const Direction<double>& v,
                     double tol) {
  if (beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol) | !is_near(s, p)) return false;
  const Doubles beyond = planes_near(s.planes, p, v).beyond, clear = clear_of(s.planes, tol);
  if (any_lane(beyond > clear)) return false;
  const Doubles open = beyond + clear;
  for (int i = 0; i < lanes_of_four; ++i) {
    if (open[i] >= 0 && !in_form(form_at(side_of(s, i), p, v), tol)) return false;
  }
  return true;
}

inline double distance_to_out(const Arb8<double>& s, const Vec3<double>& p,
                              const Direction<double>& v, double tol) {
  double leave = leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, infinity<double>());
  const FaceLanes<Doubles> planes = planes_near(s.planes, p, v);
  const Doubles lean = lanes_from(s.planes.lean);
  SmallestFirst exits{earliest_exits(planes, clear_of(s.planes, tol))};
  for (int asked = 0; asked < lanes_of_four; ++asked) {
    const int i = exits.next();
    const double earliest = exits.lanes[i];
    if (!(earliest < leave)) break;
    const TwistedFace<double>& side = side_of(s, i);
    const QuadraticForm<double> form = form_at(side, p, v);
    if (!(earliest > 0) && !in_form(form, tol)) return 0;
    // A side that the ray heads away from is not met again, however it twists.
    if (!(planes.nv[i] < -lean[i]) && comes_out(form, tol)) {
      const double exit = form_exit(side, form, form_root(form), p, v);
      if (!(exit > 0)) return 0;
      leave = smaller(exit, leave);
    }
    exits.drop(i);
  }
  return leave;
}

/// Has the ray, from a point in the box or before it, left the solid by a side that the ray does
/// not meet again?
inline bool has_left(const Arb8<double>& s, const FaceLanes<Doubles>& planes, const Doubles& clear,
                     const Vec3<double>& p, const Direction<double>& v, double tol) {
  const Doubles steep = planes.nv - lanes_from(s.planes.lean);
  const auto near = absolute(planes.beyond) <= clear;
  const auto leaves = near & (steep > 0);
  if (!any_lane(leaves)) return false;
  for (int i = 0; i < lanes_of_four; ++i) {
    if (leaves[i] != 0 && !in_form(form_at(side_of(s, i), p, v), tol)) return true;
  }
  return false;
}

inline double distance_to_in(const Arb8<double>& s, const Vec3<double>& p,
                             const Direction<double>& v, double tol) {
  const double shift = approach(s.hx, s.hy, -s.hz, s.hz, p, v);
  if (!(shift < infinity<double>())) return infinity<double>();
  const Vec3<double> q = shift > 0 ? advance(p, v, shift) : p;
  const FaceLanes<Doubles> planes = planes_near(s.planes, q, v);
  const Doubles clear = clear_of(s.planes, tol);
  const Span<double> slab = slab_span(-s.hz, s.hz, p, v, tol);
  const Entry entry = entry_by_planes(planes, clear, lanes_from(s.planes.lean), slab.enter - shift,
                                      slab.until - shift);
  if (!(entry.earliest < infinity<double>())) return infinity<double>();
  if (entry.earliest > 0 && entry.side != Entry::unknown) {
    double t = slab.enter - shift;
    if (entry.side != Entry::at_once) {
      const TwistedFace<double>& side = side_of(s, entry.side);
      const QuadraticForm<double> form = form_at(side, q, v);
      t = polished(side, q, v, form.c / (form_root(form) - form.b));
    }
    if (t > 0 && is_near(s, advance(q, v, t))) return t + shift;
  }
  return has_left(s, planes, clear, q, v, tol) ? infinity<double>() : entry_by_spans(s, p, v, tol);
}

template <class Real>
Real beyond_arb8(const Arb8<Real>& s, const Vec3<Real>& p) {
  Real beyond = absolute(p.z) - s.hz;
  beyond = larger(face_distance(s.first, p), beyond);
  beyond = larger(face_distance(s.second, p), beyond);
  beyond = larger(face_distance(s.third, p), beyond);
  return larger(face_distance(s.fourth, p), beyond);
}

// Safeties are distances to the planes, less the reach of the sides. The sides themselves are asked
// where that is not positive and, from within, where the reach is a large part of the distance.

template <class Real>
Real safety_to_in(const Arb8<Real>& s, const Vec3<Real>& p) {
  Real nearest = -infinity<Real>();
  for (int i = 0; i < lanes_of_four; ++i) {
    nearest = larger(plane_distance(s.planes, i, p) - number_of(s.planes.reach, i), nearest);
  }
  return nearest > 0 ? larger(absolute(p.z) - s.hz, nearest) : larger(beyond_arb8(s, p), Real(0));
}

/// From within, no side is asked if all are farther away than this many times their reach.
constexpr int reaches_that_are_little = 16;

template <class Real>
Real safety_to_out(const Arb8<Real>& s, const Vec3<Real>& p) {
  Real depth = s.hz - absolute(p.z), by_planes = depth;
  bool is_far = true;
  for (int i = 0; i < lanes_of_four; ++i) {
    const Real reach = number_of(s.planes.reach, i);
    const Real bound = -(plane_distance(s.planes, i, p) + reach);
    is_far &= !(bound < reaches_that_are_little * reach);
    by_planes = smaller(bound, by_planes);
    depth = smaller(larger(bound, -face_distance(side_of(s, i), p)), depth);
  }
  return larger(is_far ? by_planes : depth, Real(0));
}

// The same functions for double, four sides at once.

inline double safety_to_in(const Arb8<double>& s, const Vec3<double>& p) {
  const Doubles away = planes_near(s.planes, p, {}).beyond - lanes_from(s.planes.reach);
  const double nearest = largest_lane(away);
  return nearest > 0 ? larger(absolute(p.z) - s.hz, nearest) : larger(beyond_arb8(s, p), 0.0);
}
inline double safety_to_out(const Arb8<double>& s, const Vec3<double>& p) {
  double depth = s.hz - absolute(p.z);
  const Doubles reach = lanes_from(s.planes.reach);
  SmallestFirst sides{-(planes_near(s.planes, p, {}).beyond + reach)};
  if (!any_lane(sides.lanes < reaches_that_are_little * reach)) {
    return larger(smaller(-largest_lane(-sides.lanes), depth), 0.0);
  }
  for (int asked = 0; asked < lanes_of_four; ++asked) {
    const int i = sides.next();
    if (!(sides.lanes[i] < depth)) break;
    depth = smaller(larger(sides.lanes[i], -face_distance(side_of(s, i), p)), depth);
    sides.drop(i);
  }
  return larger(depth, 0.0);
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const Arb8<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, -s.hz, s.hz, p.z);
  offer_form(best, s.first, false, p);
  offer_form(best, s.second, false, p);
  offer_form(best, s.third, false, p);
  offer_form(best, s.fourth, false, p);
  return best.normal;
}

}  // namespace navjit::kernels

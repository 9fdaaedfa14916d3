// A torus about the z axis, which may be hollow and cut to an azimuthal segment. A tube wider than
// its circle covers the axis; the solid is still all points within rmax of the circle.
//
// Let h be the squared distance of a point of a ray from the circle in the middle of the tube.
// Along the ray, h is convex far from the z axis, concave near it, and convex again beyond. This
// suffices to bracket the turning points of h, and between these every crossing, without solving
// the quartic equation. Crossings are then found from h itself, which has none of the cancellation
// of the quartic's coefficients.
namespace navjit::kernels {

template <class Real>
struct Torus {
  Real rmin, rmax;  ///< of the tube, mm; rmin may be 0
  Real rtor;        ///< radius of the circle in the middle of the tube, mm
  Wedge<Real> wedge;
};

/// A ray from `p` along `v`, and the circle of radius `ring` in the plane z = 0.
template <class Real>
struct RingForm {
  Real ring;
  Vec3<Real> p;
  Direction<Real> v;
};

/// The rate at which a ray moves away from the axis. On the axis, where the rate jumps, the rate
/// just ahead counts.
template <class Real>
Real radial_rate(const RingForm<Real>& q, Real x, Real y, Real rho) {
  return rho > 0 ? (x * q.v.x + y * q.v.y) / rho : square_root(q.v.x * q.v.x + q.v.y * q.v.y);
}

/// The squared distance from the circle and half its derivative.
template <class Real>
Sample<Real> value_at(const RingForm<Real>& q, Real t) {
  const Real x = q.p.x + t * q.v.x, y = q.p.y + t * q.v.y, z = q.p.z + t * q.v.z;
  const Real rho = square_root(x * x + y * y), across = rho - q.ring;
  return {across * across + z * z, across * radial_rate(q, x, y, rho) + z * q.v.z};
}
/// Half the second derivative of h just ahead of the start.
template <class Real>
Real curvature(const RingForm<Real>& q) {
  const Real rho = square_root(q.p.x * q.p.x + q.p.y * q.p.y);
  const Real cross = q.p.x * q.v.y - q.p.y * q.v.x;
  const Real a = q.v.x * q.v.x + q.v.y * q.v.y + q.v.z * q.v.z;
  return rho > 0 ? a - q.ring * (cross * cross) / (rho * rho * rho) : a;
}

/// The larger of 0 and the cube root.
template <class Real>
Real cube_root(Real x) {
  if (!(x > 0)) return Real(0);
  Real y = square_root(square_root(x));
  for (int i = 0; i < 4; ++i) y = square_root(square_root(x * y));
  for (int i = 0; i < 8; ++i) y -= (y - x / (y * y)) / 3;
  return y;
}

/// The turning points of h ahead of the start. Falling and rising parts alternate, and the last
/// part rises to the end.
template <class Real>
struct Turns {
  bool falling;  ///< is the first part falling?
  int count;
  Real at[3];
  Real end;  ///< a path beyond all of the torus
};

template <class Real>
Real turning_point(const RingForm<Real>& q, Real low, Real high, bool minimum) {
  const Real a = q.v.x * q.v.x + q.v.y * q.v.y + q.v.z * q.v.z;
  const auto slope = [&](Real t) {
    const Real x = q.p.x + t * q.v.x, y = q.p.y + t * q.v.y, z = q.p.z + t * q.v.z;
    const Real rho = square_root(x * x + y * y);
    const Real radial = radial_rate(q, x, y, rho), cross = x * q.v.y - y * q.v.x;
    const Real bend = rho > 0 ? cross * cross / (rho * rho * rho) : Real(0);
    return Sample<Real>{(rho - q.ring) * radial + z * q.v.z, a - q.ring * bend};
  };
  return bracketed_zero(slope, low, high, minimum);
}

template <class Real>
Turns<Real> turns_ahead(const RingForm<Real>& q, Real reach) {
  const Vec3<Real>& p = q.p;
  const Direction<Real>& v = q.v;
  const Real s2 = v.x * v.x + v.y * v.y, a = s2 + v.z * v.z;
  const Real along = p.x * v.x + p.y * v.y + p.z * v.z;
  const Real length2 = p.x * p.x + p.y * p.y + p.z * p.z;
  Turns<Real> turns{};
  turns.end = (absolute(along) + 2 * reach + square_root(length2)) * 2;
  const Real slope = value_at(q, Real(0)).slope;
  turns.falling = slope < 0 || (slope == 0 && curvature(q) < 0);

  // The concave part, if there is one, is where rho < `bend`. Two minima lie on its sides if h
  // rises into it and falls out of it.
  bool two = false;
  Real from = 0, to = 0;
  const Real s = square_root(s2);
  if (s > 0) {
    const Real cross = p.x * v.y - p.y * v.x, nearest = absolute(cross) / s;
    const Real bend = cube_root(q.ring * (cross * cross) / a);
    const bool through = !(bend > 0);  // the axis, or so near to it that the square underflows
    if (bend > nearest || through) {
      const Real ratio = through ? Real(0) : nearest / bend;
      const Real part = square_root(larger(1 - ratio * ratio, Real(0)));
      const Real middle = -(p.x * v.x + p.y * v.y) / s2, half = bend * part / s;
      from = middle - half;
      to = middle + half;
      const Real radial = (bend - q.ring) * (s * part);
      two = (p.z + from * v.z) * v.z - radial > 0 && (p.z + to * v.z) * v.z + radial < 0;
    }
  }
  const auto add = [&](Real low, Real high, bool minimum) {
    turns.at[turns.count++] = turning_point(q, larger(low, Real(0)), high, minimum);
  };
  if (!two) {
    if (turns.falling) add(Real(0), turns.end, true);
  } else if (turns.falling) {
    if (from > 0) {
      add(Real(0), from, true);
      add(from, to, false);
    }
    add(to, turns.end, true);
  } else if (to > 0) {
    add(from, to, false);
    add(to, turns.end, true);
  }
  return turns;
}

/// Is the start on the axis, to within the tolerance?
template <class Real>
bool on_axis(const RingForm<Real>& q, Real tol) {
  return q.p.x * q.p.x + q.p.y * q.p.y <= tol * tol;
}

/// Whether a ray that heads out is in again within the tolerance. That would be a step too short to
/// move the point. It happens at the inner side of the ring, and in a hole that hardly exists.
template <class Real>
bool comes_back(Real r, const RingForm<Real>& q, const Sample<Real>& at, Real tol) {
  const Real s2 = q.v.x * q.v.x + q.v.y * q.v.y;
  if (on_axis(q, tol)) return q.p.z * q.v.z < q.ring * square_root(s2);
  const Real bend = curvature(q), c = at.value - r * r;
  return bend < 0 &&
         square_root(larger(at.slope * at.slope - bend * c, Real(0))) + at.slope <= -tol * bend;
}

/// Directional containment in the tube of radius r. A tangent is in if the distance from the circle
/// decreases along it. A ray that would be out again within the tolerance, by a step too short to
/// move the point, leaves at once, and a ray that would be in again does not leave.
template <class Real>
bool in_ring(Real r, const RingForm<Real>& q, Real tol) {
  const Sample<Real> at = value_at(q, Real(0));
  const Real outer = r + tol, inner = r - tol;
  if (at.value > outer * outer) return false;
  if (at.value < inner * inner && inner > 0) return true;
  if (at.slope > 0 || (at.slope == 0 && on_axis(q, tol))) return comes_back(r, q, at, tol);
  const Real bend = curvature(q), c = at.value - r * r;
  if (at.slope == 0 && !(bend < 0 || (bend > 0 && c < 0))) return false;
  if (!(bend > 0) || at.slope < -tol * bend) return true;
  return square_root(larger(at.slope * at.slope - bend * c, Real(0))) - at.slope > tol * bend;
}

/// The parts of the ray in the tube of radius r.
template <class Real>
SpanPair<Real> ring_spans(Real r, const RingForm<Real>& q, const Turns<Real>& turns, Real tol) {
  const auto distance = [&](Real t) {
    const Sample<Real> at = value_at(q, t);
    return Sample<Real>{at.value - r * r, 2 * at.slope};
  };
  SpanPair<Real> pair = no_spans<Real>();
  bool in = in_ring(r, q, tol), second = false, falling = turns.falling;
  const bool stays = in && !falling && comes_back(r, q, value_at(q, Real(0)), tol);
  // The ray heads in, but is out again within the tolerance.
  const bool grazes = !in && falling && value_at(q, Real(0)).value <= (r + tol) * (r + tol);
  Real enter = -infinity<Real>(), from = 0;
  for (int i = 0; i <= turns.count; ++i, falling = !falling) {
    const Real to = i < turns.count ? turns.at[i] : turns.end;
    const bool beyond = i == turns.count || distance(to).value >= 0;
    if (i == 0 && (grazes || stays)) {
      // The rest of this part is not entered, or not left.
    } else if (!in && !beyond) {
      // A ray that starts within the tolerance of the surface and heads out counts as out, even if
      // it is in the tube. It enters where h turns.
      enter = falling ? bracketed_zero(distance, from, to, false) : to;
      in = true;
      // If the ray is out for no more than the tolerance, it does not leave: the hole hardly
      // exists.
      if (second && enter - pair.first.leave <= tol) {
        enter = pair.first.enter;
        pair = no_spans<Real>();
        second = false;
      }
    } else if (!falling && in && beyond) {
      // A ray within the tolerance of the surface may turn before it is in.
      const bool passed = i > 0 && distance(from).value >= 0;
      const Real leave = passed ? from : bracketed_zero(distance, from, to, true);
      (second ? pair.second : pair.first) = {enter, leave, leave};
      second = true;
      in = false;
    }
    from = to;
  }
  return pair;
}

/// The path out of the tube of radius r, for a ray that is in the tube and either off its surface
/// or on its way in. In the tube the second derivative of h is no larger than at its outer edge. So
/// the path to where the ray could leave at the earliest is never too long, and a few such steps
/// lead to where it does leave. The result is negative if the ray only grazes there, or if it takes
/// too many steps. `hole` is the least distance of the tube from the axis.
template <class Real>
Real ring_exit(Real r, Real hole, const RingForm<Real>& q, Real tol) {
  Sample<Real> at = value_at(q, Real(0));
  const Real inner = r - tol, a = q.v.x * q.v.x + q.v.y * q.v.y + q.v.z * q.v.z;
  const bool is_deep = inner > 0 && at.value < inner * inner;
  if (!(hole > 64 * tol) || !(is_deep || at.slope < 0)) return Real(-1);
  const Real cross = q.p.x * q.v.y - q.p.y * q.v.x, furthest = q.ring + r;
  const Real most_bend = a - q.ring * (cross * cross) / (furthest * furthest * furthest);
  Real t = 0;
  for (int i = 0; i < 20; ++i) {
    const Real c = at.value - r * r, square = at.slope * at.slope - most_bend * c;
    if (!(square > 0)) return Real(-1);
    const Real root = square_root(square);
    const Real step = at.slope > 0 ? -c / (root + at.slope) : (root - at.slope) / most_bend;
    // The ray must stay out for longer than the tolerance. It bends back by no more than at the
    // hole.
    const Real to = t + step;
    if (t + step / 4 == t || !(step > 0)) {
      return at.slope > 4 * tol * (a + q.ring / hole) ? larger(to, Real(0)) : Real(-1);
    }
    t = to;
    at = value_at(q, t);
  }
  return Real(-1);
}

/// The path to where such a ray comes into a tube of radius r within the other one, before `until`;
/// infinity if it does not. The result is negative in the same cases as for ring_exit. In the wider
/// tube the second derivative of h is no smaller than at the hole.
template <class Real>
Real ring_entry(Real r, Real hole, const RingForm<Real>& q, Real tol, Real until) {
  Sample<Real> at = value_at(q, Real(0));
  const Real outer = r + tol, inner = r - tol, a = q.v.x * q.v.x + q.v.y * q.v.y + q.v.z * q.v.z;
  const bool is_off = at.value > outer * outer;
  if (!is_off && (at.value < inner * inner || !(at.slope > 0))) return Real(-1);
  const Real cross = q.p.x * q.v.y - q.p.y * q.v.x;
  const Real least_bend = a - q.ring * (cross * cross) / (hole * hole * hole);
  Real t = 0;
  for (int i = 0; i < 20; ++i) {
    const Real c = larger(at.value - r * r, Real(0));
    const Real slope2 = at.slope * at.slope, square = slope2 - least_bend * c;
    const bool falls = at.slope < 0;
    // The square is a difference of nearly equal numbers: the tube is narrow, or the ray only
    // grazes it.
    if (falls && absolute(square) <= slope2 * Real(0x1p-20)) return Real(-1);
    if (least_bend >= 0 && !(falls && square > 0)) return infinity<Real>();
    const Real root = square_root(square);
    const Real step = falls ? c / (root - at.slope) : (root + at.slope) / -least_bend;
    const Real to = t + step;
    if (!(to < until)) return infinity<Real>();
    if (t + step / 4 == t) {
      return at.slope < -4 * tol * (a + q.ring / hole) ? larger(to, Real(0)) : Real(-1);
    }
    t = to;
    at = value_at(q, t);
  }
  return Real(-1);
}

/// The ray from a point near the torus on, and the path to that point.
template <class Real>
struct TorusApproach {
  Real shift;
  RingForm<Real> form;
};
template <class Real>
TorusApproach<Real> approach_torus(const Torus<Real>& s, const Vec3<Real>& p,
                                   const Direction<Real>& v) {
  const Real reach = s.rtor + s.rmax;
  const Real shift = approach(reach, reach, -s.rmax, s.rmax, p, v);
  return {shift, {s.rtor, shift > 0 && shift < infinity<Real>() ? advance(p, v, shift) : p, v}};
}

/// Whether the ray misses the torus because it is in the hole of the torus, or not there at all,
/// all the way between the two planes across z that enclose the torus. Its distance from the axis
/// is greatest where it crosses one of the planes. The test allows for all rounding. It pays
/// because most rays that come near one of many rings, as in a field cage, pass through the ring.
template <class Real>
bool passes_through_hole(const Torus<Real>& s, const RingForm<Real>& q, Real tol) {
  const Real room = s.rmax / 64 + (s.rtor + s.rmax) / 1048576 + 4 * tol;
  const Real hole = s.rtor - s.rmax - room, half = s.rmax + room;
  if (!(hole > 0)) return false;
  if (is_along(q.v.z)) return absolute(q.p.z) > half;
  const Real one = (-half - q.p.z) * q.v.inverse_z, other = (half - q.p.z) * q.v.inverse_z;
  const auto is_within = [&](Real t) {
    const Real x = q.p.x + t * q.v.x, y = q.p.y + t * q.v.y;
    return x * x + y * y < hole * hole;
  };
  return larger(one, other) < 0 ||
         (is_within(larger(smaller(one, other), Real(0))) && is_within(larger(one, other)));
}

/// Distance from the circle in the middle of the tube.
template <class Real>
Real ring_distance(Real ring, const Vec3<Real>& p) {
  const Real across = square_root(p.x * p.x + p.y * p.y) - ring;
  return square_root(across * across + p.z * p.z);
}

template <class Real>
Side inside(const Torus<Real>& s, const Vec3<Real>& p, Real tol) {
  const Real d = ring_distance(s.rtor, p);
  Side side = worse(Side::inside, d - s.rmax, tol);
  if (s.rmin > 0) side = worse(side, s.rmin - d, tol);
  if (s.wedge.kind != 0) side = worse(side, wedge_distance(s.wedge, p.x, p.y), tol);
  return side;
}

template <class Real>
bool contains(const Torus<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const RingForm<Real> q{s.rtor, p, v};
  if (!in_ring(s.rmax, q, tol)) return false;
  if (s.rmin > 0 && in_ring(s.rmin, q, tol)) return false;
  return in_wedge(s.wedge, p, v, tol);
}

template <class Real>
Real distance_to_in(const Torus<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const TorusApproach<Real> near = approach_torus(s, p, v);
  if (!(near.shift < infinity<Real>())) return infinity<Real>();
  if (passes_through_hole(s, near.form, tol)) return infinity<Real>();
  const Turns<Real> turns = turns_ahead(near.form, s.rtor + s.rmax);
  Span<Real> segment = whole_ray<Real>();
  if (s.wedge.kind == 1) clip_to_wedge(s.wedge, p, v, tol, segment);
  const SpanPair<Real> body[] = {moved_by(ring_spans(s.rmax, near.form, turns, tol), near.shift),
                                 one_span(segment)};
  const SpanPair<Real> hole[] = {
      s.rmin > 0 ? moved_by(ring_spans(s.rmin, near.form, turns, tol), near.shift)
                 : no_spans<Real>(),
      one_span(gap_span(s.wedge, p, v, tol))};
  const Real t = first_entry(body, hole);
  return t < 0 ? distance_from_within(s, p, tol) : t;
}

template <class Real>
Real distance_to_out(const Torus<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  const RingForm<Real> q{s.rtor, p, v};
  if (in_ring(s.rmax, q, tol)) {
    const Real hole = s.rtor - s.rmax, leave = ring_exit(s.rmax, hole, q, tol);
    const Real enter =
        s.rmin > 0 && leave > 0 ? ring_entry(s.rmin, hole, q, tol, leave) : infinity<Real>();
    if (leave > 0 && enter > 0) return leave_wedge(s.wedge, p, v, tol, smaller(leave, enter));
  }
  const Turns<Real> turns = turns_ahead(q, s.rtor + s.rmax);
  Real leave = leave_body(ring_spans(s.rmax, q, turns, tol), infinity<Real>());
  if (s.rmin > 0) leave = leave_into_holes(ring_spans(s.rmin, q, turns, tol), leave);
  return leave_wedge(s.wedge, p, v, tol, leave);
}

template <class Real>
Real safety_to_in(const Torus<Real>& s, const Vec3<Real>& p) {
  const Real d = ring_distance(s.rtor, p);
  Real away = larger(d - s.rmax, Real(0));
  if (s.rmin > 0) away = larger(s.rmin - d, away);
  if (s.wedge.kind != 0) away = larger(wedge_distance(s.wedge, p.x, p.y), away);
  return away;
}

template <class Real>
Real safety_to_out(const Torus<Real>& s, const Vec3<Real>& p) {
  const Real d = ring_distance(s.rtor, p);
  Real depth = s.rmax - d;
  if (s.rmin > 0) depth = smaller(d - s.rmin, depth);
  if (s.wedge.kind != 0) depth = smaller(-wedge_distance(s.wedge, p.x, p.y), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

template <class Real>
Vec3<Real> normal(const Torus<Real>& s, const Vec3<Real>& p, Real tol) {
  const Radial<Real> r = radial_at(p);
  const Real across = r.rho - s.rtor, d = ring_distance(s.rtor, p);
  const Vec3<Real> away = unit_vector(Vec3<Real>{across * r.x, across * r.y, p.z});
  NearestFace<Real> best = no_face(tol);
  offer(best, d - s.rmax, away);
  if (s.rmin > 0) offer(best, s.rmin - d, turned_over(away));
  offer_wedge(best, s.wedge, p);
  return best.normal;
}

}  // namespace navjit::kernels

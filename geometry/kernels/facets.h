// A body that is bounded by a closed surface of triangles, convex or not, with a hierarchy of boxes
// around the triangles.
//
// A ray's line crosses a triangle as often as the triangle's outline, seen along the line, winds
// around it. The winding of an outline is counted edge by edge, and an edge counts the same for
// both of its triangles, to the last bit. So over a closed surface entries and exits cancel
// whatever is rounded, and no line is lost through an edge or a corner.
//
// A crossing is behind the start if its path is not positive, or if the start is within the
// tolerance of the triangle. All other crossings are ahead, and they alone tell whether the start
// is in the body: it is if there are more exits ahead than entries.
namespace navjit::kernels {

/// Where an edge crosses the plane y = 0.
template <class Real>
struct EdgePoint {
  int from, to;  ///< ends of the edge, in the same order for both triangles
  Real along;    ///< 0 at `from`, 1 at `to`
  Real x;
};

/// Does the line cross the facet? Returns +1 if it crosses into the body, -1 if out of it, and 0 if
/// not. `t` receives the path.
template <class Real>
int facet_turn(const Facets<Real>& s, const RayFrame<Real>& frame, const Facet& f, Real& t) {
  // A ray misses most facets of a box that it meets, so each division waits until it is needed.
  const int index[3] = {f.a, f.b, f.c};
  const Vec3<Real> d[3] = {turned(difference(s.corners[f.a], frame.start), frame.axis),
                           turned(difference(s.corners[f.b], frame.start), frame.axis),
                           turned(difference(s.corners[f.c], frame.start), frame.axis)};
  const Real y[3] = {d[0].y - frame.shear_y * d[0].z, d[1].y - frame.shear_y * d[1].z,
                     d[2].y - frame.shear_y * d[2].z};
  const bool above[3] = {y[0] > 0, y[1] > 0, y[2] > 0};
  if (above[0] == above[1] && above[1] == above[2]) return 0;
  const Real x[3] = {d[0].x - frame.shear_x * d[0].z, d[1].x - frame.shear_x * d[1].z,
                     d[2].x - frame.shear_x * d[2].z};
  if ((x[0] > 0) == (x[1] > 0) && (x[1] > 0) == (x[2] > 0)) {
    // If all corners are to one side, so is all that is between them, except for rounding.
    const Real nearest = smaller(absolute(x[0]), smaller(absolute(x[1]), absolute(x[2])));
    const Real widest = larger(absolute(x[0]), larger(absolute(x[1]), absolute(x[2])));
    if (nearest > Real(1e-14) * widest) return 0;
  }
  EdgePoint<Real> up{0, 0, 0, 0}, down{0, 0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const int k = i == 2 ? 0 : i + 1;
    if (above[i] == above[k]) continue;
    const int from = index[i] < index[k] ? i : k, to = index[i] < index[k] ? k : i;
    const Real along = y[from] / (y[from] - y[to]);
    (above[k] ? up : down) = {from, to, along, x[from] + (x[to] - x[from]) * along};
  }
  const bool up_right = up.x > 0, down_right = down.x > 0;
  if (up_right == down_right) return 0;
  const auto path = [&](const EdgePoint<Real>& at) {
    const Real begin = d[at.from].z / frame.rate, end = d[at.to].z / frame.rate;
    return begin + (end - begin) * at.along;
  };
  const Real up_t = path(up), down_t = path(down);
  t = up_t + (down_t - up_t) * (up.x / (up.x - down.x));
  return up_right == (frame.rate > 0) ? -1 : 1;
}

/// May the ray, from its start on, come within `margin` of the box?
template <class Real>
bool ray_meets(const FacetBox<Real>& box, const Vec3<Real>& p, const Direction<Real>& v,
               Real margin) {
  Real enter = 0, leave = infinity<Real>();
  const auto clip = [&](Real low, Real high, Real at, Real rate, Real inverse) {
    if (rate == 0) {
      if (at < low - margin || at > high + margin) leave = Real(-1);
      return;
    }
    const Real t1 = (low - margin - at) * inverse, t2 = (high + margin - at) * inverse;
    enter = larger(smaller(t1, t2), enter);
    leave = smaller(larger(t1, t2), leave);
  };
  clip(box.x_low, box.x_high, p.x, v.x, v.inverse_x);
  clip(box.y_low, box.y_high, p.y, v.y, v.inverse_y);
  clip(box.z_low, box.z_high, p.z, v.z, v.inverse_z);
  return enter <= leave;
}

/// Calls visit(facet) for all facets that the ray, which is along `v`, may cross: those in boxes
/// that it may come within `margin` of.
template <class Real, class Visit>
void visit_met(const Facets<Real>& s, const RayFrame<Real>& frame, const Direction<Real>& v,
               Real margin, const Visit& visit) {
  for (int i = 0; i < s.box_count;) {
    const FacetBox<Real>& box = s.boxes[i];
    if (!ray_meets(box, frame.start, v, margin)) {
      i = box.next;
      continue;
    }
    for (int k = box.first; k < box.first + box.count; ++k) visit(k);
    ++i;
  }
}
template <class Visit>
void visit_met(const Facets<double>& s, const RayFrame<double>& frame, const Direction<double>& v,
               double margin, const Visit& visit) {
  visit_met(s.groups, s.leaves, frame, v, margin, visit);
}

/// The nearest crossings ahead, in order. Crossings at the same path are combined into one.
template <class Real>
struct Crossings {
  static constexpr int capacity = 8;
  int total;    ///< entries less exits, of all crossings ahead
  int count;    ///< of those kept
  Real beyond;  ///< all before this path are kept
  Real t[capacity];
  int turn[capacity];
};

template <class Real>
void keep_crossing(Crossings<Real>& c, Real t, int turn) {
  if (!(t < c.beyond)) return;
  int at = c.count;
  while (at > 0 && c.t[at - 1] > t) --at;
  if (at > 0 && c.t[at - 1] == t) {
    c.turn[at - 1] += turn;
    return;
  }
  if (c.count == Crossings<Real>::capacity) {
    if (at == c.count) {
      c.beyond = t;
      return;
    }
    c.beyond = c.t[--c.count];
  }
  for (int i = c.count; i > at; --i) {
    c.t[i] = c.t[i - 1];
    c.turn[i] = c.turn[i - 1];
  }
  c.t[at] = t;
  c.turn[at] = turn;
  ++c.count;
}

/// The crossings ahead, kept from the path `from` on.
template <class Real>
Crossings<Real> crossings_ahead(const Facets<Real>& s, const Vec3<Real>& p,
                                const Direction<Real>& v, Real tol, Real from) {
  Crossings<Real> c;
  c.total = 0;
  c.count = 0;
  c.beyond = infinity<Real>();
  const RayFrame<Real> frame = ray_frame(p, v);
  // The margin is above all rounding, since no triangle may be left out on which the count of its
  // neighbour relies.
  const FacetBox<Real>& all = s.boxes[0];
  const Real size = larger(absolute(p.x), larger(absolute(p.y), absolute(p.z))) +
                    larger(larger(absolute(all.x_low), absolute(all.x_high)),
                           larger(larger(absolute(all.y_low), absolute(all.y_high)),
                                  larger(absolute(all.z_low), absolute(all.z_high))));
  const Real margin = 2 * tol + Real(1e-14) * size;
  visit_met(s, frame, v, margin, [&](int k) {
    Real t = 0;
    const int turn = facet_turn(s, frame, s.facets[k], t);
    if (turn == 0 || !(t > 0)) return;
    if (touches_facet(s, s.facets[k], p, tol)) return;
    c.total += turn;
    if (t >= from) keep_crossing(c, t, turn);
  });
  return c;
}

/// The path to the first crossing ahead where the body begins (`in`) or ends.
template <class Real>
Real path_until(const Facets<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol,
                Crossings<Real> c, bool in) {
  int depth = -c.total;
  for (;;) {
    for (int i = 0; i < c.count; ++i) {
      depth += c.turn[i];
      if ((depth > 0) == in) return c.t[i];
    }
    if (!(c.beyond < infinity<Real>())) return infinity<Real>();
    c = crossings_ahead(s, p, v, tol, c.beyond);
  }
}

// --- The solid --------------------------------------------------------------------------------

template <class Real>
bool contains(const Facets<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (box_distance2(s.boxes[0], p) > tol * tol) return false;
  if (v.x == 0 && v.y == 0 && v.z == 0) {
    // Asked without a direction, all of the surface belongs to the body. For other points any ray
    // tells.
    if (surface_distance2(s, p, tol * tol * Real(1.000001)) <= tol * tol) return true;
    const Direction<Real> up = make_direction<Real>(0, 0, 1);
    return crossings_ahead(s, p, up, tol, infinity<Real>()).total < 0;
  }
  const Direction<Real> whole = make_direction(v.x, v.y, v.z);
  return crossings_ahead(s, p, whole, tol, infinity<Real>()).total < 0;
}

template <class Real>
Side inside(const Facets<Real>& s, const Vec3<Real>& p, Real tol) {
  // The limit lies just above the square of the tolerance.
  const Real limit = tol * tol * Real(1.000001);
  if (surface_distance2(s, p, limit) <= tol * tol) return Side::surface;
  const Direction<Real> up = make_direction<Real>(0, 0, 1);
  return contains(s, p, up, tol) ? Side::inside : Side::outside;
}

template <class Real>
Real distance_to_in(const Facets<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  const Crossings<Real> c = crossings_ahead(s, p, v, tol, Real(0));
  if (c.total < 0 && !(box_distance2(s.boxes[0], p) > tol * tol)) {
    return distance_from_within(s, p, tol);
  }
  return path_until(s, p, v, tol, c, true);
}

template <class Real>
Real distance_to_out(const Facets<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  const Crossings<Real> c = crossings_ahead(s, p, v, tol, Real(0));
  return c.total < 0 ? path_until(s, p, v, tol, c, false) : Real(0);
}

/// The distance to the surface from its side `side`, which is 1 outside and -1 inside; 0 for a
/// point on the other side. If the nearest point of the surface is within a facet, the facet tells
/// the side. Otherwise a ray does. A ray is also asked if the facet says that the point is on the
/// other side, since facets may be within the body.
template <class Real>
Real safety_from(const Facets<Real>& s, const Vec3<Real>& p, int side) {
  const NearestFacet<Real> nearest = nearest_in_surface(s, p, infinity<Real>());
  if (nearest.side != side &&
      contains(s, p, make_direction<Real>(0, 0, 1), Real(0)) != (side < 0)) {
    return Real(0);
  }
  return square_root(nearest.distance2);
}
template <class Real>
Real safety_to_in(const Facets<Real>& s, const Vec3<Real>& p) {
  return safety_from(s, p, 1);
}
template <class Real>
Real safety_to_out(const Facets<Real>& s, const Vec3<Real>& p) {
  return safety_from(s, p, -1);
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

/// The normal of the facet that is nearest to the point. Of several that are nearest to within the
/// tolerance, it is the largest, since the normal of a sliver means little.
template <class Real>
Vec3<Real> normal(const Facets<Real>& s, const Vec3<Real>& p, Real tol) {
  const Real within = square_root(surface_distance2(s, p, infinity<Real>())) + tol;
  const Real limit = within * within;
  Vec3<Real> best{0, 0, 0};
  for (int i = 0; i < s.box_count;) {
    const FacetBox<Real>& box = s.boxes[i];
    if (box_distance2(box, p) > limit) {
      i = box.next;
      continue;
    }
    for (int k = box.first; k < box.first + box.count; ++k) {
      const Facet& f = s.facets[k];
      const Vec3<Real> u = difference(s.corners[f.b], s.corners[f.a]);
      const Vec3<Real> v = difference(s.corners[f.c], s.corners[f.a]);
      const Vec3<Real> n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
      if (dot(n, n) > dot(best, best) && facet_distance2(s, f, p) <= limit) best = n;
    }
    ++i;
  }
  return unit_vector(best);
}

}  // namespace navjit::kernels

// An upright prism: a polygon, convex or not, that does not cross itself, between two faces across
// z. Seen along z, a ray crosses an edge if the edge's ends are on different sides of the ray. A
// corner counts the same for both of its edges. So entries and exits always cancel, and no ray is
// lost through a corner. (This is the method of `Facets` in a plane.)
//
// A crossing is behind the start if its path is not positive, or if the start is within the
// tolerance of the edge. All other crossings are ahead, and they alone tell whether the start is in
// the polygon: it is if there are more exits ahead than entries.
namespace navjit::kernels {

template <class Real>
struct PlanarCorner {
  Real x, y;
};

/// Eight corners. Where fewer are left, the last one occurs more than once.
template <class Real>
struct CornerGroup {
  EightOf<Real> x, y;
};

template <class Real>
struct Prism {
  const PlanarCorner<Real>* corners;  ///< anticlockwise
  int count;
  const CornerGroup<Real>* groups;  ///< the same corners, in groups of eight
  int group_count;
  Real z_low, z_high;
  Real x_low, x_high, y_low, y_high;  ///< the box around the polygon
};

template <>
inline constexpr bool uses_vectors<Prism<double>> = true;

/// The squared distance of (x, y) from the edge that ends at corner i.
template <class Real>
Real edge_distance2(const Prism<Real>& s, int i, Real x, Real y) {
  const PlanarCorner<Real>&a = s.corners[i == 0 ? s.count - 1 : i - 1], &b = s.corners[i];
  const Real ux = b.x - a.x, uy = b.y - a.y, wx = x - a.x, wy = y - a.y;
  const Real length2 = ux * ux + uy * uy, along = ux * wx + uy * wy;
  if (!(along > 0)) return wx * wx + wy * wy;
  if (!(along < length2)) return (x - b.x) * (x - b.x) + (y - b.y) * (y - b.y);
  const Real across = ux * wy - uy * wx;
  return across * across / length2;
}

/// The number of the nearest edge, and the squared distance from it.
template <class Real>
struct NearestEdge {
  int edge;
  Real distance2;
};
template <class Real>
NearestEdge<Real> nearest_edge(const Prism<Real>& s, Real x, Real y) {
  NearestEdge<Real> nearest{0, infinity<Real>()};
  for (int i = 0; i < s.count; ++i) {
    const Real distance2 = edge_distance2(s, i, x, y);
    if (distance2 < nearest.distance2) nearest = {i, distance2};
  }
  return nearest;
}

/// The corner before each of eight corners. The one before the first is the last of `before`.
inline EightLanes lanes_before(EightLanes before, EightLanes lanes) {
  return __builtin_shufflevector(before, lanes, 7, 8, 9, 10, 11, 12, 13, 14);
}

/// The squared distance from the nearest edge.
template <class Real>
Real edges_distance2(const Prism<Real>& s, Real x, Real y) {
  return nearest_edge(s, x, y).distance2;
}
/// The same, eight edges at once.
inline double edges_distance2(const Prism<double>& s, double x, double y) {
  constexpr EightLanes lane_numbers{0, 1, 2, 3, 4, 5, 6, 7};
  EightLanes nearest = eight_of(infinity<double>());
  // The corner before the first one of a group is the last one of the group before.
  EightLanes x_before = lanes_from(s.groups[s.group_count - 1].x);
  EightLanes y_before = lanes_from(s.groups[s.group_count - 1].y);
  for (int i = 0; i < s.group_count; ++i) {
    const EightLanes bx = lanes_from(s.groups[i].x), by = lanes_from(s.groups[i].y);
    const EightLanes ax = lanes_before(x_before, bx), ay = lanes_before(y_before, by);
    const EightLanes ux = bx - ax, uy = by - ay, wx = x - ax, wy = y - ay;
    const EightLanes length2 = ux * ux + uy * uy, along = ux * wx + uy * wy;
    const EightLanes across = ux * wy - uy * wx;
    const EightLanes from_a = wx * wx + wy * wy;
    const EightLanes from_b = (x - bx) * (x - bx) + (y - by) * (y - by);
    const EightLanes within = across * across / length2;
    const EightLanes distance2 = !(along > 0) ? from_a : !(along < length2) ? from_b : within;
    const auto is_nearer = (distance2 < nearest) & (lane_numbers < double(s.count - 8 * i));
    nearest = is_nearer ? distance2 : nearest;
    x_before = bx;
    y_before = by;
  }
  return -largest_lane(-nearest);
}

/// How far (x, y) is outside of the box around the polygon.
template <class Real>
Real outside_box(const Prism<Real>& s, Real x, Real y) {
  return larger(larger(s.x_low - x, x - s.x_high), larger(s.y_low - y, y - s.y_high));
}

/// A ray seen along z. `parallel`: it runs along z, and (u, v) is any direction.
template <class Real>
struct PlanarRay {
  Real x, y, u, v;
  bool parallel;
};
template <class Real>
PlanarRay<Real> seen_along_z(const Vec3<Real>& p, const Direction<Real>& v) {
  const bool parallel = is_along(v.x) & is_along(v.y);
  return {p.x, p.y, parallel ? Real(1) : v.x, parallel ? Real(0) : v.y, parallel};
}

/// Whether the ray runs along the edge that ends at corner i, within the tolerance of the edge.
/// Such a ray is in the solid.
template <class Real>
bool runs_along(const Prism<Real>& s, int i, const PlanarRay<Real>& ray, Real tol) {
  const PlanarCorner<Real>&a = s.corners[i == 0 ? s.count - 1 : i - 1], &b = s.corners[i];
  const Real ux = b.x - a.x, uy = b.y - a.y, length = square_root(ux * ux + uy * uy);
  if (!is_along((uy * ray.u - ux * ray.v) / length)) return false;
  return absolute(ux * (ray.y - a.y) - uy * (ray.x - a.x)) <= tol * length;
}

/// The same ray moved into the solid by more than the tolerance, if it runs along an edge.
template <class Real>
[[gnu::noinline, gnu::cold]] PlanarRay<Real> moved_inside(const Prism<Real>& s, PlanarRay<Real> ray,
                                                          Real tol) {
  for (int i = 0; i < s.count; ++i) {
    if (!runs_along(s, i, ray, tol)) continue;
    const PlanarCorner<Real>&a = s.corners[i == 0 ? s.count - 1 : i - 1], &b = s.corners[i];
    const Real ux = b.x - a.x, uy = b.y - a.y, length = square_root(ux * ux + uy * uy);
    const Real by = 3 * tol + Real(4e-16) * (absolute(ray.x) + absolute(ray.y));
    ray.x -= by * uy / length;
    ray.y += by * ux / length;
    break;
  }
  return ray;
}

/// A polygon with more corners is made a solid of facets instead of a prism.
constexpr int most_corners_of_prism = 128;

/// Crossings ahead. They are taken out in order, and those at the same path together.
template <class Real>
struct EdgesAhead {
  int total = 0;  ///< entries less exits
  /// The number of corners that are nearly on the ray's line. The last corner may be counted
  /// several times.
  int near = 0;
  int count = 0;  ///< the number of edges
  /// By edge, which ends at corner i: the path to its crossing; infinity if there is none.
  Real t[most_corners_of_prism];
  /// Bit i, counted on from word to word: whether the crossing is an exit.
  unsigned long long out[most_corners_of_prism / 64];
};

/// What is needed of the crossings.
enum class Keep { total, all };

/// Is the start of the ray within the tolerance of the edge that ends at corner i?
template <class Real>
bool starts_at_edge(const Prism<Real>& s, int i, const PlanarRay<Real>& ray, Real tol) {
  return !(edge_distance2(s, i, ray.x, ray.y) > tol * tol);
}

/// A corner as seen from a ray's start, and along and across the ray. `side` is positive to the
/// left of the ray.
template <class Number>
struct CornerSeen {
  Number x, y, along, side;
};
template <class Number, class Real>
CornerSeen<Number> seen_along(const PlanarRay<Real>& ray, Number x, Number y) {
  const Number from_x = x - ray.x, from_y = y - ray.y;
  return {from_x, from_y, ray.u * from_x + ray.v * from_y, ray.u * from_y - ray.v * from_x};
}

/// Finds the crossings ahead. A corner counts as near if its `side` is at most `close` in
/// magnitude.
template <Keep keep, class Real>
EdgesAhead<Real> edges_ahead(const Prism<Real>& s, const PlanarRay<Real>& ray, Real tol,
                             Real close) {
  EdgesAhead<Real> c;
  c.count = s.count;
  for (unsigned long long& word : c.out) word = 0;
  const Real length2 = ray.u * ray.u + ray.v * ray.v;
  const auto seen = [&](int i) { return seen_along(ray, s.corners[i].x, s.corners[i].y); };
  CornerSeen<Real> before = seen(s.count - 1);
  for (int i = 0; i < s.count; ++i) {
    const CornerSeen<Real> from = before, at = seen(i);
    before = at;
    c.t[i] = infinity<Real>();
    c.near += absolute(at.side) <= close ? 1 : 0;
    const bool left = at.side > 0;
    if (left == (from.side > 0)) continue;
    const Real path = from.along + (at.along - from.along) * (from.side / (from.side - at.side));
    if (!(path > 0) || starts_at_edge(s, i, ray, tol)) continue;
    // The edge goes to the left of the ray. What is inside lies behind the edge.
    c.total += left ? -1 : 1;
    c.t[i] = path / length2;
    c.out[i / 64] |= static_cast<unsigned long long>(left) << i % 64;
  }
  return c;
}

/// The same, eight edges at once, since it is unpredictable which of them are crossed.
template <Keep keep>
EdgesAhead<double> edges_ahead(const Prism<double>& s, const PlanarRay<double>& ray, double tol,
                               double close) {
  EdgesAhead<double> c;
  c.count = 8 * s.group_count;
  const double length2 = ray.u * ray.u + ray.v * ray.v;
  const auto seen = [&](int i) {
    return seen_along(ray, lanes_from(s.groups[i].x), lanes_from(s.groups[i].y));
  };
  CornerSeen<EightLanes> before = seen(s.group_count - 1);
  for (int i = 0; i < s.group_count; ++i) {
    const CornerSeen<EightLanes> at = seen(i);
    const CornerSeen<EightLanes> from{lanes_before(before.x, at.x), lanes_before(before.y, at.y),
                                      lanes_before(before.along, at.along),
                                      lanes_before(before.side, at.side)};
    before = at;
    c.near +=
        __builtin_popcount(bits_of(__builtin_bit_cast(EightWords, absolute(at.side) <= close)));
    const EightWords left = __builtin_bit_cast(EightWords, at.side > 0);
    const EightLanes path =
        from.along + (at.along - from.along) * (from.side / (from.side - at.side));
    // Where the last corner occurs again, both ends of the edge are on one side.
    EightWords ahead = (left ^ __builtin_bit_cast(EightWords, from.side > 0)) &
                       __builtin_bit_cast(EightWords, path > 0);
    const EightLanes ux = at.x - from.x, uy = at.y - from.y;
    const EightLanes across = uy * from.x - ux * from.y;
    const EightWords far =
        __builtin_bit_cast(EightWords, across * across > 4 * tol * tol * (ux * ux + uy * uy));
    for (unsigned maybe = bits_of(ahead & ~far); maybe != 0; maybe &= maybe - 1) {
      const int lane = __builtin_ctz(maybe);
      if (starts_at_edge(s, 8 * i + lane, ray, tol)) ahead[lane] = 0;
    }
    const unsigned out = bits_of(ahead & left);
    c.total += __builtin_popcount(bits_of(ahead)) - 2 * __builtin_popcount(out);
    if constexpr (keep == Keep::all) {
      const EightLanes t = ahead != 0 ? path / length2 : eight_of(infinity<double>());
      __builtin_memcpy(c.t + 8 * i, &t, sizeof t);
      if (i % 8 == 0) c.out[i / 8] = 0;
      c.out[i / 8] |= static_cast<unsigned long long>(out) << 8 * (i % 8);
    }
  }
  return c;
}

/// The nearest crossing, combined with all others at the same path; infinitely far if there is
/// none.
template <class Real>
struct EdgeCrossing {
  Real t;
  int turn;  ///< entries less exits
};
template <class Real>
EdgeCrossing<Real> take_nearest(EdgesAhead<Real>& c) {
  EdgeCrossing<Real> nearest{infinity<Real>(), 0};
  for (int i = 0; i < c.count; ++i) nearest.t = smaller(c.t[i], nearest.t);
  if (!(nearest.t < infinity<Real>())) return nearest;
  for (int i = 0; i < c.count; ++i) {
    if (c.t[i] != nearest.t) continue;
    nearest.turn += (c.out[i / 64] >> i % 64 & 1) != 0 ? -1 : 1;
    c.t[i] = infinity<Real>();
  }
  return nearest;
}
inline EdgeCrossing<double> take_nearest(EdgesAhead<double>& c) {
  const auto lanes = [&c](int first) {
    EightLanes t;
    __builtin_memcpy(&t, c.t + first, sizeof t);
    return t;
  };
  EightLanes least = lanes(0);
  for (int i = 8; i < c.count; i += 8) least = lanes(i) < least ? lanes(i) : least;
  EdgeCrossing<double> nearest{-largest_lane(-least), 0};
  if (!(nearest.t < infinity<double>())) return nearest;
  for (int i = 0; i < c.count; i += 8) {
    const EightLanes t = lanes(i);
    const auto is_here = t == nearest.t;
    const unsigned here = bits_of(__builtin_bit_cast(EightWords, is_here));
    const unsigned out = here & static_cast<unsigned>(c.out[i / 64] >> i % 64);
    nearest.turn += __builtin_popcount(here) - 2 * __builtin_popcount(out);
    const EightLanes left = is_here ? eight_of(infinity<double>()) : t;
    __builtin_memcpy(c.t + i, &left, sizeof left);
  }
  return nearest;
}

/// A rough bound on the magnitude of `side` at both ends of an edge that the ray runs along.
template <class Real>
Real close_to(const PlanarRay<Real>& ray, Real tol) {
  return 4 * tol * (absolute(ray.u) + absolute(ray.v));
}

/// The crossings ahead, after the ray has been moved off an edge if it runs along one.
template <Keep keep, class Real>
EdgesAhead<Real> edges_ahead_inside(const Prism<Real>& s, const PlanarRay<Real>& ray, Real tol) {
  EdgesAhead<Real> c = edges_ahead<keep>(s, ray, tol, close_to(ray, tol));
  if (__builtin_expect(c.near >= 2, 0)) {
    c = edges_ahead<keep>(s, moved_inside(s, ray, tol), tol, Real(0));
  }
  return c;
}

/// Whether the polygon holds the start of the ray.
template <class Real>
bool holds_start(const Prism<Real>& s, const PlanarRay<Real>& ray, Real tol) {
  if (outside_box(s, ray.x, ray.y) > tol) return false;
  if (ray.parallel && edges_distance2(s, ray.x, ray.y) <= tol * tol) return true;
  return edges_ahead_inside<Keep::total>(s, ray, tol).total < 0;
}

/// Whether the polygon holds the point. This is told by a ray, for which edges within `tol` of the
/// point are behind.
template <class Real>
bool is_in_polygon(const Prism<Real>& s, Real x, Real y, Real tol = 0) {
  if (outside_box(s, x, y) > 0) return false;
  const PlanarRay<Real> any{x, y, Real(1), Real(0), false};
  return edges_ahead<Keep::total>(s, any, tol, Real(0)).total < 0;
}

template <class Real>
Side inside(const Prism<Real>& s, const Vec3<Real>& p, Real tol) {
  const Side along_z = worse(Side::inside, larger(p.z - s.z_high, s.z_low - p.z), tol);
  if (along_z == Side::outside || outside_box(s, p.x, p.y) > tol) return Side::outside;
  if (edges_distance2(s, p.x, p.y) <= tol * tol) return Side::surface;
  return is_in_polygon(s, p.x, p.y, tol) ? along_z : Side::outside;
}

template <class Real>
bool contains(const Prism<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (beyond_face(p.z - s.z_high, v.z, tol) || beyond_face(s.z_low - p.z, -v.z, tol)) return false;
  return holds_start(s, seen_along_z(p, v), tol);
}

/// The path to the first crossing ahead where the polygon ends; infinity if there is none.
template <class Real>
Real path_out_of_polygon(EdgesAhead<Real>& c) {
  int depth = -c.total;
  for (;;) {
    const EdgeCrossing<Real> next = take_nearest(c);
    depth += next.turn;
    if (depth <= 0 || !(next.t < infinity<Real>())) return next.t;
  }
}

/// The first path, at least `slab.enter` and before `slab.until`, where the ray is in the polygon.
template <class Real>
Real path_into_polygon(EdgesAhead<Real>& c, const Span<Real>& slab) {
  int depth = -c.total;
  Real begin = larger(slab.enter, Real(0));
  for (;;) {
    const EdgeCrossing<Real> next = take_nearest(c);
    if (depth > 0 && begin < next.t) return begin < slab.until ? begin : infinity<Real>();
    if (!(next.t < slab.until)) return infinity<Real>();
    begin = larger(next.t, begin);
    depth += next.turn;
  }
}

template <class Real>
Real distance_to_in(const Prism<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Span<Real> slab = slab_span(s.z_low, s.z_high, p, v, tol);
  if (!is_ahead(slab)) return infinity<Real>();
  const PlanarRay<Real> ray = seen_along_z(p, v);
  if (ray.parallel) {
    if (!holds_start(s, ray, tol)) return infinity<Real>();
    return starts_in(slab) ? distance_from_within(s, p, tol) : slab.enter;
  }
  EdgesAhead<Real> c = edges_ahead_inside<Keep::all>(s, ray, tol);
  if (c.total < 0 && outside_box(s, ray.x, ray.y) > tol) {
    // The ray runs along an edge and was moved into the solid. As it is it has to come to it first.
    clip_slab(slab, (s.x_high - s.x_low) / 2, p.x - (s.x_low + s.x_high) / 2, v.x, v.inverse_x,
              Real(0));
    clip_slab(slab, (s.y_high - s.y_low) / 2, p.y - (s.y_low + s.y_high) / 2, v.y, v.inverse_y,
              Real(0));
  } else if (c.total < 0 && starts_in(slab)) {
    return distance_from_within(s, p, tol);
  }
  return path_into_polygon(c, slab);
}

template <class Real>
Real distance_to_out(const Prism<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  Real leave = leave_face(p.z - s.z_high, v.z, tol, infinity<Real>());
  leave = leave_face(s.z_low - p.z, -v.z, tol, leave);
  if (!(leave > 0)) return Real(0);
  const PlanarRay<Real> ray = seen_along_z(p, v);
  if (ray.parallel) return holds_start(s, ray, tol) ? leave : Real(0);
  EdgesAhead<Real> c = edges_ahead_inside<Keep::all>(s, ray, tol);
  return c.total < 0 ? smaller(path_out_of_polygon(c), leave) : Real(0);
}

template <class Real>
Real safety_to_in(const Prism<Real>& s, const Vec3<Real>& p) {
  const Real z = larger(larger(s.z_low - p.z, p.z - s.z_high), Real(0));
  if (is_in_polygon(s, p.x, p.y)) return z;
  return square_root(edges_distance2(s, p.x, p.y) + z * z);
}
template <class Real>
Real safety_to_out(const Prism<Real>& s, const Vec3<Real>& p) {
  const Real z = smaller(s.z_high - p.z, p.z - s.z_low);
  if (!(z > 0) || !is_in_polygon(s, p.x, p.y)) return Real(0);
  return smaller(square_root(edges_distance2(s, p.x, p.y)), z);
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

/// The normal of the edge that is nearest to the point, or of an end if that is nearer.
template <class Real>
Vec3<Real> normal(const Prism<Real>& s, const Vec3<Real>& p, Real tol) {
  const NearestEdge<Real> near = nearest_edge(s, p.x, p.y);
  const Real off = square_root(near.distance2);
  const bool in = is_in_polygon(s, p.x, p.y);
  NearestFace<Real> best = no_face(tol);
  const Real middle = (s.z_low + s.z_high) / 2, half = (s.z_high - s.z_low) / 2;
  offer(best, absolute(p.z - middle) - half, Vec3<Real>{0, 0, with_sign(Real(1), p.z - middle)});
  const PlanarCorner<Real>&a = s.corners[near.edge == 0 ? s.count - 1 : near.edge - 1],
        &b = s.corners[near.edge];
  offer(best, in ? -off : off, unit_vector(Vec3<Real>{b.y - a.y, a.x - b.x, 0}));
  return best.normal;
}

}  // namespace navjit::kernels

// An upright prism: a polygon, convex or not, that does not cross itself, between two faces across
// z. Seen along z a ray crosses edges, each as often as its ends are on different sides of the ray:
// a corner counts the same for both of its edges, so that entries and exits always cancel and no
// ray is lost through a corner (as for `Facets`, of which this is the case in a plane).
//
// A crossing is behind the start if its path is not positive, or if the start is within the
// tolerance of its edge. What is not behind is ahead, and tells by itself whether the start is in
// the polygon: as many exits ahead as entries, or more.
namespace navjit::kernels {

template <class Real>
struct PlanarCorner {
  Real x, y;
};

/// Eight corners; where there are fewer, the last one more than once.
template <class Real>
struct CornerGroup {
  EightOf<Real> x, y;
};

template <class Real>
struct Prism {
  const PlanarCorner<Real>* corners;  ///< anticlockwise
  int count;
  const CornerGroup<Real>* groups;  ///< the same corners
  int group_count;
  Real z_low, z_high;
  Real x_low, x_high, y_low, y_high;  ///< the box around the polygon
};

template <>
inline constexpr bool uses_vectors<Prism<double>> = true;

/// The square of the distance of (x, y) from the edge that ends at corner i.
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

/// The number of the nearest edge, and the square of the distance from it.
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

/// The square of the distance from the nearest edge.
template <class Real>
Real edges_distance2(const Prism<Real>& s, Real x, Real y) {
  return nearest_edge(s, x, y).distance2;
}
/// The same, eight edges at once.
inline double edges_distance2(const Prism<double>& s, double x, double y) {
  constexpr EightLanes lane_numbers{0, 1, 2, 3, 4, 5, 6, 7};
  EightLanes nearest = eight_of(infinity<double>());
  // The corners before those of a group are its own and the last one of the group before.
  EightLanes x_before = lanes_from(s.groups[s.group_count - 1].x);
  EightLanes y_before = lanes_from(s.groups[s.group_count - 1].y);
  for (int i = 0; i < s.group_count; ++i) {
    const EightLanes bx = lanes_from(s.groups[i].x), by = lanes_from(s.groups[i].y);
    const EightLanes ax = __builtin_shufflevector(x_before, bx, 7, 8, 9, 10, 11, 12, 13, 14);
    const EightLanes ay = __builtin_shufflevector(y_before, by, 7, 8, 9, 10, 11, 12, 13, 14);
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

/// The edge that ends at corner i, if the ray runs along it, within the tolerance of it: there it
/// is in the solid.
template <class Real>
bool runs_along(const Prism<Real>& s, int i, const PlanarRay<Real>& ray, Real tol) {
  const PlanarCorner<Real>&a = s.corners[i == 0 ? s.count - 1 : i - 1], &b = s.corners[i];
  const Real ux = b.x - a.x, uy = b.y - a.y, length = square_root(ux * ux + uy * uy);
  if (!is_along((uy * ray.u - ux * ray.v) / length)) return false;
  return absolute(ux * (ray.y - a.y) - uy * (ray.x - a.x)) <= tol * length;
}

/// For a ray along an edge: the same ray moved into the solid, clear of the tolerance.
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

/// What has more corners is no prism, but facets.
constexpr int most_corners_of_prism = 128;

/// On which side of a ray a polygon's corners are. Which edges cross it no processor foresees, so
/// that is told for all of them first, without branches; few do.
template <class Real>
struct CornerSides {
  static constexpr int in_word = 64;
  Real of[most_corners_of_prism];
  /// Bit i, from word to word: corner i is to the left of the ray.
  unsigned long long left[most_corners_of_prism / in_word];
  int near = 0;  ///< how many are nearly on it

  CornerSides(const Prism<Real>& s, const PlanarRay<Real>& ray, Real close) {
    tell_sides(*this, s, ray, close);
  }
};

template <class Real>
void tell_sides(CornerSides<Real>& sides, const Prism<Real>& s, const PlanarRay<Real>& ray,
                Real close) {
  constexpr int in_word = CornerSides<Real>::in_word;
  for (int first = 0; first < s.count; first += in_word) {
    const int end = s.count - first < in_word ? s.count : first + in_word;
    unsigned long long word = 0;
    for (int i = first; i < end; ++i) {
      const Real side = ray.u * (s.corners[i].y - ray.y) - ray.v * (s.corners[i].x - ray.x);
      sides.of[i] = side;
      word |= static_cast<unsigned long long>(side > 0) << (i - first);
      sides.near += absolute(side) <= close ? 1 : 0;
    }
    sides.left[first / in_word] = word;
  }
}
/// The same, eight corners at once.
inline void tell_sides(CornerSides<double>& sides, const Prism<double>& s,
                       const PlanarRay<double>& ray, double close) {
  constexpr int groups_in_word = CornerSides<double>::in_word / 8;
  for (int first = 0; first < s.group_count; first += groups_in_word) {
    unsigned long long left = 0;
    for (int i = first; i < s.group_count && i < first + groups_in_word; ++i) {
      const CornerGroup<double>& at = s.groups[i];
      const EightLanes side =
          ray.u * (lanes_from(at.y) - ray.y) - ray.v * (lanes_from(at.x) - ray.x);
      __builtin_memcpy(sides.of + 8 * i, &side, sizeof side);
      left |= static_cast<unsigned long long>(bits_of(__builtin_bit_cast(EightWords, side > 0)))
              << 8 * (i - first);
      const unsigned near = bits_of(__builtin_bit_cast(EightWords, absolute(side) <= close));
      const int corners = s.count - 8 * i;
      sides.near += __builtin_popcount(corners < 8 ? near & ((1U << corners) - 1) : near);
    }
    sides.left[first / groups_in_word] = left;
  }
}

/// The crossings ahead, kept from the path `from` on, as crossings_ahead has them for facets.
template <class Real>
Crossings<Real> edges_ahead(const Prism<Real>& s, const PlanarRay<Real>& ray, Real tol, Real from,
                            const CornerSides<Real>& sides) {
  Crossings<Real> c;
  c.total = 0;
  c.count = 0;
  c.beyond = infinity<Real>();
  const Real length2 = ray.u * ray.u + ray.v * ray.v;
  const auto along = [&](int corner) {
    const PlanarCorner<Real>& at = s.corners[corner];
    return ray.u * (at.x - ray.x) + ray.v * (at.y - ray.y);
  };
  const int last = s.count - 1;
  constexpr int in_word = CornerSides<Real>::in_word;
  unsigned long long before_first = sides.left[last / in_word] >> (last % in_word) & 1;
  for (int first = 0; first < s.count; first += in_word) {
    const unsigned long long left = sides.left[first / in_word];
    unsigned long long crossing = left ^ (left << 1 | before_first);
    before_first = left >> (in_word - 1);
    if (s.count - first < in_word) crossing &= ~0ULL >> (in_word - (s.count - first));
    for (; crossing != 0; crossing &= crossing - 1) {
      const int edge = first + __builtin_ctzll(crossing), before = edge == 0 ? last : edge - 1;
      const Real side = sides.of[edge], side_before = sides.of[before];
      const Real begin = along(before), end = along(edge);
      const Real path = begin + (end - begin) * (side_before / (side_before - side));
      if (path > 0 && edge_distance2(s, edge, ray.x, ray.y) > tol * tol) {
        // Leftwards of the ray: what is inside lies behind the edge.
        const int turn = side > 0 ? -1 : 1;
        c.total += turn;
        const Real t = path / length2;
        if (t >= from) keep_crossing(c, t, turn);
      }
    }
  }
  return c;
}
template <class Real>
Crossings<Real> edges_ahead(const Prism<Real>& s, const PlanarRay<Real>& ray, Real tol, Real from) {
  return edges_ahead(s, ray, tol, from, CornerSides<Real>(s, ray, Real(0)));
}

/// Both ends of an edge that the ray runs along are within this of its line, roughly.
template <class Real>
Real close_to(const PlanarRay<Real>& ray, Real tol) {
  return 4 * tol * (absolute(ray.u) + absolute(ray.v));
}

/// The same after the ray has been moved off an edge that it runs along.
template <class Real>
Crossings<Real> edges_ahead_inside(const Prism<Real>& s, PlanarRay<Real>& ray, Real tol,
                                   Real from) {
  const CornerSides<Real> sides(s, ray, close_to(ray, tol));
  if (__builtin_expect(sides.near < 2, 1)) return edges_ahead(s, ray, tol, from, sides);
  ray = moved_inside(s, ray, tol);
  return edges_ahead(s, ray, tol, from);
}

/// Whether the polygon holds the start of the ray.
template <class Real>
bool holds_start(const Prism<Real>& s, const PlanarRay<Real>& ray, Real tol) {
  if (outside_box(s, ray.x, ray.y) > tol) return false;
  if (ray.parallel && edges_distance2(s, ray.x, ray.y) <= tol * tol) return true;
  PlanarRay<Real> clear = ray;
  return edges_ahead_inside(s, clear, tol, infinity<Real>()).total < 0;
}

template <class Real>
Side inside(const Prism<Real>& s, const Vec3<Real>& p, Real tol) {
  const Side along_z = worse(Side::inside, larger(p.z - s.z_high, s.z_low - p.z), tol);
  if (along_z == Side::outside || outside_box(s, p.x, p.y) > tol) return Side::outside;
  if (edges_distance2(s, p.x, p.y) <= tol * tol) return Side::surface;
  const PlanarRay<Real> any{p.x, p.y, Real(1), Real(0), false};
  return edges_ahead(s, any, tol, infinity<Real>()).total < 0 ? along_z : Side::outside;
}

template <class Real>
bool contains(const Prism<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (beyond_face(p.z - s.z_high, v.z, tol) || beyond_face(s.z_low - p.z, -v.z, tol)) return false;
  return holds_start(s, seen_along_z(p, v), tol);
}

/// The path to the first crossing ahead where the polygon ends; infinity if it does not.
template <class Real>
Real path_out_of_polygon(const Prism<Real>& s, const PlanarRay<Real>& ray, Real tol,
                         Crossings<Real> c) {
  int depth = -c.total;
  for (;;) {
    for (int i = 0; i < c.count; ++i) {
      depth += c.turn[i];
      if (depth <= 0) return c.t[i];
    }
    if (!(c.beyond < infinity<Real>())) return infinity<Real>();
    c = edges_ahead(s, ray, tol, c.beyond);
  }
}

/// The first path, `slab.enter` or more and before `slab.until`, where the ray is in the polygon.
template <class Real>
Real path_into_polygon(const Prism<Real>& s, const PlanarRay<Real>& ray, Real tol,
                       Crossings<Real> c, const Span<Real>& slab) {
  int depth = -c.total;
  Real begin = larger(slab.enter, Real(0));
  for (;;) {
    for (int i = 0; i < c.count; ++i) {
      if (depth > 0 && begin < c.t[i]) return begin < slab.until ? begin : infinity<Real>();
      begin = larger(c.t[i], begin);
      depth += c.turn[i];
    }
    if (!(c.beyond < infinity<Real>())) break;
    c = edges_ahead(s, ray, tol, c.beyond);
  }
  return depth > 0 && begin < slab.until ? begin : infinity<Real>();
}

template <class Real>
Real distance_to_in(const Prism<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Span<Real> slab = slab_span(s.z_low, s.z_high, p, v, tol);
  if (!is_ahead(slab)) return infinity<Real>();
  const PlanarRay<Real> seen = seen_along_z(p, v);
  if (seen.parallel) {
    if (!holds_start(s, seen, tol)) return infinity<Real>();
    return starts_in(slab) ? distance_from_within(s, p, tol) : slab.enter;
  }
  PlanarRay<Real> ray = seen;
  const Crossings<Real> c = edges_ahead_inside(s, ray, tol, Real(0));
  if (c.total < 0 && starts_in(slab) && !(outside_box(s, seen.x, seen.y) > tol)) {
    return distance_from_within(s, p, tol);
  }
  return path_into_polygon(s, ray, tol, c, slab);
}

template <class Real>
Real distance_to_out(const Prism<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  Real leave = leave_face(p.z - s.z_high, v.z, tol, infinity<Real>());
  leave = leave_face(s.z_low - p.z, -v.z, tol, leave);
  if (!(leave > 0)) return Real(0);
  const PlanarRay<Real> seen = seen_along_z(p, v);
  if (seen.parallel) return holds_start(s, seen, tol) ? leave : Real(0);
  PlanarRay<Real> ray = seen;
  const Crossings<Real> c = edges_ahead_inside(s, ray, tol, Real(0));
  return c.total < 0 ? smaller(path_out_of_polygon(s, ray, tol, c), leave) : Real(0);
}

/// Whether the polygon holds the point, without any tolerance.
template <class Real>
bool is_in_polygon(const Prism<Real>& s, Real x, Real y) {
  if (outside_box(s, x, y) > 0) return false;
  return edges_ahead(s, PlanarRay<Real>{x, y, Real(1), Real(0), false}, Real(0), infinity<Real>())
             .total < 0;
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

/// The edge that the point is nearest to, or an end if that is nearer.
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

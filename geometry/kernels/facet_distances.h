// How far a point is from the triangles of a mesh.
namespace navjit::kernels {

template <class Real>
constexpr Vec3<Real> difference(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
constexpr Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The squared distance to the segment from a to a + u, for a point at a + w.
template <class Real>
Real segment_distance2(const Vec3<Real>& u, const Vec3<Real>& w) {
  const Real length2 = dot(u, u), along = dot(u, w);
  const Real k = along > 0 && length2 > 0 ? smaller(along / length2, Real(1)) : Real(0);
  const Vec3<Real> off{w.x - k * u.x, w.y - k * u.y, w.z - k * u.z};
  return dot(off, off);
}

/// A bound above the square of the rounding error of a triple product. For the normal of a sliver
/// and a vector, the triple product is mostly rounding error.
template <class Real>
constexpr Real triple_rounding(const Vec3<Real>& u, const Vec3<Real>& v, const Vec3<Real>& w) {
  return Real(1e-28) * dot(u, u) * dot(v, v) * dot(w, w);
}

/// The part of a triangle or of the surface that is nearest to a point.
template <class Real>
struct NearestFacet {
  Real distance2;  ///< the squared distance, mm^2
  int side;  ///< of the facet that it is within: 1 outside, -1 inside; 0 on an edge, or if unclear
};

/// The nearest part of a triangle. If the triangle's plane alone is farther away than `limit`, a
/// squared distance, the result may be infinitely far.
template <class Real>
NearestFacet<Real> nearest_in_facet(const Facets<Real>& s, const Facet& f, const Vec3<Real>& p,
                                    Real limit) {
  const Vec3<Real>&a = s.corners[f.a], &b = s.corners[f.b], &c = s.corners[f.c];
  const Vec3<Real> u = difference(b, a), v = difference(c, b), w = difference(a, c);
  const Vec3<Real> from_a = difference(p, a), from_b = difference(p, b), from_c = difference(p, c);
  const Vec3<Real> n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const Real n2 = dot(n, n), h = dot(n, from_a), rounding = 16 * triple_rounding(u, v, from_a);
  if (h * h > Real(1.0001) * limit * n2 + rounding) return {infinity<Real>(), 0};
  // Whether a point is to the left of an edge: the sign of the triple product of the edge, the way
  // from its start, and the normal.
  const auto left = [&n](const Vec3<Real>& edge, const Vec3<Real>& way) {
    return (edge.y * way.z - edge.z * way.y) * n.x + (edge.z * way.x - edge.x * way.z) * n.y +
               (edge.x * way.y - edge.y * way.x) * n.z >=
           0;
  };
  if (n2 > 0 && left(u, from_a) && left(v, from_b) && left(w, from_c)) {
    return {h * h / n2, !(h * h > rounding) ? 0 : h > 0 ? 1 : -1};
  }
  Real least = segment_distance2(u, from_a);
  least = smaller(segment_distance2(v, from_b), least);
  return {smaller(segment_distance2(w, from_c), least), 0};
}

/// The squared distance to a triangle.
template <class Real>
Real facet_distance2(const Facets<Real>& s, const Facet& f, const Vec3<Real>& p) {
  return nearest_in_facet(s, f, p, infinity<Real>()).distance2;
}

/// Is the point within `tol` of the triangle?
template <class Real>
bool touches_facet(const Facets<Real>& s, const Facet& f, const Vec3<Real>& p, Real tol) {
  // Nearly always the triangle's plane is farther away than the tolerance by much more than the
  // rounding of a sliver's normal.
  const Vec3<Real>& a = s.corners[f.a];
  const Vec3<Real> u = difference(s.corners[f.b], a), v = difference(s.corners[f.c], a),
                   w = difference(p, a);
  const Vec3<Real> n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const Real h = dot(n, w);
  if (h * h > 16 * (tol * tol * dot(n, n) + triple_rounding(u, v, w))) return false;
  return facet_distance2(s, f, p) <= tol * tol;
}

template <class Real>
Real box_distance2(const FacetBox<Real>& b, const Vec3<Real>& p) {
  const Real x = larger(larger(b.x_low - p.x, p.x - b.x_high), Real(0));
  const Real y = larger(larger(b.y_low - p.y, p.y - b.y_high), Real(0));
  const Real z = larger(larger(b.z_low - p.z, p.z - b.z_high), Real(0));
  return x * x + y * y + z * z;
}

/// If two facets are equally near, only a side on which both agree is kept.
template <class Real>
void take_nearer(NearestFacet<Real>& nearest, const NearestFacet<Real>& facet) {
  if (facet.distance2 < nearest.distance2) {
    nearest = facet;
  } else if (facet.distance2 == nearest.distance2 && facet.side != nearest.side) {
    nearest.side = 0;
  }
}

/// The nearest part of the surface, with the distance `limit`, which is squared, if nothing is
/// nearer. Of two boxes the nearer one comes first: what it holds usually excludes the other.
template <class Real>
NearestFacet<Real> nearest_in_surface(const Facets<Real>& s, const Vec3<Real>& p, Real limit) {
  struct Waiting {
    int box;
    Real distance2;
  };
  Waiting waiting[most_facet_levels];  // at most one of each level above
  int count = 0;
  Waiting at{0, box_distance2(s.boxes[0], p)};
  NearestFacet<Real> nearest{limit, 0};
  for (;;) {
    if (at.distance2 < nearest.distance2) {
      const FacetBox<Real>& box = s.boxes[at.box];
      if (box.count == 0) {
        const int second = s.boxes[at.box + 1].next;
        Waiting near{at.box + 1, box_distance2(s.boxes[at.box + 1], p)};
        Waiting far{second, box_distance2(s.boxes[second], p)};
        if (far.distance2 < near.distance2) {
          const Waiting other = near;
          near = far;
          far = other;
        }
        if (far.distance2 < nearest.distance2) waiting[count++] = far;
        at = near;
        continue;
      }
      for (int k = box.first; k < box.first + box.count; ++k) {
        take_nearer(nearest, nearest_in_facet(s, s.facets[k], p, nearest.distance2));
      }
    }
    if (count == 0) return nearest;
    at = waiting[--count];
  }
}

/// The squared distance to the surface, or `limit` if that is smaller.
template <class Real>
Real surface_distance2(const Facets<Real>& s, const Vec3<Real>& p, Real limit) {
  return nearest_in_surface(s, p, limit).distance2;
}

}  // namespace navjit::kernels

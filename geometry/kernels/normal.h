// Outward unit normals of the primitives: normal(s, p, tol) at a point on the surface of a solid,
// in its own frame (docs/normals.md). Needed where a track is reflected or refracted, and by no
// navigator.
//
// The face is the one that the point is furthest beyond, or, within the solid, nearest to; of those
// that are so to within the tolerance, the first in the order in which they are offered here. So a
// point on an edge gets the same face whatever the last bit of its coordinates. Where a face has no
// normal, on the axis of a round one, x is the direction that is taken for radial.
namespace navjit::kernels {

/// The best of the faces that have been offered.
template <class Real>
struct NearestFace {
  Real beyond;  ///< signed distance of the point
  Vec3<Real> normal;
  Real tol;
};
template <class Real>
constexpr NearestFace<Real> no_face(Real tol) {
  return {-infinity<Real>(), {0, 0, 1}, tol};
}
template <class Real>
constexpr void offer(NearestFace<Real>& best, Real beyond, const Vec3<Real>& normal) {
  if (!(beyond > best.beyond + best.tol)) return;
  best.beyond = beyond;
  best.normal = normal;
}

/// The vector times what makes it of unit length; along z if it has none.
template <class Real>
Vec3<Real> unit_vector(const Vec3<Real>& v) {
  const Real most = larger(absolute(v.x), larger(absolute(v.y), absolute(v.z)));
  if (!(most > 0)) return {0, 0, 1};
  const Real x = v.x / most, y = v.y / most, z = v.z / most;
  const Real length = square_root(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}
template <class Real>
constexpr Vec3<Real> turned_over(const Vec3<Real>& v) {
  return {-v.x, -v.y, -v.z};
}

/// Away from the z axis, and how far from it the point is.
template <class Real>
struct Radial {
  Real x, y, rho;
};
template <class Real>
Radial<Real> radial_at(const Vec3<Real>& p) {
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  if (!(rho > 0)) return {1, 0, rho};
  return {p.x / rho, p.y / rho, rho};
}

template <class Real>
constexpr void offer_ends(NearestFace<Real>& best, Real z_low, Real z_high, Real z) {
  offer(best, z - z_high, Vec3<Real>{0, 0, 1});
  offer(best, z_low - z, Vec3<Real>{0, 0, -1});
}
template <class Real>
constexpr void offer_plane(NearestFace<Real>& best, const Plane<Real>& f, const Vec3<Real>& p) {
  offer(best, plane_distance(f, p), Vec3<Real>{f.a, f.b, f.c});
}

// --- Flat faces -------------------------------------------------------------------------------

template <class Real>
Vec3<Real> normal(const Box<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer(best, absolute(p.x) - s.hx, Vec3<Real>{with_sign(Real(1), p.x), 0, 0});
  offer(best, absolute(p.y) - s.hy, Vec3<Real>{0, with_sign(Real(1), p.y), 0});
  offer(best, absolute(p.z) - s.hz, Vec3<Real>{0, 0, with_sign(Real(1), p.z)});
  return best.normal;
}

template <class Real>
Vec3<Real> normal(const Trd<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer(best, absolute(p.z) - s.hz, Vec3<Real>{0, 0, with_sign(Real(1), p.z)});
  offer(best, pair_distance(s.x, p.x, p.z), Vec3<Real>{with_sign(s.x.across, p.x), 0, s.x.along});
  offer(best, pair_distance(s.y, p.y, p.z), Vec3<Real>{0, with_sign(s.y.across, p.y), s.y.along});
  return best.normal;
}

template <class Real>
Vec3<Real> normal(const Trap<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer(best, absolute(p.z) - s.hz, Vec3<Real>{0, 0, with_sign(Real(1), p.z)});
  offer_plane(best, s.y_minus, p);
  offer_plane(best, s.y_plus, p);
  offer_plane(best, s.x_minus, p);
  offer_plane(best, s.x_plus, p);
  return best.normal;
}

template <class Real>
Vec3<Real> normal(const Hull<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  for (int i = 0; i < s.count; ++i) offer_plane(best, s.planes[i], p);
  return best.normal;
}

/// The facet that the point is nearest to; of those that are so to within the tolerance the
/// largest, since a sliver's normal means little.
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

// --- Round faces ------------------------------------------------------------------------------

/// The side of the wedge that counts for the point. The outward normals are the same whether
/// the wedge is less than half a turn or more.
template <class Real>
NearestFace<Real> wedge_face(const Wedge<Real>& w, const Vec3<Real>& p, Real tol) {
  if (w.kind == 0) return no_face(tol);
  const WedgeForm<Real> at = wedge_form(w, p.x, p.y);
  const Vec3<Real> start{w.start_y, -w.start_x, 0}, end{-w.end_y, w.end_x, 0};
  return {wedge_distance(w, p.x, p.y), at.second > at.first + tol ? end : start, tol};
}
template <class Real>
void offer_wedge(NearestFace<Real>& best, const Wedge<Real>& w, const Vec3<Real>& p) {
  const NearestFace<Real> side = wedge_face(w, p, best.tol);
  if (w.kind != 0) offer(best, side.beyond, side.normal);
}

/// A tube's outer and inner face and its wedge.
template <class Real>
void offer_cylinders(NearestFace<Real>& best, Real rmin, Real rmax, const Wedge<Real>& w,
                     const Vec3<Real>& p) {
  const Radial<Real> r = radial_at(p);
  offer(best, r.rho - rmax, Vec3<Real>{r.x, r.y, 0});
  if (rmin > 0) offer(best, rmin - r.rho, Vec3<Real>{-r.x, -r.y, 0});
  offer_wedge(best, w, p);
}

template <class Real>
Vec3<Real> normal(const Tube<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, -s.hz, s.hz, p.z);
  offer_cylinders(best, s.rmin, s.rmax, s.wedge, p);
  return best.normal;
}

template <class Real>
Vec3<Real> normal(const CutTube<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_plane(best, s.high, p);
  offer_plane(best, s.low, p);
  offer_cylinders(best, s.rmin, s.rmax, s.wedge, p);
  return best.normal;
}

template <class Real>
constexpr Vec3<Real> conical_normal(const ConicalFace<Real>& f, const Radial<Real>& r) {
  return {f.cosine * r.x, f.cosine * r.y, -f.slope};
}
template <class Real>
void offer_nappe(NearestFace<Real>& best, const ConicalFace<Real>& f, bool hole,
                 const Vec3<Real>& p, const Radial<Real>& r) {
  const Real beyond = cone_distance(f, r.rho, p.z);
  const Vec3<Real> n = conical_normal(f, r);
  offer(best, hole ? -beyond : beyond, hole ? turned_over(n) : n);
}

template <class Real>
Vec3<Real> normal(const Cone<Real>& s, const Vec3<Real>& p, Real tol) {
  const Radial<Real> r = radial_at(p);
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, -s.hz, s.hz, p.z);
  offer_nappe(best, s.outer, false, p, r);
  if (s.bored != 0) offer_nappe(best, s.inner, true, p, r);
  offer_wedge(best, s.wedge, p);
  return best.normal;
}

template <class Real>
Vec3<Real> normal(const Orb<Real>&, const Vec3<Real>& p, Real) {
  return unit_vector(p);
}

template <class Real>
Vec3<Real> normal(const Sphere<Real>& s, const Vec3<Real>& p, Real tol) {
  const Radial<Real> r = radial_at(p);
  const Vec3<Real> away = unit_vector(p);
  NearestFace<Real> best = no_face(tol);
  offer(best, length(p) - s.rmax, away);
  if (s.rmin > 0) offer(best, s.rmin - length(p), turned_over(away));
  offer_wedge(best, s.wedge, p);
  for (const PolarLimit<Real>* limit : {&s.low, &s.high}) {
    if (limit->kind != 0) offer_nappe(best, limit->face, limit->kind == 2, p, r);
  }
  return best.normal;
}

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

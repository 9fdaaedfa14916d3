// A polyhedra: prisms and pyramids with regularly spaced flat sides, stacked along z, possibly cut
// to an azimuthal segment. Radii are the distances of the sides from the axis.
namespace navjit::kernels {

/// Outward unit normal of a side, across z.
template <class Real>
struct SideNormal {
  Real x, y;
};

/// The normals of eight sides. Where fewer are left, some occur more than once.
template <class Real>
struct SideGroup {
  EightOf<Real> x, y;
};

template <class Real>
struct Polyhedra {
  const Section<Real>* sections;  ///< in ascending z; those over the same z are disjoint rings
  int count;
  const Ledge<Real>* ledges;
  int ledge_count;
  Real z_low, z_high;  ///< the ends, mm
  Real rmax;           ///< largest distance of an edge from the axis, mm
  Wedge<Real> wedge;
  const SideNormal<Real>* sides;  ///< the inside of an outer or inner face is behind all of them
  int side_count;
  const SideGroup<Real>* groups;  ///< the same sides, in groups of eight
  int group_count;
};

template <>
inline constexpr bool uses_vectors<Polyhedra<double>> = true;

// If a point is beyond any side, it is beyond the side whose sector it is in. Over any azimuthal
// segment the inside of an outer or inner face is therefore the convex intersection of the
// half-spaces behind the sides, cut by the wedge.

template <class Real>
Span<Real> face_span(const Polyhedra<Real>& s, const ConicalFace<Real>& f, const Vec3<Real>& p,
                     const Direction<Real>& v, Real tol) {
  Span<Real> span = whole_ray<Real>();
  const Real radius = f.radius + f.slope * p.z, rate = f.slope * v.z;
  for (int i = 0; i < s.side_count && is_ahead(span); ++i) {
    const SideNormal<Real>& n = s.sides[i];
    clip_face(span, f.cosine * (n.x * p.x + n.y * p.y) - radius,
              f.cosine * (n.x * v.x + n.y * v.y) - rate, tol);
  }
  return span;
}
/// Eight sides of a face, seen from a ray.
inline FaceLanes<EightLanes> faces_of(const SideGroup<double>& g, const ConicalFace<double>& f,
                                      const Vec3<double>& p, const Direction<double>& v) {
  const EightLanes x = lanes_from(g.x), y = lanes_from(g.y);
  return {f.cosine * (x * p.x + y * p.y) - (f.radius + f.slope * p.z),
          f.cosine * (x * v.x + y * v.y) - f.slope * v.z};
}
/// The span for double, eight sides at once.
inline Span<double> face_span(const Polyhedra<double>& s, const ConicalFace<double>& f,
                              const Vec3<double>& p, const Direction<double>& v, double tol) {
  FaceSpans<EightLanes> spans;
  for (int i = 0; i < s.group_count; ++i) {
    const FaceLanes<EightLanes> faces = faces_of(s.groups[i], f, p, v);
    if (passes_any(faces, tol)) return no_span<double>();
    spans.clip(faces, tol);
  }
  return spans.span();
}

/// The largest product of a side's normal and a point, which is that of the side whose sector the
/// point is in.
template <class Real>
Real largest_across(const Polyhedra<Real>& s, const Vec3<Real>& p) {
  Real across = -infinity<Real>();
  for (int i = 0; i < s.side_count; ++i) {
    across = larger(s.sides[i].x * p.x + s.sides[i].y * p.y, across);
  }
  return across;
}
inline double largest_across(const Polyhedra<double>& s, const Vec3<double>& p) {
  EightLanes across = eight_of(-infinity<double>());
  for (int i = 0; i < s.group_count; ++i) {
    const EightLanes of_side = lanes_from(s.groups[i].x) * p.x + lanes_from(s.groups[i].y) * p.y;
    across = of_side > across ? of_side : across;
  }
  return largest_lane(across);
}

template <class Real>
bool in_face(const Polyhedra<Real>& s, const ConicalFace<Real>& f, const Vec3<Real>& p,
             const Direction<Real>& v, Real tol) {
  const Real radius = f.radius + f.slope * p.z, rate = f.slope * v.z;
  for (int i = 0; i < s.side_count; ++i) {
    const SideNormal<Real>& n = s.sides[i];
    if (beyond_face(f.cosine * (n.x * p.x + n.y * p.y) - radius,
                    f.cosine * (n.x * v.x + n.y * v.y) - rate, tol)) {
      return false;
    }
  }
  return true;
}
inline bool in_face(const Polyhedra<double>& s, const ConicalFace<double>& f, const Vec3<double>& p,
                    const Direction<double>& v, double tol) {
  for (int i = 0; i < s.group_count; ++i) {
    if (beyond_any(faces_of(s.groups[i], f, p, v), tol)) return false;
  }
  return true;
}
/// Takes one quotient for each side, where face_span takes two.
inline double face_leave(const Polyhedra<double>& s, const ConicalFace<double>& f,
                         const Vec3<double>& p, const Direction<double>& v, double tol) {
  FaceExits<EightLanes> exits;
  for (int i = 0; i < s.group_count; ++i) {
    const FaceLanes<EightLanes> faces = faces_of(s.groups[i], f, p, v);
    if (beyond_any(faces, tol)) return -1;
    exits.leave(faces, tol);
  }
  return exits.path();
}
/// The distance to the side that the point is furthest beyond, or nearest to from within. It does
/// not need `rho`.
template <class Real>
Real face_distance(const Polyhedra<Real>& s, const ConicalFace<Real>& f, const Vec3<Real>& p,
                   Real) {
  return f.cosine * largest_across(s, p) - f.slope * p.z - f.radius;
}

template <class Real>
Side inside(const Polyhedra<Real>& s, const Vec3<Real>& p, Real tol) {
  return sections_inside(s, p, tol);
}
template <class Real>
bool contains(const Polyhedra<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return sections_contains(s, p, v, tol);
}
template <class Real>
Real distance_to_in(const Polyhedra<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  return sections_distance_to_in(s, p, v, tol);
}
template <class Real>
Real distance_to_out(const Polyhedra<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return sections_distance_to_out(s, p, v, tol);
}
template <class Real>
Real safety_to_in(const Polyhedra<Real>& s, const Vec3<Real>& p) {
  return sections_safety_to_in(s, p);
}
template <class Real>
Real safety_to_out(const Polyhedra<Real>& s, const Vec3<Real>& p) {
  return sections_safety_to_out(s, p);
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

/// The normal of the side whose distance is face_distance.
template <class Real>
Vec3<Real> face_normal(const Polyhedra<Real>& s, const ConicalFace<Real>& f, const Vec3<Real>& p,
                       Real tol) {
  NearestFace<Real> best = no_face(tol);
  for (int i = 0; i < s.side_count; ++i) {
    const SideNormal<Real>& n = s.sides[i];
    offer(best, n.x * p.x + n.y * p.y, Vec3<Real>{f.cosine * n.x, f.cosine * n.y, -f.slope});
  }
  return best.normal;
}
template <class Real>
Vec3<Real> normal(const Polyhedra<Real>& s, const Vec3<Real>& p, Real tol) {
  return sections_normal(s, p, tol);
}

}  // namespace navjit::kernels

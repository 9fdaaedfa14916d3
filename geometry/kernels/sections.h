// Solids made of sections along z, which polycones and polyhedra have in common. Over each section
// the solid is a ring between an outer and an inner face, and the ring is continued or stepped from
// one section to the next. The two solids differ in what a face is. Each provides for its faces:
//   face_span, in_face  as cone_span and in_cone
//   face_distance       a signed distance, in magnitude a lower bound
//   face_normal         the outward unit normal
// Sections are searched in the order in which the ray meets them. The path to a plane between two
// sections has the same bits from either side, so nothing is lost at a seam, and a seam is no
// surface where both sections continue.
namespace navjit::kernels {

template <class Real>
struct Section {
  Real z_low, z_high;              ///< mm
  ConicalFace<Real> outer, inner;  ///< z from z_low
  int bored;  ///< 0: no inner face; 1: an inner face; 2: one that is nowhere near the outer face
};

/// A part of a plane across z where the solid ends: the end caps, and the steps between sections.
template <class Real>
struct Ledge {
  Real z, rmin, rmax;  ///< mm
};

/// The path to where a ray that starts in a face leaves it; -1 if the ray does not start there.
template <class Sections, class Real>
[[gnu::always_inline]] inline Real face_leave(const Sections& s, const ConicalFace<Real>& f,
                                              const Vec3<Real>& p, const Direction<Real>& v,
                                              Real tol) {
  const Span<Real> span = face_span(s, f, p, v, tol);
  return is_ahead(span) && starts_in(span) ? span.leave : Real(-1);
}

/// The paths between which a ray is over a section, in z. Empty unless from < to.
template <class Real>
struct SectionRange {
  Real from, to;
};
/// Within the tolerance of a plane the direction decides, in the same way for the sections on both
/// of its sides. A ray along the plane is in both.
template <class Real>
[[gnu::always_inline]] inline SectionRange<Real> section_range(const Section<Real>& section,
                                                               const Vec3<Real>& p,
                                                               const Direction<Real>& v, Real tol) {
  if (is_along(v.z)) {
    const bool in = (section.z_low - p.z <= tol) & (p.z - section.z_high <= tol);
    return {Real(0), in ? infinity<Real>() : Real(0)};
  }
  const Real to_low = section.z_low - p.z, to_high = section.z_high - p.z;
  const Real before = v.z < 0 ? -to_high : to_low, depth = v.z < 0 ? -to_low : to_high;
  const Real rate = absolute(v.inverse_z);
  return {before > tol ? before * rate : Real(0), depth > tol ? depth * rate : Real(0)};
}

/// How many sections end below a point; these are the first ones. 0 if there are only a few
/// sections, as then all are asked.
template <class Real>
int sections_below(const Section<Real>* sections, int count, const Vec3<Real>& p, Real tol) {
  constexpr int few = 4;
  int first = 0;
  for (int left = count <= few ? 0 : count; left > 0;) {
    const int half = left / 2;
    const bool is_below = p.z - sections[first + half].z_high > tol;
    first += is_below ? half + 1 : 0;
    left = is_below ? left - half - 1 : half;
  }
  return first;
}

template <class Real>
constexpr Vec3<Real> from_section(const Section<Real>& section, const Vec3<Real>& p) {
  return {p.x, p.y, p.z - section.z_low};
}

/// Signed distance to the ring of one section, as if the ring were infinite in z; in magnitude a
/// lower bound.
template <class Sections, class Real>
Real ring_distance(const Sections& s, const Section<Real>& section, const Vec3<Real>& q, Real rho) {
  Real beyond = face_distance(s, section.outer, q, rho);
  if (section.bored != 0) beyond = larger(-face_distance(s, section.inner, q, rho), beyond);
  return beyond;
}

/// Where a point is. Near a plane the sections on both sides of it are asked.
template <class Sections, class Real>
Side sections_inside(const Sections& s, const Vec3<Real>& p, Real tol) {
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  Side below = Side::outside, above = Side::outside;
  for (int i = 0; i < s.count; ++i) {
    const Section<Real>& section = s.sections[i];
    const Real over_low = p.z - section.z_low, under_high = section.z_high - p.z;
    if (over_low < -tol || under_high < -tol) continue;
    const Side side =
        worse(Side::inside, ring_distance(s, section, from_section(section, p), rho), tol);
    if (over_low > tol && side > below) below = side;
    if (under_high > tol && side > above) above = side;
  }
  Side side = below == above ? below : Side::surface;
  if (s.wedge.kind != 0) side = worse(side, wedge_distance(s.wedge, p.x, p.y), tol);
  return side;
}

template <class Sections, class Real>
bool sections_contains(const Sections& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (!in_wedge(s.wedge, p, v, tol)) return false;
  for (int i = sections_below(s.sections, s.count, p, tol); i < s.count; ++i) {
    const Section<Real>& section = s.sections[i];
    const Real over_low = p.z - section.z_low, under_high = section.z_high - p.z;
    if (-over_low > tol) break;
    // The same decision as in section_range.
    const bool in_range = is_along(v.z) ? under_high >= -tol
                          : v.z < 0     ? (over_low > tol) & (under_high >= -tol)
                                        : under_high > tol;
    if (!in_range) continue;
    const Vec3<Real> q = from_section(section, p);
    if (in_face(s, section.outer, q, v, tol) &&
        !(section.bored != 0 && in_face(s, section.inner, q, v, tol))) {
      return true;
    }
  }
  return false;
}

/// Is the point in the bore of a ring and off the bore's face? The ring must have a full turn. Of a
/// bore with flat sides only the circle within them is considered.
template <class Real>
[[gnu::always_inline]] inline bool well_in_bore(const Section<Real>& section, const Vec3<Real>& q,
                                                Real tol) {
  const ConicalFace<Real>& f = section.inner;
  const Real x = f.cosine * q.x, y = f.cosine * q.y;
  const Real radius = f.radius + f.slope * q.z - 2 * tol;
  return (radius > 0) & (x * x + y * y < radius * radius);
}

template <class Sections, class Real>
Real sections_distance_to_in(const Sections& s, const Vec3<Real>& p, const Direction<Real>& v,
                             Real tol) {
  // First the ray is clipped to the ends and to a cylinder around all sections, which is so wide
  // that the surface is well inside.
  Span<Real> body = whole_ray<Real>();
  if (is_along(v.z)) {
    if (s.z_low - p.z > tol || p.z - s.z_high > tol) return infinity<Real>();
  } else {
    const Real before = v.z < 0 ? p.z - s.z_high : s.z_low - p.z;
    const Real depth = v.z < 0 ? p.z - s.z_low : s.z_high - p.z;
    const Real rate = absolute(v.inverse_z);
    if (before > tol) body.enter = before * rate;
    body.leave = depth * rate;
    body.until = (depth - tol) * rate;
    if (!is_ahead(body)) return infinity<Real>();
  }
  // A single section is asked as quickly as the cylinder.
  const Span<Real> around =
      s.count > 1 ? cylinder_span(s.rmax * Real(1.0625), p, v, Real(0)) : whole_ray<Real>();
  if (!is_ahead(around) || !(around.enter < body.leave) || !(body.enter < around.leave)) {
    return infinity<Real>();
  }
  body.enter = -infinity<Real>();
  if (s.wedge.kind == 1) clip_to_wedge(s.wedge, p, v, tol, body);
  const Span<Real> gap = gap_span(s.wedge, p, v, tol);

  Real nearest = infinity<Real>();
  for (int k = 0; k < s.count; ++k) {
    const int i = v.z < 0 ? s.count - 1 - k : k;
    const Section<Real>& section = s.sections[i];
    const SectionRange<Real> range = section_range(section, p, v, tol);
    if (!(range.from < range.to) || range.to <= around.enter) continue;
    if (range.from >= nearest || range.from >= around.leave) break;
    // Spans of faces are accurate for starts nearby, so they are taken from where the ray enters
    // the section.
    const Vec3<Real> q = from_section(section, advance(p, v, range.from));
    // If the faces are apart, a ray that starts in the bore leaves the bore before it reaches the
    // outer face.
    const bool in_bore =
        (section.bored == 2) & (s.wedge.kind == 0) && well_in_bore(section, q, tol);
    const Span<Real> outer = in_bore ? whole_ray<Real>() : face_span(s, section.outer, q, v, tol);
    if (!is_ahead(outer)) continue;
    Span<Real> ring = body;
    ring.enter = larger(range.from > 0 ? range.from : -infinity<Real>(), ring.enter);
    ring.enter = larger(outer.enter < 0 ? outer.enter : outer.enter + range.from, ring.enter);
    ring.until = smaller(range.to, ring.until);
    ring.until = smaller(outer.until + range.from, ring.until);
    if (!is_ahead(ring)) continue;
    Span<Real> bore = no_span<Real>();
    // Likewise, a ray that comes in through the outer face is not in the bore there.
    const bool through_outer = (section.bored == 2) & (s.wedge.kind != 2) & (outer.enter >= 0) &&
                               ring.enter == outer.enter + range.from;
    if (section.bored != 0 && !through_outer) {
      bore = shifted(face_span(s, section.inner, q, v, tol), range.from);
    }
    const Real t = first_entry(ring, bore, gap);
    if (t < 0) return distance_from_within(s, p, tol);
    nearest = smaller(t, nearest);
  }
  return nearest;
}

template <class Sections, class Real>
Real sections_distance_to_out(const Sections& s, const Vec3<Real>& p, const Direction<Real>& v,
                              Real tol) {
  Real reach = 0;
  for (int k = 0; k < s.count; ++k) {
    const int i = v.z < 0 ? s.count - 1 - k : k;
    const Section<Real>& section = s.sections[i];
    const SectionRange<Real> range = section_range(section, p, v, tol);
    if (!(reach < range.to)) continue;
    if (reach < range.from) break;
    const Vec3<Real> q = from_section(section, advance(p, v, range.from));
    // A ring that the path is not in here, or is just leaving, does not extend the path.
    Real leave = face_leave(s, section.outer, q, v, tol);
    if (leave < 0) continue;
    if (section.bored != 0) {
      leave = leave_into_hole(face_span(s, section.inner, q, v, tol), leave);
    }
    reach = larger(smaller(leave + range.from, range.to), reach);
  }
  return leave_wedge(s.wedge, p, v, tol, reach);
}

template <class Sections, class Real>
Real sections_safety_to_in(const Sections& s, const Vec3<Real>& p) {
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  Real away = infinity<Real>();
  for (int i = 0; i < s.count; ++i) {
    const Section<Real>& section = s.sections[i];
    const Real along = larger(section.z_low - p.z, p.z - section.z_high);
    if (along >= away) continue;
    away = smaller(larger(ring_distance(s, section, from_section(section, p), rho), along), away);
  }
  if (s.wedge.kind != 0) away = larger(wedge_distance(s.wedge, p.x, p.y), away);
  return larger(away, Real(0));
}

template <class Sections, class Real>
Real sections_safety_to_out(const Sections& s, const Vec3<Real>& p) {
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  // The distance to the nearest piece of the surface, once the point is known to be in a ring.
  Real depth = infinity<Real>();
  bool in = false;
  for (int i = 0; i < s.count; ++i) {
    const Section<Real>& section = s.sections[i];
    const Real along = larger(section.z_low - p.z, p.z - section.z_high);
    if (along > 0 && along >= depth) continue;
    const Vec3<Real> q = from_section(section, p);
    const Real outer = face_distance(s, section.outer, q, rho);
    Real nearest = absolute(outer);
    bool in_ring = outer <= 0;
    if (section.bored != 0) {
      const Real inner = face_distance(s, section.inner, q, rho);
      nearest = smaller(absolute(inner), nearest);
      in_ring &= inner >= 0;
    }
    in |= in_ring & (along <= 0);
    depth = smaller(larger(along, nearest), depth);
  }
  if (!in) return Real(0);
  for (int i = 0; i < s.ledge_count; ++i) {
    const Ledge<Real>& ledge = s.ledges[i];
    const Real along = absolute(p.z - ledge.z);
    if (along >= depth) continue;
    const Real beyond = face_distance(s, ConicalFace<Real>{ledge.rmax, 0, 1}, p, rho);
    const Real within = -face_distance(s, ConicalFace<Real>{ledge.rmin, 0, 1}, p, rho);
    depth = smaller(larger(larger(beyond, within), along), depth);
  }
  if (s.wedge.kind != 0) depth = smaller(-wedge_distance(s.wedge, p.x, p.y), depth);
  return larger(depth, Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

/// Is the solid below this plane across z, or above? It is below if the point is deeper in the ring
/// of a section that ends in the plane than in the ring of any section that starts there.
template <class Sections, class Real>
bool is_below(const Sections& s, const Ledge<Real>& ledge, const Vec3<Real>& p, Real rho,
              Real tol) {
  Real below = infinity<Real>(), above = infinity<Real>();
  for (int i = 0; i < s.count; ++i) {
    const Section<Real>& section = s.sections[i];
    const bool ends = absolute(section.z_high - ledge.z) <= tol;
    if (!ends && !(absolute(section.z_low - ledge.z) <= tol)) continue;
    Real& nearest = ends ? below : above;
    nearest = smaller(ring_distance(s, section, from_section(section, p), rho), nearest);
  }
  return below <= above;
}

/// The normal of the nearest piece of the surface. The piece that the point is furthest beyond
/// would not do, because the solid is not the intersection of what lies behind its pieces.
template <class Sections, class Real>
Vec3<Real> sections_normal(const Sections& s, const Vec3<Real>& p, Real tol) {
  const Real rho = square_root(p.x * p.x + p.y * p.y);
  NearestFace<Real> best = no_face(tol);
  for (int i = 0; i < s.ledge_count; ++i) {
    const Ledge<Real>& ledge = s.ledges[i];
    const Real beyond = face_distance(s, ConicalFace<Real>{ledge.rmax, 0, 1}, p, rho);
    const Real within = -face_distance(s, ConicalFace<Real>{ledge.rmin, 0, 1}, p, rho);
    const Real away = larger(larger(beyond, within), absolute(p.z - ledge.z));
    const Real up = is_below(s, ledge, p, rho, tol) ? Real(1) : Real(-1);
    offer(best, -away, Vec3<Real>{0, 0, up});
  }
  for (int i = 0; i < s.count; ++i) {
    const Section<Real>& section = s.sections[i];
    const Real along = larger(section.z_low - p.z, p.z - section.z_high);
    const Vec3<Real> q = from_section(section, p);
    const Real outer = absolute(face_distance(s, section.outer, q, rho));
    offer(best, -larger(along, outer), face_normal(s, section.outer, q, tol));
    if (section.bored == 0) continue;
    const Real inner = absolute(face_distance(s, section.inner, q, rho));
    offer(best, -larger(along, inner), turned_over(face_normal(s, section.inner, q, tol)));
  }
  if (s.wedge.kind != 0) {
    const NearestFace<Real> side = wedge_face(s.wedge, p, tol);
    offer(best, -absolute(side.beyond), side.normal);
  }
  return best.normal;
}

}  // namespace navjit::kernels

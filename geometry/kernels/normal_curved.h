// Outward unit normals of quadrics, saddles, twisted solids, and sections along z.
namespace navjit::kernels {

/// The direction of a form's gradient: half of its slopes along the axes are what `form_at` gives.
template <class Face, class Real>
Vec3<Real> form_normal(const Face& f, const Vec3<Real>& p) {
  const Direction<Real> x{1, 0, 0, 0, 0, 0}, y{0, 1, 0, 0, 0, 0}, z{0, 0, 1, 0, 0, 0};
  return unit_vector(Vec3<Real>{form_at(f, p, x).b, form_at(f, p, y).b, form_at(f, p, z).b});
}
template <class Face, class Real>
void offer_form(NearestFace<Real>& best, const Face& f, bool hole, const Vec3<Real>& p) {
  const Real beyond = face_distance(f, p);
  const Vec3<Real> n = form_normal(f, p);
  offer(best, hole ? -beyond : beyond, hole ? turned_over(n) : n);
}

template <class Real>
Vec3<Real> normal(const QuadricSolid<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, s.z_low, s.z_high, p.z);
  offer_form(best, s.outer, false, p);
  if (s.bored != 0) offer_form(best, s.inner, true, p);
  return best.normal;
}

template <class Real>
Vec3<Real> normal(const TwistedTube<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, s.z_low, s.z_high, p.z);
  offer_form(best, s.outer, false, p);
  offer_form(best, s.inner, true, p);
  offer_form(best, s.start, false, p);
  offer_form(best, s.end, false, p);
  return best.normal;
}

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

template <class Real>
Vec3<Real> normal(const TwistedTrap<Real>& s, const Vec3<Real>& p, Real tol) {
  NearestFace<Real> best = no_face(tol);
  offer_ends(best, -s.hz, s.hz, p.z);
  const Turn<Real> turn = turn_by(s.rate * p.z);
  for (int k = 0; k < 4; ++k) {
    const TwistedValue<Real> at = value_at(s, side_of(s, k), p, turn);
    offer(best, at.value / gradient(at), unit_vector(Vec3<Real>{at.nx, at.ny, at.nz}));
  }
  return best.normal;
}

// --- Stacks -----------------------------------------------------------------------------------

template <class Real>
Vec3<Real> face_normal(const Polycone<Real>&, const ConicalFace<Real>& f, const Vec3<Real>& p,
                       Real) {
  return conical_normal(f, radial_at(p));
}
/// That of the side whose distance face_distance gives.
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

/// Is the solid below this plane across z, or above? Below is where a section that ends in it has
/// more of the point in its ring than any that starts in it.
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

/// The nearest of all pieces of the surface. Not the one that the point is most beyond: the solid
/// is not where all of them hold.
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

template <class Real>
Vec3<Real> normal(const Polycone<Real>& s, const Vec3<Real>& p, Real tol) {
  return sections_normal(s, p, tol);
}
template <class Real>
Vec3<Real> normal(const Polyhedra<Real>& s, const Vec3<Real>& p, Real tol) {
  return sections_normal(s, p, tol);
}

}  // namespace navjit::kernels

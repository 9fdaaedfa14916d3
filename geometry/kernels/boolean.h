// Boolean solids of any two kernels A and B, which may be booleans again, or solids in a frame of
// their own. Their distances are in boolean_paths.h.
namespace navjit::kernels {

/// A solid in a frame of its own: local = rotation * (p - translation), rotation row-major.
template <class Real, class Solid>
struct Placed {
  Solid solid;
  int rotated;  ///< 0: the rotation is the identity and is not applied
  Real translation[3];
  Real rotation[9];
};

template <class A, class B>
struct Union {
  A a;
  B b;
};
template <class A, class B>
struct Intersection {
  A a;
  B b;
};
template <class A, class B>
struct Subtraction {
  A a;
  B b;
};

// --- Placed ---------------------------------------------------------------------------------

template <class Real, class S>
Vec3<Real> to_local(const Placed<Real, S>& s, const Vec3<Real>& p) {
  const Real x = p.x - s.translation[0], y = p.y - s.translation[1], z = p.z - s.translation[2];
  if (s.rotated == 0) return {x, y, z};
  const Real* r = s.rotation;
  return {r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z,
          r[6] * x + r[7] * y + r[8] * z};
}
template <class Real, class S>
[[gnu::always_inline]] inline Direction<Real> to_local(const Placed<Real, S>& s,
                                                       const Direction<Real>& v) {
  if (s.rotated == 0) return v;
  const Real* r = s.rotation;
  return make_direction<Real>(r[0] * v.x + r[1] * v.y + r[2] * v.z,
                              r[3] * v.x + r[4] * v.y + r[5] * v.z,
                              r[6] * v.x + r[7] * v.y + r[8] * v.z);
}

template <class Real, class S>
Side inside(const Placed<Real, S>& s, const Vec3<Real>& p, Real tol) {
  return inside(s.solid, to_local(s, p), tol);
}
template <class Real, class S>
bool contains(const Placed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (s.rotated == 0) return contains(s.solid, to_local(s, p), v, tol);
  const Real* r = s.rotation;
  const Direction<Real> heading =
      make_heading<Real>(r[0] * v.x + r[1] * v.y + r[2] * v.z, r[3] * v.x + r[4] * v.y + r[5] * v.z,
                         r[6] * v.x + r[7] * v.y + r[8] * v.z);
  return contains(s.solid, to_local(s, p), heading, tol);
}
template <class Real, class S>
Real distance_to_in(const Placed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  return distance_to_in(s.solid, to_local(s, p), to_local(s, v), tol);
}
template <class Real, class S>
Real distance_to_out(const Placed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return distance_to_out(s.solid, to_local(s, p), to_local(s, v), tol);
}
template <class Real, class S>
Real safety_to_in(const Placed<Real, S>& s, const Vec3<Real>& p) {
  return safety_to_in(s.solid, to_local(s, p));
}
template <class Real, class S>
Real safety_to_out(const Placed<Real, S>& s, const Vec3<Real>& p) {
  return safety_to_out(s.solid, to_local(s, p));
}

// --- Boxed ----------------------------------------------------------------------------------

/// An operand with a box around it. The box includes a margin above all rounding, so a point or ray
/// well away from the box needs no test of the operand. Of the answers, only the safeties depend on
/// the box.
template <class Real, class Solid>
struct Boxed {
  Solid solid;
  int boxed;  ///< 0 if the box is not worth the test
  Real low[3], high[3];
};

template <class Real, class S>
bool may_contain(const Boxed<Real, S>& s, const Vec3<Real>& p, Real tol) {
  if (s.boxed == 0) return true;
  const Real margin = 2 * tol;
  return (p.x >= s.low[0] - margin) & (p.x <= s.high[0] + margin) & (p.y >= s.low[1] - margin) &
         (p.y <= s.high[1] + margin) & (p.z >= s.low[2] - margin) & (p.z <= s.high[2] + margin);
}
/// Whether the ray may meet the operand's box within `reach`, a path length.
template <class Real, class S>
bool may_meet(const Boxed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v, Real reach,
              Real tol) {
  if (s.boxed == 0) return true;
  const Real margin = 2 * tol;
  Real enter = 0, leave = reach;
  const auto clip = [&](Real low, Real high, Real at, Real rate, Real inverse) {
    // For a ray along the slab both paths are infinite. On the very edge of the margin one is NaN,
    // which clips nothing.
    const Real t_low = (low - margin - at) * inverse, t_high = (high + margin - at) * inverse;
    enter = larger(rate < 0 ? t_high : t_low, enter);
    leave = smaller(rate < 0 ? t_low : t_high, leave);
  };
  clip(s.low[0], s.high[0], p.x, v.x, v.inverse_x);
  clip(s.low[1], s.high[1], p.y, v.y, v.inverse_y);
  clip(s.low[2], s.high[2], p.z, v.z, v.inverse_z);
  return enter <= leave;
}

template <class Real, class S>
Side inside(const Boxed<Real, S>& s, const Vec3<Real>& p, Real tol) {
  return may_contain(s, p, tol) ? inside(s.solid, p, tol) : Side::outside;
}
template <class Real, class S>
bool contains(const Boxed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return may_contain(s, p, tol) && contains(s.solid, p, v, tol);
}
template <class Real, class S>
Real distance_to_in(const Boxed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  return may_meet(s, p, v, infinity<Real>(), tol) ? distance_to_in(s.solid, p, v, tol)
                                                  : infinity<Real>();
}
template <class Real, class S>
Real distance_to_out(const Boxed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return distance_to_out(s.solid, p, v, tol);
}

/// How far outside of the operand's box the point is, along the axis where that is most. The
/// operand is no nearer. 0 in the box, and if there is no box.
template <class Solid, class Real>
Real outside_box(const Solid&, const Vec3<Real>&) {
  return Real(0);
}
template <class Real, class S>
Real outside_box(const Boxed<Real, S>& s, const Vec3<Real>& p) {
  if (s.boxed == 0) return Real(0);
  const Real x = larger(s.low[0] - p.x, p.x - s.high[0]),
             y = larger(s.low[1] - p.y, p.y - s.high[1]),
             z = larger(s.low[2] - p.z, p.z - s.high[2]);
  return larger(larger(larger(x, y), z), Real(0));
}
/// How deep in the operand's box the point is. From within the operand its surface is no farther.
/// Infinity if there is no box.
template <class Solid, class Real>
Real depth_in_box(const Solid&, const Vec3<Real>&) {
  return infinity<Real>();
}
template <class Real, class S>
Real depth_in_box(const Boxed<Real, S>& s, const Vec3<Real>& p) {
  if (s.boxed == 0) return infinity<Real>();
  const Real x = smaller(p.x - s.low[0], s.high[0] - p.x),
             y = smaller(p.y - s.low[1], s.high[1] - p.y),
             z = smaller(p.z - s.low[2], s.high[2] - p.z);
  return smaller(smaller(x, y), z);
}

// The box is included in these answers, so that they do not change if an operand is left out
// because of its box.
template <class Real, class S>
Real safety_to_in(const Boxed<Real, S>& s, const Vec3<Real>& p) {
  return larger(safety_to_in(s.solid, p), outside_box(s, p));
}
template <class Real, class S>
Real safety_to_out(const Boxed<Real, S>& s, const Vec3<Real>& p) {
  const Real depth = depth_in_box(s, p);
  return depth > 0 ? smaller(safety_to_out(s.solid, p), depth) : Real(0);
}

/// The smaller of `safety` and the operand's safety_to_in.
template <class Real, class S>
Real safety_or_in(const S& s, const Vec3<Real>& p, Real safety) {
  return outside_box(s, p) < safety ? smaller(safety_to_in(s, p), safety) : safety;
}
/// The larger of `safety` and the operand's safety_to_out.
template <class Real, class S>
Real safety_or_out(const S& s, const Vec3<Real>& p, Real safety) {
  return depth_in_box(s, p) > safety ? larger(safety_to_out(s, p), safety) : safety;
}

// --- Union ----------------------------------------------------------------------------------

template <class Real, class A, class B>
Side inside(const Union<A, B>& s, const Vec3<Real>& p, Real tol) {
  const Side a = inside(s.a, p, tol);
  if (a == Side::inside) return a;
  const Side b = inside(s.b, p, tol);
  return a > b ? a : b;
}
template <class Real, class A, class B>
bool contains(const Union<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return contains(s.a, p, v, tol) || contains(s.b, p, v, tol);
}
template <class Real, class A, class B>
Real safety_to_in(const Union<A, B>& s, const Vec3<Real>& p) {
  // The operand with the nearer box is asked first: usually it is nearer than the other box.
  if (outside_box(s.b, p) < outside_box(s.a, p)) {
    return safety_or_in(s.a, p, safety_to_in(s.b, p));
  }
  return safety_or_in(s.b, p, safety_to_in(s.a, p));
}
template <class Real, class A, class B>
Real safety_to_out(const Union<A, B>& s, const Vec3<Real>& p) {
  // safety_to_out is zero for an operand that does not contain the point.
  return safety_or_out(s.b, p, safety_to_out(s.a, p));
}

// --- Intersection ---------------------------------------------------------------------------

template <class Real, class A, class B>
Side inside(const Intersection<A, B>& s, const Vec3<Real>& p, Real tol) {
  const Side a = inside(s.a, p, tol);
  return a == Side::outside ? a : worse(a, inside(s.b, p, tol));
}
template <class Real, class A, class B>
bool contains(const Intersection<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v,
              Real tol) {
  return contains(s.a, p, v, tol) && contains(s.b, p, v, tol);
}
template <class Real, class A, class B>
Real safety_to_in(const Intersection<A, B>& s, const Vec3<Real>& p) {
  return larger(safety_to_in(s.a, p), safety_to_in(s.b, p));
}
template <class Real, class A, class B>
Real safety_to_out(const Intersection<A, B>& s, const Vec3<Real>& p) {
  return smaller(safety_to_out(s.a, p), safety_to_out(s.b, p));
}

// --- Subtraction ----------------------------------------------------------------------------

template <class Real, class A, class B>
Side inside(const Subtraction<A, B>& s, const Vec3<Real>& p, Real tol) {
  const Side a = inside(s.a, p, tol);
  if (a == Side::outside) return a;
  const Side b = inside(s.b, p, tol);
  if (b == Side::inside) return Side::outside;
  return b == Side::surface ? Side::surface : a;
}
template <class Real, class A, class B>
bool contains(const Subtraction<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return contains(s.a, p, v, tol) && !contains(s.b, p, v, tol);
}
template <class Real, class A, class B>
Real safety_to_in(const Subtraction<A, B>& s, const Vec3<Real>& p) {
  return safety_or_out(s.b, p, safety_to_in(s.a, p));
}
template <class Real, class A, class B>
Real safety_to_out(const Subtraction<A, B>& s, const Vec3<Real>& p) {
  return safety_or_in(s.b, p, safety_to_out(s.a, p));
}

}  // namespace navjit::kernels

// Beside navigation.
// Outward unit normals. For placed and boolean solids these are the normals of the operand whose
// surface the point is on, turned over for an operand that is taken away.
namespace navjit::kernels {

template <class Real, class S>
Vec3<Real> normal(const Placed<Real, S>& s, const Vec3<Real>& p, Real tol) {
  const Vec3<Real> n = normal(s.solid, to_local(s, p), tol);
  if (s.rotated == 0) return n;
  const Real* r = s.rotation;
  // Rotations are orthonormal to 1e-6 only.
  return unit_vector(Vec3<Real>{r[0] * n.x + r[3] * n.y + r[6] * n.z,
                                r[1] * n.x + r[4] * n.y + r[7] * n.z,
                                r[2] * n.x + r[5] * n.y + r[8] * n.z});
}
template <class Real, class S>
Vec3<Real> normal(const Boxed<Real, S>& s, const Vec3<Real>& p, Real tol) {
  return normal(s.solid, p, tol);
}

/// How far a point is outside, or within (negative), by safeties, which may be less than the
/// distances.
template <class Solid, class Real>
Real signed_safety(const Solid& s, const Vec3<Real>& p) {
  return safety_to_in(s, p) - safety_to_out(s, p);
}

/// If the point is on both surfaces, the first operand's normal counts unless it leads into the
/// second. Otherwise the second's counts unless it leads into the first. If both do, the operands
/// meet in a common face, and the point is on the rim of this face. Then the second's surface
/// beside the rim counts.
template <class Real, class A, class B>
Vec3<Real> normal(const Union<A, B>& s, const Vec3<Real>& p, Real tol) {
  const bool on_a = inside(s.a, p, tol) == Side::surface;
  const bool on_b = inside(s.b, p, tol) == Side::surface;
  if (on_a && on_b) {
    const Vec3<Real> a = normal(s.a, p, tol), b = normal(s.b, p, tol);
    const Direction<Real> out = make_direction(a.x, a.y, a.z);
    if (!contains(s.b, p, out, tol)) return a;
    if (!contains(s.a, p, make_direction(b.x, b.y, b.z), tol)) return b;
    return normal(s.b, advance(p, out, 4 * tol), tol);
  }
  const bool first = on_a || (!on_b && signed_safety(s.a, p) <= signed_safety(s.b, p));
  return first ? normal(s.a, p, tol) : normal(s.b, p, tol);
}
template <class Real, class A, class B>
Vec3<Real> normal(const Intersection<A, B>& s, const Vec3<Real>& p, Real tol) {
  const bool on_a = inside(s.a, p, tol) == Side::surface;
  const bool on_b = inside(s.b, p, tol) == Side::surface;
  const bool first = on_a || (!on_b && signed_safety(s.a, p) >= signed_safety(s.b, p));
  return first ? normal(s.a, p, tol) : normal(s.b, p, tol);
}
template <class Real, class A, class B>
Vec3<Real> normal(const Subtraction<A, B>& s, const Vec3<Real>& p, Real tol) {
  const bool on_a = inside(s.a, p, tol) == Side::surface;
  const bool on_b = inside(s.b, p, tol) == Side::surface;
  const bool first = on_a || (!on_b && signed_safety(s.a, p) >= -signed_safety(s.b, p));
  return first ? normal(s.a, p, tol) : turned_over(normal(s.b, p, tol));
}

}  // namespace navjit::kernels

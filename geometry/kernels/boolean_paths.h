// Distances of boolean solids. However deeply operands are nested, each is asked once for each
// point of the ray that matters. A union of unions is one set of parts, and a solid within some
// operands and outside of others is one list of conditions. The shape of the tree changes no
// answer, except that conditions in another order may add up the same path from other parts.
namespace navjit::kernels {

/// How often the search along a ray may go on. Real booleans need a handful.
constexpr int boolean_search_limit = 256;

/// Copies a point number by number. A copy as a whole would load at once what was just stored in
/// parts, and would have to wait for these stores.
template <class Real>
constexpr Vec3<Real> as_numbers(const Vec3<Real>& p) {
  return {p.x, p.y, p.z};
}

// --- Parts of a union -----------------------------------------------------------------------

/// The longest path out among the parts that contain the point; 0 if none does.
template <class Real, class S>
Real furthest_out(const S& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return contains(s, p, v, tol) ? distance_to_out(s, p, v, tol) : Real(0);
}
template <class Real, class S>
Real furthest_out(const Placed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v,
                  Real tol) {
  if (s.rotated == 0) return furthest_out(s.solid, to_local(s, p), v, tol);
  return contains(s, p, v, tol) ? distance_to_out(s, p, v, tol) : Real(0);
}
template <class Real, class S>
Real furthest_out(const Boxed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v,
                  Real tol) {
  return may_contain(s, p, tol) ? furthest_out(s.solid, p, v, tol) : Real(0);
}
template <class Real, class A, class B>
Real furthest_out(const Union<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return larger(furthest_out(s.a, p, v, tol), furthest_out(s.b, p, v, tol));
}

/// The smaller of `best` and the path to the nearest part. If the start is in one part, the
/// surfaces of the others still count.
template <class Real, class S>
Real nearest_in(const S& s, const Vec3<Real>& p, const Direction<Real>& v, Real best, Real tol) {
  return smaller(distance_to_in(s, p, v, tol), best);
}
template <class Real, class S>
Real nearest_in(const Placed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v, Real best,
                Real tol) {
  if (s.rotated == 0) return nearest_in(s.solid, to_local(s, p), v, best, tol);
  return smaller(distance_to_in(s, p, v, tol), best);
}
template <class Real, class S>
Real nearest_in(const Boxed<Real, S>& s, const Vec3<Real>& p, const Direction<Real>& v, Real best,
                Real tol) {
  return may_meet(s, p, v, best, tol) ? nearest_in(s.solid, p, v, best, tol) : best;
}
template <class Real, class A, class B>
Real nearest_in(const Union<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v, Real best,
                Real tol) {
  return nearest_in(s.b, p, v, nearest_in(s.a, p, v, best, tol), tol);
}

template <class Real, class S>
Real distance_to_nearest_part(const S& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  const Real t = nearest_in(s, p, v, infinity<Real>(), tol);
  // From within one operand, the surface of the other is not a way in.
  if (t < infinity<Real>() && contains(s, p, v, tol)) return distance_from_within(s, p, tol);
  return t;
}
/// Goes from part to part until the end of one is in no other part.
template <class Real, class S>
Real distance_through_parts(const S& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Real t = 0;
  Vec3<Real> q = as_numbers(p);
  for (int turn = 0; turn < boolean_search_limit; ++turn) {
    const Real further = furthest_out(s, q, v, tol);
    if (!(further > 0)) break;
    t += further;
    q = advance(p, v, t);
  }
  return t;
}

template <class Real, class A, class B>
Real distance_to_in(const Union<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  return distance_to_nearest_part(s, p, v, tol);
}
template <class Real, class A, class B>
Real distance_to_out(const Union<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return distance_through_parts(s, p, v, tol);
}

// --- Within some solids and outside of others -----------------------------------------------

/// The search for the first point ahead where all conditions hold. A condition that does not hold
/// moves the point on to where it does.
template <class Real>
struct Approach {
  const Vec3<Real>& start;
  const Direction<Real>& v;
  Real tol;
  Real t;
  Vec3<Real> at;
  int next;   ///< the number of the condition to be tested next
  int moved;  ///< the number of the condition that moved the point last; -1: none
  bool done;
};

/// Takes the next condition; returns whether it still has to be tested. It need not be if it moved
/// the point last, because all others have held since.
template <class Real>
bool is_open(Approach<Real>& way) {
  way.done |= way.next++ == way.moved;
  return !way.done;
}
/// The condition holds `further` ahead. Returns false if that is infinite.
template <class Real>
bool move_on(Approach<Real>& way, Real further) {
  if (!(further < infinity<Real>())) return false;
  if (further > 0) {
    way.t += further;
    way.at = advance(way.start, way.v, way.t);
    way.moved = way.next - 1;
  }
  return true;
}

/// Moves the point on into `s`. Returns false if the ray never comes there.
template <class Real, class S>
bool come_into(const S& s, Approach<Real>& way) {
  if (!is_open(way) || contains(s, way.at, way.v, way.tol)) return true;
  return move_on(way, distance_to_in(s, way.at, way.v, way.tol));
}
/// Moves the point on to where it is outside of `s`.
template <class Real, class S>
bool come_out_of(const S& s, Approach<Real>& way) {
  if (!is_open(way) || !contains(s, way.at, way.v, way.tol)) return true;
  return move_on(way, distance_to_out(s, way.at, way.v, way.tol));
}
template <class Real, class A, class B>
bool come_into(const Intersection<A, B>& s, Approach<Real>& way) {
  return come_into(s.a, way) && come_into(s.b, way);
}
template <class Real, class A, class B>
bool come_into(const Subtraction<A, B>& s, Approach<Real>& way) {
  return come_into(s.a, way) && come_out_of(s.b, way);
}
template <class Real, class S>
bool come_into(const Boxed<Real, S>& s, Approach<Real>& way) {
  return may_meet(s, way.at, way.v, infinity<Real>(), way.tol) && come_into(s.solid, way);
}

template <class Real, class S>
Real distance_by_conditions(const S& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  Approach<Real> way{p, v, tol, Real(0), as_numbers(p), 0, -1, false};
  for (int turn = 0; turn < boolean_search_limit; ++turn) {
    if (!come_into(s, way)) return infinity<Real>();
    if (way.moved < 0) return distance_from_within(s, p, tol);
    if (way.done) return way.t;
    way.next = 0;
  }
  return infinity<Real>();
}

template <class Real, class A, class B>
Real distance_to_in(const Intersection<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  return distance_by_conditions(s, p, v, tol);
}
template <class Real, class A, class B>
Real distance_to_out(const Intersection<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return smaller(distance_to_out(s.a, p, v, tol), distance_to_out(s.b, p, v, tol));
}

template <class Real, class A, class B>
Real distance_to_in(const Subtraction<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  return distance_by_conditions(s, p, v, tol);
}
template <class Real, class A, class B>
Real distance_to_out(const Subtraction<A, B>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  return smaller(distance_to_out(s.a, p, v, tol), distance_to_in(s.b, p, v, tol));
}

}  // namespace navjit::kernels

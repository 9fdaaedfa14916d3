// A trapezoid that turns about the z axis as it rises, at a constant rate, and may be sheared:
// twisted boxes, trds and traps. Every section across z is a convex quadrangle. Crossings of the
// sides are found by steps along the ray that are so short that no crossing can be within them,
// given a bound on how strongly the sides bend.
namespace navjit::kernels {

/// In the frame that turns with the section, a point is within if
/// (nu + nu1 z) u + (nw + nw1 z) w < c0 + c1 z + c2 z^2. The length of (nu, nw) is 1. The last
/// three numbers are zero for a side that is planar except for the twist.
template <class Real>
struct TwistedSide {
  Real nu, nw, c0, c1;
  Real nu1 = 0, nw1 = 0, c2 = 0;
};

template <class Real>
struct TwistedTrap {
  Real hz;                ///< half length, mm
  Real rate;              ///< angle per length, rad/mm; at most a quarter turn in all
  Real shear_x, shear_y;  ///< how far the middle of the section moves for each mm along z
  Real hx, hy;            ///< the solid is within |x| <= hx, |y| <= hy, mm
  Real reach;             ///< no point is farther from the middle of its section, mm
  TwistedSide<Real> right, left, back, front;
  Real steep = 1;       ///< the largest length that (nu, nw) of a side has near the solid
  Real steepening = 0;  ///< the largest of (nu1, nw1)
  Real curve = 0;       ///< the largest |c2|
};
template <class Real>
constexpr const TwistedSide<Real>& side_of(const TwistedTrap<Real>& s, int k) {
  return k == 0 ? s.right : k == 1 ? s.left : k == 2 ? s.back : s.front;
}

template <class Real>
struct Turn {
  Real cosine, sine;
};
/// cos and sin for angles up to about 1, from their power series.
template <class Real>
Turn<Real> turn_by(Real angle) {
  constexpr int terms = sizeof(Real) > 8 ? 17 : 10;
  const Real x2 = angle * angle;
  Real cosine = 1, sine = 1;
  for (int i = terms; i > 0; --i) {
    cosine = 1 - cosine * x2 * (1 / Real((2 * i - 1) * (2 * i)));
    sine = 1 - sine * x2 * (1 / Real(2 * i * (2 * i + 1)));
  }
  return {cosine, sine * angle};
}

/// How far a point is beyond a side within the section at its z, and the derivatives of that
/// number: (nx, ny) across z, and nz along it.
template <class Real>
struct TwistedValue {
  Real value, nx, ny, nz;
};
template <class Real>
[[gnu::always_inline]] inline TwistedValue<Real> value_at(const TwistedTrap<Real>& s,
                                                          const TwistedSide<Real>& side,
                                                          const Vec3<Real>& p,
                                                          const Turn<Real>& turn) {
  const Real x = p.x - s.shear_x * p.z, y = p.y - s.shear_y * p.z;
  const Real u = side.nu + side.nu1 * p.z, w = side.nw + side.nw1 * p.z;
  const Real nx = turn.cosine * u - turn.sine * w, ny = turn.sine * u + turn.cosine * w;
  const Real along = turn.cosine * x + turn.sine * y, across = turn.cosine * y - turn.sine * x;
  return {nx * x + ny * y - (side.c0 + (side.c1 + side.c2 * p.z) * p.z), nx, ny,
          s.rate * (nx * y - ny * x) - (nx * s.shear_x + ny * s.shear_y) +
              (side.nu1 * along + side.nw1 * across) - (side.c1 + 2 * side.c2 * p.z)};
}
template <class Real>
Real gradient(const TwistedValue<Real>& at) {
  return square_root(at.nx * at.nx + at.ny * at.ny + at.nz * at.nz);
}
template <class Real>
Real rate_along(const TwistedValue<Real>& at, const Direction<Real>& v) {
  return at.nx * v.x + at.ny * v.y + at.nz * v.z;
}

/// Bounds on the first and the second derivatives of a side's (nx, ny) along z.
template <class Real>
struct TwistedRates {
  Real first, second;
};
template <class Real>
TwistedRates<Real> normal_rates(const TwistedTrap<Real>& s) {
  const Real turning = absolute(s.rate);
  return {turning * s.steep + s.steepening, turning * (turning * s.steep + 2 * s.steepening)};
}

/// How much room there is about the solid in which rays are followed, as a part of its size.
template <class Real>
constexpr Real twisted_room() {
  return Real(1) + Real(1) / 32;
}
/// A bound on the second derivatives of the sides along a ray, within that room.
template <class Real>
Real bend_along(const TwistedTrap<Real>& s, const Direction<Real>& v) {
  const Real shear = absolute(s.shear_x) + absolute(s.shear_y);
  const TwistedRates<Real> rates = normal_rates(s);
  const Real far = (s.hx + s.hy + shear * s.hz) * twisted_room<Real>();
  const Real vz = absolute(v.z), across = square_root(v.x * v.x + v.y * v.y);
  return vz * (vz * (rates.second * far + 2 * (rates.first * shear + s.curve)) +
               2 * rates.first * across);
}

/// Where a ray is first off the surface of a side by more than the tolerance, and whether it is
/// behind the side there. Infinity: it stays on the surface, and counts as behind the side.
template <class Real>
struct OffSide {
  Real path;
  bool within;
};
/// Decides for a ray that starts anywhere. A ray that grazes the side on which it starts is
/// followed, so that it neither enters for less than the tolerance nor leaves and enters for ever.
template <class Real>
OffSide<Real> off_side(const TwistedTrap<Real>& s, const TwistedSide<Real>& side,
                       const Vec3<Real>& p, const Direction<Real>& v,
                       const TwistedValue<Real>& start, Real bend, Real tol) {
  const Real width = tol * gradient(start);
  if (absolute(start.value) > width) return {Real(0), start.value < 0};
  const Real slope = rate_along(start, v);
  // From the far edge of the tolerance it goes beyond the other one.
  if (slope * slope > 4 * (bend * width)) return {Real(0), slope < 0};
  if (!(bend > 0)) return {infinity<Real>(), true};
  Real step = square_root(2 * width / bend);
  const Real room = twisted_room<Real>();
  for (Real t = step; step < infinity<Real>(); t += step) {
    const Vec3<Real> q = advance(p, v, t);
    if (!(absolute(q.x) <= s.hx * room && absolute(q.y) <= s.hy * room &&
          absolute(q.z) <= s.hz * room)) {
      break;
    }
    const TwistedValue<Real> at = value_at(s, side, q, turn_by(s.rate * q.z));
    if (absolute(at.value) > tol * gradient(at)) return {t, at.value < 0};
    // The bound is far above what bends the side here.
    step = step + step / 4;
  }
  return {infinity<Real>(), true};
}

/// A ray near the solid, with a bound on the second derivatives of the sides along it.
template <class Real>
struct TwistedRay {
  Vec3<Real> p;
  Direction<Real> v;
  Real end;    ///< the path up to which crossings are searched
  Real bend;   ///< the bound
  Real least;  ///< the shortest step; two crossings closer together than this do not count
};
template <class Real>
TwistedRay<Real> twisted_ray(const TwistedTrap<Real>& s, const Vec3<Real>& p,
                             const Direction<Real>& v) {
  // The box that `approach` goes to, with some room.
  const Real room = twisted_room<Real>(), size = s.hx + s.hy + s.hz;
  Span<Real> span = whole_ray<Real>();
  clip_slab(span, s.hx * room, p.x, v.x, v.inverse_x, Real(0));
  clip_slab(span, s.hy * room, p.y, v.y, v.inverse_y, Real(0));
  clip_slab(span, s.hz * room, p.z, v.z, v.inverse_z, Real(0));
  return {p, v, larger(span.leave, Real(0)), bend_along(s, v),
          size / (Real(1024) * 1024 * 1024 * 16)};
}

/// The path to the next crossing of a side after `from`. `within`: the path is behind the side
/// there, and the crossing leads out; otherwise it leads in. Infinity if there is no crossing.
template <class Real>
Real next_crossing(const TwistedTrap<Real>& s, const TwistedSide<Real>& side,
                   const TwistedRay<Real>& ray, Real from, bool within) {
  // This is positive beyond the crossing that is searched.
  const auto f = [&](Real t) {
    const Vec3<Real> q = advance(ray.p, ray.v, t);
    const TwistedValue<Real> at = value_at(s, side, q, turn_by(s.rate * q.z));
    const Real slope = rate_along(at, ray.v);
    return within ? Sample<Real>{at.value, slope} : Sample<Real>{-at.value, -slope};
  };
  if (!(from < ray.end)) return infinity<Real>();
  Real t = from;
  Sample<Real> at = f(t);
  // Steps become short near a side. More than this are needed by no solid that is thicker than the
  // tolerance.
  constexpr int most_steps = 100000;
  for (int step_count = 0; t < ray.end && step_count < most_steps; ++step_count) {
    // A start on the surface may have the value of the other side than the one that it counts as
    // on.
    const bool ahead = at.value > 0;
    if (ahead && at.slope >= 0 && t > from) return t;
    const Real size = absolute(at.value), towards = ahead ? -at.slope : at.slope;
    const Real root = square_root(towards * towards + 2 * (ray.bend * size));
    Real step = infinity<Real>();
    if (towards > 0) {
      step = 2 * size / (towards + root);
    } else if (ray.bend > 0) {
      step = (root - towards) / ray.bend;
    }
    if (!(step > ray.least)) step = ray.least;
    Real to = t + step;
    if (!(to < ray.end)) to = ray.end;
    const Sample<Real> next = f(to);
    if (!ahead && next.value > 0) return larger(bracketed_zero(f, t, to, true), from);
    if (!(to > t)) break;
    t = to;
    at = next;
  }
  return infinity<Real>();
}

template <class Real>
Side inside(const TwistedTrap<Real>& s, const Vec3<Real>& p, Real tol) {
  Side side = worse(Side::inside, absolute(p.z) - s.hz, tol);
  if (side == Side::outside) return side;
  const Turn<Real> turn = turn_by(s.rate * p.z);
  for (int k = 0; k < 4; ++k) {
    const TwistedValue<Real> at = value_at(s, side_of(s, k), p, turn);
    side = worse(side, at.value / gradient(at), tol);
  }
  return side;
}

template <class Real>
bool contains(const TwistedTrap<Real>& s, const Vec3<Real>& p, const Direction<Real>& v, Real tol) {
  if (beyond_face(absolute(p.z) - s.hz, p.z < 0 ? -v.z : v.z, tol)) return false;
  const Turn<Real> turn = turn_by(s.rate * p.z);
  const Real bend = bend_along(s, v);
  for (int k = 0; k < 4; ++k) {
    const TwistedSide<Real>& side = side_of(s, k);
    if (!off_side(s, side, p, v, value_at(s, side, p, turn), bend, tol).within) return false;
  }
  return true;
}

template <class Real>
Real distance_to_in(const TwistedTrap<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                    Real tol) {
  const Real shift = approach(s.hx, s.hy, -s.hz, s.hz, p, v);
  if (!(shift < infinity<Real>())) return infinity<Real>();
  const TwistedRay<Real> ray = twisted_ray(s, shift > 0 ? advance(p, v, shift) : p, v);
  Span<Real> slab = slab_span(-s.hz, s.hz, p, v, tol);
  slab.enter = slab.enter - shift;
  slab.until = slab.until - shift;
  if (!is_ahead(slab)) return infinity<Real>();
  const Turn<Real> turn = turn_by(s.rate * ray.p.z);
  bool within[4];
  Real event[4];
  for (int k = 0; k < 4; ++k) {
    const TwistedSide<Real>& side = side_of(s, k);
    const OffSide<Real> off =
        off_side(s, side, ray.p, v, value_at(s, side, ray.p, turn), ray.bend, tol);
    within[k] = off.within;
    event[k] = next_crossing(s, side, ray, off.path, off.within);
  }
  Real t = larger(slab.enter, Real(0));
  bool waited = t > 0 || shift > 0;
  for (bool moved = true; moved;) {
    moved = false;
    if (!(t < slab.until)) return infinity<Real>();
    for (int k = 0; k < 4; ++k) {
      while (event[k] <= t || !within[k]) {
        if (!(event[k] < infinity<Real>())) return infinity<Real>();
        if (event[k] > t) {
          t = event[k];
          moved = waited = true;
        }
        within[k] = !within[k];
        event[k] = next_crossing(s, side_of(s, k), ray, event[k], within[k]);
      }
    }
  }
  return waited ? t + shift : distance_from_within(s, p, tol);
}

template <class Real>
Real distance_to_out(const TwistedTrap<Real>& s, const Vec3<Real>& p, const Direction<Real>& v,
                     Real tol) {
  Real leave = leave_slab(s.hz, p.z, v.z, v.inverse_z, tol, infinity<Real>());
  if (!(absolute(p.z) <= s.hz + tol)) return Real(0);
  TwistedRay<Real> ray = twisted_ray(s, p, v);
  const Turn<Real> turn = turn_by(s.rate * p.z);
  for (int k = 0; k < 4; ++k) {
    const TwistedSide<Real>& face = side_of(s, k);
    const OffSide<Real> off = off_side(s, face, p, v, value_at(s, face, p, turn), ray.bend, tol);
    if (!off.within) return Real(0);
    ray.end = smaller(leave, ray.end);
    leave = smaller(next_crossing(s, face, ray, off.path, true), leave);
  }
  return leave;
}

/// The largest of the signed distances to the faces; in magnitude a lower bound on either side. The
/// value of a side cannot reach zero sooner, even with the steepest gradient and the largest second
/// derivative.
template <class Real>
Real surface_distance(const TwistedTrap<Real>& s, const Vec3<Real>& p) {
  Real d = absolute(p.z) - s.hz;
  if (d > 0) return d;
  const Real x = p.x - s.shear_x * p.z, y = p.y - s.shear_y * p.z;
  const Real far = larger(square_root(x * x + y * y), s.reach);
  const Real shear = square_root(s.shear_x * s.shear_x + s.shear_y * s.shear_y);
  const TwistedRates<Real> rates = normal_rates(s);
  const Real bend = rates.second * far + rates.first * (2 * shear + 1) + 2 * s.curve;
  const Turn<Real> turn = turn_by(s.rate * p.z);
  for (int k = 0; k < 4; ++k) {
    const TwistedValue<Real> at = value_at(s, side_of(s, k), p, turn);
    const Real steep = gradient(at);
    d = larger(2 * at.value / (steep + square_root(steep * steep + 2 * bend * absolute(at.value))),
               d);
  }
  return d;
}

template <class Real>
Real safety_to_in(const TwistedTrap<Real>& s, const Vec3<Real>& p) {
  Real away = larger(surface_distance(s, p), Real(0));
  away = larger(absolute(p.x) - s.hx, away);
  return larger(absolute(p.y) - s.hy, away);
}
template <class Real>
Real safety_to_out(const TwistedTrap<Real>& s, const Vec3<Real>& p) {
  return larger(-surface_distance(s, p), Real(0));
}

}  // namespace navjit::kernels

// Beside navigation.
namespace navjit::kernels {

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

}  // namespace navjit::kernels

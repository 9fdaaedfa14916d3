// Daughters that surround an axis or a centre as shells, with both radii ascending. The next shell
// that a ray meets is the next one inwards, up to where the ray is nearest to the axis, and from
// there the next one outwards. The search only finds candidates. Radii include a margin, and
// nothing depends on the shells being apart.
namespace navjit::kernels {

template <class Index>
struct ShellNest {
  int count;
  const double *near2, *far2;  ///< squared radii by position, mm^2
  const Index* daughter;       ///< by position
  bool ends;                   ///< whether rays come beyond the ends of all shells
  double low, high;            ///< these ends, along the axis, with a margin, mm
};

/// Narrows the path lengths [from, to] of a ray to those at which it is in [low, high] along an
/// axis. If the ray runs exactly along an end, the path to the end is NaN, and the end is no limit.
inline void clip_to_ends(double low, double high, double z, double vz, double inverse_z,
                         double& from, double& to) {
  const double t0 = (low - z) * inverse_z, t1 = (high - z) * inverse_z;
  from = larger(vz < 0 ? t1 : t0, from);
  to = smaller(vz < 0 ? t0 : t1, to);
}

/// A ray as a shell sees it: its squared radius is r2 + 2 b t + a t^2 after a path t.
struct RadialRay {
  double r2, b, a;
};

inline RadialRay about_axis(double x, double y, double vx, double vy) {
  return {x * x + y * y, x * vx + y * vy, vx * vx + vy * vy};
}
inline RadialRay about_centre(const Vec3<double>& p, const Direction<double>& v) {
  return {p.x * p.x + p.y * p.y + p.z * p.z, p.x * v.x + p.y * v.y + p.z * v.z,
          v.x * v.x + v.y * v.y + v.z * v.z};
}

inline double radius2_after(const RadialRay& ray, double t) {
  return ray.r2 + t * (2 * ray.b + t * ray.a);
}

/// The same ray from `t` on.
inline RadialRay radial_ray_from(const RadialRay& ray, double t) {
  return {radius2_after(ray, t), ray.b + t * ray.a, ray.a};
}

/// Calls visit(daughter) for shells that the ray may meet between the paths `from` and
/// `smaller(reach(), to)`, in the order in which it meets them. Visits may shorten `reach()`. If a
/// comparison involves NaN, the shell is offered.
template <class Index, class Visit, class Reach>
inline void walk_shells(const ShellNest<Index>& s, const RadialRay& whole, double from, double to,
                        const Visit& visit, const Reach& reach) {
  const RadialRay ray = s.ends ? radial_ray_from(whole, from) : whole;
  double end = smaller(reach(), to) - from;
  if (end < 0) return;
  double end2 = radius2_after(ray, end), nearest2 = 0;
  bool inwards = ray.b < 0;
  int i = 0, outwards = 0;
  if (inwards) {
    i = s.count - 1;
    while (i >= 0 && s.near2[i] > ray.r2) --i;
    outwards = i + 1;
    nearest2 = ray.r2 - ray.b * ray.b / ray.a;
  } else {
    while (i < s.count && s.far2[i] < ray.r2) ++i;
  }
  for (;;) {
    if (inwards && (i < 0 || s.far2[i] < (ray.b + end * ray.a <= 0 ? end2 : nearest2))) {
      inwards = false;
      i = outwards;
    }
    if (!inwards && (i >= s.count || s.near2[i] > end2)) return;
    visit(static_cast<unsigned>(s.daughter[i]));
    i += inwards ? -1 : 1;
    if (const double now = reach() - from; now < end) {
      end = now;
      end2 = radius2_after(ray, end);
    }
  }
}

/// Calls visit(daughter) for shells that may hold a point with this squared radius.
template <class Index, class Visit>
inline void visit_shells_at(const ShellNest<Index>& s, double r2, const Visit& visit) {
  for (int i = 0; i < s.count && !(s.near2[i] > r2); ++i) {
    if (!(s.far2[i] < r2)) visit(static_cast<unsigned>(s.daughter[i]));
  }
}

}  // namespace navjit::kernels

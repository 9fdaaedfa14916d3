// Solids with so much code that inlined copies of it cost more than calls.
namespace navjit::kernels {

template <class Real>
struct Approach;

/// A solid whose kernels are functions that are not inlined, so that all callers share one copy.
template <class Solid>
struct SolidApart {
  [[no_unique_address]] Solid solid;
};

template <class Solid>
[[gnu::noinline]] Side inside(const SolidApart<Solid>& s, const Vec3<double>& p, double tol) {
  return inside(s.solid, p, tol);
}
template <class Solid>
[[gnu::noinline]] bool contains(const SolidApart<Solid>& s, const Vec3<double>& p,
                                const Direction<double>& v, double tol) {
  return contains(s.solid, p, v, tol);
}
template <class Solid>
[[gnu::noinline]] double distance_to_in(const SolidApart<Solid>& s, const Vec3<double>& p,
                                        const Direction<double>& v, double tol) {
  return distance_to_in(s.solid, p, v, tol);
}
template <class Solid>
[[gnu::noinline]] double distance_to_out(const SolidApart<Solid>& s, const Vec3<double>& p,
                                         const Direction<double>& v, double tol) {
  return distance_to_out(s.solid, p, v, tol);
}
template <class Solid>
[[gnu::noinline]] double safety_to_in(const SolidApart<Solid>& s, const Vec3<double>& p) {
  return safety_to_in(s.solid, p);
}
template <class Solid>
[[gnu::noinline]] double safety_to_out(const SolidApart<Solid>& s, const Vec3<double>& p) {
  return safety_to_out(s.solid, p);
}

// Booleans call these for their operands, which may be booleans themselves.
template <class Solid>
[[gnu::noinline]] double furthest_out(const SolidApart<Solid>& s, const Vec3<double>& p,
                                      const Direction<double>& v, double tol) {
  return furthest_out(s.solid, p, v, tol);
}
template <class Solid>
[[gnu::noinline]] double nearest_in(const SolidApart<Solid>& s, const Vec3<double>& p,
                                    const Direction<double>& v, double best, double tol) {
  return nearest_in(s.solid, p, v, best, tol);
}
template <class Solid>
[[gnu::noinline]] bool come_into(const SolidApart<Solid>& s, Approach<double>& way) {
  return come_into(s.solid, way);
}

}  // namespace navjit::kernels

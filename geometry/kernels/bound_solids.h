// Solids of a known kind as parts of a scene. Their numbers are elsewhere in memory, or are
// constants.
namespace navjit::kernels {

/// Whether a ray that has come out of the solid at this point cannot meet the solid again. If so,
/// distance_to_in is infinite from there on, all along the ray. Solids that can tell have an
/// overload beside their kernels. The others may be met again.
template <class Solid>
bool is_left_for_good(const Solid&, const Vec3<double>&, double) {
  return false;
}

/// A solid whose kind is known and whose numbers are in memory.
template <class Shape>
struct KnownSolid {
  const Shape* shape;
};

template <class Shape>
bool contains(const KnownSolid<Shape>& s, const Vec3<double>& p, const Direction<double>& v,
              double tol) {
  return contains(*s.shape, p, v, tol);
}
template <class Shape>
double distance_to_in(const KnownSolid<Shape>& s, const Vec3<double>& p, const Direction<double>& v,
                      double tol) {
  return distance_to_in(*s.shape, p, v, tol);
}
template <class Shape>
double distance_to_entry(const KnownSolid<Shape>& s, const Vec3<double>& p,
                         const Direction<double>& v, double tol) {
  return distance_to_entry(*s.shape, p, v, tol);
}
template <class Shape>
double distance_to_out(const KnownSolid<Shape>& s, const Vec3<double>& p,
                       const Direction<double>& v, double tol) {
  return distance_to_out(*s.shape, p, v, tol);
}
template <class Shape>
double distance_to_exit(const KnownSolid<Shape>& s, const Vec3<double>& p,
                        const Direction<double>& v, double tol) {
  return distance_to_exit(*s.shape, p, v, tol);
}
template <class Shape>
double safety_to_in(const KnownSolid<Shape>& s, const Vec3<double>& p) {
  return safety_to_in(*s.shape, p);
}
template <class Shape>
double safety_to_out(const KnownSolid<Shape>& s, const Vec3<double>& p) {
  return safety_to_out(*s.shape, p);
}

template <class Shape>
bool is_left_for_good(const KnownSolid<Shape>& s, const Vec3<double>& p, double tol) {
  return is_left_for_good(*s.shape, p, tol);
}

/// A solid whose numbers are constants of the program.
template <const auto& solid>
struct ConstantSolid {};

template <const auto& solid>
bool contains(const ConstantSolid<solid>&, const Vec3<double>& p, const Direction<double>& v,
              double tol) {
  return contains(solid, p, v, tol);
}
template <const auto& solid>
double distance_to_in(const ConstantSolid<solid>&, const Vec3<double>& p,
                      const Direction<double>& v, double tol) {
  return distance_to_in(solid, p, v, tol);
}
template <const auto& solid>
double distance_to_entry(const ConstantSolid<solid>&, const Vec3<double>& p,
                         const Direction<double>& v, double tol) {
  return distance_to_entry(solid, p, v, tol);
}
template <const auto& solid>
double distance_to_out(const ConstantSolid<solid>&, const Vec3<double>& p,
                       const Direction<double>& v, double tol) {
  return distance_to_out(solid, p, v, tol);
}
template <const auto& solid>
double distance_to_exit(const ConstantSolid<solid>&, const Vec3<double>& p,
                        const Direction<double>& v, double tol) {
  return distance_to_exit(solid, p, v, tol);
}
template <const auto& solid>
bool is_left_for_good(const ConstantSolid<solid>&, const Vec3<double>& p, double tol) {
  return is_left_for_good(solid, p, tol);
}
template <const auto& solid>
double safety_to_in(const ConstantSolid<solid>&, const Vec3<double>& p) {
  return safety_to_in(solid, p);
}
template <const auto& solid>
double safety_to_out(const ConstantSolid<solid>&, const Vec3<double>& p) {
  return safety_to_out(solid, p);
}

/// Whether the distance_to_entry of a solid is only for rays that are oblique (is_oblique) in the
/// solid's own frame.
template <class Solid>
inline constexpr bool entry_needs_oblique = false;
template <>
inline constexpr bool entry_needs_oblique<Box<double>> = true;
template <class Shape>
inline constexpr bool entry_needs_oblique<KnownSolid<Shape>> = entry_needs_oblique<Shape>;
template <class Shape>
inline constexpr bool entry_needs_oblique<const Shape> = entry_needs_oblique<Shape>;
template <const auto& solid>
inline constexpr bool entry_needs_oblique<ConstantSolid<solid>> =
    entry_needs_oblique<decltype(solid)>;
template <class Shape>
inline constexpr bool entry_needs_oblique<const Shape&> = entry_needs_oblique<Shape>;

}  // namespace navjit::kernels

#include "codegen/data/quick_solid.hpp"

namespace navjit::kernels {

bool contains_any(const AnySolid<double>& s, const Vec3<double>& p, const Direction<double>& v,
                  double tol) {
  return contains(s, p, v, tol);
}
double distance_to_in_any(const AnySolid<double>& s, const Vec3<double>& p,
                          const Direction<double>& v, double tol) {
  return distance_to_in(s, p, v, tol);
}
double distance_to_out_any(const AnySolid<double>& s, const Vec3<double>& p,
                           const Direction<double>& v, double tol) {
  return distance_to_out(s, p, v, tol);
}
double safety_to_in_any(const AnySolid<double>& s, const Vec3<double>& p) {
  return safety_to_in(s, p);
}
double safety_to_out_any(const AnySolid<double>& s, const Vec3<double>& p) {
  return safety_to_out(s, p);
}

}  // namespace navjit::kernels

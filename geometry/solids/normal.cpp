#include "geometry/solids/normal.hpp"

namespace navjit {

Vec3 normal(const kernels::AnySolid<double>& solid, const Vec3& p, double tolerance) {
  return kernels::normal<double>(solid, p, tolerance);
}

}  // namespace navjit

#include "analysis/foreign.hpp"

#include <algorithm>
#include <type_traits>

namespace navjit {

bool is_foreign(const kernels::AnySolid<double>& solid) {
  return kernels::visit(solid, [](const auto& shape) {
    if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, kernels::ForeignShape>) {
      return true;
    } else if constexpr (requires { shape.a.boxed; }) {
      return is_foreign(shape.a.solid) || is_foreign(shape.b.solid);
    } else if constexpr (requires { shape.solid.kind; }) {
      return is_foreign(shape.solid);
    } else {
      return false;
    }
  });
}

bool holds_foreign(const Scene& scene) {
  return is_foreign(scene.solid) ||
         std::any_of(scene.daughters.begin(), scene.daughters.end(),
                     [](const Daughter& d) { return is_foreign(d.solid); });
}

}  // namespace navjit

#include "analysis/solid_key.hpp"

#include <type_traits>

#include "geometry/solids/fields.hpp"

namespace navjit {
namespace {

/// Appends values byte by byte.
struct Key {
  std::string bytes{};

  template <class Value>
  void add(const Value& value) {
    static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value> || std::is_pointer_v<Value>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Field>
  void operator()(const Field& field) {
    if constexpr (std::is_arithmetic_v<Field>) {
      add(field);
    } else {
      visit_fields(field, *this);
    }
  }
  template <class Field>
  void operator()(const Field* fields, int count) {
    add(count);
    for (int i = 0; i < count; ++i) (*this)(fields[i]);
  }
};

void add_solid(Key& key, const kernels::AnySolid<double>& solid) {
  key.add(solid.kind);
  kernels::visit(solid, [&](const auto& shape) {
    if constexpr (requires { shape.a.boxed; }) {
      add_solid(key, shape.a.solid);  // their boxes follow from the solids
      add_solid(key, shape.b.solid);
    } else if constexpr (requires { visit_fields(shape, key); }) {
      visit_fields(shape, key);
    } else if constexpr (requires { shape.solid, shape.translation, shape.rotation; }) {
      for (const double t : shape.translation) key.add(t);
      for (const double r : shape.rotation) key.add(r);
      add_solid(key, shape.solid);
    } else {
      key.add(solid.shape);  // equal only if it is one and the same shape
    }
  });
}

}  // namespace

std::string solid_key(const kernels::AnySolid<double>& solid) {
  Key key;
  add_solid(key, solid);
  return std::move(key.bytes);
}

}  // namespace navjit

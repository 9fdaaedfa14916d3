// The fields of the kernels' shapes in the order of declaration, as the compiler finds them: code
// generation prints them, keys of solids hold them, and the high-precision reference converts them.
// A shape is a plain struct of numbers, of structs like itself, and of arrays; an array is a
// pointer, followed by the number of its elements.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "geometry/solids/list.hpp"

namespace navjit::kernels {
namespace detail {

/// Converts to the value of any field, where fields are counted.
struct AnyField {
  template <class Field>
  operator Field() const;
};

/// From how many values a struct can be made.
template <class Shape, class... Fields>
constexpr std::size_t field_count() {
  if constexpr (requires { Shape{Fields{}..., AnyField{}}; }) {
    return field_count<Shape, Fields..., AnyField>();
  } else {
    return sizeof...(Fields);
  }
}

}  // namespace detail

/// References to all fields of a shape, as a tuple.
template <class Shape>
constexpr auto fields_of(Shape& s) {
  constexpr std::size_t count = detail::field_count<std::remove_const_t<Shape>>();
  static_assert(count >= 1 && count <= 16, "a shape of more fields needs a line more here");
  if constexpr (count == 1) {
    auto& [a] = s;
    return std::tie(a);
  } else if constexpr (count == 2) {
    auto& [a, b] = s;
    return std::tie(a, b);
  } else if constexpr (count == 3) {
    auto& [a, b, c] = s;
    return std::tie(a, b, c);
  } else if constexpr (count == 4) {
    auto& [a, b, c, d] = s;
    return std::tie(a, b, c, d);
  } else if constexpr (count == 5) {
    auto& [a, b, c, d, e] = s;
    return std::tie(a, b, c, d, e);
  } else if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = s;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = s;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (count == 8) {
    auto& [a, b, c, d, e, f, g, h] = s;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (count == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = s;
    return std::tie(a, b, c, d, e, f, g, h, i);
  } else if constexpr (count == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (count == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (count == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (count == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
  } else if constexpr (count == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else if constexpr (count == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p);
  }
}

/// Calls f(index) for each field of the shape; the index is a constant.
template <class Shape, class F>
constexpr void for_each_field(F&& f) {
  [&]<std::size_t... index>(std::index_sequence<index...>) {
    (f(std::integral_constant<std::size_t, index>{}), ...);
  }
  (std::make_index_sequence<detail::field_count<Shape>()>{});
}

namespace detail {

template <class Shape, class V>
void visit_each_field(const Shape& s, V&& visit) {
  const auto fields = fields_of(s);
  for_each_field<Shape>([&](auto at) {
    const auto& field = std::get<at>(fields);
    if constexpr (std::is_pointer_v<std::decay_t<decltype(field)>>) {
      visit(field, std::get<at + 1>(fields));
    } else {
      visit(field);
    }
  });
}

}  // namespace detail

/// Calls visit(field) for numbers and nested structs, and visit(pointer, count) for arrays. It is
/// not for solids that are made of other solids.
template <template <class> class Shape, class Real, class V>
void visit_fields(const Shape<Real>& s, V&& visit) {
  detail::visit_each_field(s, visit);
}
/// The same for a struct of whole numbers only.
template <class V>
void visit_fields(const Facet& s, V&& visit) {
  detail::visit_each_field(s, visit);
}

}  // namespace navjit::kernels

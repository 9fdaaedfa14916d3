// How GDML writes solids that take numbers and nothing else: the element, and an attribute for each
// argument of the function that makes the solid.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "navjit/solids.hpp"

namespace navjit::gdml {

struct Attribute {
  enum class Meaning { number, length, half_length, angle };

  const char* name = nullptr;
  Meaning meaning = Meaning::number;
  bool optional = false;  ///< if it is missing, the value is `otherwise`
  double otherwise = 0;   ///< in the element's unit
};

enum Missing { refused, zero };
constexpr Attribute number(const char* name, Missing missing = refused) {
  return {name, Attribute::Meaning::number, missing == zero};
}
constexpr Attribute length(const char* name, Missing missing = refused) {
  return {name, Attribute::Meaning::length, missing == zero};
}
/// A length with the default value that GDML's schema gives it.
constexpr Attribute length_or(const char* name, double otherwise) {
  return {name, Attribute::Meaning::length, true, otherwise};
}
/// A length in GDML of which the argument is half.
constexpr Attribute half(const char* name) {
  return {name, Attribute::Meaning::half_length, false};
}
constexpr Attribute angle(const char* name, Missing missing = refused) {
  return {name, Attribute::Meaning::angle, missing == zero};
}

struct SolidElement {
  static constexpr std::size_t most = 12;

  std::string_view tag;
  std::array<Attribute, most> attributes;
  std::size_t count;
  Solid (*make)(const std::string& name, const std::array<double, most>& values);
};

namespace detail {

template <class... Numbers>
constexpr std::size_t numbers_of(Solid (*)(std::string, Numbers...)) {
  return sizeof...(Numbers);
}
template <auto make, std::size_t... i>
Solid make_from(const std::string& name, const std::array<double, SolidElement::most>& values,
                std::index_sequence<i...>) {
  return make(name, values[i]...);
}

}  // namespace detail

/// The element `tag`; its attributes are the numbers that the function `make` takes, in order.
template <auto make, std::size_t count>
constexpr SolidElement made_by(std::string_view tag, const Attribute (&attributes)[count]) {
  static_assert(count == detail::numbers_of(make), "an attribute for each number");
  SolidElement element{tag, {}, count, [](const std::string& name, const auto& values) {
                         return detail::make_from<make>(name, values,
                                                        std::make_index_sequence<count>());
                       }};
  for (std::size_t i = 0; i < count; ++i) element.attributes[i] = attributes[i];
  return element;
}

}  // namespace navjit::gdml

// What the texts of all searches share: tables, and the heads of their functions.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "codegen/text.hpp"

namespace navjit::codegen {

/// A table of numbers or, for floating-point ones, of what `number` writes.
template <class Value>
std::string list(const char* type, const std::string& name, const std::vector<Value>& values) {
  std::string text = std::string("constexpr ") + type + " " + name + "[] = {";
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += i == 0 ? "" : i % 24 == 0 ? ",\n  " : ", ";
    if constexpr (std::is_floating_point_v<Value>) {
      text += number(values[i]);
    } else {
      text += std::to_string(values[i]);
    }
  }
  return text + (values.empty() ? "0};\n" : "};\n");
}

/// For indices below `n`.
inline const char* index_type(std::size_t n) { return n < 0xffff ? "unsigned short" : "unsigned"; }

inline constexpr const char* find_head =
    "[[gnu::always_inline]] static inline int find(const Vec3<double>& p, const Direction<double>& "
    "d, int blocked) {\n";
inline constexpr const char* nearest_head =
    "[[gnu::always_inline]] static inline int nearest(const Vec3<double>& p, const "
    "Direction<double>& d, double& best, "
    "double limit, [[maybe_unused]] unsigned left) {\n  int hit = -1;\n";

}  // namespace navjit::codegen

#include "codegen/shapes.hpp"

#include <stdexcept>
#include <type_traits>

#include "analysis/solid_key.hpp"
#include "codegen/kernel_names.hpp"
#include "codegen/text.hpp"
#include "codegen/typed_solid.hpp"
#include "geometry/solids/fields.hpp"

namespace navjit::codegen {
namespace {

using kernels::AnySolid;

/// Writes the fields of a shape as an initialiser. Arrays become constants of their own.
struct LiteralWriter {
  std::string& definitions;
  int& arrays;
  std::string out;

  void separate() {
    if (!out.empty()) out += ", ";
  }
  template <class Field>
  std::string one(const Field& field) {
    if constexpr (std::is_floating_point_v<Field>) {
      return number(field);
    } else if constexpr (std::is_integral_v<Field>) {
      return std::to_string(field);
    } else {
      LiteralWriter inner{definitions, arrays, {}};
      visit_fields(field, inner);
      return "{" + inner.out + "}";
    }
  }
  template <class Field>
  void operator()(const Field& field) {
    separate();
    out += one(field);
  }
  template <class Field>
  void operator()(const Field* fields, int count) {
    separate();
    if (count == 0) {
      out += "nullptr";
      return;
    }
    static_assert(element_name<Field> != nullptr, "say its name beside the facts of the solid");
    std::string text;
    for (int i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + one(fields[i]);
    const std::string name = "array_" + std::to_string(arrays++);
    definitions +=
        "constexpr " + std::string(element_name<Field>) + " " + name + "[] = {" + text + "};\n";
    out += name;
  }
};

}  // namespace

void Shapes::need(SolidKind kind) {
  for (const char* kernel : kernels_of(kind)) kernels_.insert(kernel);
}

void Shapes::begin(const AnySolid<double>& solid) {
  if (alone_) apart_ = apart_in(solid);
}

std::string Shapes::type(const AnySolid<double>& solid) {
  begin(solid);
  return type_of(solid);
}

std::string Shapes::type_of(const AnySolid<double>& solid) {
  need(solid.kind);
  const auto operand = [&](const kernels::AnyOperand<double>& s) {
    std::string of = type_of(s.solid);
    if (is_apart(s.solid, apart_)) of = "SolidApart<" + of + ">";
    return keeps_box(s) ? "Boxed<double, " + of + ">" : of;
  };
  const auto pair = [&](const char* name, const auto& a, const auto& b) {
    return std::string(name) + "<" + operand(a) + ", " + operand(b) + ">";
  };
  switch (solid.kind) {
    case SolidKind::placed:
      return "Placed<double, " +
             type_of(static_cast<const kernels::AnyPlaced<double>*>(solid.shape)->solid) + ">";
    case SolidKind::scaled:
      return "Scaled<double, " +
             type_of(static_cast<const kernels::AnyScaled<double>*>(solid.shape)->solid) + ">";
    case SolidKind::union_of: {
      const auto& s = *static_cast<const kernels::AnyUnion<double>*>(solid.shape);
      return pair("Union", s.a, s.b);
    }
    case SolidKind::intersection_of: {
      const auto& s = *static_cast<const kernels::AnyIntersection<double>*>(solid.shape);
      return pair("Intersection", s.a, s.b);
    }
    case SolidKind::subtraction_of: {
      const auto& s = *static_cast<const kernels::AnySubtraction<double>*>(solid.shape);
      return pair("Subtraction", s.a, s.b);
    }
    default:
      return shape_type(solid.kind);
  }
}

std::string Shapes::literal(const AnySolid<double>& solid) {
  return visit(solid, [&](const auto& shape) -> std::string {
    using Shape = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<Shape, kernels::AnyPlaced<double>>) {
      std::string text = "{" + literal(shape.solid) + ", " + std::to_string(shape.rotated) + ", {";
      for (const double x : shape.translation) text += number(x) + ", ";
      text += "}, {";
      for (const double x : shape.rotation) text += number(x) + ", ";
      return text + "}}";
    } else if constexpr (std::is_same_v<Shape, kernels::AnyScaled<double>>) {
      return "{" + literal(shape.solid) + ", " + number(shape.inverse_x) + ", " +
             number(shape.inverse_y) + ", " + number(shape.inverse_z) + ", " + number(shape.most) +
             "}";
    } else if constexpr (requires {
                           shape.a;
                           shape.b;
                         }) {
      return "{" + operand_literal(shape.a) + ", " + operand_literal(shape.b) + "}";
    } else if constexpr (std::is_same_v<Shape, kernels::ForeignShape>) {
      throw std::logic_error("code was asked for that holds a foreign solid");
    } else {
      LiteralWriter writer{definitions_, arrays_, {}};
      visit_fields(shape, writer);
      return "{" + writer.out + "}";
    }
  });
}

std::string Shapes::operand_literal(const kernels::AnyOperand<double>& operand) {
  std::string solid = literal(operand.solid);
  if (is_apart(operand.solid, apart_)) solid = "{" + solid + "}";
  if (!keeps_box(operand)) return solid;
  std::string text = "{" + solid + ", 1, {";
  for (const double x : operand.low) text += number(x) + ", ";
  text += "}, {";
  for (const double x : operand.high) text += number(x) + ", ";
  return text + "}}";
}

std::string Shapes::constant(const AnySolid<double>& solid) {
  std::string key = solid_key(solid);
  const auto known = constants_.find(key);
  if (known != constants_.end()) return known->second;
  const std::string name = "solid_" + std::to_string(constants_.size());
  const std::string solid_type = type(solid), value = literal(solid);
  definitions_ += "constexpr " + solid_type + " " + name + value + ";\n";
  constants_.emplace(std::move(key), name);
  return name;
}

}  // namespace navjit::codegen

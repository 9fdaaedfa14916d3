#include "codegen/typed_solid.hpp"

#include <cstring>
#include <vector>

#include "analysis/solid_key.hpp"
#include "codegen/shapes.hpp"

namespace navjit::codegen {
namespace {

using kernels::AnySolid;

/// Appends objects one after the other, each padded to a multiple of eight bytes. This is the
/// layout of the types in generated code, where all that follows an object is aligned to eight
/// bytes.
struct Bytes {
  std::vector<double> words{};

  template <class Value>
  void add(const Value& value) {
    static_assert(alignof(Value) <= alignof(double));
    const std::size_t at = words.size();
    words.resize(at + (sizeof(Value) + sizeof(double) - 1) / sizeof(double));
    std::memcpy(words.data() + at, &value, sizeof(Value));
  }
};

void add(Bytes& bytes, const AnySolid<double>& solid);

void add(Bytes& bytes, const kernels::AnyOperand<double>& operand) {
  add(bytes, operand.solid);
  if (!keeps_box(operand)) return;
  bytes.add(operand.boxed);
  bytes.add(operand.low);
  bytes.add(operand.high);
}

void add(Bytes& bytes, const AnySolid<double>& solid) {
  kernels::visit(solid, [&](const auto& shape) {
    using Shape = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<Shape, kernels::AnyPlaced<double>>) {
      add(bytes, shape.solid);
      bytes.add(shape.rotated);
      bytes.add(shape.translation);
      bytes.add(shape.rotation);
    } else if constexpr (std::is_same_v<Shape, kernels::AnyScaled<double>>) {
      add(bytes, shape.solid);
      for (const double x : {shape.inverse_x, shape.inverse_y, shape.inverse_z, shape.most}) {
        bytes.add(x);
      }
    } else if constexpr (requires { shape.a.boxed; }) {
      add(bytes, shape.a);
      add(bytes, shape.b);
    } else {
      bytes.add(shape);
    }
  });
}

/// Whether one of the solids that the solid is made of has more code than a box, a trd, or a simple
/// round solid.
bool has_much_code(const AnySolid<double>& solid) {
  return kernels::visit(solid, [&](const auto& shape) {
    if constexpr (requires { shape.a.boxed; }) {
      return has_much_code(shape.a.solid) || has_much_code(shape.b.solid);
    } else if constexpr (requires { shape.solid.kind; }) {
      return has_much_code(shape.solid);
    } else {
      return solid.kind != SolidKind::box && solid.kind != SolidKind::tube &&
             solid.kind != SolidKind::cone && solid.kind != SolidKind::trd &&
             solid.kind != SolidKind::orb;
    }
  });
}

}  // namespace

bool keeps_box(const kernels::AnyOperand<double>& operand) {
  if (operand.boxed == 0) return false;
  if (operand.solid.kind != SolidKind::placed) return true;
  const auto& placed = *static_cast<const kernels::AnyPlaced<double>*>(operand.solid.shape);
  return placed.rotated != 0 || placed.solid.kind != SolidKind::box;
}

bool is_composed(SolidKind kind) {
  return kind == SolidKind::placed || kind == SolidKind::scaled || kind == SolidKind::union_of ||
         kind == SolidKind::intersection_of || kind == SolidKind::subtraction_of;
}

const void* typed_shape(const AnySolid<double>& solid, Arena& arena) {
  if (!is_composed(solid.kind)) return solid.shape;
  Bytes bytes;
  add(bytes, solid);
  return arena.copy(bytes.words);
}

std::size_t solids_in(const AnySolid<double>& solid) {
  return kernels::visit(solid, [](const auto& shape) -> std::size_t {
    if constexpr (requires { shape.a.boxed; }) {
      return solids_in(shape.a.solid) + solids_in(shape.b.solid);
    } else if constexpr (requires { shape.solid.kind; }) {
      return solids_in(shape.solid);
    } else {
      return 1;
    }
  });
}

bool is_apart(const AnySolid<double>& operand, Apart which) {
  if (solids_in(operand) > 2) return true;
  if (which == Apart::large) return false;
  const AnySolid<double>* solid = &operand;
  while (solid->kind == SolidKind::placed) {
    solid = &static_cast<const kernels::AnyPlaced<double>*>(solid->shape)->solid;
  }
  return solid->kind != SolidKind::box;
}

Apart apart_in(const AnySolid<double>& solid) {
  constexpr std::size_t few = 4, many = 8;
  const std::size_t solids = solids_in(solid);
  return solids > many || (solids > few && has_much_code(solid)) ? Apart::all : Apart::large;
}

bool is_large(const AnySolid<double>& solid) {
  constexpr std::size_t most_constants = 200;  // a guess
  return solid_key(solid).size() / sizeof(double) > most_constants;
}

}  // namespace navjit::codegen

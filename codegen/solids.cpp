#include "codegen/solids.hpp"

#include <array>
#include <map>

#include "analysis/foreign.hpp"
#include "codegen/module_text.hpp"
#include "codegen/text.hpp"
#include "codegen/typed_solid.hpp"

namespace navjit::codegen {
namespace {

std::string function(const std::string& type, const std::string& name, bool with_direction,
                     const std::string& call) {
  return "extern \"C\" " + type + " " + name + "([[maybe_unused]] const void* data, " +
         "const Vec3<double>& p" + (with_direction ? ", const Direction<double>& v" : "") +
         ") {\n  return " + call + ";\n}\n";
}

}  // namespace

SolidTypes types_in(const kernels::AnySolid<double>& solid) {
  // A type is known by its kind and the types of its operands, so that deep chains take a time in
  // proportion to their length.
  std::map<std::array<std::size_t, 5>, std::size_t> numbers;
  SolidTypes types;
  const auto number = [&](const auto& again, const kernels::AnySolid<double>& s) -> std::size_t {
    return kernels::visit(s, [&](const auto& shape) {
      std::array<std::size_t, 5> type{static_cast<std::size_t>(s.kind), 0, 0, 0, 0};
      std::size_t* count = s.kind == SolidKind::box ? nullptr : &types.plain;
      if constexpr (requires { shape.a.boxed; }) {
        type = {type[0], again(again, shape.a.solid), keeps_box(shape.a),
                again(again, shape.b.solid), keeps_box(shape.b)};
        count = &types.composed;
      } else if constexpr (requires { shape.solid.kind; }) {
        type[1] = again(again, shape.solid);
        count = nullptr;
      }
      const auto [found, is_new] = numbers.try_emplace(type, numbers.size());
      if (is_new && count != nullptr) ++*count;
      return found->second;
    });
  };
  number(number, solid);
  return types;
}

bool gains_from_code(const kernels::AnySolid<double>& solid) {
  return is_composed(solid.kind) && solids_in(solid) > 1 && !is_foreign(solid);
}

SolidModule generate_solids(std::span<const kernels::AnySolid<double>> solids, double tolerance,
                            bool with_safety) {
  SolidModule module;
  const auto arena = std::make_shared<Arena>();
  Shapes shapes(true);
  std::string functions;
  for (const kernels::AnySolid<double>& solid : solids) {
    SolidEntry entry;
    std::string numbers;
    if (is_large(solid)) {
      numbers = "*static_cast<const " + shapes.type(solid) + "*>(data)";
      entry.data = typed_shape(solid, *arena);
    } else {
      numbers = shapes.constant(solid);
    }
    const std::string suffix = "_" + std::to_string(module.entries.size());
    const auto add = [&](std::string SolidEntry::*of, const char* kernel, bool with_direction) {
      entry.*of = std::string("navjit_") + kernel + suffix;
      functions += function(
          of == &SolidEntry::contains ? "bool" : "double", entry.*of, with_direction,
          std::string(kernel) + "(" + numbers + (with_direction ? ", p, v, tolerance)" : ", p)"));
    };
    add(&SolidEntry::contains, "contains", true);
    add(&SolidEntry::distance_to_in, "distance_to_in", true);
    add(&SolidEntry::distance_to_out, "distance_to_out", true);
    if (with_safety) {
      add(&SolidEntry::safety_to_in, "safety_to_in", false);
      add(&SolidEntry::safety_to_out, "safety_to_out", false);
    }
    module.entries.push_back(std::move(entry));
  }
  module.owner = arena;
  module.source = module_text(
      "Code for " + std::to_string(solids.size()) + " solids.", shapes,
      "constexpr double tolerance = " + number(tolerance) + ";\n" + shapes.definitions(),
      functions);
  return module;
}

}  // namespace navjit::codegen

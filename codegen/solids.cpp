#include "codegen/solids.hpp"

#include <set>

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
  Shapes shapes(true);
  std::set<std::string> composed;
  std::set<SolidKind> plain;
  const auto look = [&](const auto& again, const kernels::AnySolid<double>& s) -> void {
    kernels::visit(s, [&](const auto& shape) {
      if constexpr (requires { shape.a.boxed; }) {
        composed.insert(shapes.type(s));
        again(again, shape.a.solid);
        again(again, shape.b.solid);
      } else if constexpr (requires { shape.solid.kind; }) {
        again(again, shape.solid);
      } else if (s.kind != SolidKind::box) {
        plain.insert(s.kind);
      }
    });
  };
  look(look, solid);
  return {composed.size(), plain.size()};
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
  module.source =
      "// Code for " + std::to_string(solids.size()) + " solids. Generated: do not edit.\n" +
      module_text(
          shapes,
          "constexpr double tolerance = " + number(tolerance) + ";\n" + shapes.definitions(),
          functions);
  return module;
}

}  // namespace navjit::codegen

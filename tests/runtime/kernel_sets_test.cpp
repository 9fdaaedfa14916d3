// The kernels that each kind of solid names are all that its code needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "codegen/kernel_names.hpp"
#include "codegen/kernel_texts.hpp"
#include "geometry/solids/kinds.hpp"
#include "geometry/solids/list.hpp"
#include "jit/compiler.hpp"

namespace navjit::codegen {
namespace {

/// The name of the kernel's shape of a kind.
std::string shape_of(SolidKind of) {
#define NAVJIT_SHAPE(kind, name, Shape) \
  if (of == SolidKind::kind) return #Shape;
  NAVJIT_SOLIDS(NAVJIT_SHAPE, NAVJIT_SHAPE)
#undef NAVJIT_SHAPE
  return {};
}

/// Calls of everything that can be asked of a shape, so that every template is instantiated.
std::string questions_to(const std::string& shape) {
  return "namespace navjit::kernels {\n"
         "double asked(const " +
         shape +
         "<double>& s, const Vec3<double>& p,\n"
         "             const Direction<double>& v) {\n"
         "  return contains(s, p, v, 1e-9) + int(inside(s, p, 1e-9)) +\n"
         "         distance_to_in(s, p, v, 1e-9) + distance_to_out(s, p, v, 1e-9) +\n"
         "         safety_to_in(s, p) + safety_to_out(s, p);\n"
         "}\n"
         "}  // namespace navjit::kernels\n";
}

TEST(KernelSets, CompileWithoutThoseOfOtherKinds) {
  auto compiler = jit::Compiler::create(jit::CompileOptions{});
  ASSERT_TRUE(compiler);
  int asked = 0;
  for (const KindFacts& kind : all_kinds()) {
    if (kind.kernel_files.empty()) continue;  // foreign
    std::string source{kernel_text("vectors")};
    source += kernel_text("prelude");
    source += kernel_text("lanes");
    for (const std::string_view name : kernel_order()) {
      if (std::find(kind.kernel_files.begin(), kind.kernel_files.end(), name) !=
          kind.kernel_files.end()) {
        source += kernel_text(name);
      }
    }
    // Solids of other solids are asked where these are known.
    const std::string shape = shape_of(kind.kind);
    if (source.find("struct " + shape + " {") != std::string::npos) {
      source += questions_to(shape);
      ++asked;
    }
    source += "extern \"C\" int made() { return 1; }\n";
    const auto object = compiler->compile(source, "kernels.cpp");
    EXPECT_TRUE(object) << kind.name << ": " << object.failure().message;
  }
  EXPECT_EQ(asked, 24);
}

}  // namespace
}  // namespace navjit::codegen

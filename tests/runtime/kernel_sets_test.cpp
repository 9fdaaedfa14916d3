// The kernels that each kind of solid names are all that its code needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "codegen/kernel_names.hpp"
#include "codegen/kernel_texts.hpp"
#include "geometry/solids/kinds.hpp"
#include "jit/compiler.hpp"

namespace navjit::codegen {
namespace {

TEST(KernelSets, CompileWithoutThoseOfOtherKinds) {
  auto compiler = jit::Compiler::create(jit::CompileOptions{});
  ASSERT_TRUE(compiler);
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
    source += "extern \"C\" int made() { return 1; }\n";
    const auto object = compiler->compile(source, "kernels.cpp");
    EXPECT_TRUE(object) << kind.name << ": " << object.failure().message;
  }
}

}  // namespace
}  // namespace navjit::codegen

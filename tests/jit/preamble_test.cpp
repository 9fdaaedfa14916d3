// The text that sources begin with is kept in parsed form.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "jit/compiler.hpp"

namespace navjit::jit {
namespace {

const std::string preamble =
    "#pragma clang attribute push(__attribute__((always_inline)), apply_to = function)\n"
    "namespace kept {\n"
    "template <class T> T twice(T x) { return x + x; }\n"
    "inline double half(double x) { return x / 2; }\n"
    "}\n"
    "#pragma clang attribute pop\n";

std::string function(const std::string& name, const std::string& body) {
  return preamble + "extern \"C\" double " + name + "(double x) { return " + body + "; }\n";
}

Compiler compiler_with(const std::string& text) {
  CompileOptions options;
  options.preamble = text;
  auto compiler = Compiler::create(options);
  if (!compiler) throw std::runtime_error(compiler.failure().message);
  return *std::move(compiler);
}

TEST(Preamble, IsKeptFromTheSecondSourceOnAndTheCodeIsTheSame) {
  Compiler with = compiler_with(preamble), without = compiler_with("");
  const std::string sources[] = {function("f", "kept::twice(x)"),
                                 function("g", "kept::half(kept::twice(x)) * 3"),
                                 function("h", "kept::twice(static_cast<float>(x))")};
  for (std::size_t i = 0; i < std::size(sources); ++i) {
    const auto kept = with.compile(sources[i], "unit.cpp");
    const auto whole = without.compile(sources[i], "unit.cpp");
    ASSERT_TRUE(kept) << kept.failure().message;
    ASSERT_TRUE(whole) << whole.failure().message;
    EXPECT_EQ(kept->report.kept_preamble, i > 0);
    EXPECT_FALSE(whole->report.kept_preamble);
    EXPECT_EQ(kept->bytes, whole->bytes);
  }
  EXPECT_GT(with.processor_seconds(), 0);
}

TEST(Preamble, LinesOfErrorsAreThoseOfTheSource) {
  Compiler compiler = compiler_with(preamble);
  for (int i = 0; i < 3; ++i) {
    const auto object = compiler.compile(function("f", "missing"), "unit.cpp");
    ASSERT_FALSE(object);
    EXPECT_NE(object.failure().message.find("unit.cpp:7:40: error:"), std::string::npos)
        << object.failure().message;
  }
  // What was wrong before does not matter to what comes.
  const auto object = compiler.compile(function("f", "kept::half(x)"), "unit.cpp");
  ASSERT_TRUE(object) << object.failure().message;
  EXPECT_TRUE(object->report.kept_preamble);
}

TEST(Preamble, OtherSourcesAndOtherNamesOfUnitsAreParsedAsAWhole) {
  Compiler compiler = compiler_with(preamble);
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(compiler.compile(function("f", "x"), "unit.cpp"));
  const auto other = compiler.compile("extern \"C\" int one() { return 1; }", "unit.cpp");
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->report.kept_preamble);
  const auto elsewhere = compiler.compile(function("f", "kept::twice(x)"), "elsewhere.cpp");
  ASSERT_TRUE(elsewhere);
  EXPECT_FALSE(elsewhere->report.kept_preamble);
}

TEST(Preamble, WithErrorsInItEachSourceSaysWhere) {
  const std::string broken = "int a() { return missing; }\n";
  Compiler compiler = compiler_with(broken);
  for (int i = 0; i < 3; ++i) {
    const auto object = compiler.compile(broken + "int b() { return 1; }\n", "unit.cpp");
    ASSERT_FALSE(object);
    EXPECT_NE(object.failure().message.find("unit.cpp:1:18: error:"), std::string::npos)
        << object.failure().message;
  }
}

}  // namespace
}  // namespace navjit::jit

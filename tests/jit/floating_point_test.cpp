#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "jit/compiler.hpp"
#include "jit/linker.hpp"

namespace navjit::jit {
namespace {

// Sources that a contracting compiler would turn into fused multiply-adds.
constexpr const char* fusable =
    "extern \"C\" double f(double a, double b, double c) { return a * b + c; }\n"
    "extern \"C\" double g(double a, double b, double c) { double p = a * b; return c - p; }\n"
    "extern \"C\" void loop(double* __restrict y, const double* a, const double* b) {\n"
    "  for (int i = 0; i < 64; ++i) y[i] = a[i] * b[i] + y[i];\n}\n"
    "extern \"C\" double fused(double a, double b, double c) {\n"
    "  return __builtin_fma(a, b, c);\n}\n"
    "extern \"C\" double folded() { double a = 1 + 0x1p-30, b = 1 - 0x1p-30, c = -1;\n"
    "  return a * b + c; }\n";

// a * b rounds to 1, so that the sum is 0 if the product is rounded and -2^-60 if it is not.
constexpr double a = 1 + 0x1p-30;
constexpr double b = 1 - 0x1p-30;

std::uint64_t bits(double x) {
  std::uint64_t u;
  std::memcpy(&u, &x, sizeof u);
  return u;
}

class FloatingPoint : public testing::TestWithParam<int> {};

TEST_P(FloatingPoint, IsNeverContracted) {
  CompileOptions options;
  options.optimisation = GetParam();
  const auto object = compile(fusable, "fusable.cpp", options);
  ASSERT_TRUE(object) << object.failure().message;
  auto linker = Linker::create();
  ASSERT_TRUE(linker);
  const auto code = linker->link(*object);
  ASSERT_TRUE(code) << code.failure().message;

  auto* f = *code->function<double(double, double, double)>("f");
  auto* g = *code->function<double(double, double, double)>("g");
  auto* folded = *code->function<double()>("folded");
  EXPECT_EQ(bits(f(a, b, -1)), bits(0.0));
  EXPECT_EQ(bits(g(a, b, 1)), bits(0.0));
  EXPECT_EQ(bits(folded()), bits(f(a, b, -1)));

  double y[64], as[64], bs[64];
  for (int i = 0; i < 64; ++i) y[i] = -1, as[i] = a, bs[i] = b;
  (*code->function<void(double*, const double*, const double*)>("loop"))(y, as, bs);
  for (double sum : y) EXPECT_EQ(bits(sum), bits(0.0));

  // The test data does tell the two apart, and the fused operation is there on request.
  EXPECT_EQ((*code->function<double(double, double, double)>("fused"))(a, b, -1), -0x1p-60);
}

/// Whether the object has an instruction with the VEX opcode of a double-precision FMA3. The unit's
/// text is too small for chance hits: the units with and without it differ in nothing else.
bool has_fma_instruction(const Object& object) {
  for (std::size_t i = 0; i + 3 < object.bytes.size(); ++i) {
    const auto byte = [&](std::size_t k) {
      return static_cast<unsigned char>(object.bytes[i + k]);
    };
    const bool vex_map_0f38 = byte(0) == 0xc4 && (byte(1) & 0x1f) == 2;
    const bool w1_prefix_66 = (byte(2) & 0x83) == 0x81;
    const unsigned char operation = byte(3) & 0x0f;
    const unsigned char form = byte(3) & 0xf0;
    if (vex_map_0f38 && w1_prefix_66 && operation >= 6 &&
        (form == 0x90 || form == 0xa0 || form == 0xb0)) {
      return true;
    }
  }
  return false;
}

TEST_P(FloatingPoint, UsesNoFusedInstructionsUnlessAsked) {
  CompileOptions options;
  options.optimisation = GetParam();
  options.cpu = "x86-64-v3";  // has FMA
  const std::string source(fusable);
  const auto with = compile(source, "fusable.cpp", options);
  const auto without =
      compile(source.substr(0, source.find("extern \"C\" double fused")), "fusable.cpp", options);
  ASSERT_TRUE(with && without);
  EXPECT_TRUE(has_fma_instruction(*with));
  EXPECT_FALSE(has_fma_instruction(*without));
}

TEST_P(FloatingPoint, PragmasDoNotLoosenIt) {
  CompileOptions options;
  options.optimisation = GetParam();
  for (const char* pragma :
       {"#pragma STDC FP_CONTRACT ON\n", "#pragma clang fp contract(on)\n",
        "#pragma clang fp contract(fast)\n", "#pragma clang fp reassociate(on)\n"}) {
    const auto object =
        compile(std::string("extern \"C\" double f(double a, double b, double c) {\n") + pragma +
                    "  return a * b + c; }\n"
                    "extern \"C\" double cancel(double x) {\n" +
                    pragma + "  return (x + 1e16) - 1e16; }\n",
                "pragma.cpp", options);
    ASSERT_TRUE(object) << object.failure().message;
    auto linker = Linker::create();
    ASSERT_TRUE(linker);
    const auto code = linker->link(*object);
    ASSERT_TRUE(code) << code.failure().message;
    EXPECT_EQ(bits((*code->function<double(double, double, double)>("f"))(a, b, -1)), bits(0.0))
        << pragma;
    EXPECT_EQ((*code->function<double(double)>("cancel"))(1.0), 0.0) << pragma;
  }
  // The flags for whole functions, set in the source.
  const auto object = compile(
      "#pragma float_control(precise, off)\n"
      "extern \"C\" double f(double a, double b, double c) { return a * b + c; }\n"
      "extern \"C\" bool is_nan(double x) { return x != x; }\n",
      "pragma.cpp", options);
  ASSERT_TRUE(object) << object.failure().message;
  auto linker = Linker::create();
  ASSERT_TRUE(linker);
  const auto code = linker->link(*object);
  ASSERT_TRUE(code) << code.failure().message;
  EXPECT_EQ(bits((*code->function<double(double, double, double)>("f"))(a, b, -1)), bits(0.0));
  EXPECT_TRUE((*code->function<bool(double)>("is_nan"))(std::nan("")));
}

TEST_P(FloatingPoint, IsNotReassociatedAndKeepsSpecialValues) {
  CompileOptions options;
  options.optimisation = GetParam();
  const auto object = compile(
      "extern \"C\" double sum(const double* x, int n) {\n"
      "  double s = 0; for (int i = 0; i < n; ++i) s += x[i]; return s; }\n"
      "extern \"C\" double cancel(double x) { return (x + 1e16) - 1e16; }\n"
      "extern \"C\" bool is_nan(double x) { return x != x; }\n"
      "extern \"C\" double plus_zero(double x) { return x + 0.0; }\n"
      "extern \"C\" double third(double x) { return x / 3.0; }\n",
      "strict.cpp", options);
  ASSERT_TRUE(object) << object.failure().message;
  auto linker = Linker::create();
  ASSERT_TRUE(linker);
  const auto code = linker->link(*object);
  ASSERT_TRUE(code) << code.failure().message;

  double x[101];
  double expected = 0;
  for (int i = 0; i < 101; ++i) expected += x[i] = (i % 3 - 1) * 1e16 + 1.0 / (i + 1);
  EXPECT_EQ(bits((*code->function<double(const double*, int)>("sum"))(x, 101)), bits(expected));
  EXPECT_EQ((*code->function<double(double)>("cancel"))(1.0), 0.0);
  EXPECT_TRUE((*code->function<bool(double)>("is_nan"))(std::nan("")));
  EXPECT_EQ(bits((*code->function<double(double)>("plus_zero"))(-0.0)), bits(0.0));
  EXPECT_EQ(bits((*code->function<double(double)>("third"))(0.7)), bits(0.7 / 3.0));
}

TEST_P(FloatingPoint, FoldsConstantsToWhatRunTimeGives) {
  // Each operation once on constants and once on arguments.
  const auto object = compile(
      "extern \"C\" void folded(double* r) {\n"
      "  const double x = 0x1.921fb54442d18p+1, y = 0x1.5bf0a8b145769p+1;\n"
      "  r[0] = x * y + x / y; r[1] = __builtin_sqrt(x) - y * y; r[2] = x * x * x - y;\n"
      "  r[3] = (x - y) / (x + y); r[4] = (float)(x * y); r[5] = __builtin_floor(-x * y);\n}\n"
      "extern \"C\" void computed(double* r, double x, double y) {\n"
      "  r[0] = x * y + x / y; r[1] = __builtin_sqrt(x) - y * y; r[2] = x * x * x - y;\n"
      "  r[3] = (x - y) / (x + y); r[4] = (float)(x * y); r[5] = __builtin_floor(-x * y);\n}\n",
      "folding.cpp", CompileOptions{.optimisation = GetParam()});
  ASSERT_TRUE(object) << object.failure().message;
  auto linker = Linker::create();
  ASSERT_TRUE(linker);
  const auto code = linker->link(*object);
  ASSERT_TRUE(code) << code.failure().message;
  double folded[6];
  double computed[6];
  (*code->function<void(double*)>("folded"))(folded);
  (*code->function<void(double*, double, double)>("computed"))(computed, 0x1.921fb54442d18p+1,
                                                               0x1.5bf0a8b145769p+1);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(bits(folded[i]), bits(computed[i])) << i;
}

INSTANTIATE_TEST_SUITE_P(Levels, FloatingPoint, testing::Values(0, 1, 2, 3));

}  // namespace
}  // namespace navjit::jit

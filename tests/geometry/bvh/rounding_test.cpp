#include "geometry/bvh/rounding.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace navjit::bvh {
namespace {

TEST(Rounding, IsStrictlyOutward) {
  std::mt19937_64 generator(8);
  for (int i = 0; i < 200000; ++i) {
    const double mantissa = 1 + static_cast<double>(generator() >> 11) * 0x1p-53;
    const double x = std::ldexp(generator() % 2 ? mantissa : -mantissa,
                                static_cast<int>(generator() % 300) - 180);
    EXPECT_LT(static_cast<double>(float_below(x)), x);
    EXPECT_GT(static_cast<double>(float_above(x)), x);
    EXPECT_GE(float_below(x), x - std::fabs(x) * 0x1p-22 - 0x1p-99);
    EXPECT_LE(float_above(x), x + std::fabs(x) * 0x1p-22 + 0x1p-99);
  }
  for (const double x : {0.0, -0.0, 1.0, -1.0, 0x1p-1074, 1e-310, 1e-45, 0x1p-149, 16777216.0}) {
    EXPECT_LT(static_cast<double>(float_below(x)), x);
    EXPECT_GT(static_cast<double>(float_above(x)), x);
  }
}

TEST(Rounding, BeyondTheRangeOfFloats) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr float largest = std::numeric_limits<float>::max();
  EXPECT_EQ(float_below(1e300), largest);
  EXPECT_EQ(float_below(-1e300), -static_cast<float>(infinity));
  EXPECT_EQ(float_above(1e300), static_cast<float>(infinity));
  EXPECT_EQ(float_above(-1e300), -largest);
  EXPECT_EQ(float_above(infinity), static_cast<float>(infinity));
  EXPECT_EQ(float_below(-infinity), -static_cast<float>(infinity));
}

TEST(Rounding, OfPointsGivesTheSameBits) {
  std::mt19937_64 random(3);
  const auto expect_same = [](double x) {
    EXPECT_EQ(std::bit_cast<std::uint32_t>(float_below_point(x)),
              std::bit_cast<std::uint32_t>(float_below(x)))
        << x;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(float_above_point(x)),
              std::bit_cast<std::uint32_t>(float_above(x)))
        << x;
  };
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-320, 30);
  for (int i = 0; i < 100000; ++i) expect_same(mantissa(random) * std::pow(10, exponent(random)));
  for (const double x : {0.0, -0.0, 1.0, -1.0, 1e30, -1e30, 5e-324}) expect_same(x);
  for (const double x : {1e38, 3.4028235e38, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(float_above_point(x), float_above(x)) << x;
  }
}

}  // namespace
}  // namespace navjit::bvh

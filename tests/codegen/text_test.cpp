#include "codegen/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <limits>
#include <random>

namespace navjit::codegen {
namespace {

TEST(Text, NumbersReadBackToTheSameBits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const std::uint64_t bits = random();
    const auto value = std::bit_cast<double>(bits);
    if (!std::isfinite(value)) continue;
    const double back = std::strtod(number(value).c_str(), nullptr);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back), bits) << number(value);
  }
  EXPECT_EQ(number(-0.0), "-0x0p+0");
  EXPECT_EQ(number(-std::numeric_limits<double>::infinity()), "-__builtin_inf()");
}

TEST(Text, NamesCannotBecomeCode) {
  EXPECT_EQ(identifier("a*/ int main(){}\n\\"), "a___int_main______");
  EXPECT_LE(identifier(std::string(500, 'x')).size(), 60U);
}

}  // namespace
}  // namespace navjit::codegen

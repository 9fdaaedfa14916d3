// The boxes of a boolean's operands change no bit of an answer.
#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "tests/support/random_solids.hpp"

namespace navjit {
namespace {

constexpr double tolerance = 1e-9;

/// The same operand without its box.
template <class Any>
Any plain(Any solid) {
  solid.a.boxed = solid.b.boxed = 0;
  return solid;
}

Direction random_direction(std::mt19937_64& random, bool along_an_axis = false) {
  Vec3 d{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
  if (along_an_axis) d = {random() % 2 == 0 ? 1.0 : -1.0, 0, 0};
  const double norm = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  return kernels::make_direction(d.x / norm, d.y / norm, d.z / norm);
}

template <class Any>
bool same_answers(const Any& boxed, std::mt19937_64& random) {
  const Any without = plain(boxed);
  const auto equal = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  Vec3 p{uniform(random, -8, 8), uniform(random, -8, 8), uniform(random, -8, 8)};
  Direction v = random_direction(random, random() % 4 == 0);
  bool same = true;
  for (int i = 0; i < 6; ++i) {
    same &= contains(boxed, p, v, tolerance) == contains(without, p, v, tolerance);
    same &= inside(boxed, p, tolerance) == inside(without, p, tolerance);
    const double in = distance_to_in(boxed, p, v, tolerance);
    same &= equal(in, distance_to_in(without, p, v, tolerance));
    same &=
        equal(distance_to_out(boxed, p, v, tolerance), distance_to_out(without, p, v, tolerance));
    // On: to the surface, where the next questions are asked, some turned.
    if (!(in < 100) || in == 0) break;
    p = kernels::advance(p, v, in);
    if (i % 2 == 1) v = kernels::make_direction(-v.x, v.y, v.z);
  }
  return same;
}

TEST(OperandBoxes, ChangeNoBit) {
  std::mt19937_64 random(8);
  for (int round = 0; round < 300; ++round) {
    const Solid a = random_primitive(random);
    const Solid b = make_placed("b", random_primitive(random), random_frame(random));
    const Solid either = make_union("u", a, b), left = make_subtraction("d", a, b);
    const Solid nested = make_union("n", left, make_placed("c", either, random_frame(random)));
    for (int i = 0; i < 100; ++i) {
      const auto* u = static_cast<const kernels::AnyUnion<double>*>(either.shape.get());
      ASSERT_TRUE(same_answers(*u, random)) << "round " << round;
      const auto* s = static_cast<const kernels::AnySubtraction<double>*>(left.shape.get());
      ASSERT_TRUE(same_answers(*s, random)) << "round " << round;
      const auto* n = static_cast<const kernels::AnyUnion<double>*>(nested.shape.get());
      ASSERT_TRUE(same_answers(*n, random)) << "round " << round;
    }
  }
}

/// The boxes are part of safeties: outside they add what is known of the distance to the operand.
/// No safety may be more than the way to the surface along any ray.
template <class Any>
void check_safeties(const Any& boxed, const Vec3& p, std::mt19937_64& random, int& more) {
  const Any without = plain(boxed);
  const double in = safety_to_in(boxed, p), out = safety_to_out(boxed, p);
  ASSERT_GE(in, safety_to_in(without, p));
  more += in > safety_to_in(without, p) ? 1 : 0;
  const bool within = inside(boxed, p, tolerance) != Side::outside;
  ASSERT_LE(within ? in : out, tolerance);
  for (int ray = 0; ray < 8; ++ray) {
    const Direction v = random_direction(random);
    const double way =
        within ? distance_to_out(boxed, p, v, tolerance) : distance_to_in(boxed, p, v, tolerance);
    ASSERT_LE(within ? out : in, way + tolerance);
  }
}

TEST(OperandBoxes, AreInSafeties) {
  std::mt19937_64 random(9);
  int more = 0;
  for (int round = 0; round < 300; ++round) {
    const Solid a = random_primitive(random);
    const Solid b = make_placed("b", random_primitive(random), random_frame(random));
    const Solid either = make_union("u", a, b), left = make_subtraction("d", a, b);
    const Solid cut = make_subtraction("n", either, make_placed("c", left, random_frame(random)));
    for (int i = 0; i < 50; ++i) {
      const Vec3 p{uniform(random, -8, 8), uniform(random, -8, 8), uniform(random, -8, 8)};
      const auto* u = static_cast<const kernels::AnyUnion<double>*>(either.shape.get());
      check_safeties(*u, p, random, more);
      const auto* s = static_cast<const kernels::AnySubtraction<double>*>(left.shape.get());
      check_safeties(*s, p, random, more);
      const auto* n = static_cast<const kernels::AnySubtraction<double>*>(cut.shape.get());
      check_safeties(*n, p, random, more);
      if (HasFatalFailure()) FAIL() << "round " << round;
    }
  }
  EXPECT_GT(more, 500);
}

}  // namespace
}  // namespace navjit

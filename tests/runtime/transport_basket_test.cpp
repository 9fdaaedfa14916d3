#include "runtime/transport_basket.hpp"

#include <gtest/gtest.h>

#include "tests/support/traces.hpp"

namespace navjit {
namespace {

using tests::rays_through;
using tests::Row;

class TransportInBasket : public ::testing::Test {
 protected:
  std::shared_ptr<const World> world_ = std::make_shared<const World>(tests::mixed_world());
  Runtime runtime_{world_, {.jit = JitMode::off}};

  std::vector<Ray> rays(int count) const {
    std::vector<Ray> rays = rays_through(*world_, 9, count);
    for (std::size_t i = 0; i < rays.size(); i += 7) rays[i].position.x += 1e4;  // outside
    return rays;
  }
  static bool always() { return true; }
};

TEST_F(TransportInBasket, RaysAreThoseOfOneByOne) {
  const std::vector<Ray> some = rays(300);
  Navigator one = runtime_.navigator();
  for (const std::size_t places : {1U, 5U, 64U, 1000U}) {
    Basket basket = runtime_.basket(places);
    std::vector<std::vector<Row>> rows(some.size());
    const std::vector<RayTotals> made = transport_in_basket(
        basket, some, world_->tolerance,
        [&](std::size_t ray, const State& s, double length) {
          rows[ray].push_back({s.touchable(), length, s.volume()});
        },
        always);
    ASSERT_EQ(made.size(), some.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
      std::vector<Row> right;
      const RayTotals totals =
          transport(one, some[i], world_->tolerance, [&](const State& s, double length) {
            right.push_back({s.touchable(), length, s.volume()});
          });
      EXPECT_TRUE(tests::same_bits(rows[i], right)) << i;
      EXPECT_EQ(made[i].steps, totals.steps);
      EXPECT_TRUE(kernels::same_bits(made[i].length, totals.length));
      EXPECT_FALSE(made[i].stuck);
    }
  }
}

TEST_F(TransportInBasket, OfWhatIsInterruptedTheFirstRaysCount) {
  const std::vector<Ray> some = rays(200);
  Basket basket = runtime_.basket(16), again = runtime_.basket(16);
  const auto no_sink = [](std::size_t, const State&, double) {};
  const auto all = transport_in_basket(basket, some, world_->tolerance, no_sink, always);
  int left = 20;
  const auto part =
      transport_in_basket(again, some, world_->tolerance, no_sink, [&] { return left-- > 0; });
  ASSERT_GT(part.size(), 5U);
  ASSERT_LT(part.size(), some.size());
  for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(part[i].steps, all[i].steps) << i;
  EXPECT_TRUE(
      transport_in_basket(again, some, world_->tolerance, no_sink, [] { return false; }).size() <=
      1)
      << "only what starts outside is complete";
  EXPECT_TRUE(transport_in_basket(again, {}, world_->tolerance, no_sink, always).empty());
}

}  // namespace
}  // namespace navjit

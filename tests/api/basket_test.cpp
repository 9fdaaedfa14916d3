// Many tracks stepped at once make the same steps as one by one.
#include "navjit/basket.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "navjit/runtime.hpp"
#include "tests/support/traces.hpp"

namespace navjit {
namespace {

using tests::uniform;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Tracks as a simulation holds them, in arrays, with the answers.
struct Arrays {
  std::vector<State> state, next;
  std::vector<double> x, y, z, u, v, w, limit, length;
  std::vector<std::uint8_t> boundary;

  explicit Arrays(std::size_t k)
      : state(k), next(k), x(k), y(k), z(k), u(k), v(k), w(k), limit(k), length(k), boundary(k) {}
  std::size_t size() const { return state.size(); }
  Tracks tracks() const { return {state, x, y, z, u, v, w, limit}; }
  Steps steps() { return {length, boundary, next}; }
  Vec3 point(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Vec3 direction(std::size_t i) const { return {u[i], v[i], w[i]}; }
  void set(std::size_t i, const State& s, const Vec3& p, const Vec3& d) {
    state[i] = s;
    x[i] = p.x, y[i] = p.y, z[i] = p.z;
    u[i] = d.x, v[i] = d.y, w[i] = d.z;
  }
  void swap(std::size_t a, std::size_t b) {
    std::swap(state[a], state[b]);
    for (auto* numbers : {&x, &y, &z, &u, &v, &w}) std::swap((*numbers)[a], (*numbers)[b]);
  }
};

class BasketApi : public ::testing::TestWithParam<JitMode> {
 protected:
  BasketApi() : runtime_(tests::mixed_world(), {.jit = GetParam()}), one_(runtime_.navigator()) {}

  Vec3 anywhere() {
    return {uniform(random_, -120, 120), uniform(random_, -99, 99), uniform(random_, -99, 99)};
  }
  /// Some start outside the world.
  Arrays tracks(std::size_t k) {
    Arrays arrays(k);
    for (std::size_t i = 0; i < k; ++i) {
      const Vec3 point = anywhere(), direction = tests::random_direction(random_);
      arrays.set(i, one_.locate(point, direction), point, direction);
    }
    return arrays;
  }
  /// Steps of all tracks, compared with those that they make one by one; then they are there.
  void step(Basket& basket, Arrays& a) {
    for (double& limit : a.limit) {
      limit = random_() % 3 == 0 ? infinity : -10 * std::log(1 - uniform(random_, 0, 1));
    }
    basket.step(a.tracks(), a.steps());
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!a.state[i].inside()) {
        ASSERT_EQ(a.length[i], 0);
        ASSERT_EQ(a.boundary[i], 0);
        ASSERT_FALSE(a.next[i].inside());
        continue;
      }
      const Step right = one_.step(a.state[i], a.point(i), a.direction(i), a.limit[i]);
      ASSERT_TRUE(kernels::same_bits(a.length[i], right.length)) << i;
      ASSERT_EQ(a.boundary[i] != 0, right.boundary);
      ASSERT_EQ(a.next[i], right.next);
      if (right.next.inside()) {
        ASSERT_EQ(a.next[i].volume(), right.next.volume());
      }
      const Vec3 end = a.point(i) + right.length * a.direction(i);
      a.set(i, right.next, end, right.boundary ? a.direction(i) : tests::random_direction(random_));
      ++steps_;
    }
  }
  /// Refused, for this reason, with nothing written.
  void refused(Basket& basket, Arrays& a, const std::string& why) {
    std::fill(a.length.begin(), a.length.end(), -7);
    try {
      basket.step(a.tracks(), a.steps());
      ADD_FAILURE() << "not refused: " << why;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
    for (const double length : a.length) EXPECT_EQ(length, -7);
  }

  Runtime runtime_;
  Navigator one_;
  std::mt19937_64 random_{11};
  std::uint64_t steps_ = 0;
};

TEST_P(BasketApi, HasTheBitsOfOneByOne) {
  for (const std::size_t k : {1U, 2U, 3U, 8U, 64U, 257U}) {
    Basket basket = runtime_.basket(k);
    EXPECT_EQ(basket.places(), k);
    steps_ = 0;
    while (steps_ < 2000) {
      Arrays arrays = tracks(k);
      for (int n = 0; n < 30; ++n) step(basket, arrays);
    }
    EXPECT_EQ(basket.counts().differences, 0U);
  }
}

TEST_P(BasketApi, TracksThatKeepTheirPlaceAreNotRestored) {
  Basket basket = runtime_.basket(32);
  Arrays arrays = tracks(32);
  const auto inside = static_cast<std::uint64_t>(std::count_if(
      arrays.state.begin(), arrays.state.end(), [](const State& s) { return s.inside(); }));
  for (int n = 0; n < 20; ++n) step(basket, arrays);
  EXPECT_EQ(basket.counts().restored, inside) << "once each, where they began";
}

TEST_P(BasketApi, ALocatedTrackBeginsInItsPlace) {
  Basket basket = runtime_.basket(32);
  Arrays arrays = tracks(32);
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(basket.locate(i, arrays.point(i), arrays.direction(i)), arrays.state[i]);
  }
  for (int n = 0; n < 20; ++n) step(basket, arrays);
  EXPECT_EQ(basket.counts().restored, 0U);
}

TEST_P(BasketApi, TracksMayChangePlaces) {
  Basket basket = runtime_.basket(40);
  Arrays arrays = tracks(40);
  for (int n = 0; n < 20; ++n) {
    step(basket, arrays);
    for (std::size_t i = 1; i < arrays.size(); ++i) arrays.swap(i, random_() % (i + 1));
  }
  EXPECT_GT(basket.counts().restored, 100U);
}

TEST_P(BasketApi, ArraysMayBeLongerAndShorterThanTheBasket) {
  Basket basket = runtime_.basket(7);
  for (const std::size_t k : {50U, 3U, 0U, 7U, 8U}) {
    Arrays arrays = tracks(k);
    for (int n = 0; n < 10; ++n) step(basket, arrays);
  }
}

TEST_P(BasketApi, StatesMayBeReplacedWhereTheyAre) {
  Basket basket = runtime_.basket(64), other = runtime_.basket(64);
  Arrays apart = tracks(64), in_place = apart;
  std::fill(apart.limit.begin(), apart.limit.end(), infinity);
  other.step(apart.tracks(), apart.steps());
  // Without limits at all.
  const Tracks tracks{in_place.state, in_place.x, in_place.y, in_place.z,
                      in_place.u,     in_place.v, in_place.w};
  basket.step(tracks, {in_place.length, in_place.boundary, in_place.state});
  EXPECT_EQ(in_place.state, apart.next);
  EXPECT_EQ(in_place.length, apart.length);
}

TEST_P(BasketApi, BadTracksAreNamedAndNoneIsMade) {
  Basket basket = runtime_.basket(8);
  const Vec3 point{-60, -40, 4};
  const State state = one_.locate(point, {0, 0, 1});
  ASSERT_TRUE(state.inside());
  Arrays good(8);
  for (std::size_t i = 0; i < 8; ++i) {
    good.set(i, state, point, {0, 0, 1});
    good.limit[i] = 1;
  }
  for (const double bad : {nan, infinity, -infinity}) {
    Arrays a = good;
    a.y[5] = bad;
    refused(basket, a, "track 5: the point is not finite");
  }
  for (const double bad : {nan, infinity, 0.0, 1.1}) {
    Arrays a = good;
    a.w[3] = bad;
    refused(basket, a, "track 3: the direction is not a unit vector");
  }
  for (const double bad : {nan, -1.0}) {
    Arrays a = good;
    a.limit[7] = bad;
    refused(basket, a, "track 7: the step limit is negative, or no number");
    a.state[7] = State{};  // of those outside nothing is asked
    EXPECT_NO_THROW(basket.step(a.tracks(), a.steps()));
  }
  Arrays foreign = good;
  foreign.state[2] = State(0, 1U << 30U);
  refused(basket, foreign, "of another world");
  // Large, and finite: their sum is not.
  Arrays far = good;
  far.x[0] = far.y[0] = far.z[0] = std::numeric_limits<double>::max();
  EXPECT_NO_THROW(basket.step(far.tracks(), far.steps()));
  EXPECT_NO_THROW(basket.step(good.tracks(), good.steps())) << "as good as it was";
  EXPECT_EQ(good.length[0], one_.step(state, point, {0, 0, 1}, 1).length);
}

TEST_P(BasketApi, ArraysAreOfOneLength) {
  Basket basket = runtime_.basket(8);
  const auto short_by_one = [&](auto Arrays::*array, const std::string& name) {
    Arrays a = tracks(8);
    (a.*array).pop_back();
    refused(basket, a, "the array " + name + " has 7 elements, and there are 8 tracks");
  };
  short_by_one(&Arrays::x, "x");
  short_by_one(&Arrays::y, "y");
  short_by_one(&Arrays::z, "z");
  short_by_one(&Arrays::u, "u");
  short_by_one(&Arrays::v, "v");
  short_by_one(&Arrays::w, "w");
  short_by_one(&Arrays::limit, "limit");
  short_by_one(&Arrays::boundary, "boundary");
  short_by_one(&Arrays::next, "next");
  try {
    basket.locate(8, {0, 0, 0}, {0, 0, 1});
    ADD_FAILURE() << "there is no place 8";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "there is no place 8 in this basket: its 8 places count from 0; make a larger one "
                 "by Runtime::basket() for more");
  }
  EXPECT_THROW(basket.locate(0, {nan, 0, 0}, {0, 0, 1}), UsageError);
  EXPECT_THROW(runtime_.basket(0), UsageError);
}

INSTANTIATE_TEST_SUITE_P(Modes, BasketApi,
                         ::testing::Values(JitMode::off, JitMode::on, JitMode::wait,
                                           JitMode::shadow),
                         [](const auto& mode) -> std::string {
                           switch (mode.param) {
                             case JitMode::off:
                               return "Generic";
                             case JitMode::on:
                               return "Swapped";
                             case JitMode::wait:
                               return "Specialised";
                             case JitMode::shadow:
                               return "Compared";
                           }
                           return "";
                         });

}  // namespace
}  // namespace navjit

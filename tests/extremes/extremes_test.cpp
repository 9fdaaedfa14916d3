// The extremes, each with the generic navigator and with specialised ones.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/extremes/outcome.hpp"

namespace navjit::extremes {

void PrintTo(const Case& extreme, std::ostream* out) { *out << extreme.name; }

namespace {

std::string where(const accuracy::EngineFigures& figures) {
  std::string text;
  for (const accuracy::WorstStep& w : figures.wrong) {
    char line[600];
    const Vec3 &p = w.point, &v = w.ray.direction;
    std::snprintf(line, sizeof line,
                  "\n  ray %zu step %zu in %s from (%a, %a, %a) along (%a, %a, %a): %.17g mm, the "
                  "reference's %.17g",
                  w.ray_index, w.judged.step, w.claim.c_str(), p.x, p.y, p.z, v.x, v.y, v.z,
                  w.length, w.judged.reference);
    text += line;
  }
  return text;
}

void expect_right(const Outcome& outcome) {
  EXPECT_EQ(outcome.figures.stuck, 0u);
  EXPECT_EQ(outcome.figures.lost, 0u);
  EXPECT_EQ(outcome.figures.all.wrong_volume, 0u) << where(outcome.figures);
  EXPECT_EQ(outcome.figures.all.wrong_end, 0u) << where(outcome.figures);
}

class Extremes : public ::testing::TestWithParam<Case> {};

TEST_P(Extremes, AreNavigatedOrRefused) {
  const Outcomes outcomes = run_case(GetParam());
  if (GetParam().refused) {
    EXPECT_EQ(outcomes.generic.figures.rays, 0u) << "a ray was taken that makes no sense";
    EXPECT_EQ(outcomes.specialised.figures.rays, 0u) << "a ray was taken that makes no sense";
    EXPECT_GT(outcomes.generic.refused, 10u);
    return;
  }
  EXPECT_EQ(outcomes.generic.refused, 0u);
  EXPECT_EQ(outcomes.specialised.differing, 0u)
      << ::testing::PrintToString(outcomes.specialised.differences);
  EXPECT_GT(outcomes.generic.figures.made, 100u);
  EXPECT_GT(outcomes.specialised_scenes, 0u) << "nothing was specialised: nothing was shown";
  expect_right(outcomes.generic);
  const std::string& name = GetParam().name;
  const bool bounds_known = !name.starts_with("tori") && !name.starts_with("cones");
  EXPECT_EQ(outcomes.generic.figures.bounded > 0, bounds_known);
  EXPECT_EQ(outcomes.generic.figures.beyond_bound, 0u)
      << outcomes.generic.figures.largest_part << " times its bound";
  expect_right(outcomes.specialised);
}

std::string test_name(const ::testing::TestParamInfo<Case>& info) {
  std::string name;
  for (const char c : info.param.name) {
    const bool letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (c == '-') name += "minus";
    if (letter || (!name.empty() && name.back() != '_')) name += letter ? c : '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Cases, Extremes, ::testing::ValuesIn(all_cases(false)), test_name);

}  // namespace
}  // namespace navjit::extremes

// Radiation lengths against those of the Review of Particle Physics (table of atomic and nuclear
// properties), which were computed with a finer Coulomb correction.
#include "navjit/material.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace navjit {
namespace {

TEST(RadiationLength, OfElements) {
  struct Element {
    const char* name;
    double z, a, grams_per_cm2;
  };
  for (const Element& e : {Element{"H", 1, 1.008, 63.04}, Element{"He", 2, 4.0026, 94.32},
                           Element{"Li", 3, 6.94, 82.78}, Element{"Be", 4, 9.01218, 65.19},
                           Element{"C", 6, 12.0107, 42.70}, Element{"N", 7, 14.007, 37.99},
                           Element{"O", 8, 15.999, 34.24}, Element{"Al", 13, 26.98154, 24.01},
                           Element{"Si", 14, 28.0855, 21.82}, Element{"Ar", 18, 39.948, 19.55},
                           Element{"Fe", 26, 55.845, 13.84}, Element{"Cu", 29, 63.546, 12.86},
                           Element{"W", 74, 183.84, 6.76}, Element{"Pb", 82, 207.2, 6.37},
                           Element{"U", 92, 238.0289, 6.00}}) {
    EXPECT_NEAR(radiation_length(e.z, e.a) / e.grams_per_cm2, 1, 0.01) << e.name;
  }
}

TEST(RadiationLength, OfMixturesAndCompounds) {
  const std::vector<MaterialComponent> water{{1, 1.008, 2 * 1.008}, {8, 15.999, 15.999}};
  EXPECT_NEAR(radiation_length(water) / 36.08, 1, 0.01);
  const std::vector<MaterialComponent> air{
      {6, 12.0107, 0.000124}, {7, 14.007, 0.755267}, {8, 15.999, 0.231781}, {18, 39.948, 0.012827}};
  EXPECT_NEAR(radiation_length(air) / 36.62, 1, 0.01);
  const std::vector<MaterialComponent> tungstate{
      {82, 207.2, 207.2}, {74, 183.84, 183.84}, {8, 15.999, 4 * 15.999}};
  EXPECT_NEAR(radiation_length(tungstate) / 7.39, 1, 0.01);
}

TEST(RadiationLength, IsZeroWhereNothingIsKnown) {
  EXPECT_EQ(radiation_length(0, 1), 0);
  EXPECT_EQ(radiation_length(-3, 1), 0);
  EXPECT_EQ(radiation_length(1, 0), 0);
  EXPECT_EQ(radiation_length(NAN, 1), 0);
  EXPECT_EQ(radiation_length(1, INFINITY), 0);
  EXPECT_EQ(radiation_length(std::vector<MaterialComponent>{}), 0);
  EXPECT_EQ(radiation_length(std::vector<MaterialComponent>{{1, 1, 1}, {0, 1, 1}}), 0);
}

}  // namespace
}  // namespace navjit

// Detectors made in code are checked while they grow, and are never half finished.
#include "navjit/builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "navjit/runtime.hpp"

namespace navjit {
namespace {

DetectorBuilder::MaterialId add_lead(DetectorBuilder& builder) {
  const auto pb = builder.element({.name = "Pb", .z = 82, .a = 207.2});
  return builder.material({.name = "Lead", .density = 11.35, .elements = {{pb, 1}}});
}

TEST(Builder, MakesADetectorThatIsNavigated) {
  DetectorBuilder builder;
  const auto material = add_lead(builder);
  const auto hall = builder.volume("hall", make_box("hall", 100, 100, 100), material);
  const auto box = builder.volume("box", make_box("box", 1, 2, 3), material);
  EXPECT_EQ(builder.place(box, hall, placed_at({10, 0, 0}, {0, 0, M_PI / 2}), 7), 0U);
  EXPECT_EQ(builder.place(box, hall, placed_at({30, 0, 0}), 8, "second"), 1U);
  const Detector detector = builder.build(hall);
  Runtime runtime{detector, {.jit = JitMode::off}};
  Navigator navigator = runtime.navigator();
  const State state = navigator.locate({0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(detector.path_of(state), "hall");
  const Step step = navigator.step(state, {0, 0, 0}, {1, 0, 0});
  EXPECT_NEAR(step.length, 8, 1e-12);  // turned: 2 mm along x
  EXPECT_EQ(detector.path_of(step.next), "hall/box_0");
  EXPECT_EQ(detector.copy_number(step.next), 7);
  EXPECT_EQ(detector.path_of(navigator.locate({30, 0, 0})), "hall/second");
}

TEST(Builder, KeepsWhatMaterialsAreMadeOf) {
  DetectorBuilder builder;
  const auto pure = add_lead(builder);
  const auto proton = builder.isotope({.name = "H1", .z = 1, .nucleons = 1, .a = 1.008});
  const auto hydrogen =
      builder.element({.name = "H", .z = 1, .a = 1.008, .isotopes = {{proton, 1}}});
  const auto oxygen = builder.element({.name = "O", .z = 8, .a = 15.999});
  const auto mixed = builder.material({.name = "Water",
                                       .density = 1,
                                       .state = MaterialState::liquid,
                                       .elements = {{hydrogen, 2.016}, {oxygen, 15.999}}});
  const auto given = builder.material({.name = "Odd", .density = 2, .radiation_length = 5});
  const auto unknown = builder.material({.name = "Unknown"});
  const Detector detector = builder.build(builder.volume("v", make_orb("v", 1), mixed));
  // The Review of Particle Physics has 5.612 mm and 360.8 mm.
  EXPECT_NEAR(detector.material(pure).radiation_length, 5.612, 0.02);
  EXPECT_NEAR(detector.material(mixed).radiation_length, 360.8, 2);
  EXPECT_EQ(detector.material(given).radiation_length, 5);
  EXPECT_EQ(detector.material(unknown).radiation_length, 0);
  const auto& shares = detector.material(mixed).elements;
  ASSERT_EQ(shares.size(), 2U);
  const Element& first = detector.element(shares[0].element);
  EXPECT_EQ(first.name, "H");
  ASSERT_EQ(first.isotopes.size(), 1U);
  EXPECT_EQ(detector.isotope(first.isotopes[0].isotope).name, "H1");
  EXPECT_NEAR(shares[0].fraction, 0.1119, 1e-4);
  EXPECT_EQ(shares[0].fraction + shares[1].fraction, 1);
  EXPECT_EQ(detector.elements(), 3U);
  EXPECT_EQ(detector.isotopes(), 1U);
  EXPECT_THROW(detector.element(3), UsageError);
  EXPECT_THROW(detector.isotope(1), UsageError);
  EXPECT_EQ(detector.auxiliaries(), nullptr);
}

TEST(Builder, RefusesWhatCannotBeAtOnceAndGoesOn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  DetectorBuilder builder;
  EXPECT_THROW(builder.build(0), GeometryError);
  EXPECT_THROW(builder.material({.name = "m", .density = -1}), GeometryError);
  EXPECT_THROW(builder.material({.name = "m", .density = nan}), GeometryError);
  EXPECT_THROW(builder.isotope({.name = "i", .a = -1}), GeometryError);
  EXPECT_THROW(builder.element({.name = "e", .z = nan}), GeometryError);
  EXPECT_THROW(builder.element({.name = "e", .isotopes = {{0, 1}}}), GeometryError);
  EXPECT_THROW(builder.material({.name = "m", .elements = {{0, 1}}}), GeometryError);
  const auto element = builder.element({.name = "e", .z = 1, .a = 1});
  EXPECT_THROW(builder.material({.name = "m", .elements = {{element, 0}}}), GeometryError);
  EXPECT_THROW(builder.material({.name = "m", .elements = {{element, nan}}}), GeometryError);
  EXPECT_THROW(builder.volume("v", make_orb("v", 1), 0), GeometryError);
  const auto material = add_lead(builder);
  EXPECT_EQ(material, 0U);
  EXPECT_THROW(builder.volume("v", Solid{}, material), GeometryError);
  const auto outer = builder.volume("outer", make_orb("outer", 9), material);
  const auto inner = builder.volume("inner", make_orb("inner", 3), material);
  EXPECT_EQ(outer, 0U);
  EXPECT_THROW(builder.place(outer, outer), GeometryError);
  EXPECT_THROW(builder.place(inner, 2), GeometryError);
  EXPECT_THROW(builder.place(2, outer), GeometryError);
  EXPECT_THROW(builder.place(inner, outer, placed_at({nan, 0, 0})), GeometryError);
  Transformation sheared;
  sheared.rotation[1] = 0.1;
  EXPECT_THROW(builder.place(inner, outer, sheared), GeometryError);
  EXPECT_EQ(builder.place(inner, outer), 0U);
  EXPECT_THROW(builder.place(outer, inner), GeometryError);
  EXPECT_THROW(builder.set_user_data(2, 1), GeometryError);
  EXPECT_THROW(builder.set_user_data(outer, 1, 1), GeometryError);
  EXPECT_THROW(builder.add_auxiliary(2, {}), GeometryError);
  EXPECT_THROW(builder.add_auxiliary(inner, 0, {}), GeometryError);
  EXPECT_THROW(builder.build(2), GeometryError);
  const Detector detector = builder.build(outer);
  EXPECT_EQ(detector.volumes(), 2U);
  EXPECT_EQ(detector.touchables(), 2U);
}

TEST(Builder, RefusesTreesThatAreTooDeep) {
  DetectorBuilder builder;
  const auto material = add_lead(builder);
  VolumeId last = builder.volume("0", make_orb("0", 1), material);
  const VolumeId deepest = last;
  for (int i = 1; i < 65; ++i) {
    const std::string name = std::to_string(i);
    const VolumeId next = builder.volume(name, make_orb(name, 1 + i), material);
    builder.place(last, next);
    last = next;
    if (i == 63) {
      EXPECT_NO_THROW(builder.build(last));
    }
  }
  EXPECT_THROW(builder.build(last), GeometryError);
  EXPECT_NO_THROW(builder.build(deepest));
}

TEST(Builder, AddsToADetectorWithoutChangingIt) {
  DetectorBuilder first;
  const auto material = add_lead(first);
  const auto hall = first.volume("hall", make_box("hall", 10, 10, 10), material);
  const auto box = first.volume("box", make_box("box", 1, 1, 1), material);
  const auto at = first.place(box, hall);
  const Detector before = first.build(hall);
  DetectorBuilder second(before);
  second.set_user_data(box, 5);
  second.set_user_data(hall, at, 6);
  second.add_auxiliary(box, {.type = "SensDet", .value = "calorimeter"});
  second.add_auxiliary(hall, at,
                       {.type = "row", .value = "3", .unit = "", .children = {{"a", "b"}}});
  const Detector after = second.build(hall);
  EXPECT_EQ(before.volume(box).user_data, 0U);
  EXPECT_FALSE(before.volume(box).auxiliaries);
  EXPECT_EQ(after.volume(box).user_data, 5U);
  EXPECT_EQ(after.volume(hall).daughters[at].user_data, 6U);
  EXPECT_EQ(find_auxiliary(after.volume(box).auxiliaries, "SensDet")->value, "calorimeter");
  EXPECT_EQ(after.volume(hall).daughters[at].auxiliaries->at(0).children.at(0).type, "a");
  EXPECT_EQ(find_auxiliary(after.volume(box).auxiliaries, "row"), nullptr);
  EXPECT_EQ(find_auxiliary(after.volume(hall).auxiliaries, "row"), nullptr);
  // States are the same in both.
  EXPECT_EQ(before.state_at(std::vector<std::uint32_t>{at}),
            after.state_at(std::vector<std::uint32_t>{at}));
}

}  // namespace
}  // namespace navjit

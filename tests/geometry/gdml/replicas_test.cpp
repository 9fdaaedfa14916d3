// Compares divisionvol and replicavol with the placements that they stand for.
#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

/// A world of 60 x 20 x 20 mm with these daughters; slices of 20 x 20 x 20 fit.
class GdmlReplicas : public GdmlFiles {
 protected:
  static Gdml long_box(const std::string& daughters) {
    return {.solids = "<box name='long' x='60' y='20' z='20'/>",
            .structure = "<volume name='W'><materialref ref='G4_AIR'/><solidref ref='long'/>" +
                         daughters + "</volume>"};
  }
  static Gdml divided(const std::string& attributes, const std::string& name = "") {
    return long_box("<divisionvol" + name + " axis='kXAxis' " + attributes +
                    "><volumeref ref='D'/></divisionvol>");
  }
  static Gdml replicated(const std::string& number, const std::string& along) {
    return long_box("<replicavol number='" + number +
                    "'><volumeref ref='D'/><replicate_along_axis>" + along +
                    "</replicate_along_axis></replicavol>");
  }
};

TEST_F(GdmlReplicas, DivideBoxes) {
  for (const char* attributes : {"number='3' width='2' unit='cm' offset='0'", "number='3'",
                                 "width='20' unit='mm'", "width='19.99999999999'"}) {
    const World world = read(divided(attributes));
    ASSERT_EQ(top(world).daughters.size(), 3u) << attributes;
    for (int i = 0; i < 3; ++i) {
      const Placement& p = top(world).daughters[static_cast<std::size_t>(i)];
      EXPECT_EQ(p.name, "D_PV_" + std::to_string(i));
      EXPECT_EQ(p.copy_number, i);
      EXPECT_EQ(p.volume, 0u);
      EXPECT_FALSE(p.transformation.rotated);
      EXPECT_NEAR(p.transformation.translation[0], -20 + 20 * i, 1e-9);
      EXPECT_EQ(p.transformation.translation[1], 0);
    }
  }
  const World shifted = read(divided("number='2' width='20' offset='15'", " name='slice'"));
  EXPECT_EQ(top(shifted).daughters[1].name, "slice_1");
  EXPECT_EQ(top(shifted).daughters[1].transformation.translation[0], 15);
}

TEST_F(GdmlReplicas, ImposeTheShapeOfTheSlice) {
  const World world = read(divided("number='6'"));
  ASSERT_EQ(world.volumes.size(), 3u);
  const LogicalVolume& slice = world.volumes[top(world).daughters[0].volume];
  EXPECT_EQ(slice.name, "D");
  EXPECT_EQ(slice.solid.extent.max.x, 5);
  EXPECT_EQ(slice.solid.extent.max.y, 10);
  EXPECT_EQ(world.volumes[0].solid.extent.max.x, 10) << "the volume itself stays";
}

TEST_F(GdmlReplicas, ReplicateAlongAndAroundAxes) {
  const World along = read(replicated(
      "3", "<direction x='1'/><width value='20' unit='mm'/><offset value='7' unit='mm'/>"));
  ASSERT_EQ(top(along).daughters.size(), 3u);
  EXPECT_EQ(top(along).daughters[0].transformation.translation[0], -20);
  EXPECT_EQ(top(along).daughters[2].transformation.translation[0], 20);
  const World around = read(replicated(
      "4", "<direction phi='1'/><width value='90' unit='deg'/><offset value='-45' unit='deg'/>"));
  ASSERT_EQ(top(around).daughters.size(), 4u);
  EXPECT_FALSE(top(around).daughters[0].transformation.rotated);
  // The second copy's own x axis is the mother's y axis.
  const Vec3 p = to_local(top(around).daughters[1].transformation, Vec3{0, 5, 1});
  EXPECT_EQ(p.x, 5);
  EXPECT_EQ(p.y, 0);
  EXPECT_EQ(p.z, 1);
}

TEST_F(GdmlReplicas, TakeUnitsOfTheOtherKindAsGeant4Does) {
  // Programs write quarter turns so.
  GdmlReport report;
  const World around =
      read(replicated("4",
                      "<direction phi='1'/><width value='1.5707963267948966' unit='mm'/>"
                      "<offset value='-pi/4' unit='mm'/>"),
           &report);
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_HAS(report.notes[0], "took millimetres for radians, as Geant4");
  ASSERT_EQ(top(around).daughters.size(), 4u);
  const Vec3 p = to_local(top(around).daughters[1].transformation, Vec3{0, 5, 1});
  EXPECT_EQ(p.x, 5);
  EXPECT_EQ(p.y, 0);
  GdmlReport of_lengths;
  const World along =
      read(replicated("3", "<direction x='1'/><width value='20' unit='rad'/>"), &of_lengths);
  ASSERT_EQ(of_lengths.notes.size(), 1u);
  EXPECT_HAS(of_lengths.notes[0], "took radians for millimetres, as Geant4");
  EXPECT_EQ(top(along).daughters[2].transformation.translation[0], 20);
}

TEST_F(GdmlReplicas, RefusesWhatTheyCannotBe) {
  EXPECT_HAS(error_of(divided("")), "it needs a number or a width");
  EXPECT_HAS(error_of(divided("number='-1'")), "must not be negative");
  EXPECT_HAS(error_of(divided("number='4' width='20'")), "the slices reach out of the mother");
  EXPECT_HAS(error_of(divided("number='3' offset='100'")), "the slices reach out of the mother");
  EXPECT_HAS(error_of(divided("width='100'")), "it makes no copies");
  EXPECT_HAS(error_of(divided("width='1e-300'")), "it makes no copies");
  EXPECT_HAS(error_of(divided("number='1000000000'")), "placements");
  EXPECT_HAS(error_of(long_box("<divisionvol axis='kPhi' number='2'><volumeref ref='D'/>"
                               "</divisionvol>")),
             "unsupported structure 'divisionvol'");
  EXPECT_HAS(error_of(long_box("<divisionvol axis='kXAxis' number='2'/>")), "no <volumeref>");
  EXPECT_HAS(error_of(replicated("0", "<direction x='1'/><width value='1'/>")), "no copies");
  EXPECT_HAS(error_of(replicated("2", "<direction rho='1'/><width value='1'/>")),
             "unsupported replicas along rho in a mother that is no tube");
  EXPECT_HAS(error_of(replicated("2", "<direction r='1'/><width value='1'/>")),
             "unsupported direction");
  EXPECT_HAS(error_of(replicated("2", "<direction x='1'/>")), "no <width>");
  EXPECT_HAS(error_of(replicated("2", "<direction x='1'/><width value='1' unit='g'/>")),
             "is not a unit of length");
}

}  // namespace
}  // namespace navjit::testing

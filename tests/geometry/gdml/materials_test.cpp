// Materials by atoms, by fractions and by isotopes; their states and radiation lengths.
#include <algorithm>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

class GdmlMaterials : public GdmlFiles {
 protected:
  /// The material 'M' of this text.
  Material material(const std::string& materials, GdmlReport* report = nullptr) const {
    return read(
               "<gdml><define><quantity name='rho' value='1' unit='g/cm3'/><quantity name='t' "
               "value='100' unit='kelvin'/></define><materials>" +
                   materials +
                   "</materials><solids><box name='b' x='2' y='2' "
                   "z='2'/></solids><structure><volume "
                   "name='W'><materialref ref='M'/><solidref ref='b'/></volume></structure><setup "
                   "name='s' version='1'><world ref='W'/></setup></gdml>",
               report)
        .materials.back();
  }
};

const std::string hydrogen =
    "<element name='H' formula='H' Z='1'><atom value='1.008' unit='g/mole'/></element>";
const std::string oxygen = "<element name='O' Z='8'><atom value='15.999'/></element>";

TEST_F(GdmlMaterials, SimpleOnes) {
  struct Simple {
    const char* name;
    double z, a, density, centimetres;
  };
  for (const Simple& s :
       {Simple{"Pb", 82, 207.2, 11.35, 0.5612}, Simple{"Fe", 26, 55.845, 7.874, 1.757},
        Simple{"Si", 14, 28.0855, 2.329, 9.370}, Simple{"Al", 13, 26.98154, 2.699, 8.897},
        Simple{"Cu", 29, 63.546, 8.96, 1.436}}) {
    const Material m =
        material("<material name='M' Z='" + std::to_string(s.z) + "'><D unit='g/cm3' value='" +
                 std::to_string(s.density) + "'/><atom unit='g/mole' value='" +
                 std::to_string(s.a) + "'/></material>");
    EXPECT_NEAR(m.radiation_length / (10 * s.centimetres), 1, 0.01) << s.name;
  }
}

TEST_F(GdmlMaterials, WaterHoweverItIsGiven) {
  const std::string rest[] = {
      "<D value='1'/><composite n='2' ref='H'/><composite n='1' ref='O'/>",
      "<Dref ref='rho'/><fraction n='0.111898' ref='H'/><fraction n='0.888102' ref='O'/>",
      "<D value='1000' unit='kg/m3'/><fraction n='11.1898' ref='H'/><fraction n='88.8102' "
      "ref='O'/>",
      "<D value='1'/><fraction n='1' ref='steam'/>"};
  const std::string steam =
      "<material name='steam' state='gas'><D value='0.001'/><composite n='2' ref='H'/>"
      "<composite n='1' ref='O'/></material>";
  for (const std::string& how : rest) {
    const Material m = material(hydrogen + oxygen + steam + "<material name='M' state='liquid'>" +
                                how + "</material>");
    EXPECT_EQ(m.density, 1) << how;
    EXPECT_NEAR(m.radiation_length / 360.8, 1, 0.01) << how;
    EXPECT_EQ(m.state, MaterialState::liquid);
  }
}

TEST_F(GdmlMaterials, ElementsOfIsotopes) {
  const Material m = material(
      "<isotope name='Cu63' Z='29' N='63'><atom value='62.93' unit='g/mole'/></isotope>"
      "<isotope name='Cu65' Z='29' N='65'><atom value='0.06493' unit='kg/mole'/></isotope>"
      "<element name='Cu'><fraction ref='Cu63' n='0.6917'/><fraction ref='Cu65' "
      "n='0.3083'/></element>"
      "<material name='M'><D value='8.96'/><fraction n='1' ref='Cu'/></material>");
  EXPECT_NEAR(m.radiation_length / 14.36, 1, 0.01);
}

TEST_F(GdmlMaterials, StateTemperatureAndPressure) {
  const Material m = material(
      "<material name='M' Z='18' state='gas'><T value='87' unit='K'/><P value='2' "
      "unit='bar'/><D value='1'/><atom value='39.948'/></material>");
  EXPECT_EQ(m.state, MaterialState::gas);
  EXPECT_EQ(m.temperature, 87);
  EXPECT_NEAR(m.pressure, 2e5, 1e-6);
  const Material other = material(
      "<material name='M' Z='18'><Tref ref='t'/><D value='1'/><atom value='40'/></material>");
  EXPECT_EQ(other.temperature, 100);
  EXPECT_EQ(other.pressure, 101325);
  EXPECT_EQ(other.state, MaterialState::undefined);
}

TEST_F(GdmlMaterials, ElementsMayFollow) {
  const Material m = material(
      "<material name='M'><D value='1'/><composite n='2' ref='H'/><composite n='1' ref='O'/>"
      "</material>" +
      hydrogen + oxygen);
  EXPECT_NEAR(m.radiation_length / 360.8, 1, 0.01);
}

TEST_F(GdmlMaterials, CompositionIsKept) {
  const World world =
      read("<gdml><materials>" + hydrogen + oxygen +
           "<isotope name='U235' Z='92' N='235'><atom value='235.04'/></isotope><isotope "
           "name='U238' Z='92' N='238'><atom value='238.05'/></isotope><element name='U' "
           "formula='U'><fraction ref='U235' n='0.25'/><fraction ref='U238' n='0.75'/></element>"
           "<material name='water'><D value='1'/><composite n='2' ref='H'/><composite n='1' "
           "ref='O'/></material><material name='mix'><D value='2'/><fraction n='0.5' ref='water'/>"
           "<fraction n='0.25' ref='O'/><fraction n='0.25' ref='U'/></material><material "
           "name='Pb' Z='82'><D value='11.35'/><atom value='207.2'/></material></materials><solids>"
           "<box name='b' x='2' y='2' z='2'/></solids><structure><volume name='W'><materialref "
           "ref='mix'/><solidref ref='b'/></volume></structure><setup name='s' version='1'><world "
           "ref='W'/></setup></gdml>");
  const Material& mix = world.materials[top(world).material];
  ASSERT_EQ(mix.elements.size(), 3u);
  const auto element = [&](const ElementShare& share) { return world.elements[share.element]; };
  EXPECT_EQ(element(mix.elements[0]).name, "H");
  EXPECT_EQ(element(mix.elements[0]).formula, "H");
  EXPECT_EQ(element(mix.elements[0]).z, 1);
  EXPECT_NEAR(mix.elements[0].fraction, 0.5 * 0.111898, 1e-5);
  EXPECT_EQ(element(mix.elements[1]).name, "O");
  EXPECT_DOUBLE_EQ(element(mix.elements[1]).a, 15.999);
  EXPECT_NEAR(mix.elements[1].fraction, 0.5 * 0.888102 + 0.25, 1e-5);
  const Element uranium = element(mix.elements[2]);
  EXPECT_EQ(uranium.name, "U");
  EXPECT_EQ(uranium.z, 92);
  EXPECT_NEAR(uranium.a, 0.25 * 235.04 + 0.75 * 238.05, 1e-9);
  ASSERT_EQ(uranium.isotopes.size(), 2u);
  EXPECT_EQ(uranium.isotopes[1].abundance, 0.75);
  EXPECT_EQ(world.isotopes[uranium.isotopes[1].isotope].name, "U238");
  EXPECT_EQ(world.isotopes[uranium.isotopes[1].isotope].nucleons, 238);
  const Material& lead = world.materials.back();
  ASSERT_EQ(lead.elements.size(), 1u);
  EXPECT_EQ(element(lead.elements[0]).name, "Pb");
  EXPECT_EQ(element(lead.elements[0]).z, 82);
  EXPECT_EQ(lead.elements[0].fraction, 1);
}

TEST_F(GdmlMaterials, ThoseThatAreNotDefinedKeepTheirNames) {
  GdmlReport report;
  const World world = read(
      Gdml{.structure = "<volume name='A'><materialref ref='Quartz'/><solidref ref='b'/></volume>"
                        "<volume name='B'><materialref ref='Quartz'/><solidref ref='b'/></volume>"
                        "<volume name='W'><materialref ref='G4_AIR'/><solidref ref='b'/>"
                        "<physvol><volumeref ref='A'/></physvol>"
                        "<physvol><volumeref ref='B'/></physvol></volume>"},
      &report);
  const auto material_of = [&](std::string_view volume) {
    return std::find_if(world.volumes.begin(), world.volumes.end(),
                        [&](const LogicalVolume& v) { return v.name == volume; })
        ->material;
  };
  EXPECT_EQ(material_of("A"), material_of("B"));
  EXPECT_NE(material_of("A"), material_of("W"));
  const Material& quartz = world.materials[material_of("A")];
  EXPECT_EQ(quartz.name, "Quartz");
  EXPECT_EQ(quartz.density, 0);
  EXPECT_EQ(quartz.radiation_length, 0);
  EXPECT_TRUE(quartz.elements.empty());
  ASSERT_EQ(report.notes.size(), 1U) << "once for each name";
  EXPECT_HAS(report.notes[0], "<materialref ref='Quartz'>: material 'Quartz' is not defined");
}

TEST_F(GdmlMaterials, UnknownPartsAreNoted) {
  GdmlReport report;
  const Material m =
      material("<material name='M'><D value='3'/><fraction n='1' ref='G4_H'/></material>", &report);
  EXPECT_EQ(m.density, 3);
  EXPECT_EQ(m.radiation_length, 0);
  ASSERT_EQ(report.skipped.size(), 1u);
  EXPECT_HAS(report.skipped[0], "no radiation length");
}

TEST_F(GdmlMaterials, AreFoundWithoutTheAddressInTheirNames) {
  GdmlReport report;
  const std::string lead = "<D value='11.35'/><atom value='207.2'/></material>";
  const Material mix =
      material(hydrogen +
                   "<element name='O0x55d2' Z='8'><atom value='15.999'/></element>"
                   "<material name='Lead0x7f1' Z='82'>" +
                   lead +
                   "<material name='M'><D value='1'/><fraction n='0.5' ref='Lead'/>"
                   "<fraction n='0.5' ref='O0x1'/></material>",
               &report);
  EXPECT_EQ(mix.elements.size(), 2U);
  const World world =
      read("<gdml><materials><material name='Lead0x7f1' Z='82'>" + lead +
           "<material name='Lead' Z='80'>" + lead +
           "</materials><solids><box name='b' x='2' y='2' z='2'/></solids><structure>"
           "<volume name='A'><materialref ref='Lead0x99'/><solidref ref='b'/></volume>"
           "<volume name='W'><materialref ref='Lead'/><solidref ref='b'/></volume>"
           "</structure><setup name='s' version='1'><world ref='W'/></setup></gdml>");
  EXPECT_EQ(world.materials[world.volumes[0].material].name, "Lead0x7f1")
      << "the first of its kind";
  EXPECT_EQ(world.materials[top(world).material].name, "Lead") << "its own name comes first";
}

}  // namespace
}  // namespace navjit::testing

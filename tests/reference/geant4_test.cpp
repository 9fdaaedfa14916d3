// Compares Geant4's steps in real detectors with navjit's: volumes in order, lengths to 1e-6 mm.
//
// The reference traces were made by Geant4 11.4.0 (navigation with G4Navigator, and its own GDML
// reader). Today every ray of every file that is read agrees, and none of them only after steps are
// merged. Two remarks:
// - celeritas_lead-box is 1e22 mm large. On 4 of its 300 rays (22, 29, 186, 196) Geant4 makes one
// more step of 1.1e6 to 1.4e6 mm, a last bit of its position, before it leaves the world. The
// tolerance, which is relative to the ray, takes them as the slivers that they are.
// - In overlapping volumes (lhcb_*) several answers are possible; navjit gives Geant4's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "common/rays.hpp"
#include "geometry/gdml/read_world.hpp"
#include "tests/reference/trace.hpp"

namespace navjit::reference {
namespace {

namespace fs = std::filesystem;

const fs::path data = NAVJIT_DATA_DIR;
const fs::path references = NAVJIT_REFERENCE_DIR;

/// A reference by its name, and the detector that it is for.
struct Reference {
  std::string name;
  std::string detector;  ///< below `data`

  Reference(std::string file)  // NOLINT: lists of files are lists of references
      : name(file.substr(0, file.size() - 5)), detector(std::move(file)) {
    std::replace(name.begin(), name.end(), '/', '_');
  }
  Reference(std::string n, std::string file) : name(std::move(n)), detector(std::move(file)) {}

  fs::path rays() const { return references / (name + ".rays.csv.gz"); }
  fs::path trace() const { return references / (name + ".geant4.csv.gz"); }
};

void PrintTo(const Reference& reference, std::ostream* out) { *out << reference.name; }

std::string test_name(const ::testing::TestParamInfo<Reference>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

const std::vector<Reference>& read_today() {
  static const std::vector<Reference> files = {
      {"lhcb_forward", "lhcb/LHCb_Upgrade_onlyECALandHCAL.gdml"},
      {"lhcb/LHCb_Upgrade_onlyECALandHCAL.gdml"},
      {"testem3/testEm3.gdml"},
      {"alice/znenv.gdml"},
      {"atlas/TileTB_2B1EB.gdml"},
      {"celeritas/cmse.gdml"},
      {"celeritas/field-layers.gdml"},
      {"celeritas/four-levels.gdml"},
      {"celeritas/four-steel-slabs.gdml"},
      {"celeritas/intersection-boxes.gdml"},
      {"celeritas/lar-sphere-extramat.gdml"},
      {"celeritas/lar-sphere.gdml"},
      {"celeritas/lead-box.gdml"},  // 1e22 mm large: the relative tolerance counts
      {"celeritas/multi-level.gdml"},
      {"celeritas/one-box.gdml"},
      {"celeritas/one-steel-sphere.gdml"},
      {"celeritas/simple-cms.gdml"},
      {"celeritas/testem15.gdml"},
      {"celeritas/testem3-flat.gdml"},
      {"celeritas/testem3.gdml"},
      {"celeritas/three-spheres.gdml"},
      {"celeritas/tilecal-plug.gdml"},
      {"celeritas/transformed-box.gdml"},
      {"celeritas/two-boxes.gdml"},
      {"dune/dune10kt_v1.gdml"},
      {"dune/dune10kt_v6_refactored_nowires.gdml"},
      {"dune/nd_hall_mpd_lar_ECal12sides_42l_SPY_v3_wMuID.gdml"},
      {"lhcb/lhcb_full_2006.gdml"},
      {"lhcb/lhcbvelo_2006.gdml"},
      {"scenes/alic.gdml"},
      {"scenes/cutube.gdml"},
      {"scenes/endcap30.gdml"},
      {"scenes/graphitecone.gdml"},
      {"scenes/lattice10.gdml"},
      {"scenes/mbwheel.gdml"},
      {"scenes/tpcdrift.gdml"},
      {"scenes/znst.gdml"},
      {"solids/aConstant.gdml"},
      {"solids/aPosition.gdml"},
      {"solids/aQuantity.gdml"},
      {"solids/aRotation.gdml"},
      {"solids/aVariable.gdml"},
      {"solids/auxiliary.gdml"},
      {"solids/compositeMaterial.gdml"},
      {"solids/mixtureElement.gdml"},
      {"solids/mixtureMaterial.gdml"},
      {"solids/oneArbitraryTrapezoid.gdml"},
      {"solids/oneBox.gdml"},
      {"solids/oneConeSegment.gdml"},
      {"solids/oneOrb.gdml"},
      {"solids/onePolycone.gdml"},
      {"solids/onePolyhedron.gdml"},
      {"solids/oneSphere.gdml"},
      {"solids/oneTrapezoid.gdml"},
      {"solids/oneTube.gdml"},
      {"solids/simpleMaterial.gdml"},
      {"solids/solidIntersection.gdml"},
      {"solids/solidSubtraction.gdml"},
      {"solids/solidUnion.gdml"},
      {"solids/twoBoxes.gdml"},
      {"bmn/bmn.gdml"},
      {"celeritas/solids.gdml"},
      {"cms/preshower_sf.gdml"},
      {"mu2e/mu2e.gdml"},
      {"solids/oneCutTube.gdml"},
      {"solids/oneEllipsoid.gdml"},
      {"solids/oneEllipticalCone.gdml"},
      {"solids/oneEllipticalTube.gdml"},
      {"solids/oneExtrudedSolid.gdml"},
      {"solids/oneGenericPolycone.gdml"},
      {"solids/oneGenericPolyhedron.gdml"},
      {"solids/oneHyperbolicTube.gdml"},
      {"solids/oneParaboloid.gdml"},
      {"solids/oneParallelepiped.gdml"},
      {"solids/oneTesselatedSolid.gdml"},
      {"solids/oneTetrahedron.gdml"},
      {"solids/oneTwistedBox.gdml"},
      {"solids/oneTwistedTrapezoid.gdml"},
      {"solids/scaledBox.gdml"},
      {"solids/scaledPhysvol.gdml"},
      {"solids/solidMultiUnion.gdml"},
      {"solids/unionWIthDetector.gdml"},
  };
  return files;
}

/// Files of solids for which Geant4's constructors report a fatal exception. The references were
/// made by ignoring it, with what was left of the solids; docs/gdml.md says what that was.
const std::vector<Reference>& read_otherwise() {
  static const std::vector<Reference> files = {
      {"solids/oneGeneralTrapezoid.gdml"},         // two sides are not planar
      {"solids/oneTorus.gdml"},                    // rmax > rtor
      {"solids/oneTwistedGeneralTrapezoid.gdml"},  // the same kind of side, twisted
  };
  return files;
}

/// Files that the reader refuses.
const std::vector<Reference>& refused_today() {
  static const std::vector<Reference> files = {
      {"solids/oneTwistedTube.gdml"},  // no length; the rays are NaN
  };
  return files;
}

class Geant4Reference : public ::testing::TestWithParam<Reference> {
 protected:
  void SetUp() override {
    const Reference& reference = GetParam();
    for (const fs::path& file : {data / reference.detector, reference.rays(), reference.trace()}) {
      if (!fs::exists(file)) GTEST_SKIP() << file << " is not there";
    }
  }

  static void expect_agreement(std::shared_ptr<const World> world, JitMode jit) {
    const Reference& reference = GetParam();
    const std::vector<Ray> rays = common::read_rays(reference.rays());
    const Trace theirs = read_trace(reference.trace(), rays.size());
    const Comparison result = compare(make_trace(std::move(world), rays, jit), theirs);
    EXPECT_EQ(result.differing, 0u) << result;
    EXPECT_EQ(result.merged, 0u) << result;
    EXPECT_EQ(result.stuck, 0u) << result;
    EXPECT_GT(result.steps, 0u) << "nothing was compared";
    RecordProperty("rays", std::to_string(result.rays));
  }

  static std::shared_ptr<const World> world() {
    return std::make_shared<const World>(read_world(data / GetParam().detector));
  }
};

using Geant4ReferenceRead = Geant4Reference;
TEST_P(Geant4ReferenceRead, AgreesWithGeant4) { expect_agreement(world(), JitMode::off); }
INSTANTIATE_TEST_SUITE_P(Detectors, Geant4ReferenceRead, ::testing::ValuesIn(read_today()),
                         test_name);

/// The same with every scene specialised before the first ray.
using Geant4ReferenceSpecialised = Geant4Reference;
TEST_P(Geant4ReferenceSpecialised, AgreesWithGeant4) { expect_agreement(world(), JitMode::wait); }
INSTANTIATE_TEST_SUITE_P(
    Detectors, Geant4ReferenceSpecialised,
    ::testing::Values(Reference{"lhcb_forward", "lhcb/LHCb_Upgrade_onlyECALandHCAL.gdml"},
                      Reference{"testem3/testEm3.gdml"}, Reference{"alice/znenv.gdml"},
                      Reference{"atlas/TileTB_2B1EB.gdml"}),
    test_name);

/// Files that navjit reads in its own way: rays get through, in both modes alike.
using Geant4ReferenceOtherwise = Geant4Reference;
TEST_P(Geant4ReferenceOtherwise, IsRead) {
  const std::vector<Ray> rays = common::read_rays(GetParam().rays());
  const auto read = world();
  const Trace generic = make_trace(read, rays, JitMode::off);
  const Comparison result = compare(generic, make_trace(read, rays, JitMode::wait));
  EXPECT_EQ(result.differing, 0u) << result;
  EXPECT_EQ(result.stuck, 0u) << result;
  EXPECT_GT(result.steps, 0u);
}
INSTANTIATE_TEST_SUITE_P(Detectors, Geant4ReferenceOtherwise, ::testing::ValuesIn(read_otherwise()),
                         test_name);

/// Where Geant4 finds the way out of its twisted trap at all, it is ours, but for one ray of 73.
TEST(Geant4ReferenceTwistedTrap, AgreesWhereGeant4Steps) {
  const Reference reference{"solids/oneTwistedGeneralTrapezoid.gdml"};
  if (!fs::exists(data / reference.detector) || !fs::exists(reference.trace())) {
    GTEST_SKIP() << reference.detector << " or its reference is not there";
  }
  const std::vector<Ray> rays = common::read_rays(reference.rays());
  const Trace theirs = read_trace(reference.trace(), rays.size());
  const Trace ours = make_trace(
      std::make_shared<const World>(read_world(data / reference.detector)), rays, JitMode::off);
  int stepped = 0, equal = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (theirs[i].empty() || theirs[i][0].length < 1e-6) continue;
    ++stepped;
    equal += ours[i].size() == 1 && std::abs(ours[i][0].length - theirs[i][0].length) < 1e-6;
  }
  EXPECT_EQ(stepped, 73);
  EXPECT_GE(equal, 72);
}

/// Files that are refused with a message, or else read correctly.
using Geant4ReferenceRefused = Geant4Reference;
TEST_P(Geant4ReferenceRefused, IsRefusedOrAgreesWithGeant4) {
  std::shared_ptr<const World> read;
  try {
    read = world();
  } catch (const GdmlError& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().detector), std::string::npos)
        << error.what();
    return;
  }
  expect_agreement(read, JitMode::off);
}
INSTANTIATE_TEST_SUITE_P(Detectors, Geant4ReferenceRefused, ::testing::ValuesIn(refused_today()),
                         test_name);

TEST(Geant4References, AllHaveATest) {
  if (!fs::is_directory(references)) GTEST_SKIP() << references << " is not there";
  std::vector<std::string> tested;
  for (const auto* list : {&read_today(), &read_otherwise(), &refused_today()}) {
    for (const Reference& reference : *list) tested.push_back(reference.trace().filename());
  }
  for (const auto& entry : fs::directory_iterator(references)) {
    const std::string name = entry.path().filename();
    if (!name.ends_with(".geant4.csv.gz")) continue;
    EXPECT_EQ(std::count(tested.begin(), tested.end(), name), 1) << name;
  }
}

}  // namespace
}  // namespace navjit::reference

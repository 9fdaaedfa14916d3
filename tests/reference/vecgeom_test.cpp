// Compares VecGeom's steps in the sample detectors with navjit's: volumes in order, and lengths.
//
// navjit reads the detector as it is. VecGeom, whose reader does not know expressions or
// assemblies, reads what flatten.py makes of it; flatten.py interprets GDML's conventions by
// itself. So the reader is compared as well. turned_assemblies.gdml is there for that, since the
// assemblies of `barrel` are so symmetric that a wrong order or sense of their rotations does not
// show. VecGeom may crash, and holds one world for each process: it runs in its own process.
//
// Where the two differ, VecGeom 1.2.1 is wrong:
// - Its steps into and out of booleans are wrong by its push of 1e-6 mm (the wall of `shashlik`, on
// nearly every ray, the bulkheads and feet of `barrel`, the wall of `absorber`): where a ray along
// (-0.0765, 0.1528, 0.9853) meets the wall at z = 12345, its step is too short: navjit has
// 12529.287099351433, as has the quotient in 40 digits, VecGeom 12529.287098351433. So lengths are
// compared to 1.1e-6 mm; all that differ by more than 1e-9 border on a boolean.
// - Its searches by bounding boxes (abbox, hybrid, bvh) miss the roof of `absorber`, a spherical
//   shell cut by a box, on every ray from the origin that leaves the roof's bounding box through
//   its sides: 92 of 352. Its simple search, which looks at no boxes, finds it on all of them, and
//   so does the closed form (ray 28 of absorber_isotropic is within the box while it is 700 to
//   720 mm from the origin). Hence `simple` for that detector.
// - Ray 2056 of absorber_random: VecGeom gets stuck in the dome. navjit makes a step of
// 99.938533212223433 mm; entry and exit in 40 digits are 99.938533212224 mm apart.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "common/rays.hpp"
#include "geometry/gdml/read_world.hpp"
#include "tests/reference/trace.hpp"

namespace navjit::reference {
namespace {

namespace fs = std::filesystem;

struct Source {
  const char* name;
  const char* detector;   ///< a file of the project, without suffix
  const char* navigator;  ///< of VecGeom
  common::RaySource rays;
  std::size_t count = 3000;
};

/// VecGeom's pushes, see above.
constexpr Criteria criteria{.length = 1.1e-6};
constexpr double least_agreement = 0.999;  // of rays

void PrintTo(const Source& source, std::ostream* out) { *out << source.name; }

std::string test_name(const ::testing::TestParamInfo<Source>& info) { return info.param.name; }

/// Runs a command; the paths in it must not hold quotes.
void run(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) command += "'" + word + "' ";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status)) << command << "died";
  ASSERT_EQ(WEXITSTATUS(status), 0) << command;
}

void write_rays(const fs::path& path, const std::vector<Ray>& rays) {
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  ASSERT_NE(file, nullptr) << path;
  std::fputs("x,y,z,dx,dy,dz\n", file.get());
  for (const Ray& ray : rays) {
    const Vec3 &p = ray.position, &d = ray.direction;
    std::fprintf(file.get(), "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", p.x, p.y, p.z, d.x, d.y, d.z);
  }
  ASSERT_EQ(std::ferror(file.get()), 0) << path;
}

class VecGeomReference : public ::testing::TestWithParam<Source> {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / (std::string("navjit_vecgeom_") + GetParam().name);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }

  fs::path folder_;
};

TEST_P(VecGeomReference, AgreesWithVecGeom) {
  const Source& source = GetParam();
  const fs::path detector = fs::path(NAVJIT_SOURCE_DIR) / (std::string(source.detector) + ".gdml");
  const fs::path flat = folder_ / "flat.gdml", ray_file = folder_ / "rays.csv",
                 trace_file = folder_ / "vecgeom.csv";
  const auto world = std::make_shared<const World>(read_world(detector));
  const common::RayMaker maker(*world, source.rays);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < source.count; ++i) rays.push_back(maker.ray(i));
  ASSERT_NO_FATAL_FAILURE(write_rays(ray_file, rays));
  rays = common::read_rays(ray_file);  // both sides normalise the directions that they read
  ASSERT_NO_FATAL_FAILURE(run({NAVJIT_PYTHON, NAVJIT_FLATTEN, detector, flat}));
  ASSERT_NO_FATAL_FAILURE(
      run({NAVJIT_VECGEOM_TRACE, flat, ray_file, trace_file, source.navigator}));

  const Comparison result =
      compare(make_trace(world, rays, JitMode::off), read_trace(trace_file, rays.size()), criteria);
  EXPECT_GE(result.agreement(), least_agreement) << result;
  EXPECT_EQ(result.stuck, 0u) << result;
  EXPECT_GT(result.steps, rays.size()) << "almost nothing was compared";
  RecordProperty("rays", std::to_string(result.rays));
  RecordProperty("differing", std::to_string(result.differing));
}

const Vec3 origin{0, 0, 0};
INSTANTIATE_TEST_SUITE_P(
    Detectors, VecGeomReference,
    ::testing::Values(
        Source{
            "shashlik_random", "detectors/shashlik", "automatic", {std::nullopt, std::nullopt, 1}},
        Source{
            "shashlik_forward", "detectors/shashlik", "automatic", {origin, std::pair{2., 5.}, 2}},
        Source{"barrel_random", "detectors/barrel", "automatic", {std::nullopt, std::nullopt, 3}},
        Source{"barrel_isotropic", "detectors/barrel", "automatic", {origin, std::nullopt, 4}},
        Source{"absorber_random", "detectors/absorber", "simple", {std::nullopt, std::nullopt, 5}},
        Source{"absorber_isotropic", "detectors/absorber", "simple", {origin, std::nullopt, 6}},
        // From the middle of one of its two halls.
        Source{"turned_assemblies",
               "tests/reference/turned_assemblies",
               "automatic",
               {Vec3{-330, 10, -45}, std::nullopt, 7},
               20000}),
    test_name);

}  // namespace
}  // namespace navjit::reference

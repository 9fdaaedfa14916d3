// `navjit scan`: sums along rays, compared with known numbers and with steps of single rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

#include "apps/scan/report.hpp"
#include "apps/scan/scan.hpp"
#include "geometry/gdml/read_world.hpp"
#include "navjit/errors.hpp"
#include "runtime/transport.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/png.hpp"
#include "tests/support/process.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::scan {
namespace {

constexpr auto npos = std::string::npos;
const std::string barrel = NAVJIT_DETECTORS_DIR "/barrel.gdml";

/// A tube of lead, 10 mm thick, about the axis, in empty space.
std::shared_ptr<const World> lead_tube() {
  World world;
  world.elements = {{.name = "Lead", .z = 82, .a = 207.2}};
  Material lead{.name = "Lead", .density = 11.35};
  lead.radiation_length = 5.612;
  lead.elements = {{0, 1.0}};
  world.materials = {Material{.name = "Nothing"}, lead};
  world.top = tests::add_volume(world, "World", make_box("w", 1000, 1000, 9000));
  const VolumeId tube = tests::add_volume(world, "Tube", make_tube("t", 100, 110, 8000, 0, 7));
  world.volumes[tube].material = 1;
  tests::place(world, world.top, tube, {0, 0, 0});
  finish(world);
  return std::make_shared<const World>(std::move(world));
}

TEST(Scan, OfATubeGrowsAsTheHyperbolicCosine) {
  Runtime runtime(lead_tube(), {.jit = JitMode::off});
  Request request;
  request.eta = {-2, 2};
  request.eta_bins = 8;
  request.phi_bins = 5;
  request.rays = 1;
  request.threads = 2;
  const Scan scan = make(runtime, request);
  EXPECT_EQ(scan.rays, 40U);
  EXPECT_EQ(scan.stuck, 0U);
  for (int i = 0; i < 8; ++i) {
    const double thick = 10 * std::cosh(scan.eta_edge(i) + 0.25);
    for (int j = 0; j < 5; ++j) {
      const Budget& bin = scan.bin(i, j);
      EXPECT_NEAR(bin.radiation_lengths, thick / 5.612, 1e-9 * thick);
      EXPECT_NEAR(bin.mass, thick * 1.135, 1e-9 * thick);
      EXPECT_NEAR(bin.interaction_lengths, thick * 1.135 / (35 * std::cbrt(207.2)), 1e-9 * thick);
      EXPECT_GT(bin.path, thick);
    }
    EXPECT_NEAR(scan.mean(i).mass, thick * 1.135, 1e-9 * thick);
  }
  const auto parts = parts_of(scan, runtime.world(), Quantity::mass);
  ASSERT_EQ(parts.size(), 1U);  // what weighs nothing is no part
  EXPECT_EQ(parts[0].material, "Lead");
  EXPECT_NEAR(parts[0].by_eta[3], scan.mean(3).mass, 1e-9);
}

TEST(Scan, EndsWhereItIsToldTo) {
  Runtime runtime(lead_tube(), {.jit = JitMode::off});
  Request request;
  request.eta = {-1, 1};
  request.eta_bins = 2;
  request.phi_bins = 2;
  request.stop = {"Tu*"};
  const Scan scan = make(runtime, request);
  EXPECT_EQ(scan.bin(1, 1).mass, 0);
  EXPECT_GT(scan.bin(1, 1).path, 99.99);
  request.stop = {"NoSuchThing"};
  EXPECT_THROW(make(runtime, request), Error);
}

TEST(Scan, HasTheSumsOfSingleRays) {
  const auto world = std::make_shared<const World>(read_world(barrel));
  Runtime runtime(world, {.jit = JitMode::off});
  Request request;
  request.origin = {3, 1, -20};
  request.eta_bins = 9;
  request.phi_bins = 7;
  request.rays = 2;
  const Scan scan = make(runtime, request);
  request.threads = 3;
  const Scan again = make(runtime, request);
  const auto rates = common::material_rates(*world);
  Navigator navigator = runtime.navigator();
  for (int i = 0; i < 9; ++i) {
    double by_parts = 0;
    for (const Part& part : parts_of(scan, *world, Quantity::radiation_lengths)) {
      by_parts += part.by_eta[static_cast<std::size_t>(i)];
    }
    EXPECT_NEAR(by_parts, scan.mean(i).radiation_lengths, 1e-9 * by_parts);
    for (int j = 0; j < 7; ++j) {
      double sum = 0;
      for (int k = 0; k < 4; ++k) {
        const double eta = -3 + (i + (k / 2 + 0.5) / 2) * 6 / 9;
        const double phi = (2 * (j + (k % 2 + 0.5) / 2) / 7 - 1) * std::numbers::pi;
        const double theta = 2 * std::atan(std::exp(-eta));
        Vec3 v{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        v = (1 / norm(v)) * v;
        transport(navigator, {request.origin, v}, world->tolerance,
                  [&](const State& state, double length) {
                    sum += length * rates[state.volume()].radiation_lengths / 4;
                  });
      }
      // Directions differ in their last bits; lengths along faces may differ by more.
      EXPECT_NEAR(scan.bin(i, j).radiation_lengths, sum, 1e-6 * sum + 1e-6) << i << ' ' << j;
      EXPECT_EQ(scan.bin(i, j).radiation_lengths, again.bin(i, j).radiation_lengths);
    }
  }
}

TEST(ScanCommand, WritesTableCsvAndPicture) {
  const tests::TemporaryFolder folder;
  const bool plots = std::system("command -v gnuplot > /dev/null 2>&1") == 0;
  const tests::Output output = tests::run_navjit(
      "scan " + barrel + " --eta-bins 6 --phi-bins 8 --rays 2 --threads 2 --csv " +
      folder.file("s.csv") + (plots ? " --picture " + folder.file("s.png") : ""));
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("\n192 rays, 0 stuck\n"), npos) << output.text;
  std::istringstream csv(tests::read_file(folder.file("s.csv")));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "eta_low,eta_high,phi_low,phi_high,rays,x0,g_cm2,lambda,path_mm");
  std::size_t rows = 0;
  while (std::getline(csv, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 8) << line;
    EXPECT_EQ(line.find("nan"), npos);
    ++rows;
  }
  EXPECT_EQ(rows, 48U);
  if (plots) {
    EXPECT_GT(tests::decode_png(tests::read_file(folder.file("s.png"))).width, 800);
  }
}

TEST(ScanCommand, RefusesWhatItCannotScan) {
  const auto refused = [&](const std::string& arguments, int status, const std::string& words) {
    const tests::Output output = tests::run_navjit("scan " + barrel + " " + arguments);
    EXPECT_EQ(output.status, status) << arguments << ": " << output.text;
    EXPECT_NE(output.text.find(words), npos) << arguments << ": " << output.text;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  };
  refused("--eta 2,1", 2, "--eta: '2,1' is not a range");
  refused("--eta=-99,1", 2, "within 15 of 0");
  refused("--eta nan,1", 2, "--eta");
  refused("--phi 1", 2, "--phi: 2 numbers");
  refused("--eta-bins 0", 2, "--eta-bins");
  refused("--phi-bins 1e9", 2, "--phi-bins");
  refused("--rays 1001", 2, "--rays");
  refused("--of path", 2, "--of: 'path' is not x0, mass or lambda");
  refused("--origin 1e9,0,0", 1, "outside the world");
  refused("--stop NoSuchThing", 1, "no volume is called 'NoSuchThing'");
  refused("--picture s.jpg", 2, "pictures are .svg or .png files");
  refused("--csv /nowhere/s.csv", 1, "/nowhere/s.csv");
}

}  // namespace
}  // namespace navjit::scan

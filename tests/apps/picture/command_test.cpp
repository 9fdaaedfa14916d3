// `navjit picture` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/picture/colours.hpp"
#include "geometry/gdml/read_world.hpp"
#include "navjit/runtime.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/png.hpp"
#include "tests/support/process.hpp"

namespace navjit::tests {
namespace {

constexpr auto npos = std::string::npos;
const std::string barrel = NAVJIT_DETECTORS_DIR "/barrel.gdml";
const std::string absorber = NAVJIT_DETECTORS_DIR "/absorber.gdml";

picture::Image picture_of(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string file = folder.file("p.png");
  const Output output = run_navjit("picture " + arguments + " -o " + file);
  EXPECT_EQ(output.status, 0) << output.text;
  return decode_png(read_file(file));
}

TEST(PictureCommand, PixelsHaveTheColoursOfTheirVolumes) {
  const TemporaryFolder folder;
  const auto image = picture_of(folder, barrel +
                                            " --view +z --cut 'z>-50' --width 4000 --at 0,0,0 "
                                            "--size 80x60 --flat --no-legend --threads 2");
  ASSERT_EQ(image.width, 80);
  ASSERT_EQ(image.height, 60);
  const auto world = std::make_shared<const World>(read_world(barrel));
  Runtime runtime(world, {.jit = JitMode::off});
  Navigator navigator = runtime.navigator();
  // Below the plane of the cut, the first that is no gas.
  std::size_t differences = 0, something = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const Ray ray{{-2000 + 50 * (x + 0.5), 1500 - 50 * (y + 0.5), -50}, {0, 0, -1}};
      picture::Rgb expected = picture::background;
      bool seen = false;
      transport(navigator, ray, world->tolerance, [&](const State& state, double length) {
        const VolumeId v = state.volume();
        const Material& material = world->materials[world->volumes[v].material];
        if (seen || length == 0 || v == world->top || picture::is_transparent(material)) return;
        expected = picture::colour_of(*world, v, picture::ColourBy::volume);
        seen = true;
      });
      something += seen ? 1 : 0;
      differences += expected == image.at(x, y) ? 0 : 1;
    }
  }
  EXPECT_GT(something, 1000U);
  EXPECT_LE(differences, 3U);
}

TEST(PictureCommand, IsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const auto one = picture_of(folder, barrel + " --size 120x90 --cut 'x<0'");
  const auto four = picture_of(folder, barrel + " --size 120x90 --cut 'x<0' --threads 4");
  EXPECT_TRUE(one.pixels == four.pixels);
}

TEST(PictureCommand, DrawsEveryMode) {
  const TemporaryFolder folder;
  for (const std::string mode : {"surface", "path", "x0", "mass", "steps", "time"}) {
    const Output output = run_navjit("picture " + absorber + " --size 60x40 --threads 2 --mode " +
                                     mode + " -o " + folder.file("p.png"));
    EXPECT_EQ(output.status, 0) << output.text;
    const auto image = decode_png(read_file(folder.file("p.png")));
    EXPECT_GT(image.width, mode == "time" ? 120 : 60) << mode;
    if (mode == "time") {
      EXPECT_NE(output.text.find(" times"), npos) << output.text;
    } else if (mode != "surface") {
      EXPECT_NE(output.text.find("mean "), npos) << output.text;
    }
    // Something is in it: not all pixels of the view are alike.
    bool same = true;
    for (int x = 0; x < 60; ++x) same = same && image.at(x, 20) == image.at(0, 0);
    EXPECT_FALSE(same) << mode;
  }
}

TEST(PictureCommand, WritesSvg) {
  const TemporaryFolder folder;
  const std::string file = folder.file("p.svg");
  const Output output = run_navjit("picture " + absorber + " --size 60x40 -o " + file);
  EXPECT_EQ(output.status, 0) << output.text;
  const std::string svg = read_file(file);
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_NE(svg.find("data:image/png;base64,"), npos);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
}

TEST(PictureCommand, RefusesWhatItCannotDraw) {
  const TemporaryFolder folder;
  const std::string file = folder.file("p.png");
  const auto refused = [&](const std::string& arguments, int status, const std::string& words) {
    const Output output = run_navjit("picture " + absorber + " -o " + file + " " + arguments);
    EXPECT_EQ(output.status, status) << arguments << ": " << output.text;
    EXPECT_NE(output.text.find(words), npos) << arguments << ": " << output.text;
    EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
    EXPECT_FALSE(std::filesystem::exists(file)) << arguments;
  };
  for (const char* size : {"0x10", "10", "x", "10x", "-5x5", "1e9x1", "8193x1", "axb", "10x10x10",
                           "1.5x2", "99999999999999999999x1", "''"}) {
    refused(std::string("--size=") + size, 2, "--size");
  }
  refused("--cut 'w>1'", 2, "--cut: 'w>1' is no half of space");
  refused("--slice z=1 --cut 'x>0'", 2, "--cut excludes --slice");
  refused("--slice z", 2, "--slice: 'z' is not as");
  refused("--slice z=nan", 2, "--slice");
  refused("--view up", 2, "--view: 'up' is not");
  refused("--eye 1,2", 2, "--eye");
  refused("--eye 1,2,nan", 2, "--eye");
  refused("--eye 1,2,3 --view +x", 2, "excludes");
  refused("--fov 180", 2, "--fov");
  refused("--fov 0", 2, "--fov");
  refused("--width=-1", 2, "--width");
  refused("--width 5 --fov 30", 2, "excludes");
  refused("--mode colour", 2, "--mode: 'colour' is not surface, path");
  refused("--mode x0 --flat", 2, "x0 has no surfaces");
  refused("--log", 2, "--log: needs a --mode of numbers");
  refused("--mode time --cut 'x>0'", 2, "--cut");
  refused("--mode time --hide Foil", 2, "--hide: rays pass everything with this --mode");
  refused("--mode steps --hide Foil", 2, "--hide: rays pass everything with this --mode");
  refused("--hide NoSuchVolume", 1, "no volume or material is called 'NoSuchVolume'");
  refused("--eye 1,2,3 --at 1,2,3", 1, "the eye is where it looks at");
  refused("--view +x --up 1,0,0", 1, "up is along the view");
  const Output jpeg = run_navjit("picture " + absorber + " -o " + folder.file("p.jpg"));
  EXPECT_EQ(jpeg.status, 2);
  EXPECT_NE(jpeg.text.find("pictures are .svg or .png files"), npos) << jpeg.text;
}

TEST(PictureCommand, SmallAndFarViewsAreDrawn) {
  const TemporaryFolder folder;
  for (const std::string arguments :
       {" --size 1x1", " --size 1x2000", " --size 8192x1", " --eye 1e9,1e9,1e9", " --eye 0,0,0",
        " --fov 170", " --width 1e-9", " --width 1e12", " --cut 'x>-1e9'", " --hide '*'",
        " --slice x=1e9", " --size 1x1 --mode time"}) {
    const auto image = picture_of(folder, absorber + arguments);
    EXPECT_GT(image.width, 0) << arguments;
  }
}

TEST(PictureCommand, LeavesNothingHalfDone) {
  const TemporaryFolder folder;
  const std::string file = folder.file("p.png");
  write_file(file, "as it was");
  Process draws({NAVJIT_COMMAND, "picture", NAVJIT_DETECTORS_DIR "/shashlik.gdml", "--mode", "x0",
                 "--view", "-x", "--size", "8000x8000", "-o", file},
                folder.file("log"));
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  draws.send(SIGTERM);
  EXPECT_EQ(draws.wait(), 128 + SIGTERM) << draws.text();
  EXPECT_EQ(read_file(file), "as it was");
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& each : std::filesystem::directory_iterator(folder.path()))
    ++files;
  EXPECT_EQ(files, 2U);
  const Output full =
      run_navjit("picture " + absorber + " --size 9x9 -o " + folder.file("none/p.png"));
  EXPECT_EQ(full.status, 1) << full.text;
}

}  // namespace
}  // namespace navjit::tests

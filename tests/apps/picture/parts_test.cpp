// Views, cuts, colours, legends and files, each tested by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/picture/cuts.hpp"
#include "apps/picture/sheet.hpp"
#include "apps/picture/view.hpp"
#include "common/markup.hpp"
#include "common/material_budget.hpp"
#include "common/progress_line.hpp"
#include "geometry/gdml/read_world.hpp"
#include "navjit/errors.hpp"
#include "tests/support/png.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::picture {
namespace {

constexpr auto npos = std::string::npos;

TEST(View, ShowsTheWholeBox) {
  World world = tests::mixed_world();
  finish(world);
  const Extent box{{-30, -10, 5}, {80, 20, 95}};
  for (const char* from : {"+x", "-x", "+y", "-y", "+z", "-z", "corner"}) {
    for (const bool perspective : {false, true}) {
      for (const auto& [width, height] : {std::pair{300, 200}, std::pair{50, 400}}) {
        ViewOptions options{.from = from};
        if (perspective) options.fov = 70;
        const View view = view_of(box, world, options, width, height);
        EXPECT_NEAR(norm(view.right), 1, 1e-12);
        EXPECT_NEAR(dot(view.right, view.up), 0, 1e-12);
        EXPECT_NEAR(dot(view.right, view.forward), 0, 1e-12);
        EXPECT_NEAR(view.half_height / view.half_width, static_cast<double>(height) / width, 1e-9);
        double widest = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3 p = corner_of(box, corner) - view.eye;
          const double depth = dot(p, view.forward);
          EXPECT_GT(depth, 0) << from;
          const double by = perspective ? depth : 1;
          const double u = std::abs(dot(p, view.right)) / by / view.half_width;
          const double v = std::abs(dot(p, view.up)) / by / view.half_height;
          EXPECT_LE(std::max(u, v), 1) << from;
          widest = std::max({widest, u, v});
        }
        EXPECT_GT(widest, 0.9) << from;
      }
    }
  }
}

TEST(View, PutsPixelsWhereTheyBelong) {
  World world = tests::mixed_world();
  finish(world);
  const Extent box{{-50, -50, -50}, {50, 50, 50}};
  const View view = view_of(box, world, {.from = "+z", .width = 200.0}, 200, 100);
  const Ray first = view.ray(0, 0, 200, 100), last = view.ray(199, 99, 200, 100);
  EXPECT_NEAR(first.position.x, -99.5, 1e-9);
  EXPECT_NEAR(first.position.y, 49.5, 1e-9);
  EXPECT_NEAR(last.position.x, 99.5, 1e-9);
  EXPECT_NEAR(last.position.y, -49.5, 1e-9);
  EXPECT_EQ(first.direction.z, -1);
  EXPECT_THROW(view_of(box, world, {.eye = Vec3{0, 0, 0}}, 10, 10), UsageError);
  EXPECT_THROW(view_of(box, world, {.from = "+z", .up = Vec3{0, 0, 3}}, 10, 10), UsageError);
  EXPECT_THROW(view_of(box, world, {.from = "up"}, 10, 10), UsageError);
}

TEST(Cuts, AreParsedOrRefused) {
  const Cut cut = parse_cut("x>10,y<-2.5e1");
  ASSERT_EQ(cut.size(), 2U);
  EXPECT_EQ(cut[0].offset, 10);
  EXPECT_EQ(cut[1].normal.y, -1);
  EXPECT_EQ(cut[1].offset, 25);
  for (const char* bad : {"", "x", "x>", "w>1", "x=1", "x>>1", "x>nan", "x>1,", ",x>1", "x>1;y>2",
                          "x>1e999", "X>1"}) {
    EXPECT_THROW(parse_cut(bad), UsageError) << bad;
  }
}

TEST(Cuts, OfARayAreMerged) {
  const Ray ray{{-10, 0, 0}, {1, 0, 0}};
  const std::vector<Cut> cuts{parse_cut("x>0,x<5"), parse_cut("x>4,x<6"), parse_cut("x<-8"),
                              parse_cut("y>1"), parse_cut("x>20")};
  const std::vector<Gap> gaps = gaps_of(cuts, ray);
  ASSERT_EQ(gaps.size(), 3U);
  EXPECT_EQ(gaps[0].from, 0);
  EXPECT_EQ(gaps[0].to, 2);
  EXPECT_EQ(gaps[1].from, 10);
  EXPECT_EQ(gaps[1].to, 16);
  EXPECT_EQ(gaps[1].face.x, -1);
  EXPECT_EQ(gaps[2].to, std::numeric_limits<double>::infinity());
}

TEST(Png, IsReadBackAsItWas) {
  Image few(7, 5, {1, 2, 3}), many(64, 64, background);
  few.at(6, 4) = {200, 100, 50};
  for (int i = 0; i < 64 * 64; ++i) {
    many.at(i % 64, i / 64) = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i / 16), 9};
  }
  for (const Image* image : {&few, &many}) {
    const Image read = tests::decode_png(png_of(*image));
    EXPECT_EQ(read.width, image->width);
    EXPECT_EQ(read.height, image->height);
    EXPECT_TRUE(read.pixels == image->pixels);
  }
}

TEST(Png, AsTextIsBase64) {
  EXPECT_EQ(common::base64(""), "");
  EXPECT_EQ(common::base64("f"), "Zg==");
  EXPECT_EQ(common::base64("fo"), "Zm8=");
  EXPECT_EQ(common::base64("foo"), "Zm9v");
  EXPECT_EQ(common::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(common::base64("\xff\xfe\xfd"), "//79");
}

TEST(Scale, EndsAtARoundNumber) {
  std::vector<double> values(1000, 3.1);
  values[7] = 400;  // one of a thousand
  values[8] = std::numeric_limits<double>::quiet_NaN();
  const Scale scale = scale_of(values, false, ColourMap::cool);
  EXPECT_EQ(scale.high, 5);
  EXPECT_EQ(scale.position(0), 0);
  EXPECT_EQ(scale.position(400), 1);
  EXPECT_EQ(scale.marks().size(), 6U);
  EXPECT_TRUE(scale.colour(values[8]) == stuck_colour);
  const Scale log = scale_of(values, true, ColourMap::hot);
  EXPECT_EQ(log.position(0), 0);
  EXPECT_NEAR(log.position(5e-2), 0.5, 1e-9);
  EXPECT_EQ(log.marks().size(), 5U);
  const Scale none = scale_of({}, false, ColourMap::hot),
              zero = scale_of(std::vector<double>(9), true, ColourMap::hot);
  EXPECT_EQ(none.high, 1);
  EXPECT_EQ(zero.high, 1);
}

Sheet sheet_of(int width, int height) {
  Sheet sheet;
  sheet.panels.push_back({Image(width, height, {10, 20, 30}), "a title <&>"});
  sheet.entries.push_back({{1, 2, 3}, "<script>alert(\"x\")</script>"});
  sheet.entries.push_back({{4, 5, 6}, std::string("\x1b[31m\n\xff") + std::string(3000, 'n')});
  for (int i = 0; i < 200; ++i) sheet.entries.push_back({{7, 8, 9}, "volume " + std::to_string(i)});
  return sheet;
}

TEST(Sheet, KeepsThePixelsOfItsPanels) {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{3, 700}, std::pair{900, 2}}) {
    Sheet sheet = sheet_of(width, height);
    sheet.panels[0].title.clear();
    const Image image = tests::decode_png(png_sheet(sheet));
    EXPECT_GT(image.width, width);
    EXPECT_TRUE(image.at(width - 1, height - 1) == (Rgb{10, 20, 30}));
    sheet.legend = false;
    const Image alone = tests::decode_png(png_sheet(sheet));
    EXPECT_TRUE(alone.pixels == sheet.panels[0].image.pixels);
    sheet.panels.push_back(sheet.panels[0]);
    EXPECT_EQ(tests::decode_png(png_sheet(sheet)).width, 2 * width);
  }
}

TEST(Sheet, NamesAreNoMarkup) {
  Sheet sheet = sheet_of(300, 200);
  sheet.scale = Scale{};
  sheet.unit = "<b>";
  const std::string svg = svg_sheet(sheet);
  EXPECT_EQ(svg.find("<script"), npos);
  EXPECT_EQ(svg.find("<b>"), npos);
  EXPECT_EQ(svg.find('\x1b'), npos);
  EXPECT_EQ(svg.find('\xff'), npos);
  EXPECT_NE(svg.find("a title &lt;&amp;&gt;"), npos);
  EXPECT_NE(svg.find("more)"), npos);
}

TEST(MaterialRates, AreThoseOfTheMaterials) {
  World world;
  world.elements = {{.name = "Iron", .z = 26, .a = 55.845}, {.name = "Odd", .z = 3}};
  Material iron{.name = "Iron", .density = 7.874};
  iron.radiation_length = 17.57;
  iron.elements = {{0, 1.0}};
  Material odd{.name = "Odd", .density = 1};
  odd.elements = {{0, 0.5}, {1, 0.5}};
  world.materials = {iron, odd};
  const VolumeId first = tests::add_volume(world, "a", make_box("a", 1, 1, 1));
  const VolumeId second = tests::add_volume(world, "b", make_box("b", 1, 1, 1));
  world.volumes[first].material = 0;
  world.volumes[second].material = 1;
  const auto rates = common::material_rates(world);
  EXPECT_NEAR(rates[first].radiation_lengths, 1 / 17.57, 1e-12);
  EXPECT_NEAR(rates[first].mass, 0.7874, 1e-12);
  // 132.1 g/cm2 by measurement, 16.8 cm.
  EXPECT_NEAR(1 / rates[first].interaction_lengths, 168, 4);
  EXPECT_EQ(rates[second].radiation_lengths, 0);
  EXPECT_EQ(rates[second].interaction_lengths, 0);  // an element without a mass
}

TEST(Progress, IsInPercentAndTimeLeft) {
  EXPECT_EQ(common::percent_and_left(0, 0, 10), "");
  EXPECT_EQ(common::percent_and_left(0, 10, 10), "0%");
  EXPECT_EQ(common::percent_and_left(5, 10, 0.1), "50%");
  EXPECT_EQ(common::percent_and_left(5, 10, 8), "50%, 8 s left");
  EXPECT_EQ(common::percent_and_left(1, 10, 20), "10%, 3 min 0 s left");
  EXPECT_EQ(common::percent_and_left(1, 1000, 20), "0%, 5 h 33 min left");
  EXPECT_EQ(common::percent_and_left(999, 1000, 1), "99%, 0 s left");
  EXPECT_EQ(common::percent_and_left(10, 10, 8), "100%");
}

}  // namespace
}  // namespace navjit::picture

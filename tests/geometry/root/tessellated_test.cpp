// ROOT's tessellated solids, in the form of every version of ROOT, and damaged ones.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/root_reading.hpp"

namespace navjit {
namespace {

using namespace tests;
using Vertices = std::vector<std::vector<double>>;
using Facets = std::vector<std::vector<int>>;

/// A house: four walls, a floor, and a roof of two sides with triangles below its ends. It is 2 cm
/// by 2 cm; the walls are 2 cm high, and the ridge is 1 cm above them, along x.
const Vertices house = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0},  {-1, 1, 0}, {-1, -1, 2},
                        {1, -1, 2},  {1, 1, 2},  {-1, 1, 2}, {-1, 0, 3}, {1, 0, 3}};
const Facets walls = {{3, 2, 1, 0}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7},
                      {4, 5, 9, 8}, {6, 7, 8, 9}, {5, 6, 9},    {7, 4, 8}};
constexpr double house_volume = 4 * 2 * 1000 + 2 * 1 * 1000;

class RootTessellated : public RootReading {
 protected:
  void expect_refused(const RootPointer& shape, const std::string& why) {
    const std::string message = refusal(root_world_around(shape));
    EXPECT_NE(message.find("TGeoTessellated 'mesh': " + why), std::string::npos) << message;
  }
};

TEST_F(RootTessellated, EveryVersionIsRead) {
  for (const RootFacetStyle& style :
       {RootFacetStyle{}, RootFacetStyle{.by_members = false},
        RootFacetStyle{.vertex_class = "TGeoVector3", .shared = true},
        RootFacetStyle{.vertex_class = "TGeoVector3", .by_members = false, .shared = true}}) {
    const Solid s = solid(root_tessellated("mesh", house, walls, style));
    EXPECT_STREQ(kind_name(s.kind), "facets");
    EXPECT_NEAR(capacity(s), house_volume, 1e-6);
    EXPECT_EQ(s.extent.max.z, 30);
    EXPECT_TRUE(has(s, {0, 4, 25}));
    EXPECT_FALSE(has(s, {0, 6, 25}));
  }
}

TEST_F(RootTessellated, FacetsMayFaceInwardsOrLeaveVerticesOver) {
  Facets inwards = walls;
  for (auto& facet : inwards) std::reverse(facet.begin(), facet.end());
  EXPECT_NEAR(capacity(solid(root_tessellated("mesh", house, inwards))), house_volume, 1e-6);
  Vertices more = house;
  more.push_back({100, 0, 0});
  EXPECT_EQ(solid(root_tessellated("mesh", more, walls)).extent.max.x, 10);
}

TEST_F(RootTessellated, WhatIsOpenIsClosedWithANote) {
  const Facets open(walls.begin() + 1, walls.end());
  GdmlReport report;
  const Detector detector = read(root_world_around(root_tessellated("mesh", house, open)), &report);
  EXPECT_NEAR(capacity(detector.volume(*detector.find_volume("inner")).solid), house_volume, 1e-6);
  ASSERT_EQ(report.skipped.size(), 1U);
  EXPECT_NE(report.skipped[0].find("closed them"), std::string::npos);
}

TEST_F(RootTessellated, MayBeOperands) {
  const RootPointer mesh = root_tessellated("mesh", house, walls);
  const RootPointer roof = root_half_space({0, 0, 2}, {0, 0, -1});
  const Solid s = solid(root_boolean("TGeoIntersection", mesh, roof));
  EXPECT_TRUE(has(s, {0, 4, 25}));
  EXPECT_FALSE(has(s, {0, 4, 19}));
}

TEST_F(RootTessellated, BrokenOnesAreRefused) {
  const auto with = [](std::size_t facet, const std::vector<int>& corners) {
    Facets facets = walls;
    facets[facet] = corners;
    return root_tessellated("mesh", house, facets);
  };
  expect_refused(with(3, {3, 2, 10}), "a vertex of facet 3 is not among its 10");
  expect_refused(with(3, {3, -1, 1}), "a vertex of facet 3 is not among its 10");
  expect_refused(with(0, {3, 2}), "facet 0 has not three or four vertices");
  expect_refused(root_tessellated("mesh", {}, {}), "it has no facets; close the shape");
  expect_refused(root_tessellated("mesh", {}, walls), "a vertex of facet 0 is not among its 0");
  expect_refused(root_tessellated("mesh", house, {walls[0]}), "");
  for (const double bad : {static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    Vertices vertices = house;
    vertices[7][1] = bad;
    expect_refused(root_tessellated("mesh", vertices, walls),
                   "a number of fVertices.fVec is not finite");
  }
  // Of another class than it was.
  const RootPointer odd = root_object("TGeoTessellated", "mesh", {{"fNfacets", 1}});
  expect_refused(odd, "it has no facets");
}

TEST_F(RootTessellated, TakeNoMoreThanIsAllowed) {
  const std::string bytes =
      root_file({{"g", root_manager(root_world_around(root_tessellated("mesh", house, walls)))}});
  EXPECT_NE(refusal_of_bytes(bytes, {.limits = {.max_facets = 18}}).find("max_facets"),
            std::string::npos);
  EXPECT_EQ(refusal_of_bytes(bytes, {.limits = {.max_facets = 19}}), "");
}

/// Whatever the lengths and numbers in it are, there is a detector or an error.
TEST_F(RootTessellated, BytesMayBeAnything) {
  for (const bool by_members : {true, false}) {
    const std::string whole =
        root_file({{"g", root_manager(root_world_around(root_tessellated(
                             "mesh", house, walls, {.by_members = by_members})))}});
    for (std::size_t length = 0; length < whole.size(); length += 13) {
      EXPECT_NE(refusal_of_bytes(whole.substr(0, length)), "") << length;
    }
    int errors = 0;
    for (std::size_t at = whole.find("TGeoTessellated"), end = at + 1100; at < end; at += 7) {
      for (const char byte : {'\x00', '\x7f', '\xff'}) {
        std::string bytes = whole;
        bytes[at] = byte;
        errors += refusal_of_bytes(bytes, {.limits = {.max_bytes = 1 << 24}}).empty() ? 0 : 1;
      }
    }
    EXPECT_GT(errors, 40);
  }
}

}  // namespace
}  // namespace navjit

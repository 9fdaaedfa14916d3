// Shells of surfaces: which way they face, and what they lie within.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "navjit/surface.hpp"
#include "tests/support/meshes.hpp"

namespace navjit {
namespace {

using tests::Mesh;

/// A block of 480 mm3 times the third power of `scale`, about a place, facing outwards or inwards.
Mesh block(double scale, const Vec3& at = {}, bool inwards = false) {
  Mesh mesh = tests::block();
  for (FacetCorners& f : mesh) {
    for (Vec3& p : f) p = scale * p + at;
    if (inwards) tests::flip(f);
  }
  return mesh;
}

/// The surface of all facets, whose equal corners are one.
Surface surface_of(const std::vector<Mesh>& meshes) {
  Surface surface;
  for (const Mesh& mesh : meshes) {
    for (const FacetCorners& f : mesh) {
      Surface::Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t corner = 0;
        while (corner < surface.corners.size() && !(surface.corners[corner] == f[k])) ++corner;
        if (corner == surface.corners.size()) surface.corners.push_back(f[k]);
        triangle[k] = corner;
      }
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
        continue;
      }
      surface.triangles.push_back(triangle);
      surface.origins.push_back(surface.origins.size() + 1);
    }
  }
  return surface;
}

double volume_of(const Surface& surface) { return capacity(make_tessellated("it", surface)); }

/// Expects one note that contains `part`, and this volume, mm3.
void expect_mended(Surface surface, const std::string& part, double volume) {
  const std::vector<std::string> notes = mend_shells(surface);
  ASSERT_EQ(notes.size(), 1U) << part;
  EXPECT_NE(notes[0].find(part), std::string::npos) << notes[0];
  EXPECT_NEAR(volume_of(surface), volume, 1e-9 * volume);
  EXPECT_TRUE(mend_shells(surface).empty() || part == "cross");
}

/// Expects that nothing is changed, and this volume, mm3.
void expect_kept(Surface surface, double volume) {
  const std::vector<Surface::Triangle> before = surface.triangles;
  EXPECT_TRUE(mend_shells(surface).empty());
  EXPECT_EQ(surface.triangles, before);
  EXPECT_NEAR(volume_of(surface), volume, 1e-9 * volume);
}

TEST(Shells, ThatFaceTheRightWayStay) {
  expect_kept(surface_of({block(1)}), 480);
  expect_kept(surface_of({block(1), block(1, {20, 0, 0})}), 960);
  expect_kept(surface_of({block(2), block(1, {}, true)}), 7 * 480);             // hollow
  expect_kept(surface_of({block(3), block(2, {}, true), block(1)}), 20 * 480);  // and in it a body
  expect_kept(surface_of({block(1), block(1, {10, 8, 0})}), 960);  // with a common edge
  expect_kept(surface_of({block(1), block(1, {10, 8, 6})}), 960);  // a common corner
  expect_kept(surface_of({block(1), block(1, {0, 0, 6})}), 960);   // a common face
}

TEST(Shells, ThatAreInsideOutAreTurned) {
  expect_mended(surface_of({block(1, {}, true)}), "1 shell facing inwards", 480);
  expect_mended(surface_of({block(1), block(1, {20, 0, 0}, true)}),
                "1 shell facing inwards, but within no other one: turned: the one of 12 triangles "
                "with facet 13",
                960);
  // With a common edge, one surface is the mirror image of the other.
  expect_mended(surface_of({block(1), block(1, {10, 8, 0}, true)}), "1 shell facing inwards", 960);
  // A hollow body is turned as a whole.
  expect_mended(surface_of({block(2, {}, true), block(1), block(1, {40, 0, 0})}),
                "1 shell facing inwards", 8 * 480);
  expect_mended(surface_of({block(1, {}, true), block(1, {20, 0, 0}, true)}),
                "2 shells facing inwards", 960);
}

TEST(Shells, WithinABodyMakeNoDifference) {
  expect_mended(surface_of({block(2), block(1)}), "makes no difference", 8 * 480);
  // A hole within a hole.
  expect_mended(surface_of({block(3), block(2, {}, true), block(1, {}, true)}),
                "makes no difference", 19 * 480);
  // A hollow body within a body: two shells.
  expect_mended(surface_of({block(3), block(2), block(1, {}, true)}), "2 shells within others",
                27 * 480);
}

TEST(Shells, ThatAreThereTwiceAreThereOnce) {
  expect_mended(surface_of({block(1), block(1)}), "12 triangles are there twice", 480);
  expect_mended(surface_of({block(1), block(1, {20, 0, 0}), block(1, {20, 0, 0})}),
                "12 triangles are there twice", 960);
}

TEST(Shells, ThatCrossAreLeftAndNamed) {
  expect_mended(surface_of({block(1), block(1, {5, 4, 3})}), "cross", 960);
}

TEST(Shells, ThatEncloseNothingStay) {
  Mesh flat = block(1, {0, 0, 30});
  for (FacetCorners& f : flat) {
    for (Vec3& p : f) p.z = 30;
  }
  expect_kept(surface_of({block(1), flat}), 480);
}

TEST(Shells, HaveToBeClosed) {
  Surface surface = surface_of({block(1)});
  surface.triangles.pop_back();
  EXPECT_THROW(mend_shells(surface), GeometryError);
}

/// A hundred bubbles in a block, of which every other one is written as a body.
TEST(Shells, MayBeMany) {
  std::vector<Mesh> meshes{block(100)};
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j)
      meshes.push_back(block(1, {20.0 * i, 20.0 * j, 0}, (i + j) % 2 == 0));
  }
  Surface surface = surface_of(meshes);
  EXPECT_EQ(mend_shells(surface).size(), 1U);
  EXPECT_NEAR(volume_of(surface), (1e6 - 50) * 480, 1);
}

}  // namespace
}  // namespace navjit

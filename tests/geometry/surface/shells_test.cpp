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
  EXPECT_TRUE(mend_shells(surface).empty()) << "once is enough";
}

/// Expects that nothing is changed, but one note that contains `part`.
void expect_named(const Surface& surface, const std::string& part) {
  Surface same = surface;
  const std::vector<std::string> notes = mend_shells(same);
  ASSERT_EQ(notes.size(), 1U) << part;
  EXPECT_NE(notes[0].find(part), std::string::npos) << notes[0];
  EXPECT_EQ(same.triangles, surface.triangles);
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
  expect_mended(surface_of({block(1, {}, true)}), "1 shell was inside out", 480);
  expect_mended(surface_of({block(1), block(1, {20, 0, 0}, true)}),
                "1 shell was inside out and is turned: the one of 12 triangles with facet 13", 960);
  // With a common edge, one surface is the mirror image of the other.
  expect_mended(surface_of({block(1), block(1, {10, 8, 0}, true)}), "1 shell was", 960);
  // A hollow body is turned as a whole.
  expect_mended(surface_of({block(2, {}, true), block(1), block(1, {40, 0, 0})}),
                "2 shells were inside out", 8 * 480);
  expect_mended(surface_of({block(1, {}, true), block(1, {20, 0, 0}, true)}),
                "2 shells were inside out", 960);
}

/// Holes that end on the faces of what they are in: through it, or all corners on its surface.
TEST(Shells, ThatAreHolesStayHoles) {
  const Mesh outer = block(2);  // 20 x 16 x 12 mm
  Mesh through = block(1, {}, true);
  for (FacetCorners& f : through) {
    for (Vec3& p : f) p.z *= 2;
  }
  expect_kept(surface_of({outer, through}), 8 * 480 - 2 * 480);
  // An octahedron that touches all six faces.
  const Vec3 tips[] = {{10, 0, 0}, {-10, 0, 0}, {0, 8, 0}, {0, -8, 0}, {0, 0, 6}, {0, 0, -6}};
  Mesh octahedron;
  for (int i = 0; i < 8; ++i) {
    FacetCorners f{tips[i & 1], tips[2 + (i >> 1 & 1)], tips[4 + (i >> 2 & 1)]};
    // Anticlockwise seen from outside where an even number of tips is negative; turned inwards.
    if (((i & 1) + (i >> 1 & 1) + (i >> 2 & 1)) % 2 == 0) tests::flip(f);
    octahedron.push_back(f);
  }
  expect_kept(surface_of({outer, octahedron}), 8 * 480 - 4.0 / 3 * 10 * 8 * 6);
}

TEST(Shells, ThatOverlapOthersAreNamed) {
  expect_named(surface_of({block(2), block(1)}), "1 shell overlaps others");
  expect_named(surface_of({block(3), block(2, {}, true), block(1, {}, true)}), "1 shell overlaps");
  expect_named(surface_of({block(1), block(1, {5, 4, 3})}), "overlap");
}

TEST(Shells, ThatAreThereTwiceAreThereOnce) {
  expect_mended(surface_of({block(1), block(1)}), "12 triangles are there twice", 480);
  expect_mended(surface_of({block(1), block(1, {20, 0, 0}), block(1, {20, 0, 0})}),
                "12 triangles are there twice", 960);
}

/// A block whose faces are cut along their other diagonals, from a face on.
Mesh cut_otherwise(std::size_t from_face = 0) {
  Mesh mesh = block(1);
  for (std::size_t f = 2 * from_face; f < mesh.size(); f += 2) {
    const Vec3 a = mesh[f][0], b = mesh[f][1], c = mesh[f][2], d = mesh[f + 1][2];
    mesh[f] = {b, c, d};
    mesh[f + 1] = {b, d, a};
  }
  return mesh;
}

TEST(Shells, ThatAreThereTwiceAndCutOtherwiseAreNamed) {
  EXPECT_NEAR(volume_of(surface_of({cut_otherwise()})), 480, 1e-9);
  Mesh upon = cut_otherwise();  // the face between them faces both ways
  for (FacetCorners& f : upon) {
    for (Vec3& p : f) p.z += 6;
  }
  expect_kept(surface_of({block(1), upon}), 960);
  expect_named(surface_of({block(1), cut_otherwise()}),
               "24 triangles lie upon others that face as they do, so that parts overlap and the "
               "volume is not exact: the first is facet 1, in the shell of 24 triangles");
  expect_named(surface_of({block(1, {40, 0, 0}), block(1), cut_otherwise()}),
               "24 triangles lie upon others");
  // Half of the faces are cut in the same way, and dropping those of one would open the surface.
  Surface half = surface_of({block(1), cut_otherwise(3)});
  const std::vector<std::string> notes = mend_shells(half);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("6 triangles are there twice"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("the volume is not exact"), std::string::npos) << notes[1];
}

/// Each edge has another corner in the middle, so that no edge is that of the other body.
TEST(Shells, ThatAreThereTwiceWithoutACommonEdgeAreNamed) {
  Mesh finer;
  for (const FacetCorners& f : block(1)) {
    const Vec3 a = 0.5 * (f[0] + f[1]), b = 0.5 * (f[1] + f[2]), c = 0.5 * (f[2] + f[0]);
    finer.insert(finer.end(), {{f[0], a, c}, {a, f[1], b}, {c, b, f[2]}, {a, b, c}});
  }
  expect_named(surface_of({block(1), finer}), "2 shells overlap others");
  Mesh beside = finer;
  for (FacetCorners& f : beside) {
    for (Vec3& p : f) p.z += 6;
  }
  expect_kept(surface_of({block(1), beside}), 960);
}

TEST(Shells, ThatShareTrianglesAndDifferAreNamed) {
  Surface surface = surface_of({block(1), block(1, {0, 0, 6}, true)});
  const std::vector<std::string> notes = mend_shells(surface);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("seems to face inwards"), std::string::npos) << notes[0];
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

/// A hundred bubbles in a block, and thousands of shells in one another.
TEST(Shells, MayBeMany) {
  std::vector<Mesh> meshes{block(100)};
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) meshes.push_back(block(1, {20.0 * i, 20.0 * j, 0}, true));
  }
  expect_kept(surface_of(meshes), (1e6 - 100) * 480);
  Surface nested;
  for (std::uint32_t i = 0; i < 8000; ++i) {
    for (FacetCorners f : tests::block()) {
      if (i % 2 == 1) tests::flip(f);
      Surface::Triangle t{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& p = f[k];
        t[k] = 8 * i + (p.x > 0 ? 1 : 0) + (p.y > 0 ? 2 : 0) + (p.z > 0 ? 4 : 0);
      }
      nested.triangles.push_back(t);
    }
    for (int c = 0; c < 8; ++c) {
      const double scale = 10000.0 - i;
      nested.corners.push_back({(c & 1) != 0 ? scale : -scale, (c & 2) != 0 ? scale : -scale,
                                (c & 4) != 0 ? scale : -scale});
    }
  }
  EXPECT_TRUE(mend_shells(nested).empty());
}

}  // namespace
}  // namespace navjit

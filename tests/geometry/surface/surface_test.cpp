// Surfaces from files.
#include "navjit/surface.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <limits>
#include <random>

#include "geometry/solids/any_solid.hpp"
#include "geometry/solids/facets.hpp"
#include "geometry/surface/polygon.hpp"
#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/surfaces.hpp"

namespace navjit {
namespace {

using tests::Mesh;

class Surfaces : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) {
    tests::write_file(folder_.file(name), bytes);
    return folder_.file(name);
  }
  Surface read(const std::string& name, const std::string& bytes) {
    return read_surface(file(name, bytes));
  }
  /// What is said of a file that cannot be read.
  std::string refusal(const std::string& name, const std::string& bytes,
                      const SurfaceOptions& options = {}) {
    try {
      read_surface(file(name, bytes), options);
    } catch (const SurfaceError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(folder_.file(name) + ":")) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos);
      return what;
    }
    ADD_FAILURE() << name << " was read";
    return {};
  }

  tests::TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The volume within the surface, mm3.
double volume_of(const Surface& surface) { return capacity(make_tessellated("it", surface)); }

TEST_F(Surfaces, AreTheSameInAllFormats) {
  const Mesh mesh = tests::ball(2);
  const Solid expected = make_tessellated("ball", mesh);
  const Surface words = read("a.stl", tests::ascii_stl(mesh));
  const Surface objects = read("a.OBJ", tests::obj(mesh));
  const Surface bytes = read("b.stl", tests::binary_stl(mesh));
  for (const Surface* s : {&words, &objects, &bytes}) {
    EXPECT_EQ(s->triangles.size(), mesh.size());
    EXPECT_EQ(s->corners.size(), mesh.size() / 2 + 2);  // Euler
    EXPECT_EQ(open_at(*s), "");
  }
  EXPECT_EQ(words.triangles, objects.triangles);
  EXPECT_EQ(words.triangles, bytes.triangles);
  EXPECT_EQ(volume_of(words), capacity(expected));  // the same corners, bit for bit
  EXPECT_EQ(volume_of(objects), capacity(expected));
  EXPECT_NEAR(volume_of(bytes), capacity(expected), 1e-5 * capacity(expected));
}

TEST_F(Surfaces, HaveTheirUnits) {
  const std::string path = file("a.stl", tests::ascii_stl(tests::block()));
  EXPECT_DOUBLE_EQ(volume_of(read_surface(path)), 480);
  EXPECT_NEAR(volume_of(read_surface(path, {.unit = 25.4})), 480 * 25.4 * 25.4 * 25.4, 1e-6);
  EXPECT_THROW(read_surface(path, {.unit = 0}), UsageError);
  EXPECT_THROW(read_surface(path, {.unit = std::numeric_limits<double>::quiet_NaN()}), UsageError);
}

TEST_F(Surfaces, BinaryOnesMayBeginLikeWords) {
  std::string bytes = tests::binary_stl(tests::block());
  bytes.replace(0, 13, "solid facet n");
  EXPECT_DOUBLE_EQ(volume_of(read("a.stl", bytes)), 480);
}

TEST_F(Surfaces, WordsMayBeWrittenInAnyWay) {
  std::string text = tests::ascii_stl(tests::block());
  for (char& c : text) c = static_cast<char>(c >= 'a' && c <= 'z' && c != 'e' ? c - 32 : c);
  std::string returns;
  for (const char c : text) returns += c == '\n' ? std::string("\r\n\t ") : std::string(1, c);
  EXPECT_DOUBLE_EQ(volume_of(read("a.stl", returns)), 480);
  // Several solids in a file; some write no numbers for normals.
  Mesh half = tests::block();
  const Mesh other(half.begin() + 6, half.end());
  half.resize(6);
  std::string both = tests::ascii_stl(half) + tests::ascii_stl(other);
  both.replace(both.find("normal 0 0 0"), 12, "normal nan -nan inf");
  EXPECT_DOUBLE_EQ(volume_of(read("b.stl", both)), 480);
}

TEST_F(Surfaces, AreTurnedWhereAllOfThemFacesInwards) {
  Mesh mesh = tests::block();
  for (FacetCorners& f : mesh) tests::flip(f);
  EXPECT_DOUBLE_EQ(volume_of(read("a.stl", tests::ascii_stl(mesh))), 480);
}

TEST_F(Surfaces, LinesOfObjectsMayBeContinued) {
  const std::string mark = "\xef\xbb\xbf", corners = "v 0 0 0\nv 1 0\\\n 0\nv 0 1 0\r\nv 0 0 1\n";
  const std::string faces = "f 1 3 \\\r\n2\nf 1 2 4\nf 1 4\\\n3\nf 2 3 4 # ends with \\\n";
  const Surface surface = read("a.obj", mark + "# a comment \\\n" + corners + faces);
  EXPECT_EQ(surface.triangles.size(), 4U);
  EXPECT_DOUBLE_EQ(volume_of(surface), 1.0 / 6);
  // Lines are counted on.
  EXPECT_TRUE(contains(refusal("a.obj", corners + "f 1 2 9\n"), "a.obj:6: "));
  EXPECT_DOUBLE_EQ(volume_of(read("a.stl", mark + tests::ascii_stl(tests::block()))), 480);
}

TEST_F(Surfaces, TrianglesWithNothingInThemAreLeftOut) {
  Mesh mesh = tests::block();
  mesh.push_back({mesh[0][0], mesh[0][0], mesh[0][1]});
  const Surface surface = read("a.stl", tests::ascii_stl(mesh));
  EXPECT_EQ(surface.triangles.size(), 12U);
  EXPECT_EQ(open_at(surface), "");
}

TEST_F(Surfaces, OpenOnesNameTheirEdge) {
  Mesh mesh = tests::ball(1);
  mesh.erase(mesh.begin() + 17);
  Surface surface = read("a.stl", tests::binary_stl(mesh));
  std::string open = open_at(surface);
  EXPECT_TRUE(contains(open, "it is open: beyond the edge from (")) << open;
  EXPECT_TRUE(contains(open, "the first of 3 such edges")) << open;
  EXPECT_TRUE(contains(open, "of facet ")) << open;
  EXPECT_THROW(make_tessellated("it", surface), GeometryError);

  mesh = tests::block();
  tests::flip(mesh[4]);
  surface = read("a.stl", tests::ascii_stl(mesh));
  open = open_at(surface);
  EXPECT_TRUE(contains(open, "faces the wrong way")) << open;
  EXPECT_TRUE(contains(open, "the facet of line 30 ")) << open;  // seven lines each
  EXPECT_THROW(make_tessellated("it", surface), GeometryError);

  mesh = tests::block();
  mesh.push_back(mesh[3]);
  open = open_at(read("a.stl", tests::ascii_stl(mesh)));
  EXPECT_TRUE(contains(open, "is of 3 triangles")) << open;
}

TEST(Tessellated, IsFoundWithoutADirection) {
  const Solid block = make_tessellated("block", tests::block());
  const auto& facets = *static_cast<const kernels::Facets<double>*>(block.shape.get());
  const auto none = kernels::make_direction<double>(0, 0, 0);
  for (const Vec3& p : {Vec3{0, 0, 0}, {0, 0, 3}, {0, 0, -3}, {5, 0, 0}, {4.9, 3.9, -2.9}}) {
    EXPECT_TRUE(kernels::contains(facets, p, none, 1e-9));
  }
  for (const Vec3& p : {Vec3{0, 0, 3.1}, {0, 0, -3.1}, {6, 0, 0}}) {
    EXPECT_FALSE(kernels::contains(facets, p, none, 1e-9));
  }
}

TEST_F(Surfaces, FlatOnesEncloseNothing) {
  Mesh mesh = tests::block();
  for (FacetCorners& f : mesh) {
    for (Vec3& p : f) p.z = 1;
  }
  EXPECT_THROW(make_tessellated("it", read("a.stl", tests::ascii_stl(mesh))), GeometryError);
}

TEST_F(Surfaces, WhatIsTruncatedIsSaidSo) {
  const std::string bytes = tests::binary_stl(tests::block());
  EXPECT_TRUE(contains(refusal("a.stl", bytes.substr(0, bytes.size() - 1)), "is it truncated"));
  EXPECT_TRUE(contains(refusal("a.stl", bytes.substr(0, 83)), "is it truncated"));
  EXPECT_TRUE(contains(refusal("a.stl", bytes + "x"), "truncated"));
  EXPECT_TRUE(contains(refusal("a.stl", ""), "too short"));
  const std::string text = tests::ascii_stl(tests::block());
  EXPECT_TRUE(contains(refusal("a.stl", text.substr(0, text.size() / 2)), ":"));
  EXPECT_TRUE(contains(refusal("a.stl", "solid x\nendsolid x\n"), "no triangle"));
  EXPECT_TRUE(contains(refusal("a.obj", "v 0 0 0\n"), "no triangle"));
}

TEST_F(Surfaces, HostileOnesAreRefused) {
  // A count that the file does not have takes no memory.
  std::string bytes = tests::binary_stl(tests::block());
  bytes.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_TRUE(contains(refusal("a.stl", bytes), "4294967295 facets"));
  // Numbers that are none, or too large, behind whichever unit.
  for (const std::uint32_t bits : {0x7fc00000U, 0x7f800000U, 0xff800000U, 0x7f000000U}) {
    bytes = tests::binary_stl(tests::block());
    bytes.replace(84 + 50 + 12, 4, tests::little_endian(bits));
    EXPECT_TRUE(contains(refusal("a.stl", bytes), "facet 1 of 12"));
  }
  for (const char* word :
       {"nan", "inf", "1e999", "1e13", "0x10", "1,5", "1.0f", "--1", "+-1", ""}) {
    const std::string corner = "v 0 0 " + std::string(word) + "\n";
    EXPECT_TRUE(contains(refusal("a.obj", "v 1 2 3\n" + corner), "a.obj:2: ")) << word;
  }
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* face :
       {"0 1 2", "1 2 4", "-4 1 2", "1 2 3x", "1 2 99999999999999999999", "1 2 /"}) {
    EXPECT_TRUE(contains(refusal("a.obj", corners + "f " + face + "\n"), "a.obj:4: ")) << face;
  }
  EXPECT_TRUE(contains(refusal("a.obj", corners + "curv 0 1 1 2\n"), "a.obj:4: 'curv'"));
  std::string polygon = "f";
  for (int i = 0; i < 3000; ++i) polygon += " " + std::to_string(1 + i % 3);
  EXPECT_TRUE(contains(refusal("a.obj", corners + polygon + "\n"), "more than 1000"));
  EXPECT_TRUE(contains(refusal("a.stl", tests::ascii_stl(tests::block()), {.max_triangles = 11}),
                       "more than 11 triangles"));
  EXPECT_TRUE(contains(refusal("a.stl", tests::ascii_stl(tests::block()), {.max_bytes = 100}),
                       "longer than 100 bytes"));
  EXPECT_TRUE(contains(refusal("a.ply", "ply\n"), ".stl or .obj"));
}

TEST_F(Surfaces, WhatIsNoFileIsRefused) {
  EXPECT_THROW(read_surface(folder_.file("none.stl")), SurfaceError);
  EXPECT_THROW(read_surface("/dev/zero"), SurfaceError);
  const std::string pipe = folder_.file("pipe.stl");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(read_surface(pipe), SurfaceError);  // and does not wait for a writer
  for (const char* name : {"large.stl", "large.obj"}) {
    const std::string pointer =
        "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 5\n";
    EXPECT_TRUE(contains(refusal(name, pointer), "it is a Git LFS pointer")) << name;
  }
}

TEST_F(Surfaces, ChangedBytesNeverCrash) {
  std::minstd_rand random(1);
  const Mesh mesh = tests::ball(1);
  int read = 0, closed = 0;
  const auto attempt = [&](const std::string& name, std::string bytes) {
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0:
          bytes[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          bytes.erase(at, 1 + random() % 60);
          break;
        case 2:
          bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 60));
          break;
        default:
          bytes[at] = "0123456789.-e \nvf/"[random() % 18];
          break;
      }
      if (bytes.empty()) return;
    }
    try {
      const Surface surface = read_surface(file(name, bytes));
      ++read;
      make_tessellated("it", surface);
      ++closed;
    } catch (const Error&) {
    }
  };
  for (int i = 0; i < 500; ++i) {
    attempt("a.stl", tests::binary_stl(mesh));
    attempt("a.stl", tests::ascii_stl(mesh));
    attempt("a.obj", tests::obj(mesh));
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(closed, 10);
}

/// Compares the area of the polygon's triangles, in the plane z = 0, with that of the polygon.
void expect_cut(const std::vector<Vec3>& polygon, double area) {
  const auto triangles = surface::cut(polygon);
  EXPECT_EQ(triangles.size(), polygon.size() - 2);
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 u = polygon[b] - polygon[a], v = polygon[c] - polygon[a];
    const double part = (u.x * v.y - u.y * v.x) / 2;
    EXPECT_GE(part, 0);
    sum += part;
  }
  EXPECT_NEAR(sum, area, 1e-9 * area);
}

TEST(Polygons, AreCutWhateverTheirOutline) {
  expect_cut({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.5);
  expect_cut({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}}, 6);               // a dent
  expect_cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}}, 4.5);  // on a line
  expect_cut(
      {{0, 0, 0}, {9, 0, 0}, {9, 1, 0}, {1, 1, 0}, {1, 8, 0}, {9, 8, 0}, {9, 9, 0}, {0, 9, 0}},
      25);  // a bracket
  std::vector<Vec3> comb;
  for (const PlanarPoint& p : tests::comb()) comb.push_back({p.x, p.y, 0});
  const auto triangles = surface::cut(comb);
  EXPECT_EQ(triangles.size(), comb.size() - 2);
}

TEST_F(Surfaces, FacesOfManyCornersAreCut) {
  // A prism over a comb: two faces that are not convex, and a wall of quadrangles.
  const std::vector<PlanarPoint> comb = tests::comb();
  std::string text, bottom = "f", top = "f", walls;
  const std::size_t count = comb.size();
  for (const double z : {-2.0, 2.0}) {
    for (const PlanarPoint& p : comb) text += "v " + tests::words_of({p.x, p.y, z}) + "\n";
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    top += " " + std::to_string(count + i + 1);
    bottom += " " + std::to_string(count - i);
    walls += "f";
    for (const std::size_t c : {i, next, count + next, count + i})
      walls += " " + std::to_string(c + 1);
    walls += "\n";
  }
  const Surface surface = read("comb.obj", text + top + "\n" + bottom + " # both\n" + walls);
  EXPECT_EQ(open_at(surface), "");
  const Solid expected =
      make_extruded("comb", comb, std::vector<ExtrudedSection>{{-2, 0, 0, 1}, {2, 0, 0, 1}});
  EXPECT_NEAR(volume_of(surface), capacity(expected), 1e-9 * capacity(expected));
}

}  // namespace
}  // namespace navjit

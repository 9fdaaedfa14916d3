// Files made by gzip are read, whatever their names; damaged ones and bombs are refused.
#include <zlib.h>

#include "tests/geometry/gdml/gdml_files.hpp"

namespace navjit::testing {
namespace {

std::string gzipped(const std::string& text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, static_cast<uLong>(text.size())) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

using GdmlGzip = GdmlFiles;

TEST_F(GdmlGzip, IsReadByContent) {
  const std::string text = Gdml{.structure = volume("W", physvol("D"))};
  for (const char* name : {"det.gdml.gz", "det.gdml"}) {
    EXPECT_EQ(top(read_world(write(name, gzipped(text)))).daughters.size(), 1u);
  }
  // Several members, and what pads a tape.
  const std::string parts = gzipped(text.substr(0, 100)) + gzipped("") + gzipped(text.substr(100)) +
                            std::string(512, '\0');
  EXPECT_EQ(top(read_world(write("parts.gz", parts))).daughters.size(), 1u);
}

TEST_F(GdmlGzip, InEntitiesAndModules) {
  write("part.xml", gzipped("<box name='big' x='60' y='60' z='60'/>"));
  write("module.gdml", gzipped(Gdml{.structure = volume("M", physvol("D")), .world = "M"}));
  const World world = read(
      Gdml{.solids = "&part;",
           .structure = "<volume name='W'><solidref ref='big'/><physvol><file name='module.gdml'/>"
                        "</physvol></volume>",
           .doctype = "<!DOCTYPE gdml [<!ENTITY part SYSTEM 'part.xml'>]>"});
  EXPECT_EQ(top(world).solid.extent.max.x, 30);
  EXPECT_EQ(top(world).touchables, 3u);
}

TEST_F(GdmlGzip, ErrorsNameTheLineOfTheText) {
  EXPECT_HAS(error(write("det.gdml.gz", gzipped("<gdml>\n</gdml>"))), "det.gdml.gz:1: <gdml>");
}

TEST_F(GdmlGzip, DamagedFilesAreRefused) {
  const std::string good = gzipped(Gdml{.structure = volume("W")});
  for (std::size_t size = 2; size < good.size(); ++size) {
    const std::string message = error(write("short.gz", good.substr(0, size)));
    EXPECT_HAS(message, "short.gz:0: cannot be read: it is gzipped and ");
  }
  std::string damaged = good;
  damaged[good.size() - 6] ^= 1;  // the checksum
  EXPECT_HAS(error(write("bad.gz", damaged)),
             "bad.gz:0: cannot be read: it is gzipped and damaged");
  EXPECT_HAS(error(write("more.gz", good + "rest")), "it is gzipped and damaged");
}

TEST_F(GdmlGzip, BombsAreRefused) {
  const std::string bomb = gzipped(std::string(200u << 20, ' '));
  ASSERT_LT(bomb.size(), 1u << 20);
  GdmlOptions options;
  options.limits.max_bytes = 2u << 20;
  EXPECT_HAS(error(write("bomb.gz", bomb), options),
             "it is gzipped, and unpacks to too much text; raise GdmlLimits::max_bytes");
  // A bomb in a bomb is no text.
  EXPECT_HAS(error(write("twice.gz", gzipped(bomb)), options), "not well-formed XML");
}

}  // namespace
}  // namespace navjit::testing

#include "geometry/gdml/gzip.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>

namespace navjit::gdml {
namespace {

constexpr int gzip_only = 15 + 16;  // the largest window; no format other than gzip
constexpr std::string_view magic = "\x1f\x8b";

struct Inflater {
  Inflater() {
    if (inflateInit2(&stream, gzip_only) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream); }

  z_stream stream{};
};

}  // namespace

bool is_gzipped(std::string_view contents) { return contents.starts_with(magic); }

Expected<std::string> unpack_gzip(std::string_view contents, std::size_t most) {
  std::string text;
  Inflater inflater;
  z_stream& stream = inflater.stream;
  std::array<char, 1 << 16> block;
  int status = Z_OK;
  for (;;) {
    if (stream.avail_in == 0 && !contents.empty()) {
      constexpr std::size_t piece = 1u << 30;
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(contents.data()));
      stream.avail_in = static_cast<uInt>(std::min(piece, contents.size()));
      contents.remove_prefix(stream.avail_in);
    }
    if (status == Z_STREAM_END) {
      // Members follow one another; zeros that pad a file to the length of a block are skipped.
      while (stream.avail_in > 0 && *stream.next_in == 0) {
        ++stream.next_in;
        --stream.avail_in;
      }
      if (stream.avail_in == 0 && contents.empty()) return text;
      if (stream.avail_in == 0) continue;
      inflateReset(&stream);
    }
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    const std::size_t made = block.size() - stream.avail_out;
    if (made > most - text.size()) {
      return Failure{
          "it is gzipped, and unpacks to too much text; raise GdmlLimits::max_bytes if this is "
          "meant"};
    }
    text.append(block.data(), made);
    if (status == Z_BUF_ERROR && stream.avail_in == 0 && contents.empty()) {
      return Failure{"it is gzipped and ends too early; copy or make it again"};
    }
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) {
      return Failure{"it is gzipped and damaged; copy or make it again"};
    }
  }
}

}  // namespace navjit::gdml

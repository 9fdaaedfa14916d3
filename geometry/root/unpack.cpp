#include "geometry/root/unpack.hpp"

#include <lz4.h>
#include <lzma.h>
#include <zlib.h>
#include <zstd.h>

#include <new>

#include "geometry/root/bytes.hpp"

namespace navjit::root {
namespace {

[[noreturn]] void damaged(const char* what) {
  throw FormatError(std::string("its ") + what +
                    " data are damaged; copy the file again, or make it again");
}

/// `window` is zlib's parameter; it is negative for a stream without zlib's header.
void inflate_into(std::string_view packed, char* out, std::size_t size, int window) {
  z_stream stream{};
  if (inflateInit2(&stream, window) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out);
  stream.avail_out = static_cast<uInt>(size);
  const int status = inflate(&stream, Z_FINISH);
  const bool whole = status == Z_STREAM_END && stream.avail_out == 0;
  inflateEnd(&stream);
  if (status == Z_MEM_ERROR) throw std::bad_alloc();
  if (!whole) damaged("zlib");
}

void unpack_lzma(std::string_view packed, char* out, std::size_t size) {
  std::uint64_t memory = std::uint64_t{256} << 20;
  std::size_t in_at = 0, out_at = 0;
  const lzma_ret status = lzma_stream_buffer_decode(
      &memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(packed.data()), &in_at,
      packed.size(), reinterpret_cast<std::uint8_t*>(out), &out_at, size);
  if (status == LZMA_MEM_ERROR) throw std::bad_alloc();
  if (status != LZMA_OK || out_at != size) damaged("LZMA");
}

void unpack_lz4(std::string_view packed, char* out, std::size_t size) {
  constexpr std::size_t checksum = 8;
  if (packed.size() < checksum) damaged("LZ4");
  const int made =
      LZ4_decompress_safe(packed.data() + checksum, out, static_cast<int>(packed.size() - checksum),
                          static_cast<int>(size));
  if (made < 0 || static_cast<std::size_t>(made) != size) damaged("LZ4");
}

void unpack_zstd(std::string_view packed, char* out, std::size_t size) {
  if (ZSTD_decompress(out, size, packed.data(), packed.size()) != size) damaged("Zstandard");
}

std::size_t little_endian(std::string_view three) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(three[i]));
  };
  return byte(0) | byte(1) << 8 | byte(2) << 16;
}

}  // namespace

std::string unpack(std::string_view blocks, std::size_t size) {
  Bytes in(blocks);
  std::string all;
  while (all.size() < size) {
    const std::string_view method = in.take(2);
    in.skip(1);
    const std::size_t packed_size = little_endian(in.take(3));
    const std::size_t unpacked_size = little_endian(in.take(3));
    const std::string_view packed = in.take(packed_size);
    if (unpacked_size == 0 || unpacked_size > size - all.size()) damaged("packed");
    const std::size_t at = all.size();
    all.resize(at + unpacked_size);
    char* out = all.data() + at;
    if (method == "ZL") {
      inflate_into(packed, out, unpacked_size, MAX_WBITS);
    } else if (method == "CS") {
      inflate_into(packed, out, unpacked_size, -MAX_WBITS);
    } else if (method == "XZ") {
      unpack_lzma(packed, out, unpacked_size);
    } else if (method == "L4") {
      unpack_lz4(packed, out, unpacked_size);
    } else if (method == "ZS") {
      unpack_zstd(packed, out, unpacked_size);
    } else {
      damaged("packed");
    }
  }
  return all;
}

}  // namespace navjit::root

// Reads numbers and texts of ROOT's files in sequence: big-endian, never beyond the end.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "navjit/root.hpp"

namespace navjit::root {

/// The bytes are not what the format has there. The message does not name the file.
struct FormatError : RootError {
  using RootError::RootError;
};

/// A place in a sequence of bytes, from which they are read.
class Bytes {
 public:
  explicit Bytes(std::string_view all, std::size_t at = 0) : all_(all), at_(at) {
    if (at > all.size()) too_short();
  }

  std::size_t at() const { return at_; }
  std::size_t left() const { return all_.size() - at_; }
  std::string_view all() const { return all_; }

  /// All of these throw FormatError where too few bytes are left.
  std::string_view take(std::size_t count) {
    if (count > left()) too_short();
    at_ += count;
    return all_.substr(at_ - count, count);
  }
  void skip(std::size_t count) { take(count); }
  template <class Unsigned>
  Unsigned number() {
    const std::string_view bytes = take(sizeof(Unsigned));
    Unsigned value = 0;
    for (const char byte : bytes) {
      value = static_cast<Unsigned>(value << 7 << 1 | static_cast<unsigned char>(byte));
    }
    return value;
  }
  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(u64()); }
  /// A TString: a length of one byte, or one of four bytes after the byte 255, and then the text.
  std::string_view text() {
    const std::size_t brief = u8();
    return take(brief == 255 ? u32() : brief);
  }
  /// A text up to a zero byte, which is skipped.
  std::string_view zero_ended() {
    const std::size_t end = all_.find('\0', at_);
    if (end == std::string_view::npos) too_short();
    const std::string_view text = all_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }

 private:
  [[noreturn]] static void too_short() { throw FormatError("it ends too early"); }

  std::string_view all_;
  std::size_t at_;
};

/// What stands before an object or a part of one: its length, and the version of its class.
struct VersionHeader {
  std::uint16_t version = 0;
  std::size_t end = 0;  ///< 0: the file does not give it
};

constexpr std::uint32_t byte_count_mask = 0x40000000;

inline VersionHeader version_header(Bytes& bytes) {
  VersionHeader header;
  Bytes ahead = bytes;
  const std::uint32_t count = ahead.u32();
  if ((count & byte_count_mask) != 0) {
    bytes = ahead;
    const std::size_t length = count & ~byte_count_mask;
    if (length > bytes.left() || length < 2) throw FormatError("an object has no such length");
    header.end = bytes.at() + length;
  }
  header.version = bytes.u16();
  return header;
}

/// The bits of a TObject, which is the only one that has no length before it.
inline std::uint32_t object_bits(Bytes& bytes) {
  bytes.skip(2);  // version
  bytes.skip(4);  // unique number
  const std::uint32_t bits = bytes.u32();
  constexpr std::uint32_t is_referenced = 1U << 4;
  if ((bits & is_referenced) != 0) bytes.skip(2);
  return bits;
}

}  // namespace navjit::root

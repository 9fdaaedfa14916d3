// Reads STL: triangles one by one, in binary form or as words.
#include <algorithm>
#include <bit>

#include "geometry/surface/reading.hpp"

namespace navjit::surface {
namespace {

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

void read_binary(const Place& at, std::string_view bytes, Collector& into) {
  const std::size_t count = number_at(bytes, header_bytes - 4);
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t begin = header_bytes + f * facet_bytes + 12;  // after the normal
    std::uint32_t corner[3];
    for (std::size_t c = 0; c < 3; ++c) {
      double xyz[3];
      for (std::size_t k = 0; k < 3; ++k) {
        xyz[k] = std::bit_cast<float>(number_at(bytes, begin + 12 * c + 4 * k));
      }
      try {
        corner[c] = into.corner(xyz, 0);
      } catch (const SurfaceError&) {
        refuse(at, 0,
               "facet " + std::to_string(f) + " of " + std::to_string(count) +
                   ": a corner is not at a finite place within 1e12 mm");
      }
    }
    into.triangle(corner[0], corner[1], corner[2], f);
  }
}

bool is_word(std::string_view word, std::string_view expected) {
  return std::equal(word.begin(), word.end(), expected.begin(), expected.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

class AsciiReader {
 public:
  AsciiReader(const Place& at, std::string_view text, Collector& into)
      : at_(at), words_(text), into_(into) {}

  void read() {
    into_.origins_are_lines();
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (!is_word(word, "solid")) refuse_word(word, "'solid'");
      words_.skip_line();  // its name
      read_facets();
    }
  }

 private:
  [[noreturn]] void refuse_word(std::string_view word, const std::string& expected) {
    refuse(at_, words_.line(),
           word.empty() ? "the file ends where " + expected + " should be: is it truncated?"
                        : "'" + std::string(word.substr(0, 40)) + "' stands where " + expected +
                              " should be");
  }
  void expect(std::string_view expected) {
    const std::string_view word = words_.next();
    if (!is_word(word, expected)) refuse_word(word, "'" + std::string(expected) + "'");
  }
  double read_number() {
    const std::string_view word = words_.next();
    const auto value = number(word);
    if (!value) refuse_word(word, "a number");
    return *value;
  }

  void read_facets() {
    for (;;) {
      const std::string_view word = words_.next();
      if (is_word(word, "endsolid")) break;
      if (!is_word(word, "facet")) refuse_word(word, "'facet' or 'endsolid'");
      const std::size_t line = words_.line();
      expect("normal");
      for (int k = 0; k < 3; ++k) words_.next();  // not looked at: some programs write nan there
      expect("outer");
      expect("loop");
      std::uint32_t corner[3];
      for (std::uint32_t& c : corner) {
        expect("vertex");
        const std::size_t its_line = words_.line();
        double xyz[3];
        for (double& x : xyz) x = read_number();
        c = into_.corner(xyz, its_line);
      }
      expect("endloop");
      expect("endfacet");
      into_.triangle(corner[0], corner[1], corner[2], line);
    }
    words_.skip_line();  // its name again
  }

  Place at_;
  Words words_;
  Collector& into_;
};

}  // namespace

void read_stl(const Place& at, std::string_view bytes, Collector& into) {
  // Binary files may begin with "solid", too: their length shows what they are.
  const bool long_enough = bytes.size() >= header_bytes;
  const std::size_t count = long_enough ? number_at(bytes, header_bytes - 4) : 0;
  if (long_enough && bytes.size() == header_bytes + count * facet_bytes) {
    return read_binary(at, bytes, into);
  }
  const std::string_view text = without_mark(bytes);
  if (is_word(Words(text).next(), "solid")) return AsciiReader(at, text, into).read();
  if (!long_enough) refuse(at, 0, "it is too short for STL: is it truncated?");
  refuse(at, 0,
         "binary STL of " + std::to_string(count) + " facets has " +
             std::to_string(header_bytes + count * facet_bytes) + " bytes, and this has " +
             std::to_string(bytes.size()) + ": is it truncated?");
}

}  // namespace navjit::surface

// What the readers of surfaces share. Private to geometry/surface.
#pragma once

#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "navjit/surface.hpp"

namespace navjit::surface {

/// A file that is being read, for messages.
struct Place {
  const std::string& file;
  const SurfaceOptions& options;
};

/// "FILE:LINE: what", or "FILE: what" where the line is 0.
[[noreturn]] void refuse(const Place& at, std::size_t line, const std::string& what);

/// Collects corners, each once, and triangles.
class Collector {
 public:
  explicit Collector(const Place& at) : at_(at) {}

  /// The number of the corner at this place, which is in the file's units. Throws SurfaceError,
  /// which names `line`, unless the place is finite.
  std::uint32_t corner(const double (&xyz)[3], std::size_t line);
  /// Adds a triangle, unless it has less than three different corners. Throws SurfaceError if there
  /// are too many triangles. `origin`: as in Surface.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t origin);
  const Vec3& at(std::uint32_t corner) const { return surface_.corners[corner]; }
  void origins_are_lines() { surface_.origins_are_lines = true; }

  /// The surface, with only the corners that triangles use. Throws SurfaceError if there are none.
  Surface finish();

 private:
  struct SamePlace {
    bool operator()(const Vec3& a, const Vec3& b) const { return a == b; }
  };
  struct HashOfPlace {
    std::size_t operator()(const Vec3& p) const {
      std::size_t hash = 0;
      for (const double x : {p.x, p.y, p.z}) {
        hash = (hash ^ std::hash<double>{}(x)) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 32;
      }
      return hash;
    }
  };
  Place at_;
  Surface surface_;
  std::unordered_map<Vec3, std::uint32_t, HashOfPlace, SamePlace> known_;
};

/// A text without the mark with which some editors let it begin (UTF-8's byte order mark).
inline std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

/// The words of a text, with the line that each is on.
class Words {
 public:
  /// `continued`: a backslash at the end of a line makes one line of it and the next.
  explicit Words(std::string_view text, bool continued = false)
      : text_(text), continued_(continued) {}

  /// The next word of the text; empty at its end.
  std::string_view next();
  /// The next word of the same line; empty at its end.
  std::string_view next_in_line();
  /// To the end of the line, whatever it ends with: a name or comment may end with a backslash.
  void skip_line();
  bool at_end() const { return at_ >= text_.size(); }
  std::size_t line() const { return line_; }

 private:
  std::string_view word();
  /// The end of the backslash and line end that stand here; where none do, the place itself.
  std::size_t end_of_continuation() const;

  std::string_view text_;
  bool continued_;
  std::size_t at_ = 0, line_ = 1;
};

/// A decimal number and nothing else; nothing for any other word.
inline std::optional<double> number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

void read_stl(const Place& at, std::string_view bytes, Collector& into);
void read_obj(const Place& at, std::string_view text, Collector& into);

}  // namespace navjit::surface

// Reads Wavefront OBJ: corners first, then polygons by the numbers of their corners.
#include <algorithm>
#include <array>
#include <vector>

#include "geometry/surface/polygon.hpp"
#include "geometry/surface/reading.hpp"

namespace navjit::surface {
namespace {

/// More corners of one face are refused: cutting takes time that grows with their square.
constexpr std::size_t most_corners = 1000;

/// What says nothing about the shape, or only how it looks.
constexpr std::array ignored{
    "vn",  "vt", "vp",    "g",      "o",      "s",        "usemtl",   "mtllib",     "l",        "p",
    "lod", "mg", "bevel", "maplib", "usemap", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

class ObjReader {
 public:
  ObjReader(const Place& at, std::string_view text, Collector& into)
      : at_(at), words_(text, true), into_(into) {}

  void read() {
    into_.origins_are_lines();
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (word == "v") {
        read_corner();
      } else if (word == "f" || word == "fo") {
        read_face();
      } else if (!word.starts_with('#') &&
                 std::find(ignored.begin(), ignored.end(), word) == ignored.end()) {
        refuse(at_, words_.line(),
               "'" + std::string(word.substr(0, 40)) +
                   "' is not read; write the surface as corners (v) and faces (f) alone");
      }
      words_.skip_line();
    }
  }

 private:
  void read_corner() {
    double xyz[3];
    for (double& x : xyz) {
      const auto value = number(words_.next_in_line());
      if (!value) refuse(at_, words_.line(), "a corner (v) needs three numbers");
      x = *value;
    }
    corners_.push_back(into_.corner(xyz, words_.line()));
  }

  /// "17", "17/3", "17//3", "17/3/3"; a negative number counts back from the last corner so far.
  std::uint32_t corner_of(std::string_view word) {
    const std::string_view first = word.substr(0, word.find('/'));
    long long index = 0;
    const auto [end, error] = std::from_chars(first.data(), first.data() + first.size(), index);
    const auto count = static_cast<long long>(corners_.size());
    if (error != std::errc{} || end != first.data() + first.size() || index == 0 || index > count ||
        index < -count) {
      refuse(at_, words_.line(),
             "'" + std::string(word.substr(0, 40)) + "' is no corner: there are " +
                 std::to_string(count) + " before this line");
    }
    return corners_[static_cast<std::size_t>(index > 0 ? index - 1 : count + index)];
  }

  void read_face() {
    face_.clear();
    points_.clear();
    for (std::string_view word = words_.next_in_line(); !word.empty() && !word.starts_with('#');
         word = words_.next_in_line()) {
      const std::uint32_t corner = corner_of(word);
      if (!face_.empty() && face_.back() == corner) continue;
      if (face_.size() == most_corners) {
        refuse(at_, words_.line(),
               "a face of more than " + std::to_string(most_corners) + " corners; cut it");
      }
      face_.push_back(corner);
      points_.push_back(into_.at(corner));
    }
    if (face_.size() > 1 && face_.front() == face_.back()) {
      face_.pop_back();
      points_.pop_back();
    }
    if (face_.size() < 3) return;  // it encloses nothing
    const auto triangles = cut(points_);
    if (triangles.empty()) {
      refuse(at_, words_.line(), "the outline of this face crosses itself; cut it into triangles");
    }
    for (const auto& [a, b, c] : triangles) {
      into_.triangle(face_[a], face_[b], face_[c], words_.line());
    }
  }

  Place at_;
  Words words_;
  Collector& into_;
  std::vector<std::uint32_t> corners_;  ///< by number in the file
  std::vector<std::uint32_t> face_;
  std::vector<Vec3> points_;
};

}  // namespace

void read_obj(const Place& at, std::string_view text, Collector& into) {
  ObjReader(at, without_mark(text), into).read();
}

}  // namespace navjit::surface

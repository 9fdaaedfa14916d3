#include "geometry/surface/reading.hpp"

#include "geometry/input_file.hpp"
#include "geometry/printable.hpp"

namespace navjit {
namespace surface {

void refuse(const Place& at, std::size_t line, const std::string& what) {
  throw SurfaceError(printable_path(at.file) + (line > 0 ? ":" + std::to_string(line) : "") + ": " +
                     what);
}

std::uint32_t Collector::corner(const double (&xyz)[3], std::size_t line) {
  const double unit = at_.options.unit;
  // Negative zeros become positive, since they are the same place.
  const Vec3 p{xyz[0] * unit + 0.0, xyz[1] * unit + 0.0, xyz[2] * unit + 0.0};
  constexpr double most = 1e12;  // mm; squares and products of such lengths are finite
  if (!(std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most)) {
    refuse(at_, line, "a corner is not at a finite place within 1e12 mm");
  }
  const auto [found, added] =
      known_.try_emplace(p, static_cast<std::uint32_t>(surface_.corners.size()));
  if (added) surface_.corners.push_back(p);
  return found->second;
}

void Collector::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t origin) {
  if (a == b || b == c || c == a) return;
  if (surface_.triangles.size() == at_.options.max_triangles) {
    refuse(at_, surface_.origins_are_lines ? origin : 0,
           "more than " + std::to_string(at_.options.max_triangles) +
               " triangles; write the surface more coarsely");
  }
  surface_.triangles.push_back({a, b, c});
  surface_.origins.push_back(origin);
}

Surface Collector::finish() {
  if (surface_.triangles.empty()) refuse(at_, 0, "there is no triangle in it");
  constexpr std::uint32_t unused = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(surface_.corners.size(), unused);
  std::vector<Vec3> corners;
  for (Surface::Triangle& t : surface_.triangles) {
    for (std::uint32_t& corner : t) {
      if (number[corner] == unused) {
        number[corner] = static_cast<std::uint32_t>(corners.size());
        corners.push_back(surface_.corners[corner]);
      }
      corner = number[corner];
    }
  }
  surface_.corners = std::move(corners);
  return std::move(surface_);
}

std::size_t Words::end_of_continuation() const {
  if (!continued_ || text_[at_] != '\\') return at_;
  std::size_t end = at_ + 1;
  if (end < text_.size() && text_[end] == '\r') ++end;
  return end < text_.size() && text_[end] == '\n' ? end + 1 : at_;
}

std::string_view Words::word() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) > ' ' &&
         end_of_continuation() == at_) {
    ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

std::string_view Words::next() {
  for (;;) {
    const std::string_view found = next_in_line();
    if (!found.empty() || at_end()) return found;
    ++at_;
    ++line_;
  }
}

std::string_view Words::next_in_line() {
  while (at_ < text_.size() && text_[at_] != '\n') {
    if (const std::size_t end = end_of_continuation(); end != at_) {
      at_ = end;
      ++line_;
    } else if (static_cast<unsigned char>(text_[at_]) <= ' ') {
      ++at_;
    } else {
      return word();
    }
  }
  return {};
}

void Words::skip_line() {
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
}

}  // namespace surface

Surface read_surface(const std::filesystem::path& path, const SurfaceOptions& options) {
  const std::string file = path.string();
  const surface::Place at{file, options};
  if (!(options.unit > 0 && std::isfinite(options.unit))) {
    throw UsageError("the unit of a surface is not a length above 0");
  }
  std::string kind = path.extension().string();
  for (char& c : kind) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (kind != ".stl" && kind != ".obj") {
    surface::refuse(at, 0, "a surface is a file .stl or .obj; rename it if it is one");
  }
  const Expected<std::string> bytes =
      read_regular_file(path, options.max_bytes,
                        "it is longer than " + std::to_string(options.max_bytes) +
                            " bytes; write the surface more coarsely");
  if (!bytes) surface::refuse(at, 0, "cannot be read: " + bytes.failure().message);
  surface::Collector collector(at);
  (kind == ".stl" ? surface::read_stl : surface::read_obj)(at, *bytes, collector);
  return collector.finish();
}

}  // namespace navjit

#include "common/rays.hpp"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string_view>

#include "common/numbers.hpp"
#include "navjit/errors.hpp"
#include "navjit/runtime.hpp"

namespace navjit::common {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

void RayFile::Close::operator()(gzFile_s* file) const { gzclose(file); }

void RayFile::fail(const std::string& what) const {
  throw Error(path_ + ":" + std::to_string(line_) + ": " + what);
}

RayFile::RayFile(std::string path) : path_(std::move(path)), file_(gzopen(path_.c_str(), "rb")) {
  if (!file_) throw Error(path_ + ": cannot be opened");
  std::string_view header;
  if (!read_line(header)) throw Error(path_ + ": no rays");
  // Spreadsheets begin UTF-8 with this mark.
  if (header.starts_with("\xef\xbb\xbf")) header.remove_prefix(3);
  std::string names(header);
  std::erase_if(names, is_blank);
  if (names != "x,y,z,dx,dy,dz") fail("the header must be x,y,z,dx,dy,dz");
}

/// False at the end of the file.
bool RayFile::read_line(std::string_view& row) {
  if (gzgets(file_.get(), text_, sizeof text_) == nullptr) {
    int error = 0;
    const char* message = gzerror(file_.get(), &error);
    if (error != Z_OK && error != Z_STREAM_END) throw Error(path_ + ": " + message);
    return false;
  }
  ++line_;
  row = text_;
  if (row.size() + 1 == sizeof text_) fail("the line is too long");
  while (!row.empty() && (row.back() == '\n' || row.back() == '\r')) row.remove_suffix(1);
  return true;
}

std::optional<Ray> RayFile::next() {
  std::string_view row;
  do {
    if (!read_line(row)) {
      if (rays_ == 0) throw Error(path_ + ": no rays");
      return std::nullopt;
    }
  } while (row.empty());
  double value[6];
  const char *at = row.data(), *end = row.data() + row.size();
  const auto skip_blanks = [&] {
    while (at != end && is_blank(*at)) ++at;
  };
  for (int i = 0; i < 6; ++i) {
    skip_blanks();
    if (end - at > 1 && *at == '+' && at[1] != '-') ++at;
    const auto [next, error] = std::from_chars(at, end, value[i]);
    if (error != std::errc{} || !std::isfinite(value[i])) {
      fail("field " + std::to_string(i + 1) + " is not a finite number");
    }
    at = next;
    skip_blanks();
    if (i < 5) {
      if (at == end || *at != ',') fail("six numbers are needed");
      ++at;
    }
  }
  if (at != end) fail("more than six numbers");
  const double length = std::hypot(value[3], value[4], value[5]);
  if (!(length > 0) || !std::isfinite(length)) fail("the direction has no length");
  ++rays_;
  return Ray{{value[0], value[1], value[2]},
             {value[3] / length, value[4] / length, value[5] / length}};
}

std::vector<Ray> read_rays(const std::string& path) {
  RayFile file(path);
  std::vector<Ray> rays;
  while (const std::optional<Ray> ray = file.next()) rays.push_back(*ray);
  return rays;
}

RayStream::RayStream(const std::string& text, const RaySource& source, const World& world,
                     const Part& part) {
  std::uint64_t all = 0;
  if (looks_like_number(text)) {
    all = parse_count(text);
    maker_.emplace(world, source);
  } else {
    file_.emplace(text);
    if (part.whole()) return;
    for (RayFile file(text); file.next();) ++all;
  }
  counted_ = true;
  first_ = part.begin(all);
  count_ = part.end(all) - first_;
  if (file_) {
    for (std::uint64_t i = 0; i < first_; ++i) file_->next();
  }
}

std::vector<Ray> RayStream::next(std::size_t most) {
  std::vector<Ray> rays;
  while (rays.size() < most) {
    if (counted_ && made_ == count_) break;
    if (file_) {
      const std::optional<Ray> ray = file_->next();
      if (!ray) break;
      rays.push_back(*ray);
    } else {
      rays.push_back(maker_->ray(first_ + made_));
    }
    ++made_;
  }
  return rays;
}

std::vector<Ray> rays_of(const std::string& text, const RaySource& source, const World& world) {
  return RayStream(text, source, world).next(std::numeric_limits<std::size_t>::max());
}

void check_origin(const RaySource& source, const std::shared_ptr<const World>& world) {
  if (!source.origin) return;
  Runtime generic(world, {.jit = JitMode::off});
  Navigator navigator = generic.navigator();
  const Vec3& p = *source.origin;
  // A point on the surface may be outside for half of all directions only.
  for (const double sign : {1.0, -1.0}) {
    for (const Vec3 direction : {Vec3{sign, 0, 0}, Vec3{0, sign, 0}, Vec3{0, 0, sign}}) {
      if (navigator.locate(p, direction).inside()) return;
    }
  }
  const Extent& e = world->volumes[world->top].solid.extent;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "the origin %.9g,%.9g,%.9g is outside the world, which is within %.9g,%.9g,%.9g and "
      "%.9g,%.9g,%.9g mm: no ray would meet anything",
      p.x, p.y, p.z, e.min.x, e.min.y, e.min.z, e.max.x, e.max.y, e.max.z);
  throw Error(text);
}

}  // namespace navjit::common

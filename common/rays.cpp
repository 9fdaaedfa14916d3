#include "common/rays.hpp"

#include <zlib.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>

namespace navjit::common {
namespace {

struct CloseFile {
  void operator()(gzFile file) const { gzclose(file); }
};

/// splitmix64 (Steele, Lea and Flood 2014): a good generator even from consecutive seeds.
struct Generator {
  std::uint64_t state;
  double operator()() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
};

[[noreturn]] void fail(const std::string& path, int line, const std::string& what) {
  throw std::runtime_error(path + ":" + std::to_string(line) + ": " + what);
}

}  // namespace

std::vector<Ray> read_rays(const std::string& path) {
  const std::unique_ptr<gzFile_s, CloseFile> file(gzopen(path.c_str(), "rb"));
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  std::vector<Ray> rays;
  char text[1024];
  for (int line = 1; gzgets(file.get(), text, sizeof text) != nullptr; ++line) {
    std::string_view row(text);
    if (row.size() + 1 == sizeof text) fail(path, line, "the line is too long");
    while (!row.empty() && (row.back() == '\n' || row.back() == '\r')) row.remove_suffix(1);
    if (line == 1) {
      if (row != "x,y,z,dx,dy,dz") fail(path, line, "the header must be x,y,z,dx,dy,dz");
      continue;
    }
    if (row.empty()) continue;
    double value[6];
    const char *at = row.data(), *end = row.data() + row.size();
    for (int i = 0; i < 6; ++i) {
      const auto [next, error] = std::from_chars(at, end, value[i]);
      if (error != std::errc{} || !std::isfinite(value[i])) {
        fail(path, line, "field " + std::to_string(i + 1) + " is not a finite number");
      }
      at = next;
      if (i < 5) {
        if (at == end || *at != ',') fail(path, line, "six numbers are needed");
        ++at;
      }
    }
    if (at != end) fail(path, line, "more than six numbers");
    const double length = std::hypot(value[3], value[4], value[5]);
    if (!(length > 0) || !std::isfinite(length)) fail(path, line, "the direction has no length");
    rays.push_back({{value[0], value[1], value[2]},
                    {value[3] / length, value[4] / length, value[5] / length}});
  }
  int error = 0;
  const char* message = gzerror(file.get(), &error);
  if (error != Z_OK && error != Z_STREAM_END) throw std::runtime_error(path + ": " + message);
  if (rays.empty()) throw std::runtime_error(path + ": no rays");
  return rays;
}

Ray make_ray(const RaySource& source, const World& world, std::uint64_t index) {
  Generator random{source.seed * 0xd1342543de82ef95U + index * 0x2545f4914f6cdd1dU};
  Ray ray;
  if (source.origin) {
    ray.position = *source.origin;
  } else {
    const Extent& e = world.volumes[world.top].solid.extent;
    ray.position = {e.min.x + random() * (e.max.x - e.min.x),
                    e.min.y + random() * (e.max.y - e.min.y),
                    e.min.z + random() * (e.max.z - e.min.z)};
  }
  const double phi = 2 * std::numbers::pi * random();
  double cosine, sine;
  if (source.eta) {
    const double eta = source.eta->first + random() * (source.eta->second - source.eta->first);
    cosine = std::tanh(eta);
    sine = 1 / std::cosh(eta);
  } else {
    cosine = 2 * random() - 1;
    sine = std::sqrt((1 - cosine) * (1 + cosine));
  }
  const double x = sine * std::cos(phi), y = sine * std::sin(phi);
  const double length = std::hypot(x, y, cosine);
  ray.direction = {x / length, y / length, cosine / length};
  return ray;
}

std::vector<Ray> rays_of(const std::string& text, const RaySource& source, const World& world) {
  std::uint64_t count = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc{} || at != end) return read_rays(text);
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) rays.push_back(make_ray(source, world, i));
  return rays;
}

}  // namespace navjit::common

#include "apps/accuracy/peer.hpp"

#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

#include "common/child.hpp"
#include "navjit/errors.hpp"
#include "navjit/vector.hpp"
#include "runtime/private_folder.hpp"

namespace navjit::accuracy {
namespace {

namespace fs = std::filesystem;

/// A row ray,step,volume,length of a trace. Volume names hold no commas.
bool parse_row(const std::string& line, std::size_t& ray, std::string& volume, double& length,
               bool& stuck) {
  const std::size_t first = line.find(','), second = line.find(',', first + 1),
                    last = line.rfind(',');
  if (first == std::string::npos || second == std::string::npos || last <= second) return false;
  const auto [at, error] = std::from_chars(line.data(), line.data() + first, ray);
  if (error != std::errc{} || at != line.data() + first) return false;
  volume = line.substr(second + 1, last - second - 1);
  const std::string value = line.substr(last + 1);
  stuck = value == "stuck";
  if (stuck) return true;
  const auto [end, wrong] = std::from_chars(value.data(), value.data() + value.size(), length);
  return wrong == std::errc{} && end == value.data() + value.size();
}

}  // namespace

void write_rays(const fs::path& path, std::span<const Ray> rays) {
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  if (!file) throw Error(path.string() + ": cannot be written");
  std::fputs("x,y,z,dx,dy,dz\n", file.get());
  for (const Ray& ray : rays) {
    const Vec3 &p = ray.position, &v = ray.direction;
    std::fprintf(file.get(), "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", p.x, p.y, p.z, v.x, v.y, v.z);
  }
  if (std::fflush(file.get()) != 0) throw Error(path.string() + ": cannot be written");
}

std::optional<std::string> VecGeom::beside_this_program() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  if (error) return std::nullopt;
  const fs::path program = self.parent_path() / "vecgeom_trace";
  return access(program.c_str(), X_OK) == 0 ? std::optional(program.string()) : std::nullopt;
}

std::string VecGeom::trace(std::span<const Ray> rays,
                           const std::function<void(MadeRay&)>& sink) const {
  const PrivateFolder folder;
  write_rays(folder.file("rays.csv"), rays);
  const common::ChildResult result =
      common::run_child({options_.program, "--as-given", options_.detector, folder.file("rays.csv"),
                         folder.file("steps.csv"), options_.navigator},
                        options_.seconds);
  if (!result.good()) return result.words(options_.seconds);
  std::ifstream in(folder.file("steps.csv"));
  std::string line, volume;
  std::getline(in, line);  // the header
  MadeRay made;
  if (!rays.empty()) made.end = rays[0].position;
  const auto finish_until = [&](std::size_t next) {
    while (made.index < next) {
      sink(made);
      const std::size_t index = made.index + 1;
      made = {};
      made.index = index;
      if (index < rays.size()) made.end = rays[index].position;
    }
  };
  std::size_t ray = 0;
  double length = 0;
  for (bool stuck = false; std::getline(in, line);) {
    if (!parse_row(line, ray, volume, length, stuck) || ray >= rays.size() || ray < made.index) {
      return "writes a row that is none: " + line;
    }
    finish_until(ray);
    if (stuck) {
      made.stuck = true;
      continue;
    }
    made.steps.push_back({made.end, length, volume, std::nullopt});
    made.end += length * rays[ray].direction;
  }
  finish_until(rays.size());
  return "";
}

std::string VecGeom::times(std::span<const Ray> rays, int repetitions, Times& times) const {
  const PrivateFolder folder;
  write_rays(folder.file("rays.csv"), rays);
  const common::ChildResult result =
      common::run_child({options_.program, "--time", options_.detector, folder.file("rays.csv"),
                         std::to_string(repetitions)},
                        options_.seconds);
  if (!result.good()) return result.words(options_.seconds);
  std::istringstream in(result.output);
  for (std::string line; std::getline(in, line);) {
    char name[32];
    double median = 0, least = 0;
    unsigned long long steps = 0, zero = 0;
    if (std::sscanf(line.c_str(), "%31s %lf ns %lf ns %llu %llu", name, &median, &least, &steps,
                    &zero) == 5 &&
        options_.navigator == name && steps > zero) {
      times = {median, static_cast<double>(steps), static_cast<double>(zero)};
      return "";
    }
  }
  return "gives no times";
}

std::string VecGeom::time(std::span<const Ray> rays, int repetitions, double& ns_per_step) const {
  Times all;
  std::string failure = times(rays, repetitions, all);
  if (failure.empty()) ns_per_step = all.ns_per_step * all.steps / (all.steps - all.zero);
  return failure;
}

std::string VecGeom::time_of_rays(std::span<const Ray> rays, int repetitions,
                                  double& ns_per_ray) const {
  Times all;
  std::string failure = times(rays, repetitions, all);
  if (failure.empty()) {
    ns_per_ray = all.ns_per_step * all.steps / static_cast<double>(rays.size());
  }
  return failure;
}

std::string VecGeom::follow(const Track& track, std::vector<LegEnd>& ends) const {
  const PrivateFolder folder;
  {
    const std::unique_ptr<FILE, int (*)(FILE*)> file(
        std::fopen(folder.file("legs.csv").c_str(), "w"), std::fclose);
    if (!file) throw Error(folder.file("legs.csv") + ": cannot be written");
    std::fputs("x,y,z,dx,dy,dz,length\n", file.get());
    for (const Leg& leg : track.legs) {
      const Vec3 &p = track.start, &v = leg.direction;
      std::fprintf(file.get(), "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", p.x, p.y, p.z, v.x,
                   v.y, v.z, leg.length);
    }
  }
  const common::ChildResult result =
      common::run_child({options_.program, "--track", options_.detector, folder.file("legs.csv"),
                         folder.file("ends.csv"), options_.navigator},
                        options_.seconds);
  if (!result.good()) return result.words(options_.seconds);
  std::ifstream in(folder.file("ends.csv"));
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    LegEnd end{};
    unsigned long long boundaries = 0;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%llu", &end.point.x, &end.point.y, &end.point.z,
                    &boundaries) != 4) {
      return "writes a row that is none: " + line;
    }
    end.boundaries = boundaries;
    ends.push_back(end);
  }
  return "";
}

}  // namespace navjit::accuracy

// Prints the steps of rays through a detector as VecGeom makes them, or the time that they take.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/clock.hpp"
#include "vecgeom_peer.hpp"

namespace {

using navjit::peers::Leg;
using navjit::peers::Ray;
using navjit::peers::VecGeomNavigator;
using navjit::peers::VecGeomPeer;

constexpr std::uint64_t max_steps_per_ray = 10'000'000;

struct NamedNavigator {
  const char* name;
  VecGeomNavigator navigator;
};
constexpr NamedNavigator navigators[] = {
    {"simple", VecGeomNavigator::simple},       {"abbox", VecGeomNavigator::abbox},
    {"hybrid", VecGeomNavigator::hybrid},       {"bvh", VecGeomNavigator::bvh},
    {"automatic", VecGeomNavigator::automatic},
};

int usage() {
  std::cerr << "usage: vecgeom_trace [--as-given] DET.gdml RAYS.csv OUT.csv "
               "[simple|abbox|hybrid|bvh|automatic]\n"
               "       vecgeom_trace --track DET.gdml LEGS.csv OUT.csv [NAVIGATOR]\n"
               "       vecgeom_trace --time DET.gdml RAYS.csv REPEATS\n"
               "--as-given: directions are not normalised, and numbers need not be finite\n";
  return 2;
}

/// Reads rows of `fields` numbers under a header.
std::optional<std::vector<std::vector<double>>> read_rows(const std::string& file,
                                                          std::size_t fields, bool finite) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) {
    std::cerr << "vecgeom_trace: " << file << ": cannot be read\n";
    return std::nullopt;
  }
  std::vector<std::vector<double>> rows;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) continue;
    std::vector<double> values(fields);
    const char* at = line.data();
    const char* const end = at + line.size();
    bool good = true;
    for (std::size_t i = 0; i < fields && good; ++i) {
      const auto [next, status] = std::from_chars(at, end, values[i]);
      good = status == std::errc() && (!finite || std::isfinite(values[i])) &&
             (i + 1 == fields ? next == end : next != end && *next == ',');
      at = next + 1;
    }
    const double norm = fields < 6 ? 1 : std::hypot(values[3], values[4], values[5]);
    if (!good || (finite && !(norm > 0))) {
      std::cerr << "vecgeom_trace: " << file << ":" << number << ": not a ray\n";
      return std::nullopt;
    }
    rows.push_back(std::move(values));
  }
  return rows;
}

/// Reads rays from lines x,y,z,dx,dy,dz under such a header. Normalises the directions, unless they
/// are to be taken as given.
std::optional<std::vector<Ray>> read_rays(const std::string& file, bool as_given) {
  const auto rows = read_rows(file, 6, !as_given);
  if (!rows) return std::nullopt;
  std::vector<Ray> rays;
  for (const auto& v : *rows) {
    const double norm = as_given ? 1 : std::hypot(v[3], v[4], v[5]);
    rays.push_back({{v[0], v[1], v[2]}, {v[3] / norm, v[4] / norm, v[5] / norm}});
  }
  return rays;
}

/// Follows one track: lines x,y,z,dx,dy,dz,length; the first line has the start.
int write_track(const VecGeomPeer& peer, const std::string& legs_file, const std::string& file) {
  const auto rows = read_rows(legs_file, 7, true);
  if (!rows || rows->empty()) return 1;
  std::vector<Leg> legs;
  for (const auto& v : *rows) legs.push_back({{v[3], v[4], v[5]}, v[6]});
  const double start[3] = {rows->front()[0], rows->front()[1], rows->front()[2]};
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (out == nullptr) {
    std::cerr << "vecgeom_trace: " << file << ": cannot be written\n";
    return 1;
  }
  std::fputs("x,y,z,boundaries\n", out);
  for (const auto& end : peer.follow(start, legs)) {
    std::fprintf(out, "%.17g,%.17g,%.17g,%llu\n", end.position[0], end.position[1], end.position[2],
                 static_cast<unsigned long long>(end.boundaries));
  }
  return std::fclose(out) == 0 ? 0 : 1;
}

int write_trace(const VecGeomPeer& peer, const std::vector<Ray>& rays, const std::string& file) {
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (out == nullptr) {
    std::cerr << "vecgeom_trace: " << file << ": cannot be written\n";
    return 1;
  }
  std::fputs("ray,step,volume,length\n", out);
  std::uint32_t ray = 0;
  std::uint32_t step = 0;
  for (const auto& segment : peer.trace(rays, max_steps_per_ray)) {
    step = segment.ray == ray ? step : 0;
    ray = segment.ray;
    std::fprintf(out, "%u,%u,%s,", ray, step++, peer.names()[segment.volume].c_str());
    if (segment.stuck())
      std::fputs("stuck\n", out);
    else
      std::fprintf(out, "%.17g\n", segment.length);
  }
  const bool failed = std::ferror(out) != 0;
  if (std::fclose(out) != 0 || failed) {
    std::cerr << "vecgeom_trace: " << file << ": cannot be written\n";
    return 1;
  }
  return 0;
}

void print_times(VecGeomPeer& peer, const std::vector<Ray>& rays, int repeats) {
  std::vector<double> times[std::size(navigators)];
  VecGeomPeer::Totals totals[std::size(navigators)];
  for (int repeat = -1; repeat < repeats; ++repeat) {  // the first round warms up
    for (std::size_t i = 0; i < std::size(navigators); ++i) {
      peer.use(navigators[i].navigator);
      const double start = navjit::common::thread_ns();
      totals[i] = peer.transport(rays, max_steps_per_ray);
      const double time = navjit::common::thread_ns() - start;
      if (repeat >= 0)
        times[i].push_back(time / static_cast<double>(std::max<std::uint64_t>(totals[i].steps, 1)));
    }
  }
  std::printf("%-10s %10s %10s %12s %10s %6s %20s\n", "navigator", "median", "least", "steps",
              "of zero", "stuck", "length/mm");
  for (std::size_t i = 0; i < std::size(navigators); ++i) {
    std::sort(times[i].begin(), times[i].end());
    std::printf("%-10s %7.2f ns %7.2f ns %12llu %10llu %6llu %20.3f\n", navigators[i].name,
                times[i][times[i].size() / 2], times[i].front(),
                static_cast<unsigned long long>(totals[i].steps),
                static_cast<unsigned long long>(totals[i].zero_steps),
                static_cast<unsigned long long>(totals[i].stuck), totals[i].length);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  std::string mode;
  if (!arguments.empty() && arguments[0].starts_with("--")) {
    mode = arguments[0];
    arguments.erase(arguments.begin());
  }
  const bool time = mode == "--time", as_given = mode == "--as-given", track = mode == "--track";
  if (!mode.empty() && !time && !as_given && !track) return usage();
  if (time ? arguments.size() != 3 : arguments.size() != 3 && arguments.size() != 4) return usage();
  const std::string& detector = arguments[0];
  const std::string& ray_file = arguments[1];

  VecGeomNavigator navigator = VecGeomNavigator::automatic;
  int repeats = 0;
  if (time) {
    repeats = std::atoi(arguments[2].c_str());
    if (repeats < 1) return usage();
  } else if (arguments.size() == 4) {
    const auto* found =
        std::find_if(std::begin(navigators), std::end(navigators),
                     [&](const NamedNavigator& n) { return arguments[3] == n.name; });
    if (found == std::end(navigators)) return usage();
    navigator = found->navigator;
  }

  const auto rays = track ? std::vector<Ray>{} : read_rays(ray_file, as_given);
  if (!rays) return 1;
  const auto loaded = VecGeomPeer::load(detector);
  if (!loaded) {
    std::cerr << "vecgeom_trace: " << loaded.failure().message << "\n";
    return 1;
  }
  const std::unique_ptr<VecGeomPeer>& peer = *loaded;
  if (time) {
    print_times(*peer, *rays, repeats);
    return 0;
  }
  peer->use(navigator);
  if (track) return write_track(*peer, ray_file, arguments[2]);
  return write_trace(*peer, *rays, arguments[2]);
}

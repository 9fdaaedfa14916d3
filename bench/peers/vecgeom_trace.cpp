// Steps of rays through a detector as VecGeom makes them, or the time that they take.

#include <algorithm>
#include <charconv>
#include <chrono>
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

#include "vecgeom_peer.hpp"

namespace {

using navjit::peers::Ray;
using navjit::peers::VecGeomNavigator;
using navjit::peers::VecGeomPeer;

constexpr std::uint64_t max_steps_per_ray = 1'000'000;

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
  std::cerr
      << "usage: vecgeom_trace DET.gdml RAYS.csv OUT.csv [simple|abbox|hybrid|bvh|automatic]\n"
         "       vecgeom_trace --time DET.gdml RAYS.csv REPEATS\n";
  return 2;
}

/// Reads rays from lines x,y,z,dx,dy,dz under such a header; normalises the directions.
std::optional<std::vector<Ray>> read_rays(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) {
    std::cerr << "vecgeom_trace: " << file << ": cannot be read\n";
    return std::nullopt;
  }
  std::vector<Ray> rays;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) continue;
    double values[6];
    const char* at = line.data();
    const char* const end = at + line.size();
    bool good = true;
    for (int i = 0; i < 6 && good; ++i) {
      const auto [next, status] = std::from_chars(at, end, values[i]);
      good = status == std::errc() && std::isfinite(values[i]) &&
             (i == 5 ? next == end : next != end && *next == ',');
      at = next + 1;
    }
    const double norm = std::hypot(values[3], values[4], values[5]);
    if (!good || !(norm > 0)) {
      std::cerr << "vecgeom_trace: " << file << ":" << number << ": not a ray\n";
      return std::nullopt;
    }
    rays.push_back({{values[0], values[1], values[2]},
                    {values[3] / norm, values[4] / norm, values[5] / norm}});
  }
  return rays;
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
      const auto start = std::chrono::steady_clock::now();
      totals[i] = peer.transport(rays, max_steps_per_ray);
      const std::chrono::duration<double, std::nano> time =
          std::chrono::steady_clock::now() - start;
      if (repeat >= 0)
        times[i].push_back(time.count() /
                           static_cast<double>(std::max<std::uint64_t>(totals[i].steps, 1)));
    }
  }
  std::printf("%-10s %10s %10s %12s %10s %6s %20s\n", "navigator", "median", "least", "steps",
              "of zero", "stuck", "length/mm");
  for (std::size_t i = 0; i < std::size(navigators); ++i) {
    std::sort(times[i].begin(), times[i].end());
    std::printf("%-10s %7.1f ns %7.1f ns %12llu %10llu %6llu %20.3f\n", navigators[i].name,
                times[i][times[i].size() / 2], times[i].front(),
                static_cast<unsigned long long>(totals[i].steps),
                static_cast<unsigned long long>(totals[i].zero_steps),
                static_cast<unsigned long long>(totals[i].stuck), totals[i].length);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool time = !arguments.empty() && arguments[0] == "--time";
  if (time ? arguments.size() != 4 : arguments.size() != 3 && arguments.size() != 4) return usage();
  const std::string& detector = arguments[time ? 1 : 0];
  const std::string& ray_file = arguments[time ? 2 : 1];

  VecGeomNavigator navigator = VecGeomNavigator::automatic;
  int repeats = 0;
  if (time) {
    repeats = std::atoi(arguments[3].c_str());
    if (repeats < 1) return usage();
  } else if (arguments.size() == 4) {
    const auto* found =
        std::find_if(std::begin(navigators), std::end(navigators),
                     [&](const NamedNavigator& n) { return arguments[3] == n.name; });
    if (found == std::end(navigators)) return usage();
    navigator = found->navigator;
  }

  const auto rays = read_rays(ray_file);
  if (!rays) return 1;
  std::string error;
  const auto peer = VecGeomPeer::load(detector, error);
  if (!peer) {
    std::cerr << "vecgeom_trace: " << error << "\n";
    return 1;
  }
  if (time) {
    print_times(*peer, *rays, repeats);
    return 0;
  }
  peer->use(navigator);
  return write_trace(*peer, *rays, arguments[2]);
}

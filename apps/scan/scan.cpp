#include "apps/scan/scan.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "common/parallel.hpp"
#include "common/passage.hpp"
#include "navjit/errors.hpp"

namespace navjit::scan {
namespace {

double edge(const Range& range, int bins, double bin) {
  return range.low + bin / bins * (range.high - range.low);
}

Vec3 direction_of(double eta, double phi) {
  // As tanh and 1 / cosh: exact enough at any eta.
  const double z = std::tanh(eta), across = 1 / std::cosh(eta);
  const Vec3 v{across * std::cos(phi), across * std::sin(phi), z};
  return (1 / norm(v)) * v;
}

std::vector<bool> stops_of(const World& world, const std::vector<std::string>& names) {
  std::vector<bool> stops(world.volumes.size());
  for (const std::string& name : names) {
    bool found = false;
    for (std::size_t v = 0; v < stops.size(); ++v) {
      if (fnmatch(name.c_str(), world.volumes[v].name.c_str(), 0) != 0) continue;
      stops[v] = true;
      found = true;
    }
    if (!found) throw Error("no volume is called '" + name + "'; navjit inspect lists them");
  }
  return stops;
}

}  // namespace

double Scan::eta_edge(int bin) const { return edge(request.eta, request.eta_bins, bin); }
double Scan::phi_edge(int bin) const { return edge(request.phi, request.phi_bins, bin); }

Budget Scan::mean(int eta) const {
  Budget sum;
  for (int phi = 0; phi < request.phi_bins; ++phi) {
    const Budget& each = bin(eta, phi);
    sum.radiation_lengths += each.radiation_lengths / request.phi_bins;
    sum.mass += each.mass / request.phi_bins;
    sum.interaction_lengths += each.interaction_lengths / request.phi_bins;
    sum.path += each.path / request.phi_bins;
  }
  return sum;
}

Scan make(Runtime& runtime, const Request& request) {
  const World& world = runtime.world();
  const std::vector<bool> stops = stops_of(world, request.stop);
  const std::vector<common::MaterialRates> rates = common::material_rates(world);
  Scan scan{request, {}, {}};
  const auto etas = static_cast<std::size_t>(request.eta_bins);
  scan.bins.resize(etas * static_cast<std::size_t>(request.phi_bins));
  scan.paths.assign(etas, std::vector<double>(world.materials.size()));
  std::atomic<int> next{0};
  std::atomic<std::uint64_t> stuck{0};
  std::atomic<bool> stop{false};
  std::mutex telling;
  int done = 0;
  const int per_bin = request.rays * request.rays;
  const double weight = 1.0 / per_bin;

  const auto shoot = [&](Navigator& navigator, double eta, double phi, Budget& bin,
                         std::vector<double>& paths) {
    const Ray ray{request.origin, direction_of(eta, phi)};
    const auto end = common::pass(navigator, world, ray, [&](const common::Leg& leg) {
      const VolumeId v = leg.state.volume();
      if (stops[v]) return false;
      const double mm = weight * (leg.to - leg.from);
      bin.radiation_lengths += mm * rates[v].radiation_lengths;
      bin.mass += mm * rates[v].mass;
      bin.interaction_lengths += mm * rates[v].interaction_lengths;
      bin.path += mm;
      const std::uint32_t material = world.volumes[v].material;
      if (material < paths.size()) paths[material] += mm / request.phi_bins;
      return true;
    });
    if (end == common::PassageEnd::stuck) ++stuck;
  };
  common::in_parallel(request.threads, stop, [&] {
    Navigator navigator = runtime.navigator();
    for (int i; !stop && (i = next.fetch_add(1)) < request.eta_bins;) {
      const auto row = static_cast<std::size_t>(i);
      for (int j = 0; j < request.phi_bins; ++j) {
        Budget& bin = scan.bins[row * static_cast<std::size_t>(request.phi_bins) +
                                static_cast<std::size_t>(j)];
        for (int k = 0; k < per_bin; ++k) {
          const double u = (k / request.rays + 0.5) / request.rays;
          const double v = (k % request.rays + 0.5) / request.rays;
          shoot(navigator, edge(request.eta, request.eta_bins, i + u),
                edge(request.phi, request.phi_bins, j + v), bin, scan.paths[row]);
        }
      }
      if (!request.progress) continue;
      const std::lock_guard lock(telling);
      request.progress(++done);
    }
  });
  scan.rays = scan.bins.size() * static_cast<std::uint64_t>(per_bin);
  scan.stuck = stuck;
  return scan;
}

double value_of(const Budget& budget, Quantity quantity) {
  switch (quantity) {
    case Quantity::radiation_lengths:
      return budget.radiation_lengths;
    case Quantity::mass:
      return budget.mass;
    case Quantity::interaction_lengths:
      return budget.interaction_lengths;
  }
  return 0;
}

const char* unit_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::radiation_lengths:
      return "radiation lengths";
    case Quantity::mass:
      return "g/cm2";
    case Quantity::interaction_lengths:
      return "interaction lengths";
  }
  return "";
}

std::vector<Part> parts_of(const Scan& scan, const World& world, Quantity quantity) {
  std::vector<Part> parts;
  for (std::size_t m = 0; m < world.materials.size(); ++m) {
    const common::MaterialRates rates = common::rates_of(world, world.materials[m]);
    const double rate =
        value_of({rates.radiation_lengths, rates.mass, rates.interaction_lengths}, quantity);
    Part part{world.materials[m].name, {}};
    for (const std::vector<double>& paths : scan.paths) {
      part.by_eta.push_back(rate * paths[m]);
      part.sum += part.by_eta.back();
    }
    if (part.sum > 0) parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.sum > b.sum; });
  return parts;
}

}  // namespace navjit::scan

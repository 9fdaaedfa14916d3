// What particles from one point go through, by pseudorapidity and azimuth.
#pragma once

#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/material_budget.hpp"
#include "navjit/runtime.hpp"

namespace navjit::scan {

struct Range {
  double low, high;
};

struct Request {
  Vec3 origin{0, 0, 0};  ///< mm
  Range eta{-3, 3};
  Range phi{-std::numbers::pi, std::numbers::pi};  ///< rad
  int eta_bins = 30, phi_bins = 72;
  int rays = 4;  ///< in each bin, along eta and along phi
  /// Names of volumes, with * and ?: rays end where they enter one.
  std::vector<std::string> stop{};
  unsigned threads = 1;
  /// Told how many bins of eta are done, one call at a time.
  std::function<void(int)> progress{};
};

/// Sums along a ray, or their mean.
struct Budget {
  double radiation_lengths = 0;
  double mass = 0;                 ///< g/cm2
  double interaction_lengths = 0;  ///< nuclear ones
  double path = 0;                 ///< mm, in whatever
};

struct Scan {
  Request request;
  std::vector<Budget> bins;  ///< means over rays; eta by eta, in each phi by phi
  /// mm of each material (by number), mean over the rays of a bin of eta.
  std::vector<std::vector<double>> paths;
  std::uint64_t rays = 0, stuck = 0;

  const Budget& bin(int eta, int phi) const {
    return bins[static_cast<std::size_t>(eta) * static_cast<std::size_t>(request.phi_bins) +
                static_cast<std::size_t>(phi)];
  }
  /// Edges of bins; the last one is the end of the range.
  double eta_edge(int bin) const;
  double phi_edge(int bin) const;
  /// Mean over phi.
  Budget mean(int eta) const;
};

/// Rays at even distances within each bin, the same for any number of threads. Throws Error for a
/// name that is no volume's.
Scan make(Runtime& runtime, const Request& request);

/// Which of the sums.
enum class Quantity : std::uint8_t { radiation_lengths, mass, interaction_lengths };
double value_of(const Budget& budget, Quantity quantity);
/// "radiation lengths", "g/cm2", "interaction lengths".
const char* unit_of(Quantity quantity);

/// Materials by what they add to a quantity over all of the scan, the most first, those that add
/// something; with it of each, by bin of eta.
struct Part {
  std::string material;
  std::vector<double> by_eta;
  double sum = 0;
};
std::vector<Part> parts_of(const Scan& scan, const World& world, Quantity quantity);

}  // namespace navjit::scan

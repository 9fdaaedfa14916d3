#include "analysis/patterns/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/patterns/nest.hpp"
#include "analysis/patterns/rings.hpp"

namespace navjit {
namespace {

/// The number of distinct values, where values closer than `tolerance` count as one.
std::size_t distinct(std::vector<double> values, double tolerance) {
  std::sort(values.begin(), values.end());
  std::size_t count = 1;
  for (std::size_t i = 1; i < values.size(); ++i) count += values[i] - values[i - 1] > tolerance;
  return count;
}

}  // namespace

Pattern pattern_of(std::span<const Extent> boxes) {
  if (boxes.empty()) return {Arrangement::leaf, "leaf"};
  if (boxes.size() == 1) return {Arrangement::single, "single"};
  std::vector<double> x, y, z;
  for (const Extent& e : boxes) {
    x.push_back((e.min.x + e.max.x) / 2);
    y.push_back((e.min.y + e.max.y) / 2);
    z.push_back((e.min.z + e.max.z) / 2);
  }
  const double tolerance = 1e-6;
  const std::size_t n[3] = {distinct(x, tolerance), distinct(y, tolerance), distinct(z, tolerance)};
  const char* axis[3] = {"x", "y", "z"};
  for (int a = 0; a < 3; ++a) {
    if (n[a] == boxes.size() && n[(a + 1) % 3] == 1 && n[(a + 2) % 3] == 1) {
      return {Arrangement::slabs, std::to_string(n[a]) + " slabs along " + axis[a]};
    }
  }
  if (n[0] * n[1] * n[2] == boxes.size()) {
    return {Arrangement::grid, "grid " + std::to_string(n[0]) + " x " + std::to_string(n[1]) +
                                   " x " + std::to_string(n[2])};
  }
  if (n[0] == 1 && n[1] == 1 && n[2] == 1) {
    return {Arrangement::nest, "nest of " + std::to_string(boxes.size())};
  }
  return {Arrangement::other, std::to_string(boxes.size()) + " daughters"};
}

std::string describe_round_pattern(const World& world, const Solid& mother,
                                   std::span<const Daughter> daughters, double margin) {
  const char* const about[] = {" about x", " about y", " about z", " about the centre"};
  const auto besides = [](std::size_t others) {
    return others == 0 ? std::string() : " and " + std::to_string(others) + " more";
  };
  const auto few = [&](std::size_t others) { return 2 * others < daughters.size(); };
  const std::optional<Nest> nest = find_nest(world, mother, daughters, margin);
  const std::optional<Rings> rings = find_rings(world, mother, daughters, margin);
  if (rings && few(rings->others.size()) && !(nest && nest->others.size() < rings->others.size())) {
    const Ring& first = rings->rings[0];
    const auto same = [&](const Ring& r) {
      return r.steps == first.steps && r.present == first.present;
    };
    std::string text;
    if (rings->rings.size() > 1) text = std::to_string(rings->rings.size()) + " rings";
    if (std::all_of(rings->rings.begin(), rings->rings.end(), same)) {
      text += (text.empty() ? "ring of " : " of ") + std::to_string(first.present);
      if (first.present < first.steps) text += " of " + std::to_string(first.steps);
    }
    return text + about[rings->axis] + besides(rings->others.size());
  }
  if (nest && few(nest->others.size())) {
    return "nest of " + std::to_string(nest->members.size()) + " shells" + about[nest->axis] +
           besides(nest->others.size());
  }
  return {};
}

}  // namespace navjit

#include "analysis/patterns/rings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/axial_extent.hpp"
#include "geometry/solids/list.hpp"

// clang-format off
#include "geometry/kernels/nest.h"
#include "geometry/kernels/rings.h"
// clang-format on

namespace navjit {
namespace {

constexpr double pi = std::numbers::pi;

/// Radii and heights in one ring agree to this, relative to the largest radius. Azimuths agree to
/// this as well, in rad.
constexpr double alike = 1e-6;

/// Fewer daughters are not a ring, and with more steps sectors do not serve.
constexpr std::size_t fewest = 3;
constexpr int most_steps = 1024;

/// With more different radii, heights and spans than this, no rings are searched: each daughter is
/// compared with all of these. A guess.
constexpr std::size_t most_groups = 256;

/// A ray is tested against a surface of a ring only if the mother reaches farther than the ring by
/// this share of the ring's own thickness. Less is not worth a square root.
constexpr double worth_clipping = 0.1;

double turn(double phi) { return phi - 2 * pi * std::floor(phi / (2 * pi)); }

double middle(const TangentSpan& s) { return turn(s.first + s.span / 2); }

/// A daughter as seen from the axis.
struct Seen : AxialExtent {
  double lean = 0;  ///< of the tangents that separate it best, mm; 0: radii
};

/// All daughters, as seen from an axis.
struct View {
  const World& world;
  std::span<const Daughter> daughters;
  int axis;
  std::vector<Seen> seen{};

  const Solid& solid(std::uint32_t k) const { return world.volumes[daughters[k].volume].solid; }
  const Transformation& place(std::uint32_t k) const { return daughters[k].transformation; }
  const Seen& look_at(std::uint32_t k) {
    Seen& e = seen.emplace_back(Seen{axial_extent(solid(k), place(k), axis)});
    if (!e.around && !e.segment) e.lean = lean_of(solid(k), place(k), axis);
    return e;
  }
  /// The azimuths or tangents that a daughter spans; nothing if tangents of this circle do not
  /// tell.
  std::optional<TangentSpan> directions(std::uint32_t k, double lean) const {
    if (lean == 0) return TangentSpan{seen[k].first, seen[k].span};
    return tangent_span(solid(k), place(k), axis, lean);
  }
};

bool same_ring(const Seen& a, const Seen& b) {
  const double tolerance = alike * std::max(a.far, b.far);
  return std::abs(a.lean - b.lean) <= tolerance && std::abs(a.near - b.near) <= tolerance &&
         std::abs(a.far - b.far) <= tolerance && std::abs(a.low - b.low) <= tolerance &&
         std::abs(a.high - b.high) <= tolerance && std::abs(a.span - b.span) <= alike;
}

/// The number of steps in a full turn of which all azimuths are multiples; 0 if there is none.
int steps_of(std::vector<double> azimuths) {
  std::sort(azimuths.begin(), azimuths.end());
  double smallest = azimuths.front() + 2 * pi - azimuths.back();
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    smallest = std::min(smallest, azimuths[i] - azimuths[i - 1]);
  }
  if (!(smallest * most_steps > pi)) return 0;
  const int steps = static_cast<int>(std::lround(2 * pi / smallest));
  if (steps < static_cast<int>(fewest)) return 0;
  for (const double phi : azimuths) {
    const double at = (phi - azimuths.front()) * steps / (2 * pi);
    if (std::abs(at - std::round(at)) > alike * steps) return 0;
  }
  return steps;
}

/// Lists the daughters of each sector. `directions` are those that each member spans. A daughter
/// belongs to the sectors into which it reaches by more than the margin, measured across the edge.
/// The margin is used as an angle, taken at the ring's far end, where it is smallest.
void fill(Ring& ring, double start, const std::vector<TangentSpan>& directions,
          const std::vector<std::uint32_t>& members, double margin) {
  const double width = 2 * pi / ring.steps;
  std::vector<std::vector<std::uint32_t>> lists(static_cast<std::size_t>(ring.steps));
  for (std::size_t m = 0; m < members.size(); ++m) {
    const std::uint32_t k = members[m];
    const double shrink = margin / ring.far;
    const double begin = turn(directions[m].first - start + shrink);
    const double end = begin + std::max(directions[m].span - 2 * shrink, 0.0);
    const int last =
        std::min(static_cast<int>(end / width), static_cast<int>(begin / width) + ring.steps - 1);
    for (int s = static_cast<int>(begin / width); s <= last; ++s) {
      lists[static_cast<std::size_t>(s % ring.steps)].push_back(k);
    }
  }
  ring.first.assign(1, 0);
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    ring.members.insert(ring.members.end(), list.begin(), list.end());
    ring.first.push_back(static_cast<std::uint32_t>(ring.members.size()));
  }
}

/// Makes sectors from `start` on, and the tables by which the sector of a point is found.
void lay_edges(Ring& ring, double start) {
  std::vector<std::pair<double, std::uint32_t>> angles;
  for (int s = 0; s <= ring.steps; ++s) {
    const double phi = start + 2 * pi / ring.steps * (s == ring.steps ? 0 : s);
    ring.edges.push_back({std::cos(phi), std::sin(phi)});
    if (s == ring.steps) break;
    angles.emplace_back(kernels::square_angle(ring.edges.back()[0], ring.edges.back()[1]),
                        static_cast<std::uint32_t>(s));
  }
  std::sort(angles.begin(), angles.end());
  // Equal steps of azimuth are at least half as large in the square angle, so no cell has two
  // edges.
  const int cells = 4 * ring.steps;
  for (int cell = 0; cell < cells; ++cell) {
    const std::pair begin{4.0 * cell / cells, ~0U};
    const auto beyond = std::upper_bound(angles.begin(), angles.end(), begin);
    ring.at_angle.push_back(beyond == angles.begin() ? angles.back().second
                                                     : std::prev(beyond)->second);
  }
}

std::optional<Ring> make_ring(const View& view, const std::vector<std::uint32_t>& members,
                              const AxialExtent& mother, double margin) {
  std::vector<TangentSpan> directions;
  std::vector<double> azimuths;
  Ring ring;
  ring.segments = true;
  ring.near = INFINITY;
  ring.low = INFINITY;
  ring.high = -INFINITY;
  ring.lean = view.seen[members[0]].lean;
  for (const std::uint32_t k : members) {
    const Seen& e = view.seen[k];
    const auto of = view.directions(k, ring.lean);
    if (!of) return {};
    directions.push_back(*of);
    azimuths.push_back(middle(*of));
    ring.segments &= e.segment;
    ring.near = std::min(ring.near, e.near);
    ring.far = std::max(ring.far, e.far);
    ring.low = std::min(ring.low, e.low);
    ring.high = std::max(ring.high, e.high);
  }
  ring.steps = steps_of(azimuths);
  ring.present = static_cast<int>(members.size());
  if (ring.steps == 0) return {};
  const double width = 2 * pi / ring.steps;
  // Sectors that are hardly wider than margins tell nothing.
  const double near = std::sqrt(std::max(ring.near * ring.near - ring.lean * ring.lean, 0.0));
  if (!(near * width > 1e3 * margin)) return {};
  const double thick = ring.far - ring.near, tall = ring.high - ring.low;
  ring.hole = mother.near < ring.near - worth_clipping * thick;
  // Points within the circle are on no tangent.
  if (ring.lean != 0 && !(mother.near > 1.001 * std::abs(ring.lean))) ring.hole = true;
  ring.outside = mother.far > ring.far + worth_clipping * thick;
  ring.ends = mother.low < ring.low - worth_clipping * tall ||
              mother.high > ring.high + worth_clipping * tall;
  ring.near -= margin;
  ring.far += margin;
  ring.low -= margin;
  ring.high += margin;
  ring.reach = 4 * margin;
  const double start = turn(azimuths[0] - width / 2);
  lay_edges(ring, start);
  fill(ring, start, directions, members, margin);
  return ring;
}

}  // namespace

std::optional<Rings> find_rings(const World& world, const Solid& mother,
                                std::span<const Daughter> daughters, double margin) {
  std::optional<Rings> best;
  for (const int axis : {2, 0, 1}) {
    const AxialExtent outer = axial_extent(mother, Transformation{}, axis);
    View view{world, daughters, axis};
    std::vector<std::vector<std::uint32_t>> groups;
    Rings rings;
    rings.axis = axis;
    for (std::uint32_t k = 0; k < daughters.size(); ++k) {
      const Seen& e = view.look_at(k);
      if (e.around || !(e.near > 0)) {
        rings.others.push_back(k);
        continue;
      }
      const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) {
        return same_ring(view.seen[g[0]], view.seen[k]);
      });
      if (group == groups.end()) {
        groups.push_back({k});
        if (groups.size() > most_groups) break;
      } else {
        group->push_back(k);
      }
    }
    if (groups.size() > most_groups) continue;
    for (const auto& group : groups) {
      std::optional<Ring> ring;
      if (group.size() >= fewest) ring = make_ring(view, group, outer, margin);
      if (ring) {
        rings.rings.push_back(std::move(*ring));
      } else {
        rings.others.insert(rings.others.end(), group.begin(), group.end());
      }
    }
    std::sort(rings.others.begin(), rings.others.end());
    if (!rings.rings.empty() && (!best || rings.others.size() < best->others.size())) {
      best = std::move(rings);
    }
  }
  return best;
}

}  // namespace navjit

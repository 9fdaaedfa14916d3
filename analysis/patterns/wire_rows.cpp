#include "analysis/patterns/wire_rows.hpp"

#include <algorithm>
#include <cmath>

namespace navjit {
namespace {

using Plane = std::array<double, 2>;

/// Fewer places are not a row. If fewer are in all rows together, it does not pay to transform a
/// ray into the rows' frame.
constexpr std::size_t fewest_in_row = 4, fewest = 8;

/// A new row begins where places leave a gap across the row of more than this share of the radius.
constexpr double gap = 0.5;

/// The cost for every ray of a row, and of a place that is in no row, in units of the cost of being
/// offered a place. Guesses.
constexpr double cost_of_row = 0.3, cost_of_other = 1;

/// Once rows as good as this are found, no others are searched.
constexpr double good_spread = 0.05, good_offer = 1.5;
constexpr std::size_t good_count = 4;

/// In a lattice rows run from a place to its nearest ones. Directions are tried from this many
/// places to this many neighbours.
constexpr std::size_t samples = 6, neighbours = 3;

struct Attempt {
  RowsAcross found;
  std::vector<std::size_t> longest;  ///< the row with most places, by their indices
  double cost = INFINITY;
  double spread = 0;   ///< the largest distance of places from the middle of their row
  double offered = 0;  ///< a bound of the mean number of places that a row offers a ray
  std::size_t others = 0;
};

double along(const PlaceAcross& p, const Plane& d) { return d[0] * p.x + d[1] * p.y; }
double across(const PlaceAcross& p, const Plane& d) { return d[0] * p.y - d[1] * p.x; }

Attempt attempt(std::span<const PlaceAcross> places, const Plane& d, double radius) {
  Attempt a;
  a.found.along = d;
  a.cost = 0;
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) order.emplace_back(across(places[i], d), i);
  std::sort(order.begin(), order.end());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    for (end = begin + 1;
         end < order.size() && order[end].first - order[end - 1].first <= gap * radius; ++end) {
    }
    if (end - begin < fewest_in_row) {
      a.others += end - begin;
      continue;
    }
    double low = INFINITY, high = -INFINITY;
    std::vector<std::uint32_t> row;
    std::vector<std::size_t> numbers;
    for (std::size_t i = begin; i < end; ++i) {
      const PlaceAcross& p = places[order[i].second];
      low = std::min(low, along(p, d));
      high = std::max(high, along(p, d));
      row.push_back(p.daughter);
      numbers.push_back(order[i].second);
    }
    const double spread = (order[end - 1].first - order[begin].first) / 2;
    const double offered = 2 * (radius + spread) * static_cast<double>(row.size()) /
                           (high - low + 2 * (radius + spread));
    a.spread = std::max(a.spread, spread);
    a.offered = std::max(a.offered, offered);
    a.cost += cost_of_row + offered;
    if (numbers.size() > a.longest.size()) a.longest = std::move(numbers);
    a.found.rows.push_back(std::move(row));
  }
  a.cost += cost_of_other * static_cast<double>(a.others);
  return a;
}

/// The direction of the straight line through the longest row.
Plane fitted(std::span<const PlaceAcross> places, const Attempt& a) {
  const Plane& d = a.found.along;
  double u = 0, n = 0, uu = 0, un = 0;
  const auto count = static_cast<double>(a.longest.size());
  for (const std::size_t i : a.longest) {
    u += along(places[i], d) / count;
    n += across(places[i], d) / count;
  }
  for (const std::size_t i : a.longest) {
    const double du = along(places[i], d) - u;
    uu += du * du;
    un += du * (across(places[i], d) - n);
  }
  const double slope = uu > 0 ? un / uu : 0, length = std::hypot(1, slope);
  return {(d[0] - slope * d[1]) / length, (d[1] + slope * d[0]) / length};
}

/// The longest axis of all places together.
Plane main_axis(std::span<const PlaceAcross> places) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  const auto count = static_cast<double>(places.size());
  for (const PlaceAcross& p : places) {
    x += p.x / count;
    y += p.y / count;
  }
  for (const PlaceAcross& p : places) {
    xx += (p.x - x) * (p.x - x);
    xy += (p.x - x) * (p.y - y);
    yy += (p.y - y) * (p.y - y);
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  return {std::cos(angle), std::sin(angle)};
}

/// Directions from a few places to those nearest to them.
std::vector<Plane> to_neighbours(std::span<const PlaceAcross> places) {
  std::vector<Plane> directions;
  for (std::size_t s = 0; s < samples; ++s) {
    const PlaceAcross& from = places[(2 * s + 1) * places.size() / (2 * samples)];
    std::vector<std::pair<double, Plane>> near;
    for (const PlaceAcross& p : places) {
      const double distance = std::hypot(p.x - from.x, p.y - from.y);
      if (distance > 0) near.push_back({distance, {p.x - from.x, p.y - from.y}});
    }
    const std::size_t count = std::min(neighbours, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    for (std::size_t i = 0; i < count; ++i) directions.push_back(near[i].second);
  }
  return directions;
}

}  // namespace

std::optional<RowsAcross> find_rows(std::span<const PlaceAcross> places,
                                    std::span<const Plane> likely, double radius) {
  if (places.size() < fewest) return {};
  Attempt best;
  const auto attempt_along = [&](Plane d) {
    const double length = std::hypot(d[0], d[1]);
    if (!(length > 1e-6)) return;
    d = {d[0] / length, d[1] / length};
    for (int refinements = 0; refinements < 3; ++refinements) {
      Attempt a = attempt(places, d, radius);
      if (!(a.cost < best.cost || (a.cost == best.cost && a.spread < best.spread))) return;
      best = std::move(a);
      // Rows that are exact cannot be fitted better.
      if (best.longest.empty() || best.spread < 1e-9 * radius) return;
      d = fitted(places, best);
    }
  };
  const auto is_good = [&] {
    return best.others == 0 && best.found.rows.size() <= good_count &&
           best.spread <= good_spread * radius && best.offered <= good_offer;
  };
  const auto attempt_all = [&](std::span<const Plane> directions) {
    for (const Plane& d : directions) {
      attempt_along(d);
      attempt_along({-d[1], d[0]});
    }
  };
  attempt_all(likely);
  if (!is_good()) {
    const Plane axis = main_axis(places);
    attempt_all(std::span(&axis, 1));
  }
  if (!is_good()) attempt_all(to_neighbours(places));
  if (places.size() - best.others < fewest) return {};
  return std::move(best.found);
}

}  // namespace navjit

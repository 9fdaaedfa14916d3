#include "geometry/solids/windings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navjit::detail {
namespace {

using Polygon = std::vector<PlanarPoint>;

/// The heights of all corners and crossings, ascending: no edges cross between two of them. Empty
/// if there are too many crossings.
std::vector<double> heights(const Polygon& polygon) {
  std::vector<double> all;
  for (const PlanarPoint& p : polygon) all.push_back(p.y);
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const PlanarPoint &a = polygon[i], &b = polygon[(i + 1) % n];
    for (std::size_t k = i + 1; k < n; ++k) {
      const PlanarPoint &c = polygon[k], &d = polygon[(k + 1) % n];
      const double across = (b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x);
      if (across == 0) continue;
      const double s = ((c.x - a.x) * (d.y - c.y) - (c.y - a.y) * (d.x - c.x)) / across;
      const double t = ((c.x - a.x) * (b.y - a.y) - (c.y - a.y) * (b.x - a.x)) / across;
      if (s > 0 && s < 1 && t > 0 && t < 1) all.push_back(a.y + s * (b.y - a.y));
      if (all.size() > n + 1000) return {};
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

double wrongly_surrounded(const Polygon& polygon) {
  const std::vector<double> levels = heights(polygon);
  if (levels.empty()) return std::numeric_limits<double>::infinity();
  struct Passage {
    double x;
    int turn;
  };
  std::vector<Passage> passages;
  double area = 0;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const double low = levels[i - 1], high = levels[i], middle = low + (high - low) / 2;
    if (!(middle > low && middle < high)) continue;
    passages.clear();
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const PlanarPoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      if ((a.y > middle) == (b.y > middle)) continue;
      passages.push_back(
          {a.x + (b.x - a.x) * ((middle - a.y) / (b.y - a.y)), a.y > middle ? 1 : -1});
    }
    std::sort(passages.begin(), passages.end(),
              [](const Passage& a, const Passage& b) { return a.x < b.x; });
    int around = 0;
    for (std::size_t k = 0; k + 1 < passages.size(); ++k) {
      around += passages[k].turn;
      if (around != 0 && around != 1) area += (passages[k + 1].x - passages[k].x) * (high - low);
    }
  }
  return area;
}

}  // namespace navjit::detail

#include "analysis/patterns/grid.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/axis.hpp"
#include "geometry/model/placed_extent.hpp"
#include "navjit/vector.hpp"

namespace navjit {
namespace {

struct Range {
  int first, last;
};

Range range_of(const Grid& b, const Extent& box, int axis, double margin) {
  const auto index = [&](double x) {
    const double i = std::floor((x - b.origin[axis]) / b.width[axis]);
    return static_cast<int>(std::clamp(i, 0.0, static_cast<double>(b.count[axis] - 1)));
  };
  return {index(low(box, axis) - margin), index(high(box, axis) + margin)};
}

Grid layout(const Extent& scene, const std::array<int, 3>& count) {
  Grid b;
  b.count = count;
  for (int axis = 0; axis < 3; ++axis) {
    b.origin[axis] = low(scene, axis);
    b.width[axis] = (high(scene, axis) - low(scene, axis)) / count[axis];
  }
  return b;
}

/// For an oblique box: the sums of |det| over the choices of one, two and three of its edges,
/// projected onto one axis, onto two axes (indexed by the axis left out) and onto all three.
struct Spread {
  double one[3], two[3], three;
};

Spread spread_of(const PlacedBox& box) {
  Spread s{};
  double along[3][3];
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec3 whole = 2 * box.edges[e];
    along[e][0] = whole.x;
    along[e][1] = whole.y;
    along[e][2] = whole.z;
  }
  for (std::size_t e = 0; e < 3; ++e) {
    const auto& p = along[e];
    const auto& q = along[(e + 1) % 3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
      const double minor = p[i] * q[j] - p[j] * q[i];
      s.one[axis] += std::abs(p[axis]);
      s.two[axis] += std::abs(minor);
      if (e == 0) s.three += minor * along[2][axis];
    }
  }
  s.three = std::abs(s.three);
  return s;
}

/// The expected number of cells that an oblique box reaches into. It is the volume of the Minkowski
/// sum of the box and a cell divided by the volume of the cell, both projected onto the axes that
/// are split. The volume of a sum of segments is the sum of |det| over the choices of as many
/// segments as there are dimensions (e.g. G. M. Ziegler, "Lectures on Polytopes", 7.3); the cell's
/// own segments are the axes.
double expected_cells(const Grid& b, const Spread& s) {
  double per_mm[3];  // 0 along axes that are not split
  for (int axis = 0; axis < 3; ++axis) per_mm[axis] = b.count[axis] > 1 ? 1 / b.width[axis] : 0;
  const auto [x, y, z] = per_mm;
  return 1 + s.one[0] * x + s.one[1] * y + s.one[2] * z + s.two[2] * x * y + s.two[0] * y * z +
         s.two[1] * z * x + s.three * x * y * z;
}

/// Boxes whose cells are counted for many grids. If there are very many boxes, a few stand for all.
struct Counted {
  std::vector<const PlacedBox*> boxes;
  std::vector<Spread> spreads;  ///< those of oblique boxes; zero for others
  double each = 1;              ///< how many boxes each of these stands for

  explicit Counted(std::span<const PlacedBox> all) {
    constexpr std::size_t most = 512;
    const std::size_t count = std::min(all.size(), most);
    if (count > 0) each = static_cast<double>(all.size()) / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      boxes.push_back(&all[count < all.size() ? scattered(k, all.size()) : k]);
      spreads.push_back(boxes.back()->oblique ? spread_of(*boxes.back()) : Spread{});
    }
  }

 private:
  /// Indices that are evenly spread, and not in step with any row of daughters: multiples of the
  /// golden ratio, modulo 1.
  static std::size_t scattered(std::size_t k, std::size_t of) {
    double whole = 0;
    const double at = std::modf(0.6180339887498949 * static_cast<double>(k), &whole);
    return std::min(of - 1, static_cast<std::size_t>(at * static_cast<double>(of)));
  }
};

/// Sum over boxes of the number of cells each reaches into: about the length of `members`.
double total_members(const Grid& b, const Counted& counted, double margin) {
  double total = 0;
  for (std::size_t k = 0; k < counted.boxes.size(); ++k) {
    const PlacedBox& box = *counted.boxes[k];
    double reached = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const Range r = range_of(b, box.bounds, axis, margin);
      reached *= r.last - r.first + 1;
    }
    total += box.oblique ? std::min(reached, expected_cells(b, counted.spreads[k])) : reached;
  }
  return counted.each * total;
}

/// Whether one of an oblique box's own faces separates it from a box along the axes, both inflated
/// by `margin` (S. Gottschalk et al., "OBBTree", 1996). The axes of the other box were tested with
/// the bounds. Those of pairs of edges are left out, because they rarely tell more.
bool separated(const PlacedBox& box, const Extent& cell, double margin) {
  const Vec3 between = 0.5 * (cell.min + cell.max) - 0.5 * (box.bounds.min + box.bounds.max);
  const Vec3 half = 0.5 * (cell.max - cell.min);
  for (const Vec3& edge : box.edges) {
    const double length = norm(edge);
    if (!(length > 0)) continue;
    const double reach =
        std::abs(edge.x) * half.x + std::abs(edge.y) * half.y + std::abs(edge.z) * half.z;
    if (std::abs(dot(between, edge)) > length * length + reach + 2 * margin * length) return true;
  }
  return false;
}

/// The cost for a ray: the candidates of a cell, and the walk from cell to cell. The weights are
/// guesses that served well; they are not fitted to measurements.
double cost(const Grid& b, double members, CellUse use) {
  const double cells =
      static_cast<double>(b.count[0]) * static_cast<double>(b.count[1]) * b.count[2];
  const double per_cell = members / cells;
  const int walk = b.count[0] + b.count[1] + b.count[2] - 3;
  if (use == CellUse::blocks) {
    // In cycles. Rays pass a fifth of the cells along an axis; each cell takes 25, and each block
    // 20.
    return (1 + 0.2 * walk) * (25 + 20 * (0.5 + per_cell / 8));
  }
  return per_cell + 0.02 * walk + 0.3 * ((b.count[0] > 1) + (b.count[1] > 1) + (b.count[2] > 1));
}

Extent cell_box(const Grid& b, int i, int j, int k) {
  const double index[3] = {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  double low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = b.origin[axis] + index[axis] * b.width[axis];
    high[axis] = low[axis] + b.width[axis];
  }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

bool protrudes(const Extent& box, const Extent& scene) {
  for (int axis = 0; axis < 3; ++axis) {
    if (low(box, axis) < low(scene, axis) || high(box, axis) > high(scene, axis)) return true;
  }
  return false;
}

void fill(Grid& b, const Extent& scene, std::span<const PlacedBox> boxes, double margin,
          const Apart& apart) {
  const std::size_t cells = static_cast<std::size_t>(b.count[0]) * b.count[1] * b.count[2];
  std::vector<std::vector<std::uint32_t>> lists(cells);
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    const PlacedBox& box = boxes[k];
    const Range x = range_of(b, box.bounds, 0, margin), y = range_of(b, box.bounds, 1, margin),
                z = range_of(b, box.bounds, 2, margin);
    // The outermost cells reach to infinity, which matters for boxes that reach out of the scene.
    const bool bounds_only = protrudes(box.bounds, scene);
    for (int i = x.first; i <= x.last; ++i) {
      for (int j = y.first; j <= y.last; ++j) {
        for (int l = z.first; l <= z.last; ++l) {
          const Extent cell = cell_box(b, i, j, l);
          if (!bounds_only &&
              ((box.oblique && separated(box, cell, margin)) || (apart && apart(k, cell)))) {
            continue;
          }
          lists[(static_cast<std::size_t>(i) * b.count[1] + j) * b.count[2] + l].push_back(k);
        }
      }
    }
  }
  b.first.assign(1, 0);
  for (const auto& list : lists) {
    b.members.insert(b.members.end(), list.begin(), list.end());
    b.first.push_back(static_cast<std::uint32_t>(b.members.size()));
  }
}

}  // namespace

PlacedBox placed_box(const Solid& solid, const Transformation& t) {
  PlacedBox box{placed_extent(solid, t)};
  const double* r = t.rotation;
  for (int i = 0; i < 3 && t.rotated; ++i) {
    const double half = (high(solid.extent, i) - low(solid.extent, i)) / 2;
    box.edges[static_cast<std::size_t>(i)] = {half * r[3 * i], half * r[3 * i + 1],
                                              half * r[3 * i + 2]};
    int along = 0;
    for (int j = 0; j < 3; ++j) along += r[3 * i + j] != 0 ? 1 : 0;
    box.oblique |= along > 1;
  }
  return box;
}

Grid make_grid(const Extent& scene, std::span<const PlacedBox> boxes, double margin, CellUse use,
               const Apart& apart, const GridLimits& limits) {
  // A greedy search: the axis whose refinement lowers the cost most is refined, until none does.
  const Counted counted(boxes);
  std::array<int, 3> count{1, 1, 1};
  Grid best = layout(scene, count);
  double best_cost = cost(best, total_members(best, counted, margin), use);
  for (;;) {
    std::array<int, 3> chosen = count;
    double chosen_cost = best_cost;
    for (int axis = 0; axis < 3; ++axis) {
      // Any count up to a limit is tried, because a grid needs exactly its own pitch, not the next
      // power of two.
      for (int n = count[axis] + 1; n <= std::min(limits.max_per_axis, 4 * count[axis] + 8); ++n) {
        std::array<int, 3> trial = count;
        trial[axis] = n;
        const double cells =
            static_cast<double>(trial[0]) * static_cast<double>(trial[1]) * trial[2];
        if (cells > static_cast<double>(limits.max_cells)) break;
        const Grid candidate = layout(scene, trial);
        const double members = total_members(candidate, counted, margin);
        if (members > static_cast<double>(limits.max_members)) continue;
        const double trial_cost = cost(candidate, members, use);
        if (trial_cost < chosen_cost * (1 - 1e-9)) {
          chosen = trial;
          chosen_cost = trial_cost;
        }
      }
    }
    if (chosen == count) break;
    count = chosen;
    best_cost = chosen_cost;
  }
  Grid result = layout(scene, count);
  fill(result, scene, boxes, margin, apart);
  return result;
}

double mean_candidates(const Grid& grid) {
  return grid.size() == 0
             ? 0
             : static_cast<double>(grid.members.size()) / static_cast<double>(grid.size());
}

}  // namespace navjit

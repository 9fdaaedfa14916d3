#include "geometry/solids/bodies.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "geometry/solids/closing.hpp"

namespace navjit {
namespace detail {
namespace {

using kernels::Facet;
using Box = kernels::FacetBox<double>;
using Group = kernels::FacetGroup<double>;

struct Holder {
  std::vector<Vec3> corners;
  std::vector<Facet> facets;
  std::vector<Box> boxes;
  std::vector<Group> groups;
  kernels::Facets<double> shape{};

  void point() {
    shape = {corners.data(), static_cast<int>(corners.size()),
             facets.data(),  static_cast<int>(facets.size()),
             boxes.data(),   static_cast<int>(boxes.size()),
             groups.data(),  static_cast<int>(groups.size())};
  }
};

Box box_of(const Holder& h, int first, int count) {
  Box box{INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY, first, count, 0};
  for (int i = first; i < first + count; ++i) {
    const Facet& f = h.facets[static_cast<std::size_t>(i)];
    for (const int corner : {f.a, f.b, f.c}) {
      const Vec3& p = h.corners[static_cast<std::size_t>(corner)];
      box.x_low = std::min(box.x_low, p.x);
      box.y_low = std::min(box.y_low, p.y);
      box.z_low = std::min(box.z_low, p.z);
      box.x_high = std::max(box.x_high, p.x);
      box.y_high = std::max(box.y_high, p.y);
      box.z_high = std::max(box.z_high, p.z);
    }
  }
  return box;
}

/// Halves at the median along the longest side, down to a few facets.
void add_boxes(Holder& h, int first, int count) {
  constexpr int leaf = 4;
  const std::size_t at = h.boxes.size();
  h.boxes.push_back(box_of(h, first, count));
  if (count > leaf) {
    const Box box = h.boxes[at];
    h.boxes[at].count = 0;
    const double x = box.x_high - box.x_low, y = box.y_high - box.y_low, z = box.z_high - box.z_low;
    const auto along = [&](const Facet& f) {
      const auto one = [&](int corner) {
        const Vec3& p = h.corners[static_cast<std::size_t>(corner)];
        return x >= y && x >= z ? p.x : y >= z ? p.y : p.z;
      };
      return one(f.a) + one(f.b) + one(f.c);
    };
    std::stable_sort(h.facets.begin() + first, h.facets.begin() + first + count,
                     [&](const Facet& a, const Facet& b) { return along(a) < along(b); });
    add_boxes(h, first, count / 2);
    add_boxes(h, first + count / 2, count - count / 2);
  }
  h.boxes[at].next = static_cast<int>(h.boxes.size());
}

/// Of one group, as arrays.
struct Lanes {
  static constexpr int count = 8;
  double low[3][count], high[3][count];
  int below[count];

  Lanes() {
    std::fill_n(&low[0][0], 3 * count, INFINITY);
    std::fill_n(&high[0][0], 3 * count, -INFINITY);
    std::fill_n(below, count, 0);
  }
  void set(std::size_t lane, const Box& box, int what) {
    const double lows[3] = {box.x_low, box.y_low, box.z_low};
    const double highs[3] = {box.x_high, box.y_high, box.z_high};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis][lane] = lows[axis];
      high[axis][lane] = highs[axis];
    }
    below[lane] = what;
  }
  Group group() const {
    const auto eight = [](const auto* x) {
      return kernels::EightOf<std::decay_t<decltype(*x)>>{x[0], x[1], x[2], x[3],
                                                          x[4], x[5], x[6], x[7]};
    };
    return {eight(low[0]),  eight(low[1]),  eight(low[2]), eight(high[0]),
            eight(high[1]), eight(high[2]), eight(below)};
  }
};

/// Facets that follow one another.
struct Range {
  int first, count;
};

/// A group of these facets, which are in the order of add_boxes; its number.
int add_group(Holder& h, Range all) {
  const auto number = static_cast<int>(h.groups.size());
  h.groups.emplace_back();
  Lanes lanes;
  if (all.count <= Lanes::count) {
    for (int i = 0; i < all.count; ++i) {
      const int facet = all.first + i;
      lanes.set(static_cast<std::size_t>(i), box_of(h, facet, 1), -1 - facet);
    }
  } else {
    // Halves, as the boxes are, of the largest part, until there are enough.
    std::vector<Range> parts{all};
    while (parts.size() < Lanes::count) {
      const auto largest =
          std::max_element(parts.begin(), parts.end(),
                           [](const Range& a, const Range& b) { return a.count < b.count; });
      if (largest->count <= Lanes::count) break;
      const int half = largest->count / 2;
      const Range second{largest->first + half, largest->count - half};
      largest->count = half;
      parts.push_back(second);
    }
    for (std::size_t lane = 0; lane < parts.size(); ++lane) {
      const int below = add_group(h, parts[lane]);
      lanes.set(lane, box_of(h, parts[lane].first, parts[lane].count), below);
    }
  }
  h.groups[static_cast<std::size_t>(number)] = lanes.group();
  return number;
}

/// One corner for all that fall into the same cell of this size. Facets of which nothing is left
/// are left out.
void merge_corners(Holder& h, double cell) {
  std::map<std::array<double, 3>, int> known;
  std::vector<int> merged;
  std::vector<Vec3> kept;
  for (const Vec3& p : h.corners) {
    const std::array<double, 3> key{std::round(p.x / cell), std::round(p.y / cell),
                                    std::round(p.z / cell)};
    const auto [found, added] = known.try_emplace(key, static_cast<int>(kept.size()));
    if (added) kept.push_back({p.x + 0.0, p.y + 0.0, p.z + 0.0});
    merged.push_back(found->second);
  }
  for (Facet& f : h.facets) {
    for (int* corner : {&f.a, &f.b, &f.c}) *corner = merged[static_cast<std::size_t>(*corner)];
  }
  std::erase_if(h.facets, [](const Facet& f) { return f.a == f.b || f.b == f.c || f.c == f.a; });
  h.corners = std::move(kept);
}

/// Merges corners within 1e-9 of the size of each other. If the facets do not close then, within up
/// to 1e-5, so far as fewer edges are open and no facet is lost: corners that were written or
/// computed several times.
void join_corners(Holder& h, double size) {
  const Holder given = h;
  merge_corners(h, 1e-9 * std::max(size, 1e-300));
  std::size_t open = open_edges(h.facets);
  for (double part = 1e-8; open > 0 && part < 2e-5; part *= 10) {
    Holder coarser = given;
    merge_corners(coarser, part * size);
    const std::size_t still_open = open_edges(coarser.facets);
    if (coarser.facets.size() < h.facets.size() || still_open >= open) continue;
    open = still_open;
    h = std::move(coarser);
  }
}

}  // namespace

Solid make_facets(std::string name, std::vector<Vec3> corners, std::vector<Facet> facets,
                  std::string* note) {
  require(!facets.empty() && facets.size() <= 10'000'000, name,
          "it has no facets, or more than 10000000");
  Extent e{corners.front(), corners.front()};
  for (const Vec3& p : corners) {
    require_finite({p.x, p.y, p.z}, name);
    e = merged(e, {p, p});
  }
  const double size = std::max({e.max.x - e.min.x, e.max.y - e.min.y, e.max.z - e.min.z});
  const auto holder = std::make_shared<Holder>();
  holder->corners = std::move(corners);
  holder->facets = std::move(facets);
  join_corners(*holder, size);
  const std::string repaired = describe(close_facets(holder->corners, holder->facets));
  if (note != nullptr && !repaired.empty()) *note = repaired;
  require(holder->facets.size() >= 4, name, "it has less than four facets");
  holder->point();
  const double volume = SolidFacts<kernels::Facets<double>>::volume(holder->shape);
  require(std::abs(volume) > 1e-12 * size * size * size && std::isfinite(volume), name,
          "its facets enclose no volume");
  if (volume < 0) {
    for (Facet& f : holder->facets) std::swap(f.b, f.c);
  }
  add_boxes(*holder, 0, static_cast<int>(holder->facets.size()));
  add_group(*holder, {0, static_cast<int>(holder->facets.size())});
  holder->point();
  return {std::move(name), SolidKind::facets, std::shared_ptr<const void>(holder, &holder->shape),
          e};
}

}  // namespace detail

Solid make_tessellated(std::string name, std::span<const FacetCorners> facets, std::string* note) {
  std::vector<Vec3> corners;
  std::vector<kernels::Facet> triangles;
  for (const FacetCorners& f : facets) {
    detail::require(f.size() == 3 || f.size() == 4, name, "a facet needs three or four corners");
    const int first = static_cast<int>(corners.size());
    corners.insert(corners.end(), f.begin(), f.end());
    triangles.push_back({first, first + 1, first + 2});
    if (f.size() == 4) triangles.push_back({first, first + 2, first + 3});
  }
  detail::require(!triangles.empty(), name, "it has no facets");
  return detail::make_facets(std::move(name), std::move(corners), std::move(triangles), note);
}

double SolidFacts<kernels::Facets<double>>::volume(const Shape& s) {
  const Vec3& o = s.corners[0];
  double volume = 0;
  for (int i = 0; i < s.facet_count; ++i) {
    const kernels::Facet& f = s.facets[i];
    const Vec3 a = kernels::difference(s.corners[f.a], o),
               b = kernels::difference(s.corners[f.b], o);
    const Vec3 c = kernels::difference(s.corners[f.c], o);
    volume += (a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
               a.z * (b.x * c.y - b.y * c.x)) /
              6;
  }
  return volume;
}

}  // namespace navjit

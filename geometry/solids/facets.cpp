#include "geometry/solids/bodies.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "geometry/solids/closing.hpp"
#include "geometry/solids/facet_hierarchy.hpp"

namespace navjit {
namespace detail {
namespace {

using kernels::Facet;

struct Holder {
  std::vector<Vec3> corners;
  std::vector<Facet> facets;
  FacetHierarchy around;
  kernels::Facets<double> shape{};

  void point() {
    const auto& [boxes, groups, leaves] = around;
    shape = {corners.data(), static_cast<int>(corners.size()),
             facets.data(),  static_cast<int>(facets.size()),
             boxes.data(),   static_cast<int>(boxes.size()),
             groups.data(),  static_cast<int>(groups.size()),
             leaves.data(),  static_cast<int>(leaves.size())};
  }
};

/// Makes one corner of all that fall into the same cell of this size. Facets of which nothing
/// remains are left out.
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

/// Merges corners within 1e-9 of the size of one another. If the facets do not close then, merges
/// within up to 1e-5, provided that fewer edges are open and no facet is lost: such corners were
/// written or computed several times.
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
  // Rounding is some 1e-16 of area times size for each facet; there may be ten million.
  require(std::isfinite(volume) && enclose_more(holder->shape, volume, size, 1e-12), name,
          "its facets enclose no volume");
  if (volume < 0) {
    for (Facet& f : holder->facets) std::swap(f.b, f.c);
  }
  holder->around = build_facet_hierarchy(holder->corners, holder->facets);
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

bool enclose_more(const kernels::Facets<double>& s, double volume, double size, double part) {
  double area = 0;
  for (int i = 0; i < s.facet_count; ++i) {
    const kernels::Facet& f = s.facets[i];
    const Vec3& a = s.corners[f.a];
    const Vec3 u = s.corners[f.b] - a, v = s.corners[f.c] - a;
    area += std::hypot(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x) / 2;
  }
  return std::abs(volume) > part * area * size;
}

}  // namespace navjit

#include "analysis/patterns/wires.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/patterns/wire_rows.hpp"
#include "geometry/navigation/geometry.hpp"
#include "geometry/solids/box_blocks.hpp"
#include "geometry/solids/extent.hpp"
#include "geometry/solids/list.hpp"
#include "navjit/vector.hpp"

namespace navjit {
namespace {

/// Boxes, tested eight at once, are as good for fewer wires. A guess.
constexpr std::size_t fewest = 12;
/// Each row costs every ray a comparison, each bundle a rotation of the ray. Guesses.
constexpr std::size_t most_rows = 32, most_bundles = 4, most_directions = 8;
/// How many wires there must be for each other daughter, and how many others there may be in any
/// case.
constexpr std::size_t wires_per_other = 8, few_others = 4;
/// The largest mean number of wires that a row may offer a ray across it. With more, rows tell
/// little.
constexpr double most_offered = 3;

/// A daughter that is this many times as long as it is thick has a direction.
constexpr double elongated = 3;
/// Wires of one direction may be askew by this share of their thickness.
constexpr double most_askew = 0.25;
/// A daughter that is this many times as thick as most is not a wire.
constexpr double too_thick = 3;
/// Rays are tested against the ends of wires only if the mother reaches beyond these by this share
/// of their length.
constexpr double worth_clipping = 0.1;

/// A daughter as it is placed: the middle of its solid, and the solid's axes with half lengths.
struct Placed {
  Vec3 middle;
  std::array<Vec3, 3> axis;
  std::array<double, 3> half;
  bool tube, box;
};

Placed place(const Solid& solid, const Transformation& t) {
  Placed placed;
  const Extent& e = solid.extent;
  const Vec3 half = 0.5 * (e.max - e.min);
  placed.tube = solid.kind == SolidKind::tube;
  placed.box = solid.kind == SolidKind::box;
  placed.half = {half.x, half.y, half.z};
  if (placed.tube) {
    // Whether it is cut to a segment or not, it stays about its axis.
    const auto& tube = *static_cast<const kernels::Tube<double>*>(solid.shape.get());
    placed.half = {tube.rmax, tube.rmax, tube.hz};
    placed.middle = to_outer(t, Vec3{0, 0, 0});
  } else {
    placed.middle = to_outer(t, 0.5 * (e.min + e.max));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    placed.axis[i] = Vec3{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    const double* r = t.rotation + 3 * i;
    if (t.rotated) placed.axis[i] = {r[0], r[1], r[2]};
  }
  return placed;
}

/// The daughter's own axis along which it is elongated; 3 if there is none.
std::size_t long_axis(const Placed& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (p.tube && i != 2) continue;
    const double others = std::max(p.half[(i + 1) % 3], p.half[(i + 2) % 3]);
    if (p.half[i] > elongated * others) return i;
  }
  return 3;
}

/// Whether the wire's own axis `i` runs in this direction.
bool runs_along(const Placed& p, std::size_t i, const Vec3& along) {
  const double thick = std::max(p.half[(i + 1) % 3], p.half[(i + 2) % 3]);
  const double askew = norm(cross(p.axis[i], along));
  return askew <= 0.1 && askew * p.half[i] <= most_askew * thick;
}

/// The own axis that makes a daughter a wire of this direction; 3 if there is none.
std::size_t axis_along(const Placed& p, const Vec3& along) {
  for (std::size_t i = 0; i < 3; ++i) {
    if ((!p.tube || i == 2) && runs_along(p, i, along)) return i;
  }
  return 3;
}

struct SameDirection {
  Vec3 along;
  std::vector<std::uint32_t> members;
};

/// Groups daughters by the direction in which they are elongated. Short daughters join a direction
/// that one of their own axes has. Daughters that fit no direction go to `others`.
std::vector<SameDirection> by_direction(const std::vector<Placed>& placed,
                                        std::vector<std::uint32_t>& others) {
  std::vector<SameDirection> directions;
  for (const Placed& p : placed) {
    const std::size_t i = long_axis(p);
    if (i == 3 || directions.size() == most_directions) continue;
    if (std::none_of(directions.begin(), directions.end(),
                     [&](const SameDirection& d) { return runs_along(p, i, d.along); })) {
      directions.push_back({p.axis[i], {}});
    }
  }
  for (std::uint32_t k = 0; k < placed.size(); ++k) {
    const auto of = std::find_if(directions.begin(), directions.end(), [&](const SameDirection& d) {
      return axis_along(placed[k], d.along) != 3;
    });
    (of == directions.end() ? others : of->members).push_back(k);
  }
  return directions;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How far a wire reaches from its middle along a unit vector, mm.
double reach_along(const Placed& p, const Vec3& d) {
  if (p.tube) return std::abs(dot(p.axis[2], d)) * p.half[2] + p.half[0];
  double reach = 0;
  for (std::size_t i = 0; i < 3; ++i) reach += p.half[i] * std::abs(dot(p.axis[i], d));
  return reach;
}

/// The radius of the circle across `along` that holds the wire, mm.
double radius_across(const Placed& p, const Vec3& along) {
  const std::size_t i = axis_along(p, along);
  const double tilt = p.half[i] * norm(cross(p.axis[i], along));
  return tilt + (p.tube ? p.half[0] : std::hypot(p.half[(i + 1) % 3], p.half[(i + 2) % 3]));
}

/// Two unit vectors across `along`, of which the first is along the row.
std::pair<Vec3, Vec3> axes_across(const Vec3& along) {
  const Vec3 a{std::abs(along.x), std::abs(along.y), std::abs(along.z)};
  const Vec3 other = a.x <= a.y && a.x <= a.z ? Vec3{1, 0, 0}
                     : a.y <= a.z             ? Vec3{0, 1, 0}
                                              : Vec3{0, 0, 1};
  Vec3 first = cross(along, other);
  first = (1 / norm(first)) * first;
  return {first, cross(along, first)};
}

std::array<double, 3> numbers(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 as_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// Makes the cells along a row, about one for each wire, and the first wire of each cell, as the
/// kernels look them up.
void lay_cells(WireRow& row) {
  const std::size_t cells = std::max<std::size_t>(row.u.size(), 2);
  row.origin = row.u.front();
  row.width = std::max((row.u.back() - row.u.front()) / static_cast<double>(cells), row.radius);
  const double per_mm = 1 / row.width;
  std::uint32_t at = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    while (at < row.u.size() &&
           kernels::cell_along(row.u[at], row.origin, per_mm, static_cast<int>(cells)) <
               static_cast<int>(c)) {
      ++at;
    }
    row.first.push_back(at);
  }
  row.first.push_back(static_cast<std::uint32_t>(row.u.size()));
}

/// One row of a bundle, its wires in order.
WireRow make_row(const WireBundle& bundle, const std::vector<Placed>& placed,
                 const std::vector<std::uint32_t>& members, double margin) {
  const Vec3 across = as_vector(bundle.across), normal = as_vector(bundle.normal),
             along = as_vector(bundle.along);
  WireRow row;
  row.members = members;
  const auto u = [&](std::uint32_t k) { return dot(across, placed[k].middle); };
  const auto n = [&](std::uint32_t k) { return dot(normal, placed[k].middle); };
  std::sort(row.members.begin(), row.members.end(), [&](std::uint32_t a, std::uint32_t b) {
    return u(a) < u(b) || (u(a) == u(b) && a < b);
  });
  double low = INFINITY, high = -INFINITY;
  for (const std::uint32_t k : row.members) {
    row.u.push_back(u(k));
    low = std::min(low, n(k));
    high = std::max(high, n(k));
  }
  row.at = (low + high) / 2;
  for (const std::uint32_t k : row.members) {
    const double off = std::abs(n(k) - row.at) + margin;
    row.half_u = std::max(row.half_u, reach_along(placed[k], across) + margin);
    row.half_n = std::max(row.half_n, reach_along(placed[k], normal) + off);
    row.radius = std::max(row.radius, radius_across(placed[k], along) + off);
  }
  lay_cells(row);
  return row;
}

/// Whether a distance in the plane across the wires is a lower bound of a wire's safety_to_in: for
/// tubes the distance from the circle, for boxes with axes along u and n that from the rectangle.
bool safety_is_known(const WireBundle& bundle, const Placed& p, double largest, double margin) {
  const auto is_along = [&](const Vec3& axis, const std::array<double, 3>& d) {
    return 4 * largest * norm(cross(axis, as_vector(d))) < margin / 4;
  };
  if (p.tube) return is_along(p.axis[2], bundle.along);
  const auto is_axis = [&](const std::array<double, 3>& d) {
    return std::any_of(p.axis.begin(), p.axis.end(),
                       [&](const Vec3& axis) { return is_along(axis, d); });
  };
  return p.box && is_axis(bundle.across) && is_axis(bundle.normal);
}

/// Sets where all wires of a bundle end, and whether the mother reaches farther.
void clip_ends(const std::vector<Placed>& placed, const Placed& mother, double margin,
               WireBundle& bundle) {
  const Vec3 along = as_vector(bundle.along);
  bundle.low = INFINITY;
  bundle.high = -INFINITY;
  for (const WireRow& row : bundle.rows) {
    for (const std::uint32_t k : row.members) {
      const double at = dot(along, placed[k].middle),
                   reach = reach_along(placed[k], along) + margin;
      bundle.low = std::min(bundle.low, at - reach);
      bundle.high = std::max(bundle.high, at + reach);
    }
  }
  const double worth_it = worth_clipping * (bundle.high - bundle.low);
  const double middle = dot(along, mother.middle), reach = reach_along(mother, along);
  bundle.ends = middle - reach < bundle.low - worth_it || middle + reach > bundle.high + worth_it;
}

/// Whether rays across a row are offered few of its wires.
bool tells_wires_apart(const WireRow& row) {
  const double span = row.u.back() - row.u.front() + 2 * row.radius;
  return 2 * row.radius * static_cast<double>(row.u.size()) <= most_offered * span;
}

/// The wires of one direction in bundles; nothing if a row tells too little. Places in no row
/// remain in `places`.
std::optional<std::vector<WireBundle>> make_bundles(const Vec3& along, double radius,
                                                    const std::vector<Placed>& placed,
                                                    const Placed& mother, double margin,
                                                    std::vector<PlaceAcross>& places, const Vec3& x,
                                                    const Vec3& y) {
  // Rows along the mother's own axes are the commonest.
  std::vector<std::array<double, 2>> likely;
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    likely.push_back({dot(axis, x), dot(axis, y)});
  }
  std::vector<WireBundle> bundles;
  while (const std::optional<RowsAcross> found = find_rows(places, likely, radius)) {
    WireBundle bundle;
    const auto [c, s] = found->along;
    bundle.along = numbers(along);
    bundle.across = numbers(c * x + s * y);
    bundle.normal = numbers(c * y - s * x);
    bundle.round = true;
    std::vector<char> taken(placed.size(), 0);
    for (const auto& members : found->rows) {
      bundle.rows.push_back(make_row(bundle, placed, members, margin));
      if (!tells_wires_apart(bundle.rows.back())) return {};
      for (const std::uint32_t k : members) {
        taken[k] = 1;
        bundle.round &= placed[k].tube;
      }
    }
    std::sort(bundle.rows.begin(), bundle.rows.end(),
              [](const WireRow& a, const WireRow& b) { return a.at < b.at; });
    clip_ends(placed, mother, margin, bundle);
    bundles.push_back(std::move(bundle));
    std::erase_if(places, [&](const PlaceAcross& p) { return taken[p.daughter]; });
  }
  return bundles;
}

}  // namespace

std::optional<Wires> find_wires(const World& world, const Solid& mother,
                                std::span<const Daughter> daughters, double margin) {
  if (daughters.size() < fewest) return {};
  std::vector<Placed> placed;
  const Placed outer = place(mother, Transformation{});
  double largest = largest_coordinate(mother.extent);
  for (const Daughter& d : daughters) {
    placed.push_back(place(world.volumes[d.volume].solid, d.transformation));
    largest = std::max(largest, norm(placed.back().middle));
  }
  if (!std::isfinite(largest)) return {};
  Wires wires;
  wires.safety_known = true;
  for (const SameDirection& same : by_direction(placed, wires.others)) {
    if (same.members.empty()) continue;
    std::vector<double> radii;
    radii.reserve(same.members.size());
    for (const std::uint32_t k : same.members) {
      radii.push_back(radius_across(placed[k], same.along));
    }
    const double radius = median(radii);
    const auto [x, y] = axes_across(same.along);
    std::vector<PlaceAcross> places;
    for (std::size_t i = 0; i < same.members.size(); ++i) {
      const std::uint32_t k = same.members[i];
      if (radii[i] > too_thick * radius) {
        wires.others.push_back(k);
      } else {
        places.push_back({k, dot(x, placed[k].middle), dot(y, placed[k].middle)});
      }
    }
    auto bundles = make_bundles(same.along, radius, placed, outer, margin, places, x, y);
    if (!bundles) return {};
    for (WireBundle& bundle : *bundles) wires.bundles.push_back(std::move(bundle));
    for (const PlaceAcross& p : places) wires.others.push_back(p.daughter);
  }
  std::size_t rows = 0;
  for (const WireBundle& bundle : wires.bundles) {
    rows += bundle.rows.size();
    for (const WireRow& row : bundle.rows) {
      for (const std::uint32_t k : row.members) {
        wires.safety_known &= safety_is_known(bundle, placed[k], largest, margin);
      }
    }
  }
  const std::size_t members = daughters.size() - wires.others.size();
  if (members < fewest || rows > most_rows || wires.bundles.size() > most_bundles) return {};
  if (wires.others.size() > std::max(few_others, members / wires_per_other)) return {};
  std::sort(wires.others.begin(), wires.others.end());
  return wires;
}

std::string describe_wires(const Wires& wires) {
  std::size_t rows = 0, members = 0;
  for (const WireBundle& bundle : wires.bundles) {
    rows += bundle.rows.size();
    for (const WireRow& row : bundle.rows) members += row.members.size();
  }
  std::string text = std::to_string(members) + " wires in " + std::to_string(rows) +
                     (rows == 1 ? " row" : " rows");
  if (!wires.others.empty()) text += " and " + std::to_string(wires.others.size()) + " more";
  return text;
}

}  // namespace navjit

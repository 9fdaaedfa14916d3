#include "geometry/reference/wide_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/model/placed_extent.hpp"
#include "navjit/detail/standing.hpp"

namespace navjit::reference {
namespace {

Vec3 narrow(const WidePoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

/// The box with a margin far larger than the rounding of everything that it was made from.
Extent inflated(const Extent& e, double tolerance) {
  const double size = std::max({std::abs(e.min.x), std::abs(e.min.y), std::abs(e.min.z),
                                std::abs(e.max.x), std::abs(e.max.y), std::abs(e.max.z)});
  const double margin = 1e-9 * size + 100 * tolerance;
  return {{e.min.x - margin, e.min.y - margin, e.min.z - margin},
          {e.max.x + margin, e.max.y + margin, e.max.z + margin}};
}

bool within(const Extent& e, const Vec3& p) {
  return p.x >= e.min.x && p.x <= e.max.x && p.y >= e.min.y && p.y <= e.max.y && p.z >= e.min.z &&
         p.z <= e.max.z;
}

/// False only if the ray certainly does not meet the box within `limit`.
bool may_meet(const Extent& e, const Vec3& p, const Vec3& v, double limit) {
  double enter = 0, leave = limit;
  const double low[3] = {e.min.x, e.min.y, e.min.z}, high[3] = {e.max.x, e.max.y, e.max.z};
  const double at[3] = {p.x, p.y, p.z}, slope[3] = {v.x, v.y, v.z};
  for (int i = 0; i < 3; ++i) {
    if (std::abs(slope[i]) < 1e-12) continue;  // the other axes decide alone
    double a = (low[i] - at[i]) / slope[i], b = (high[i] - at[i]) / slope[i];
    if (a > b) std::swap(a, b);
    enter = std::max(enter, a);
    leave = std::min(leave, b);
  }
  return enter <= leave + 1e-6 + 1e-9 * std::abs(leave);
}

}  // namespace

WidePoint widen(const Vec3& p) { return {p.x, p.y, p.z}; }

WideDirection widen_direction(const Vec3& v) {
  return kernels::make_direction<Quad>(v.x, v.y, v.z);
}

WidePoint along(const Vec3& p, const Vec3& v, double t) {
  return {Quad(p.x) + Quad(t) * v.x, Quad(p.y) + Quad(t) * v.y, Quad(p.z) + Quad(t) * v.z};
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::right:
      return "right";
    case Verdict::near_a_boundary:
      return "near a boundary";
    case Verdict::overlap:
      return "overlap";
    case Verdict::protrusion:
      return "protrusion";
    case Verdict::outside:
      return "outside";
    case Verdict::missed_daughter:
      return "missed daughter";
  }
  return "";
}

Chain chain_of(const World& world, TouchableId touchable) {
  Chain chain;
  const LogicalVolume* volume = &world.volumes[world.top];
  while (touchable > 0) {
    const auto after = std::upper_bound(
        volume->daughters.begin(), volume->daughters.end(), touchable,
        [](TouchableId id, const Placement& placement) { return id < placement.offset; });
    const auto index = static_cast<std::uint32_t>(after - volume->daughters.begin() - 1);
    chain.push_back(index);
    touchable -= volume->daughters[index].offset;
    volume = &world.volumes[volume->daughters[index].volume];
  }
  return chain;
}

WideGeometry::WideGeometry(std::shared_ptr<const World> world) : world_(std::move(world)) {
  std::map<const void*, std::size_t> known;  // volumes may share shapes
  for (const LogicalVolume& volume : world_->volumes) {
    const auto [entry, fresh] = known.try_emplace(volume.solid.shape.get(), solids_.size());
    if (fresh) solids_.push_back(std::make_shared<const WideSolid<Quad>>(volume.solid));
    Scene scene;
    scene.solid = solids_[entry->second]->any();
    for (const Placement& placement : volume.daughters) {
      const Transformation& t = placement.transformation;
      Placed placed{{}, {}, t.rotated, placement.volume};
      std::copy_n(t.translation, 3, placed.translation);
      std::copy_n(t.rotation, 9, placed.rotation);
      scene.daughters.push_back(placed);
      scene.boxes.push_back(
          inflated(placed_extent(world_->volumes[placement.volume].solid, t), world_->tolerance));
    }
    scenes_.push_back(std::move(scene));
  }
}

WidePoint WideGeometry::to_local(const Placed& t, const WidePoint& p) {
  const Quad x = p.x - t.translation[0], y = p.y - t.translation[1], z = p.z - t.translation[2];
  if (!t.rotated) return {x, y, z};
  const Quad* r = t.rotation;
  return {r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z,
          r[6] * x + r[7] * y + r[8] * z};
}

WideDirection WideGeometry::to_local(const Placed& t, const WideDirection& v) {
  if (!t.rotated) return v;
  const Quad* r = t.rotation;
  return kernels::make_direction<Quad>(r[0] * v.x + r[1] * v.y + r[2] * v.z,
                                       r[3] * v.x + r[4] * v.y + r[5] * v.z,
                                       r[6] * v.x + r[7] * v.y + r[8] * v.z);
}

Verdict WideGeometry::judge(const Chain& chain, const WidePoint& point, double tolerance) const {
  const Quad tol = tolerance;
  bool near = false, overlap = false, protrusion = false;
  VolumeId volume = world_->top;
  WidePoint p = point;
  for (std::size_t level = 0;; ++level) {
    const Scene& scene = scenes_[volume];
    const bool last = level == chain.size();
    const Side side = inside(scene.solid, p, tol);
    if (side == Side::outside && last) return Verdict::outside;
    protrusion = protrusion || side == Side::outside;
    near = near || side == Side::surface;
    const Vec3 narrow_p = narrow(p);
    for (std::size_t k = 0; k < scene.daughters.size(); ++k) {
      if (!within(scene.boxes[k], narrow_p) || (!last && k == chain[level])) continue;
      const Placed& d = scene.daughters[k];
      const Side there = inside(scenes_[d.volume].solid, to_local(d, p), tol);
      if (there == Side::inside && last) return Verdict::missed_daughter;
      overlap = overlap || there == Side::inside;
      near = near || there == Side::surface;
    }
    if (last) break;
    const Placed& next = scene.daughters[chain[level]];
    p = to_local(next, p);
    volume = next.volume;
  }
  if (protrusion) return Verdict::protrusion;
  if (overlap) return Verdict::overlap;
  return near ? Verdict::near_a_boundary : Verdict::right;
}

void WideGeometry::push(std::vector<Level>& levels, std::uint32_t daughter) const {
  const Level& mother = levels.back();
  const Placed& placed = scenes_[mother.volume].daughters[daughter];
  levels.push_back(
      {placed.volume, daughter, to_local(placed, mother.p), to_local(placed, mother.v)});
}

void WideGeometry::move(std::vector<Level>& levels, Quad t) const {
  levels.front().p = kernels::advance(levels.front().p, levels.front().v, t);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    levels[i].p =
        to_local(scenes_[levels[i - 1].volume].daughters[levels[i].daughter], levels[i - 1].p);
  }
}

void WideGeometry::relocate(std::vector<Level>& levels, int blocked) const {
  const Quad tol = world_->tolerance;
  while (blocked >= 0) {
    const Level& level = levels.back();
    if (contains(scenes_[level.volume].solid, level.p, level.v, tol)) break;
    blocked = static_cast<int>(level.daughter);
    levels.pop_back();
    if (levels.empty()) return;
  }
  for (bool found = true; found; blocked = -1) {
    const Level& level = levels.back();
    const Scene& scene = scenes_[level.volume];
    const Vec3 p = narrow(level.p);
    found = false;
    for (auto k = static_cast<std::uint32_t>(scene.daughters.size()); k-- > 0 && !found;) {
      if (static_cast<int>(k) == blocked || !within(scene.boxes[k], p)) continue;
      const Placed& d = scene.daughters[k];
      if (contains(scenes_[d.volume].solid, to_local(d, level.p), to_local(d, level.v), tol)) {
        found = true;
        push(levels, k);
      }
    }
  }
}

bool WideGeometry::locate(const WidePoint& point, const WideDirection& direction,
                          Chain& chain) const {
  chain.clear();
  std::vector<Level> levels{{world_->top, 0, point, direction}};
  if (!contains(scenes_[world_->top].solid, point, direction, Quad(world_->tolerance))) {
    return false;
  }
  relocate(levels, -1);
  for (std::size_t i = 1; i < levels.size(); ++i) chain.push_back(levels[i].daughter);
  return true;
}

std::vector<WideStep> WideGeometry::trace(const Vec3& point, const Vec3& direction,
                                          bool& stuck) const {
  const Quad tol = world_->tolerance;
  std::vector<WideStep> steps;
  std::vector<Level> levels{{world_->top, 0, widen(point), widen_direction(direction)}};
  stuck = false;
  if (!contains(scenes_[world_->top].solid, levels[0].p, levels[0].v, tol)) return steps;
  relocate(levels, -1);
  for (detail::Standing standing; !levels.empty();) {
    const VolumeId volume = levels.back().volume;
    VolumeId surface;
    const Quad t = next(levels, surface);
    steps.push_back({volume, t});
    standing.count(t, world_->tolerance);
    if (standing.stuck()) {
      stuck = true;
      return steps;
    }
  }
  return steps;
}

/// Makes one step. Leaves the levels at the next touchable; there are none outside the world.
Quad WideGeometry::next(std::vector<Level>& levels, VolumeId& surface) const {
  const Quad tol = world_->tolerance;
  const Level& level = levels.back();
  const Scene& scene = scenes_[level.volume];
  Quad t = distance_to_out(scene.solid, level.p, level.v, tol);
  int into = -1;
  surface = level.volume;
  const Vec3 p = narrow(level.p), v = narrow({level.v.x, level.v.y, level.v.z});
  for (std::size_t k = 0; k < scene.daughters.size(); ++k) {
    if (!may_meet(scene.boxes[k], p, v, static_cast<double>(t))) continue;
    const Placed& d = scene.daughters[k];
    const Quad in =
        distance_to_in(scenes_[d.volume].solid, to_local(d, level.p), to_local(d, level.v), tol);
    if (in < t) {
      t = in;
      into = static_cast<int>(k);
      surface = d.volume;
    }
  }
  move(levels, t);
  if (into >= 0) {
    push(levels, static_cast<std::uint32_t>(into));
    relocate(levels, -1);
  } else {
    const int left = static_cast<int>(levels.back().daughter);
    levels.pop_back();
    if (!levels.empty()) relocate(levels, left);
  }
  return t;
}

std::vector<WideGeometry::Level> WideGeometry::levels_of(const Chain& chain, const WidePoint& point,
                                                         const WideDirection& direction) const {
  std::vector<Level> levels{{world_->top, 0, point, direction}};
  for (const std::uint32_t daughter : chain) push(levels, daughter);
  return levels;
}

WideAnswer WideGeometry::step(const Chain& chain, const WidePoint& point,
                              const WideDirection& direction) const {
  std::vector<Level> levels = levels_of(chain, point, direction);
  WideAnswer answer{0, false, {}, world_->top, 0};
  const auto measure = [&](const WidePoint& p) {
    const Vec3 q = narrow(p);
    answer.magnitude = std::max({answer.magnitude, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
  };
  const std::vector<Level> before = levels;
  answer.length = next(levels, answer.surface);
  for (const Level& level : before) {
    measure(level.p);
    measure(kernels::advance(level.p, level.v, answer.length));
  }
  for (const Level& level : levels) measure(level.p);
  answer.inside = !levels.empty();
  for (std::size_t i = 1; i < levels.size(); ++i) answer.next.push_back(levels[i].daughter);
  return answer;
}

Quad WideGeometry::nearest_surface(const Chain& chain, const WidePoint& point) const {
  WidePoint p = point;
  VolumeId volume = world_->top;
  for (const std::uint32_t daughter : chain) {
    const Placed& placed = scenes_[volume].daughters[daughter];
    p = to_local(placed, p);
    volume = placed.volume;
  }
  const Scene& scene = scenes_[volume];
  const auto away = [](const kernels::AnySolid<Quad>& solid, const WidePoint& q) {
    return kernels::larger(safety_to_in(solid, q), safety_to_out(solid, q));
  };
  Quad nearest = away(scene.solid, p);
  const Vec3 narrow_p = narrow(p);
  for (std::size_t k = 0; k < scene.daughters.size(); ++k) {
    if (!within(scene.boxes[k], narrow_p)) continue;
    const Placed& d = scene.daughters[k];
    nearest = kernels::smaller(nearest, away(scenes_[d.volume].solid, to_local(d, p)));
  }
  return nearest;
}

double WideGeometry::across(const Chain& chain, const Vec3& start, const Vec3& direction,
                            Quad length, Quad right) const {
  // The right end need not be on a surface: along a face it is as far from it as the ray is.
  const auto away = [&](Quad t) {
    return nearest_surface(chain, kernels::advance(widen(start), widen_direction(direction), t));
  };
  return static_cast<double>(kernels::smaller(kernels::absolute(length - right),
                                              kernels::absolute(away(length) - away(right))));
}

Quad WideGeometry::exit(const Vec3& point, const Vec3& direction) const {
  return distance_to_out(scenes_[world_->top].solid, widen(point), widen_direction(direction),
                         Quad(world_->tolerance));
}

Side WideGeometry::side_of_world(const WidePoint& point, double tolerance) const {
  return inside(scenes_[world_->top].solid, point, Quad(tolerance));
}

}  // namespace navjit::reference

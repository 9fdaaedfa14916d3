#include "geometry/solids/union_parts.hpp"

#include <algorithm>

#include "geometry/solids/extent.hpp"

namespace navjit::kernels {
namespace {

BoxBlock no_boxes() {
  BoxBlock block;
  for (int axis = 0; axis < 3; ++axis) {
    block.low[axis] = all_lanes(__builtin_inff());
    block.high[axis] = all_lanes(-__builtin_inff());
  }
  return block;
}

/// Adds the box around all boxes of a block.
void add_group(std::vector<BoxBlock>& groups, std::size_t number, const BoxBlock& block) {
  if (number % box_lanes == 0) groups.push_back(no_boxes());
  const std::size_t lane = number % box_lanes;
  for (int axis = 0; axis < 3; ++axis) {
    for (int l = 0; l < box_lanes; ++l) {
      Floats &low = groups.back().low[axis], &high = groups.back().high[axis];
      low[lane] = std::min<float>(low[lane], block.low[axis][l]);
      high[lane] = std::max<float>(high[lane], block.high[axis][l]);
    }
  }
}

/// Calls ask(number) for parts in the lanes that `lanes(block)` gives, until it says "enough".
template <class Lanes, class Ask>
bool ask_parts(const UnionParts& s, const Lanes& lanes, const Ask& ask) {
  const auto ask_block = [&](std::size_t b) {
    for (unsigned met = lanes(s.blocks[b]); met != 0; met &= met - 1) {
      if (ask(b * box_lanes + static_cast<unsigned>(__builtin_ctz(met)))) return true;
    }
    return false;
  };
  if (s.blocks.size() <= 2) {
    for (std::size_t b = 0; b < s.blocks.size(); ++b) {
      if (ask_block(b)) return true;
    }
    return false;
  }
  for (std::size_t g = 0; g < s.groups.size(); ++g) {
    for (unsigned met = lanes(s.groups[g]); met != 0; met &= met - 1) {
      if (ask_block(g * box_lanes + static_cast<unsigned>(__builtin_ctz(met)))) return true;
    }
  }
  return false;
}

/// The path to where the ray meets the box around all; more than `reach` if that is farther.
double path_to_all(const UnionParts& s, const Vec3<double>& p, const Direction<double>& v,
                   double reach) {
  const double at[3] = {p.x, p.y, p.z}, rate[3] = {v.x, v.y, v.z},
               inverse[3] = {v.inverse_x, v.inverse_y, v.inverse_z};
  double enter = 0, leave = reach;
  for (int axis = 0; axis < 3; ++axis) {
    const bool down = rate[axis] < 0;
    enter = larger(((down ? s.high : s.low)[axis] - at[axis]) * inverse[axis], enter);
    leave = smaller(((down ? s.low : s.high)[axis] - at[axis]) * inverse[axis], leave);
  }
  return enter <= leave ? enter : infinity<double>();
}

bool is_around(const UnionParts& s, const Vec3<double>& p) {
  return (p.x >= s.low[0]) & (p.x <= s.high[0]) & (p.y >= s.low[1]) & (p.y <= s.high[1]) &
         (p.z >= s.low[2]) & (p.z <= s.high[2]);
}

/// The block whose box is the nearest.
std::size_t nearest_block(const UnionParts& s, const BoxDistances& from) {
  std::size_t nearest = 0;
  float least = __builtin_inff();
  for (std::size_t g = 0; g < s.groups.size(); ++g) {
    const Floats distance = from.along_axes(s.groups[g]);
    const unsigned lane = least_lane(distance);
    if (!(distance[lane] < least)) continue;
    least = distance[lane];
    nearest = g * box_lanes + lane;
  }
  return nearest;
}

}  // namespace

UnionParts make_union_parts(std::span<const Solid> parts,
                            std::vector<AnyOperand<double>> operands) {
  UnionParts s{};
  s.operands = std::move(operands);
  Extent all = parts[0].extent;
  for (const Solid& part : parts) all = merged(all, part.extent);
  s.margin = 0x1p-20 * largest_coordinate(all);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t lane = i % box_lanes;
    if (lane == 0) s.blocks.push_back(no_boxes());
    const Extent box = inflated(parts[i].extent, s.margin);
    const double low[3] = {box.min.x, box.min.y, box.min.z},
                 high[3] = {box.max.x, box.max.y, box.max.z};
    for (int axis = 0; axis < 3; ++axis) {
      s.blocks.back().low[axis][lane] = strictly_below(low[axis]);
      s.blocks.back().high[axis][lane] = strictly_above(high[axis]);
    }
  }
  for (std::size_t b = 0; b < s.blocks.size(); ++b) add_group(s.groups, b, s.blocks[b]);
  const Extent around = inflated(all, s.margin);
  const double low[3] = {around.min.x, around.min.y, around.min.z},
               high[3] = {around.max.x, around.max.y, around.max.z};
  std::copy_n(low, 3, s.low);
  std::copy_n(high, 3, s.high);
  return s;
}

bool is_wide_enough(const UnionParts& s, double tol) { return s.margin > 8 * tol; }

bool contains(const UnionParts& s, const Vec3<double>& p, const Direction<double>& v, double tol) {
  return is_around(s, p) &&
         ask_parts(
             s, [&](const BoxBlock& block) { return lanes_around(block, p); },
             [&](std::size_t k) { return contains(s.operands[k].solid, p, v, tol); });
}

double furthest_out(const UnionParts& s, const Vec3<double>& p, const Direction<double>& v,
                    double tol) {
  double furthest = 0;
  if (!is_around(s, p)) return furthest;
  ask_parts(
      s, [&](const BoxBlock& block) { return lanes_around(block, p); },
      [&](std::size_t k) {
        furthest = larger(furthest_out(s.operands[k].solid, p, v, tol), furthest);
        return false;
      });
  return furthest;
}

double nearest_in(const UnionParts& s, const Vec3<double>& p, const Direction<double>& v,
                  double best, double tol) {
  // Starts where the ray comes near to them, so that single precision is accurate enough.
  const double ahead = path_to_all(s, p, v, best);
  if (!(ahead < infinity<double>())) return best;
  const FloatRay ray = float_ray(advance(p, v, ahead), v);
  Floats enter;
  ask_parts(
      s,
      [&](const BoxBlock& block) {
        return lanes_met(block, ray, 0.0F, strictly_above(best - ahead), enter);
      },
      [&](std::size_t k) {
        best = nearest_in(s.operands[k].solid, p, v, best, tol);
        return false;
      });
  return best;
}

double safety_to_in(const UnionParts& s, const Vec3<double>& p) {
  const BoxDistances from(p);
  double safety = infinity<double>();
  // Calls ask(lane) for boxes that are nearer than what was found, the nearest first.
  const auto nearest_first = [&](const BoxBlock& block, auto ask) {
    Floats distance = from.along_axes(block);
    for (;;) {
      const unsigned lane = least_lane(distance);
      if (!(static_cast<double>(distance[lane]) < safety)) return;
      ask(lane);
      distance[lane] = __builtin_inff();
    }
  };
  const auto ask_block = [&](std::size_t b) {
    nearest_first(s.blocks[b], [&](unsigned lane) {
      safety = smaller(safety_to_in(s.operands[b * box_lanes + lane], p), safety);
    });
  };
  if (s.blocks.size() <= 2) {
    for (std::size_t b = 0; b < s.blocks.size(); ++b) ask_block(b);
    return safety;
  }
  // The block with the nearest box comes first: after it hardly any other is near enough.
  const std::size_t first = nearest_block(s, from);
  ask_block(first);
  for (std::size_t g = 0; g < s.groups.size(); ++g) {
    nearest_first(s.groups[g], [&](unsigned lane) {
      if (g * box_lanes + lane != first) ask_block(g * box_lanes + lane);
    });
  }
  return safety;
}

double safety_to_out(const UnionParts& s, const Vec3<double>& p) {
  double safety = 0;
  if (!is_around(s, p)) return safety;
  ask_parts(
      s, [&](const BoxBlock& block) { return lanes_around(block, p); },
      [&](std::size_t k) {
        safety = safety_or_out(s.operands[k], p, safety);
        return false;
      });
  return safety;
}

}  // namespace navjit::kernels

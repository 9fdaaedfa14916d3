// A world whose volumes are all bound to data, and steps through it without a runtime.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/plan.hpp"
#include "codegen/data/bind.hpp"
#include "geometry/navigation/generic.hpp"
#include "geometry/navigation/steps_of_no_length.hpp"

namespace navjit::tests {

struct BoundWorld {
  Geometry geometry;
  codegen::Arena arena;
  std::vector<const kernels::DispatchEntry*> table;
  kernels::Context context{};

  /// `search`: how daughters are found wherever that is possible.
  explicit BoundWorld(World world, std::optional<Candidates> search = std::nullopt)
      : geometry(std::make_shared<const World>(std::move(world))) {
    WorldFacts facts = analyse_world(geometry);
    for (VolumeId v = 0; v < geometry.size(); ++v) {
      if (search) facts.forced_candidates[v] = *search;
      table.push_back(facts.reachable[v]
                          ? codegen::bind_to_data(geometry, plan_scene(geometry, facts, v), arena)
                          : &generic::dispatch_entry);
    }
    context = {table.data(), &geometry, leave_at_once, return_at_once};
  }

  double step(NavigationStack& stack, const Vec3& p, const Vec3& v, double limit) const {
    kernels::set_ray(stack, v.x, v.y, v.z);
    const auto& entry = *table[stack.levels[stack.depth].volume];
    const double length = entry.step(&stack, &context, entry.data, p.x, p.y, p.z, limit);
    return length >= 0 ? length : generic::step(geometry, stack, p, v, limit);
  }

  struct Compared {
    double length;  ///< the generic navigator's
    bool same;      ///< bit by bit, and where it leads
  };
  /// The same step by the generic navigator, of `right`, and bound to data, of `got`.
  Compared step_both(NavigationStack& right, NavigationStack& got, const Vec3& p, const Vec3& v,
                     double limit) const {
    const double expected = generic::step(geometry, right, p, v, limit);
    const double length = step(got, p, v, limit);
    return {expected, kernels::same_bits(length, expected) && identical(right, got)};
  }
};

}  // namespace navjit::tests

#include "geometry/navigation/generic.hpp"

#include <algorithm>
#include <span>

#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/navigation/packed_daughter.hpp"

namespace navjit::generic {
namespace {

constexpr unsigned no_daughter = ~0U;  ///< greater than any daughter's number

/// The daughter, other than `blocked`, that holds the local point. Where daughters overlap the last
/// in file order wins, as in Geant4. A daughter for which `confirm(k)` is false does not count.
/// `around`: the neighbours of the blocked daughter, if the point is in its box.
template <class Confirm>
unsigned find_daughter(const PackedScene& scene, const Vec3& p, const Direction& v, int blocked,
                       double tolerance, const NeighbourLists::Of* around, const Confirm& confirm) {
  if (around != nullptr && around->listed()) {
    const auto holds = [&](unsigned k) {
      return contains_local(scene.daughters[k], p, v, tolerance) && confirm(k);
    };
    const std::uint32_t* const neighbours = scene.neighbours + around->first;
    if (around->block != NeighbourLists::Of::no_block) {
      return static_cast<unsigned>(
          kernels::first_around(scene.blocks + around->block, neighbours, around->count, p, holds));
    }
    for (std::uint32_t n = 0; n < around->count; ++n) {
      if (holds(neighbours[n])) return neighbours[n];
    }
    return no_daughter;
  }
  unsigned found = no_daughter;
  const auto test = [&](unsigned k) {
    if ((found == no_daughter || k > found) && static_cast<int>(k) != blocked &&
        contains_local(scene.daughters[k], p, v, tolerance) && confirm(k)) {
      found = k;
    }
    return true;
  };
  switch (scene.search) {
    case Search::none:
      break;
    case Search::all:
      for (unsigned k = scene.count; k-- > 0 && found == no_daughter;) {
        test(k);
      }
      break;
    case Search::linear_boxes:
    case Search::bvh:
      scene.boxes->containing(p, test);
  }
  return found;
}

/// The same for a point without a direction, apart from the frequent case: on a face that daughters
/// share, the first in file order wins; well inside, the rule is that of find_daughter.
[[gnu::noinline]] unsigned find_daughter_undirected(const PackedScene& scene, const Vec3& p,
                                                    double tolerance) {
  const Direction none = kernels::make_heading(0.0, 0.0, 0.0);
  unsigned on_face = no_daughter, within = no_daughter;
  const auto test = [&](unsigned k) {
    const PackedDaughter& d = scene.daughters[k];
    const Vec3 q = local(d, p);
    if (!contains(d.solid, q, none, tolerance)) return true;
    if (inside(d.solid, q, tolerance) != Side::inside) {
      on_face = std::min(on_face, k);
    } else if (within == no_daughter || k > within) {
      within = k;
    }
    return true;
  };
  if (scene.boxes != nullptr) {
    scene.boxes->containing(p, test);
  } else {
    for (unsigned k = 0; k < scene.count; ++k) test(k);
  }
  return within != no_daughter ? within : on_face;
}

struct Hit {
  double distance;
  unsigned daughter;
};

/// The nearest daughter ahead that is nearer than `distance`, which is that to the mother's exit;
/// of equally near ones the first in file order. Daughters beyond `limit` may be left out, and so
/// may one at distance zero for which `confirm(k)` is false.
template <class Confirm>
Hit nearest_daughter(const PackedScene& scene, const Vec3& p, const Direction& v, double distance,
                     double limit, double tolerance, const Confirm& confirm) {
  Hit hit{distance, no_daughter};
  const auto test = [&](unsigned k) {
    const double d = distance_local(scene.daughters[k], p, v, tolerance);
    if (d == 0 && !confirm(k)) return hit.distance;
    if (d < hit.distance ||
        (d == hit.distance && hit.daughter != no_daughter && k < hit.daughter)) {
      hit = {d, k};
    }
    return hit.distance;
  };
  switch (scene.search) {
    case Search::none:
      break;
    case Search::all:
      for (unsigned k = 0; k < scene.count; ++k) test(k);
      break;
    case Search::linear_boxes:
    case Search::bvh:
      scene.boxes->along_ray(p, v, std::min(limit, distance),
                             [&](unsigned k, double) { return std::min(limit, test(k)); });
  }
  return hit;
}

}  // namespace

bool enter(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
           const Vec3& direction) {
  enter_world(stack, geometry.world().top);
  stack.boundary = 0;
  // Nearly all rays start well inside a world that is a box.
  const Extent& well_inside = geometry.well_inside();
  if ((point.x > well_inside.min.x) & (point.x < well_inside.max.x) &
      (point.y > well_inside.min.y) & (point.y < well_inside.max.y) &
      (point.z > well_inside.min.z) & (point.z < well_inside.max.z)) {
    return true;
  }
  const Vec3 p{point.x + 0.0, point.y + 0.0, point.z + 0.0};
  const Direction v = kernels::make_heading(direction.x, direction.y, direction.z);
  if (contains(geometry.packed(geometry.world().top).solid, p, v, geometry.tolerance()))
    return true;
  stack.depth = -1;
  return false;
}

void locate(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
            const Vec3& direction) {
  if (!enter(geometry, stack, point, direction)) return;
  relocate(geometry, stack, {point.x + 0.0, point.y + 0.0, point.z + 0.0}, direction, -1);
}

bool ascend(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
            const Vec3& direction) {
  stack.boundary = 0;
  const Vec3 p{point.x + 0.0, point.y + 0.0, point.z + 0.0};
  for (;;) {
    const StackLevel& level = stack.levels[stack.depth];
    if (contains_here(geometry.packed(level.volume).solid, kernels::to_local(level, p.x, p.y, p.z),
                      kernels::to_local_heading(level, direction.x, direction.y, direction.z),
                      geometry.tolerance())) {
      return true;
    }
    if (--stack.depth < 0) return false;
  }
}

void locate_from(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
                 const Vec3& direction) {
  if (stack.depth < 0) {
    locate(geometry, stack, point, direction);
  } else if (ascend(geometry, stack, point, direction)) {
    relocate(geometry, stack, {point.x + 0.0, point.y + 0.0, point.z + 0.0}, direction, -1);
  }
}

namespace {

/// The heading in a level's frame; `v` is the heading in the world.
Direction heading_in(const StackLevel& level, const Direction& v) {
  return level.rotation == nullptr ? v : kernels::to_local_heading(level, v.x, v.y, v.z);
}

/// `v` is the heading in the world. `confirmed`: as in relocate_in_own_frames().
void relocate_after(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
                    const Direction& v, int blocked, bool confirmed) {
  const double tolerance = geometry.tolerance();
  const StackLevel* level = &stack.levels[stack.depth];
  const PackedScene* scene = &geometry.packed(level->volume);
  // Most volumes that are entered have no daughters: then the place of the point does not matter.
  if (blocked < 0 && scene->count == 0) return;
  Vec3 p = kernels::to_local(*level, point.x, point.y, point.z);
  Direction heading = heading_in(*level, v);
  const auto move_to = [&](const StackLevel& next) {
    p = kernels::to_local(next, point.x, point.y, point.z);
    // Levels without a rotation of their own share that of their mother.
    if (next.rotation != level->rotation || next.rotation == next.own_rotation) {
      heading = heading_in(next, v);
    }
    level = &next;
  };
  const NeighbourLists::Of* around = nullptr;
  if (blocked >= 0) {
    // The track came out of a daughter: the mother may end at the same place.
    for (;;) {
      around = scene->lists == nullptr ? nullptr : scene->lists + blocked;
      if (around != nullptr && !is_there(*around, p)) around = nullptr;
      if (around != nullptr && around->mother_contains) break;
      if (contains_here(scene->solid, p, heading, tolerance)) break;
      blocked = static_cast<int>(level->daughter);
      if (--stack.depth < 0) return;
      move_to(stack.levels[stack.depth]);
      scene = &geometry.packed(level->volume);
    }
  }
  const bool directed = v.x != 0 || v.y != 0 || v.z != 0;
  for (;;) {
    const InOwnFrame in_own_frame{stack, *scene, point, v, tolerance};
    const unsigned found =
        !directed   ? find_daughter_undirected(*scene, p, tolerance)
        : confirmed ? find_daughter(*scene, p, heading, blocked, tolerance, around, in_own_frame)
                    : find_daughter(*scene, p, heading, blocked, tolerance, around,
                                    [](unsigned) { return true; });
    if (found == no_daughter) return;
    push(stack, scene->daughters[found], found);
    const StackLevel& entered = stack.levels[stack.depth];
    scene = &geometry.packed(entered.volume);
    if (scene->count == 0) return;
    move_to(entered);
    blocked = -1;
    around = nullptr;
  }
}

/// Makes a step along the stack's ray.
double step_along_ray(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
                      double limit) {
  const StackLevel& level = stack.levels[stack.depth];
  const PackedScene& scene = geometry.packed(level.volume);
  const Vec3 p = kernels::to_local(level, point.x, point.y, point.z);
  const double(&given)[3] = stack.ray.given;
  const Direction v = level.rotation == nullptr
                          ? stack.ray.direction
                          : kernels::to_local_direction(level, given[0], given[1], given[2]);
  const double out = distance_out_here(scene.solid, p, v, geometry.tolerance());
  const InOwnFrame in_own_frame{stack, scene, point, stack.ray.direction, geometry.tolerance()};
  // If the mother ends at once, no daughter is nearer: so a reflected photon goes back.
  const Hit hit =
      out == 0 ? Hit{out, no_daughter}
               : nearest_daughter(scene, p, v, out, limit, geometry.tolerance(), in_own_frame);
  if (hit.distance > limit) {
    stack.boundary = 0;
    return limit;
  }
  stack.boundary = 1;
  const Vec3 end{point.x + hit.distance * given[0], point.y + hit.distance * given[1],
                 point.z + hit.distance * given[2]};
  int left = -1;
  if (hit.daughter != no_daughter) {
    push(stack, scene.daughters[hit.daughter], hit.daughter);
  } else {
    left = static_cast<int>(level.daughter);
    stack.left.from = hit.distance > 0 ? stack.depth : -1;
    if (--stack.depth < 0) return hit.distance;
  }
  relocate_after(geometry, stack, end, stack.ray.direction, left, hit.distance == 0);
  return hit.distance;
}

Direction heading_of(const Vec3& direction) {
  return kernels::make_heading(direction.x, direction.y, direction.z);
}

}  // namespace

void relocate(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
              const Vec3& direction, int blocked) {
  relocate_after(geometry, stack, point, heading_of(direction), blocked, false);
}

void relocate_in_own_frames(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
                            const Vec3& direction, int blocked) {
  relocate_after(geometry, stack, point, heading_of(direction), blocked, true);
}

double step(const Geometry& geometry, NavigationStack& stack, const Vec3& point,
            const Vec3& direction, double limit) {
  kernels::set_ray(stack, direction.x, direction.y, direction.z);
  return step_along_ray(geometry, stack, point, limit);
}

double safety(const Geometry& geometry, const NavigationStack& stack, const Vec3& point,
              double enough) {
  const StackLevel& level = stack.levels[stack.depth];
  const PackedScene& scene = geometry.packed(level.volume);
  const Vec3 p = kernels::to_local(level, point.x, point.y, point.z);
  double safety = std::min(safety_to_out(scene.solid, p), enough + 2 * geometry.tolerance());
  // `bound` is the distance to the daughter's box. With it the answer is the same, whether or not
  // the search left the daughter out.
  const auto test = [&](unsigned k, double bound) {
    const PackedDaughter& d = scene.daughters[k];
    const double away = safety_to_in(d.solid, local(d, p));
    safety = std::min(safety, std::max(bound, away));
    return safety;
  };
  switch (scene.search) {
    case Search::none:
      break;
    case Search::all:
      for (unsigned k = 0; k < scene.count; ++k) test(k, 0.0);
      break;
    case Search::linear_boxes:
    case Search::bvh:
      scene.boxes->near(p, safety, test);
  }
  // Frames are composed and applied with rounding, and yet the bound must not exceed the truth.
  return std::min(enough, std::max(0.0, safety - geometry.tolerance()));
}

void restore(const Geometry& geometry, NavigationStack& stack, TouchableId touchable) {
  const World& world = geometry.world();
  stack.left.daughter = kernels::LeftForGood::none;
  stack.left.from = -1;
  // Keeps the levels whose range of touchables holds the one that is asked for.
  while (stack.depth >= 0) {
    const StackLevel& level = stack.levels[stack.depth];
    if (touchable >= level.touchable &&
        touchable < level.touchable + world.volumes[level.volume].touchables) {
      break;
    }
    --stack.depth;
  }
  if (stack.depth < 0) enter_world(stack, world.top);
  if (!geometry.touchables().empty()) {
    geometry.touchables().descend(stack, touchable);
    return;
  }
  while (stack.levels[stack.depth].touchable != touchable) {
    const StackLevel& level = stack.levels[stack.depth];
    const auto index =
        static_cast<unsigned>(geometry.daughter_holding(level.volume, touchable - level.touchable));
    push(stack, geometry.packed(level.volume).daughters[index], index);
  }
}

namespace {

double step_record(NavigationStack* stack, const kernels::Context* context, const void*, double x,
                   double y, double z, double limit) {
  return step_along_ray(*static_cast<const Geometry*>(context->geometry), *stack, {x, y, z}, limit);
}

void relocate_record(NavigationStack* stack, const kernels::Context* context, const void*, double x,
                     double y, double z, int blocked) {
  relocate_after(*static_cast<const Geometry*>(context->geometry), *stack, {x, y, z},
                 stack->ray.direction, blocked, false);
}

double safety_record(const NavigationStack* stack, const kernels::Context* context, const void*,
                     double x, double y, double z, double enough) {
  return safety(*static_cast<const Geometry*>(context->geometry), *stack, {x, y, z}, enough);
}

}  // namespace

const kernels::DispatchEntry dispatch_entry{step_record, relocate_record, safety_record};

}  // namespace navjit::generic

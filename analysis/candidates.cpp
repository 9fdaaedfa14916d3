#include "analysis/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/patterns/grid.hpp"
#include "analysis/patterns/layers.hpp"
#include "analysis/patterns/nest.hpp"
#include "analysis/patterns/pattern.hpp"
#include "analysis/patterns/rings.hpp"
#include "analysis/patterns/slabs.hpp"
#include "analysis/patterns/wires.hpp"
#include "geometry/model/placed_extent.hpp"
#include "geometry/solids/extent.hpp"
#include "navjit/vector.hpp"

namespace navjit {
namespace {

/// Up to this many daughters every one is spelled out and tested.
constexpr std::size_t spell_out_limit = 4;

/// At most this many boxes are all tested, four at once.
constexpr std::size_t most_lanes = 8;

/// With 20,000 daughters `boxes` is 1.5 times as fast as the hierarchy of boxes (docs/scenes.md).
/// Nothing was measured with more than this.
constexpr std::size_t most_boxes = 32768;

/// Scenes with more daughters than this, four million, are not divided by planes: sorting so many
/// boxes takes seconds.
constexpr std::size_t most_in_planes = std::size_t{1} << 22;

/// With more daughters than this no rings are searched, since nothing was measured.
constexpr std::size_t most_about_an_axis = 4096;

/// Up to this many daughters all boxes are tested for the safety. With 65 to 70 daughters this
/// takes as long as the generic navigator's tree (docs/scenes.md). The limit itself is a guess.
constexpr std::size_t most_boxes_near = 128;

/// Boxes in scenes that are not larger than this, mm, can be distinguished in single precision.
constexpr double largest_float_scene = 1e7;

/// A nest is searched by its shells if it has at least one shell for this many other daughters.
/// With three others for four shells that was no faster than boxes, with none two to five times as
/// fast (docs/scenes.md).
constexpr std::size_t most_others = 3;

/// A ray walks through each ring separately. Two rings were measured to pay and 26 not. The limit
/// in between is a guess, and so is the number of other daughters.
constexpr std::size_t most_rings = 4;
constexpr std::size_t most_beside_rings = 4;

/// Grids have at most this many daughters in a cell on average, all of one solid. Then no box needs
/// a test.
constexpr double about_one = 1.05;

/// Slabs that take less than this share of the mother's cross-section are missed by most rays,
/// which then walk past one slab after the other. In this case boxes are tested first. A guess:
/// runs in halls of trackers were 1.2 to 1.8 times as fast with scans, those in stacks of full
/// plates 0.9 times.
constexpr double least_met = 0.5;

/// Twice the rounding error of a position in single precision.
double float_margin(double largest) { return largest * 0x1p-21; }

/// The mean cross-section of the boxes across an axis, as a share of the mother's.
double mean_cross_section(const Extent& mother, const std::vector<Extent>& boxes, int axis) {
  const auto across = [&](const Extent& e) {
    const Vec3 size = e.max - e.min;
    return axis == 0 ? size.y * size.z : axis == 1 ? size.x * size.z : size.x * size.y;
  };
  double sum = 0;
  for (const Extent& box : boxes) sum += across(box);
  return sum / (across(mother) * static_cast<double>(boxes.size()));
}

/// The part of is_regular_grid() that is known before the cells are made.
bool may_be_grid(const ScenePlan& plan) {
  return plan.classes.size() == 1 && !plan.classes[0].rotated;
}

/// Whether there are several daughters, and all are boxes along the axes.
bool may_use_lanes(const Geometry& geometry, const ScenePlan& plan) {
  const auto daughters = geometry.scene(plan.volume).daughters;
  if (!plan.oblique_only || plan.classes.size() != 1 || plan.classes[0].rotated ||
      plan.classes[0].kind() != SolidKind::box || daughters.size() < 2 ||
      daughters.size() > most_lanes) {
    return false;
  }
  return std::all_of(daughters.begin(), daughters.end(), [&](const Daughter& d) {
    const auto& box = *static_cast<const kernels::Box<double>*>(d.solid.shape);
    return std::min({box.hx, box.hy, box.hz}) > geometry.tolerance();
  });
}

/// Many rings are no faster than boxes (26: 0.56 times).
bool sectors_may_pay(const Rings& rings) {
  return rings.rings.size() <= most_rings && rings.others.size() <= most_beside_rings;
}

/// Whether sectors are chosen without measurement, which is the case if daughters are segments
/// about the axis. Each of these fills its sector, and boxes tell little; sectors are 1.2 and 1.4
/// times as fast as boxes. With daughters that are only placed in a ring (boxes, trapezoids) they
/// are 0.8 to 1.1 times as fast for 12 to 64 daughters, and much faster for 1200 thin blades, whose
/// boxes overlap. Such scenes are measured with both (runtime/bind_to_data.cpp).
bool sectors_pay(const Rings& rings) {
  return sectors_may_pay(rings) && std::all_of(rings.rings.begin(), rings.rings.end(),
                                               [](const Ring& ring) { return ring.segments; });
}

bool is_regular(Arrangement arrangement) {
  return arrangement == Arrangement::slabs || arrangement == Arrangement::grid;
}

/// Whether slabs or a grid are at least as good for wires as rows. For boxes along the axes slabs
/// have a shorter walk, and steps among wires in one plane are as fast with slabs as with rows. But
/// rows have a faster safety if there are too many wires to test all. Grids lead to the cell at
/// once.
bool slabs_or_grid_serve(const Geometry& geometry, const ScenePlan& plan, Arrangement arrangement) {
  const bool plain = may_be_grid(plan), boxes = plan.classes[0].kind() == SolidKind::box;
  if (arrangement == Arrangement::grid) return plain;
  return arrangement == Arrangement::slabs &&
         ((plain && boxes) || geometry.scene(plan.volume).daughters.size() <= most_boxes_near);
}

/// Chooses a pattern about an axis or a centre: a nest, or rings. Returns false if there is none.
bool choose_round(const Geometry& geometry, std::optional<Candidates> forced, double margin,
                  ScenePlan& plan) {
  const World& world = geometry.world();
  const Scene& scene = geometry.scene(plan.volume);
  if (!forced || forced == Candidates::nest) {
    auto nest = find_nest(world, world.volumes[plan.volume].solid, scene.daughters, margin);
    if (nest && (forced || most_others * nest->others.size() <= nest->members.size())) {
      plan.candidates = Candidates::nest;
      plan.nest = std::move(*nest);
      return true;
    }
  }
  if (!forced || forced == Candidates::rings) {
    auto rings = find_rings(world, world.volumes[plan.volume].solid, scene.daughters, margin);
    const bool chosen = rings && (forced || sectors_pay(*rings));
    if (chosen) plan.candidates = Candidates::rings;
    if (chosen || (rings && sectors_may_pay(*rings))) plan.rings = std::move(*rings);
    if (chosen) return true;
  }
  return false;
}

}  // namespace

bool is_regular_grid(const ScenePlan& plan) {
  return may_be_grid(plan) && plan.mean_candidates <= about_one;
}

void choose_candidates(const Geometry& geometry, std::optional<Candidates> forced,
                       ScenePlan& plan) {
  const World& world = geometry.world();
  const Scene& scene = geometry.scene(plan.volume);
  const Extent& extent = world.volumes[plan.volume].solid.extent;
  std::vector<PlacedBox> placed;
  std::vector<Extent> boxes;
  for (const Daughter& d : scene.daughters) {
    placed.push_back(placed_box(world.volumes[d.volume].solid, d.transformation));
    boxes.push_back(placed.back().bounds);
  }
  const Pattern pattern = pattern_of(boxes);
  const Arrangement arrangement = pattern.arrangement;
  plan.pattern = pattern.words;
  if (boxes.empty()) {
    plan.candidates = Candidates::none;
    return;
  }
  if (forced == Candidates::tree) {
    plan.candidates = scene.boxes ? Candidates::tree : Candidates::all;
    plan.mean_candidates = static_cast<double>(boxes.size());
    return;
  }
  const double margin = search_margin(extent, geometry.tolerance());
  double largest = largest_coordinate(extent);
  for (const Extent& box : boxes) largest = std::max(largest, largest_coordinate(box));
  // Daughters may stick out of their mother.
  const double round_margin = 2 * geometry.tolerance() + 1e-9 * largest;
  const bool in_floats = largest <= largest_float_scene;
  const bool boxes_possible = boxes.size() <= most_boxes && in_floats;
  const auto make_boxes = [&] {
    if (!plan.boxes.empty()) return;
    const double inflate = margin + float_margin(largest);
    for (const Extent& box : boxes) plan.boxes.push_back(inflated(box, inflate));
  };
  const bool scan = boxes_possible && may_be_scanned(boxes.size());
  const bool groups = boxes_possible && may_be_grouped(boxes.size());
  const auto use_scan = [&] {
    plan.candidates = Candidates::scan;
    plan.mean_candidates = static_cast<double>(boxes.size());
  };
  // Scenes that are bound to data may use a scan, whatever is chosen here.
  if (scan || groups) make_boxes();
  if (scan && forced == Candidates::scan) {
    use_scan();
    return;
  }
  if (groups && forced == Candidates::groups) {
    plan.candidates = Candidates::groups;
    plan.mean_candidates = static_cast<double>(boxes.size());
    return;
  }
  const auto make_wires = [&] {
    if (forced ? *forced != Candidates::wires : slabs_or_grid_serve(geometry, plan, arrangement))
      return false;
    auto wires = find_wires(world, world.volumes[plan.volume].solid, scene.daughters, round_margin);
    if (!wires || (wires->others.size() > 2 && largest > largest_float_scene)) return false;
    plan.candidates = Candidates::wires;
    if (!is_regular(arrangement)) plan.pattern = describe_wires(*wires);
    plan.wires = std::move(*wires);
    if (plan.wires.others.size() > 2) make_boxes();
    plan.mean_candidates = 1;
    return true;
  };
  const auto make_layers = [&] {
    if (!in_floats || boxes.size() > most_in_planes) return false;
    auto layers = find_layers(boxes, geometry.tolerance(), margin);
    if (layers) plan.layers = std::move(*layers);
    return plan.layers.found();
  };
  // If there are too many daughters to test all for the safety, layers may give it.
  const auto make_layers_for_safety = [&] {
    if (!forced && boxes.size() > most_boxes_near) make_layers();
  };
  if (make_wires()) {
    if (!plan.wires.safety_known) make_layers_for_safety();
    return;
  }
  if (boxes.size() <= most_about_an_axis && !is_regular(arrangement)) {
    std::string round = describe_round_pattern(world, world.volumes[plan.volume].solid,
                                               scene.daughters, round_margin);
    if (!round.empty()) plan.pattern = std::move(round);
  }
  const auto make_round = [&] {
    if (boxes.size() > most_about_an_axis || !boxes_possible ||
        !choose_round(geometry, forced, round_margin, plan))
      return false;
    make_boxes();
    plan.mean_candidates = 1;
    return true;
  };
  const bool lanes = (!forced || *forced == Candidates::lanes) && may_use_lanes(geometry, plan);
  const auto use_lanes = [&] {
    plan.candidates = Candidates::lanes;
    plan.mean_candidates = static_cast<double>(boxes.size());
  };
  const bool few = boxes.size() <= spell_out_limit;
  if (lanes && (forced || few)) {
    use_lanes();
    return;
  }
  if (few && forced && make_round()) return;
  if (forced ? *forced == Candidates::all : few) {
    plan.candidates = Candidates::all;
    plan.mean_candidates = static_cast<double>(boxes.size());
    return;
  }
  if (!forced || *forced == Candidates::slabs) {
    if (auto slabs = find_slabs(extent, boxes, geometry.tolerance(), margin)) {
      plan.slabs = std::move(*slabs);
      if (plan.classes.size() == 1 && plan.classes[0].kind() == SolidKind::box &&
          !plan.classes[0].rotated) {
        plan.slabs.skin = margin + geometry.tolerance() / 2;
      }
      if (scan && !forced && mean_cross_section(extent, boxes, plan.slabs.axis) < least_met) {
        use_scan();
        return;
      }
      make_layers_for_safety();
      plan.candidates = Candidates::slabs;
      plan.mean_candidates = 1;
      return;
    }
  }
  if (!few && make_round()) return;
  if (lanes) {
    use_lanes();
    return;
  }
  // Layers are walked only by navigators that are bound to data; code gets another search besides.
  if ((!forced || *forced == Candidates::layers) && make_layers() &&
      (forced || boxes.size() > most_boxes)) {
    plan.candidates = Candidates::layers;
    plan.mean_candidates = plan.layers.mean_group;
    return;
  }
  if (!forced && boxes.size() > most_boxes && scene.boxes) {
    plan.candidates = Candidates::tree;
    plan.mean_candidates = static_cast<double>(boxes.size());
    return;
  }
  // A daughter is not listed in cells that lie in a hole of the daughter, or in a part of its box
  // that it does not fill.
  const auto apart = [&](std::uint32_t k, const Extent& box) {
    const Daughter& d = scene.daughters[k];
    return safety_to_in(d.solid, to_local(d.transformation, 0.5 * (box.min + box.max))) >
           norm(0.5 * (box.max - box.min)) + 2 * margin;
  };
  const auto make = [&](Candidates candidates, CellUse use) {
    plan.candidates = candidates;
    plan.grid = make_grid(extent, placed, margin, use, apart);
    plan.mean_candidates = mean_candidates(plan.grid);
  };
  if (!boxes_possible || (forced ? *forced == Candidates::grid : may_be_grid(plan))) {
    make(Candidates::grid, CellUse::daughters);
    if (!boxes_possible || forced || is_regular_grid(plan)) return;
  }
  if (scan && !forced) {
    use_scan();
    return;
  }
  make(Candidates::boxes, CellUse::blocks);
  make_boxes();
}

void choose_safety(const Geometry& geometry, ScenePlan& plan) {
  const Scene& scene = geometry.scene(plan.volume);
  switch (scene.search) {
    case Search::none:
    case Search::all:
      if (plan.candidates == Candidates::wires) return;
      plan.safety = SafetyFrom::all;
      return;
    case Search::linear_boxes:
    case Search::bvh:
      if (plan.candidates == Candidates::wires) {
        if (!plan.wires.safety_known) return;
        plan.safety = SafetyFrom::wires;
        return;
      }
      if (scene.daughters.size() > most_boxes_near) return;
      plan.safety = SafetyFrom::boxes;
      for (const Daughter& d : scene.daughters) {
        const Extent box =
            placed_extent(geometry.world().volumes[d.volume].solid, d.transformation);
        plan.tree_boxes.push_back(inflated(box, box_margin(geometry.tolerance())));
      }
  }
}

}  // namespace navjit

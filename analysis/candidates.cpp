#include "analysis/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

/// A scene whose search is being chosen, and what several of the steps below need.
struct Choice {
  const Geometry& geometry;
  std::optional<Candidates> forced;
  ScenePlan& plan;
  const Scene& scene;
  const Solid& mother;
  std::vector<PlacedBox> placed{};
  std::vector<Extent> boxes{};  ///< of `placed`
  Arrangement arrangement = Arrangement::leaf;
  double largest = 0;       ///< coordinate of the mother and of all boxes, mm
  double margin = 0;        ///< of cells and boxes, mm
  double round_margin = 0;  ///< of radii, mm: daughters may stick out of their mother
  bool in_floats = false;   ///< single precision distinguishes the boxes
  bool boxes_possible = false, scan_possible = false, groups_possible = false;

  const World& world() const { return geometry.world(); }
  /// Whether this search is asked for, or none is.
  bool may_be(Candidates search) const { return !forced || *forced == search; }
  bool few() const { return boxes.size() <= spell_out_limit; }

  bool choose(Candidates search, double mean_candidates) const {
    plan.candidates = search;
    plan.mean_candidates = mean_candidates;
    return true;
  }
  /// The same for a search that looks at all daughters or their boxes.
  bool choose_of_all(Candidates search) const {
    return choose(search, static_cast<double>(boxes.size()));
  }
};

Choice prepare(const Geometry& geometry, std::optional<Candidates> forced, ScenePlan& plan) {
  const World& world = geometry.world();
  Choice c{geometry, forced, plan, geometry.scene(plan.volume), world.volumes[plan.volume].solid};
  c.largest = largest_coordinate(c.mother.extent);
  for (const Daughter& d : c.scene.daughters) {
    c.placed.push_back(placed_box(world.volumes[d.volume].solid, d.transformation));
    c.boxes.push_back(c.placed.back().bounds);
    c.largest = std::max(c.largest, largest_coordinate(c.boxes.back()));
  }
  Pattern pattern = pattern_of(c.boxes);
  c.arrangement = pattern.arrangement;
  plan.pattern = std::move(pattern.words);
  c.margin = search_margin(c.mother.extent, geometry.tolerance());
  c.round_margin = 2 * geometry.tolerance() + 1e-9 * c.largest;
  c.in_floats = c.largest <= largest_float_scene;
  c.boxes_possible = c.boxes.size() <= most_boxes && c.in_floats;
  c.scan_possible = c.boxes_possible && may_be_scanned(c.boxes.size());
  c.groups_possible = c.boxes_possible && may_be_grouped(c.boxes.size());
  return c;
}

void make_boxes(const Choice& c) {
  if (!c.plan.boxes.empty()) return;
  const double inflate = c.margin + float_margin(c.largest);
  for (const Extent& box : c.boxes) c.plan.boxes.push_back(inflated(box, inflate));
}

bool make_layers(const Choice& c) {
  if (!c.in_floats || c.boxes.size() > most_in_planes) return false;
  auto layers = find_layers(c.boxes, c.geometry.tolerance(), c.margin);
  if (layers) c.plan.layers = std::move(*layers);
  return c.plan.layers.found();
}

/// If there are too many daughters to test all for the safety, layers may give it.
void make_layers_for_safety(const Choice& c) {
  if (!c.forced && c.boxes.size() > most_boxes_near) make_layers(c);
}

void make_cells(const Choice& c, Candidates search, CellUse use) {
  // A daughter is not listed in cells that lie in a hole of the daughter, or in a part of its box
  // that it does not fill.
  const auto apart = [&](std::uint32_t k, const Extent& box) {
    const Daughter& d = c.scene.daughters[k];
    return safety_to_in(d.solid, to_local(d.transformation, 0.5 * (box.min + box.max))) >
           norm(0.5 * (box.max - box.min)) + 2 * c.margin;
  };
  c.plan.grid = make_grid(c.mother.extent, c.placed, c.margin, use, apart);
  c.choose(search, mean_candidates(c.plan.grid));
}

/// Whether slabs or a grid are at least as good for wires as rows. For boxes along the axes slabs
/// have a shorter walk, and steps among wires in one plane are as fast with slabs as with rows. But
/// rows have a faster safety if there are too many wires to test all. Grids lead to the cell at
/// once.
bool slabs_or_grid_serve(const Choice& c) {
  const bool plain = may_be_grid(c.plan), boxes = c.plan.classes[0].kind() == SolidKind::box;
  if (c.arrangement == Arrangement::grid) return plain;
  return c.arrangement == Arrangement::slabs &&
         ((plain && boxes) || c.boxes.size() <= most_boxes_near);
}

// The steps of the choice. Each returns whether it has chosen; if not, the next one is asked.

bool try_none(const Choice& c) { return c.boxes.empty() && c.choose(Candidates::none, 0); }

bool try_tree_if_forced(const Choice& c) {
  return c.forced == Candidates::tree &&
         c.choose_of_all(c.scene.boxes ? Candidates::tree : Candidates::all);
}

bool try_boxes_of_all_if_forced(const Choice& c) {
  // Scenes that are bound to data may use a scan, whatever is chosen here.
  if (c.scan_possible || c.groups_possible) make_boxes(c);
  if (c.scan_possible && c.forced == Candidates::scan) return c.choose_of_all(Candidates::scan);
  return c.groups_possible && c.forced == Candidates::groups && c.choose_of_all(Candidates::groups);
}

bool try_wires(const Choice& c) {
  if (c.forced ? *c.forced != Candidates::wires : slabs_or_grid_serve(c)) return false;
  auto wires = find_wires(c.world(), c.mother, c.scene.daughters, c.round_margin);
  if (!wires || (wires->others.size() > 2 && !c.in_floats)) return false;
  if (!is_regular(c.arrangement)) c.plan.pattern = describe_wires(*wires);
  c.plan.wires = std::move(*wires);
  if (c.plan.wires.others.size() > 2) make_boxes(c);
  if (!c.plan.wires.safety_known) make_layers_for_safety(c);
  return c.choose(Candidates::wires, 1);
}

/// Chooses nothing: only what people call the pattern depends on it.
bool name_round_pattern(const Choice& c) {
  if (c.boxes.size() > most_about_an_axis || is_regular(c.arrangement)) return false;
  std::string round =
      describe_round_pattern(c.world(), c.mother, c.scene.daughters, c.round_margin);
  if (!round.empty()) c.plan.pattern = std::move(round);
  return false;
}

/// A pattern about an axis or a centre: a nest, or rings.
bool try_round(const Choice& c) {
  if (c.boxes.size() > most_about_an_axis || !c.boxes_possible) return false;
  if (c.may_be(Candidates::nest)) {
    auto nest = find_nest(c.world(), c.mother, c.scene.daughters, c.round_margin);
    if (nest && (c.forced || most_others * nest->others.size() <= nest->members.size())) {
      c.plan.nest = std::move(*nest);
      make_boxes(c);
      return c.choose(Candidates::nest, 1);
    }
  }
  if (!c.may_be(Candidates::rings)) return false;
  auto rings = find_rings(c.world(), c.mother, c.scene.daughters, c.round_margin);
  if (!rings) return false;
  const bool chosen = c.forced || sectors_pay(*rings);
  if (chosen || sectors_may_pay(*rings)) c.plan.rings = std::move(*rings);
  if (!chosen) return false;
  make_boxes(c);
  return c.choose(Candidates::rings, 1);
}

bool try_lanes(const Choice& c) {
  return c.may_be(Candidates::lanes) && may_use_lanes(c.geometry, c.plan) &&
         c.choose_of_all(Candidates::lanes);
}

bool try_lanes_if_forced_or_few(const Choice& c) { return (c.forced || c.few()) && try_lanes(c); }

bool try_round_if_forced_and_few(const Choice& c) { return c.forced && c.few() && try_round(c); }

bool try_all(const Choice& c) {
  return (c.forced ? *c.forced == Candidates::all : c.few()) && c.choose_of_all(Candidates::all);
}

/// Slabs, or a scan if rays miss most of them.
bool try_slabs(const Choice& c) {
  if (!c.may_be(Candidates::slabs)) return false;
  auto slabs = find_slabs(c.mother.extent, c.boxes, c.geometry.tolerance(), c.margin);
  if (!slabs) return false;
  c.plan.slabs = std::move(*slabs);
  if (may_be_grid(c.plan) && c.plan.classes[0].kind() == SolidKind::box) {
    c.plan.slabs.skin = c.margin + c.geometry.tolerance() / 2;
  }
  if (c.scan_possible && !c.forced &&
      mean_cross_section(c.mother.extent, c.boxes, c.plan.slabs.axis) < least_met) {
    return c.choose_of_all(Candidates::scan);
  }
  make_layers_for_safety(c);
  return c.choose(Candidates::slabs, 1);
}

bool try_round_of_many(const Choice& c) { return !c.few() && try_round(c); }

/// Layers are walked only by navigators that are bound to data; code gets another search besides.
bool try_layers(const Choice& c) {
  return c.may_be(Candidates::layers) && make_layers(c) &&
         (c.forced || c.boxes.size() > most_boxes) &&
         c.choose(Candidates::layers, c.plan.layers.mean_group);
}

bool try_tree_if_too_many(const Choice& c) {
  return !c.forced && c.boxes.size() > most_boxes && c.scene.boxes &&
         c.choose_of_all(Candidates::tree);
}

bool try_grid(const Choice& c) {
  if (c.boxes_possible && !(c.forced ? *c.forced == Candidates::grid : may_be_grid(c.plan))) {
    return false;
  }
  make_cells(c, Candidates::grid, CellUse::daughters);
  return !c.boxes_possible || c.forced || is_regular_grid(c.plan);
}

bool try_scan(const Choice& c) {
  return c.scan_possible && !c.forced && c.choose_of_all(Candidates::scan);
}

bool try_boxes(const Choice& c) {
  make_cells(c, Candidates::boxes, CellUse::blocks);
  make_boxes(c);
  return true;
}

/// The policy: the first that can be used and is expected to pay.
constexpr bool (*in_order[])(const Choice&) = {try_none,
                                               try_tree_if_forced,
                                               try_boxes_of_all_if_forced,
                                               try_wires,
                                               name_round_pattern,
                                               try_lanes_if_forced_or_few,
                                               try_round_if_forced_and_few,
                                               try_all,
                                               try_slabs,
                                               try_round_of_many,
                                               try_lanes,
                                               try_layers,
                                               try_tree_if_too_many,
                                               try_grid,
                                               try_scan,
                                               try_boxes};

}  // namespace

bool is_regular_grid(const ScenePlan& plan) {
  return may_be_grid(plan) && plan.mean_candidates <= about_one;
}

void choose_candidates(const Geometry& geometry, std::optional<Candidates> forced,
                       ScenePlan& plan) {
  const Choice choice = prepare(geometry, forced, plan);
  for (const auto choose : in_order) {
    if (choose(choice)) return;
  }
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

#include "analysis/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/buckets.hpp"
#include "analysis/pattern.hpp"
#include "analysis/plates.hpp"
#include "geometry/model/vector.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit {
namespace {

/// Up to this many daughters every one is spelled out and tested.
constexpr std::size_t spell_out_limit = 4;

/// With more daughters than this, tables of boxes would be most of the code.
constexpr std::size_t most_boxes = 4096;

/// All boxes are looked at for safety: beyond this the generic navigator's tree is faster.
constexpr std::size_t most_boxes_near = 128;

/// Single precision tells boxes apart in scenes that are not larger than this, mm.
constexpr double largest_float_scene = 1e7;

/// So little more than one daughter a bucket, and of one solid, is what grids have: there no box
/// needs a test.
constexpr double about_one = 1.05;

/// What single precision loses of a position, twice over.
double float_margin(double largest) { return largest * 0x1p-21; }

}  // namespace

bool is_grid(const ScenePlan& plan) {
  return plan.mean_candidates <= about_one && plan.classes.size() == 1 && !plan.classes[0].rotated;
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
  plan.pattern = describe_pattern(boxes);
  if (boxes.empty()) {
    plan.candidates = Candidates::none;
    return;
  }
  if (forced ? *forced == Candidates::all : boxes.size() <= spell_out_limit) {
    plan.candidates = Candidates::all;
    plan.mean_candidates = static_cast<double>(boxes.size());
    return;
  }
  const double margin = search_margin(extent, geometry.tolerance());
  if (!forced || *forced == Candidates::plates) {
    if (auto plates = find_plates(extent, boxes, geometry.tolerance(), margin)) {
      plan.candidates = Candidates::plates;
      plan.plates = std::move(*plates);
      if (plan.classes.size() == 1 && plan.classes[0].kind() == SolidKind::box &&
          !plan.classes[0].rotated) {
        plan.plates.skin = margin + geometry.tolerance() / 2;
      }
      plan.mean_candidates = 1;
      return;
    }
  }
  // What is in a hole of a daughter, or beside what her box holds of her, is not hers.
  const auto apart = [&](std::uint32_t k, const Extent& box) {
    const Daughter& d = scene.daughters[k];
    return safety_to_in(d.solid, to_local(d.transformation, 0.5 * (box.min + box.max))) >
           norm(0.5 * (box.max - box.min)) + 2 * margin;
  };
  plan.candidates = Candidates::buckets;
  plan.buckets = make_buckets(extent, placed, margin, BucketUse::daughters, apart);
  plan.mean_candidates = mean_candidates(plan.buckets);
  double largest = largest_coordinate(extent);
  for (const Extent& box : boxes) largest = std::max(largest, largest_coordinate(box));
  const bool possible = boxes.size() <= most_boxes && largest <= largest_float_scene;
  if (!possible || (forced ? *forced != Candidates::boxes : is_grid(plan))) return;
  plan.candidates = Candidates::boxes;
  plan.buckets = make_buckets(extent, placed, margin, BucketUse::blocks, apart);
  plan.mean_candidates = mean_candidates(plan.buckets);
  const double inflate = margin + float_margin(largest);
  for (const Extent& box : boxes) plan.boxes.push_back(inflated(box, inflate));
}

void choose_safety(const Geometry& geometry, ScenePlan& plan) {
  const Scene& scene = geometry.scene(plan.volume);
  switch (scene.search) {
    case Search::none:
    case Search::all:
      plan.safety = SafetyFrom::all;
      return;
    case Search::linear_boxes:
    case Search::bvh:
      if (scene.daughters.size() > most_boxes_near) return;
      plan.safety = SafetyFrom::boxes;
      for (const Daughter& d : scene.daughters) {
        const Extent box =
            placed_extent(geometry.world().volumes[d.volume].solid, d.transformation);
        plan.tree_boxes.push_back(inflated(box, geometry.tolerance()));
      }
  }
}

}  // namespace navjit

// The parts of a scene that is bound to data, made from its plan.
#pragma once

#include <functional>

#include "analysis/scene_plan.hpp"
#include "codegen/data/arena.hpp"
#include "codegen/data/code_of_solids.hpp"
#include "codegen/data/quick_solid.hpp"
#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/navigation/geometry.hpp"
#include "geometry/navigation/scene.hpp"

namespace navjit::codegen {

using Index = unsigned;
using AnyDaughters = kernels::SolidDaughters<kernels::QuickSolid>;
template <int n>
using Lanes = kernels::SearchLanes<kernels::FoursAt<n>>;
using TubeDaughters = kernels::SolidDaughters<kernels::KnownSolid<kernels::Tube<double>>>;

/// Finds the daughters whose boxes the ray meets, by the hierarchy of the generic navigator.
struct SearchTree {
  const bvh::BoxTree* tree;

  template <class Daughters>
  [[gnu::always_inline]] int find(const Daughters& d, const Vec3& p, const Direction& v,
                                  int blocked, double tol) const {
    kernels::LastThatHolds<Daughters> last{d, p, v, blocked, tol};
    tree->containing(p, [&](unsigned k) {
      last(k);
      return true;
    });
    return last.found;
  }
  template <class Daughters>
  [[gnu::always_inline]] int nearest(const Daughters& d, const Vec3& p, const Direction& v,
                                     double& best, double limit, unsigned, double tol) const {
    kernels::NearestAhead<Daughters> nearest{d, p, v, best, limit, tol};
    tree->along_ray(p, v, std::min(limit, best), [&](unsigned k, double) {
      nearest(k);
      return std::min(limit, best);
    });
    return nearest.hit;
  }
};

/// The input from which parts are made.
struct Source {
  const Geometry& geometry;
  const ScenePlan& plan;
  const Scene& scene;
  Arena& arena;
  const CodeOfSolids* code = nullptr;  ///< null: no solid has code
  /// By volume, the stand-in that tables have in its place. If null, each volume stands for itself.
  const std::vector<VolumeId>* stand_ins = nullptr;
};

// Each overload fills in one part.
void make(const Source& source, kernels::UnrotatedFrame& frame);
void make(const Source& source, kernels::TurnedFrame& frame);
void make(const Source& source, kernels::AnyFrame& frame);
void make(const Source& source, kernels::Box<double>& mother);
void make(const Source& source, kernels::Tube<double>& mother);
void make(const Source& source, kernels::QuickSolid& mother);
void make(const Source& source, kernels::NoDaughters& daughters);
void make(const Source& source, kernels::BoxDaughters& daughters);
void make(const Source& source, AnyDaughters& daughters);
void make(const Source& source, TubeDaughters& daughters);
void make(const Source& source, kernels::NoSearch& search);
void make(const Source& source, kernels::SearchAll& search);
void make(const Source& source, Lanes<1>& search);
void make(const Source& source, Lanes<2>& search);
void make(const Source& source, kernels::SearchSlabs<Index>& search);
void make(const Source& source, kernels::SearchGrid<Index>& search);
void make(const Source& source, kernels::SearchBoxes<Index>& search);
void make(const Source& source, kernels::SearchScan& search);
void make(const Source& source, kernels::SearchGroups& search);
void make(const Source& source, SearchTree& search);
void make(const Source& source, kernels::SearchLayers<Index>& search);
void make(const Source& source, kernels::SearchNest<Index>& search);
void make(const Source& source, kernels::SearchRings<Index>& search);
void make(const Source& source, kernels::SearchWires<Index>& search);

/// A block of eight boxes. Lanes for which `box` returns null are empty.
kernels::BoxBlock block_of(const std::function<const Extent*(std::size_t lane)>& box);
/// Boxes along the axes, in lanes of four. Lanes without a box are empty.
void fill_fours(std::span<const Daughter> daughters, std::span<kernels::FourBoxes> fours);
/// The boxes of all daughters, by daughter, as in the generic navigator.
const kernels::FloatBox* make_float_boxes(const Source& source);
/// The boxes of all daughters, for safeties.
kernels::NearBoxes make_near_boxes(std::span<const Extent> boxes, Arena& arena);

/// The box of a daughter's solid, in its own frame, with a margin.
Extent box_with_margin(const Geometry& geometry, const Daughter& daughter);

/// Whether neighbour lists are read when a track leaves a daughter. Lists that are in no cache are
/// slower than searches by arithmetic, whose tables are small, since slabs store equal rows once.
bool reads_neighbour_lists(const Source& source);

/// Makes what scenes of all kinds have: neighbour lists, which belong to the generic navigator, and
/// boxes.
template <class Scene>
void make_shared_tables(const Source& source, Scene& scene) {
  if (reads_neighbour_lists(source)) {
    const NeighbourLists& lists = source.scene.neighbour_lists;
    scene.lists = lists.of.data();
    scene.neighbours = lists.neighbours.data();
    scene.beside = lists.blocks.data();
  }
  if (source.plan.safety == SafetyFrom::boxes) {
    scene.boxes = make_near_boxes(source.plan.tree_boxes, source.arena);
  }
}

}  // namespace navjit::codegen

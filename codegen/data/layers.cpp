// Slabs within slabs, made from a plan.
#include <algorithm>
#include <map>

#include "codegen/data/parts.hpp"
#include "geometry/model/placed_extent.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit::codegen {
namespace {

/// Boxes around daughters, inflated by the margin and by twice the rounding error of a position in
/// single precision.
std::vector<Extent> boxes_in_single_precision(const Source& source) {
  const World& world = source.geometry.world();
  const Extent& extent = world.volumes[source.plan.volume].solid.extent;
  std::vector<Extent> boxes;
  double largest = largest_coordinate(extent);
  for (const Daughter& d : source.scene.daughters) {
    boxes.push_back(placed_extent(world.volumes[d.volume].solid, d.transformation));
    largest = std::max(largest, largest_coordinate(boxes.back()));
  }
  const double margin = search_margin(extent, source.geometry.tolerance()) + largest * 0x1p-21;
  for (Extent& box : boxes) box = inflated(box, margin);
  return boxes;
}

/// Tables that several rows have in common are stored once.
struct Shared {
  Arena& arena;
  std::map<std::vector<double>, const double*> numbers{};
  std::map<std::vector<std::uint32_t>, const Index*> indices{};

  const double* copy(const std::vector<double>& from) {
    const double*& known = numbers[from];
    if (known == nullptr) known = arena.copy(from);
    return known;
  }
  const Index* copy(const std::vector<std::uint32_t>& from) {
    const Index*& known = indices[from];
    if (known == nullptr) known = arena.copy(from);
    return known;
  }
};

void make_groups(const Source& source, kernels::LayerTree<Index>& tree) {
  const auto& from = source.plan.layers.groups;
  if (from.empty()) return;
  const std::vector<Extent> boxes = boxes_in_single_precision(source);
  auto* groups = source.arena.array<kernels::LayerGroup>(from.size());
  unsigned blocks = 0;
  for (std::size_t g = 0; g < from.size(); ++g) {
    groups[g].first = blocks;
    blocks += static_cast<unsigned>((from[g].size() + kernels::box_lanes - 1) / kernels::box_lanes);
    groups[g].last = blocks;
  }
  auto* made = source.arena.array<kernels::BoxBlock>(blocks);
  auto* daughters = source.arena.array<Index[kernels::box_lanes]>(blocks);
  for (std::size_t g = 0; g < from.size(); ++g) {
    for (unsigned b = groups[g].first; b < groups[g].last; ++b) {
      const std::size_t first = std::size_t{b - groups[g].first} * kernels::box_lanes;
      made[b] = block_of([&](std::size_t lane) {
        return first + lane < from[g].size() ? &boxes[from[g][first + lane]] : nullptr;
      });
      for (std::size_t l = 0; l < kernels::box_lanes && first + l < from[g].size(); ++l) {
        daughters[b][l] = from[g][first + l];
      }
    }
  }
  tree.groups = groups;
  tree.blocks = made;
  tree.in_block = daughters;
}

}  // namespace

void make(const Source& source, kernels::SearchLayers<Index>& search) {
  const Layers& layers = source.plan.layers;
  Shared shared{source.arena};
  auto* rows = source.arena.array<kernels::LayerRow<Index>>(layers.divisions.size());
  for (std::size_t i = 0; i < layers.divisions.size(); ++i) {
    const Slabs& s = layers.divisions[i].slabs;
    std::vector<std::uint32_t> parts;
    for (const Layers::Part& part : layers.divisions[i].parts) {
      parts.push_back(part.number | (part.kind == Layers::Kind::slabs   ? kernels::in_slab::slabs
                                     : part.kind == Layers::Kind::group ? kernels::in_slab::group
                                                                        : 0U));
    }
    rows[i].slabs = {static_cast<int>(parts.size()),
                     shared.copy(s.low),
                     shared.copy(s.high),
                     source.arena.copy(parts),
                     nullptr,
                     0,
                     s.origin,
                     1 / s.width,
                     static_cast<int>(s.ascending.size()),
                     shared.copy(s.ascending),
                     shared.copy(s.descending)};
    rows[i].axis = s.axis;
  }
  search.tree = {};
  search.tree.rows = rows;
  make_groups(source, search.tree);
  search.boxes = source.scene.boxes ? make_float_boxes(source) : nullptr;
  search.largest = 0;
  for (const Daughter& d : source.scene.daughters) {
    const Solid& solid = source.geometry.world().volumes[d.volume].solid;
    search.largest =
        std::max(search.largest, largest_coordinate(placed_extent(solid, d.transformation)));
  }
}

}  // namespace navjit::codegen

// Makes the searches for daughters that a ray may meet, and the boxes of daughters for safeties.
#include <functional>
#include <limits>

#include "codegen/data/parts.hpp"
#include "geometry/bvh/clustering.hpp"
#include "geometry/bvh/rounding.hpp"
#include "geometry/model/placed_extent.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit::codegen {

using namespace kernels;

BoxBlock block_of(const std::function<const Extent*(std::size_t)>& box) {
  BoxBlock block;
  constexpr float infinite = std::numeric_limits<float>::infinity();
  for (std::size_t lane = 0; lane < box_lanes; ++lane) {
    const Extent* e = box(lane);
    const double low[3] = {e ? e->min.x : 0, e ? e->min.y : 0, e ? e->min.z : 0};
    const double high[3] = {e ? e->max.x : 0, e ? e->max.y : 0, e ? e->max.z : 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      block.low[axis][lane] = e ? bvh::float_below(low[axis]) : infinite;
      block.high[axis][lane] = e ? bvh::float_above(high[axis]) : -infinite;
    }
  }
  return block;
}

namespace {

template <class KernelGrid>
void fill_grid(const Grid& grid, KernelGrid& kernel) {
  for (std::size_t a = 0; a < 3; ++a) {
    kernel.count[a] = grid.count[a];
    kernel.origin[a] = grid.origin[a];
    kernel.width[a] = grid.width[a];
    kernel.per_mm[a] = 1 / grid.width[a];
  }
}

/// Up to this many daughters beside a pattern are asked one by one. If there are more, their boxes
/// are tested first.
constexpr std::size_t few_others = 2;

Beside<Index> make_beside(const Source& source, const std::vector<std::uint32_t>& others) {
  Beside<Index> beside{};
  if (others.size() <= few_others) {
    beside.few = source.arena.copy(others);
    beside.few_count = static_cast<unsigned>(others.size());
    return beside;
  }
  const std::size_t blocks = (others.size() + box_lanes - 1) / box_lanes;
  auto* made = source.arena.array<BoxBlock>(blocks);
  auto* daughters = source.arena.array<Index[box_lanes]>(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    made[b] = block_of([&](std::size_t lane) {
      const std::size_t i = b * box_lanes + lane;
      return i < others.size() ? &source.plan.boxes[others[i]] : nullptr;
    });
    for (std::size_t lane = 0; lane < box_lanes && b * box_lanes + lane < others.size(); ++lane) {
      daughters[b][lane] = others[b * box_lanes + lane];
    }
  }
  beside.blocks = made;
  beside.in_block = daughters;
  beside.block_count = static_cast<unsigned>(blocks);
  return beside;
}

}  // namespace

void make(const Source&, NoSearch&) {}
void make(const Source&, SearchAll&) {}

void fill_fours(std::span<const Daughter> daughters, std::span<FourBoxes> fours) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < fours.size() * lanes_of_four; ++k) {
    FourBoxes& four = fours[k / lanes_of_four];
    const std::size_t lane = k % lanes_of_four;
    const bool there = k < daughters.size();
    const double* at = there ? daughters[k].transformation.translation : nullptr;
    const Box<double> box = there ? *static_cast<const Box<double>*>(daughters[k].solid.shape)
                                  : Box<double>{-infinite, -infinite, -infinite};
    four.x[lane] = there ? at[0] : 0;
    four.y[lane] = there ? at[1] : 0;
    four.z[lane] = there ? at[2] : 0;
    four.hx[lane] = box.hx;
    four.hy[lane] = box.hy;
    four.hz[lane] = box.hz;
  }
}

namespace {

template <int n>
void make_lanes(const Source& source, Lanes<n>& search) {
  auto* fours = source.arena.array<FourBoxes[n]>(1);
  fill_fours(source.scene.daughters, *fours);
  search.fours.at = fours;
}

}  // namespace

void make(const Source& source, Lanes<1>& search) { make_lanes(source, search); }
void make(const Source& source, Lanes<2>& search) { make_lanes(source, search); }

void make(const Source& source, SearchSlabs<Index>& search) {
  const Slabs& s = source.plan.slabs;
  std::vector<std::uint32_t> position(s.members.size());
  for (std::uint32_t i = 0; i < s.members.size(); ++i) position[s.members[i]] = i;
  Arena& arena = source.arena;
  search.slabs = {static_cast<int>(s.members.size()),
                  arena.copy(s.low),
                  arena.copy(s.high),
                  arena.copy(s.members),
                  arena.copy(position),
                  s.skin,
                  s.origin,
                  1 / s.width,
                  static_cast<int>(s.ascending.size()),
                  arena.copy(s.ascending),
                  arena.copy(s.descending)};
  search.axis = s.axis;
}

void make(const Source& source, SearchGrid<Index>& search) {
  const Grid& b = source.plan.grid;
  fill_grid(b, search.grid);
  search.grid.first = source.arena.copy(b.first);
  search.grid.members = source.arena.copy(b.members);
}

void make(const Source& source, SearchBoxes<Index>& search) {
  const Grid& b = source.plan.grid;
  fill_grid(b, search.grid);
  std::vector<std::uint32_t> first{0};
  for (std::size_t cell = 0; cell < b.size(); ++cell) {
    const std::uint32_t members = b.first[cell + 1] - b.first[cell];
    first.push_back(first.back() + (members + box_lanes - 1) / box_lanes);
  }
  auto* blocks = source.arena.array<BoxBlock>(first.back());
  auto* daughters = source.arena.array<Index[box_lanes]>(first.back());
  for (std::size_t cell = 0; cell < b.size(); ++cell) {
    const std::uint32_t* members = b.members.data() + b.first[cell];
    const std::uint32_t count = b.first[cell + 1] - b.first[cell];
    for (std::uint32_t n = 0; n < first[cell + 1] - first[cell]; ++n) {
      const auto daughter = [&](std::size_t lane) { return n * box_lanes + lane; };
      blocks[first[cell] + n] = block_of([&](std::size_t lane) {
        return daughter(lane) < count ? &source.plan.boxes[members[daughter(lane)]] : nullptr;
      });
      for (std::size_t lane = 0; lane < box_lanes && daughter(lane) < count; ++lane) {
        daughters[first[cell] + n][lane] = members[daughter(lane)];
      }
    }
  }
  search.grid.first = source.arena.copy(first);
  search.grid.blocks = blocks;
  search.grid.daughters = daughters;
}

void make(const Source& source, SearchScan& search) {
  static_assert(navjit::most_scanned == kernels::most_scanned);
  const std::vector<Extent>& boxes = source.plan.boxes;
  const std::size_t count = (boxes.size() + box_lanes - 1) / box_lanes;
  auto* blocks = source.arena.array<BoxBlock>(count);
  for (std::size_t b = 0; b < count; ++b) {
    blocks[b] = block_of([&](std::size_t lane) {
      const std::size_t k = b * box_lanes + lane;
      return k < boxes.size() ? &boxes[k] : nullptr;
    });
  }
  search = {blocks, static_cast<unsigned>(count)};
}

namespace {

/// Makes blocks of boxes around groups of blocks.
const BoxBlock* make_halls(const NearBoxes& boxes, Arena& arena) {
  std::vector<Extent> around;
  for (unsigned g = 0; g * box_lanes < boxes.count; ++g) {
    const BoxBlock& group = boxes.groups[g];
    double low[3], high[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = group.low[axis][0];
      high[axis] = group.high[axis][0];
      for (std::size_t lane = 1; lane < box_lanes; ++lane) {
        low[axis] = std::min<double>(low[axis], group.low[axis][lane]);
        high[axis] = std::max<double>(high[axis], group.high[axis][lane]);
      }
    }
    around.push_back({{low[0], low[1], low[2]}, {high[0], high[1], high[2]}});
  }
  auto* halls = arena.array<BoxBlock>((around.size() + box_lanes - 1) / box_lanes);
  for (std::size_t h = 0; h * box_lanes < around.size(); ++h) {
    halls[h] = block_of([&](std::size_t lane) {
      const std::size_t g = h * box_lanes + lane;
      return g < around.size() ? &around[g] : nullptr;
    });
  }
  return halls;
}

}  // namespace

void make(const Source& source, SearchGroups& search) {
  static_assert(navjit::most_grouped == kernels::most_grouped);
  search.boxes = make_near_boxes(source.plan.boxes, source.arena);
  search.halls = nullptr;
  if (search.boxes.count >= kernels::blocks_with_halls) {
    search.halls = make_halls(search.boxes, source.arena);
  }
}

void make(const Source& source, SearchTree& search) { search.tree = source.scene.boxes.get(); }

void make(const Source& source, SearchNest<Index>& search) {
  const Nest& s = source.plan.nest;
  search.shells = {static_cast<int>(s.members.size()),
                   source.arena.copy(s.near2),
                   source.arena.copy(s.far2),
                   source.arena.copy(s.members),
                   s.ends,
                   s.low,
                   s.high};
  search.beside = make_beside(source, s.others);
  search.axis = s.axis;
}

void make(const Source& source, SearchRings<Index>& search) {
  const Rings& r = source.plan.rings;
  Arena& arena = source.arena;
  auto* rings = arena.array<RingSectors<Index>>(r.rings.size());
  for (std::size_t i = 0; i < r.rings.size(); ++i) {
    const Ring& ring = r.rings[i];
    auto* edges = arena.array<double[2]>(ring.edges.size());
    for (std::size_t s = 0; s < ring.edges.size(); ++s) {
      edges[s][0] = ring.edges[s][0];
      edges[s][1] = ring.edges[s][1];
    }
    const double near = std::max(ring.near, 0.0);
    const std::size_t cells = ring.at_angle.size();
    rings[i] = {near * near,
                ring.far * ring.far,
                ring.low,
                ring.high,
                ring.hole,
                ring.outside,
                ring.ends,
                ring.steps,
                edges,
                arena.copy(ring.at_angle),
                static_cast<double>(cells) / 4,
                static_cast<int>(cells),
                ring.reach,
                ring.lean,
                arena.copy(ring.first),
                arena.copy(ring.members)};
  }
  search.rings = rings;
  search.count = static_cast<unsigned>(r.rings.size());
  search.beside = make_beside(source, r.others);
  search.axis = r.axis;
}

void make(const Source& source, SearchWires<Index>& search) {
  const Wires& w = source.plan.wires;
  Arena& arena = source.arena;
  auto* bundles = arena.array<kernels::WireBundle<Index>>(w.bundles.size());
  for (std::size_t i = 0; i < w.bundles.size(); ++i) {
    const navjit::WireBundle& from = w.bundles[i];
    auto* rows = arena.array<kernels::WireRow<Index>>(from.rows.size());
    for (std::size_t r = 0; r < from.rows.size(); ++r) {
      const navjit::WireRow& row = from.rows[r];
      rows[r] = {row.at,
                 row.half_u,
                 row.half_n,
                 row.radius,
                 static_cast<int>(row.members.size()),
                 arena.copy(row.u),
                 arena.copy(row.members),
                 row.origin,
                 1 / row.width,
                 static_cast<int>(row.first.size() - 1),
                 arena.copy(row.first)};
    }
    kernels::WireBundle<Index>& to = bundles[i];
    std::copy(from.across.begin(), from.across.end(), to.across);
    std::copy(from.normal.begin(), from.normal.end(), to.normal);
    std::copy(from.along.begin(), from.along.end(), to.along);
    to.count = static_cast<unsigned>(from.rows.size());
    to.rows = rows;
    to.ends = from.ends;
    to.low = from.low;
    to.high = from.high;
    to.round = from.round;
  }
  search.bundles = bundles;
  search.count = static_cast<unsigned>(w.bundles.size());
  search.beside = make_beside(source, w.others);
  search.others = arena.copy(w.others);
  search.other_count = static_cast<unsigned>(w.others.size());
  if (source.plan.safety != SafetyFrom::wires) return;
  search.boxes = make_float_boxes(source);
}

const FloatBox* make_float_boxes(const Source& source) {
  const std::span<const Daughter> daughters = source.scene.daughters;
  auto* made = source.arena.array<FloatBox>(daughters.size());
  for (std::size_t k = 0; k < daughters.size(); ++k) {
    const Daughter& d = daughters[k];
    const Solid& solid = source.geometry.world().volumes[d.volume].solid;
    const Extent e =
        inflated(placed_extent(solid, d.transformation), box_margin(source.geometry.tolerance()));
    made[k] = {{bvh::float_below(e.min.x), bvh::float_below(e.min.y), bvh::float_below(e.min.z)},
               {bvh::float_above(e.max.x), bvh::float_above(e.max.y), bvh::float_above(e.max.z)}};
  }
  return made;
}

NearBoxes make_near_boxes(std::span<const Extent> boxes, Arena& arena) {
  const bvh::Clusters clusters = bvh::cluster_by_surface(boxes, box_lanes);
  const std::size_t count = clusters.size();
  auto* blocks = arena.array<BoxBlock>(count);
  auto* daughters = arena.array<Index[box_lanes]>(count);
  std::vector<Extent> around(count);
  for (std::size_t b = 0; b < count; ++b) {
    const std::span members(clusters.order.data() + clusters.begin[b],
                            clusters.begin[b + 1] - clusters.begin[b]);
    blocks[b] = block_of(
        [&](std::size_t lane) { return lane < members.size() ? &boxes[members[lane]] : nullptr; });
    around[b] = boxes[members[0]];
    for (std::size_t lane = 0; lane < box_lanes; ++lane) {
      // Lanes without a box may have any daughter.
      daughters[b][lane] = members[lane < members.size() ? lane : 0];
      around[b] = merged(around[b], boxes[daughters[b][lane]]);
    }
  }
  auto* groups = arena.array<BoxBlock>((count + box_lanes - 1) / box_lanes);
  for (std::size_t g = 0; g * box_lanes < count; ++g) {
    groups[g] = block_of([&](std::size_t lane) {
      const std::size_t b = g * box_lanes + lane;
      return b < count ? &around[b] : nullptr;
    });
  }
  return {groups, blocks, daughters, static_cast<unsigned>(count)};
}

}  // namespace navjit::codegen

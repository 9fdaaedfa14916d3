// Makes frames, mothers and daughters, and says whether neighbour lists are used. The searches are
// in searches.cpp.
#include "codegen/data/parts.hpp"

#include <map>

#include "analysis/plan.hpp"
#include "codegen/data/inner.hpp"
#include "codegen/data/library_solids.hpp"
#include "codegen/data/rotations.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit::codegen {
namespace {

using namespace kernels;

template <class Shape>
const Shape& shape_of(const kernels::AnySolid<double>& solid) {
  return *static_cast<const Shape*>(solid.shape);
}

/// The solid. A box or a tube is copied, so that its numbers lie beside those of the scene.
kernels::AnySolid<double> nearby(const Source& source, const kernels::AnySolid<double>& solid) {
  return kernels::visit(solid, [&](const auto& shape) -> kernels::AnySolid<double> {
    using Shape = std::decay_t<decltype(shape)>;
    if constexpr (std::is_same_v<Shape, Box<double>> || std::is_same_v<Shape, Tube<double>>) {
      Shape* copy = source.arena.array<Shape>(1);
      *copy = shape;
      return {solid.kind, copy};
    } else {
      return solid;
    }
  });
}

QuickSolid quick_solid(const Source& source, const kernels::AnySolid<double>& solid) {
  if (source.code != nullptr) {
    const auto code = source.code->find(solid.shape);
    if (code != source.code->end()) return quick(solid, code->second);
  }
  const double tolerance = source.geometry.tolerance();
  const SolidCode* code = library_code(solid, tolerance, source.arena);
  if (code == nullptr) code = plain_code(solid, tolerance, source.arena);
  return code != nullptr ? quick(solid, code) : quick(nearby(source, solid));
}

}  // namespace

Extent box_with_margin(const Geometry& geometry, const Daughter& daughter) {
  // The margin is far above any rounding and far below any dimension.
  const Extent& e = geometry.world().volumes[daughter.volume].solid.extent;
  const double tolerance = geometry.tolerance();
  const double scale = std::max(1.0, largest_coordinate(e));
  return inflated(e, 2 * tolerance + 1e-9 * std::max(scale, tolerance * 1e9));
}

void make(const Source&, UnrotatedFrame&) {}
void make(const Source& source, TurnedFrame& frame) { frame.rotation = source.plan.frame.rotation; }
void make(const Source&, AnyFrame&) {}

void make(const Source& source, Box<double>& mother) {
  mother = shape_of<Box<double>>(source.scene.solid);
}
void make(const Source& source, Tube<double>& mother) {
  mother = shape_of<Tube<double>>(source.scene.solid);
}
void make(const Source& source, QuickSolid& mother) {
  mother = quick_solid(source, source.scene.solid);
}

void make(const Source&, NoDaughters&) {}

void make(const Source& source, BoxDaughters& daughters) {
  const auto& from = source.scene.daughters;
  auto* at = source.arena.array<BoxDaughter>(from.size());
  const auto inner = inner_of_daughters(source.geometry, source.scene);
  for (std::size_t k = 0; k < from.size(); ++k) {
    const auto& box = shape_of<Box<double>>(from[k].solid);
    const double* t = from[k].transformation.translation;
    at[k] = {t[0], t[1], t[2], box.hx, box.hy, box.hz, from[k].offset, from[k].volume, inner[k]};
  }
  daughters = {at, static_cast<unsigned>(from.size())};
}

namespace {

bool can_be_left_for_good(const QuickSolid& solid) {
  switch (solid.kind) {
    case SolidKind::box:
    case SolidKind::trd:
    case SolidKind::trap:
    case SolidKind::hull:
    case SolidKind::orb:
    case SolidKind::tube:
    case SolidKind::cone:
      return true;
    default:
      return false;
  }
}
bool can_be_left_for_good(const KnownSolid<Tube<double>>&) { return true; }

template <class Solid>
Solid as(const Source& source, const kernels::AnySolid<double>& solid) {
  if constexpr (std::is_same_v<Solid, QuickSolid>) {
    return quick_solid(source, solid);
  } else {
    return {static_cast<decltype(Solid::shape)>(nearby(source, solid).shape)};
  }
}

template <class Solid>
void make_solids(const Source& source, SolidDaughters<Solid>& daughters) {
  const auto& from = source.scene.daughters;
  auto* at = source.arena.array<SolidDaughter<Solid>>(from.size());
  const auto inner = inner_of_daughters(source.geometry, source.scene);
  navjit::Vec3(*boxes)[2] = nullptr;
  Rotations rotations(source.arena);
  // Equal solids are stored once in the packed scenes.
  const PackedDaughter* const packed = source.geometry.packed(source.plan.volume).daughters;
  std::map<const void*, Solid> solids;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const void* const shape = packed[k].solid.shape;
    if (!solids.contains(shape)) solids[shape] = as<Solid>(source, from[k].solid);
  }
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Daughter& d = from[k];
    const Transformation& t = d.transformation;
    const Solid& solid = solids.at(packed[k].solid.shape);
    const bool boxed = is_costly(d.solid.kind);
    at[k] = {t.translation[0],
             t.translation[1],
             t.translation[2],
             rotations.of(d),
             solid,
             d.offset,
             d.volume,
             inner[k],
             boxed,
             can_be_left_for_good(solid)};
    if (!boxed) continue;
    if (boxes == nullptr) boxes = source.arena.array<navjit::Vec3[2]>(from.size());
    const Extent box = box_with_margin(source.geometry, d);
    boxes[k][0] = box.min;
    boxes[k][1] = box.max;
  }
  daughters = {at, boxes, static_cast<unsigned>(from.size())};
}

}  // namespace

void make(const Source& source, AnyDaughters& daughters) { make_solids(source, daughters); }
void make(const Source& source, TubeDaughters& daughters) { make_solids(source, daughters); }

bool reads_neighbour_lists(const Source& source) {
  const NeighbourLists& lists = source.scene.neighbour_lists;
  const Candidates search = source.plan.candidates;
  const bool by_arithmetic = search == Candidates::layers || search == Candidates::wires;
  return !lists.of.empty() && (lists.are_near() || !by_arithmetic);
}

}  // namespace navjit::codegen

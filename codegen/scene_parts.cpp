#include "codegen/scene_parts.hpp"

#include <algorithm>
#include <map>

#include "analysis/plan.hpp"
#include "codegen/data/inner.hpp"
#include "codegen/data/rotations.hpp"
#include "codegen/search_numbers.hpp"
#include "codegen/typed_solid.hpp"
#include "geometry/solids/extent.hpp"

namespace navjit::codegen {
namespace {

/// At most this many daughters become types of their own, each with its own numbers as constants.
constexpr std::size_t most_listed = 8;

/// Each class is a branch and code of its own. If there would be more classes than this, solids of
/// one type share a class.
constexpr std::size_t most_classes = 24;

/// If a scene's daughters are made of no more solids than this, all are inlined where they are
/// asked. A guess.
constexpr std::size_t most_inlined = 12;

PartClass of_plan(const DaughterClass& c, Shapes& shapes) {
  PartClass part;
  part.from = c.from_table() && c.kind() == SolidKind::box    ? PartClass::From::box_in_table
              : c.from_table() || is_large(c.shapes[0].solid) ? PartClass::From::shape_in_table
                                                              : PartClass::From::constant;
  part.type = shapes.type(c.shapes[0].solid);
  part.rotated = c.rotated;
  part.box_first = c.box_first;
  part.members = c.members;
  return part;
}

/// Classes of daughters whose solids have the same type, with all numbers in tables.
std::vector<PartClass> by_type(const Scene& scene, Shapes& shapes) {
  std::vector<PartClass> classes;
  std::map<std::pair<std::string, bool>, std::size_t> known;
  for (std::uint32_t k = 0; k < scene.daughters.size(); ++k) {
    const Daughter& d = scene.daughters[k];
    const bool rotated = d.transformation.rotated;
    const std::string type = shapes.type(d.solid);
    const auto [at, fresh] = known.try_emplace({type, rotated}, classes.size());
    if (fresh) {
      PartClass& c = classes.emplace_back();
      c.from = d.solid.kind == SolidKind::box ? PartClass::From::box_in_table
                                              : PartClass::From::shape_in_table;
      c.type = type;
      c.rotated = rotated;
      c.box_first = is_costly(d.solid.kind);
    }
    classes[at->second].members.push_back(k);
  }
  return classes;
}

/// Compilers inline a solid's kernels wherever a daughter is asked. If the daughters are made of
/// many solids, this is most of the code and most of the time to compile it. In this case booleans
/// become functions that are not inlined.
void set_apart(const Scene& scene, SceneParts& parts) {
  const auto solids = [&](const PartClass& c) {
    return solids_in(scene.daughters[c.members[0]].solid);
  };
  std::size_t all = 0;
  for (const PartClass& c : parts.classes) all += solids(c);
  if (all <= most_inlined) return;
  for (PartClass& c : parts.classes) c.apart = solids(c) > 1;
}

/// Stands for a part that is constant in generated code and takes no space in its objects. The
/// number makes each a type of its own, because two empty members of one type would take space.
template <int>
struct Nothing {};

struct MotherInTable {
  const void* shape;
};
struct DaughtersInTable {
  const void* at;
  const kernels::Vec3<double> (*boxes)[2];
  unsigned count;
};

template <class Record>
void make_daughters(const Source& source, const SceneParts& parts, DaughtersInTable& table) {
  const auto daughters = source.scene.daughters;
  auto* records = source.arena.array<Record>(daughters.size());
  const auto inner = inner_of_daughters(source.geometry, source.scene);
  kernels::Vec3<double>(*boxes)[2] = nullptr;
  Rotations rotations(source.arena);
  std::map<const void*, const void*> shapes;
  for (std::size_t c = 0; c < parts.classes.size(); ++c) {
    const PartClass& part = parts.classes[c];
    for (const std::uint32_t k : part.members) {
      const Daughter& d = daughters[k];
      const double* t = d.transformation.translation;
      Record& record = records[k];
      const VolumeId volume = source.stand_ins ? (*source.stand_ins)[d.volume] : d.volume;
      static_cast<kernels::PlacedDaughter&>(record) = {
          t[0],    t[1],     t[2],   rotations.of(d),
          nullptr, d.offset, volume, static_cast<unsigned short>(c),
          inner[k]};
      if (part.from == PartClass::From::shape_in_table) {
        const auto [at, fresh] = shapes.try_emplace(d.solid.shape, nullptr);
        if (fresh) at->second = typed_shape(d.solid, source.arena);
        record.shape = at->second;
      }
      if constexpr (requires { record.box; }) {
        if (part.from == PartClass::From::box_in_table) {
          record.box = *static_cast<const kernels::Box<double>*>(d.solid.shape);
        }
      }
      if (part.box_first && part.from == PartClass::From::shape_in_table) {
        if (boxes == nullptr) {
          boxes = source.arena.array<kernels::Vec3<double>[2]>(daughters.size());
        }
        const Extent box = box_with_margin(source.geometry, d);
        boxes[k][0] = box.min;
        boxes[k][1] = box.max;
      }
    }
  }
  table = {records, boxes, static_cast<unsigned>(daughters.size())};
}

template <class Frame, class Mother, class Daughters, class Search, class Tolerance>
SceneTables make_scene(const Source& source, const SceneParts& parts) {
  using Scene = kernels::Scene<Frame, Mother, Daughters, Search, Tolerance>;
  Scene& scene = *source.arena.array<Scene>(1);
  SceneTables tables;
  if constexpr (std::is_same_v<Tolerance, double>) {
    scene.tolerance = source.geometry.tolerance();
  }
  if constexpr (!std::is_same_v<Frame, Nothing<0>>) make(source, scene.frame);
  if constexpr (std::is_same_v<Mother, MotherInTable>) {
    scene.mother.shape = typed_shape(source.scene.solid, source.arena);
  } else if constexpr (!std::is_same_v<Mother, Nothing<1>>) {
    make(source, scene.mother);
  }
  if constexpr (std::is_same_v<Daughters, DaughtersInTable>) {
    if (parts.boxes_beside) {
      make_daughters<kernels::PlacedBoxDaughter>(source, parts, scene.daughters);
    } else {
      make_daughters<kernels::PlacedDaughter>(source, parts, scene.daughters);
    }
  }
  make(source, scene.search);
  tables.search_type = type_of(scene.search);
  tables.search_numbers = numbers_of_search(scene.search);
  make_shared_tables(source, scene);
  tables.data = &scene;
  tables.bytes = sizeof scene;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
  tables.boxes = offsetof(Scene, boxes);
#pragma GCC diagnostic pop
  return tables;
}

template <class Frame, class Mother, class Tolerance>
SceneTables with_search(const Source& source, const SceneParts& parts) {
  const auto of = [&]<class Search>(const Search&) {
    return parts.listed || source.scene.daughters.empty()
               ? make_scene<Frame, Mother, Nothing<2>, Search, Tolerance>(source, parts)
               : make_scene<Frame, Mother, DaughtersInTable, Search, Tolerance>(source, parts);
  };
  switch (source.plan.candidates) {
    case Candidates::none:
    case Candidates::wires:
    case Candidates::groups:
    case Candidates::tree:
    case Candidates::layers:
      break;
    case Candidates::all:
      return of(kernels::SearchAll{});
    case Candidates::lanes:
      if (parts.numbers == Numbers::constants) return of(kernels::SearchAll{});
      return source.scene.daughters.size() <= kernels::lanes_of_four ? of(Lanes<1>{})
                                                                     : of(Lanes<2>{});
    case Candidates::slabs:
      return of(kernels::SearchSlabs<Index>{});
    case Candidates::grid:
      return of(kernels::SearchGrid<Index>{});
    case Candidates::boxes:
      return of(kernels::SearchBoxes<Index>{});
    case Candidates::scan:
      return of(kernels::SearchScan{});
    case Candidates::nest:
      return of(kernels::SearchNest<Index>{});
    case Candidates::rings:
      return of(kernels::SearchRings<Index>{});
  }
  return of(kernels::NoSearch{});
}

/// The tables of a leaf that shares code: only its own numbers, which lie behind a SharedLeafData.
template <class Frame, class Mother>
SceneTables make_leaf(const Source& source, const SceneParts& parts) {
  using kernels::NoSearch;
  static_assert(alignof(kernels::Scene<Frame, Mother, Nothing<2>, NoSearch, Nothing<3>>) ==
                alignof(kernels::SharedLeafData));
  return make_scene<Frame, Mother, Nothing<2>, NoSearch, Nothing<3>>(source, parts);
}

template <class Frame>
SceneTables leaf_tables(const Source& source, const SceneParts& parts) {
  return source.scene.solid.kind == SolidKind::box
             ? make_leaf<Frame, kernels::Box<double>>(source, parts)
             : make_leaf<Frame, kernels::Tube<double>>(source, parts);
}

template <class Frame>
SceneTables with_frame(const Source& source, const SceneParts& parts) {
  return parts.mother_beside ? leaf_tables<Frame>(source, parts)
                             : with_search<Frame, MotherInTable, double>(source, parts);
}

}  // namespace

SceneParts parts_of_scene(const Geometry& geometry, const ScenePlan& plan, Numbers numbers,
                          Shapes& shapes) {
  const Scene& scene = geometry.scene(plan.volume);
  SceneParts parts;
  parts.numbers = numbers;
  if (numbers == Numbers::own_solid) {
    parts.mother_beside = true;
    return parts;
  }
  const bool constants = numbers == Numbers::constants;
  parts.mother_in_table = !constants || is_large(scene.solid);
  parts.listed = constants && !scene.daughters.empty() && scene.daughters.size() <= most_listed &&
                 (plan.candidates == Candidates::all || plan.candidates == Candidates::lanes) &&
                 std::none_of(scene.daughters.begin(), scene.daughters.end(),
                              [](const Daughter& d) { return is_large(d.solid); });
  if (parts.listed) {
    for (std::uint32_t k = 0; k < scene.daughters.size(); ++k) {
      const Daughter& d = scene.daughters[k];
      parts.classes.push_back({PartClass::From::constant,
                               shapes.type(d.solid),
                               d.transformation.rotated,
                               is_costly(d.solid.kind),
                               false,
                               {k}});
    }
  } else if (constants && plan.classes.size() <= most_classes) {
    for (const DaughterClass& c : plan.classes) parts.classes.push_back(of_plan(c, shapes));
  } else {
    parts.classes = by_type(scene, shapes);
  }
  set_apart(scene, parts);
  parts.boxes_beside =
      std::any_of(parts.classes.begin(), parts.classes.end(),
                  [](const PartClass& c) { return c.from == PartClass::From::box_in_table; });
  return parts;
}

SceneTables make_tables(const Source& source, const SceneParts& parts) {
  if (parts.numbers == Numbers::constants) {
    return parts.mother_in_table ? with_search<Nothing<0>, MotherInTable, Nothing<3>>(source, parts)
                                 : with_search<Nothing<0>, Nothing<1>, Nothing<3>>(source, parts);
  }
  const FrameFacts& frame = source.plan.frame;
  if (frame.never_rotated) return with_frame<kernels::UnrotatedFrame>(source, parts);
  if (frame.only_rotation) return with_frame<kernels::TurnedFrame>(source, parts);
  return with_frame<kernels::AnyFrame>(source, parts);
}

}  // namespace navjit::codegen

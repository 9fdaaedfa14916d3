#include "codegen/scene_types.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <vector>

#include "codegen/data/inner.hpp"
#include "codegen/text.hpp"

namespace navjit::codegen {
namespace {

/// If a scene has daughters of more different volumes than this, leaves not counted, it enters all
/// of them through the dispatch table.
constexpr std::size_t most_entered = 24;

struct Writer {
  const Geometry& geometry;
  const WorldFacts& facts;
  const ScenePlan& plan;
  const SceneParts& parts;
  const SceneTables& tables;
  const Neighbours& neighbours;
  const std::string& name;
  Shapes& shapes;
  const Scene& scene;
  std::string text{};

  /// The full name of a constant of this scene.
  std::string own(const std::string& what) const { return what + "_of_" + name; }
  /// Defines a constant and returns its name. `dimension` is that of an array, for instance "[2]".
  std::string define(const std::string& type, const std::string& what, const std::string& value,
                     const std::string& dimension = "") {
    text += "constexpr " + type + " " + own(what) + dimension + value + ";\n";
    return own(what);
  }
  bool constants() const { return parts.numbers == Numbers::constants; }
  bool of_structure() const { return parts.numbers == Numbers::tables; }
  bool stand_ins() const { return constants() && facts.of_equals[plan.volume].stand_ins; }
  /// The volume as which the code knows a daughter: its stand-in, if the scene has stand-ins.
  VolumeId known_as(VolumeId daughter) const {
    return stand_ins() ? facts.first_equal[daughter] : daughter;
  }
};

std::string indexed(const std::string& name, std::size_t i) {
  return name + "_" + std::to_string(i);
}

std::string frame_of(Writer& w) {
  const FrameFacts& f = w.plan.frame;
  if (!f.never_rotated && !f.only_rotation) return "AnyFrame";
  if (!w.constants()) return f.never_rotated ? "UnrotatedFrame" : "TurnedFrame";
  const std::array<double, 9> none{};
  const std::array<double, 3> nowhere{};
  const std::string frame =
      w.define("FrameConstants", "frame",
               "{" + number(f.never_rotated ? 0U : f.rotation) + ", " +
                   list(f.never_rotated ? none : f.only_rotation.value_or(none)) + ", " +
                   number(f.only_translation.has_value()) + ", " +
                   list(f.only_translation.value_or(nowhere)) + "}");
  return "ConstantFrame<" + frame + ">";
}

/// What the places of these daughters have in common, as an initialiser.
std::string places_of(const Writer& w, const std::vector<std::uint32_t>& members) {
  const Daughter& first = w.scene.daughters[members[0]];
  const auto all = [&](auto same) {
    return w.constants() && std::all_of(members.begin(), members.end(), [&](std::uint32_t k) {
             return same(w.scene.daughters[k]);
           });
  };
  std::array<bool, 3> same{};
  std::array<double, 3> at{};
  for (std::size_t i = 0; i < 3; ++i) {
    same[i] = all([&](const Daughter& d) {
      return d.transformation.translation[i] == first.transformation.translation[i];
    });
    if (same[i]) at[i] = first.transformation.translation[i];
  }
  const double* r = first.transformation.rotation;
  const bool rotated = first.transformation.rotated;
  const bool same_turn = rotated && all([&](const Daughter& d) {
                           return std::equal(r, r + 9, d.transformation.rotation);
                         });
  std::array<double, 9> turn{};
  if (same_turn) std::copy_n(r, 9, turn.begin());
  const bool same_volume = all([&](const Daughter& d) { return d.volume == first.volume; });
  return "{" + list(same) + ", " + list(at) + ", " + number(rotated) + ", " + number(same_turn) +
         ", " + list(turn) + ", " + number(same_volume) + ", " +
         number(same_volume ? first.volume : 0U) + "}";
}

/// The half lengths that all boxes of a class share, as an initialiser.
std::string shared_box(const Writer& w, const PartClass& c) {
  const auto half = [&](std::uint32_t k, std::size_t axis) {
    const auto& box = *static_cast<const kernels::Box<double>*>(w.scene.daughters[k].solid.shape);
    return axis == 0 ? box.hx : axis == 1 ? box.hy : box.hz;
  };
  std::array<bool, 3> same{};
  std::array<double, 3> halves{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double first = half(c.members[0], axis);
    same[axis] =
        w.constants() && std::all_of(c.members.begin(), c.members.end(),
                                     [&](std::uint32_t k) { return half(k, axis) == first; });
    if (same[axis]) halves[axis] = first;
  }
  return "{" + list(same) + ", " + list(halves) + "}";
}

std::string corner(const Vec3& p) { return list(std::array{p.x, p.y, p.z}); }

std::string class_of(Writer& w, std::size_t number_of_class) {
  const PartClass& c = w.parts.classes[number_of_class];
  const Daughter& first = w.scene.daughters[c.members[0]];
  std::string solid;
  switch (c.from) {
    case PartClass::From::constant:
      solid = "SameSolid<" + w.shapes.constant(first.solid) + ">";
      break;
    case PartClass::From::box_in_table:
      solid = "OwnBox<" +
              w.define("BoxConstants", indexed("box", number_of_class), shared_box(w, c)) + ">";
      break;
    case PartClass::From::shape_in_table:
      solid = "OwnSolid<" + c.type + ">";
  }
  if (c.apart) solid = "Apart<" + solid + ">";
  const std::string place =
      w.define("PlaceConstants", indexed("place", number_of_class), places_of(w, c.members));
  std::string bounds = "NoBox";
  if (c.box_first && c.from == PartClass::From::constant) {
    const Extent box = box_with_margin(w.geometry, first);
    bounds = "SameBounds<" +
             w.define("Vec3<double>", indexed("bounds", number_of_class),
                      "{" + corner(box.min) + ", " + corner(box.max) + "}", "[2]") +
             ">";
  } else if (c.box_first) {
    bounds = "OwnBounds";
  }
  return "DaughterClass<" + solid + ", " + place + ", " + bounds + ">";
}

/// The records of listed daughters: all that is needed to push one onto the stack.
std::string listed_places(Writer& w) {
  std::string records;
  const auto inner = inner_of_daughters(w.geometry, w.scene);
  for (std::size_t k = 0; k < w.scene.daughters.size(); ++k) {
    const Daughter& d = w.scene.daughters[k];
    const double* t = d.transformation.translation;
    std::string rotation = "nullptr";
    if (d.transformation.rotated) {
      const double* r = d.transformation.rotation;
      rotation = w.define("double", indexed("turn", k), list(std::span(r, 9)), "[9]");
    }
    records += (k == 0 ? "{" : ", {") + number(t[0]) + ", " + number(t[1]) + ", " + number(t[2]) +
               ", " + rotation + ", nullptr, " + number(static_cast<unsigned long long>(d.offset)) +
               ", " + number(w.known_as(d.volume)) + ", " + number(static_cast<unsigned>(k)) +
               ", " + "InnerDaughters(" + number(unsigned{inner[k]}) + ")" + "}";
  }
  return w.define("PlacedDaughter", "places", "{" + records + "}", "[]");
}

std::string daughters_of(Writer& w) {
  if (w.scene.daughters.empty()) return "NoDaughters";
  std::vector<std::uint32_t> all(w.scene.daughters.size());
  std::iota(all.begin(), all.end(), 0U);
  const std::string shared = w.define("PlaceConstants", "shared", places_of(w, all));
  std::string type = w.parts.listed         ? "ListedDaughters<" + listed_places(w)
                     : w.parts.boxes_beside ? "ClassedDaughters<PlacedBoxDaughter"
                                            : "ClassedDaughters<PlacedDaughter";
  type += ", " + shared;
  for (std::size_t c = 0; c < w.parts.classes.size(); ++c) type += ",\n    " + class_of(w, c);
  return type + ">";
}

std::string lanes_of(Writer& w) {
  const auto daughters = w.scene.daughters;
  std::vector<kernels::FourBoxes> fours((daughters.size() + kernels::lanes_of_four - 1) /
                                        kernels::lanes_of_four);
  fill_fours(daughters, fours);
  std::string text;
  for (const kernels::FourBoxes& f : fours) {
    text += text.empty() ? "{{" : ", {";
    for (const kernels::Doubles& lanes : {f.x, f.y, f.z, f.hx, f.hy, f.hz}) {
      text += (text.back() == '{' ? "" : ", ") +
              list(std::array<double, 4>{lanes[0], lanes[1], lanes[2], lanes[3]});
    }
    text += "}";
  }
  return "SearchLanes<ConstantFours<" + w.define("FourBoxes", "fours", text + "}", "[]") + ">>";
}

std::string search_of(Writer& w) {
  if (w.constants() && w.plan.candidates == Candidates::lanes) return lanes_of(w);
  if (!w.constants() || w.tables.search_numbers.empty()) return w.tables.search_type;
  return "ConstantSearch<" + w.define(w.tables.search_type, "search", w.tables.search_numbers) +
         ">";
}

/// The type that says how to relocate a track that leaves the scene.
std::string leave_of(const Writer& w) {
  if (w.of_structure()) return "LeaveByStack";
  if (w.plan.volume == w.geometry.world().top) return "LeaveWorld";
  const std::optional<VolumeId> mothers = w.facts.of_equals[w.plan.volume].mothers;
  if (mothers && w.neighbours.reenter.contains(*mothers)) {
    return (w.constants() ? "LeaveToScene<" : "LeaveSharedLeafTo<") + scene_name(*mothers) + ">";
  }
  if (!w.plan.only_mother) return "LeaveByStack";
  return "LeaveToVolume<" + number(*w.plan.only_mother) + ">";
}

/// The type that says how to relocate a track that enters a daughter.
std::string enter_of(const Writer& w) {
  if (w.of_structure()) return "EnterByTable";
  std::set<VolumeId> volumes;
  for (const Daughter& d : w.scene.daughters) volumes.insert(w.known_as(d.volume));
  const std::size_t leaves =
      std::erase_if(volumes, [&](VolumeId v) { return w.geometry.scene(v).daughters.empty(); });
  if (volumes.empty()) return "EnterLeaves";
  std::string scenes;
  std::size_t known = 0;
  for (const VolumeId v : volumes) {
    const VolumeId first = w.facts.first_equal[v];
    if (!w.neighbours.enter.contains(first)) continue;
    scenes += ", VolumeOfScene<" + number(v) + ", " + scene_name(first) + ">";
    ++known;
  }
  if (known == 0 || volumes.size() > most_entered) return "EnterByTable";
  return "EnterScenes<" + number(leaves > 0) + ", " + number(known == volumes.size()) + scenes +
         ">";
}

/// Neighbour lists as constants, if the daughters are listed.
std::string listed_neighbours(Writer& w) {
  const NeighbourLists& from = w.scene.neighbour_lists;
  if (!w.parts.listed || from.of.empty()) return {};
  std::string text;
  for (const kernels::NeighbourList& l : from.of) {
    text += (text.empty() ? "{" : ", {") + list(l.low) + ", " + list(l.high) + ", " +
            number(l.first) + ", " + number(unsigned{l.count}) + ", " +
            number(unsigned{l.mother_contains}) + ", " + number(l.block) + "}";
  }
  const std::string of = w.define("NeighbourList", "lists", "{" + text + "}", "[]");
  std::vector<unsigned> neighbours(from.neighbours.begin(), from.neighbours.end());
  neighbours.push_back(0);  // arrays must not be empty
  text.clear();
  for (const unsigned k : neighbours) text += (text.empty() ? "{" : ", ") + number(k);
  return "  static constexpr const NeighbourList* lists = " + of +
         ";\n  static constexpr const unsigned* neighbours = " +
         w.define("unsigned", "neighbours", text + "}", "[]") + ";\n";
}

std::string whether(bool there) { return there ? "Has::yes" : "Has::no"; }

}  // namespace

std::string scene_name(VolumeId volume) { return "scene_" + std::to_string(volume); }

std::string scene_types(const Geometry& geometry, const WorldFacts& facts, const ScenePlan& plan,
                        const SceneParts& parts, const SceneTables& tables,
                        const Neighbours& neighbours, std::size_t at, const std::string& name,
                        Shapes& shapes) {
  const Scene& scene = geometry.scene(plan.volume);
  Writer w{geometry, facts, plan, parts, tables, neighbours, name, shapes, scene};
  const std::string mother = parts.mother_beside ? shapes.type(scene.solid)
                             : parts.mother_in_table
                                 ? "KnownSolid<" + shapes.type(scene.solid) + ">"
                                 : "ConstantSolid<" + shapes.constant(scene.solid) + ">";
  const std::string frame = frame_of(w), daughters = daughters_of(w), search = search_of(w);
  const std::string lists = listed_neighbours(w);
  w.text += "struct " + name + " : Scene<" + frame + ", " + mother + ",\n  " + daughters + ",\n  " +
            search + ", " + (w.of_structure() ? "double" : "Tolerance") + "> {\n" + lists;
  w.text += "  using leave = " + leave_of(w) + ";\n  using enter = " + enter_of(w) + ";\n";
  // Code of a structure also serves scenes in which rare steps are frequent, so it makes them, out
  // of line.
  w.text += std::string("  static constexpr Rare rare = Rare::") +
            (w.of_structure()     ? "out_of_line"
             : plan.bail_out_rare ? "left_out"
                                  : "taken") +
            ";\n";
  w.text +=
      "  static constexpr bool oblique_only = " + number(w.of_structure() || plan.oblique_only) +
      ", shared_moves = " + number(!w.of_structure()) + ";\n";
  w.text += "  static constexpr Has has_lists = " + whether(!scene.neighbour_lists.of.empty()) +
            ", has_boxes = " + whether(plan.safety == SafetyFrom::boxes) + ";\n";
  if (w.stand_ins()) w.text += "  static constexpr bool stand_ins = true;\n";
  w.text += "  static constexpr unsigned long at = " + std::to_string(at) + ";\n};\n";
  w.text += "static_assert(sizeof(" + name + ") == " + std::to_string(tables.bytes) +
            " && __builtin_offsetof(" + name + ", boxes) == " + std::to_string(tables.boxes) +
            ");\n";
  return std::move(w.text);
}

}  // namespace navjit::codegen

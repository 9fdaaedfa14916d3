#include "analysis/plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "analysis/candidates.hpp"
#include "analysis/foreign.hpp"
#include "analysis/patterns/layers.hpp"
#include "analysis/solid_key.hpp"

namespace navjit {
namespace {

const char* const axis_names[] = {"x", "y", "z", "the centre"};

/// A scene that is not a grid has blocks of boxes from a few daughters on. If it has more daughters
/// than this and no boxes, there were too many daughters for boxes.
constexpr std::size_t most_without_boxes = 64;

/// With more daughters than this, tables of boxes would be most of the code.
constexpr std::size_t most_boxes_in_code = 4096;

/// Each class of daughters is code of its own, and each number of a solid is a constant. With more
/// than this the compiler takes longer than any run would gain.
constexpr std::size_t most_classes = 64;
constexpr std::size_t most_numbers = 4000;

std::vector<DaughterClass> classify(const Geometry& geometry, const Scene& scene) {
  std::vector<DaughterClass> classes;
  std::map<std::pair<std::string, bool>, std::size_t> known;
  for (std::uint32_t k = 0; k < scene.daughters.size(); ++k) {
    const Daughter& d = scene.daughters[k];
    const auto [entry, fresh] =
        known.try_emplace({solid_key(d.solid), d.transformation.rotated}, classes.size());
    if (!fresh) {
      classes[entry->second].members.push_back(k);
      continue;
    }
    DaughterClass c;
    c.shapes.push_back({d.solid, geometry.world().volumes[d.volume].solid.extent});
    c.rotated = d.transformation.rotated;
    c.box_first = is_costly(d.solid.kind);
    c.members.push_back(k);
    classes.push_back(std::move(c));
  }
  for (DaughterClass& c : classes) c.shape_of.assign(c.members.size(), 0);
  return classes;
}

/// From this many different solids of a kind on, a table of their numbers costs less than code with
/// constants for each solid and an unpredictable branch between them. Thirteen cones gained half of
/// their time. The limits are guesses, except for boxes.
std::size_t fewest_in_table(SolidKind kind) {
  switch (kind) {
    case SolidKind::box:
      return 2;
    case SolidKind::tube:
    case SolidKind::cone:
    case SolidKind::trd:
      return 3;
    default:
      return static_cast<std::size_t>(-1);
  }
}

void merge_classes(std::vector<DaughterClass>& classes, SolidKind kind, bool rotated) {
  const auto mergeable = [&](const DaughterClass& c) {
    return c.kind() == kind && c.rotated == rotated;
  };
  const auto count =
      static_cast<std::size_t>(std::count_if(classes.begin(), classes.end(), mergeable));
  if (count < fewest_in_table(kind)) return;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> members;  // daughters, each with its shape
  std::vector<DaughterClass::Shape> shapes;
  for (DaughterClass& c : classes) {
    if (!mergeable(c)) continue;
    for (const std::uint32_t k : c.members) {
      members.emplace_back(k, static_cast<std::uint32_t>(shapes.size()));
    }
    shapes.push_back(c.shapes[0]);
  }
  std::sort(members.begin(), members.end());
  const auto into = std::find_if(classes.begin(), classes.end(), mergeable);
  std::erase_if(classes, [&](const DaughterClass& c) { return &c != &*into && mergeable(c); });
  // This is the first of the merged classes, so erasing the others did not move it.
  into->shapes = std::move(shapes);
  into->members.clear();
  into->shape_of.clear();
  for (const auto& [k, shape] : members) {
    into->members.push_back(k);
    into->shape_of.push_back(shape);
  }
}

/// With more daughters than this the tables of neighbours would be most of the code.
constexpr std::size_t most_with_neighbours = 2048;

/// Plans of scenes with fewer daughters are not kept, since they take little time. A guess.
constexpr std::size_t fewest_to_keep = 16;

/// Whether the volume's own solid, or that of a daughter that is not rotated, is a box.
bool has_boxes_along_axes(const Scene& scene, const ScenePlan& plan) {
  return scene.solid.kind == SolidKind::box ||
         std::any_of(plan.classes.begin(), plan.classes.end(), [](const DaughterClass& c) {
           return !c.rotated && c.kind() == SolidKind::box;
         });
}

ScenePlan make_plan(const Geometry& geometry, const WorldFacts& facts,
                    const KnownPlans::Question& question) {
  const VolumeId volume = question.volume;
  const Scene& scene = geometry.scene(volume);
  ScenePlan plan;
  plan.volume = volume;
  plan.frame = facts.frames[volume];
  plan.only_mother = facts.only_mothers[volume];
  plan.classes = classify(geometry, scene);
  for (const SolidKind kind : {SolidKind::box, SolidKind::tube, SolidKind::cone, SolidKind::trd}) {
    for (const bool rotated : {false, true}) merge_classes(plan.classes, kind, rotated);
  }
  plan.neighbour_lists =
      !scene.neighbour_lists.of.empty() && scene.neighbour_lists.of.size() <= most_with_neighbours;
  plan.bail_out_rare = !question.along_faces;
  plan.oblique_only = plan.bail_out_rare && has_boxes_along_axes(scene, plan);
  choose_candidates(geometry, question.forced, plan);
  if (question.with_safety) choose_safety(geometry, plan);
  return plan;
}

/// How the scene's daughters are found, for people; empty if there are none.
std::string how_found(const ScenePlan& plan) {
  std::ostringstream out;
  switch (plan.candidates) {
    case Candidates::none:
      break;
    case Candidates::all:
      out << "spelled out one by one";
      break;
    case Candidates::lanes:
      out << "all, four boxes at once";
      break;
    case Candidates::slabs:
      out << "the next along "
          << "xyz"[plan.slabs.axis];
      break;
    case Candidates::nest:
      out << "the next of " << plan.nest.members.size() << " shells about "
          << axis_names[plan.nest.axis];
      break;
    case Candidates::rings:
      out << "sectors about " << axis_names[plan.rings.axis] << ":";
      for (const Ring& ring : plan.rings.rings) {
        out << " " << ring.present << " of " << ring.steps << " in a ring"
            << (ring.lean != 0 ? " that leans," : ",");
      }
      out << " " << plan.rings.others.size() << " besides";
      break;
    case Candidates::wires:
      out << "the next across:";
      for (const WireBundle& bundle : plan.wires.bundles) {
        for (const WireRow& row : bundle.rows) out << " " << row.members.size() << " in a row,";
      }
      out << " " << plan.wires.others.size() << " besides";
      break;
    case Candidates::scan:
      out << "those whose boxes it meets, all of " << plan.boxes.size() << " looked at first";
      break;
    case Candidates::groups:
      out << "those whose boxes it meets, looked at by groups of eight";
      break;
    case Candidates::tree:
      out << "by the hierarchy of boxes";
      break;
    case Candidates::layers:
      out << describe_layers(plan.layers);
      break;
    case Candidates::grid:
    case Candidates::boxes:
      out << "cells " << plan.grid.count[0] << " x " << plan.grid.count[1] << " x "
          << plan.grid.count[2] << ", " << plan.mean_candidates << " candidates a cell"
          << (plan.candidates == Candidates::boxes ? ", boxes tested eight at once" : "");
  }
  return out.str();
}

}  // namespace

bool is_costly(SolidKind kind) {
  return kind != SolidKind::box && kind != SolidKind::tube && kind != SolidKind::cone;
}

ScenePlan plan_scene(const Geometry& geometry, const WorldFacts& facts, VolumeId volume) {
  const auto forced = facts.forced_candidates.find(facts.first_equal[volume]);
  const KnownPlans::Question question{
      volume,
      forced == facts.forced_candidates.end() ? std::nullopt : std::optional(forced->second),
      facts.along_faces.contains(volume), facts.with_safety};
  if (geometry.scene(volume).daughters.size() < fewest_to_keep) {
    return make_plan(geometry, facts, question);
  }
  if (const auto known = facts.known_plans->find(question)) return *known;
  ScenePlan plan = make_plan(geometry, facts, question);
  facts.known_plans->keep(question, plan);
  return plan;
}

std::size_t numbers_of_solids(const Geometry& geometry, const ScenePlan& plan) {
  std::size_t numbers = solid_key(geometry.scene(plan.volume).solid).size() / 8;
  for (const DaughterClass& c : plan.classes) {
    for (const DaughterClass::Shape& s : c.shapes) numbers += solid_key(s.solid).size() / 8;
  }
  return numbers;
}

Worth worth_compiling(const Geometry& geometry, const ScenePlan& plan) {
  const auto no = [](std::string_view why) { return Worth{false, why}; };
  if (facts_of(plan.candidates).for_data_alone) return no("its search is bound to data alone");
  const std::size_t daughters = geometry.scene(plan.volume).daughters.size();
  if (plan.candidates == Candidates::boxes && daughters > most_boxes_in_code)
    return no("too many daughters for tables of boxes");
  // If many cells have a single daughter, and these are tested one after the other, this is no
  // faster than the generic navigator's tree.
  if (plan.candidates == Candidates::grid && daughters > most_without_boxes &&
      !is_regular_grid(plan)) {
    return no("too many daughters for tables of boxes");
  }
  // The walk through many faces is the same code with tables, specialised or not. A copy for every
  // scene only removes other code from the instruction cache.
  if (geometry.scene(plan.volume).solid.kind == SolidKind::facets) {
    return no("its own faces take the time");
  }
  if (holds_foreign(geometry.scene(plan.volume))) return no("there is no code for foreign solids");
  if (plan.classes.size() > most_classes) return no("too many different solids to spell out");
  if (numbers_of_solids(geometry, plan) > most_numbers) return no("solids too large to spell out");
  return {true, "constants fold, candidates are few"};
}

std::string describe(const Geometry& geometry, const ScenePlan& plan) {
  const LogicalVolume& volume = geometry.world().volumes[plan.volume];
  std::ostringstream out;
  out << "scene " << volume.name << "\n"
      << "  solid        " << kind_name(volume.solid.kind) << "\n"
      << "  daughters    " << volume.daughters.size() << " (" << plan.pattern << ")\n"
      << "  frame        "
      << (plan.frame.only_translation ? "constant"
          : plan.frame.never_rotated  ? "translation only"
          : plan.frame.only_rotation  ? "one rotation"
                                      : "general")
      << "\n"
      << "  leaves out   "
      << (plan.oblique_only    ? "steps along faces, or from within daughters"
          : plan.bail_out_rare ? "steps from within daughters"
                               : "nothing")
      << "\n"
      << "  mother       "
      << (plan.only_mother                      ? geometry.world().volumes[*plan.only_mother].name
          : plan.volume == geometry.world().top ? std::string("none: the world")
                                                : std::string("several"))
      << "\n"
      << "  candidates   ";
  const std::string how = how_found(plan);
  out << facts_of(plan.candidates).name << (how.empty() ? "" : ": ") << how << "\n";
  if (plan.layers.found() && plan.candidates != Candidates::layers &&
      plan.candidates != Candidates::slabs && plan.candidates != Candidates::wires) {
    out << "  bound to data " << describe_layers(plan.layers) << "\n";
  }
  for (const DaughterClass& c : plan.classes) {
    out << "  class        " << c.members.size() << " x " << kind_name(c.kind())
        << (c.rotated ? ", rotated" : "") << (c.box_first ? ", box first" : "")
        << (c.from_table() ? ", " + std::to_string(c.shapes.size()) + " sizes from a table" : "")
        << "\n";
  }
  out << "  safety       "
      << (plan.safety == SafetyFrom::all     ? "every daughter's"
          : plan.safety == SafetyFrom::boxes ? "by boxes, eight at once"
          : plan.safety == SafetyFrom::wires ? "the wires that are near"
          : plan.layers.found()              ? "the layers that are near"
                                             : "generic")
      << "\n";
  if (plan.neighbour_lists) {
    const NeighbourLists& around = geometry.scene(plan.volume).neighbour_lists;
    std::size_t listed = 0, within = 0;
    for (const NeighbourLists::Of& of : around.of) {
      listed += of.listed() ? 1 : 0;
      within += of.mother_contains ? 1 : 0;
    }
    out << "  leaving      " << around.neighbours.size() << " neighbours of " << listed
        << " daughters, " << within << " of them well inside\n";
  }
  const Worth worth = worth_compiling(geometry, plan);
  out << "  compile      " << (worth ? "yes: " : "no: ") << worth.why << "\n";
  return out.str();
}

}  // namespace navjit

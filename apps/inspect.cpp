// `navjit inspect`: what is in a detector, and what the analysis makes of a scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>

#include "analysis/error_bound.hpp"
#include "analysis/plan.hpp"
#include "apps/commands.hpp"
#include "apps/options/boxes.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "codegen/data/bind.hpp"
#include "codegen/module.hpp"
#include "common/text.hpp"
#include "geometry/bvh/box_tree.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  std::string scene;        ///< empty: all volumes in short
  bool emit = false;        ///< print the generated source of the scene
  bool structures = false;  ///< what scenes have in common, instead of scenes
  GeometryOptions geometry;
};

/// "all", "linear", "two-level:surface", ...
std::string search_name(const Scene& scene) {
  if (scene.boxes) return to_string(scene.boxes->structure());
  return scene.search == Search::none ? "-" : "all";
}

std::string clusters_of(const Scene& scene) {
  const std::size_t clusters = scene.boxes ? scene.boxes->clusters() : 0;
  return clusters > 0 ? std::to_string(clusters) : "-";
}

VolumeId find_volume(const World& world, const std::string& name) {
  for (std::size_t v = 0; v < world.volumes.size(); ++v) {
    if (world.volumes[v].name == name) return static_cast<VolumeId>(v);
  }
  throw Error("no logical volume is called '" + name +
              "'; navjit inspect without --scene lists them");
}

/// Prints how far off the steps of the scene's navigators may be.
void print_level(const ErrorBound& bound) {
  if (bound.known()) {
    std::printf("  error bound  %.3g mm: tolerance %.2g, frames %.2g, surfaces %.2g\n",
                bound.total(), bound.tolerance, bound.frame, bound.kernel);
  } else {
    std::printf("  error bound  none: no bound is known of surfaces of %s\n",
                bound.unknown.c_str());
  }
}

/// Which other volumes have the code that is compiled for this one.
void print_equals(const World& world, const WorldFacts& facts, VolumeId volume) {
  constexpr std::size_t most_named = 3;
  const std::vector<VolumeId>& equals = facts.equals[facts.first_equal[volume]];
  if (equals.size() < 2) return;
  std::string names;
  std::size_t named = 0;
  for (const VolumeId equal : equals) {
    if (equal == volume) continue;
    if (named++ == most_named) break;
    names += (names.empty() ? "" : ", ") + common::printable(world.volumes[equal].name);
  }
  std::printf("  code         shared with %zu equal volume%s: %s%s\n", equals.size() - 1,
              equals.size() == 2 ? "" : "s", names.c_str(), named > most_named ? ", ..." : "");
}

void print_scene(const Geometry& geometry, const std::string& name, bool emit) {
  const VolumeId volume = find_volume(geometry.world(), name);
  const WorldFacts facts = analyse_world(geometry);
  std::istringstream plan(describe(geometry, plan_scene(geometry, facts, volume)));
  for (std::string line; std::getline(plan, line);) {
    std::printf("%s\n", common::printable(line).c_str());
  }
  std::printf("  touchables   %llu\n", static_cast<unsigned long long>(facts.touchables[volume]));
  const Scene& scene = geometry.scene(volume);
  std::printf("  search       %s", search_name(scene).c_str());
  if (scene.boxes) {
    const bvh::BoxTree& boxes = *scene.boxes;
    if (boxes.clusters() > 0) std::printf(", %zu clusters", boxes.clusters());
    std::printf(", %zu bytes", boxes.bytes());
  }
  std::printf("\n");
  print_level(error_bounds(geometry.world())[volume]);
  print_equals(geometry.world(), facts, volume);
  if (emit) {
    std::printf("\n%s", codegen::generate(geometry, facts, std::array{volume}).source.c_str());
  }
}

/// Prints the materials of the volumes in the tree. What is not known is a dash.
void print_materials(const World& world, const WorldFacts& facts) {
  std::vector<bool> used(world.materials.size());
  for (std::size_t v = 0; v < world.volumes.size(); ++v) {
    if (facts.reachable[v]) used[world.volumes[v].material] = true;
  }
  const auto print = [](double value) {
    if (value > 0) {
      std::printf("%10.5g ", value);
    } else {
      std::printf("%10s ", "-");
    }
  };
  std::printf("\n%10s %10s %s\n", "g/cm3", "X0/cm", "material");
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (!used[m]) continue;
    print(world.materials[m].density);
    print(world.materials[m].radiation_length / 10);
    std::printf("%s\n", common::printable(world.materials[m].name).c_str());
  }
}

void print_world(const Geometry& geometry, const std::string& file, const GdmlReport& report) {
  const World& world = geometry.world();
  const WorldFacts facts = analyse_world(geometry);
  std::size_t placements = 0, unused = 0;
  for (std::size_t v = 0; v < world.volumes.size(); ++v) {
    placements += world.volumes[v].daughters.size();
    unused += facts.reachable[v] ? 0 : 1;
  }
  std::printf(
      "%s\n%zu logical volumes, %zu placements, %llu touchables, %d levels, tolerance %g mm\n",
      file.c_str(), world.volumes.size(), placements,
      static_cast<unsigned long long>(world.volumes[world.top].touchables), world.depth,
      world.tolerance);
  if (unused > 0) std::printf("%zu volumes are not in the tree\n", unused);
  for (const std::string& note : report.notes)
    std::printf("note: %s\n", common::printable(note).c_str());
  for (const std::string& note : report.skipped)
    std::printf("note: %s\n", common::printable(note).c_str());
  std::printf("\n%10s %6s %-13s %-21s %8s %-28s %s\n", "touchables", "daught", "solid", "search",
              "clusters", "arrangement", "volume");
  for (std::size_t v = 0; v < world.volumes.size(); ++v) {
    if (!facts.reachable[v]) continue;
    const auto volume = static_cast<VolumeId>(v);
    const ScenePlan plan = plan_scene(geometry, facts, volume);
    const Scene& scene = geometry.scene(volume);
    std::printf("%10llu %6zu %-13s %-21s %8s %-28s %s\n",
                static_cast<unsigned long long>(facts.touchables[v]),
                world.volumes[v].daughters.size(), kind_name(world.volumes[v].solid.kind),
                search_name(scene).c_str(), clusters_of(scene).c_str(), plan.pattern.c_str(),
                common::printable(world.volumes[v].name).c_str());
  }
  print_materials(world, facts);
}

/// Scenes of one structure share their code when they are bound to data.
void print_structures(const Geometry& geometry) {
  struct Structure {
    std::uint64_t scenes = 0, touchables = 0;
    std::string example;
  };
  const WorldFacts facts = analyse_world(geometry);
  std::map<std::string, Structure> structures;
  std::uint64_t scenes = 0;
  for (std::size_t v = 0; v < facts.reachable.size(); ++v) {
    if (!facts.reachable[v]) continue;
    const auto volume = static_cast<VolumeId>(v);
    Structure& s = structures[codegen::structure_of(geometry, plan_scene(geometry, facts, volume))];
    if (s.scenes++ == 0) s.example = geometry.world().volumes[v].name;
    s.touchables += facts.touchables[v];
    ++scenes;
  }
  std::vector<std::pair<std::string, Structure>> sorted(structures.begin(), structures.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second.scenes > b.second.scenes; });
  std::printf("%llu scenes, %zu structures\n\n%8s %10s %-52s %s\n",
              static_cast<unsigned long long>(scenes), sorted.size(), "scenes", "touchables",
              "structure", "for instance");
  for (const auto& [name, s] : sorted) {
    std::printf("%8llu %10llu %-52s %s\n", static_cast<unsigned long long>(s.scenes),
                static_cast<unsigned long long>(s.touchables), name.c_str(),
                common::printable(s.example).c_str());
  }
}

int inspect(const Options& options) {
  GdmlReport report;
  // The list of volumes has the notes in it, and elsewhere they are logged.
  const bool lists = !options.structures && options.scene.empty();
  const Geometry geometry(lists ? read(options.detector, report) : read(options.detector),
                          options.geometry);
  if (options.structures) {
    print_structures(geometry);
  } else if (options.scene.empty()) {
    print_world(geometry, options.detector.file, report);
  } else {
    print_scene(geometry, options.scene, options.emit);
  }
  return 0;
}

}  // namespace

void add_inspect(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("inspect", "What is in a detector");
  add_detector(command, options->detector);
  command.add_option("--scene", options->scene, "analysis of one logical volume")
      ->check(not_empty());
  command.add_flag("--emit", options->emit, "print the scene's generated source")->needs("--scene");
  command.add_flag("--structures", options->structures, "what the scenes have in common")
      ->excludes("--scene");
  add_boxes(command, options->geometry);
  command.callback([options, &action] { action = [options] { return inspect(*options); }; });
}

}  // namespace navjit::apps

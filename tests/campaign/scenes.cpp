// Random scenes of rotated solids: steps of navjit and of VecGeom are compared with the reference.
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "common/rays.hpp"
#include "geometry/gdml/read_world.hpp"
#include "geometry/reference/wide_geometry.hpp"
#include "tests/campaign/random_scene.hpp"
#include "tests/campaign/starts.hpp"
#include "tests/reference/trace.hpp"

namespace {

using namespace navjit;
using reference::Comparison;
using reference::Trace;
namespace fs = std::filesystem;

/// The results of one engine in all scenes.
struct Engine {
  const char* name;
  reference::Criteria criteria;
  std::size_t scenes = 0, failed = 0, rays = 0, stuck = 0, differing = 0, steps = 0;
  std::map<std::string, std::size_t> kinds{};  ///< of the volumes where traces part

  /// Of the traces, the reference's comes first.
  void add(const Trace& truth, const Trace& made) {
    const Comparison c = compare(truth, made, criteria, truth.size());
    ++scenes;
    rays += c.rays;
    stuck += c.stuck_theirs;
    differing += c.differing;
    steps += c.steps;
    for (const reference::Difference& d : c.differences) {
      const std::string& words = d.ours.starts_with("has left") ? d.theirs : d.ours;
      std::string volume = words.substr(words.rfind(' ') + 1);
      ++kinds[volume.substr(0, volume.find('_'))];
    }
  }
  void print() const {
    const auto per_mille = [&](std::size_t n) {
      return rays == 0 ? 0.0 : 1e3 * static_cast<double>(n) / static_cast<double>(rays);
    };
    std::printf("| %s | %zu | %zu | %zu | %zu | %zu | %.3f | %zu | %.3f |\n", name, scenes, failed,
                rays, steps, stuck, per_mille(stuck), differing, per_mille(differing));
  }
  nlohmann::json json() const {
    return {{"scenes", scenes}, {"failed", failed},       {"rays", rays},  {"steps", steps},
            {"stuck", stuck},   {"differing", differing}, {"kinds", kinds}};
  }
};

Trace reference_trace(const std::shared_ptr<const World>& world, const std::vector<Ray>& rays) {
  const reference::WideGeometry geometry(world);
  Trace trace(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    bool stuck = false;
    for (const auto& step : geometry.trace(rays[i].position, rays[i].direction, stuck)) {
      trace[i].push_back(
          {world->volumes[step.volume].name, static_cast<double>(step.length), false});
    }
    if (stuck) trace[i].back().stuck = true;
  }
  return trace;
}

void write_rays(const fs::path& path, const World& world, std::uint64_t seed, std::size_t count) {
  std::ofstream out(path);
  out << "x,y,z,dx,dy,dz\n";
  char row[200];
  for (std::size_t i = 0; i < count; ++i) {
    const Ray ray = campaign::make_plain_ray(world, seed, i);
    const Vec3 &p = ray.position, &v = ray.direction;
    std::snprintf(row, sizeof row, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", p.x, p.y, p.z, v.x, v.y,
                  v.z);
    out << row;
  }
  if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

/// VecGeom may crash, so it runs in a process of its own. Paths must not hold quotes.
bool run_vecgeom(const std::string& command, const std::string& navigator, const fs::path& scene,
                 const fs::path& rays, const fs::path& out) {
  const std::string line = "'" + command + "' '" + scene.string() + "' '" + rays.string() + "' '" +
                           out.string() + "' " + navigator + " > /dev/null";
  const int status = std::system(line.c_str());
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Random scenes: navjit and VecGeom against a reference of 113 bits.");
  std::uint64_t seed = 1, scenes = 100;
  std::size_t rays = 1000;
  int solids = 600;
  std::vector<std::string> kinds = campaign::scene_kinds();
  std::string vecgeom, navigator = "automatic", json_file, keep;
  std::size_t examples = 3;
  app.add_option("--scenes", scenes, "How many");
  app.add_option("--rays", rays, "Rays per scene");
  app.add_option("--solids", solids, "Solids per scene, at most");
  app.add_option("--seed", seed, "Of the first scene; the next ones follow");
  app.add_option("--kinds", kinds, "Kinds of solids")->delimiter(',');
  app.add_option("--vecgeom", vecgeom, "The program vecgeom_trace, to compare it as well");
  app.add_option("--navigator", navigator, "VecGeom's")
      ->check(CLI::IsMember({"simple", "abbox", "hybrid", "bvh", "automatic"}));
  app.add_option("--examples", examples, "Differences to show per scene");
  app.add_option("--keep", keep, "Folder to leave the scenes and rays in");
  app.add_option("--json", json_file, "Where to write a report");
  CLI11_PARSE(app, argc, argv);

  // VecGeom's steps into and out of booleans are wrong by its push of 1e-6 mm; that is not counted.
  Engine ours{"navjit", {.sliver = 1e-6, .length = 1e-6}};
  Engine strict{"navjit, to 1e-8 mm", {.sliver = 1e-8, .length = 1e-8}};
  Engine theirs{"VecGeom", {.sliver = 1.1e-6, .length = 2.2e-6}};
  const fs::path folder =
      keep.empty() ? fs::temp_directory_path() / ("navjit_scenes_" + std::to_string(getpid()))
                   : fs::path(keep);
  try {
    fs::create_directories(folder);
    for (std::uint64_t i = 0; i < scenes; ++i) {
      const std::string name = "scene" + std::to_string(seed + i);
      const fs::path file = folder / (name + ".gdml"),
                     their_file = folder / (name + ".vecgeom.gdml"),
                     ray_file = folder / (name + ".rays.csv"),
                     trace_file = folder / (name + ".vecgeom.csv");
      std::ofstream(file) << campaign::random_scene(seed + i, solids, kinds);
      const auto world = std::make_shared<const World>(read_world(file));
      write_rays(ray_file, *world, seed + i, rays);
      // Both sides normalise the directions that they read.
      const std::vector<Ray> read = common::read_rays(ray_file);
      const Trace truth = reference_trace(world, read);
      const Trace made = reference::make_trace(world, read, JitMode::off);
      ours.add(truth, made);
      strict.add(truth, made);
      if (const auto c = compare(truth, made, ours.criteria, examples); c.differing > 0) {
        std::cerr << name << ": " << c << '\n';
      }
      if (vecgeom.empty()) continue;
      std::ofstream(their_file) << campaign::random_scene(seed + i, solids, kinds, true);
      if (run_vecgeom(vecgeom, navigator, their_file, ray_file, trace_file)) {
        theirs.add(truth, reference::read_trace(trace_file, read.size()));
      } else {
        ++theirs.failed;
      }
    }
    if (keep.empty()) fs::remove_all(folder);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "navjit_scenes: %s\n", e.what());
    return 1;
  }

  std::printf(
      "| engine | scenes | not served | rays | steps | stuck | per 1000 | differing | per 1000 |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  ours.print();
  strict.print();
  if (!vecgeom.empty()) {
    theirs.print();
    std::printf("\nVecGeom parts from the reference in:");
    for (const auto& [kind, count] : theirs.kinds) std::printf(" %s %zu", kind.c_str(), count);
    std::printf("\n");
  }
  if (!json_file.empty()) {
    const nlohmann::json report{
        {"navjit", ours.json()}, {"navjit_strict", strict.json()}, {"vecgeom", theirs.json()}};
    std::ofstream(json_file) << report.dump(1) << '\n';
  }
  return ours.differing == 0 && ours.stuck == 0 && ours.rays > 0 ? 0 : 1;
}

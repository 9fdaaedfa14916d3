// `navjit specialise`, `navjit profile`, `navjit plugin`: navigators made ahead of time.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "analysis/plan.hpp"
#include "apps/commands.hpp"
#include "apps/read_detector.hpp"
#include "runtime/make_plugin.hpp"
#include "runtime/plugin_text.hpp"

namespace navjit::apps {
namespace {

std::vector<VolumeId> named_scenes(const Geometry& geometry, const WorldFacts& facts,
                                   const std::vector<std::string>& names) {
  const World& world = geometry.world();
  std::vector<VolumeId> scenes;
  for (const std::string& name : names) {
    bool found = false;
    for (VolumeId v = 0; v < geometry.size(); ++v) {
      if (world.volumes[v].name != name || !facts.reachable[v]) continue;
      found = true;
      std::string why;
      if (!worth_compiling(geometry, plan_scene(geometry, facts, v), &why)) {
        throw std::runtime_error("scene '" + name + "' is not worth compiling: " + why);
      }
      scenes.push_back(v);
    }
    if (!found) {
      throw std::runtime_error("no logical volume is called '" + name +
                               "'; navjit inspect without --scene lists them");
    }
  }
  return scenes;
}

}  // namespace

int specialise(const SpecialiseOptions& options) {
  const Geometry geometry(read_detector(options.detector, options.setup));
  const WorldFacts facts = analyse_world(geometry);
  std::vector<VolumeId> scenes = named_scenes(geometry, facts, options.scenes);
  if (!options.profile.empty()) {
    const StepProfile profile = read_profile(options.profile);
    try {
      const auto hot = hot_scenes(profile, geometry, facts, options.choice);
      scenes.insert(scenes.end(), hot.begin(), hot.end());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(options.profile + ": " + error.what());
    }
  }
  if (scenes.empty()) {
    throw std::runtime_error("no scene is hot enough and worth compiling; --least-share may help");
  }
  const std::string source = plugin_source(geometry, facts, scenes);
  if (options.source_only) {
    std::ofstream out(options.out, std::ios::binary);
    out << source;
    out.close();
    if (!out) throw std::runtime_error(options.out + ": " + std::strerror(errno));
  } else {
    const std::string problem = make_plugin(source, options.optimisation, options.out);
    if (!problem.empty()) throw std::runtime_error(problem);
  }
  std::printf("%zu scenes\n", scenes.size());
  return 0;
}

int merge_profiles(const MergeOptions& options) {
  StepProfile merged = read_profile(options.profiles.at(0));
  for (std::size_t i = 1; i < options.profiles.size(); ++i) {
    const StepProfile next = read_profile(options.profiles[i]);
    try {
      merged = merge(merged, next);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(options.profiles[0] + ", " + options.profiles[i] + ": " +
                               error.what());
    }
  }
  write_profile(merged, options.out);
  std::printf("%zu volumes, %llu runs\n", merged.volumes.size(),
              static_cast<unsigned long long>(merged.runs));
  return 0;
}

int seal_plugin(const std::string& path) {
  const std::string problem = navjit::seal_plugin(path);
  if (!problem.empty()) throw std::runtime_error(problem);
  return 0;
}

}  // namespace navjit::apps

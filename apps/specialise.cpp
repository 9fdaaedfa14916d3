// `navjit specialise`: navigators made ahead of time, as a plugin or as its source.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "analysis/plan.hpp"
#include "apps/commands.hpp"
#include "apps/options/detector.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/observe.hpp"
#include "apps/options/outputs.hpp"
#include "apps/options/runtime.hpp"
#include "files/output_file.hpp"
#include "navjit/errors.hpp"
#include "runtime/make_plugin.hpp"
#include "runtime/plugin_text.hpp"

namespace navjit::apps {
namespace {

struct Options {
  Detector detector;
  Observation observation;
  std::vector<std::string> scenes;  ///< logical volumes by name
  std::string profile;              ///< file; empty: the named scenes only
  PluginChoice choice;
  std::string emit;  ///< "so" or "cpp"
  PluginCode code;
  std::string out;
};

std::vector<VolumeId> named_scenes(const Geometry& geometry, const WorldFacts& facts,
                                   const std::vector<std::string>& names) {
  const World& world = geometry.world();
  std::vector<VolumeId> scenes;
  for (const std::string& name : names) {
    bool found = false;
    for (VolumeId v = 0; v < geometry.size(); ++v) {
      if (world.volumes[v].name != name || !facts.reachable[v]) continue;
      found = true;
      if (const Worth worth = worth_compiling(geometry, plan_scene(geometry, facts, v)); !worth) {
        throw Error("scene '" + name + "' is not worth compiling: " + std::string(worth.why));
      }
      // Each once, whichever volumes are alike and however often they are named.
      const VolumeId scene = facts.first_equal[v];
      if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) scenes.push_back(scene);
    }
    if (!found) {
      throw Error("no logical volume is called '" + name +
                  "'; navjit inspect without --scene lists them");
    }
  }
  return scenes;
}

int specialise(const Options& options) {
  const bool source_only = options.emit == "cpp";
  OutputFile out(options.out, source_only ? std::nullopt : std::optional(plugin_mode));
  const ObservedDetector seen(read(options.detector), options.observation);
  const Geometry geometry(seen.detector().model());
  const WorldFacts facts = analyse_world(geometry);
  std::vector<VolumeId> scenes = named_scenes(geometry, facts, options.scenes);
  if (!options.profile.empty()) {
    const StepProfile profile = read_profile(options.profile);
    try {
      const auto hot = hot_scenes(profile, geometry, facts, options.choice);
      scenes.insert(scenes.end(), hot.begin(), hot.end());
    } catch (const Error& error) {
      throw Error(options.profile + ": " + error.what());
    }
  }
  if (scenes.empty()) {
    throw Error("no scene is hot enough and worth compiling; --least-share may help");
  }
  const std::string source = plugin_source(geometry, facts, scenes);
  if (source_only) {
    out.write(source);
  } else {
    const auto plugin = plugin_bytes(source, options.code);
    if (!plugin) throw Error(plugin.failure().message);
    out.write(*plugin);
  }
  out.finish();
  std::printf("%zu scene%s\n", scenes.size(), scenes.size() == 1 ? "" : "s");
  return 0;
}

}  // namespace

void add_specialise(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command =
      *app.add_subcommand("specialise", "Make a plugin of navigators ahead of time");
  add_detector(command, options->detector);
  add_observe(command, options->observation);
  CLI::Option* scenes =
      command.add_option("--scene", options->scenes, "logical volumes")->option_text("NAME...");
  command.add_option("--profile", options->profile, "of navjit run --save-profile")
      ->excludes(scenes)
      ->check(not_empty())
      ->option_text("FILE");
  command
      .add_option("--least-share", options->choice.least_share,
                  "of a profile's steps, for a scene to be taken (default: 0.001)")
      ->check(number(0, 1))
      ->option_text("SHARE");
  command.add_option("--emit", options->emit, "so (a plugin) or cpp (its source)")
      ->required()
      ->check(one_of({"so", "cpp"}))
      ->option_text("cpp|so");
  command.add_option("--opt", options->code.optimisation, "of the compiler, 0 to 3 (default: 2)")
      ->transform(count(0, 3))
      ->option_text("N");
  add_isa(command, options->code.instruction_set);
  add_output(command, "-o,--out", options->out, "file to write")->required();
  command.callback([options, &action] {
    if (options->scenes.empty() && options->profile.empty()) {
      throw CLI::ValidationError("specialise", "--scene or --profile is needed");
    }
    refuse_same_files({{"-o", options->out}},
                      {{"the detector", options->detector.file}, {"--profile", options->profile}});
    action = [options] { return specialise(*options); };
  });
}

}  // namespace navjit::apps

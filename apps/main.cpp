// The `navjit` command: reads the command line, calls the commands, turns exceptions into one line.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>

#include "apps/boxes_option.hpp"
#include "apps/commands.hpp"

namespace {

using namespace navjit;

const std::map<std::string, JitMode> jit_modes{{"off", JitMode::off},
                                               {"on", JitMode::on},
                                               {"wait", JitMode::wait},
                                               {"shadow", JitMode::shadow}};
const std::map<std::string, Level> levels{
    {"exact", Level::exact}, {"fast", Level::fast}, {"single", Level::single}};
const std::map<std::string, InstructionSet> instruction_sets{{"native", InstructionSet::native},
                                                             {"sse4.2", InstructionSet::sse42},
                                                             {"avx2", InstructionSet::avx2},
                                                             {"avx512", InstructionSet::avx512}};

void add_boxes(CLI::App* command, GeometryOptions& options) {
  command
      ->add_option_function<std::string>(
          "--boxes",
          [&options](const std::string& text) {
            try {
              apps::parse_boxes(text, options);
            } catch (const std::invalid_argument& error) {
              throw CLI::ValidationError("--boxes", error.what());
            }
          },
          "how daughters' boxes are searched: auto, linear, two-level or\nregular-tree, the last "
          "two with :surface, :k-means or :furthest")
      ->option_text("[VOLUME=]SEARCH,...");
}

/// "off", or a directory; the environment variable serves those who cannot change a command line.
void add_cache(CLI::App* command, Cache& cache, bool may_be_off) {
  cache = Cache::user_default();
  command
      ->add_option_function<std::string>(
          "--cache",
          [&cache](const std::string& text) { cache = text == "off" ? Cache{} : Cache::in(text); },
          may_be_off ? "of compiled code: a directory, or off (default: the user's)"
                     : "directory (default: the user's)")
      ->envname("NAVJIT_CACHE")
      ->option_text(may_be_off ? "DIR|off" : "DIR");
}

/// What the answers and the code shall be like.
void add_code_options(CLI::App* command, RuntimeOptions& options) {
  command
      ->add_option("--level", options.level,
                   "accuracy: exact, fast or single (at present all exact)")
      ->transform(CLI::CheckedTransformer(levels).description(""))
      ->option_text("LEVEL");
  command
      ->add_option("--isa", options.specialiser.instruction_set,
                   "instructions of generated code: native, sse4.2, avx2 or avx512")
      ->transform(CLI::CheckedTransformer(instruction_sets).description(""))
      ->option_text("SET");
  command->add_option("--nice", options.specialiser.nice, "priority of the compiler's thread")
      ->check(CLI::Range(0, 19))
      ->option_text("0..19");
}

void add_runtime_options(CLI::App* command, RuntimeOptions& options) {
  options.specialiser.safety = false;  // the commands' rays never ask for it
  add_cache(command, options.cache, true);
  command->add_option("--jit", options.jit, "off, on, wait (specialise first) or shadow (compare)")
      ->transform(CLI::CheckedTransformer(jit_modes).description(""))
      ->option_text("MODE");
  command->add_option("--plugin", options.plugin, "made by navjit specialise; used from the start")
      ->option_text("FILE");
  add_code_options(command, options);
  command->add_option("--opt", options.specialiser.optimisation, "compiler's optimisation, 0 to 3")
      ->check(CLI::Range(0, 3))
      ->option_text("N");
  command->add_flag("--perf-map", options.specialiser.perf_map,
                    "name generated functions for perf (/tmp/perf-PID.map)");
  add_boxes(command, options.geometry);
}

void add_detector(CLI::App* command, std::string& detector, std::string& setup) {
  command->add_option("detector", detector, "GDML file")->required();
  command->add_option("--setup", setup, "which <setup> of the file (default: its default)")
      ->option_text("NAME");
}

void add_threads(CLI::App* command, unsigned& threads) {
  command->add_option("--threads", threads, "navigating threads")
      ->check(CLI::Range(1U, 1024U))
      ->option_text("T");
}

/// "a,b,c" as numbers. Throws CLI::ValidationError.
std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count) {
  std::vector<double> values;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string field = text.substr(at, comma - at);
    char* end = nullptr;
    values.push_back(std::strtod(field.c_str(), &end));
    if (field.empty() || *end != '\0' || !std::isfinite(values.back())) {
      throw CLI::ValidationError(option, "'" + field + "' is not a finite number");
    }
    at = comma + 1;
  }
  if (values.size() != count) {
    throw CLI::ValidationError(option, std::to_string(count) + " numbers with commas are needed");
  }
  return values;
}

void add_source(CLI::App* command, std::string& origin, std::string& eta) {
  command->add_option("--origin", origin, "start of all rays, mm (default: over the world)")
      ->option_text("X,Y,Z");
  command->add_option("--eta", eta, "pseudorapidity about +z (default: isotropic)")
      ->option_text("LO,HI");
}

/// Throws CLI::ValidationError.
void set_source(apps::RaySource& source, const std::string& origin, const std::string& eta) {
  if (!origin.empty()) {
    const auto v = numbers("--origin", origin, 3);
    source.origin = Vec3{v[0], v[1], v[2]};
  }
  if (!eta.empty()) {
    const auto v = numbers("--eta", eta, 2);
    source.eta = {v[0], v[1]};
  }
}

/// CLI::Range lets through what is no number.
CLI::Validator within(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) {
        double value = 0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
        return good
                   ? std::string()
                   : text + " is not within " + std::to_string(low) + " to " + std::to_string(high);
      },
      "");
}

/// The options of a command that were given, as they were given.
std::vector<std::string> words_given(const CLI::App* command,
                                     const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (const std::string& name : names) {
    const CLI::Option* option = command->get_option(name);
    if (option->count() == 0) continue;
    if (name[0] == '-') words.push_back(name);
    words.push_back(option->results().at(0));
  }
  return words;
}

void add_warmup(CLI::App* command, apps::WarmupOptions& options) {
  add_detector(command, options.detector, options.setup);
  command->add_option("--seconds", options.seconds, "of each run")
      ->check(within(0.05, 3600.0))
      ->option_text("S");
  command
      ->add_option("--prime", options.prime_seconds,
                   "seconds of the run that fills the cache and makes the\nplugin's profile")
      ->check(within(0.05, 3600.0))
      ->option_text("S");
  command->add_option("--repetitions", options.repetitions, "of each run, in turn")
      ->check(CLI::Range(1, 1000))
      ->option_text("N");
  command->add_option("--interval", options.interval, "between points of the series, s")
      ->check(within(0.001, 10.0))
      ->option_text("S");
  command->add_option("--modes", options.modes, "of cold, cache and plugin; off is always there")
      ->delimiter(',')
      ->check(CLI::IsMember({"cold", "cache", "plugin"}).description(""))
      ->option_text("LIST");
  command->add_option("--opt", options.optimisations, "compiler's optimisations to compare")
      ->delimiter(',')
      ->check(CLI::Range(0, 3))
      ->option_text("LIST");
  command->add_option("--report", options.report, "write a JSON report")->option_text("FILE");
  command->add_option("--csv", options.csv, "write every point")->option_text("FILE");
  command->add_option("--picture", options.picture, "speed and share against time; by gnuplot")
      ->option_text("FILE.svg|.png");
  add_threads(command, options.threads);
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Particle transport through detectors, with navigators written while it runs"};
  app.name("navjit");
  app.require_subcommand(1);
  bool verbose = false;
  app.add_flag("-v,--verbose", verbose, "log decisions");

  apps::InspectOptions inspect;
  CLI::App* inspect_command = app.add_subcommand("inspect", "What is in a detector");
  add_detector(inspect_command, inspect.detector, inspect.setup);
  inspect_command->add_option("--scene", inspect.scene, "analysis of one logical volume");
  inspect_command->add_flag("--emit", inspect.emit, "print the scene's generated source")
      ->needs("--scene");
  add_boxes(inspect_command, inspect.geometry);

  apps::RunOptions run;
  std::string origin, eta;
  CLI::App* run_command = app.add_subcommand("run", "Transport rays with the JIT on");
  add_detector(run_command, run.detector, run.setup);
  run_command
      ->add_option("--budget", run.runtime.budget,
                   "how far from its surface a step may end: told scene by scene")
      ->check(CLI::PositiveNumber)
      ->option_text("MM");
  run_command->add_option("--rays", run.rays, "number of rays")->check(CLI::PositiveNumber);
  run_command->add_option("--seed", run.source.seed, "of the random rays");
  add_source(run_command, origin, eta);
  run_command->add_option("--report", run.report, "write a JSON report")->option_text("FILE");
  run_command->add_option("--save-profile", run.save_profile, "write what navjit specialise needs")
      ->option_text("FILE");
  add_threads(run_command, run.threads);
  add_runtime_options(run_command, run.runtime);

  apps::TraceOptions trace;
  CLI::App* trace_command = app.add_subcommand("trace", "Write every step of every ray");
  add_detector(trace_command, trace.detector, trace.setup);
  trace_command->add_option("--rays", trace.rays, "CSV file of rays, or their number")
      ->required()
      ->option_text("FILE|N");
  trace_command->add_option("--seed", trace.seed, "of random rays");
  trace_command->add_option("--out", trace.out, "CSV file (default: standard output)")
      ->option_text("FILE");
  add_threads(trace_command, trace.threads);
  add_runtime_options(trace_command, trace.runtime);

  apps::CheckOptions check;
  CLI::App* check_command = app.add_subcommand("check", "Find overlaps and protrusions");
  add_detector(check_command, check.detector, check.setup);
  check_command->add_option("--resolution", check.resolution, "points on each daughter's surface")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000000}))
      ->option_text("N");
  check_command->add_option("--tolerance", check.tolerance, "mm; shallower ones are not told")
      ->check(CLI::NonNegativeNumber)
      ->option_text("MM");

  apps::CacheOptions cache;
  CLI::App* cache_command = app.add_subcommand("cache", "Look after compiled code");
  cache_command->require_subcommand(1);
  add_cache(cache_command, cache.cache, false);
  const auto add_action = [&](const char* name, const char* what, apps::CacheAction action) {
    cache_command->add_subcommand(name, what)->fallthrough()->callback([&cache, action] {
      cache.action = action;
    });
  };
  add_action("list", "what is in it, last used first", apps::CacheAction::list);
  add_action("verify", "check every entry; exit status 1 if one is damaged",
             apps::CacheAction::verify);
  add_action("clear", "remove all entries", apps::CacheAction::clear);
  add_action("path", "where it is", apps::CacheAction::path);

  apps::SpecialiseOptions specialise;
  CLI::App* specialise_command =
      app.add_subcommand("specialise", "Make a plugin of navigators ahead of time");
  add_detector(specialise_command, specialise.detector, specialise.setup);
  CLI::Option* scenes =
      specialise_command->add_option("--scene", specialise.scenes, "logical volumes")
          ->option_text("NAME...");
  CLI::Option* profile =
      specialise_command
          ->add_option("--profile", specialise.profile, "of navjit run --save-profile")
          ->option_text("FILE");
  scenes->excludes(profile);
  specialise_command
      ->add_option("--least-share", specialise.choice.least_share,
                   "of a profile's steps, for a scene to be taken")
      ->check(CLI::Range(0.0, 1.0))
      ->option_text("SHARE");
  std::string emit;
  specialise_command->add_option("--emit", emit, "so (a plugin) or cpp (its source)")
      ->required()
      ->check(CLI::IsMember({"so", "cpp"}).description(""))
      ->option_text("cpp|so");
  specialise_command->add_option("--opt", specialise.optimisation, "of the compiler, 0 to 3")
      ->check(CLI::Range(0, 3))
      ->option_text("N");
  specialise_command->add_option("-o,--out", specialise.out, "file to write")
      ->required()
      ->option_text("FILE");

  apps::MergeOptions merge;
  CLI::App* profile_command = app.add_subcommand("profile", "Profiles of several runs");
  profile_command->require_subcommand(1);
  CLI::App* merge_command = profile_command->add_subcommand("merge", "add profiles up");
  merge_command->add_option("profiles", merge.profiles, "files")->required();
  merge_command->add_option("-o,--out", merge.out, "file to write")
      ->required()
      ->option_text("FILE");

  std::string library;
  CLI::App* plugin_command = app.add_subcommand("plugin", "Plugins that were compiled elsewhere");
  plugin_command->require_subcommand(1);
  plugin_command->add_subcommand("seal", "make a plugin of a shared library")
      ->add_option("library", library, "file, changed in place")
      ->required();

  apps::AccuracyOptions accuracy;
  std::string accuracy_origin, accuracy_eta;
  CLI::App* accuracy_command =
      app.add_subcommand("accuracy", "Hold every step against 113 bits: error and speed by level");
  add_detector(accuracy_command, accuracy.detector, accuracy.setup);
  accuracy_command->add_option("--rays", accuracy.rays, "CSV file of rays, or their number")
      ->option_text("FILE|N");
  accuracy_command->add_option("--seed", accuracy.source.seed, "of the random rays");
  add_source(accuracy_command, accuracy_origin, accuracy_eta);
  accuracy_command->add_option("--repetitions", accuracy.repetitions, "of the timing")
      ->check(CLI::Range(1, 1000));
  accuracy_command->add_option("--boundaries", accuracy.boundaries, "on the long track; 0: none");
  accuracy_command->add_option("--scenes", accuracy.scenes, "in the table");
  accuracy_command->add_option("--report", accuracy.report, "write a JSON report")
      ->option_text("FILE");
  accuracy_command->add_option("--picture", accuracy.picture, "speed against error; by gnuplot")
      ->option_text("FILE.svg|.png");
  accuracy_command
      ->add_option("--vecgeom", accuracy.vecgeom,
                   "the program vecgeom_trace, or off (default: the one\nbeside navjit)")
      ->option_text("PROGRAM|off");
  accuracy_command
      ->add_option("--vecgeom-detector", accuracy.vecgeom_detector,
                   "the same detector, as VecGeom can read it")
      ->option_text("FILE");
  accuracy_command->add_option("--vecgeom-navigator", accuracy.vecgeom_navigator, "of VecGeom")
      ->check(CLI::IsMember({"simple", "abbox", "hybrid", "bvh", "automatic"}))
      ->option_text("NAME");
  accuracy_command
      ->add_option("--vecgeom-seconds", accuracy.vecgeom_seconds, "for each of its runs")
      ->check(CLI::PositiveNumber)
      ->option_text("S");
  add_threads(accuracy_command, accuracy.threads);
  add_boxes(accuracy_command, accuracy.geometry);

  apps::WarmupOptions warmup;
  apps::RaySource warmup_source;
  RuntimeOptions warmup_code;
  std::string warmup_origin, warmup_eta;
  CLI::App* warmup_command =
      app.add_subcommand("warmup", "What the JIT costs before it pays: steps/s against time");
  add_warmup(warmup_command, warmup);
  warmup_command->add_option("--seed", warmup_source.seed, "of the random rays");
  add_source(warmup_command, warmup_origin, warmup_eta);
  add_code_options(warmup_command, warmup_code);

  warmup::RunSetup one_run;
  std::string one_run_origin, one_run_eta;
  CLI::App* one_run_command = app.add_subcommand("warmup-run", "One run of navjit warmup");
  one_run_command->group("");  // for navjit itself
  add_detector(one_run_command, one_run.detector, one_run.setup);
  add_threads(one_run_command, one_run.threads);
  one_run_command->add_option("--seed", one_run.source.seed);
  add_source(one_run_command, one_run_origin, one_run_eta);
  one_run_command->add_option("--seconds", one_run.seconds)->check(within(0.05, 3600.0));
  one_run_command->add_option("--interval", one_run.interval)->check(within(0.001, 10.0));
  one_run_command->add_option("--save-profile", one_run.save_profile);
  add_runtime_options(one_run_command, one_run.runtime);

  try {
    app.parse(argc, argv);
    if (*specialise_command && specialise.scenes.empty() && specialise.profile.empty()) {
      throw CLI::ValidationError("specialise", "--scene or --profile is needed");
    }
    specialise.source_only = emit == "cpp";
    set_source(run.source, origin, eta);
    set_source(accuracy.source, accuracy_origin, accuracy_eta);
    set_source(warmup_source, warmup_origin, warmup_eta);
    set_source(one_run.source, one_run_origin, one_run_eta);
    warmup.words =
        words_given(warmup_command, {"detector", "--setup", "--threads", "--seed", "--origin",
                                     "--eta", "--interval", "--level", "--isa", "--nice"});
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::Error& error) {
    std::fprintf(stderr, "navjit: %s; see navjit --help\n", error.what());
    return 2;
  }
  spdlog::set_default_logger(spdlog::stderr_color_mt("navjit"));
  spdlog::set_level(verbose ? spdlog::level::debug : spdlog::level::warn);
  if (*inspect_command) return apps::inspect(inspect);
  if (*run_command) return apps::run(run);
  if (*check_command) return apps::check(check);
  if (*cache_command) return apps::cache(cache);
  if (*specialise_command) return apps::specialise(specialise);
  if (*profile_command) return apps::merge_profiles(merge);
  if (*plugin_command) return apps::seal_plugin(library);
  if (*accuracy_command) return apps::accuracy(accuracy);
  if (*warmup_command) return apps::warmup(warmup);
  if (*one_run_command) return apps::warmup_run(one_run);
  return apps::trace(trace);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navjit: %s\n", error.what());
    return 1;
  }
}

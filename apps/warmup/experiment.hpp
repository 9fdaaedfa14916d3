// The experiment "JIT warm-up versus speed-up": the same rays without the JIT, with it cold, with
// what an earlier run left in the cache, and with a plugin; each run in a process of its own, in
// turn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/warmup/one_run.hpp"

namespace navjit::warmup {

enum class Mode : std::uint8_t { off, cold, cache, plugin };
const char* mode_name(Mode mode);

/// A way to run, with what the command line of its process has in addition.
struct Variant {
  std::string name;  ///< "off", "cold", or with what was varied: "cold -O1"
  Mode mode = Mode::off;
  std::vector<std::string> words;
};

struct ExperimentOptions {
  std::string program;             ///< navjit
  std::vector<std::string> words;  ///< of every run: detector, rays, threads, seconds
  /// Those of them that `navjit specialise` takes, too: its plugin has to be of the same code.
  std::vector<std::string> plugin_words;
  std::vector<Variant> variants;  ///< the first has mode `off`
  int repetitions = 5;
  double seconds = 5;         ///< of a run
  double prime_seconds = 10;  ///< of the run that fills the cache and makes the plugin's profile
  double patience = 120;      ///< beyond that, until a process is given up, s
};

/// What follows from one run and the one without JIT of the same repetition.
struct RunFigures {
  RunRecord record;
  std::optional<double> break_even_s, half_s, most_s;  ///< of shares 50% and 90%
  double share = 0;             ///< of steps in scenes that are specialised in the end
  double steps_per_second = 0;  ///< whole run
  /// Of the last quarter, in processor time of the navigating threads; nothing if one of both runs
  /// made no step there.
  std::optional<double> speed_up;
};

struct VariantReport {
  Variant variant;
  std::vector<RunFigures> runs;  ///< by repetition
};

struct ExperimentReport {
  std::vector<VariantReport> variants;
  double prepare_s = 0;  ///< filling caches and making plugins, wall clock
  /// Rays that two runs both made have the same steps and lengths: all that are in blocks which
  /// both completed.
  bool same_rays = true;
  bool interrupted = false;  ///< by a signal: only the runs that came to their end before it
  std::string failure;       ///< which run failed, and why: only those before it; empty: none did
};

/// Throws Error, which names the process and has its last line, if one fails before any run has
/// come to its end, and common::Interrupted if a signal comes before that.
ExperimentReport run_experiment(const ExperimentOptions& options);

/// The command line that makes a variant's plugin of a profile.
std::vector<std::string> specialise_words(const ExperimentOptions& options, const Variant& variant,
                                          const std::string& profile, const std::string& plugin);

/// From the records alone; `off` is the run without JIT of the same repetition.
RunFigures figures_of(RunRecord record, const RunRecord& off);
/// No block of rays that both have complete differs.
bool same_rays(const RunRecord& a, const RunRecord& b);

}  // namespace navjit::warmup

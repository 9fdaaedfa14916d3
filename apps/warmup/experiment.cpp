#include "apps/warmup/experiment.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>

#include "common/child.hpp"
#include "common/interruption.hpp"
#include "navjit/errors.hpp"
#include "runtime/private_folder.hpp"

namespace navjit::warmup {
namespace {

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// `what` names the process where something has to be said of it.
std::string output_of(const std::string& what, const Words& words, double seconds) {
  common::ChildResult result = common::run_child(words, seconds);
  if (!result.good()) throw Error(what + ": " + result.words(seconds));
  if (!result.error.empty()) spdlog::warn("{}: {}", what, result.error);
  return std::move(result.output);
}

/// What a variant needs before it is timed.
struct Prepared {
  std::string cache, plugin;
};

/// A run that fills a cache, and a plugin of what was hot in it. Variants that differ in nothing
/// but the mode share both.
Prepared prepare(const ExperimentOptions& options, const Variant& variant,
                 const std::string& stem) {
  const Prepared prepared{stem + ".cache", stem + ".so"};
  const std::string profile = stem + ".json";
  const double limit = options.prime_seconds + options.patience;
  output_of("the run that prepares '" + variant.name + "'",
            Words{options.program, "warmup-run"} + options.words + variant.words +
                Words{"--seconds", std::to_string(options.prime_seconds), "--cache", prepared.cache,
                      "--save-profile", profile},
            limit);
  output_of("making the plugin of '" + variant.name + "'",
            specialise_words(options, variant, profile, prepared.plugin), limit);
  return prepared;
}

Words words_of(const Variant& variant, const Prepared& prepared) {
  switch (variant.mode) {
    case Mode::off:
      return {"--jit", "off", "--cache", "off"};
    case Mode::cold:
      return variant.words + Words{"--cache", "off"};
    case Mode::cache:
      return variant.words + Words{"--cache", prepared.cache};
    case Mode::plugin:
      return variant.words + Words{"--cache", "off", "--plugin", prepared.plugin};
  }
  return {};
}

}  // namespace

Words specialise_words(const ExperimentOptions& options, const Variant& variant,
                       const std::string& profile, const std::string& plugin) {
  return Words{options.program, "specialise"} + options.plugin_words + variant.words +
         Words{"--profile", profile, "--emit", "so", "-o", plugin};
}

const char* mode_name(Mode mode) {
  switch (mode) {
    case Mode::off:
      return "off";
    case Mode::cold:
      return "cold";
    case Mode::cache:
      return "cache";
    case Mode::plugin:
      return "plugin";
  }
  return "";
}

bool same_rays(const RunRecord& a, const RunRecord& b) {
  const std::size_t both = std::min(a.blocks.size(), b.blocks.size());
  return std::equal(a.blocks.begin(), a.blocks.begin() + static_cast<std::ptrdiff_t>(both),
                    b.blocks.begin());
}

RunFigures figures_of(RunRecord record, const RunRecord& off) {
  RunFigures figures;
  figures.record = std::move(record);
  const RunRecord& r = figures.record;
  figures.break_even_s = break_even(r.series, off.series);
  figures.half_s = time_of_share(r.swaps, 0.5);
  figures.most_s = time_of_share(r.swaps, 0.9);
  const double end = r.series.empty() ? 0 : r.series.back().seconds;
  figures.share = share_at(r.swaps, end);
  figures.steps_per_second = rate(r.series, 0, end);
  const double off_end = off.series.empty() ? 0 : off.series.back().seconds;
  const double off_rate = processor_rate(off.series, 0.75 * off_end, off_end);
  const double own_rate = processor_rate(r.series, 0.75 * end, end);
  if (off_rate > 0 && own_rate > 0) figures.speed_up = own_rate / off_rate;
  return figures;
}

namespace {

RunRecord record_of(const std::string& what, const Words& words, double seconds) {
  const std::string text = output_of(what, words, seconds);
  try {
    return from_text(text);
  } catch (const Error& error) {
    throw Error(what + ": " + error.what());
  }
}

/// The runs of all variants, in turn.
void make_runs(const ExperimentOptions& options, const std::map<Words, Prepared>& all_prepared,
               ExperimentReport& report) {
  RunRecord longest;  // agrees with all before it, as far as these went
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    std::optional<RunRecord> off;
    for (VariantReport& each : report.variants) {
      const auto found = all_prepared.find(each.variant.words);
      const Prepared prepared = found != all_prepared.end() ? found->second : Prepared{};
      RunRecord record =
          record_of("run " + std::to_string(repetition + 1) + " of '" + each.variant.name + "'",
                    Words{options.program, "warmup-run"} + options.words +
                        Words{"--seconds", std::to_string(options.seconds)} +
                        words_of(each.variant, prepared),
                    options.seconds + options.patience);
      if (!off) off = record;
      report.same_rays = report.same_rays && same_rays(longest, record);
      if (record.blocks.size() > longest.blocks.size()) longest = record;
      each.runs.push_back(figures_of(std::move(record), *off));
    }
  }
}

}  // namespace

ExperimentReport run_experiment(const ExperimentOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const PrivateFolder folder;
  ExperimentReport report;
  std::map<Words, Prepared> all_prepared;
  for (const Variant& variant : options.variants) {
    report.variants.push_back({variant, {}});
    if (variant.mode != Mode::cache && variant.mode != Mode::plugin) continue;
    if (all_prepared.contains(variant.words)) continue;
    const std::string stem = folder.path() + "/" + std::to_string(all_prepared.size());
    all_prepared[variant.words] = prepare(options, variant, stem);
  }
  report.prepare_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  try {
    make_runs(options, all_prepared, report);
  } catch (const common::Interrupted&) {
    if (report.variants[0].runs.empty()) throw;
    report.interrupted = true;
  } catch (const Error& error) {
    // The runs before it are worth as much as they were.
    if (report.variants[0].runs.empty()) throw;
    report.failure = error.what();
  }
  return report;
}

}  // namespace navjit::warmup

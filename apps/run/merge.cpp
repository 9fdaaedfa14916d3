#include "apps/run/merge.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/merge/reports.hpp"

namespace navjit::apps {
namespace {

using nlohmann::ordered_json;
using Series = std::vector<std::pair<double, std::uint64_t>>;

/// The value that has this name; the first where none has it.
template <class Value, std::size_t n>
Value named(const std::array<Value, n>& values, const char* (*name_of)(Value),
            const std::string& name) {
  for (const Value value : values) {
    if (name == name_of(value)) return value;
  }
  return values[0];
}

constexpr std::array bindings{Binding::generic, Binding::data, Binding::structure,
                              Binding::constants};
constexpr std::array statuses{SceneStatus::generic, SceneStatus::compiling,
                              SceneStatus::specialised, SceneStatus::unprofitable,
                              SceneStatus::failed};
constexpr std::array origins{CodeOrigin::none, CodeOrigin::compiler, CodeOrigin::cache,
                             CodeOrigin::plugin};

SceneReport scene_of(const ordered_json& row, const std::vector<SceneReport>& own) {
  SceneReport scene;
  scene.volume = row["volume"];
  scene.structure = row["structure"];
  for (const SceneReport& mine : own) {
    if (mine.volume == scene.volume && mine.structure == scene.structure) scene = mine;
  }
  scene.steps = row["steps"];
  scene.share = row["share"];
  scene.relocations = row["relocations"];
  scene.generic_ns_per_step = row["generic_ns_per_step"];
  scene.specialised_ns_per_step = row["specialised_ns_per_step"];
  scene.compile_ms = row["compile_ms"];
  scene.specialised_at_s = row["specialised_at_s"];
  scene.swapped_at_s = row["swapped_at_s"];
  scene.binding = named(bindings, binding_name, row["binding"]);
  scene.status = named(statuses, status_name, row["status"]);
  scene.origin = named(origins, origin_name, row["code"]);
  scene.compiled_solids = row["compiled_solids"];
  scene.note = row["note"];
  return scene;
}

void take(const ordered_json& sum, RunReport& report) {
  Transport& t = report.transport;
  t.rays = sum["rays"];
  t.steps = sum["steps"];
  t.stuck = sum["stuck"];
  t.outside = sum["outside"];
  t.bail_outs = sum["bail_outs"];
  t.differences = sum["differences"];
  t.length_mm = sum["length_mm"];
  t.threads = sum["threads"];
  t.seconds = sum["seconds"];
  t.cpu_seconds = sum["cpu_seconds"];
  t.warm_steps_per_second = sum["warm_steps_per_second"];
  report.interrupted = sum["interrupted"];
  report.compile_cpu_seconds = sum["compile_cpu_seconds"];
  report.compared.reset();
  if (const ordered_json& c = sum["compared"]; !c.is_null()) {
    report.compared =
        Comparison{c["rays"], c["steps_per_second_with"], c["steps_per_second_without"]};
  }
  RuntimeReport& r = report.runtime;
  r.steps = t.steps;
  r.modules = sum["modules"];
  r.cached_modules = sum["cached_modules"];
  r.plugin_scenes = sum["plugin_scenes"];
  r.deoptimised = sum["deoptimised"];
  r.compile_ms = sum["compile_ms"];
  r.code_bytes = sum["code_bytes"];
  const std::vector<SceneReport> own = std::move(r.scenes);
  r.scenes.clear();
  for (const ordered_json& row : sum["scenes"]) r.scenes.push_back(scene_of(row, own));
}

std::string text_of(const Series& series) {
  std::string text;
  for (const auto& [seconds, steps] : series) {
    char line[64];
    std::snprintf(line, sizeof line, "%.6f %llu\n", seconds,
                  static_cast<unsigned long long>(steps));
    text += line;
  }
  return text;
}

Series series_of(const std::string& text) {
  Series series;
  std::istringstream in(text);
  double seconds = 0;
  for (std::uint64_t steps = 0; in >> seconds >> steps;) series.emplace_back(seconds, steps);
  return series;
}

/// Steps of one process at a moment, on a straight line between those that were noted.
double steps_at(const Series& series, double seconds) {
  double from = 0, steps = 0;
  for (const auto& [at, count] : series) {
    const auto made = static_cast<double>(count);
    if (at >= seconds) {
      return at > from ? steps + (made - steps) * (seconds - from) / (at - from) : made;
    }
    from = at;
    steps = made;
  }
  return steps;
}

/// At the moments of the one that went on longest.
Series sum_of(const std::vector<Series>& all) {
  const Series* longest = &all.front();
  for (const Series& each : all) {
    if (!each.empty() && (longest->empty() || each.back().first > longest->back().first)) {
      longest = &each;
    }
  }
  Series sum;
  for (const auto& [seconds, own] : *longest) {
    double steps = 0;
    for (const Series& each : all) steps += steps_at(each, seconds);
    sum.emplace_back(seconds, static_cast<std::uint64_t>(steps));
  }
  return sum;
}

}  // namespace

Made gather(Processes& processes, const RunReport& report, const StepProfile& profile) {
  Series own = report.transport.series;
  own.emplace_back(report.transport.seconds, report.transport.steps);
  return {processes.gather(json_text(report)), processes.gather(profile_text(profile)),
          processes.gather(text_of(own))};
}

void merge(const Made& made, RunReport& report, StepProfile& profile) {
  ReportMerger merger;
  for (const std::string& text : made.reports) merger.add(nlohmann::json::parse(text));
  take(merger.merged(), report);
  report.processes = static_cast<unsigned>(made.reports.size());
  report.part = {};
  for (std::size_t i = 1; i < made.profiles.size(); ++i) {
    profile = merge(profile, parse_profile(made.profiles[i]));
  }
  std::vector<Series> each;
  for (const std::string& text : made.series) each.push_back(series_of(text));
  report.transport.series = sum_of(each);
}

}  // namespace navjit::apps

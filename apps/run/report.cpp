#include "apps/run/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/text.hpp"

#include "apps/options/machine.hpp"
#include "apps/options/observed_report.hpp"
#include "apps/warmup/series.hpp"

namespace navjit::apps {
namespace {

/// Scenes with less than this share are summed up in one line.
constexpr double least_share = 0.002;

const char* jit_name(JitMode mode) {
  switch (mode) {
    case JitMode::off:
      return "off";
    case JitMode::on:
      return "on";
    case JitMode::wait:
      return "wait";
    case JitMode::shadow:
      return "shadow";
  }
  return "";
}

constexpr double infinity = std::numeric_limits<double>::infinity();

double steps_per_second(const Transport& t) {
  return t.seconds > 0 ? static_cast<double>(t.steps) / t.seconds : 0;
}

/// When the scenes that are specialised in the end came to be.
std::vector<warmup::Swap> swaps_of(const RuntimeReport& report) {
  std::vector<warmup::Swap> swaps;
  for (const SceneReport& scene : report.scenes) {
    if (scene.specialised_at_s > 0) swaps.push_back({scene.specialised_at_s, scene.share});
  }
  return swaps;
}

/// "123.4", or a dash for what was not measured.
std::string figure(double value, const char* format) {
  if (!(value > 0)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Which scenes keep the budget, and the hottest that cannot promise to.
void print_budget(const RunReport& report) {
  double kept = 0;
  std::size_t scenes = 0, all = 0;
  const SceneReport* first = nullptr;
  for (const SceneReport& s : report.runtime.scenes) {
    if (!s.budget) continue;
    ++all;
    if (s.budget->met) {
      ++scenes;
      kept += s.share;
    } else if (first == nullptr) {
      first = &s;
    }
  }
  std::printf("budget %g mm: promised in %zu of %zu scenes, %.2f%% of the steps", *report.budget,
              scenes, all, 100 * kept);
  if (first != nullptr) {
    std::printf("; not in %s: %s", common::printable(first->volume).c_str(),
                common::printable(first->budget->why).c_str());
  }
  std::printf("\n");
}

nlohmann::ordered_json to_json(const BudgetReport& b) {
  nlohmann::ordered_json json{{"promised", b.met}, {"bound_mm", nullptr}};
  if (std::isfinite(b.bound_mm)) json["bound_mm"] = b.bound_mm;
  json.update({{"measured_mm", b.measured_mm}, {"states", b.states}, {"why", b.why}});
  return json;
}

}  // namespace

bool RunReport::any_specialised() const {
  return std::any_of(runtime.scenes.begin(), runtime.scenes.end(),
                     [](const SceneReport& s) { return s.binding != Binding::generic; });
}

std::optional<double> RunReport::speedup() const {
  if (compared) return compared->with / compared->without;
  if (interrupted || (jit != JitMode::on && jit != JitMode::wait)) return std::nullopt;
  return any_specialised() ? std::nullopt : std::optional(1.0);
}

void print_table(const RunReport& report) {
  std::printf("\n%-44s %7s %9s %9s %9s %8s  %s\n", "scene", "steps", "ns/step", "ns/step",
              "compile", "swapped", "status");
  std::printf("%-44s %7s %9s %9s %9s %8s\n", "", "share", "generic", "special.", "ms", "at s");
  double rest = 0;
  std::size_t others = 0;
  for (const SceneReport& s : report.runtime.scenes) {
    if (s.share < least_share) {
      rest += s.share;
      ++others;
      continue;
    }
    std::printf("%s %6.2f%% %9s %9s %9s %8s  %s%s%s\n", common::fitted(s.volume, 44).c_str(),
                100 * s.share, figure(s.generic_ns_per_step, "%.1f").c_str(),
                figure(s.specialised_ns_per_step, "%.1f").c_str(),
                figure(s.compile_ms, "%.1f").c_str(), figure(s.swapped_at_s, "%.2f").c_str(),
                s.compiled_solids > 0        ? "bound to data, solids compiled"
                : s.binding == Binding::data ? "bound to data"
                                             : status_name(s.status),
                s.note.empty() ? "" : ": ",
                common::printable(s.note.substr(0, s.note.find('\n'))).c_str());
  }
  if (others > 0) {
    std::printf("%-44s %6.2f%%\n", ("(" + std::to_string(others) + " more)").c_str(), 100 * rest);
  }
  const Transport& t = report.transport;
  std::printf("\n%llu rays%s, %llu steps, %.9g mm, %llu stuck, ",
              static_cast<unsigned long long>(t.rays), report.interrupted ? " (interrupted)" : "",
              static_cast<unsigned long long>(t.steps), t.length_mm,
              static_cast<unsigned long long>(t.stuck));
  if (t.outside > 0) {
    std::printf("%llu start outside the world, ", static_cast<unsigned long long>(t.outside));
  }
  if (report.processes > 1) std::printf("%u processes, ", report.processes);
  std::printf("%u thread%s, %.2f s\n", t.threads, t.threads == 1 ? "" : "s", t.seconds);
  std::printf("%.3f M steps/s", steps_per_second(t) / 1e6);
  if (report.jit != JitMode::off) {
    std::printf(" over the whole run, %.3f M steps/s after the last swap",
                t.warm_steps_per_second / 1e6);
  }
  std::printf("; jit %s\n", jit_name(report.jit));
  if (report.jit == JitMode::on || report.jit == JitMode::wait) {
    if (const auto& c = report.compared) {
      std::printf(
          "one thread%s, first %llu rays again, in turn, in processor time: %.3f M steps/s with "
          "the JIT, %.3f M steps/s without: %.2f times\n",
          report.processes > 1 ? " for each process" : "", static_cast<unsigned long long>(c->rays),
          c->with / 1e6, c->without / 1e6, *report.speedup());
    } else if (!report.interrupted && !report.any_specialised()) {
      std::printf("no scene is specialised in the end: the speed-up is 1\n");
    }
    std::printf(
        "%zu modules (%zu from the cache), %.0f ms of compilation, %zu kB of code, %llu "
        "bail-outs\n",
        report.runtime.modules, report.runtime.cached_modules, report.runtime.compile_ms,
        report.runtime.code_bytes / 1024, static_cast<unsigned long long>(t.bail_outs));
  }
  if (report.jit == JitMode::shadow) {
    std::printf("%llu of %llu steps differed from the generic navigator's\n",
                static_cast<unsigned long long>(t.differences),
                static_cast<unsigned long long>(t.steps));
  }
  if (report.budget) print_budget(report);
  if (report.seen != nullptr) print_observation(*report.seen);
}

std::string json_text(const RunReport& report) {
  const Transport& t = report.transport;
  const std::vector<warmup::Swap> swaps = swaps_of(report.runtime);
  const auto or_null = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json compared;  // null where nothing was compared
  if (report.compared) {
    compared = {{"rays", report.compared->rays},
                {"steps_per_second_with", report.compared->with},
                {"steps_per_second_without", report.compared->without}};
  }
  nlohmann::ordered_json json = circumstances_json();
  json.update(nlohmann::ordered_json{
      {"detector", report.detector},
      {"interrupted", report.interrupted},
      {"rays", t.rays},
      {"steps", t.steps},
      {"stuck", t.stuck},
      {"outside", t.outside},
      {"length_mm", t.length_mm},
      {"seconds", t.seconds},
      {"cpu_seconds", t.cpu_seconds},
      {"compile_cpu_seconds", report.compile_cpu_seconds},
      {"steps_per_second", steps_per_second(t)},
      {"warm_steps_per_second", t.warm_steps_per_second},
      {"speedup", or_null(report.speedup())},
      {"share_specialised", warmup::share_at(swaps, infinity)},
      {"specialised_50_at_s", or_null(warmup::time_of_share(swaps, 0.5))},
      {"specialised_90_at_s", or_null(warmup::time_of_share(swaps, 0.9))},
      {"threads", t.threads},
      {"basket", report.basket},
      {"jit", jit_name(report.jit)},
      {"bail_outs", t.bail_outs},
      {"differences", t.differences},
      {"compared", compared},
      {"modules", report.runtime.modules},
      {"cached_modules", report.runtime.cached_modules},
      {"plugin_scenes", report.runtime.plugin_scenes},
      {"deoptimised", report.runtime.deoptimised},
      {"compile_ms", report.runtime.compile_ms},
      {"code_bytes", report.runtime.code_bytes},
  });
  if (report.processes > 1) json["processes"] = report.processes;
  if (!report.part.whole()) {
    json["part"] = common::part_text(report.part);
    json["part_of"] = report.rays_of;
  }
  if (report.budget) json["budget_mm"] = *report.budget;
  if (report.seen != nullptr) json["observe"] = to_json(*report.seen);
  auto& scenes = json["scenes"] = nlohmann::ordered_json::array();
  for (const SceneReport& s : report.runtime.scenes) {
    scenes.push_back({{"volume", s.volume},
                      {"structure", s.structure},
                      {"steps", s.steps},
                      {"share", s.share},
                      {"relocations", s.relocations},
                      {"generic_ns_per_step", s.generic_ns_per_step},
                      {"specialised_ns_per_step", s.specialised_ns_per_step},
                      {"compile_ms", s.compile_ms},
                      {"specialised_at_s", s.specialised_at_s},
                      {"swapped_at_s", s.swapped_at_s},
                      {"code", origin_name(s.origin)},
                      {"binding", binding_name(s.binding)},
                      {"compiled_solids", s.compiled_solids},
                      {"status", status_name(s.status)},
                      {"note", s.note}});
    if (s.budget) scenes.back()["budget"] = to_json(*s.budget);
  }
  return report_text(json);
}

}  // namespace navjit::apps

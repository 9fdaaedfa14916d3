#include "apps/run/report.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/text.hpp"

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
                status_name(s.status), s.note.empty() ? "" : ": ",
                common::printable(s.note.substr(0, s.note.find('\n'))).c_str());
  }
  if (others > 0) {
    std::printf("%-44s %6.2f%%\n", ("(" + std::to_string(others) + " more)").c_str(), 100 * rest);
  }
  std::printf("\n%llu rays, %llu steps, %.9g mm, %llu stuck, %u thread%s, %.2f s\n",
              static_cast<unsigned long long>(report.rays),
              static_cast<unsigned long long>(report.steps), report.length_mm,
              static_cast<unsigned long long>(report.stuck), report.threads,
              report.threads == 1 ? "" : "s", report.seconds);
  std::printf("%.3f M steps/s", report.steps_per_second / 1e6);
  if (report.jit != JitMode::off) {
    std::printf(" over the whole run, %.3f M steps/s after the last swap",
                report.warm_steps_per_second / 1e6);
  }
  std::printf("; jit %s\n", jit_name(report.jit));
  if (report.jit == JitMode::on || report.jit == JitMode::wait) {
    if (report.compared_without > 0) {
      std::printf(
          "one thread, first %llu rays again, in turn: %.3f M steps/s with the JIT, %.3f M "
          "steps/s without: %.2f times\n",
          static_cast<unsigned long long>(report.compared_rays), report.compared_with / 1e6,
          report.compared_without / 1e6, report.compared_with / report.compared_without);
    }
    std::printf(
        "%zu modules (%zu from the cache), %.0f ms of compilation, %zu kB of code, %llu states "
        "declined\n",
        report.runtime.modules, report.runtime.cached_modules, report.runtime.compile_ms,
        report.runtime.code_bytes / 1024, static_cast<unsigned long long>(report.declined));
  }
  if (report.budget) print_budget(report);
}

std::string json_text(const RunReport& report) {
  nlohmann::ordered_json json{
      {"detector", report.detector},
      {"rays", report.rays},
      {"steps", report.steps},
      {"stuck", report.stuck},
      {"length_mm", report.length_mm},
      {"seconds", report.seconds},
      {"steps_per_second", report.steps_per_second},
      {"warm_steps_per_second", report.warm_steps_per_second},
      {"level", level_name(report.level)},
      {"level_taken", "exact"},
      {"threads", report.threads},
      {"jit", jit_name(report.jit)},
      {"declined", report.declined},
      {"differences", report.differences},
      {"compared",
       {{"rays", report.compared_rays},
        {"steps_per_second_with", report.compared_with},
        {"steps_per_second_without", report.compared_without}}},
      {"modules", report.runtime.modules},
      {"cached_modules", report.runtime.cached_modules},
      {"plugin_scenes", report.runtime.plugin_scenes},
      {"withdrawn", report.runtime.withdrawn},
      {"compile_ms", report.runtime.compile_ms},
      {"code_bytes", report.runtime.code_bytes},
  };
  if (report.budget) json["budget_mm"] = *report.budget;
  auto& scenes = json["scenes"] = nlohmann::ordered_json::array();
  for (const SceneReport& s : report.runtime.scenes) {
    scenes.push_back({{"volume", s.volume},
                      {"steps", s.steps},
                      {"share", s.share},
                      {"generic_ns_per_step", s.generic_ns_per_step},
                      {"specialised_ns_per_step", s.specialised_ns_per_step},
                      {"compile_ms", s.compile_ms},
                      {"swapped_at_s", s.swapped_at_s},
                      {"code", origin_name(s.origin)},
                      {"binding", binding_name(s.binding)},
                      {"status", status_name(s.status)},
                      {"note", s.note}});
    if (s.budget) scenes.back()["budget"] = to_json(*s.budget);
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

}  // namespace navjit::apps

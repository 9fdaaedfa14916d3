#include "apps/run/page.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "apps/options/machine.hpp"
#include "common/page.hpp"

namespace navjit::apps {
namespace {

using common::Cell;

std::string text_of(const char* format, double a, double b = 0) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

/// Steps a second in some hundred pieces of the run.
common::ChartLine rates_of(const Transport& t) {
  constexpr double pieces = 120;
  common::ChartLine line{"million steps a second", {}};
  double from = 0, steps_from = 0;
  const auto add = [&](double to, std::uint64_t steps) {
    const double made = static_cast<double>(steps) - steps_from;
    line.points.push_back({(from + to) / 2, made / (to - from) / 1e6});
    from = to;
    steps_from = static_cast<double>(steps);
  };
  for (const auto& [seconds, steps] : t.series) {
    if (seconds - from >= t.seconds / pieces) add(seconds, steps);
  }
  if (t.seconds - from > 0.5 * t.seconds / pieces) add(t.seconds, t.steps);
  return line;
}

std::vector<common::ChartMark> swaps_of(const RunReport& report) {
  std::vector<common::ChartMark> marks;
  for (const SceneReport& s : report.runtime.scenes) {
    if (s.binding == Binding::generic) continue;
    const double at = std::max(0.0, s.swapped_at_s - report.transport.begun_s);
    marks.push_back({at, s.share,
                     s.volume +
                         text_of(": %.1f%% of the steps, at %.2f s, bound to ", 100 * s.share, at) +
                         binding_name(s.binding)});
  }
  return marks;
}

/// One sentence: what it was, what was done, what that brought.
std::string story_of(const SceneReport& s, double begun_s) {
  std::string text = s.volume + text_of(" took %.1f%% of the steps", 100 * s.share);
  if (!s.structure.empty()) text += " (" + s.structure + ")";
  text += ". ";
  if (s.binding == Binding::generic) {
    text +=
        s.note.empty()
            ? "It stayed with the generic navigator."
            : "It stayed with the generic navigator: " + s.note.substr(0, s.note.find('\n')) + ".";
    return text;
  }
  text += std::string("Since ") +
          text_of("%.2f s it is bound to ", std::max(0.0, s.swapped_at_s - begun_s)) +
          binding_name(s.binding);
  if (s.generic_ns_per_step > 0 && s.specialised_ns_per_step > 0) {
    text += text_of(": a step takes %.1f ns instead of %.1f", s.specialised_ns_per_step,
                    s.generic_ns_per_step);
  }
  return text + ".";
}

std::string scenes_of(const RunReport& report) {
  std::vector<std::vector<Cell>> rows;
  for (const SceneReport& s : report.runtime.scenes) {
    const bool both = s.generic_ns_per_step > 0 && s.specialised_ns_per_step > 0;
    rows.push_back(
        {{s.volume},
         {s.structure},
         common::counted(s.steps),
         common::measured(100 * s.share, "%.2f%%"),
         common::measured(s.generic_ns_per_step, "%.1f"),
         common::measured(s.specialised_ns_per_step, "%.1f"),
         common::measured(both ? s.generic_ns_per_step / s.specialised_ns_per_step : 0, "%.2f"),
         {binding_name(s.binding)},
         common::measured(s.swapped_at_s, "%.2f"),
         common::measured(s.compile_ms, "%.1f"),
         {status_name(s.status)},
         {s.note}});
  }
  return common::table_html(
      {"scene", "structure", "steps", "share", "ns/step generic", "ns/step now", "times",
       "bound to", "swapped at, s", "compile, ms", "status", "note"},
      rows);
}

std::string bindings_of(const RunReport& report) {
  constexpr std::array kinds{Binding::constants, Binding::structure, Binding::data,
                             Binding::generic};
  std::vector<std::pair<std::string, double>> shares;
  for (const Binding kind : kinds) {
    std::size_t scenes = 0;
    double share = 0;
    for (const SceneReport& s : report.runtime.scenes) {
      if (s.binding != kind) continue;
      ++scenes;
      share += s.share;
    }
    shares.push_back(
        {std::string(binding_name(kind)) + " (" + std::to_string(scenes) + " scenes)", share});
  }
  return common::shares_html(shares);
}

std::string summary_of(const RunReport& report) {
  const Transport& t = report.transport;
  const auto number = [](std::uint64_t value) { return common::counted(value).text; };
  std::vector<std::pair<std::string, std::string>> facts{
      {"rays", number(t.rays) + (report.interrupted ? " (interrupted)" : "")},
      {"steps", number(t.steps) + (t.stuck > 0 ? ", " + number(t.stuck) + " rays stuck" : "")},
      {"way", text_of("%.0f m", t.length_mm / 1000)},
      {"time", text_of("%.2f s, %.2f s of processor time", t.seconds, t.cpu_seconds)},
      {"speed", text_of("%.3f million steps a second; after the last swap %.3f",
                        t.seconds > 0 ? static_cast<double>(t.steps) / t.seconds / 1e6 : 0,
                        t.warm_steps_per_second / 1e6)}};
  if (const auto speedup = report.speedup()) {
    facts.push_back(
        {"speed-up", text_of("%.2f times: the first rays again, in turn with and without, "
                             "by one thread, in processor time",
                             *speedup)});
  }
  facts.push_back(
      {"compiled", number(report.runtime.modules) + " modules (" +
                       number(report.runtime.cached_modules) + " from the cache)" +
                       text_of(" in %.0f ms, %.0f kB of code", report.runtime.compile_ms,
                               static_cast<double>(report.runtime.code_bytes) / 1024)});
  return common::facts_html(facts);
}

}  // namespace

std::string run_page(const RunReport& report, const std::string& hot_map) {
  const Transport& t = report.transport;
  std::string body = summary_of(report);

  body += common::heading_html("What was hot, and what was done about it");
  std::size_t told = 0;
  for (const SceneReport& s : report.runtime.scenes) {
    if (told == 5 || s.share < 0.02) break;
    body += common::paragraph_html(story_of(s, t.begun_s));
    ++told;
  }
  if (told == 0) body += common::paragraph_html("No scene stood out.");

  body += common::heading_html("Speed against time");
  body += common::chart_html({"seconds since the first ray",
                              "million steps a second",
                              {rates_of(t)},
                              swaps_of(report),
                              "swaps, higher for scenes with more steps"});

  body += common::heading_html("What navigates the steps");
  body += common::paragraph_html(
      "Shares of all steps by what their scenes are bound to in the end: constants of compiled "
      "code, "
      "a compiled structure, data for code of the library, or the generic navigator.");
  body += bindings_of(report);

  if (!hot_map.empty()) {
    body += common::heading_html("Where the time goes");
    body += common::picture_html(
        hot_map,
        "Time of parallel rays through the whole detector, from a corner, ns for each pixel.");
  }
  body += common::heading_html("Scenes");
  body += common::paragraph_html("A click on a heading sorts.");
  body += scenes_of(report);

  body += common::heading_html("Command and machine");
  std::vector<std::pair<std::string, std::string>> facts = circumstances();
  facts.push_back({"detector", report.detector});
  facts.push_back({"threads", std::to_string(t.threads)});
  body += common::facts_html(facts);
  return common::page_html("navjit run: " + report.detector, body);
}

}  // namespace navjit::apps

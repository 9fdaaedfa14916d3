#include "apps/warmup/report.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace navjit::warmup {
namespace {

using Json = nlohmann::ordered_json;

/// Over repetitions; those without a value are counted apart.
struct Over {
  Spread of;
  std::size_t with = 0, runs = 0;
};

template <class Get>
Over over(const VariantReport& report, Get&& get) {
  std::vector<double> values;
  for (const RunFigures& run : report.runs) {
    if (const std::optional<double> value = get(run)) values.push_back(*value);
  }
  return {spread(values), values.size(), report.runs.size()};
}

/// "1.23 (1.1 to 1.4)", "never", or with how many had it: "1.23 (1.1 to 1.4), 2 of 3".
std::string words(const Over& over, const char* format) {
  if (over.with == 0) return "never";
  char number[3][32];
  std::snprintf(number[0], sizeof number[0], format, over.of.median);
  std::snprintf(number[1], sizeof number[1], format, over.of.low);
  std::snprintf(number[2], sizeof number[2], format, over.of.high);
  std::string text = std::string(number[0]) + " (" + number[1] + " to " + number[2] + ")";
  if (over.with < over.runs) {
    text += ", " + std::to_string(over.with) + " of " + std::to_string(over.runs);
  }
  return text;
}

Json json_of(const Over& over) {
  if (over.with == 0) return nullptr;
  return {{"median", over.of.median},
          {"low", over.of.low},
          {"high", over.of.high},
          {"runs", over.with}};
}

const auto break_even_of = [](const RunFigures& r) { return r.break_even_s; };
const auto half_of = [](const RunFigures& r) { return r.half_s; };
const auto most_of = [](const RunFigures& r) { return r.most_s; };
const auto share_of = [](const RunFigures& r) { return std::optional(r.share); };
const auto rate_of = [](const RunFigures& r) { return std::optional(r.steps_per_second); };
const auto speed_up_of = [](const RunFigures& r) { return std::optional(r.speed_up); };
const auto cost_of = [](const RunFigures& r) { return std::optional(r.record.other_s); };

}  // namespace

void print_table(const ExperimentReport& report) {
  std::printf("median (least to most) of %zu runs each%s\n\n",
              report.variants.empty() ? 0 : report.variants[0].runs.size(),
              report.interrupted        ? ", as far as they were made (interrupted)"
              : !report.failure.empty() ? ", as far as they were made (one failed)"
                                        : "");
  std::printf(
      "| run | M steps/s, whole run | speed-up in the end | break-even, s | 50%% of steps "
      "specialised, s | 90%%, s | share in the end | cost, s of processor |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const VariantReport& each : report.variants) {
    if (each.runs.empty()) {
      std::printf("| %s | not made |\n", each.variant.name.c_str());
      continue;
    }
    const bool off = each.variant.mode == Mode::off;
    const auto in_millions = [](const RunFigures& r) {
      return std::optional(r.steps_per_second / 1e6);
    };
    const auto percent = [](const RunFigures& r) { return std::optional(100 * r.share); };
    std::printf("| %s | %s |", each.variant.name.c_str(),
                words(over(each, in_millions), "%.2f").c_str());
    if (off) {
      std::printf(" 1 | | | | | %s |\n", words(over(each, cost_of), "%.2f").c_str());
      continue;
    }
    std::printf(
        " %s | %s | %s | %s | %s%% | %s |\n", words(over(each, speed_up_of), "%.2f").c_str(),
        words(over(each, break_even_of), "%.2f").c_str(),
        words(over(each, half_of), "%.3f").c_str(), words(over(each, most_of), "%.3f").c_str(),
        words(over(each, percent), "%.0f").c_str(), words(over(each, cost_of), "%.2f").c_str());
  }
  std::printf("\npreparing cache and plugin took %.1f s\n", report.prepare_s);
}

Json to_json(const ExperimentReport& report) {
  Json json{{"interrupted", report.interrupted},
            {"failure", report.failure.empty() ? Json() : Json(report.failure)},
            {"prepare_s", report.prepare_s},
            {"same_rays", report.same_rays}};
  Json& variants = json["variants"] = Json::array();
  for (const VariantReport& each : report.variants) {
    Json variant{{"name", each.variant.name},
                 {"mode", mode_name(each.variant.mode)},
                 {"steps_per_second", json_of(over(each, rate_of))},
                 {"speed_up", json_of(over(each, speed_up_of))},
                 {"break_even_s", json_of(over(each, break_even_of))},
                 {"half_specialised_s", json_of(over(each, half_of))},
                 {"most_specialised_s", json_of(over(each, most_of))},
                 {"specialised_share", json_of(over(each, share_of))},
                 {"cost_s", json_of(over(each, cost_of))}};
    Json& runs = variant["runs"] = Json::array();
    for (const RunFigures& figures : each.runs) {
      const RunRecord& r = figures.record;
      Json run{{"rays", r.rays},
               {"steps", r.steps},
               {"stuck", r.stuck},
               {"navigating_s", r.navigating_s},
               {"cost_s", r.other_s},
               {"modules", r.modules},
               {"cached_modules", r.cached_modules},
               {"deoptimised", r.deoptimised},
               {"code_bytes", r.code_bytes},
               {"scenes", r.swaps.size()},
               {"series", Json::array()},
               {"swaps", Json::array()}};
      for (const Point& p : r.series) run["series"].push_back({p.seconds, p.steps});
      for (const Swap& s : r.swaps) run["swaps"].push_back({s.seconds, s.share});
      runs.push_back(std::move(run));
    }
    variants.push_back(std::move(variant));
  }
  return json;
}

std::string to_csv(const ExperimentReport& report) {
  std::string text = "variant,repetition,seconds,steps,steps_per_second,specialised_share\n";
  for (const VariantReport& each : report.variants) {
    for (std::size_t i = 0; i < each.runs.size(); ++i) {
      const RunRecord& r = each.runs[i].record;
      Point last;
      for (const Point& p : r.series) {
        char line[160];
        std::snprintf(line, sizeof line, ",%zu,%.6f,%.0f,%.6g,%.6g\n", i, p.seconds, p.steps,
                      rate({last, p}, last.seconds, p.seconds), share_at(r.swaps, p.seconds));
        text += each.variant.name + line;
        last = p;
      }
    }
  }
  return text;
}

}  // namespace navjit::warmup

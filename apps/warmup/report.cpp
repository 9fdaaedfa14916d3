#include "apps/warmup/report.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/warmup/columns.hpp"

namespace navjit::warmup {
namespace {

using Json = nlohmann::ordered_json;

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
const auto speed_up_of = [](const RunFigures& r) { return r.speed_up; };
const auto cost_of = [](const RunFigures& r) { return std::optional(r.record.other_s); };

}  // namespace

void print_table(const ExperimentReport& report) {
  std::printf("median (least to most) of %zu runs each%s\n\n",
              report.variants.empty() ? 0 : report.variants[0].runs.size(),
              report.interrupted        ? ", as far as they were made (interrupted)"
              : !report.failure.empty() ? ", as far as they were made (one failed)"
                                        : "");
  std::string heads = "| run |", rule = "|---|";
  for (const std::string& heading : headings()) {
    heads += ' ' + heading + " |";
    rule += "--:|";
  }
  std::printf("%s\n%s\n", heads.c_str(), rule.c_str());
  for (const VariantReport& each : report.variants) {
    std::string row = "| " + each.variant.name + " |";
    if (each.runs.empty()) {
      row += " not made |";
    } else {
      for (const Field& field : fields_of(each)) row += ' ' + field.text + " |";
    }
    std::puts(row.c_str());
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
      for (const Point& p : r.series) {
        run["series"].push_back({p.seconds, p.steps, p.processor_s});
      }
      for (const Swap& s : r.swaps) run["swaps"].push_back({s.seconds, s.share});
      runs.push_back(std::move(run));
    }
    variants.push_back(std::move(variant));
  }
  return json;
}

std::string to_csv(const ExperimentReport& report) {
  std::string text =
      "variant,repetition,seconds,steps,steps_per_second,specialised_share,processor_s\n";
  for (const VariantReport& each : report.variants) {
    for (std::size_t i = 0; i < each.runs.size(); ++i) {
      const RunRecord& r = each.runs[i].record;
      Point last;
      for (const Point& p : r.series) {
        char line[160];
        std::snprintf(line, sizeof line, ",%zu,%.6f,%.0f,%.6g,%.6g,%.6f\n", i, p.seconds, p.steps,
                      rate({last, p}, last.seconds, p.seconds), share_at(r.swaps, p.seconds),
                      p.processor_s);
        text += each.variant.name + line;
        last = p;
      }
    }
  }
  return text;
}

}  // namespace navjit::warmup

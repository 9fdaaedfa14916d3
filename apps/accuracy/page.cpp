#include "apps/accuracy/page.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "apps/accuracy/observed_report.hpp"
#include "common/page.hpp"

namespace navjit::accuracy {
namespace {

using common::Cell;
using Row = std::vector<Cell>;

/// Counts are told even where they are 0.
Cell count_of(std::uint64_t value) { return common::counted(value); }

std::string text_of(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// An error: 0 is a value like any other.
Cell error_of(double value) { return {text_of("%.2g", value), value}; }

/// Headings that follow others: these have about half of a paper's width.
constexpr const char* error_headings[] = {
    "off by, ulp: median", "99.9%",      "largest",      "off by, mm: largest",
    "off surface, ulp",    "wrong ends", "wrong volumes"};

std::vector<std::string> headings(std::vector<std::string> first) {
  first.insert(first.end(), std::begin(error_headings), std::end(error_headings));
  return first;
}

Row with_errors(Row row, const StepFigures& f) {
  const Quantiles ulp = quantiles(f.errors.along_ulp);
  for (const double value :
       {ulp.median, ulp.high, ulp.largest, quantiles(f.errors.along_mm).largest,
        quantiles(f.errors.across_ulp).largest}) {
    row.push_back(error_of(value));
  }
  row.push_back(count_of(f.wrong_end));
  row.push_back(count_of(f.wrong_volume));
  return row;
}

std::string engines_of(const ExperimentReport& report) {
  std::vector<Row> rows;
  for (const EngineReport& engine : report.engines) {
    const EngineFigures& f = engine.figures;
    const double equal =
        f.made > 0 ? 100 * static_cast<double>(f.equal) / static_cast<double>(f.made) : 0;
    Row row{{engine.name},
            count_of(f.rays),
            count_of(f.made),
            common::measured(equal, "%.4g%%"),
            common::measured(engine.ns_per_step, "%.1f")};
    for (const std::uint64_t n :
         {f.all.wrong_end, f.all.wrong_volume, f.stuck, f.lost, f.arguable}) {
      row.push_back(count_of(n));
    }
    row.push_back({engine.failure});
    rows.push_back(std::move(row));
  }
  return common::table_html(
      {"engine", "rays", "steps", "as generic, bit by bit", "ns/step", "wrong ends",
       "wrong volumes", "rays stuck", "lost", "arguable steps", "note"},
      rows);
}

/// Quantiles of all three kinds of errors.
std::string errors_of(const ExperimentReport& report) {
  std::vector<Row> rows;
  for (const EngineReport& engine : report.engines) {
    const Errors& e = engine.figures.all.errors;
    for (const auto& [what, errors] :
         {std::pair("length, mm", &e.along_mm), std::pair("length, ulp", &e.along_ulp),
          std::pair("end off the surface, ulp", &e.across_ulp)}) {
      const Quantiles q = quantiles(*errors);
      rows.push_back(
          {{engine.name}, {what}, error_of(q.median), error_of(q.high), error_of(q.largest)});
    }
  }
  return common::table_html({"engine", "error of", "median", "99.9%", "largest"}, rows);
}

std::string tracks_of(const ExperimentReport& report) {
  std::vector<Row> rows;
  for (const EngineReport& engine : report.engines) {
    const TrackResult& t = engine.track;
    if (t.boundaries == 0) continue;
    rows.push_back({{engine.name},
                    count_of(t.boundaries),
                    error_of(t.drift),
                    error_of(t.largest),
                    error_of(t.ulp),
                    {t.complete ? "" : "given up"}});
  }
  if (rows.empty()) return common::paragraph_html("No long track was asked for.");
  return common::table_html({"engine", "boundaries", "drift at the end, mm", "at most, mm",
                             "an ulp of the coordinates, mm", "note"},
                            rows);
}

/// Of each engine the share of the steps whose errors are larger.
std::string distribution_of(const ExperimentReport& report) {
  common::Chart chart{
      "error of the length, ulp of the coordinates", "share of the steps with larger errors", {}};
  chart.x_scale = chart.y_scale = common::Scale::logarithmic;
  for (const EngineReport& engine : report.engines) {
    std::vector<float> errors = engine.figures.all.errors.along_ulp;
    if (errors.size() < 2) continue;
    std::sort(errors.begin(), errors.end());
    common::ChartLine line{engine.name, {}};
    const auto all = static_cast<double>(errors.size());
    constexpr double least = 1e-3, factor = 1.15;
    for (double at = least; at < errors.back(); at *= factor) {
      const auto larger = static_cast<double>(
          errors.end() - std::upper_bound(errors.begin(), errors.end(), static_cast<float>(at)));
      line.points.emplace_back(at, larger / all);
    }
    line.points.emplace_back(errors.back(), 1 / all);
    chart.lines.push_back(std::move(line));
  }
  return common::chart_html(chart);
}

/// Of each engine a bar from the median of the errors to the largest, at its speed.
std::string speed_of(const ExperimentReport& report) {
  // What is drawn on a logarithmic scale is no 0.
  constexpr double least = 0.01;
  common::Chart chart{"ns for a step", "error of the length, ulp", {}};
  chart.y_scale = common::Scale::logarithmic;
  chart.dots = true;
  for (const EngineReport& engine : report.engines) {
    if (!(engine.ns_per_step > 0) || engine.figures.all.errors.along_ulp.empty()) continue;
    const Quantiles q = quantiles(engine.figures.all.errors.along_ulp);
    common::ChartLine line{engine.name, {}};
    for (const double error : {q.median, q.high, q.largest}) {
      line.points.emplace_back(engine.ns_per_step, std::max(error, least));
    }
    chart.lines.push_back(std::move(line));
  }
  return common::chart_html(chart);
}

std::string surfaces_of(const ExperimentReport& report) {
  std::vector<Row> rows;
  for (const auto& [kind, unused] : report.engines[0].figures.surfaces) {
    for (const EngineReport& engine : report.engines) {
      const auto found = engine.figures.surfaces.find(kind);
      if (found == engine.figures.surfaces.end()) continue;
      rows.push_back(with_errors({{kind_name(kind)}, {engine.name}, count_of(found->second.steps)},
                                 found->second));
    }
  }
  return common::table_html(headings({"surface of", "engine", "steps"}), rows);
}

std::string scenes_of(const World& world, const ExperimentReport& report) {
  std::set<VolumeId> volumes;
  for (const auto& [volume, unused] : report.engines[0].figures.scenes) volumes.insert(volume);
  std::vector<std::pair<std::uint64_t, Row>> all;
  for (const VolumeId volume : volumes) {
    for (const EngineReport& engine : report.engines) {
      const auto found = engine.figures.scenes.find(volume);
      if (found == engine.figures.scenes.end()) continue;
      const auto ns = engine.scene_ns.find(volume);
      Row row{{world.volumes[volume].name},
              {engine.name},
              count_of(found->second.steps),
              common::measured(ns != engine.scene_ns.end() ? ns->second : 0, "%.1f")};
      all.emplace_back(found->second.steps, with_errors(std::move(row), found->second));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Row> rows;
  for (auto& [steps, row] : all) rows.push_back(std::move(row));
  return common::table_html(headings({"scene", "engine", "steps", "ns/step"}), rows);
}

std::string step_text(const WorstStep& w) {
  char text[200];
  std::snprintf(text, sizeof text, "from %.17g %.17g %.17g along %.17g %.17g %.17g in ", w.point.x,
                w.point.y, w.point.z, w.ray.direction.x, w.ray.direction.y, w.ray.direction.z);
  return text + w.claim;
}

/// What it takes to see the worst steps again.
std::string worst_of(const ExperimentReport& report) {
  std::vector<Row> rows;
  const auto add = [&](const std::string& engine, const char* what,
                       const std::vector<WorstStep>& steps) {
    for (const WorstStep& w : steps) {
      const bool judged = w.judged.ulp > 0;
      rows.push_back({{engine},
                      {what},
                      count_of(w.ray_index),
                      count_of(w.judged.step),
                      judged ? error_of(w.judged.error / w.judged.ulp) : Cell{"-"},
                      judged ? error_of(w.judged.across / w.judged.ulp) : Cell{"-"},
                      judged ? Cell{text_of("%.17g", w.length), w.length} : Cell{"-"},
                      {step_text(w)}});
    }
  };
  for (const EngineReport& engine : report.engines) {
    const EngineFigures& f = engine.figures;
    // What is the generic navigator's to the last bit would be said twice.
    if (&engine != report.engines.data() && f.equal == f.made) continue;
    add(engine.name, "given up", f.given_up);
    add(engine.name, "wrong", f.wrong);
    add(engine.name, "off the surface", f.worst_across);
    add(engine.name, "length", f.worst_along);
  }
  if (rows.empty()) return common::paragraph_html("No step was judged.");
  return common::table_html(
      {"engine", "worst in", "ray", "step", "off, ulp", "off surface, ulp", "length, mm", "made"},
      rows);
}

std::string bounds_of(const EngineFigures& f) {
  const auto number = [](std::uint64_t value) { return common::counted(value).text; };
  return common::paragraph_html("Of " + number(f.made) + " steps of the generic navigator " +
                                number(f.bounded) + " are in scenes whose error is bounded; " +
                                number(f.beyond_bound) +
                                " of them are off by more, and the largest error is" +
                                text_of(" %.2g", f.largest_part) + " of its bound.");
}

}  // namespace

std::string page(const World& world, const ExperimentReport& report, const std::string& title,
                 const Facts& facts) {
  return common::page_html(
      "navjit accuracy: " + title,
      common::paragraph_html(
          std::string(
              "The same rays by each engine. Each step is held against the same detector's "
              "at 113 bits, from the very same point, so that errors do not pile up. An ulp "
              "is the last bit of the largest coordinate.") +
          (report.interrupted ? " The experiment was interrupted." : "")) +
          engines_of(report) + bounds_of(report.engines[0].figures) +
          common::heading_html("How large errors are") + errors_of(report) +
          distribution_of(report) + common::heading_html("Speed and error") +
          common::paragraph_html("From below: median, 99.9% of the steps, the largest. What is "
                                 "less than 0.01 ulp is drawn "
                                 "there.") +
          speed_of(report) + common::heading_html("One long track") + tracks_of(report) +
          common::heading_html("By the surface that ended the step") + surfaces_of(report) +
          common::heading_html("By scene") + scenes_of(world, report) +
          common::heading_html("The worst steps") + worst_of(report) +
          common::heading_html("Command and machine") + common::facts_html(facts));
}

std::string page(const std::vector<ObservedFigures>& figures, const std::string& title,
                 const Facts& facts) {
  std::vector<Row> rows;
  for (const ObservedFigures& f : figures) {
    rows.push_back({{f.observe},
                    common::measured(f.steps_per_ray, "%.2f"),
                    common::measured(f.ns_per_ray, "%.0f"),
                    common::measured(faster(figures[0].ns_per_ray, f.ns_per_ray), "%.2f"),
                    common::measured(f.data_ns_per_ray, "%.0f"),
                    common::measured(faster(figures[0].data_ns_per_ray, f.data_ns_per_ray), "%.2f"),
                    error_of(f.mean),
                    error_of(f.most_of_1000),
                    error_of(f.largest),
                    error_of(f.bound),
                    error_of(f.largest_path)});
  }
  return common::page_html(
      "navjit accuracy: " + title,
      common::paragraph_html("What is lost, and what is won, by observing less: the same rays with "
                             "every boundary (all), and with what each observation leaves.") +
          common::table_html(
              {"observe", "steps/ray", "ns/ray, generic", "times", "ns/ray, bound to data", "times",
               "radiation lengths of a ray, off: mean", "99.9%", "largest", "promised",
               "path in a material, off, mm"},
              rows) +
          common::heading_html("Command and machine") + common::facts_html(facts));
}

}  // namespace navjit::accuracy

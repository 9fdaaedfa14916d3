#include "apps/merge/reports.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/part.hpp"
#include "common/text.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {
namespace {

using nlohmann::json;

const json& member(const json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end()) throw Error(std::string("'") + key + "' is missing: is it a report?");
  return *at;
}

double number(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0) {
    throw Error(std::string("'") + key + "' is not a number above 0");
  }
  return value.get<double>();
}

std::uint64_t whole(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >> 60 != 0) {
    throw Error(std::string("'") + key + "' is not a count");
  }
  return value.get<std::uint64_t>();
}

std::string text(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_string()) throw Error(std::string("'") + key + "' is not a text");
  return value.get<std::string>();
}

/// What has to be alike in all, as text.
std::string circumstances(const json& report) {
  std::string all;
  for (const char* key : {"version", "detector", "jit"}) all += text(report, key) + '\n';
  const auto observed = report.find("observe");
  if (observed != report.end() && observed->is_object()) all += text(*observed, "kind");
  return all;
}

constexpr const char* counts[] = {"rays",           "steps",         "stuck",       "outside",
                                  "threads",        "bail_outs",     "differences", "modules",
                                  "cached_modules", "plugin_scenes", "deoptimised"};
/// Runs are made side by side: their speeds add up.
constexpr const char* sums[] = {"length_mm",  "cpu_seconds",      "compile_cpu_seconds",
                                "compile_ms", "steps_per_second", "warm_steps_per_second"};

}  // namespace

void ReportMerger::add(const json& report) {
  if (!report.is_object()) throw Error("it is no report of navjit run");
  if (report.contains("merged")) {
    throw Error("it is a merged report: give the reports that it was made of, and all the others");
  }
  for (const char* key : counts) whole(report, key);
  for (const char* key : sums) number(report, key);
  for (const char* key : {"seconds", "share_specialised"}) number(report, key);
  whole(report, "code_bytes");
  const auto interrupted = report.find("interrupted");
  if (interrupted != report.end() && !interrupted->is_boolean()) {
    throw Error("'interrupted' is neither true nor false");
  }
  if (!reports_.empty() && circumstances(report) != circumstances(reports_.front())) {
    throw Error("it is of another version, detector, --jit or --observe than the first");
  }
  circumstances(report);
  add_part(report);
  add_scenes(report);
  add_comparison(report);
  reports_.push_back(report);
}

void ReportMerger::add_part(const json& report) {
  const auto given = report.find("part");
  common::Part part{};
  if (given != report.end()) part = common::parse_part(text(report, "part"));
  const std::uint64_t of = given == report.end() ? 0 : part.of;
  if (reports_.empty()) of_ = of;
  if (of != of_) {
    throw Error(of == 0 ? "it is of a whole run, and the first is of a part"
                        : "it is of " + std::to_string(of) +
                              " parts, and the first is not; merge parts of one run");
  }
  const std::string rays = report.contains("part_of") ? text(report, "part_of") : "";
  if (reports_.empty()) rays_of_ = rays;
  if (rays != rays_of_) {
    throw Error("it is a part of '" + common::printable(rays) + "', and the first is one of '" +
                common::printable(rays_of_) + "'; merge parts of one run");
  }
  if (of > 0 && !parts_.insert(part.number).second) {
    throw Error("part " + std::to_string(part.number) + " is there twice");
  }
}

void ReportMerger::add_scenes(const json& report) {
  const json& rows = member(report, "scenes");
  if (!rows.is_array()) throw Error("'scenes' is not an array");
  for (const json& row : rows) {
    if (!row.is_object()) throw Error("a scene is not an object");
    Scene& scene = scenes_[{text(row, "volume"), text(row, "structure")}];
    const std::uint64_t steps = whole(row, "steps");
    const auto weight = static_cast<double>(steps);
    if (const double ns = number(row, "generic_ns_per_step"); ns > 0) {
      scene.generic_ns += ns * weight;
      scene.generic_steps += weight;
    }
    if (const double ns = number(row, "specialised_ns_per_step"); ns > 0) {
      scene.specialised_ns += ns * weight;
      scene.specialised_steps += weight;
    }
    scene.compile_ms += number(row, "compile_ms");
    const double at = number(row, "specialised_at_s");
    scene.always_specialised = scene.always_specialised && at > 0;
    scene.specialised_at_s = std::max(scene.specialised_at_s, at);
    scene.swapped_at_s = std::max(scene.swapped_at_s, number(row, "swapped_at_s"));
    for (const char* key : {"code", "binding", "status", "note"}) text(row, key);
    if (row.contains("compiled_solids")) whole(row, "compiled_solids");
    if (scene.of_most_steps.is_null() || steps > scene.most_steps) {
      scene.most_steps = steps;
      scene.of_most_steps = row;
    }
    scene.steps += steps;
    scene.relocations += whole(row, "relocations");
  }
}

void ReportMerger::add_comparison(const json& report) {
  const json& compared = member(report, "compared");
  if (compared.is_null()) return;
  if (!compared.is_object()) throw Error("'compared' is not an object");
  const std::uint64_t rays = whole(compared, "rays");
  const double with = number(compared, "steps_per_second_with");
  const double without = number(compared, "steps_per_second_without");
  if (rays == 0 || !(with > 0) || !(without > 0)) return;
  ++compared_;
  compared_rays_ += rays;
  with_ += with;
  without_ += without;
}

double ReportMerger::scenes_steps() const {
  double all = 0;
  for (const auto& [name, scene] : scenes_) all += static_cast<double>(scene.steps);
  return std::max(all, 1.0);
}

nlohmann::ordered_json ReportMerger::merged() const {
  const json& first = reports_.front();
  nlohmann::ordered_json made{{"version", first["version"]},
                              {"detector", first["detector"]},
                              {"jit", first["jit"]},
                              {"merged", reports_.size()}};
  if (of_ > 0) {
    made["parts"] = of_;
    made["parts_there"] = parts_;
  }
  bool interrupted = false;
  for (const json& r : reports_) interrupted = interrupted || r.value("interrupted", false);
  made["interrupted"] = interrupted;
  for (const char* key : counts) {
    std::uint64_t sum = 0;
    for (const json& r : reports_) sum += whole(r, key);
    made[key] = sum;
  }
  for (const char* key : sums) {
    double sum = 0;
    for (const json& r : reports_) sum += number(r, key);
    made[key] = sum;
  }
  double seconds = 0;
  std::uint64_t code_bytes = 0;
  for (const json& r : reports_) {
    seconds = std::max(seconds, number(r, "seconds"));
    code_bytes = std::max(code_bytes, whole(r, "code_bytes"));
  }
  made["seconds"] = seconds;
  made["code_bytes"] = code_bytes;
  double specialised = 0, steps = 0;
  for (const json& r : reports_) {
    specialised += number(r, "share_specialised") * number(r, "steps");
    steps += number(r, "steps");
  }
  // Alike in all, as the first was found to be.
  if (first.contains("observe")) made["observe"] = first["observe"];
  made["share_specialised"] = steps > 0 ? specialised / steps : 0;
  made["speedup"] = nullptr;
  made["compared"] = nullptr;
  // Where nothing was specialised there is nothing to compare, and 1 is known.
  const auto is_one = [](const json& r) {
    const auto speedup = r.find("speedup");
    return speedup != r.end() && speedup->is_number() && *speedup == 1 &&
           member(r, "compared").is_null();
  };
  if (std::all_of(reports_.begin(), reports_.end(), is_one)) made["speedup"] = 1.0;
  if (compared_ == reports_.size()) {
    made["speedup"] = with_ / without_;
    made["compared"] = {{"rays", compared_rays_},
                        {"steps_per_second_with", with_},
                        {"steps_per_second_without", without_}};
  }
  std::vector<std::pair<const Scene*, const std::string*>> order;
  for (const auto& [name, scene] : scenes_) order.emplace_back(&scene, &name.first);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first->steps, a.first->relocations) >
           std::tie(b.first->steps, b.first->relocations);
  });
  const double all = scenes_steps();
  auto& rows = made["scenes"] = nlohmann::ordered_json::array();
  for (const auto& [scene, name] : order) {
    const json& like = scene->of_most_steps;
    rows.push_back(
        {{"volume", *name},
         {"structure", like["structure"]},
         {"steps", scene->steps},
         {"share", static_cast<double>(scene->steps) / all},
         {"relocations", scene->relocations},
         {"generic_ns_per_step",
          scene->generic_steps > 0 ? scene->generic_ns / scene->generic_steps : 0},
         {"specialised_ns_per_step",
          scene->specialised_steps > 0 ? scene->specialised_ns / scene->specialised_steps : 0},
         {"compile_ms", scene->compile_ms},
         {"specialised_at_s", scene->always_specialised ? scene->specialised_at_s : 0},
         {"swapped_at_s", scene->swapped_at_s},
         {"code", like["code"]},
         {"binding", like["binding"]},
         {"compiled_solids", like.value("compiled_solids", std::uint64_t{0})},
         {"status", like["status"]},
         {"note", like["note"]}});
  }
  return made;
}

std::string ReportMerger::missing() const {
  const std::uint64_t there = parts_.size();
  if (of_ == 0 || there == of_) return {};
  std::uint64_t first = 1;
  while (parts_.contains(first)) ++first;
  return "; " + std::to_string(of_ - there) + " of " + std::to_string(of_) +
         " parts are missing, the first of them " + std::to_string(first);
}

}  // namespace navjit::apps

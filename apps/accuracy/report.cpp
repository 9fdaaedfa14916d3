#include "apps/accuracy/report.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/text.hpp"

namespace navjit::accuracy {
namespace {

using Json = nlohmann::ordered_json;

unsigned long long number(std::uint64_t n) { return n; }

struct Row {
  const StepFigures* figures;
  Quantiles mm, along, across;
  explicit Row(const StepFigures& f)
      : figures(&f),
        mm(quantiles(f.errors.along_mm)),
        along(quantiles(f.errors.along_ulp)),
        across(quantiles(f.errors.across_ulp)) {}
  void print() const {
    std::printf("%.2g / %.2g / %.2g | %.2g / %.2g / %.2g | %.2g / %.2g / %.2g | %llu | %llu |",
                mm.median, mm.high, mm.largest, along.median, along.high, along.largest,
                across.median, across.high, across.largest, number(figures->wrong_end),
                number(figures->wrong_volume));
  }
};

constexpr const char* error_columns =
    "error of the length, mm: median / 99.9% / largest | in ulp of the coordinates | end from the "
    "surface, ulp | wrong ends | wrong volumes |";
constexpr const char* error_rules = "--:|--:|--:|--:|--:|";

void print_engines(const ExperimentReport& report) {
  std::printf(
      "| engine | rays | steps | as generic, bit by bit | ns/step | %s stuck | lost | arguable | "
      "drift, mm | boundaries |\n|---|--:|--:|--:|--:|%s--:|--:|--:|--:|--:|\n",
      error_columns, error_rules);
  for (const EngineReport& engine : report.engines) {
    const EngineFigures& f = engine.figures;
    if (f.rays == 0) {
      std::printf("| %s | %s |\n", engine.name.c_str(), engine.failure.c_str());
      continue;
    }
    std::printf("| %s | %llu | %llu | %llu | ", engine.name.c_str(), number(f.rays), number(f.made),
                number(f.equal));
    if (engine.ns_per_step > 0) {
      std::printf("%.1f | ", engine.ns_per_step);
    } else {
      std::printf("- | ");
    }
    Row(f.all).print();
    std::printf(" %llu | %llu | %llu |", number(f.stuck), number(f.lost), number(f.arguable));
    if (engine.track.boundaries > 0) {
      std::printf(" %.2g (at most %.2g)%s | %llu |\n", engine.track.drift, engine.track.largest,
                  engine.track.complete ? "" : ", then given up", number(engine.track.boundaries));
    } else {
      std::printf(" - | - |\n");
    }
    if (!engine.failure.empty()) {
      std::fprintf(stderr, "navjit: %s: %s\n", engine.name.c_str(), engine.failure.c_str());
    }
  }
}

/// What is promised of every step, and whether it was kept.
void print_bounds(const EngineFigures& f) {
  std::printf(
      "\nOf %llu steps of the generic navigator %llu are in scenes whose error is bounded "
      "(navjit inspect --scene); %llu of them are off by more, the largest error is %.2g of its "
      "bound.\n",
      number(f.made), number(f.bounded), number(f.beyond_bound), f.largest_part);
}

void print_surfaces(const ExperimentReport& report) {
  std::printf("\n| surface of | engine | steps | %s\n|---|---|--:|%s\n", error_columns,
              error_rules);
  for (const auto& [kind, unused] : report.engines[0].figures.surfaces) {
    for (const EngineReport& engine : report.engines) {
      const auto found = engine.figures.surfaces.find(kind);
      if (found == engine.figures.surfaces.end()) continue;
      std::printf("| %s | %s | %llu | ", kind_name(kind), engine.name.c_str(),
                  number(found->second.steps));
      Row(found->second).print();
      std::printf("\n");
    }
  }
}

std::vector<VolumeId> by_steps(const EngineFigures& figures) {
  std::vector<VolumeId> volumes;
  volumes.reserve(figures.scenes.size());
  for (const auto& [volume, unused] : figures.scenes) volumes.push_back(volume);
  std::stable_sort(volumes.begin(), volumes.end(), [&](VolumeId a, VolumeId b) {
    return figures.scenes.at(a).steps > figures.scenes.at(b).steps;
  });
  return volumes;
}

void print_scenes(const World& world, const ExperimentReport& report, std::size_t most) {
  const std::vector<VolumeId> volumes = by_steps(report.engines[0].figures);
  std::printf("\n| scene | engine | steps | ns/step | %s\n|---|---|--:|--:|%s\n", error_columns,
              error_rules);
  for (std::size_t i = 0; i < std::min(most, volumes.size()); ++i) {
    for (const EngineReport& engine : report.engines) {
      const auto found = engine.figures.scenes.find(volumes[i]);
      if (found == engine.figures.scenes.end()) continue;
      std::printf("| %s | %s | %llu | ", common::printable(world.volumes[volumes[i]].name).c_str(),
                  engine.name.c_str(), number(found->second.steps));
      const auto ns = engine.scene_ns.find(volumes[i]);
      if (ns != engine.scene_ns.end()) {
        std::printf("%.0f | ", ns->second);
      } else {
        std::printf("- | ");
      }
      Row(found->second).print();
      std::printf("\n");
    }
  }
  if (volumes.size() > most) {
    std::printf("\n%zu more scenes are in the JSON report.\n", volumes.size() - most);
  }
}

void print_given_up(const WorstStep& w) {
  const Vec3 &p = w.ray.position, &v = w.ray.direction;
  std::printf(
      "- ray %zu from (%.17g, %.17g, %.17g) along (%.17g, %.17g, %.17g): %s, after %zu steps, at "
      "(%.17g, %.17g, %.17g)\n",
      w.ray_index, p.x, p.y, p.z, v.x, v.y, v.z, common::printable(w.claim).c_str(),
      w.judged.step + 1, w.point.x, w.point.y, w.point.z);
}

void print_step(const char* what, const WorstStep& w) {
  const Vec3 &p = w.point, &v = w.ray.direction;
  std::printf(
      "- %s: ray %zu, step %zu in %s from (%.17g, %.17g, %.17g) along (%.17g, %.17g, %.17g): "
      "%.17g mm instead of %.17g, off by %.3g ulp, %.3g ulp from the surface\n",
      what, w.ray_index, w.judged.step, common::printable(w.claim).c_str(), p.x, p.y, p.z, v.x, v.y,
      v.z, w.length, w.judged.reference, w.judged.error / w.judged.ulp,
      w.judged.across / w.judged.ulp);
}

Json to_json(const Quantiles& q) {
  return {{"median", q.median}, {"99.9%", q.high}, {"largest", q.largest}};
}

Json to_json(const StepFigures& f) {
  const Row row(f);
  return {{"steps", f.steps},
          {"error_mm", to_json(row.mm)},
          {"error_ulp", to_json(row.along)},
          {"from_surface_ulp", to_json(row.across)},
          {"wrong_ends", f.wrong_end},
          {"wrong_volumes", f.wrong_volume}};
}

Json to_json(const WorstStep& w) {
  const Vec3 &p = w.point, &v = w.ray.direction, &s = w.ray.position;
  return {{"ray", w.ray_index},
          {"ray_start", {s.x, s.y, s.z}},
          {"step", w.judged.step},
          {"claim", w.claim},
          {"point", {p.x, p.y, p.z}},
          {"direction", {v.x, v.y, v.z}},
          {"length_mm", w.length},
          {"reference_mm", w.judged.reference},
          {"error_ulp", w.judged.error / w.judged.ulp},
          {"from_surface_ulp", w.judged.across / w.judged.ulp},
          {"wrong_end", w.judged.wrong_end},
          {"wrong_volume", w.judged.wrong_volume}};
}

Json to_json(const std::vector<WorstStep>& list) {
  Json json = Json::array();
  for (const WorstStep& w : list) json.push_back(to_json(w));
  return json;
}

}  // namespace

void print_tables(const World& world, const ExperimentReport& report, std::size_t most_scenes) {
  print_engines(report);
  print_bounds(report.engines[0].figures);
  print_surfaces(report);
  print_scenes(world, report, most_scenes);
  for (const EngineReport& engine : report.engines) {
    const EngineFigures& f = engine.figures;
    if (f.worst_across.empty() && f.worst_along.empty() && f.wrong.empty() && f.given_up.empty()) {
      continue;
    }
    if (&engine != report.engines.data() && f.equal == f.made) continue;  // it would be said twice
    std::printf("\n%s, worst steps:\n", engine.name.c_str());
    for (std::size_t i = 0; i < std::min<std::size_t>(3, f.given_up.size()); ++i) {
      print_given_up(f.given_up[i]);
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(3, f.wrong.size()); ++i) {
      print_step("wrong", f.wrong[i]);
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(3, f.worst_across.size()); ++i) {
      print_step("off the surface", f.worst_across[i]);
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(3, f.worst_along.size()); ++i) {
      print_step("length", f.worst_along[i]);
    }
  }
}

Json to_json(const World& world, const std::string& detector, const ExperimentReport& report) {
  Json json{{"detector", detector},
            {"interrupted", report.interrupted},
            {"tolerance_mm", world.tolerance},
            {"engines", Json::array()}};
  for (const EngineReport& engine : report.engines) {
    const EngineFigures& f = engine.figures;
    Json entry{{"name", engine.name}};
    if (!engine.failure.empty()) entry["failure"] = engine.failure;
    if (f.rays > 0) {
      entry.update({{"rays", f.rays},
                    {"rays_outside", f.outside},
                    {"steps", f.made},
                    {"steps_as_generic", f.equal},
                    {"ns_per_step", engine.ns_per_step > 0 ? Json(engine.ns_per_step) : Json()},
                    {"stuck", f.stuck},
                    {"lost", f.lost},
                    {"steps_not_judged", f.skipped},
                    {"steps_arguable", f.arguable},
                    {"steps_bounded", f.bounded},
                    {"steps_beyond_bound", f.beyond_bound},
                    {"largest_part_of_bound", f.largest_part},
                    {"overall", to_json(f.all)}});
      entry["track"] = {{"boundaries", engine.track.boundaries},
                        {"drift_mm", engine.track.drift},
                        {"largest_drift_mm", engine.track.largest},
                        {"ulp_mm", engine.track.ulp},
                        {"complete", engine.track.complete}};
      for (const auto& [kind, figures] : f.surfaces) {
        entry["surfaces"][kind_name(kind)] = to_json(figures);
      }
      entry["scenes"] = Json::array();
      for (const VolumeId volume : by_steps(f)) {
        Json scene{{"volume", world.volumes[volume].name}};
        const auto ns = engine.scene_ns.find(volume);
        if (ns != engine.scene_ns.end()) scene["ns_per_step"] = ns->second;
        scene.update(to_json(f.scenes.at(volume)));
        entry["scenes"].push_back(std::move(scene));
      }
      entry["worst_from_surface"] = to_json(f.worst_across);
      entry["worst_length"] = to_json(f.worst_along);
      entry["wrong"] = to_json(f.wrong);
      entry["given_up"] = Json::array();
      for (const WorstStep& w : f.given_up) {
        const Vec3 &p = w.ray.position, &v = w.ray.direction;
        entry["given_up"].push_back({{"ray", w.ray_index},
                                     {"ray_start", {p.x, p.y, p.z}},
                                     {"direction", {v.x, v.y, v.z}},
                                     {"point", {w.point.x, w.point.y, w.point.z}},
                                     {"claim", w.claim}});
      }
    }
    json["engines"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace navjit::accuracy

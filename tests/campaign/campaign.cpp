// Sends rays through detectors and judges their steps: the program behind docs/campaign.md.
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "geometry/gdml/read_world.hpp"
#include "navjit/runtime.hpp"
#include "tests/campaign/files.hpp"
#include "tests/campaign/judge.hpp"

namespace {

using namespace navjit;
using campaign::Counts;
using campaign::Defect;
using reference::Verdict;

struct Result {
  std::string file;
  Counts counts;
  double seconds = 0;
  std::vector<Defect> defects;
};

Result run_file(const std::string& file, std::uint64_t rays, unsigned threads,
                const campaign::Plan& plan) {
  const auto world = std::make_shared<const World>(read_world(file));
  const reference::WideGeometry reference(world);
  Runtime runtime(world, {.jit = JitMode::off});
  Result result{file, {}, 0, {}};
  const auto start = std::chrono::steady_clock::now();
  std::atomic<std::uint64_t> next = 0;
  std::mutex merging;
  const auto work = [&] {
    Navigator navigator = runtime.navigator();
    Counts counts;
    std::vector<Defect> defects;
    constexpr std::uint64_t chunk = 256;
    for (std::uint64_t first; (first = next.fetch_add(chunk)) < rays;) {
      for (std::uint64_t i = first; i < std::min(first + chunk, rays); ++i) {
        campaign::run_ray(navigator, reference, plan, i, counts, defects);
      }
    }
    const std::lock_guard lock(merging);
    result.counts += counts;
    result.defects.insert(result.defects.end(), defects.begin(), defects.end());
  };
  {
    std::vector<std::jthread> workers;
    for (unsigned i = 1; i < threads; ++i) workers.emplace_back(work);
    work();
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

void print_header() {
  std::printf(
      "| file | rays | steps | zero steps | stuck | lost | steps checked | points judged | wrong | "
      "near a boundary | overlap | protrusion | safety too large | s |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
}

void print_row(const std::string& name, const Counts& c, double seconds) {
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  const auto points = [&](Verdict v) { return number(c.points[static_cast<std::size_t>(v)]); };
  std::printf(
      "| %s | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %llu | "
      "%.0f |\n",
      name.c_str(), number(c.rays), number(c.steps), number(c.zero_steps), number(c.stuck),
      number(c.lost), number(c.checked), number(c.judged()), number(c.wrong()),
      points(Verdict::near_a_boundary), points(Verdict::overlap), points(Verdict::protrusion),
      number(c.unsafe), seconds);
  std::fflush(stdout);
}

void print_defect(const Defect& d) {
  const Vec3 &p = d.ray.position, &v = d.ray.direction;
  std::fprintf(stderr,
               "  %s: ray %llu from %a,%a,%a along %a,%a,%a; step %llu, %.17g mm after %.17g mm, "
               "in %s\n",
               d.what.c_str(), static_cast<unsigned long long>(d.index), p.x, p.y, p.z, v.x, v.y,
               v.z, static_cast<unsigned long long>(d.step), d.length, d.from, d.path.c_str());
}

nlohmann::json to_json(const Counts& c) {
  nlohmann::json points;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    points[name_of(static_cast<Verdict>(i))] = c.points[i];
  }
  return {{"rays", c.rays},       {"outside", c.outside},       {"steps", c.steps},
          {"stuck", c.stuck},     {"zero_steps", c.zero_steps}, {"lost", c.lost},
          {"checked", c.checked}, {"points", points},           {"safety_too_large", c.unsafe}};
}

nlohmann::json to_json(const Defect& d) {
  const Vec3 &p = d.ray.position, &v = d.ray.direction;
  return {{"what", d.what},
          {"position", {p.x, p.y, p.z}},
          {"direction", {v.x, v.y, v.z}},
          {"ray", d.index},
          {"step", d.step},
          {"path", d.path},
          {"after_mm", d.from},
          {"length_mm", d.length}};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Transports random rays and judges points of their steps at 113 bits.");
  std::vector<std::string> files;
  std::uint64_t rays = 1000;
  unsigned threads = 1;
  campaign::Plan plan;
  std::string json_file;
  app.add_option("files", files, "GDML files, or folders of them")->required();
  app.add_option("--rays", rays, "Rays per file");
  app.add_option("--seed", plan.seed, "Of rays and of the choice of steps");
  app.add_option("--threads", threads, "Threads")->check(CLI::Range(1, 256));
  app.add_option("--checked", plan.checked, "Share of the steps that are judged")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--json", json_file, "Where to write a report");
  CLI11_PARSE(app, argc, argv);

  const std::vector<std::string> all = gdml_files(files);

  nlohmann::json report{{"files", nlohmann::json::array()}, {"refused", nlohmann::json::array()}};
  Counts totals;
  double seconds = 0;
  print_header();
  for (const std::string& file : all) {
    try {
      const Result result = run_file(file, rays, threads, plan);
      print_row(std::filesystem::path(file).stem(), result.counts, result.seconds);
      nlohmann::json entry = to_json(result.counts);
      entry["file"] = file;
      entry["seconds"] = result.seconds;
      entry["defects"] = nlohmann::json::array();
      for (const Defect& d : result.defects) {
        print_defect(d);
        entry["defects"].push_back(to_json(d));
      }
      report["files"].push_back(std::move(entry));
      totals += result.counts;
      seconds += result.seconds;
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      report["refused"].push_back({{"file", file}, {"why", e.what()}});
    }
  }
  print_row("total", totals, seconds);
  report["total"] = to_json(totals);
  if (!json_file.empty()) std::ofstream(json_file) << report.dump(1) << '\n';
  if (totals.rays == 0) return 2;
  return totals.defects() == 0 ? 0 : 1;
}

// Compares all box structures: methods and clusterings, by scene and kind of query. From its tables
// navjit::bvh::default_method was chosen (docs/bvh.md).
//
// Queries start at random within the bounds of the boxes. A ray's visitor behaves like a navigator
// whose daughters all fill their boxes: the first box met sets the limit.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bench/bvh_scenes.hpp"
#include "bench/ranges.hpp"
#include "common/clock.hpp"
#include "common/statistics.hpp"
#include "geometry/bvh/box_tree.hpp"
#include "geometry/bvh/box_tree_traversal.hpp"
#include "geometry/model/random.hpp"

namespace navjit::bench {
namespace {

using bvh::BoxTree;
using bvh::Structure;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Query {
  Vec3 point;
  Direction direction;
};

std::vector<Query> make_queries(const Extent& bounds, std::size_t count) {
  std::mt19937_64 random(1);
  std::vector<Query> queries;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 v = unit_vector(random);
    queries.push_back(
        {{uniform(random, bounds.min.x, bounds.max.x), uniform(random, bounds.min.y, bounds.max.y),
          uniform(random, bounds.min.z, bounds.max.z)},
         kernels::make_direction(v.x, v.y, v.z)});
  }
  return queries;
}

// Each function returns something that depends on all visits.
double first_hit(const BoxTree& tree, const Query& q) {
  double limit = 1e9;
  tree.along_ray(q.point, q.direction, limit,
                 [&](std::uint32_t, double enter) { return limit = std::min(limit, enter); });
  return limit;
}
double all_hits(const BoxTree& tree, const Query& q) {
  double sum = 0;
  tree.along_ray(q.point, q.direction, 1e9, [&](std::uint32_t index, double) {
    sum += index;
    return 1e9;
  });
  return sum;
}
double containing(const BoxTree& tree, const Query& q) {
  double sum = 0;
  tree.containing(q.point, [&](std::uint32_t index) {
    sum += index;
    return true;
  });
  return sum;
}
double near(const BoxTree& tree, const Query& q) {
  double radius = infinity;
  tree.near(q.point, radius,
            [&](std::uint32_t, double distance) { return radius = std::min(radius, distance); });
  return radius;
}

struct Kind {
  const char* name;
  double (*ask)(const BoxTree&, const Query&);
};
constexpr Kind kinds[] = {
    {"first hit", first_hit}, {"all hits", all_hits}, {"containing", containing}, {"near", near}};

volatile double sink;

/// The time of a query, ns.
double time_queries(const Kind& kind, const BoxTree& tree, const std::vector<Query>& queries) {
  const double start = common::thread_ns();
  double sum = 0;
  for (const Query& query : queries) sum += kind.ask(tree, query);
  sink = sum;
  return (common::thread_ns() - start) / static_cast<double>(queries.size());
}

struct Candidate {
  std::string name;
  Structure structure;
};

std::vector<Candidate> candidates(const std::vector<std::uint32_t>& groups) {
  using enum bvh::Clustering;
  std::vector<Candidate> result{{"linear", {}}, {"wide-tree", {bvh::Method::wide_tree}}};
  for (const bvh::Clustering clustering : {surface, k_means, furthest}) {
    for (const std::uint32_t g : groups) {
      const Structure two{bvh::Method::two_level, clustering, g};
      result.push_back({to_string(two) + (g == 0 ? "" : " g" + std::to_string(g)), two});
    }
  }
  for (const bvh::Clustering clustering : {surface, k_means, furthest}) {
    const Structure tree{bvh::Method::regular_tree, clustering};
    result.push_back({to_string(tree), tree});
  }
  return result;
}

void print_heading(const std::vector<Candidate>& list) {
  std::printf("| scene | boxes | query |");
  for (const Candidate& candidate : list) std::printf(" %s |", candidate.name.c_str());
  std::printf("\n|---|--:|---|");
  for (std::size_t i = 0; i < list.size(); ++i) std::printf("--:|");
  std::printf("\n");
}

/// Prints median ns for each query, and ms to build; structures take turns in each repetition.
void measure(const BoxScene& scene, const std::vector<Candidate>& list, int repetitions,
             std::size_t query_count) {
  const std::vector<Query> queries = make_queries(bounds(scene.boxes), query_count);
  std::vector<BoxTree> trees;
  std::vector<double> build_ms;
  for (const Candidate& candidate : list) {
    const double start = common::thread_ns();
    trees.emplace_back(scene.boxes, 1e-9, candidate.structure);
    build_ms.push_back(1e-6 * (common::thread_ns() - start));
  }
  for (const Kind& kind : kinds) {
    std::vector<std::vector<double>> times(list.size());
    for (int r = 0; r < repetitions; ++r) {
      for (std::size_t i = 0; i < list.size(); ++i) {
        times[i].push_back(time_queries(kind, trees[i], queries));
      }
    }
    std::printf("| %s | %zu | %s |", scene.name.c_str(), scene.boxes.size(), kind.name);
    for (const auto& t : times) std::printf(" %.1f |", common::summarise(t).median);
    std::printf("\n");
  }
  std::printf("| %s | %zu | build, ms |", scene.name.c_str(), scene.boxes.size());
  for (const double ms : build_ms) std::printf(" %.2f |", ms);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace navjit::bench

int main(int argc, char** argv) {
  using namespace navjit::bench;
  CLI::App app{"Box structures against each other; median ns a query"};
  std::vector<std::size_t> counts{1,  4,  8,   12,  16,  20,   24,   32,   48,
                                  64, 96, 128, 256, 512, 1024, 2048, 4096, 10000};
  std::vector<std::string> files;
  std::vector<std::uint32_t> groups{0};
  std::size_t most = 3, queries = 500;
  int repetitions = 11;
  app.add_option("detectors", files, "GDML files, instead of the made-up scenes");
  app.add_option("--counts", counts, "boxes of the made-up scenes")->delimiter(',');
  app.add_option("--groups", groups, "groups per cluster of two levels; 0: the default")
      ->delimiter(',');
  app.add_option("--volumes", most, "of each file, those with most daughters");
  app.add_option("--queries", queries, "in a repetition")->check(range_of_counts());
  app.add_option("--repetitions", repetitions, "medians are over these")
      ->check(range_of_repetitions());
  CLI11_PARSE(app, argc, argv);
  try {
    const auto list = candidates(groups);
    print_heading(list);
    if (files.empty()) {
      for (const std::size_t count : counts) {
        for (const BoxScene& s : made_up_scenes(count)) measure(s, list, repetitions, queries);
      }
    }
    for (const std::string& file : files) {
      for (const BoxScene& s : scenes_of(file, most)) measure(s, list, repetitions, queries);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bvh_benchmark: %s\n", error.what());
    return 1;
  }
}

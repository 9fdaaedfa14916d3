// Linear against two-level box trees, by number of boxes and kind of query. Boxes are cubes of a
// grid with gaps ("grid", sparse candidates) or plates of a stack ("stack", a ray meets them all).
// The crossing point of the two is what navjit::bvh::default_method documents.
//
// A ray's visitor behaves like a navigator whose daughters all fill their boxes: the first box met
// sets the limit.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "geometry/bvh/box_tree.hpp"
#include "geometry/bvh/box_tree_traversal.hpp"

namespace navjit::bvh {
namespace {

enum Shape { grid, stack };

std::vector<Extent> make_boxes(Shape shape, int count) {
  std::vector<Extent> boxes;
  if (shape == stack) {
    for (int i = 0; i < count; ++i) {
      const double low = -500 + 1000.0 * i / count, high = low + 900.0 / count;
      boxes.push_back({{-500, -500, low}, {500, 500, high}});
    }
    return boxes;
  }
  const int n = static_cast<int>(std::ceil(std::cbrt(count) - 1e-9));
  const double pitch = 1000.0 / n;
  for (int i = 0; i < count; ++i) {
    const Vec3 low{-500 + pitch * (i % n), -500 + pitch * (i / n % n), -500 + pitch * (i / n / n)};
    const double edge = 0.7 * pitch;
    boxes.push_back({low, {low.x + edge, low.y + edge, low.z + edge}});
  }
  return boxes;
}

struct Query {
  Vec3 point;
  Direction direction;
};

std::vector<Query> make_queries() {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> at(-500, 500);
  std::normal_distribution<double> along;
  std::vector<Query> queries;
  for (int i = 0; i < 1024; ++i) {
    const double x = along(generator), y = along(generator), z = along(generator);
    const double length = std::sqrt(x * x + y * y + z * z);
    queries.push_back({{at(generator), at(generator), at(generator)},
                       kernels::make_direction(x / length, y / length, z / length)});
  }
  return queries;
}

BoxTree make_tree(const benchmark::State& state) {
  const auto groups = static_cast<std::uint32_t>(state.range(2));
  const std::vector<Extent> boxes =
      make_boxes(static_cast<Shape>(state.range(1)), static_cast<int>(state.range(0)));
  if (groups == 0) return {boxes, 1e-9, Method::linear};
  return {boxes, 1e-9, Method::two_level, groups};
}

template <class Ask>
void run(benchmark::State& state, const Ask& ask) {
  const BoxTree tree = make_tree(state);
  const std::vector<Query> queries = make_queries();
  std::size_t i = 0, visits = 0;
  for (auto _ : state) {
    ask(tree, queries[i], visits);
    i = (i + 1) % queries.size();
  }
  state.counters["visits"] =
      benchmark::Counter(static_cast<double>(visits), benchmark::Counter::kAvgIterations);
}

void along_ray(benchmark::State& state) {
  run(state, [](const BoxTree& tree, const Query& query, std::size_t& visits) {
    double limit = 2000;
    tree.along_ray(query.point, query.direction, limit, [&](std::uint32_t index, double enter) {
      benchmark::DoNotOptimize(index);
      ++visits;
      return limit = std::min(limit, enter);
    });
  });
}

void along_ray_all(benchmark::State& state) {
  run(state, [](const BoxTree& tree, const Query& query, std::size_t& visits) {
    tree.along_ray(query.point, query.direction, 2000, [&](std::uint32_t index, double) {
      benchmark::DoNotOptimize(index);
      ++visits;
      return 2000.0;
    });
  });
}

void containing(benchmark::State& state) {
  run(state, [](const BoxTree& tree, const Query& query, std::size_t& visits) {
    tree.containing(query.point, [&](std::uint32_t index) {
      benchmark::DoNotOptimize(index);
      ++visits;
      return false;
    });
  });
}

void near(benchmark::State& state) {
  run(state, [](const BoxTree& tree, const Query& query, std::size_t& visits) {
    double radius = std::numeric_limits<double>::infinity();
    tree.near(query.point, radius, [&](std::uint32_t index, double bound) {
      benchmark::DoNotOptimize(index);
      ++visits;
      return radius = std::min(radius, bound);
    });
  });
}

/// Groups per cluster; 0 stands for linear.
void arguments(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"boxes", "stack", "groups"});
  for (const int shape : {grid, stack}) {
    for (const int count :
         {1, 4, 8, 12, 16, 20, 24, 32, 48, 64, 128, 256, 512, 1024, 2048, 4096, 10000}) {
      for (const int groups : {0, 1, 2, 4}) benchmark->Args({count, shape, groups});
    }
  }
}

BENCHMARK(along_ray)->Apply(arguments);
BENCHMARK(along_ray_all)->Apply(arguments);
BENCHMARK(containing)->Apply(arguments);
BENCHMARK(near)->Apply(arguments);

}  // namespace
}  // namespace navjit::bvh

BENCHMARK_MAIN();

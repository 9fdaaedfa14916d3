// Rays through worlds with every step kept, for comparison bit by bit.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "navjit/runtime.hpp"
#include "runtime/faulty_runtime.hpp"
#include "runtime/transport.hpp"
#include "tests/support/worlds.hpp"

namespace navjit::tests {

struct Row {
  TouchableId touchable;
  double length;
  VolumeId volume;
};

inline bool same_bits(const std::vector<Row>& a, const std::vector<Row>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].touchable != b[i].touchable || a[i].volume != b[i].volume ||
        !kernels::same_bits(a[i].length, b[i].length)) {
      return false;
    }
  }
  return true;
}

inline std::vector<Row> trace(Navigator& navigator, const Ray& ray, double tolerance) {
  std::vector<Row> rows;
  const RayTotals totals = transport(navigator, ray, tolerance, [&](const State& s, double length) {
    rows.push_back({s.touchable(), length, s.volume()});
  });
  EXPECT_FALSE(totals.stuck);
  return rows;
}

inline std::vector<Ray> rays_through(const World& world, std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  const Extent& e = world.volumes[world.top].solid.extent;
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    Ray ray{{uniform(random, e.min.x, e.max.x), uniform(random, e.min.y, e.max.y),
             uniform(random, e.min.z, e.max.z)},
            random_direction(random)};
    // Some along the axes, through rounded coordinates: faces and edges are hit exactly.
    if (i % 4 == 0) {
      ray.direction = i % 8 == 0 ? Vec3{0, 0, 1} : Vec3{-1, 0, 0};
      ray.position = {std::round(ray.position.x), std::round(ray.position.y),
                      std::round(ray.position.z)};
    }
    rays.push_back(ray);
  }
  return rays;
}

/// The number of rays whose traces differ in any bit from the generic ones.
inline std::size_t traces_that_differ(Runtime& runtime, const std::vector<Ray>& rays) {
  const World& world = runtime.world();
  Runtime generic(runtime.share_world(), {.jit = JitMode::off});
  Navigator a = generic.navigator(), b = runtime.navigator();
  return static_cast<std::size_t>(std::count_if(rays.begin(), rays.end(), [&](const Ray& ray) {
    return !same_bits(trace(a, ray, world.tolerance), trace(b, ray, world.tolerance));
  }));
}

/// The fraction of all steps so far that was made in scenes that are specialised now. Equal answers
/// prove nothing unless specialised navigators gave them.
inline double share_specialised(const Runtime& runtime) {
  double share = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    share += scene.status == SceneStatus::specialised ? scene.share : 0;
  }
  return share;
}

/// How many scenes have compiled code of their own now.
inline std::size_t scenes_compiled(const Runtime& runtime) {
  std::size_t count = 0;
  for (const SceneReport& scene : runtime.report().scenes) {
    count += scene.binding == Binding::constants ? 1 : 0;
  }
  return count;
}

inline std::shared_ptr<const Faults> edited(std::function<void(std::string&)> edit) {
  return std::make_shared<const Faults>(Faults{.edit_source = std::move(edit)});
}

/// Generated code whose steps are too long by a last bit, but which is installed nevertheless: for
/// tests of what has to notice it.
inline std::shared_ptr<const Faults> wrong_code() {
  const auto faults = std::make_shared<Faults>();
  faults->skip_verification = true;
  faults->edit_source = [](std::string& source) {
    const std::string right = "  return best;\n", wrong = "  return best * (1 + 0x1p-52);\n";
    for (std::size_t at = 0; (at = source.find(right, at)) != std::string::npos;
         at += wrong.size()) {
      source.replace(at, right.size(), wrong);
    }
  };
  return faults;
}

/// For small worlds and runs: everything is specialised early.
inline RuntimeOptions eager_options(JitMode jit) {
  RuntimeOptions o;
  o.jit = jit;
  o.specialiser.compile_weight = 1e-6;
  o.specialiser.min_steps = 200;
  o.specialiser.optimisation = 1;
  o.specialiser.keep_only_faster = false;
  o.specialiser.compile_first_ms = 1e9;
  return o;
}

}  // namespace navjit::tests

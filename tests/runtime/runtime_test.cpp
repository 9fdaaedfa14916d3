#include "navjit/runtime.hpp"
#include "geometry/navigation/generic.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>
#include <unordered_set>

#include "runtime/dispatch_table.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

RuntimeOptions generic_only() {
  RuntimeOptions options;
  options.jit = JitMode::off;
  return options;
}

TEST(Navigator, RefusesWhatIsNotFinite) {
  Runtime runtime(tests::mixed_world(), generic_only());
  Navigator navigator = runtime.navigator();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(navigator.locate({nan, 0, 0}), UsageError);
  EXPECT_THROW(navigator.locate({0, 0, 0}, {1, nan, 0}), UsageError);
  EXPECT_THROW(navigator.locate({0, std::numeric_limits<double>::infinity(), 0}), UsageError);
  const State inside = navigator.locate({0, 0, 0});
  ASSERT_TRUE(inside.inside());
  EXPECT_THROW(navigator.step(inside, {nan, 0, 0}, {1, 0, 0}), UsageError);
  EXPECT_THROW(navigator.step(State{}, {0, 0, 0}, {1, 0, 0}), UsageError);
}

TEST(Navigator, OutsideIsAState) {
  Runtime runtime(tests::mixed_world(), generic_only());
  Navigator navigator = runtime.navigator();
  EXPECT_FALSE(navigator.locate({1000, 0, 0}).inside());
  State state = navigator.locate({0, 0, 99});
  const Step step = navigator.step(state, {0, 0, 99}, {0, 0, 1});
  EXPECT_DOUBLE_EQ(step.length, 1);
  EXPECT_TRUE(step.boundary);
  EXPECT_FALSE(step.next.inside());
}

TEST(Navigator, AnOldStateGivesTheSameStepAgain) {
  Runtime runtime(tests::mixed_world(), generic_only());
  Navigator navigator = runtime.navigator();
  std::mt19937_64 random(1);
  std::unordered_set<State> seen;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p{tests::uniform(random, -99, 99), tests::uniform(random, -99, 99),
                 tests::uniform(random, -99, 99)};
    const Vec3 v = tests::random_direction(random);
    const State state = navigator.locate(p, v);
    seen.insert(state);
    const Step first = navigator.step(state, p, v);
    if (first.next.inside()) navigator.step(first.next, p + first.length * v, v);
    const Step again = navigator.step(state, p, v);  // the navigator has moved on since
    EXPECT_EQ(first.length, again.length);
    EXPECT_EQ(first.next, again.next);
    EXPECT_LE(navigator.safety(state, p), first.length);
  }
  EXPECT_GT(seen.size(), 20U);
  EXPECT_GT(navigator.counts().restored, 0U);
}

TEST(Report, CountsStepsPerVolume) {
  Runtime runtime(tests::mixed_world(), generic_only());
  Navigator navigator = runtime.navigator();
  std::uint64_t steps = 0;
  for (double y = -99; y < 99; y += 1.7) {
    Vec3 p{-99.5, y, 3};
    for (State s = navigator.locate(p); s.inside(); ++steps) {
      const Step step = navigator.step(s, p, {1, 0, 0});
      p.x += step.length;
      s = step.next;
    }
  }
  const RuntimeReport report = runtime.final_report();
  EXPECT_EQ(report.steps, steps);
  double share = 0;
  for (const SceneReport& scene : report.scenes) share += scene.share;
  EXPECT_NEAR(share, 1, 1e-12);
  ASSERT_FALSE(report.scenes.empty());
  EXPECT_GT(report.scenes[0].generic_ns_per_step, 0);
  EXPECT_EQ(report.scenes[0].status, SceneStatus::generic);
}

/// Counts the records that are alive.
struct Counted {
  static inline std::atomic<int> alive{0};
  kernels::DispatchEntry navigators;
  Counted() : navigators(generic::dispatch_entry) { ++alive; }
  Counted(const Counted&) = delete;
  ~Counted() { --alive; }
};

TEST(DispatchTable, FreesReplacedRecordsWhileThreadsNavigate) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  std::atomic<bool> stop{false};
  {
    DispatchTable table(geometry);
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        const auto read_side = table.add_thread();
        const auto stack = std::make_unique<NavigationStack>();
        while (!stop) {
          generic::locate(geometry, *stack, {-99, -40, 1}, {1, 0, 0});
          kernels::set_ray(*stack, 1, 0, 0);
          Vec3 p{-99, -40, 1};
          while (stack->depth >= 0) {
            read_side->enter();
            const auto volume = stack->levels[stack->depth].volume;
            const kernels::DispatchEntry* n = kernels::dispatch_entry_of(&table.context(), volume);
            p.x += n->step(stack.get(), &table.context(), n->data, p.x, p.y, p.z, 1e9);
            read_side->leave();
          }
        }
        table.remove_thread(read_side);
      });
    }
    for (int i = 0; i < 5000; ++i) {
      auto record = std::make_shared<Counted>();
      const kernels::DispatchEntry* published = &record->navigators;
      table.install(static_cast<VolumeId>(i) % static_cast<VolumeId>(geometry.size()), published,
                    std::move(record));
      // A thread that was preempted inside a navigator holds things up, but not for ever.
      const auto limit = static_cast<int>(geometry.size()) + 200;
      for (int patience = 0; Counted::alive > limit; ++patience) {
        ASSERT_LT(patience, 100000);
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        table.reclaim();
      }
    }
    stop = true;
    threads.clear();
    EXPECT_EQ(table.reclaim(), 0U);
    EXPECT_EQ(Counted::alive, static_cast<int>(geometry.size()));
  }
  EXPECT_EQ(Counted::alive, 0);
}

}  // namespace
}  // namespace navjit

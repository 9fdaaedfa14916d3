// Navigators are installed, replaced and deoptimised without pause while many threads navigate.
// Every trace has to be the generic navigator's, and memory constant. Exit status 1 if not.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include "codegen/module.hpp"
#include "geometry/navigation/generic.hpp"
#include "jit/compiler.hpp"
#include "jit/linker.hpp"
#include "runtime/dispatch_table.hpp"
#include "tests/stress/memory.hpp"
#include "tests/support/worlds.hpp"

namespace navjit {
namespace {

struct Options {
  unsigned threads = 16;
  double seconds = 60;         ///< at least
  std::uint64_t swaps = 0;     ///< at least
  double most_growth_mb = 16;  ///< of memory, after a tenth of the swaps
};

struct TraceRow {
  TouchableId touchable;
  double length;
};
using Trace = std::vector<TraceRow>;

struct Start {
  Vec3 point, direction;
};

bool same(const Trace& a, const Trace& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const TraceRow& left, const TraceRow& right) {
        return left.touchable == right.touchable && kernels::same_bits(left.length, right.length);
      });
}

/// Traces the whole ray, at each step with the navigators that the table has then.
void trace(const Geometry& geometry, const DispatchTable& table, ReadSide& read_side,
           NavigationStack& stack, const Start& start, Trace& rows) {
  rows.clear();
  const Vec3& d = start.direction;
  Vec3 p = start.point;
  generic::locate(geometry, stack, p, d);
  while (stack.depth >= 0 && rows.size() < 10000) {
    const TouchableId touchable = stack.levels[stack.depth].touchable;
    read_side.enter();
    const kernels::DispatchEntry* entry =
        kernels::dispatch_entry_of(&table.context(), stack.levels[stack.depth].volume);
    kernels::set_ray(stack, d.x, d.y, d.z);
    double length = entry->step(&stack, &table.context(), entry->data, p.x, p.y, p.z, 1e30);
    read_side.leave();
    if (length < 0) length = generic::step(geometry, stack, p, d, 1e30);
    rows.push_back({touchable, length});
    p += length * d;
  }
}

/// Linked code with its dispatch entries; the same object is linked again and again.
struct Linked {
  jit::Code code;
  std::vector<kernels::DispatchEntry> records;
};

class Swapper {
 public:
  Swapper(const Geometry& geometry, DispatchTable& table)
      : table_(table), linker_(check(jit::Linker::create({}))) {
    const WorldFacts facts = analyse_world(geometry);
    std::vector<VolumeId> hot;
    for (VolumeId v = 0; v < geometry.size(); ++v) {
      if (facts.first_equal[v] == v) hot.push_back(v);
    }
    module_ = codegen::generate(geometry, facts, hot);
    object_ = check(jit::compile(module_.source, "stress", {}));
  }

  std::size_t scenes() const { return module_.entries.size(); }
  std::uint64_t installed = 0, deoptimised = 0;

  void swap(std::mt19937_64& random) {
    const std::size_t which = random() % scenes();
    if (random() % 4 == 0) {
      table_.reset(module_.entries[which].volume);
      ++deoptimised;
      return;
    }
    auto linked = std::make_shared<Linked>(Linked{check(linker_.link(object_)), {}});
    for (const codegen::Entry& entry : module_.entries) {
      linked->records.push_back(
          {check(linked->code.function<std::remove_pointer_t<kernels::StepFunction>>(entry.step)),
           check(linked->code.function<std::remove_pointer_t<kernels::RelocateFunction>>(
               entry.relocate)),
           entry.safety.empty()
               ? generic::dispatch_entry.safety
               : check(linked->code.function<std::remove_pointer_t<kernels::SafetyFunction>>(
                     entry.safety)),
           module_.data, module_.data});
    }
    // One scene, or now and then all of the module.
    const bool all = random() % 8 == 0;
    for (std::size_t i = 0; i < scenes(); ++i) {
      if (i != which && !all) continue;
      table_.install(module_.entries[i].volume, &linked->records[i], linked);
      ++installed;
    }
  }

 private:
  template <class T>
  static T check(Expected<T> value) {
    if (!value) throw std::runtime_error(value.failure().message);
    return *std::move(value);
  }

  DispatchTable& table_;
  jit::Linker linker_;
  codegen::Module module_;
  jit::Object object_;
};

int run(const Options& options) {
  const Geometry geometry(std::make_shared<const World>(tests::mixed_world()));
  DispatchTable table(geometry);
  Swapper swapper(geometry, table);
  std::mt19937_64 random(1);
  std::vector<Start> starts;
  std::vector<Trace> expected;
  {
    const auto stack = std::make_unique<NavigationStack>();
    ReadSide alone;
    for (int i = 0; i < 500; ++i) {
      const auto coordinate = [&] { return tests::uniform(random, -99, 99); };
      starts.push_back(
          {{coordinate(), coordinate(), coordinate()}, tests::random_direction(random)});
      trace(geometry, table, alone, *stack, starts.back(), expected.emplace_back());
    }
  }
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> traces{0}, wrong{0};
  std::vector<std::jthread> threads;
  for (unsigned t = 0; t < options.threads; ++t) {
    threads.emplace_back([&, t] {
      const auto read_side = table.add_thread();
      const auto stack = std::make_unique<NavigationStack>();
      stack->depth = -1;
      Trace rows;
      for (std::size_t i = t; !stop; i = (i + 1) % starts.size()) {
        trace(geometry, table, *read_side, *stack, starts[i], rows);
        if (!same(rows, expected[i])) ++wrong;
        ++traces;
      }
      table.remove_thread(read_side);
    });
  }
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  std::uint64_t swaps = 0, most_waiting = 0;
  double early_mb = 0, most_mb = 0;
  while (seconds() < options.seconds || swaps < options.swaps) {
    swapper.swap(random);
    ++swaps;
    std::size_t waiting = table.reclaim();
    // A thread that was preempted inside a navigator holds things up, but not for ever.
    for (int patience = 0; waiting > 200 && patience < 100000; ++patience) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
      waiting = table.reclaim();
    }
    most_waiting = std::max<std::uint64_t>(most_waiting, waiting);
    if (swaps % 50 != 0) continue;
    const double mb = tests::resident_mb();
    const bool early = seconds() < 0.1 * options.seconds || swaps < options.swaps / 10;
    (early ? early_mb : most_mb) = std::max(early ? early_mb : most_mb, mb);
  }
  stop = true;
  threads.clear();
  const std::size_t left = table.reclaim();
  std::printf(
      "%u threads, %.1f s: %llu swaps (%llu scenes installed, %llu deoptimised), %llu traces, %llu "
      "wrong; at most %llu waited to be freed, %zu at the end; memory at most %.1f MB in the first "
      "tenth, %.1f MB after\n",
      options.threads, seconds(), static_cast<unsigned long long>(swaps),
      static_cast<unsigned long long>(swapper.installed),
      static_cast<unsigned long long>(swapper.deoptimised),
      static_cast<unsigned long long>(traces.load()), static_cast<unsigned long long>(wrong.load()),
      static_cast<unsigned long long>(most_waiting), left, early_mb, most_mb);
  const bool flat = early_mb == 0 || most_mb <= early_mb + options.most_growth_mb;
  if (!flat) std::printf("memory grew\n");
  return wrong == 0 && traces > 0 && left == 0 && flat ? 0 : 1;
}

}  // namespace
}  // namespace navjit

int main(int argc, char** argv) {
  navjit::Options options;
  CLI::App app{"Navigators swapped without pause under threads that use them"};
  app.add_option("--threads", options.threads)->check(CLI::Range(1, 1024));
  app.add_option("--seconds", options.seconds);
  app.add_option("--swaps", options.swaps);
  app.add_option("--most-growth-mb", options.most_growth_mb);
  CLI11_PARSE(app, argc, argv);
  return navjit::run(options);
}

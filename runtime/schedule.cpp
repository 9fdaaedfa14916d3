#include "runtime/schedule.hpp"

#include <algorithm>

#include "codegen/module.hpp"
#include "codegen/solids.hpp"

namespace navjit {
namespace {

// These were fitted by least squares of relative errors to the processor time of 191 scenes of
// seven detectors, each compiled alone. Nine in ten took 0.6 to 1.3 times the fitted time.
constexpr double leaf_ms = 10;       // step and relocation, with nothing in them
constexpr double daughters_ms = 32;  // searching daughters
constexpr double class_ms = 58;    // for each daughters' solid, inlined into all searches, and for
                                   // each further solid of a boolean
constexpr double number_ms = 0.6;  // for each number of the solids
constexpr double most_numbers_ms = 120;  // large solids are loops over tables

// The same for booleans that are compiled alone. Of 158 in eight detectors, nine in ten took 0.8 to
// 1.5 times this time and the module's.
constexpr double boolean_type_ms = 50;
constexpr double solid_kind_ms = 40;

// Medians over the scenes of the LHCb calorimeters, shashlik, testEm3 and ZNENV.
constexpr double leaf_gain_ns = 20;
constexpr double daughters_gain_ns = 60;

/// Factor on the weight while a processor is free. It is a choice, since the processor may belong
/// to another program.
constexpr double where_processors_are_left = 1.0 / 30;
/// Tolerance, in processors, because threads that wait now and then are not quite busy.
constexpr double nearly = 0.2;

/// A module may always be expected to take this long, ms. In smaller modules module_base_ms would
/// be too large a part. A guess.
constexpr double least_module_ms = 150;

/// The share of a run so far that a module may be expected to take. A guess.
constexpr double part_of_run = 0.3;

/// Scenes that have this share of what makes them due are compiled together with one that is due.
constexpr double soon = 0.3;

/// The gain from compiling the scene, for its recent executions, ns; and the same for each ms of
/// compiling.
double worth(const Candidate& c) { return c.recent * c.gain_ns; }
double urgency(const Candidate& c) { return worth(c) / c.compile_ms; }

/// Of the scenes that are too long for a module with others, the one that gains most for its cost,
/// if this is more than `most`; null if there is none.
const Candidate* fills_a_module(std::span<const Candidate> due, const SpecialiserOptions& options,
                                double most) {
  const Candidate* best = nullptr;
  for (const Candidate& c : due) {
    const double expected = module_base_ms + c.compile_ms;
    if (expected <= options.module_ms || worth(c) / expected <= most) continue;
    most = worth(c) / expected;
    best = &c;
  }
  return best;
}

}  // namespace

double expected_compile_ms(const Geometry& geometry, const ScenePlan& plan) {
  return leaf_ms + (plan.classes.empty() ? 0 : daughters_ms) +
         class_ms * static_cast<double>(codegen::solids_of(geometry, plan) - 1) +
         std::min(most_numbers_ms,
                  number_ms * static_cast<double>(numbers_of_solids(geometry, plan)));
}

double expected_compile_ms(const kernels::AnySolid<double>& solid) {
  const codegen::SolidTypes types = codegen::types_in(solid);
  return boolean_type_ms * static_cast<double>(types.composed) +
         solid_kind_ms * static_cast<double>(types.plain);
}

double expected_gain_ns(const ScenePlan& plan) {
  return plan.classes.empty() ? leaf_gain_ns : daughters_gain_ns;
}

double weight_of_compiling(double weight, double busy_threads, unsigned processors) {
  return busy_threads + 1 > processors + nearly ? weight : weight * where_processors_are_left;
}

double most_module_ms(double seconds, const SpecialiserOptions& options) {
  return std::min(options.module_ms, std::max(least_module_ms, part_of_run * 1e3 * seconds));
}

double times_paid(const Candidate& c, const SpecialiserOptions& options) {
  return c.executions * c.gain_ns / (options.compile_weight * c.compile_ms * 1e6);
}

bool is_due(const Candidate& c, const SpecialiserOptions& options, double part) {
  return c.executions >= part * static_cast<double>(options.min_steps) &&
         times_paid(c, options) >= part;
}

std::vector<VolumeId> next_module(std::span<const Candidate> candidates,
                                  const SpecialiserOptions& options, double least) {
  std::vector<Candidate> due, later;
  for (const Candidate& c : candidates) {
    if (is_due(c, options)) {
      due.push_back(c);
    } else if (is_due(c, options, soon)) {
      later.push_back(c);
    }
  }
  std::vector<VolumeId> chosen;
  if (due.empty()) return chosen;
  double expected = module_base_ms, won = 0;
  for (std::vector<Candidate>* some : {&due, &later}) {
    std::stable_sort(some->begin(), some->end(), [](const Candidate& a, const Candidate& b) {
      return urgency(a) > urgency(b);
    });
    for (const Candidate& c : *some) {
      if (chosen.size() == options.batch) break;
      if (expected > least_module_ms && times_paid(c, options) < least) continue;
      if (expected + c.compile_ms > options.module_ms) continue;
      expected += c.compile_ms;
      won += worth(c);
      chosen.push_back(c.volume);
    }
    if (some == &later) break;
    // A scene that fills a module alone comes first if it gains more for its cost.
    const double most = chosen.empty() ? -1 : won / expected;
    if (const Candidate* alone = fills_a_module(due, options, most)) return {alone->volume};
  }
  return chosen;
}

}  // namespace navjit

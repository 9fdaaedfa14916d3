#include "runtime/bind_to_data.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <set>

#include "analysis/plan.hpp"
#include "codegen/data/bind.hpp"
#include "geometry/navigation/generic.hpp"
#include "runtime/judge.hpp"
#include "runtime/log_text.hpp"
#include "runtime/measured_search.hpp"
#include "runtime/verify.hpp"

namespace navjit {
namespace {

/// A scene with fewer steps is not bound, because too little is known of the states that occur in
/// it.
constexpr std::uint64_t least_steps = 500;
/// How long one call of bind_hot_to_data() may bind, so that other work of the thread is not put
/// off for long.
constexpr double most_ms = 20;
/// How many made-up states verify a volume, besides the recorded ones. Few are enough: the code is
/// the library's own, and only the data can be wrong. A volume with more daughters gets a state for
/// each of them, up to the second number, since a few daughters may be unlike the others.
constexpr std::size_t states_made_up = 64, most_states_made_up = 512;
constexpr std::size_t states_made_up_for_one_of_many = 8;
/// When all scenes are bound, this many leaf volumes of one mother are timed one by one. Further
/// ones are bound without timing, each being one of many that are alike.
constexpr std::size_t leaves_alone = 32;
/// The least share of all steps for a scene to be bound by itself. A guess.
constexpr double least_share = 0.0005;
/// Scenes that are too rare for that are bound together, whatever their mothers, once they have
/// this many times the least share in total: 2% of all steps. A guess.
constexpr std::uint64_t many_shares = 40;
/// For scenes with no more daughters than this the search matters little, and is not timed. A
/// guess.
constexpr std::size_t few_daughters = 8;
/// A navigator that takes longer than this many times the generic navigator's time on recorded
/// states is not tried in the run: steps in a run take longer than replayed ones, with either
/// navigator. A guess.
constexpr double most_of_generic = 1.1;

/// A second way to bind a scene that is slower than this many times the fastest one on recorded
/// states is not tried in the run. A guess.
constexpr double most_of_best = 1.5;

/// The other searches with which the scene is bound, besides the one that the analysis chose.
std::vector<Candidates> other_searches(const Scene& scene, const ScenePlan& plan) {
  std::vector<Candidates> others;
  if (!plan.slabs.members.empty() && plan.candidates != Candidates::slabs) {
    others.push_back(Candidates::slabs);
  }
  if (may_be_scanned(plan.boxes.size()) && plan.candidates != Candidates::scan) {
    others.push_back(Candidates::scan);
  }
  if (may_be_grouped(plan.boxes.size())) others.push_back(Candidates::groups);
  if (!plan.rings.rings.empty() && plan.candidates != Candidates::rings) {
    others.push_back(Candidates::rings);
  }
  if (scene.boxes) others.push_back(Candidates::tree);
  return others;
}

/// How many different shapes of the scene have compiled code.
std::size_t compiled_solids(const codegen::CodeOfSolids& code, const Scene& scene) {
  std::set<const void*> shapes{scene.solid.shape};
  for (const Daughter& d : scene.daughters) shapes.insert(d.solid.shape);
  return static_cast<std::size_t>(
      std::count_if(shapes.begin(), shapes.end(), [&](const void* s) { return code.contains(s); }));
}

/// Binds the plan to data, with the code that was compiled for its solids so far.
const kernels::DispatchEntry* bind(Specialisation& spec, const ScenePlan& plan) {
  const Geometry& geometry = spec.shared->geometry;
  const kernels::DispatchEntry* entry =
      codegen::bind_to_data(geometry, plan, *spec.arena, &spec.code_of_solids);
  if (spec.code_of_solids.empty()) return entry;
  const std::size_t compiled = compiled_solids(spec.code_of_solids, geometry.scene(plan.volume));
  const std::lock_guard lock(spec.mutex);
  if (compiled > 0) spec.compiled_solids[entry] = compiled;
  return entry;
}

/// Some searches leave the safety to the generic navigator. If the daughters of the scene are also
/// layers, this gives such a navigator the safety of the layers, which is bound once for all ways
/// to bind the scene.
class SafetyOfLayers {
 public:
  SafetyOfLayers(Specialisation& spec, const ScenePlan& plan) : spec_(spec), plan_(plan) {}

  const kernels::DispatchEntry* added_to(const kernels::DispatchEntry* entry) {
    if (!plan_.layers.found() || entry->safety != generic::dispatch_entry.safety) return entry;
    if (by_layers_ == nullptr) {
      plan_.candidates = Candidates::layers;
      by_layers_ = bind(spec_, plan_);
    }
    kernels::DispatchEntry* const both = spec_.arena->array<kernels::DispatchEntry>(1);
    *both = *entry;
    both->safety = by_layers_->safety;
    both->safety_data = by_layers_->safety_data;
    const std::lock_guard lock(spec_.mutex);
    const auto compiled = spec_.compiled_solids.find(entry);
    if (compiled != spec_.compiled_solids.end()) spec_.compiled_solids[both] = compiled->second;
    return both;
  }

 private:
  Specialisation& spec_;
  ScenePlan plan_;
  const kernels::DispatchEntry* by_layers_ = nullptr;
};

/// Which navigator computes the safety, as a word for the log.
std::string_view safety_of(const kernels::DispatchEntry& entry) {
  return entry.safety == generic::dispatch_entry.safety ? "generic"
         : entry.safety_data != entry.data              ? "layers"
                                                        : "own";
}

struct Bound {
  const kernels::DispatchEntry* entry;
  std::string structure;
  double ns;  ///< time of a step on replayed states
};

/// The scene bound in each way that may be the best, the fastest first.
std::vector<Bound> bind_in_all_ways(Specialisation& spec, VolumeId volume, bool forced,
                                    const std::vector<Sample>& samples) {
  const Geometry& geometry = spec.shared->geometry;
  std::vector<ScenePlan> plans{plan_without_measurement(spec, volume)};
  const Candidates chosen = plans[0].candidates;
  const bool for_safety = chosen == Candidates::slabs || chosen == Candidates::wires;
  if (!forced && plans[0].layers.found() && !for_safety) plans[0].candidates = Candidates::layers;
  if (!forced) {
    for (const Candidates other : other_searches(geometry.scene(volume), plans[0])) {
      plans.push_back(plans[0]);
      plans.back().candidates = other;
    }
  }
  std::vector<Bound> all;
  SafetyOfLayers safety(spec, plans[0]);
  for (const ScenePlan& plan : plans) {
    const kernels::DispatchEntry* entry = safety.added_to(bind(spec, plan));
    if (plan.candidates != chosen) spec.searches[entry] = plan.candidates;
    const double ns = time_per_step(geometry, spec.shared->table.context(), *entry, samples);
    const bool is_fastest = spec.shared->faults.fastest == plan.candidates;
    all.push_back({entry, codegen::structure_of(geometry, plan), is_fastest ? 0 : ns});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Bound& a, const Bound& b) { return a.ns < b.ns; });
  return all;
}

}  // namespace

void bind_to_data(Specialisation& spec, VolumeId volume) {
  if (!spec.bound.insert(volume).second) return;
  const Geometry& geometry = spec.shared->geometry;
  const kernels::Context& context = spec.shared->table.context();
  const bool forced = spec.forced.contains(spec.facts.first_equal[volume]);
  const bool only_if_faster = spec.shared->options.specialiser.keep_only_faster && !forced;
  std::vector<Sample> samples = spec.samples[volume];
  if (samples.size() < few_recorded) samples.clear();
  const bool recorded = !samples.empty();
  const std::size_t states =
      std::clamp(geometry.scene(volume).daughters.size(), states_made_up, most_states_made_up);
  const std::vector<Sample> made_up = spec.sampler.states(volume, states, volume + 1);
  if (!recorded) samples = made_up;

  std::vector<Bound> ways = bind_in_all_ways(spec, volume, forced, samples);
  const double generic_ns = time_per_step(geometry, context, generic::dispatch_entry, samples);
  if (recorded) samples.insert(samples.end(), made_up.begin(), made_up.end());
  // A way that is wrong is not used, and the others may be right.
  std::string problem;
  std::erase_if(ways, [&](const Bound& way) {
    std::string its = verify(geometry, context, *way.entry, volume, samples);
    if (spec.shared->faults.fail_verification) its = injected_failure;
    if (its.empty()) return false;
    problem = its == no_state_to_verify_on ? its : way.structure + ": " + its;
    return true;
  });
  if (ways.empty()) {
    note_failure(spec, volume, problem);
    return;
  }
  if (!problem.empty()) {
    spec.shared->log->warn("scene {} is not bound in one of the ways: {}",
                           geometry.world().volumes[volume].name, one_line(problem));
  }
  // A scene with few recorded states of its own is installed whatever the timing says, and the run
  // judges it. Most of its work is relocation at the end of other scenes' steps, about which
  // made-up steps say nothing.
  if (only_if_faster && recorded) {
    std::erase_if(ways, [&](const Bound& b) { return b.ns > most_of_generic * generic_ns; });
  }
  const bool pays = !ways.empty();
  spec.shared->log->debug(
      "event=bound at_s={:.3f} scene={} structure={} safety={} generic_ns={:.1f} bound_ns={:.1f} "
      "verdict={}",
      spec.seconds(), in_quotes(geometry.world().volumes[volume].name),
      in_quotes(pays ? ways[0].structure : "any"),
      safety_of(pays ? *ways[0].entry : generic::dispatch_entry), generic_ns,
      pays ? ways[0].ns : 0.0, pays ? "installed" : "slower");
  if (pays) {
    spec.shared->table.install(volume, ways[0].entry, spec.arena);
    spec.without_code[volume] = ways[0].entry;
    // Made-up states are not those of any run, and code must not depend on timings with them.
    if (recorded || spec.shared->faults.fastest) search_as_bound(spec, volume);
    try_out(spec, volume, ways[0].entry, spec.arena);
    if (ways.size() > 1 && only_if_faster && ways[1].ns <= most_of_best * ways[0].ns) {
      spec.second_choices[volume] = ways[1].entry;
    }
  }
  const std::lock_guard lock(spec.mutex);
  SceneReport& scene = spec.scenes[volume];
  scene.generic_ns_per_step = generic_ns;
  if (!pays) return;
  scene.binding = Binding::data;
  scene.specialised_ns_per_step = ways[0].ns;
  scene.swapped_at_s = spec.seconds();
}

namespace {

/// Binds a scene that is one of many alike, without timing it. It has the same code as the others,
/// and the same gain.
void bind_one_of_many(Specialisation& spec, VolumeId volume) {
  if (!spec.bound.insert(volume).second) return;
  const Geometry& geometry = spec.shared->geometry;
  const ScenePlan plan = plan_scene(geometry, spec.facts, volume);
  const kernels::DispatchEntry* entry = bind(spec, plan);
  const std::vector<Sample> states =
      spec.sampler.states(volume, states_made_up_for_one_of_many, volume + 1);
  std::string problem = verify(geometry, spec.shared->table.context(), *entry, volume, states);
  if (spec.shared->faults.fail_verification) problem = injected_failure;
  if (!problem.empty()) {
    note_failure(spec, volume, problem);
    return;
  }
  spec.shared->table.install(volume, entry, spec.arena);
  spec.without_code[volume] = entry;
  try_out(spec, volume, entry, spec.arena);
  const std::lock_guard lock(spec.mutex);
  SceneReport& scene = spec.scenes[volume];
  scene.binding = Binding::data;
  scene.swapped_at_s = spec.seconds();
}

/// Scenes that are each rare and together hot: wires of many lengths in one mother, crystals of
/// many shapes, or the plates and gaps of a calorimeter in which every layer has volumes of its
/// own. A track that leaves an unbound scene is relocated by the generic navigator, which in some
/// mothers takes far longer than everything else.
std::vector<VolumeId> many_rare_scenes(const Specialisation& spec, std::uint64_t least) {
  const Geometry& geometry = spec.shared->geometry;
  const auto is_leaf = [&](VolumeId v) {
    return geometry.scene(v).daughters.empty() && !spec.bound.contains(v);
  };
  std::set<VolumeId> rare, others;
  std::uint64_t steps_of_others = 0;
  for (VolumeId v = 0; v < geometry.size(); ++v) {
    if (spec.steps[v] == 0 || spec.bound.contains(v)) continue;
    if (geometry.scene(v).daughters.size() > few_daughters) continue;
    others.insert(v);
    steps_of_others += spec.steps[v];
  }
  if (steps_of_others < least) return {};
  for (const VolumeId mother : spec.bound) {
    std::set<VolumeId> met;
    std::uint64_t steps = 0;
    const auto daughters = geometry.scene(mother).daughters;
    for (const Daughter& d : daughters) {
      if (spec.steps[d.volume] == 0 || !is_leaf(d.volume)) continue;
      if (met.insert(d.volume).second) steps += spec.steps[d.volume];
    }
    if (steps < least) continue;
    for (const Daughter& d : daughters) {
      if (!is_leaf(d.volume)) continue;
      rare.insert(d.volume);
      if (others.erase(d.volume) > 0) steps_of_others -= spec.steps[d.volume];
    }
  }
  if (steps_of_others >= many_shares * least) rare.merge(others);
  return {rare.begin(), rare.end()};
}

}  // namespace

bool bind_hot_to_data(Specialisation& spec) {
  std::vector<VolumeId> hot;
  std::uint64_t all = 0;
  for (const std::uint64_t steps : spec.steps) all += steps;
  const auto least =
      std::max(least_steps, static_cast<std::uint64_t>(least_share * static_cast<double>(all)));
  for (std::size_t v = 0; v < spec.steps.size(); ++v) {
    const auto volume = static_cast<VolumeId>(v);
    if (spec.executions(volume) >= static_cast<double>(least) && !spec.bound.contains(volume)) {
      hot.push_back(volume);
    }
  }
  std::stable_sort(hot.begin(), hot.end(),
                   [&](VolumeId a, VolumeId b) { return spec.executions(a) > spec.executions(b); });
  const double until = steady_seconds() + most_ms * 1e-3;
  for (const VolumeId volume : hot) {
    if (spec.stopping() || steady_seconds() > until) return true;
    bind_to_data(spec, volume);
  }
  // Once the list is due it is worked off completely, even if the rest of it would not be due by
  // itself.
  if (spec.rare_due.empty() && all >= spec.rare_again_at) {
    spec.rare_due = many_rare_scenes(spec, least);
    // The search looks at every daughter of every bound scene, so it is not made at every look at
    // the profile.
    if (spec.rare_due.empty()) spec.rare_again_at = all / 8 * 9;
  }
  while (!spec.rare_due.empty()) {
    if (spec.stopping() || steady_seconds() > until) return true;
    bind_one_of_many(spec, spec.rare_due.back());
    spec.rare_due.pop_back();
  }
  return false;
}

void bind_all_to_data(Specialisation& spec) {
  const Geometry& geometry = spec.shared->geometry;
  // Mothers come first. A track that leaves a daughter is then relocated by a navigator that is
  // bound, which in a plane of thousands of wires is much faster.
  std::vector<VolumeId> order{geometry.world().top};
  std::vector<char> met(geometry.size(), 0);
  met[geometry.world().top] = 1;
  for (std::size_t i = 0; i < order.size() && !spec.stopping(); ++i) {
    bind_to_data(spec, order[i]);
    std::size_t leaves = 0;
    for (const Daughter& d : geometry.scene(order[i]).daughters) {
      if (met[d.volume] != 0) continue;
      met[d.volume] = 1;
      const bool leaf = geometry.scene(d.volume).daughters.empty();
      if (leaf && ++leaves > leaves_alone) {
        bind_one_of_many(spec, d.volume);
      } else {
        order.push_back(d.volume);
      }
    }
  }
}

double bound_ns(const Specialisation& spec, VolumeId volume) {
  const std::lock_guard lock(spec.mutex);
  const auto known = spec.scenes.find(volume);
  return known != spec.scenes.end() && known->second.specialised_ns_per_step > 0 &&
                 (known->second.binding == Binding::data ||
                  known->second.binding == Binding::structure)
             ? known->second.specialised_ns_per_step
             : std::numeric_limits<double>::infinity();
}

}  // namespace navjit

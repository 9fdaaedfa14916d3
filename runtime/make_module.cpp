#include "runtime/make_module.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "geometry/navigation/generic.hpp"
#include "runtime/compile.hpp"
#include "runtime/install.hpp"
#include "runtime/log_text.hpp"
#include "runtime/measured_search.hpp"

namespace navjit {
namespace {

/// The label of a module in the cache, for people: how many scenes, and the first of them.
std::string label_of(const World& world, const Batch& batch) {
  std::string label = std::to_string(batch.size()) + (batch.size() == 1 ? " scene: " : " scenes: ");
  for (std::size_t i = 0; i < batch.size() && label.size() < 160; ++i) {
    label += (i == 0 ? "" : ", ") + world.volumes[batch[i]].name;
  }
  return label;
}

/// How many of the recorded rays are parallel to one of the planes that two of the scene's axes
/// span.
std::size_t along_axes(const Geometry& geometry, const std::vector<Sample>& samples) {
  const auto stack = std::make_unique<NavigationStack>();
  stack->depth = -1;
  return static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [&](const Sample& s) {
        generic::restore(geometry, *stack, s.touchable);
        return !kernels::is_oblique(kernels::to_local_heading(
            stack->levels[stack->depth], s.direction.x, s.direction.y, s.direction.z));
      }));
}

// Each batch below holds the first volume of each group of equal volumes.

/// Whether many steps of these scenes are along faces, so that their navigators have to make them.
bool takes_rays_along_faces(Specialisation& spec, const Batch& batch) {
  std::size_t along = 0, all = 0;
  for (const VolumeId volume : batch) {
    if (spec.left_out_too_much.contains(volume)) return true;
    for (const VolumeId equal : spec.facts.equals[volume]) {
      along += along_axes(spec.shared->geometry, spec.samples[equal]);
      all += spec.samples[equal].size();
    }
  }
  return along * bail_out_share > all;
}

/// Whether most recorded steps in leaves of these scenes end on a boundary. Straight rays go from
/// one leaf to the next, and particles that scatter stay.
codegen::Leaves leaves_of(Specialisation& spec, const Batch& batch) {
  std::size_t crossing = 0, all = 0;
  for (const VolumeId volume : batch) {
    if (!spec.shared->geometry.scene(volume).daughters.empty()) continue;
    for (const VolumeId equal : spec.facts.equals[volume]) {
      for (const Sample& s : spec.samples[equal]) {
        if (s.question != Question::step) continue;
        ++all;
        crossing += s.relocation_count > 0 ? 1 : 0;
      }
    }
  }
  return 2 * crossing > all ? codegen::Leaves::shared : codegen::Leaves::apart;
}

/// The time that the cost model expects for a module, ms; 0 if one of its scenes was not estimated.
double expected_ms(Specialisation& spec, const Batch& batch) {
  double sum = module_base_ms;
  for (const VolumeId volume : batch) {
    const auto known = spec.candidates.find(volume);
    if (known == spec.candidates.end()) return 0;
    sum += known->second.compile_ms;
  }
  return sum;
}

std::vector<ListedModule> without_module(Specialisation& spec, const Batch& batch,
                                         const Failure& failure) {
  const std::string& why = failure.message;
  if (nothing_more(spec, failure)) {
    for (const VolumeId volume : batch) note(spec, volume, SceneStatus::generic, why);
    return {};
  }
  if (batch.size() > 1) {
    // One of the scenes may have spoilt the module for all of them.
    std::vector<ListedModule> made;
    for (const VolumeId volume : batch) {
      if (spec.hopeless || spec.stopping()) break;
      for (ListedModule& alone : make_modules(spec, {volume})) made.push_back(std::move(alone));
    }
    return made;
  }
  note_failure(spec, batch[0], why);
  return {};
}

}  // namespace

void count_in_vain(Specialisation& spec, double start) {
  const std::lock_guard lock(spec.mutex);
  spec.totals.compile_ms += (steady_seconds() - start) * 1e3;
}

bool nothing_more(Specialisation& spec, const Failure& failure) {
  if (!failure.exhausted && spec.maker->no_compiler().empty() && spec.maker->no_linker().empty()) {
    return false;
  }
  spec.shared->log->warn("nothing more is specialised in this run: {}", one_line(failure.message));
  spec.hopeless = true;
  return true;
}

codegen::Module generate(Specialisation& spec, const Batch& batch, bool along_faces,
                         codegen::Leaves leaves) {
  spec.facts.along_faces.clear();
  if (along_faces) {
    for (const VolumeId volume : batch)
      spec.facts.along_faces.insert(spec.facts.first_equal[volume]);
  }
  return codegen::generate(spec.shared->geometry, spec.facts, batch, leaves);
}

std::vector<ListedModule> make_modules(Specialisation& spec, const Batch& batch) {
  const double start = steady_seconds(), own_start = spec.own_seconds();
  codegen::Module module =
      generate(spec, batch, takes_rays_along_faces(spec, batch), leaves_of(spec, batch));
  // While it is compiled, other searches may be measured.
  const ListedModule listed = to_be_listed(spec, batch);
  if (spec.shared->faults.edit_source) spec.shared->faults.edit_source(module.source);
  if (auto found = spec.maker->find(module.source)) {
    if (install(spec, module, std::move(found->code), true, start)) return {listed};
    if (spec.stopping()) return {};
    spec.maker->reject(module.source);
  }
  auto made = compile(spec, module.source);
  if (!made) {
    if (made.failure().stopped) return {};
    count_in_vain(spec, start);
    return without_module(spec, batch, made.failure());
  }
  const jit::CompileReport& report = made->object.report;
  // Processor time is compared, because time spent waiting on a busy machine is no reason to
  // compile less.
  const double expected = expected_ms(spec, batch), took = (spec.own_seconds() - own_start) * 1e3;
  if (expected > 0) {
    spec.expected_ms += expected;
    spec.compiled_ms += took;
  }
  spec.shared->log->debug(
      "event=compiled at_s={:.3f} scenes={} ms={:.0f} expected_ms={:.0f} source_kb={} "
      "frontend_ms={:.0f} optimise_ms={:.0f} codegen_ms={:.0f} code_kb={}",
      spec.seconds(), batch.size(), took, expected, module.source.size() / 1024, report.frontend_ms,
      report.optimise_ms, report.codegen_ms, report.code_bytes / 1024);
  if (install(spec, module, std::move(made->code), false, start)) {
    spec.maker->keep(module.source, label_of(spec.shared->geometry.world(), batch), made->object);
  }
  return {listed};
}

}  // namespace navjit

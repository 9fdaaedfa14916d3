#include "runtime/specialisation.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <thread>

#include "runtime/log_text.hpp"
#include "runtime/processor_time.hpp"
#include "runtime/verify.hpp"

namespace navjit {

Specialisation::Specialisation(std::shared_ptr<detail::Shared> runtime)
    : shared(std::move(runtime)),
      facts(analyse_world(shared->geometry)),
      sampler(shared->geometry),
      steps(shared->geometry.size(), 0),
      relocations(shared->geometry.size(), 0),
      execution_counts(shared->geometry.size(), 0),
      recent(shared->geometry.size(), 0),
      started_at(steady_seconds()),
      process_s_before(process_seconds()) {}

double Specialisation::seconds() const { return steady_seconds() - started_at; }

bool Specialisation::allowance_is_used_up() const {
  const SpecialiserOptions& options = shared->options.specialiser;
  return totals.compile_ms > options.compile_first_ms + options.compile_share * 1e3 * seconds();
}

double Specialisation::own_seconds() const {
  return thread_seconds() + (maker ? maker->processor_seconds() : 0);
}

double Specialisation::poll_ms() const {
  constexpr double hour_ms = 3.6e6;
  return std::clamp(shared->options.specialiser.poll_ms, 0.1, hour_ms);
}

double Specialisation::compile_weight() const {
  const double weight = shared->options.specialiser.compile_weight;
  const double busy = navigated_s() / std::max(seconds(), 1e-3);
  return weight_of_compiling(weight, busy, std::thread::hardware_concurrency());
}

VolumeId hottest_equal(const Specialisation& spec, VolumeId first) {
  const std::vector<VolumeId>& equals = spec.facts.equals[first];
  return *std::max_element(equals.begin(), equals.end(), [&](VolumeId a, VolumeId b) {
    return spec.executions(a) < spec.executions(b);
  });
}

void have_bound(Specialisation& spec, VolumeId volume) {
  if (!spec.without_code.contains(volume)) spec.bound.erase(volume);
}

void note(Specialisation& spec, VolumeId volume, SceneStatus status, const std::string& why) {
  spec.shared->log->debug("event=status at_s={:.3f} scene={} status={} why={}", spec.seconds(),
                          in_quotes(spec.shared->geometry.world().volumes[volume].name),
                          status_name(status), in_quotes(why));
  const std::lock_guard lock(spec.mutex);
  for (const VolumeId equal : spec.facts.equals[volume]) {
    if (spec.off.contains(equal)) continue;
    SceneReport& scene = spec.scenes[equal];
    scene.status = status;
    scene.note = why;
  }
}

void note_failure(Specialisation& spec, VolumeId volume, const std::string& why) {
  const std::lock_guard lock(spec.mutex);
  if (why == no_state_to_verify_on) {
    // The volume holds hardly a point, and so hardly a step: nothing is wrong with the code.
    spec.shared->log->debug("event=unverified scene={}",
                            in_quotes(spec.shared->geometry.world().volumes[volume].name));
    spec.scenes[volume].note = why;
    return;
  }
  spec.shared->log->warn(
      "scene {} stays {}: {}", spec.shared->geometry.world().volumes[volume].name,
      spec.scenes[volume].binding == Binding::generic ? "generic" : "bound as before",
      one_line(why));
  spec.scenes[volume].status = SceneStatus::failed;
  spec.scenes[volume].note = why;
}

}  // namespace navjit

#include "runtime/compile.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <future>
#include <new>

#include "jit/activity.hpp"
#include "runtime/bind_to_data.hpp"
#include "runtime/gather.hpp"
#include "runtime/judge.hpp"
#include "runtime/own_thread.hpp"
#include "runtime/processor_time.hpp"

namespace navjit {
namespace {

using Made = Expected<CodeMaker::Made>;

/// Everything that the compiling thread uses. It must not use anything else, because it may outlive
/// the run.
struct Job {
  std::unique_ptr<jit::Activity> activity;  // released after everything else
  std::shared_ptr<CodeMaker> maker;
  std::shared_ptr<detail::Shared> shared;
  std::string source;
  std::stop_token stop;
  std::promise<Made> made;
};

void work(std::unique_ptr<Job> job) {
  const std::unique_ptr<jit::Activity> until_the_end = std::move(job->activity);
  Made made = stopped();
  try {
    if (job->shared->faults.compiling) job->shared->faults.compiling();
    made = job->maker->compile(job->source, job->stop);
  } catch (const std::bad_alloc&) {
    made = out_of_memory();
  } catch (const std::exception& error) {
    made = Failure{error.what()};
  }
  job->made.set_value(std::move(made));
  job.reset();
}

bool is_ready(const std::future<Made>& made) {
  return made.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

/// The work that goes on while the compiler runs. None of it depends on what is being compiled.
void look_meanwhile(Specialisation& spec) {
  gather(spec);
  bind_hot_to_data(spec);
  if (!spec.trials.nearly_all_decided()) judge(spec);
}

}  // namespace

Made compile(Specialisation& spec, const std::string& source) {
  // The compiler's processor time is asked for while it works, so it must exist before the thread
  // starts.
  spec.maker->make_compiler();
  if (spec.stopping()) return stopped();
  auto job = std::make_unique<Job>(Job{std::make_unique<jit::Activity>(spec.stop),
                                       spec.maker,
                                       spec.shared,
                                       source,
                                       spec.stop.get_token(),
                                       {}});
  std::future<Made> made = job->made.get_future();
  try {
    own_thread(work, std::move(job)).detach();
  } catch (const std::exception& error) {
    return Failure{std::string("no thread to compile on: ") + error.what(), /*exhausted=*/true};
  }
  double pause = 1;  // in units of poll_ms
  while (true) {
    const double look_at = steady_seconds() + 1e-3 * pause * spec.poll_ms();
    // The compiling thread may outlive the run, so it cannot notify this thread, which polls
    // instead.
    for (double left = look_at - steady_seconds(); left > 0 && !spec.stopping() && !is_ready(made);
         left = look_at - steady_seconds()) {
      std::unique_lock lock(spec.mutex);
      spec.wake.wait_for(lock, std::chrono::duration<double>(std::min(left, 5e-3)));
    }
    if (spec.stopping()) return stopped();
    if (is_ready(made)) break;
    if (!spec.looking) continue;
    const double began_s = thread_seconds();
    look_meanwhile(spec);
    pause = pause_after(spec.pace, {.took_s = thread_seconds() - began_s,
                                    .navigated_s = spec.navigated_s(),
                                    .poll_s = 1e-3 * spec.poll_ms()});
  }
  if (spec.looking) show_candidates(spec);
  return made.get();
}

}  // namespace navjit

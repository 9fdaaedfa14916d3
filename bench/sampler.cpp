#include "bench/sampler.hpp"

#include <signal.h>
#include <sys/syscall.h>
#include <time.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "navjit/errors.hpp"

namespace navjit::bench {

thread_local volatile std::uint32_t sampled_scene = 0;

namespace {

// A signal handler can reach its data in no other way.
std::vector<CodeSample> samples;
std::atomic<std::size_t> taken{0};

/// Prime, so that it does not beat with the work that is measured; ns.
constexpr long period = 97'003;

void look([[maybe_unused]] int signal, siginfo_t*, [[maybe_unused]] void* context) {
#if defined(__x86_64__)
  const std::size_t at = taken.load(std::memory_order_relaxed);
  if (at == samples.size()) return;
  const auto* machine = static_cast<const ucontext_t*>(context);
  samples[at] = {static_cast<std::uint64_t>(machine->uc_mcontext.gregs[REG_RIP]), sampled_scene};
  taken.store(at + 1, std::memory_order_relaxed);
#endif
}

void set(void* timer, long ns) {
  itimerspec spec{{0, ns}, {0, ns}};
  timer_settime(static_cast<timer_t>(timer), 0, &spec, nullptr);
}

}  // namespace

Sampler::Sampler() {
  samples.assign(most_samples, {});
  taken = 0;
  struct sigaction action {};
  action.sa_sigaction = look;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  sigaction(SIGPROF, &action, nullptr);
  sigaction(SIGTRAP, &action, nullptr);
  sigevent event{};
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = SIGPROF;
  event._sigev_un._tid = static_cast<pid_t>(syscall(SYS_gettid));
  timer_t timer{};
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0) {
    throw Error(std::string("no timer for sampling: ") + std::strerror(errno));
  }
  timer_ = timer;
}

Sampler::~Sampler() { timer_delete(static_cast<timer_t>(timer_)); }

void Sampler::start() { set(timer_, period); }
void Sampler::stop() { set(timer_, 0); }

bool Sampler::start_stepping() {
#if defined(__x86_64__)
  asm volatile("pushfq\n\torq $0x100, (%%rsp)\n\tpopfq" ::: "memory", "cc");
  return true;
#else
  return false;
#endif
}

void Sampler::stop_stepping() {
#if defined(__x86_64__)
  asm volatile("pushfq\n\tandq $~0x100, (%%rsp)\n\tpopfq" ::: "memory", "cc");
#endif
}

std::vector<CodeSample> Sampler::take() {
  std::vector<CodeSample> result(samples.begin(),
                                 samples.begin() + static_cast<std::ptrdiff_t>(taken.load()));
  taken = 0;
  return result;
}

}  // namespace navjit::bench

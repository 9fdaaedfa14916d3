#include "navjit/geant4/session.hpp"

#include <G4Exception.hh>
#include <G4ExceptionSeverity.hh>
#include <algorithm>
#include <chrono>
#include <ctime>

namespace navjit::geant4 {

double sampling_time() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

namespace {

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Session::Session(Options options) : options_(std::move(options)), made_at_(processor_time()) {}

double Session::processor_seconds() const { return processor_time() - made_at_; }

std::shared_ptr<Engine> Session::present_engine() const {
  const std::lock_guard lock(mutex_);
  return engine_;
}

const char* call_name(Call call) {
  constexpr std::array<const char*, call_kinds> names{
      "ComputeStep",   "LocateGlobalPointAndSetup", "LocateGlobalPointWithinVolume",
      "ComputeSafety", "ResetHierarchyAndLocate",   "exit normals"};
  return names[static_cast<std::size_t>(call)];
}

void Counts::add(const Counts& other) {
  for (std::size_t i = 0; i < call_kinds; ++i) {
    calls[i].calls += other.calls[i].calls;
    calls[i].sampled += other.calls[i].sampled;
    calls[i].sampled_seconds += other.calls[i].sampled_seconds;
  }
  const Differences& d = other.differences;
  differences.steps += d.steps;
  differences.lengths += d.lengths;
  differences.locates += d.locates;
  differences.histories += d.histories;
  differences.ties += d.ties;
  differences.safeties += d.safeties;
  differences.normals += d.normals;
  differences.largest_length = std::max<double>(differences.largest_length, d.largest_length);
  zero_steps += other.zero_steps;
  pushed += other.pushed;
  abandoned += other.abandoned;
}

std::shared_ptr<Engine> Session::engine(G4VPhysicalVolume& world) {
  const std::lock_guard lock(mutex_);
  if (options_.mode == Mode::geant4 || refused_ == &world) return nullptr;
  if (engine_ && &engine_->geometry.world() == &world) return engine_;
  refusal_.clear();
  try {
    engine_ = std::make_shared<Engine>(world, options_.runtime);
  } catch (const Error& error) {
    engine_ = nullptr;
    refused_ = &world;
    refusal_ = error.what();
    G4Exception("navjit::geant4::Session::engine()", "navjit0001", JustWarning,
                ("Geant4's own navigator stays: " + refusal_).c_str());
  }
  return engine_;
}

void Session::geometry_changed() {
  const std::lock_guard lock(mutex_);
  engine_ = nullptr;
  refused_ = nullptr;
  generation_.fetch_add(1, std::memory_order_release);
}

std::string Session::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

std::shared_ptr<Counts> Session::new_counts() {
  const std::lock_guard lock(mutex_);
  return counts_.emplace_back(std::make_shared<Counts>());
}

Counts Session::counts() const {
  const std::lock_guard lock(mutex_);
  Counts sum;
  for (const auto& counts : counts_) sum.add(*counts);
  return sum;
}

}  // namespace navjit::geant4

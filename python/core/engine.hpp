// What a Python Runtime holds: the runtime, navigators for whoever calls, and the lines of the log.
#pragma once

#include <navjit/navjit.hpp>

#include <atomic>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "python/core/bind.hpp"

namespace navjit::python {

/// Lines of the log, written by any thread and handed to Python by one that holds the interpreter's
/// lock: the compiler's thread must never wait for that.
class LogLines {
 public:
  void add(LogLevel level, std::string_view line);
  /// To Python's logger "navjit". Needs the interpreter's lock.
  void hand_over();

 private:
  static constexpr std::size_t most = 1000;  ///< if nobody takes them, the last are left out
  std::mutex mutex_;
  std::deque<std::pair<LogLevel, std::string>> lines_;
  std::size_t left_out_ = 0;
  std::atomic<bool> any_{false};
};

/// Thread-safe, but for what Runtime's functions are not; those take the mutex.
class Engine {
 public:
  Engine(const Detector& detector, const Observation& observation, RuntimeOptions options,
         unsigned threads);

  const ObservedDetector& seen() const { return seen_; }
  unsigned threads() const { return threads_; }
  Runtime& runtime() { return *runtime_; }
  std::mutex& mutex() { return mutex_; }
  LogLines& log() { return *log_; }

  /// A navigator that nobody else uses meanwhile; it goes back when this is destroyed.
  class Borrowed {
   public:
    explicit Borrowed(Engine& engine) : engine_(engine), navigator_(engine.take()) {}
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    ~Borrowed() { engine_.give_back(std::move(navigator_)); }
    Navigator& operator*() { return *navigator_; }

   private:
    Engine& engine_;
    std::unique_ptr<Navigator> navigator_;
  };

  /// Throws UsageError unless the volume is one of the detector's: states come from anywhere.
  void require_known(const State& state) const {
    if (state.volume() >= volumes_) throw UsageError("the state is of another detector");
  }

 private:
  std::unique_ptr<Navigator> take();
  void give_back(std::unique_ptr<Navigator> navigator);

  std::shared_ptr<LogLines> log_;
  ObservedDetector seen_;
  std::size_t volumes_;
  unsigned threads_;
  std::unique_ptr<Runtime> runtime_;
  std::mutex mutex_;  ///< of the runtime's functions that one thread at a time may call
  std::mutex pool_mutex_;
  std::vector<std::unique_ptr<Navigator>> pool_;
};

}  // namespace navjit::python

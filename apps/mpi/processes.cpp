#include "apps/mpi/processes.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <system_error>
#include <thread>

#include "apps/mpi/launcher.hpp"
#include "common/interruption.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {
namespace {

/// Kinds of messages.
enum : int {
  ending = 1,  ///< a signal's number, or 0: the sender has failed
  outcome,     ///< of a piece of work: empty, or why it failed
  verdict,     ///< the first process's answer to all outcomes, likewise
  given        ///< a text of gather()
};

/// How often a process looks for messages: one that waits, and one that works.
constexpr std::chrono::milliseconds pause{1}, long_pause{10};

std::string where(unsigned rank, unsigned count) {
  char host[256] = "";
  if (gethostname(host, sizeof host - 1) != 0) host[0] = '\0';
  return " (process " + std::to_string(rank + 1) + " of " + std::to_string(count) +
         (host[0] != '\0' ? std::string(", on ") + host : "") + ")";
}

/// The exception's message, which is never empty.
std::string text_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return "out of memory; fewer --threads need less, and so do fewer processes on a machine";
  } catch (const std::exception& error) {
    return *error.what() != '\0' ? error.what() : "failed";
  }
}

}  // namespace

std::unique_ptr<mpi::World> Processes::of_launcher() {
  const auto launched = mpi::launched();
  if (!launched || launched->of == 1) return nullptr;
  const std::string us = "this is one of " + std::to_string(launched->of) + " processes";
  if (mpi::library().empty()) {
    if (launched->of == 0) return nullptr;  // as far as is known it is alone
    throw Error(us +
                ", and navjit is built without MPI: say --part K/N, another K in each process");
  }
  auto world = std::make_unique<mpi::World>();
  if (launched->of > 1 && world->count() != launched->of) {
    throw Error(us + ", and " + mpi::library() + ", which navjit is built with, finds " +
                std::to_string(world->count()) + ": use its own mpirun, or say --part K/N");
  }
  return world;
}

/// Passes on a signal of this process, and notes one of another.
void Processes::hear() {
  if (const int signal = common::interruption(); signal != 0 && !signal_is_known_) {
    tell_others(std::to_string(signal));
  }
  world_->sent_all();
  while (const auto message = world_->receive_from_any(ending)) {
    if (const int signal = std::atoi(message->c_str()); signal != 0) {
      signal_is_known_ = true;
      common::note_interruption(signal);
    } else {
      in_vain_ = true;
    }
  }
}

void Processes::tell_others(const std::string& why) {
  signal_is_known_ = true;
  for (unsigned to = 0; to < count(); ++to) {
    if (to != rank()) world_->send(to, ending, why);
  }
}

void Processes::deliver(unsigned to, int kind, const std::string& text) {
  world_->send(to, kind, text);
  while (!world_->sent_all()) {
    hear();
    std::this_thread::sleep_for(pause);
  }
}

std::string Processes::await(unsigned from, int kind) {
  for (;;) {
    if (auto text = world_->receive(from, kind)) return *std::move(text);
    hear();
    std::this_thread::sleep_for(pause);
  }
}

/// Tells the first process why this one has failed (`own`; empty: it has not). Returns what the
/// first one says of all: why one of them has failed, or nothing.
std::string Processes::verdict_on(const std::string& own) {
  if (!first()) {
    deliver(0, outcome, own);
    return await(0, verdict);
  }
  std::string all = own;
  for (unsigned from = 1; from < count(); ++from) {
    const std::string other = await(from, outcome);
    if (all.empty()) all = other;
  }
  for (unsigned to = 1; to < count(); ++to) deliver(to, verdict, all);
  return all;
}

void Processes::together(const std::function<void()>& work) {
  if (!several()) return work();
  std::exception_ptr thrown;
  {
    // Meanwhile a thread of its own hears the others.
    std::jthread listener;
    try {
      listener = std::jthread([this](const std::stop_token& end) {
        while (!end.stop_requested()) {
          hear();
          std::this_thread::sleep_for(long_pause);
        }
      });
    } catch (const std::system_error& error) {  // signals to others are heard at the end, then
      spdlog::debug("event=deaf reason={}", error.what());
    }
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
  }
  if (thrown) tell_others("0");
  const std::string own = thrown ? text_of(thrown) : "";
  const std::string all = verdict_on(own.empty() || first() ? own : own + where(rank(), count()));
  if (all.empty()) return;
  if (thrown) std::rethrow_exception(thrown);
  throw Error(all);
}

std::vector<std::string> Processes::gather(const std::string& mine) {
  try {
    if (!first()) {
      deliver(0, given, mine);
      return {};
    }
    std::vector<std::string> all{mine};
    for (unsigned from = 1; from < count(); ++from) all.push_back(await(from, given));
    return all;
  } catch (...) {  // memory: the others would wait for ever
    world_->abandon();
    throw;
  }
}

}  // namespace navjit::apps

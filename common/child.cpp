#include "common/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <thread>

#include "common/interruption.hpp"

namespace navjit::common {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t most_output = std::size_t{16} << 20;

/// The program that is being run; 0: none. For signal handlers, which can reach nothing but static
/// storage.
std::atomic<pid_t> running{0};

struct Pipe {
  int ends[2] = {-1, -1};
  bool open() { return pipe2(ends, O_CLOEXEC) == 0; }
  void close_end(int i) {
    if (ends[i] >= 0) ::close(ends[i]);
    ends[i] = -1;
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
};

/// Reads once what is there, and keeps no more than `most_output` and a buffer. False at the end of
/// the stream.
bool read_some(int file, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t n = ::read(file, buffer.data(), buffer.size());
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  if (text.size() <= most_output) text.append(buffer.data(), static_cast<std::size_t>(n));
  return n > 0;
}

pid_t start(const std::vector<std::string>& words, Pipe& out, Pipe& err) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.ends[1], STDERR_FILENO);
  // What this process ignores (common/standard_streams.hpp) is none of the program's business.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t ours;
  sigemptyset(&ours);
  sigaddset(&ours, SIGPIPE);
  sigaddset(&ours, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &ours);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t pid = -1;
  if (posix_spawn(&pid, arguments[0], &actions, &attributes, arguments.data(), environ) != 0) {
    pid = -1;
  }
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

}  // namespace

std::string ChildResult::words(double seconds) const {
  char text[80];
  switch (end) {
    case End::not_started:
      return "cannot be started";
    case End::timed_out:
      std::snprintf(text, sizeof text, "hangs (%g s)", seconds);
      return text;
    case End::wrote_too_much:
      std::snprintf(text, sizeof text, "writes more than %zu MB, which is too much to be kept",
                    most_output >> 20);
      return text;
    case End::crashed:
      std::snprintf(text, sizeof text, "crashes (signal %d)", status);
      return text;
    case End::exited:
      break;
  }
  if (status == 0) return "";
  std::string line = error.empty() ? output : error;
  while (!line.empty() && line.back() == '\n') line.pop_back();
  line.erase(0, line.rfind('\n') + 1);
  return line.empty() ? "fails (status " + std::to_string(status) + ")" : line;
}

ChildResult run_child(const std::vector<std::string>& words, double seconds,
                      WhenInterrupted when_interrupted) {
  const bool heeds_signals = when_interrupted == WhenInterrupted::end_it;
  if (heeds_signals) stop_if_interrupted();
  ChildResult result;
  Pipe out, err;
  if (!out.open() || !err.open()) return result;
  const pid_t pid = start(words, out, err);
  if (pid < 0) return result;
  out.close_end(1);
  err.close_end(1);
  running = pid;
  auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  bool killed = false, too_much = false;
  bool reading_out = true, reading_err = true;
  bool interrupted = false;
  const auto check_time = [&] {
    if (heeds_signals && !interrupted && interruption() != 0) {
      // It may have something to tidy up.
      ::kill(pid, SIGTERM);
      interrupted = true;
      deadline = std::min(deadline, Clock::now() + std::chrono::duration<double>(2));
    }
    if (killed || Clock::now() < deadline) return;
    ::kill(pid, SIGKILL);
    killed = true;
  };
  while ((reading_out || reading_err) && !killed) {
    pollfd files[2] = {{reading_out ? out.ends[0] : -1, POLLIN, 0},
                       {reading_err ? err.ends[0] : -1, POLLIN, 0}};
    ::poll(files, 2, 50);
    if (files[0].revents != 0) reading_out = read_some(out.ends[0], result.output);
    if (files[1].revents != 0) reading_err = read_some(err.ends[0], result.error);
    if (result.output.size() > most_output) {
      ::kill(pid, SIGKILL);
      too_much = true;
      break;
    }
    check_time();
  }
  // The program may close its streams and go on. Until it is waited for, no other process gets its
  // number.
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(pid), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         ended.si_pid == 0) {
    check_time();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  running = 0;
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (heeds_signals) stop_if_interrupted();
  if (too_much) {
    result.end = ChildResult::End::wrote_too_much;
  } else if (killed) {
    result.end = ChildResult::End::timed_out;
  } else if (WIFSIGNALED(status)) {
    result.end = ChildResult::End::crashed;
    result.status = WTERMSIG(status);
  } else {
    result.end = ChildResult::End::exited;
    result.status = WEXITSTATUS(status);
  }
  return result;
}

void end_child() noexcept {
  if (const pid_t pid = running.load()) ::kill(pid, SIGTERM);
}

}  // namespace navjit::common

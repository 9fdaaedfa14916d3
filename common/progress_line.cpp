#include "common/progress_line.hpp"

#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace navjit::common {
namespace {

/// "8 s", "3 min 20 s", "5 h 12 min".
std::string duration_text(double seconds) {
  char text[48];
  if (seconds < 59.5) {
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  } else if (seconds < 3600) {
    const double minutes = std::floor(seconds / 60);
    std::snprintf(text, sizeof text, "%.0f min %.0f s", minutes,
                  std::floor(seconds - 60 * minutes));
  } else {
    const double hours = std::floor(seconds / 3600);
    std::snprintf(text, sizeof text, "%.0f h %.0f min", hours,
                  std::floor((seconds - 3600 * hours) / 60));
  }
  return text;
}

}  // namespace

std::size_t terminal_columns() {
  if (!spdlog::should_log(spdlog::level::warn) || isatty(STDERR_FILENO) == 0) return 0;
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

std::string percent_and_left(std::uint64_t done, std::uint64_t total, double seconds) {
  if (total == 0) return "";
  const double part = static_cast<double>(done) / static_cast<double>(total);
  char text[24];
  std::snprintf(text, sizeof text, "%.0f%%", std::floor(100 * part));
  // The first moments tell nothing of the rest.
  if (done == 0 || done >= total || seconds < 0.5) return text;
  return std::string(text) + ", " + duration_text(seconds * (1 - part) / part) + " left";
}

ProgressLine::ProgressLine(std::string what, std::uint64_t total)
    : what_(std::move(what)), total_(total) {}

ProgressLine::~ProgressLine() {
  if (any_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::at(std::uint64_t done) {
  const Clock::time_point now = Clock::now();
  if (now - shown_ < std::chrono::milliseconds(200)) return;
  const std::size_t columns = terminal_columns();
  if (columns == 0) return;
  const std::chrono::duration<double> so_far = now - start_;
  const std::string line = what_ + " " + percent_and_left(done, total_, so_far.count());
  std::fprintf(stderr, "\r\033[K%s", line.substr(0, columns - 1).c_str());
  std::fflush(stderr);
  any_ = true;
  shown_ = now;
}

}  // namespace navjit::common

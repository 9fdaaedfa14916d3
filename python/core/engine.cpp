#include "python/core/engine.hpp"

namespace navjit::python {

void LogLines::add(LogLevel level, std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (lines_.size() >= most) {
    ++left_out_;
    return;
  }
  lines_.emplace_back(level, line);
  any_ = true;
}

void LogLines::hand_over() {
  if (!any_) return;
  std::deque<std::pair<LogLevel, std::string>> lines;
  {
    const std::lock_guard lock(mutex_);
    lines.swap(lines_);
    if (left_out_ > 0) {
      lines.emplace_back(LogLevel::warning,
                         std::to_string(left_out_) + " more lines were left out");
    }
    left_out_ = 0;
    any_ = false;
  }
  const auto logger = py::module_::import("logging").attr("getLogger")("navjit");
  for (const auto& [level, line] : lines) {
    const int number = level == LogLevel::debug ? 10 : level == LogLevel::info ? 20 : 30;
    logger.attr("log")(number, "%s",
                       py::str(PyUnicode_DecodeUTF8(
                           line.data(), static_cast<py::ssize_t>(line.size()), "replace")));
  }
}

Engine::Engine(const Detector& detector, const Observation& observation, RuntimeOptions options,
               unsigned threads)
    : log_(std::make_shared<LogLines>()),
      seen_(detector, observation),
      volumes_(detector.volumes()),
      threads_(threads) {
  options.log = [log = log_](LogLevel level, std::string_view line) {
    try {
      log->add(level, line);
    } catch (const std::bad_alloc&) {  // nothing depends on a line
    }
  };
  runtime_ = std::make_unique<Runtime>(seen_.detector(), std::move(options));
}

std::unique_ptr<Navigator> Engine::take() {
  {
    const std::lock_guard lock(pool_mutex_);
    if (!pool_.empty()) {
      auto navigator = std::move(pool_.back());
      pool_.pop_back();
      return navigator;
    }
  }
  return std::make_unique<Navigator>(runtime_->navigator());
}

void Engine::give_back(std::unique_ptr<Navigator> navigator) {
  const std::lock_guard lock(pool_mutex_);
  pool_.push_back(std::move(navigator));
}

}  // namespace navjit::python

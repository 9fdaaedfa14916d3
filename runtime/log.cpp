#include "runtime/log.hpp"

#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace navjit {
namespace {

/// Passes lines to the user's sink, which must be thread-safe itself.
class UsersSink : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 public:
  explicit UsersSink(const LogSink& lines) : sink_(lines) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const LogLevel level = message.level <= spdlog::level::debug  ? LogLevel::debug
                           : message.level == spdlog::level::info ? LogLevel::info
                                                                  : LogLevel::warning;
    sink_(level, {message.payload.data(), message.payload.size()});
  }
  void flush_() override {}

 private:
  LogSink sink_;
};

}  // namespace

std::shared_ptr<spdlog::logger> make_log(const LogSink& sink) {
  if (!sink) {
    auto programs = spdlog::default_logger();
    // The logger that spdlog makes itself has no name, and writes to standard output, where a
    // program's results are.
    if (programs && !programs->name().empty()) return programs;
    return std::make_shared<spdlog::logger>(
        "navjit", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  }
  auto log = std::make_shared<spdlog::logger>("navjit", std::make_shared<UsersSink>(sink));
  log->set_level(spdlog::level::debug);
  return log;
}

}  // namespace navjit

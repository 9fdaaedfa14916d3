// What navjit has to say while it works.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "navjit/detail/api.hpp"

namespace NAVJIT_API navjit {

/// How much a line matters.
enum class LogLevel : std::uint8_t {
  debug,    ///< decisions, as key=value (docs/decisions.md)
  info,     ///< what is done differently than before
  warning,  ///< what costs speed, never an answer
};

/// Takes one line without its end, and has to be thread-safe: the thread that compiles calls it as
/// well as those that call the Runtime. Must not throw, nor call the Runtime.
using LogSink = std::function<void(LogLevel level, std::string_view line)>;

}  // namespace navjit

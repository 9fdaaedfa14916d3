// What navjit reports while it works.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "navjit/detail/api.hpp"

namespace NAVJIT_API navjit {

/// How much a line matters.
enum class LogLevel : std::uint8_t {
  debug,    ///< decisions, as key=value (docs/decisions.md)
  info,     ///< what is done differently from now on
  warning,  ///< what costs speed but changes no answer
};

/// Takes one line without its line end. It has to be thread-safe: the thread that compiles calls it
/// as well as those that call the Runtime. It must not throw, nor call the Runtime.
using LogSink = std::function<void(LogLevel level, std::string_view line)>;

}  // namespace navjit

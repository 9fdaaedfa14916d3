// Where a Runtime's lines go.
#pragma once

#include <spdlog/fwd.h>

#include <memory>

#include "navjit/log.hpp"

namespace navjit {

/// A logger that hands every line to the sink; without one it is spdlog's default at this moment.
std::shared_ptr<spdlog::logger> make_log(const LogSink& sink);

}  // namespace navjit

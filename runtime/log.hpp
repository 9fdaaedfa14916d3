// The log of a Runtime.
#pragma once

#include <spdlog/fwd.h>

#include <memory>

#include "navjit/log.hpp"

namespace navjit {

/// A logger that passes every line to the sink. Without a sink it is the logger that is spdlog's
/// default at this moment.
std::shared_ptr<spdlog::logger> make_log(const LogSink& sink);

}  // namespace navjit

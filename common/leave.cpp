#include "common/leave.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "jit/activity.hpp"

namespace navjit::common {

void leave(int status) {
  if (jit::Activity::any()) {
    spdlog::default_logger_raw()->flush();
    std::fflush(nullptr);
    _exit(status);
  }
  std::exit(status);
}

}  // namespace navjit::common

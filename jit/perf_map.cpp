#include "jit/detail/perf_map.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace navjit::jit::detail {

void append_to_perf_map(const std::vector<FunctionRange>& functions) {
  std::string text;
  for (const FunctionRange& function : functions) {
    char numbers[48];
    std::snprintf(numbers, sizeof numbers, "%llx %llx ",
                  static_cast<unsigned long long>(function.address),
                  static_cast<unsigned long long>(function.bytes));
    text += numbers + function.name + '\n';
  }
  const std::string path = "/tmp/perf-" + std::to_string(getpid()) + ".map";
  // The directory is shared and the name is predictable, so a link that somebody else placed must
  // not be followed.
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file < 0) return;
  // This is one write in append mode, so that concurrent links do not interleave.
  [[maybe_unused]] const ssize_t written = write(file, text.data(), text.size());
  close(file);
}

}  // namespace navjit::jit::detail

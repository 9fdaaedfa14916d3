#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace navjit::jit::detail {

/// A function in memory.
struct FunctionRange {
  std::string name;
  std::uint64_t address = 0;
  std::uint64_t bytes = 0;
};

/// Appends `functions` to /tmp/perf-PID.map. Errors are ignored: a profile without names is no
/// reason to fail. Thread-safe.
void append_to_perf_map(const std::vector<FunctionRange>& functions);

}  // namespace navjit::jit::detail

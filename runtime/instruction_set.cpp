#include "runtime/instruction_set.hpp"

#include <spdlog/spdlog.h>

namespace navjit {

const char* processor_for(InstructionSet set, spdlog::logger& log) {
#if defined(__x86_64__)
  switch (set) {
    case InstructionSet::native:
      break;
    case InstructionSet::sse42:
      if (__builtin_cpu_supports("x86-64-v2")) return "x86-64-v2";
      break;
    case InstructionSet::avx2:
      if (__builtin_cpu_supports("x86-64-v3")) return "x86-64-v3";
      break;
    case InstructionSet::avx512:
      if (__builtin_cpu_supports("x86-64-v4")) return "x86-64-v4";
  }
#endif
  if (set != InstructionSet::native) {
    log.warn("this processor has not the instructions asked for: generated code uses its own");
  }
  return "";
}

}  // namespace navjit

// The list of generated code that GDB reads. GDB requires this layout and these names. LLVM's
// library defines the two symbols.
#pragma once

#include <cstdint>

extern "C" {
struct jit_code_entry {
  jit_code_entry* next_entry;
  jit_code_entry* prev_entry;
  const char* symfile_addr;
  std::uint64_t symfile_size;
};
struct jit_descriptor {
  std::uint32_t version;
  std::uint32_t action_flag;
  jit_code_entry* relevant_entry;
  jit_code_entry* first_entry;
};
// GDB knows them by these names.
extern jit_descriptor __jit_debug_descriptor;  // NOLINT(bugprone-reserved-identifier)
void __jit_debug_register_code();              // NOLINT(bugprone-reserved-identifier)
}

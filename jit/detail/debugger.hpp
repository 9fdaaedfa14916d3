#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace navjit::jit::detail {

/// Announces a linked object to an attached (or later attaching) debugger for as long as it lives,
/// through the interface GDB documents as "JIT Compilation Interface". LLVM's own plugin for this
/// never withdraws what it announced. Thread-safe.
class DebuggerRegistration {
 public:
  /// `object` is the relocatable ELF object; `section_addresses` says where its sections, by name,
  /// were put in memory.
  DebuggerRegistration(std::vector<char> object,
                       const std::map<std::string, std::uint64_t>& section_addresses);
  ~DebuggerRegistration();
  DebuggerRegistration(const DebuggerRegistration&) = delete;
  DebuggerRegistration& operator=(const DebuggerRegistration&) = delete;

 private:
  struct Entry;
  std::vector<char> object_;
  std::unique_ptr<Entry> entry_;
};

}  // namespace navjit::jit::detail

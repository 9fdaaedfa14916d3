#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "jit/compiler.hpp"
#include "navjit/detail/expected.hpp"

namespace navjit::jit {

/// How linked code is made known to tools outside the program.
struct LinkerOptions {
  /// Announce code through the GDB JIT interface: function names always, source lines if compiled
  /// with `CompileOptions::debug_info`. Breakpoints in code have to be deleted before the code is
  /// freed: GDB restores the bytes under them even if other code has taken the address.
  bool debugger = true;
  /// Append function addresses to /tmp/perf-PID.map, which perf reads. Entries are never removed,
  /// so addresses that are reused after code was freed have two names.
  bool perf_map = false;
};

/// What one link cost and made.
struct LinkReport {
  double link_ms = 0;            ///< Wall time, milliseconds.
  std::size_t code_bytes = 0;    ///< Machine code, without constants.
  std::size_t mapped_bytes = 0;  ///< Code and data in memory, before rounding up to pages.
};

/// Linked, executable code. It owns its memory: addresses obtained from it are invalid once it is
/// destroyed, and no thread may be running in it then. It may outlive its `Linker`. Lookups are
/// thread-safe.
class Code {
 public:
  Code(Code&&) noexcept;
  Code& operator=(Code&&) noexcept;
  ~Code();

  /// Address of an exported function or variable by its linkage name. Fails if there is none.
  Expected<void*> symbol(const std::string& name) const;

  /// The same as a pointer to function: `code.function<double(double)>("f")`. Nothing checks that
  /// the type is right.
  template <typename Signature>
  Expected<Signature*> function(const std::string& name) const {
    static_assert(std::is_function_v<Signature>);
    Expected<void*> address = symbol(name);
    if (!address) return address.failure();
    return reinterpret_cast<Signature*>(*address);
  }

  /// Linkage names of everything exported, sorted.
  std::vector<std::string> symbol_names() const;

  const LinkReport& report() const;

 private:
  friend class Linker;
  struct Impl;
  explicit Code(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Turns objects into executable code in this process.
///
/// Each object is linked alone. It sees no symbols of other objects, and of the process it sees
/// only the C library's memory functions (memcpy, memmove, memset, memcmp, bcmp) and mathematical
/// functions. Thread-safe; only one link at a time is made on one `Linker`.
class Linker {
 public:
  /// Fails if the process cannot host a linker, for example on an unsupported architecture.
  static Expected<Linker> create(const LinkerOptions& options = {});

  Linker(Linker&&) noexcept;
  Linker& operator=(Linker&&) noexcept;
  ~Linker();

  /// Links one object; `object` need not outlive the call. Fails if the bytes are not an object for
  /// this machine's architecture or refer to a symbol that is not allowed. Only the structure is
  /// checked: the caller must know that bytes from outside the process were made by a `Compiler`.
  Expected<Code> link(const Object& object);

 private:
  struct Impl;
  explicit Linker(std::shared_ptr<Impl> impl);
  std::shared_ptr<Impl> impl_;
  friend class Code;
};

}  // namespace navjit::jit

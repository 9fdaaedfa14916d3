// Which functions an address of this process belongs to: generated code by its debug information,
// the program's own by its symbols.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace navjit::bench {

/// Made of what the debugger's interface announces at that moment: of code compiled with debug
/// information, and not freed since.
class CodeMap {
 public:
  CodeMap();
  ~CodeMap();

  struct Place {
    bool generated = false;
    /// The function and what was inlined into it there, outermost first, without template
    /// arguments; empty where nothing is known.
    std::vector<std::string> functions;
  };
  const Place& at(std::uint64_t address);

  struct Range {
    std::uint64_t begin, end;
  };
  /// Generated machine code.
  std::vector<Range> generated_code() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace navjit::bench

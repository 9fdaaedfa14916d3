// Which functions an address of this process belongs to: for generated code its debug information
// tells it, for the program's own code its symbols.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace navjit::bench {

/// Made from what the debugger's interface announces at that moment: code that was compiled with
/// debug information and has not been freed.
class CodeMap {
 public:
  CodeMap();
  ~CodeMap();

  struct Place {
    bool generated = false;
    /// The function, and the functions inlined into it there, outermost first, without template
    /// arguments; empty where nothing is known.
    std::vector<std::string> functions;
  };
  const Place& at(std::uint64_t address);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace navjit::bench

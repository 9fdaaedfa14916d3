#pragma once

#include <clang/Frontend/PrecompiledPreamble.h>
#include <llvm/ADT/IntrusiveRefCntPtr.h>
#include <llvm/Support/VirtualFileSystem.h>

#include <optional>
#include <string>
#include <string_view>

namespace clang {
class CompilerInvocation;
}  // namespace clang

namespace navjit::jit::detail {

/// Text that many sources begin with, parsed once. Clang keeps its declarations in memory, as it
/// would in a precompiled header, and reads those that a source uses. Where parsing fails there is
/// no preamble: each source is parsed as a whole then, with whatever diagnostics that has.
class Preamble {
 public:
  explicit Preamble(std::string text) : text_(std::move(text)) {}

  /// If the source begins with the text, `invocation`, which is set up for it, and `files` are
  /// changed so that only the rest is parsed. The first such source is parsed as a whole all the
  /// same: whoever compiles but one need not wait for more. The second has the text parsed first.
  /// Returns whether only the rest of this source is to be parsed.
  bool use(std::string_view source, clang::CompilerInvocation& invocation,
           llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem>& files);

 private:
  std::string text_;
  int sources_ = 0;        ///< how many began with it, counted up to three
  std::string unit_name_;  ///< of the unit that it is parsed for
  std::optional<clang::PrecompiledPreamble> parsed_{};
};

}  // namespace navjit::jit::detail

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

/// Text with which many sources begin, and which is parsed once. Clang keeps its declarations in
/// memory, as in a precompiled header, and reads those that a source uses. If the text cannot be
/// parsed there is no preamble: then each source is parsed as a whole and gives its own
/// diagnostics.
class Preamble {
 public:
  explicit Preamble(std::string text) : text_(std::move(text)) {}

  /// If the source begins with the text, `invocation`, which must be set up for the source, and
  /// `files` are changed so that only the rest is parsed. The first such source is still parsed as
  /// a whole, so that a program which compiles only one source need not wait for more. For the
  /// second one the text is parsed first. Returns whether only the rest of this source will be
  /// parsed.
  bool use(std::string_view source, clang::CompilerInvocation& invocation,
           llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem>& files);

 private:
  std::string text_;
  int sources_ = 0;        ///< how many sources began with the text, counted up to three
  std::string unit_name_;  ///< of the unit for which the text was parsed
  std::optional<clang::PrecompiledPreamble> parsed_{};
};

}  // namespace navjit::jit::detail

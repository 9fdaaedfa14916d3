#include "jit/detail/preamble.hpp"

#include <clang/Basic/Diagnostic.h>
#include <clang/Basic/DiagnosticOptions.h>
#include <clang/Frontend/CompilerInvocation.h>
#include <clang/Serialization/PCHContainerOperations.h>
#include <llvm/Support/MemoryBuffer.h>

#include <memory>

#include "jit/activity.hpp"

namespace navjit::jit::detail {
namespace {

struct OutlastStaticObjects : clang::PreambleCallbacks {
  void HandleTopLevelDecl(clang::DeclGroupRef) override { outlast_static_objects(); }
};

/// Returns nothing if there are errors in the text.
std::optional<clang::PrecompiledPreamble> parse_text(
    const std::string& text, const clang::CompilerInvocation& invocation,
    const llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem>& files) {
  const llvm::IntrusiveRefCntPtr<clang::DiagnosticsEngine> diagnostics(new clang::DiagnosticsEngine(
      new clang::DiagnosticIDs, new clang::DiagnosticOptions, new clang::IgnoringDiagConsumer));
  const auto buffer =
      llvm::MemoryBuffer::getMemBufferCopy(text, invocation.getFrontendOpts().Inputs[0].getFile());
  OutlastStaticObjects callbacks;
  auto parsed = clang::PrecompiledPreamble::Build(
      invocation, buffer.get(),
      {static_cast<unsigned>(text.size()), /*PreambleEndsAtStartOfLine=*/true}, *diagnostics, files,
      std::make_shared<clang::PCHContainerOperations>(), /*StoreInMemory=*/true,
      /*StoragePath=*/"", callbacks);
  // A preamble with errors would be kept, and later sources would not report the errors.
  if (!parsed || diagnostics->hasErrorOccurred()) return std::nullopt;
  return std::move(*parsed);
}

}  // namespace

bool Preamble::use(std::string_view source, clang::CompilerInvocation& invocation,
                   llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem>& files) {
  if (text_.empty() || !source.starts_with(text_) || ++sources_ == 1) return false;
  const std::string unit_name = invocation.getFrontendOpts().Inputs[0].getFile().str();
  if (sources_ == 2) {
    unit_name_ = unit_name;
    parsed_ = parse_text(text_, invocation, files);
  }
  sources_ = 3;
  // Clang finds the preamble's declarations by the name of the file.
  if (!parsed_ || unit_name != unit_name_) return false;
  auto buffer = llvm::MemoryBuffer::getMemBufferCopy(llvm::StringRef(source.data(), source.size()),
                                                     unit_name);
  parsed_->AddImplicitPreamble(invocation, files, buffer.release());  // deletes the buffer
  return true;
}

}  // namespace navjit::jit::detail

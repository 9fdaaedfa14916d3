#include "jit/detail/frontend.hpp"

#include <clang/AST/ASTConsumer.h>
#include <clang/Basic/Diagnostic.h>
#include <clang/Basic/DiagnosticOptions.h>
#include <clang/CodeGen/ModuleBuilder.h>
#include <clang/Frontend/CompilerInstance.h>
#include <clang/Frontend/CompilerInvocation.h>
#include <clang/Frontend/FrontendAction.h>
#include <clang/Frontend/MultiplexConsumer.h>
#include <clang/Frontend/TextDiagnosticPrinter.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Support/VirtualFileSystem.h>
#include <llvm/Support/raw_ostream.h>

#include "jit/activity.hpp"
#include "jit/detail/leave_wreck.hpp"

namespace navjit::jit::detail {
namespace {

/// Clang makes static objects when it meets the first declaration that needs them.
class OutlastStaticObjects : public clang::ASTConsumer {
 public:
  bool HandleTopLevelDecl(clang::DeclGroupRef) override {
    outlast_static_objects();
    return true;
  }
};

/// Generates IR for the whole unit and keeps it. Clang's own actions for this would also set up
/// and run its back end, which has its own idea of the pass pipeline.
class KeepModule : public clang::ASTFrontendAction {
 public:
  explicit KeepModule(llvm::LLVMContext& context) : context_(context) {}

  std::unique_ptr<llvm::Module> take_module() { return std::move(module_); }

 protected:
  std::unique_ptr<clang::ASTConsumer> CreateASTConsumer(clang::CompilerInstance& instance,
                                                        llvm::StringRef file) override {
    generator_ =
        clang::CreateLLVMCodeGen(instance.getDiagnostics(), file, &instance.getVirtualFileSystem(),
                                 instance.getHeaderSearchOpts(), instance.getPreprocessorOpts(),
                                 instance.getCodeGenOpts(), context_);
    std::vector<std::unique_ptr<clang::ASTConsumer>> consumers;
    consumers.emplace_back(generator_);
    consumers.push_back(std::make_unique<OutlastStaticObjects>());
    return std::make_unique<clang::MultiplexConsumer>(std::move(consumers));
  }

  void EndSourceFileAction() override {
    if (generator_ != nullptr) module_.reset(generator_->ReleaseModule());
    generator_ = nullptr;
  }

 private:
  llvm::LLVMContext& context_;
  clang::CodeGenerator* generator_ = nullptr;  // owned by the compiler instance
  std::unique_ptr<llvm::Module> module_;
};

/// Prints errors apart from warnings, each with its notes. Even someone who reads only the
/// beginning must see why a unit was refused, however many warnings came before.
class SplitPrinter : public clang::DiagnosticConsumer {
 public:
  explicit SplitPrinter(clang::DiagnosticOptions* options)
      : error_printer_(error_stream_, options), warning_printer_(warning_stream_, options) {}

  void BeginSourceFile(const clang::LangOptions& language,
                       const clang::Preprocessor* preprocessor) override {
    error_printer_.BeginSourceFile(language, preprocessor);
    warning_printer_.BeginSourceFile(language, preprocessor);
  }
  void EndSourceFile() override {
    error_printer_.EndSourceFile();
    warning_printer_.EndSourceFile();
  }
  void HandleDiagnostic(clang::DiagnosticsEngine::Level level,
                        const clang::Diagnostic& diagnostic) override {
    DiagnosticConsumer::HandleDiagnostic(level, diagnostic);
    if (level != clang::DiagnosticsEngine::Note) {
      in_error_ = level >= clang::DiagnosticsEngine::Error;
    }
    (in_error_ ? error_printer_ : warning_printer_).HandleDiagnostic(level, diagnostic);
  }

  std::string all() { return error_stream_.str() + warning_stream_.str(); }

 private:
  std::string errors_, warnings_;
  llvm::raw_string_ostream error_stream_{errors_}, warning_stream_{warnings_};
  clang::TextDiagnosticPrinter error_printer_, warning_printer_;
  bool in_error_ = false;
};

/// The objects that parsing works with. The instance uses the members before it until it is
/// destroyed.
struct Frontend {
  llvm::IntrusiveRefCntPtr<clang::DiagnosticOptions> diagnostic_options{
      new clang::DiagnosticOptions()};
  SplitPrinter printer{diagnostic_options.get()};
  clang::CompilerInstance instance;
  KeepModule action;

  explicit Frontend(llvm::LLVMContext& context) : action(context) {}
};

std::vector<std::string> target_flags(const Target& target) {
  std::vector<std::string> flags = {"-triple", target.triple, "-target-cpu", target.cpu};
  for (const std::string& feature : target.features) {
    flags.push_back("-target-feature");
    flags.push_back(feature);
  }
  return flags;
}

/// Returns false, with diagnostics, if flags are not understood.
bool fill_invocation(clang::CompilerInvocation& invocation, const std::string& unit_name,
                     const std::vector<std::string>& flags, const Target& target,
                     clang::DiagnosticsEngine& diagnostics) {
  std::vector<std::string> arguments = target_flags(target);
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  arguments.insert(arguments.end(),
                   {"-main-file-name", unit_name.substr(unit_name.rfind('/') + 1)});
  std::vector<const char*> pointers;
  pointers.reserve(arguments.size());
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  if (!clang::CompilerInvocation::CreateFromArgs(invocation, pointers, diagnostics)) return false;
  invocation.getFrontendOpts().Inputs = {clang::FrontendInputFile(unit_name, clang::Language::CXX)};
  return true;
}

}  // namespace

std::vector<std::string> frontend_flags(const CompileOptions& options) {
  // These are options of the compiler proper, not of the driver. What the driver would turn on but
  // is not listed here (exceptions, errno for mathematical functions) is off.
  std::vector<std::string> flags = {"-x",
                                    "c++",
                                    "-std=c++20",
                                    "-ffp-contract=off",
                                    "-fno-rtti",
                                    "-nostdsysteminc",
                                    "-nobuiltininc",
                                    "-nostdinc++",
                                    "-mrelocation-model",
                                    "pic",
                                    "-pic-level",
                                    "2",
                                    "-funwind-tables=2",
                                    "-discard-value-names",
                                    "-ferror-limit",
                                    "20",
                                    "-O" + std::to_string(options.optimisation)};
  if (options.optimisation >= 2) {
    flags.push_back("-vectorize-loops");
  }
  if (options.debug_info) {
    flags.insert(flags.end(), {"-debug-info-kind=standalone", "-dwarf-version=4",
                               "-debugger-tuning=gdb", "-mframe-pointer=all"});
  }
  return flags;
}

Expected<ParsedUnit> parse(std::string_view source, std::string_view unit_name,
                           const std::vector<std::string>& flags, const Target& target,
                           Preamble& preamble, llvm::LLVMContext& context) {
  const std::string name(unit_name);
  return leave_wreck(std::make_unique<Frontend>(context), [&](Frontend& f) -> Expected<ParsedUnit> {
    // The source is the only file that can be included.
    llvm::IntrusiveRefCntPtr<llvm::vfs::InMemoryFileSystem> memory(
        new llvm::vfs::InMemoryFileSystem());
    if (const std::error_code error = memory->setCurrentWorkingDirectory("/")) {
      return Failure{"no root of files in memory: " + error.message()};
    }
    memory->addFile(
        name, 0,
        llvm::MemoryBuffer::getMemBufferCopy(llvm::StringRef(source.data(), source.size()), name));
    f.instance.createDiagnostics(&f.printer, /*ShouldOwnClient=*/false);
    // Otherwise the number of errors would be printed on stderr.
    f.instance.setVerboseOutputStream(std::make_unique<llvm::raw_null_ostream>());

    if (!fill_invocation(f.instance.getInvocation(), name, flags, target,
                         f.instance.getDiagnostics())) {
      return Failure{"compiler flags not understood:\n" + f.printer.all()};
    }
    outlast_static_objects();  // the table of flags is a static object
    llvm::IntrusiveRefCntPtr<llvm::vfs::FileSystem> files(memory);
    const bool kept = preamble.use(source, f.instance.getInvocation(), files);
    f.instance.createFileManager(files);

    const bool succeeded = f.instance.ExecuteAction(f.action);
    std::shared_ptr<llvm::Module> module = f.action.take_module();
    if (!succeeded || !module || f.instance.getDiagnostics().hasErrorOccurred()) {
      const std::string messages = f.printer.all();
      return Failure{messages.empty() ? name + ": compilation failed" : messages};
    }
    return ParsedUnit{std::move(module), f.printer.all(), kept};
  });
}

}  // namespace navjit::jit::detail

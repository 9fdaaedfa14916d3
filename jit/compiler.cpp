#include "jit/compiler.hpp"

#include <llvm/IR/DiagnosticInfo.h>
#include <llvm/IR/DiagnosticPrinter.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>
#include <llvm/Support/raw_ostream.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <new>
#include <optional>

#include "jit/detail/backend.hpp"
#include "jit/detail/frontend.hpp"
#include "jit/detail/large_stack.hpp"
#include "jit/detail/leave_wreck.hpp"
#include "jit/detail/preamble.hpp"
#include "jit/detail/processor_time.hpp"
#include "jit/detail/source_check.hpp"
#include "jit/detail/target.hpp"

namespace navjit::jit {
namespace {

class Stopwatch {
 public:
  /// Milliseconds since construction or the last call.
  double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The messages of passes and code generator. Without a handler LLVM prints them and exits.
struct BackendDiagnostics {
  std::string errors;
  std::string warnings;
};

void collect(const llvm::DiagnosticInfo* info, void* destination) {
  auto& diagnostics = *static_cast<BackendDiagnostics*>(destination);
  if (info->getSeverity() != llvm::DS_Error && info->getSeverity() != llvm::DS_Warning) return;
  std::string text;
  llvm::raw_string_ostream stream(text);
  llvm::DiagnosticPrinterRawOStream printer(stream);
  info->print(printer);
  stream << '\n';
  (info->getSeverity() == llvm::DS_Error ? diagnostics.errors : diagnostics.warnings) +=
      stream.str();
}

/// Names are used as paths and inside lines of text; "-" would mean standard input.
bool is_usable_name(std::string_view name) {
  return name.front() != '-' && std::none_of(name.begin(), name.end(), [](char c) {
           return static_cast<unsigned char>(c) < ' ' || c == 0x7f;
         });
}

bool defines_visible_function(const llvm::Module& module) {
  for (const llvm::Function& function : module) {
    if (!function.isDeclaration() && !function.hasLocalLinkage()) return true;
  }
  return false;
}

/// Nothing runs initialisers after linking, so code that relies on them would see zeros.
bool needs_initialisation(const llvm::Module& module) {
  return module.getNamedGlobal("llvm.global_ctors") != nullptr ||
         module.getNamedGlobal("llvm.global_dtors") != nullptr;
}

}  // namespace

struct Compiler::Impl {
  CompileOptions options;
  detail::Target target;
  std::vector<std::string> flags;
  detail::ProcessorTime compiling{};
  std::unique_ptr<detail::Preamble> preamble;
  std::shared_ptr<llvm::TargetMachine> machine;
  std::string description;

  /// Must be called when an exception went through the code generator, which must never be
  /// destroyed afterwards.
  void leave_machine() noexcept { std::construct_at(&left_behind.machine, machine); }

  Expected<Object> compile(std::string_view source, const std::string& unit_name,
                           const std::stop_token& stop) const {
    const detail::Bound bound(stop, options.most_ms);
    if (bound.is_reached()) return bound.failure();
    return detail::leave_wreck(std::make_unique<Work>(), [&](Work& work) {
      return compile_with(work, source, unit_name, bound);
    });
  }

 private:
  union LeftBehind {
    std::shared_ptr<llvm::TargetMachine> machine;
    LeftBehind() {}
    ~LeftBehind() {}
  } left_behind;

  /// The objects that a compilation makes on its way.
  struct Work {
    BackendDiagnostics diagnostics;
    llvm::LLVMContext context;
    std::shared_ptr<llvm::Module> module;
  };

  Expected<Object> compile_with(Work& work, std::string_view source, const std::string& unit_name,
                                const detail::Bound& bound) const {
    Stopwatch stopwatch;
    work.context.setDiagnosticHandlerCallBack(collect, &work.diagnostics, /*RespectFilters=*/true);
    Expected<detail::ParsedUnit> unit =
        detail::parse(source, unit_name, flags, target, *preamble, work.context);
    if (!unit) return unit.failure();
    work.module = unit->module;
    llvm::Module& module = *work.module;
    if (!defines_visible_function(module)) {
      return Failure{unit_name + ": no function visible from outside is defined"};
    }
    Object object;
    object.report.kept_preamble = unit->kept_preamble;
    object.report.frontend_ms = stopwatch.lap_ms();

    detail::make_floating_point_strict(module);
    detail::optimise(module, *machine, options.optimisation, bound);
    if (bound.is_reached()) return bound.failure();
    if (needs_initialisation(module)) {
      return Failure{unit_name + ": a global variable is not initialised by a constant"};
    }
    object.report.optimise_ms = stopwatch.lap_ms();

    Expected<std::vector<char>> bytes = detail::emit_object(module, *machine, bound);
    if (!bytes) return bytes.failure();
    if (!work.diagnostics.errors.empty()) {
      return Failure{unit_name + ": " + work.diagnostics.errors};
    }
    object.bytes = *std::move(bytes);
    object.report.codegen_ms = stopwatch.lap_ms();
    object.report.code_bytes = detail::machine_code_bytes(object.bytes);
    object.warnings = std::move(unit->warnings) + work.diagnostics.warnings;
    return object;
  }
};

Compiler::Compiler(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Compiler::Compiler(Compiler&&) noexcept = default;
Compiler& Compiler::operator=(Compiler&&) noexcept = default;
Compiler::~Compiler() = default;

Expected<Compiler> Compiler::create(const CompileOptions& options) {
  if (options.optimisation < 0 || options.optimisation > 3) {
    return Failure{"optimisation level " + std::to_string(options.optimisation) + " is not 0 to 3"};
  }
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->target = detail::resolve_target(options);
  auto machine = detail::make_target_machine(impl->target, options.optimisation);
  if (!machine) return machine.failure();
  impl->machine = *std::move(machine);
  impl->flags = detail::frontend_flags(options);
  impl->preamble = std::make_unique<detail::Preamble>(options.preamble);
  impl->description = navjit::jit::target_description(options);
  return Compiler(std::move(impl));
}

Expected<Object> Compiler::compile(std::string_view source, std::string_view unit_name,
                                   const std::stop_token& stop) {
  const std::string name(unit_name.empty() ? "unnamed.cpp" : unit_name);
  if (!is_usable_name(name)) return Failure{"not usable as the name of a unit: '" + name + "'"};
  if (source.size() > impl_->options.max_source_bytes) {
    return Failure{name + ": source of " + std::to_string(source.size()) +
                   " bytes is longer than the limit of " +
                   std::to_string(impl_->options.max_source_bytes)};
  }
  if (std::optional<Failure> failure = detail::too_deep(source, name)) return *failure;
  Expected<Object> result = Failure{name + ": compilation did not finish"};
  const std::optional<Failure> not_run = detail::run_on_large_stack(detail::stack_bytes, [&] {
    const detail::ProcessorTime::Watched time(impl_->compiling);
    try {
      result = impl_->compile(source, name, stop);
    } catch (const std::bad_alloc&) {
      impl_->leave_machine();
      result = out_of_memory();
    } catch (const std::exception& error) {
      result = Failure{name + ": " + error.what()};
    }
  });
  if (not_run) return *not_run;
  return result;
}

double Compiler::processor_seconds() const { return impl_->compiling.seconds(); }

const std::string& Compiler::target_description() const { return impl_->description; }

Expected<Object> compile(std::string_view source, std::string_view unit_name,
                         const CompileOptions& options) {
  Expected<Compiler> compiler = Compiler::create(options);
  if (!compiler) return compiler.failure();
  return compiler->compile(source, unit_name);
}

}  // namespace navjit::jit

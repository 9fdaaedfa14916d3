#include "jit/detail/target.hpp"

#include <clang/Basic/Version.h>
#include <llvm/ADT/StringMap.h>
#include <llvm/Config/llvm-config.h>
#include <llvm/MC/MCSubtargetInfo.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/ErrorHandling.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/Target/TargetMachine.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/Triple.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <new>
#include <optional>

#include "jit/detail/frontend.hpp"

namespace navjit::jit {
namespace detail {
namespace {

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    if (!text.empty()) text += ',';
    text += part;
  }
  return text;
}

/// For names that it does not know LLVM only prints a warning, so they are looked up beforehand.
std::optional<Failure> unknown_name(const llvm::Target& backend, const Target& target) {
  const std::unique_ptr<llvm::MCSubtargetInfo> known(
      backend.createMCSubtargetInfo(target.triple, "", ""));
  if (!known) return Failure{"no subtarget information for " + target.triple};
  if (!known->isCPUStringValid(target.cpu)) {
    return Failure{"unknown processor '" + target.cpu + "' for " + target.triple};
  }
  const auto features = known->getAllProcessorFeatures();
  for (const std::string& feature : target.features) {
    const bool is_signed = !feature.empty() && (feature[0] == '+' || feature[0] == '-');
    const bool is_known =
        is_signed && std::any_of(features.begin(), features.end(), [&](const auto& entry) {
          return feature.compare(1, std::string::npos, entry.Key) == 0;
        });
    if (!is_known) {
      return Failure{"unknown processor feature '" + feature + "' (want +name or -name)"};
    }
  }
  // Without these features the code generator ends the process when it compiles code for 64 bits.
  if (llvm::Triple(target.triple).getArch() == llvm::Triple::x86_64) {
    const std::unique_ptr<llvm::MCSubtargetInfo> subtarget(
        backend.createMCSubtargetInfo(target.triple, target.cpu, joined(target.features)));
    for (const char* needed : {"+64bit", "+cmov", "+cx8", "+fxsr", "+sse2", "+x87"}) {
      if (!subtarget->checkFeatures(needed)) {
        return Failure{"the target lacks the processor feature '" + std::string(needed + 1) + "'"};
      }
    }
  }
  return std::nullopt;
}

llvm::CodeGenOptLevel codegen_level(int optimisation) {
  switch (optimisation) {
    case 0:
      return llvm::CodeGenOptLevel::None;
    case 1:
      return llvm::CodeGenOptLevel::Less;
    case 2:
      return llvm::CodeGenOptLevel::Default;
    default:
      return llvm::CodeGenOptLevel::Aggressive;
  }
}

}  // namespace

void initialise_native_target() {
  // LLVM's registry of targets is process-wide and not synchronised. So is its handler for
  // exhausted memory; without a handler LLVM ends the process.
  static std::once_flag once;
  std::call_once(once, [] {
    llvm::install_bad_alloc_error_handler([](void*, const char*, bool) { throw std::bad_alloc(); });
    llvm::InitializeNativeTarget();
    llvm::InitializeNativeTargetAsmPrinter();
    llvm::InitializeNativeTargetAsmParser();
  });
}

Target resolve_target(const CompileOptions& options) {
  Target target;
  target.triple = llvm::sys::getProcessTriple();
  target.cpu = options.cpu;
  if (target.cpu.empty()) {
    target.cpu = llvm::sys::getHostCPUName().str();
    // A virtual machine may hide features that the processor's name implies.
    for (const auto& feature : llvm::sys::getHostCPUFeatures()) {
      // Processors that have this feature also have AVX-512, and Clang warns of the combination.
      if (feature.first() == "avx10.1-256") continue;
      target.features.emplace_back(1, feature.second ? '+' : '-');
      target.features.back() += feature.first();
    }
    // The map is unordered, but the description of a target must be unique.
    std::sort(target.features.begin(), target.features.end());
  }
  target.features.insert(target.features.end(), options.features.begin(), options.features.end());
  return target;
}

Expected<std::shared_ptr<llvm::TargetMachine>> make_target_machine(const Target& target,
                                                                   int optimisation) {
  initialise_native_target();
  std::string error;
  const llvm::Target* backend = llvm::TargetRegistry::lookupTarget(target.triple, error);
  if (backend == nullptr) return Failure{error};
  if (std::optional<Failure> failure = unknown_name(*backend, target)) return *failure;

  llvm::TargetOptions target_options;
  target_options.AllowFPOpFusion = llvm::FPOpFusion::Strict;
  std::shared_ptr<llvm::TargetMachine> machine(backend->createTargetMachine(
      target.triple, target.cpu, joined(target.features), target_options, llvm::Reloc::PIC_,
      llvm::CodeModel::Small, codegen_level(optimisation)));
  if (!machine) return Failure{"no code generator for " + target.triple};
  return machine;
}

}  // namespace detail

/// To be raised with each change of jit/ that changes the code which comes from one and the same
/// text (passes, strictness of floating-point arithmetic): caches then hold old code.
constexpr const char* passes_version = "1";

std::string target_description(const CompileOptions& options) {
  const detail::Target target = detail::resolve_target(options);
  return "llvm " LLVM_VERSION_STRING "; " + clang::getClangFullVersion() + "; " + target.triple +
         "; cpu=" + target.cpu + "; features=" + detail::joined(target.features) +
         "; flags=" + detail::joined(detail::frontend_flags(options)) +
         "; passes=" + passes_version;
}

bool has_compiler() { return true; }

std::vector<std::string> host_features() {
  // Code for 64 bits always requires these.
  constexpr std::array baseline{"64bit", "cmov", "cx8", "fxsr", "mmx", "sse", "sse2", "x87"};
  std::vector<std::string> features;
  for (const std::string& feature : detail::resolve_target({}).features) {
    std::string name = feature.substr(1);
    if (feature[0] == '+' && std::find(baseline.begin(), baseline.end(), name) == baseline.end()) {
      features.push_back(std::move(name));
    }
  }
  return features;
}

}  // namespace navjit::jit

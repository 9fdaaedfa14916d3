#include "jit/detail/backend.hpp"

#include <llvm/ADT/SmallVector.h>
#include <llvm/Analysis/TargetLibraryInfo.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/IR/Module.h>
#include <llvm/IR/Operator.h>
#include <llvm/IR/OptBisect.h>
#include <llvm/Object/ObjectFile.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Target/TargetMachine.h>
#include <llvm/TargetParser/Triple.h>

#include "jit/activity.hpp"
#include "jit/detail/leave_wreck.hpp"

namespace navjit::jit::detail {
namespace {

llvm::OptimizationLevel pipeline_level(int level) {
  switch (level) {
    case 0:
      return llvm::OptimizationLevel::O0;
    case 1:
      return llvm::OptimizationLevel::O1;
    case 2:
      return llvm::OptimizationLevel::O2;
    default:
      return llvm::OptimizationLevel::O3;
  }
}

/// The code generator asks this before each pass that it could do without. This is the only place
/// where it can be told to stop. It compiles one function after the other, so functions that it has
/// not begun can be emptied.
class StopGate : public llvm::OptPassGate {
 public:
  StopGate(llvm::Module& module, const Bound& bound) : module_(module), bound_(bound) {}

  bool isEnabled() const override { return true; }
  bool shouldRunPass(llvm::StringRef, llvm::StringRef unit) override {
    outlast_static_objects();
    if (!bound_.is_reached()) return true;
    // The unit is named "function (NAME)".
    if (!emptied_ && unit.consume_front("function (") && unit.consume_back(")")) {
      if (const llvm::Function* current = module_.getFunction(unit)) {
        for (auto next = std::next(current->getIterator()); next != module_.end(); ++next) {
          module_.getFunction(next->getName())->deleteBody();
        }
        emptied_ = true;
      }
    }
    return false;
  }

 private:
  llvm::Module& module_;
  const Bound& bound_;
  bool emptied_ = false;
};

/// The objects that the pipeline of passes works with.
struct Optimiser {
  llvm::PassInstrumentationCallbacks callbacks;
  llvm::TargetLibraryInfoImpl library;
  llvm::PassBuilder builder;
  llvm::LoopAnalysisManager loop_analyses;
  llvm::FunctionAnalysisManager function_analyses;
  llvm::CGSCCAnalysisManager call_graph_analyses;
  llvm::ModuleAnalysisManager module_analyses;
  llvm::ModulePassManager passes;

  Optimiser(llvm::TargetMachine& machine, const llvm::PipelineTuningOptions& tuning)
      : library(machine.getTargetTriple()), builder(&machine, tuning, std::nullopt, &callbacks) {}
};

/// The objects that the code generator works with.
struct Emitter {
  llvm::SmallVector<char, 0> bytes;
  llvm::raw_svector_ostream stream{bytes};
  llvm::legacy::PassManager passes;
  StopGate gate;

  Emitter(llvm::Module& module, const Bound& bound) : gate(module, bound) {}
};

}  // namespace

void make_floating_point_strict(llvm::Module& module) {
  for (llvm::Function& function : module) {
    for (const char* attribute : {"unsafe-fp-math", "no-infs-fp-math", "no-nans-fp-math",
                                  "no-signed-zeros-fp-math", "approx-func-fp-math"}) {
      function.removeFnAttr(attribute);
    }
    for (llvm::Instruction& instruction : llvm::instructions(function)) {
      if (llvm::isa<llvm::FPMathOperator>(instruction)) {
        instruction.copyFastMathFlags(llvm::FastMathFlags());
      }
    }
  }
}

void optimise(llvm::Module& module, llvm::TargetMachine& machine, int level, const Bound& bound) {
  llvm::PipelineTuningOptions tuning;
  tuning.LoopVectorization = level >= 2;
  // Packing neighbouring numbers into vectors made navigators slower, and compilation too
  // (docs/experiments.md).
  tuning.SLPVectorization = false;
  leave_wreck(std::make_unique<Optimiser>(machine, tuning), [&](Optimiser& o) {
    o.callbacks.registerShouldRunOptionalPassCallback([&bound](llvm::StringRef, const llvm::Any&) {
      outlast_static_objects();
      return !bound.is_reached();
    });
    o.function_analyses.registerPass([&] { return llvm::TargetLibraryAnalysis(o.library); });
    o.builder.registerModuleAnalyses(o.module_analyses);
    o.builder.registerCGSCCAnalyses(o.call_graph_analyses);
    o.builder.registerFunctionAnalyses(o.function_analyses);
    o.builder.registerLoopAnalyses(o.loop_analyses);
    o.builder.crossRegisterProxies(o.loop_analyses, o.function_analyses, o.call_graph_analyses,
                                   o.module_analyses);
    o.passes = level == 0 ? o.builder.buildO0DefaultPipeline(llvm::OptimizationLevel::O0)
                          : o.builder.buildPerModuleDefaultPipeline(pipeline_level(level));
    o.passes.run(module, o.module_analyses);
  });
}

Expected<std::vector<char>> emit_object(llvm::Module& module, llvm::TargetMachine& machine,
                                        const Bound& bound) {
  return leave_wreck(std::make_unique<Emitter>(module, bound),
                     [&](Emitter& e) -> Expected<std::vector<char>> {
                       const llvm::TargetLibraryInfoImpl library(machine.getTargetTriple());
                       e.passes.add(new llvm::TargetLibraryInfoWrapperPass(library));
                       if (machine.addPassesToEmitFile(e.passes, e.stream, nullptr,
                                                       llvm::CodeGenFileType::ObjectFile,
                                                       /*DisableVerify=*/true)) {
                         return Failure{"the code generator cannot write object files"};
                       }
                       module.getContext().setOptPassGate(e.gate);
                       e.passes.run(module);
                       if (bound.is_reached()) return bound.failure();
                       return std::vector<char>(e.bytes.begin(), e.bytes.end());
                     });
}

std::size_t machine_code_bytes(const std::vector<char>& object) {
  auto file = llvm::object::ObjectFile::createObjectFile(
      llvm::MemoryBufferRef(llvm::StringRef(object.data(), object.size()), "object"));
  if (!file) {
    llvm::consumeError(file.takeError());
    return 0;
  }
  std::size_t bytes = 0;
  for (const llvm::object::SectionRef& section : (*file)->sections()) {
    if (section.isText()) bytes += section.getSize();
  }
  return bytes;
}

}  // namespace navjit::jit::detail

#include "jit/linker.hpp"

#include <dlfcn.h>
#include <llvm/ExecutionEngine/JITLink/JITLink.h>
#include <llvm/ExecutionEngine/Orc/Core.h>
#include <llvm/ExecutionEngine/Orc/ExecutorProcessControl.h>
#include <llvm/ExecutionEngine/Orc/ObjectFileInterface.h>
#include <llvm/ExecutionEngine/Orc/ObjectLinkingLayer.h>
#include <llvm/ExecutionEngine/Orc/TaskDispatch.h>
#include <llvm/Object/ObjectFile.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/Triple.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>

#include "jit/detail/debugger.hpp"
#include "jit/detail/perf_map.hpp"

namespace navjit::jit {
namespace {

namespace jitlink = llvm::jitlink;
namespace orc = llvm::orc;

/// The functions outside itself that code may call: those that the code generator calls of its own
/// accord, and mathematical functions. All have a float variant with the suffix f, except the first
/// group.
constexpr const char* memory_functions[] = {"memcpy", "memmove", "memset", "memcmp", "bcmp"};
constexpr const char* math_functions[] = {
    "acos",      "asin",  "atan",   "atan2",  "cbrt",      "ceil",    "copysign",  "cos",   "cosh",
    "exp",       "exp2",  "expm1",  "fabs",   "fdim",      "floor",   "fma",       "fmax",  "fmin",
    "fmod",      "frexp", "hypot",  "ldexp",  "llrint",    "llround", "log",       "log10", "log1p",
    "log2",      "lrint", "modf",   "lround", "nearbyint", "pow",     "remainder", "rint",  "round",
    "roundeven", "sin",   "sincos", "sinh",   "sqrt",      "tan",     "tanh",      "trunc"};

/// Where a link placed code and data.
struct Placement {
  std::map<std::string, std::uint64_t> section_addresses;
  std::vector<detail::FunctionRange> functions;
  std::size_t code_bytes = 0, mapped_bytes = 0;
};

/// Records where each finished link placed code and data.
class PlacementRecorder : public orc::ObjectLinkingLayer::Plugin {
 public:
  /// Where to record; null to record nothing. Must not be called during a link.
  void set_destination(Placement* destination) { destination_ = destination; }

  void modifyPassConfig(orc::MaterializationResponsibility&, jitlink::LinkGraph&,
                        jitlink::PassConfiguration& passes) override {
    passes.PrePrunePasses.push_back([this](jitlink::LinkGraph& graph) {
      if (destination_ != nullptr) keep_functions(graph);
      return llvm::Error::success();
    });
    passes.PostFixupPasses.push_back([this](jitlink::LinkGraph& graph) {
      if (destination_ != nullptr) record(graph, *destination_);
      return llvm::Error::success();
    });
  }

  llvm::Error notifyFailed(orc::MaterializationResponsibility&) override {
    return llvm::Error::success();
  }
  llvm::Error notifyRemovingResources(orc::JITDylib&, orc::ResourceKey) override {
    return llvm::Error::success();
  }
  void notifyTransferringResources(orc::JITDylib&, orc::ResourceKey, orc::ResourceKey) override {}

 private:
  /// Keeps the symbols of local functions. These functions are called by their section's symbol. So
  /// their own symbols would be removed, and profilers would not know their names.
  static void keep_functions(jitlink::LinkGraph& graph) {
    for (jitlink::Symbol* symbol : graph.defined_symbols()) {
      if (symbol->hasName() && symbol->isCallable()) symbol->setLive(true);
    }
  }

  static void record(jitlink::LinkGraph& graph, Placement& placement) {
    for (jitlink::Section& section : graph.sections()) {
      const jitlink::SectionRange range(section);
      if (range.empty()) continue;
      placement.section_addresses[section.getName().str()] = range.getStart().getValue();
      placement.mapped_bytes += range.getSize();
      const bool executable = (static_cast<unsigned>(section.getMemProt()) &
                               static_cast<unsigned>(orc::MemProt::Exec)) != 0;
      placement.code_bytes += executable ? range.getSize() : 0;
    }
    for (const jitlink::Symbol* symbol : graph.defined_symbols()) {
      if (!symbol->hasName() || !symbol->isCallable()) continue;
      placement.functions.push_back(
          {symbol->getName().str(), symbol->getAddress().getValue(), symbol->getSize()});
    }
  }

  Placement* destination_ = nullptr;
};

/// Refuses bytes that are not an ELF object for this machine before the linker proper reads them.
std::optional<Failure> not_linkable(llvm::MemoryBufferRef bytes) {
  auto file = llvm::object::ObjectFile::createELFObjectFile(bytes);
  if (!file) return Failure{"not an object file: " + llvm::toString(file.takeError())};
  if (!(*file)->isRelocatableObject()) return Failure{"not a relocatable object file"};
  const llvm::Triple host(llvm::sys::getProcessTriple());
  if ((*file)->getArch() != host.getArch()) {
    return Failure{"object file is for " + llvm::Triple::getArchTypeName((*file)->getArch()).str() +
                   ", this machine is " + host.getArchName().str()};
  }
  return std::nullopt;
}

}  // namespace

/// Shared by the linker and all code it made, so that either may be destroyed first.
struct Linker::Impl {
  LinkerOptions options;
  std::mutex mutex;  // guards all members below
  std::optional<orc::ExecutionSession> session;
  std::optional<orc::ObjectLinkingLayer> layer;
  std::shared_ptr<PlacementRecorder> recorder = std::make_shared<PlacementRecorder>();
  orc::JITDylib* process = nullptr;  // the symbols of the process that code may use
  std::uint64_t links = 0;
  std::string errors;  // reported by the session since last cleared

  Impl(const LinkerOptions& linker_options, std::unique_ptr<orc::ExecutorProcessControl> control)
      : options(linker_options) {
    session.emplace(std::move(control));
    session->setErrorReporter([this](llvm::Error error) {
      if (!errors.empty()) errors += '\n';
      errors += llvm::toString(std::move(error));
    });
    layer.emplace(*session);
    layer->addPlugin(recorder);
  }

  ~Impl() {
    llvm::consumeError(session->endSession());
    layer.reset();
    session.reset();
  }

  llvm::Error define_process_symbols() {
    process = &session->createBareJITDylib("process");
    orc::SymbolMap symbols;
    const auto add = [&](const std::string& name) {
      if (void* address = dlsym(RTLD_DEFAULT, name.c_str())) {
        symbols[session->intern(name)] = {
            orc::ExecutorAddr::fromPtr(address),
            llvm::JITSymbolFlags::Exported | llvm::JITSymbolFlags::Callable};
      }
    };
    for (const char* name : memory_functions) add(name);
    for (const char* name : math_functions) {
      add(name);
      add(std::string(name) + 'f');
    }
    return process->define(orc::absoluteSymbols(std::move(symbols)));
  }

  /// Links into `dylib`. The mutex must be held.
  llvm::Expected<orc::SymbolMap> link_into(orc::JITDylib& dylib, llvm::MemoryBufferRef bytes,
                                           Placement& placement) {
    dylib.addToLinkOrder(*process);
    auto interface = orc::getObjectFileInterface(*session, bytes);
    if (!interface) return interface.takeError();
    orc::SymbolLookupSet names;
    for (const auto& [name, flags] : interface->SymbolFlags) {
      if (flags.isExported()) names.add(name);
    }
    auto copy = llvm::MemoryBuffer::getMemBufferCopy(bytes.getBuffer(), dylib.getName());
    if (auto error =
            layer->add(dylib.getDefaultResourceTracker(), std::move(copy), std::move(*interface))) {
      return error;
    }
    recorder->set_destination(&placement);
    auto symbols = session->lookup({{&dylib, orc::JITDylibLookupFlags::MatchExportedSymbolsOnly}},
                                   std::move(names));
    recorder->set_destination(nullptr);
    return symbols;
  }

  void remove(orc::JITDylib& dylib) {
    const std::lock_guard lock(mutex);
    remove_locked(dylib);
  }

  void remove_locked(orc::JITDylib& dylib) {
    llvm::consumeError(session->removeJITDylib(dylib));
    // Names of removed symbols stay in the pool until this call.
    session->getSymbolStringPool()->clearDeadEntries();
  }
};

struct Code::Impl {
  std::shared_ptr<Linker::Impl> linker;
  orc::JITDylib* dylib = nullptr;
  std::map<std::string, void*> symbols;
  LinkReport report;
  std::unique_ptr<detail::DebuggerRegistration> debugger;

  ~Impl() {
    debugger.reset();  // the debugger must not read the code once it is freed
    if (dylib != nullptr) linker->remove(*dylib);
  }
};

Code::Code(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Code::Code(Code&&) noexcept = default;
Code& Code::operator=(Code&&) noexcept = default;
Code::~Code() = default;

Expected<void*> Code::symbol(const std::string& name) const {
  const auto found = impl_->symbols.find(name);
  if (found == impl_->symbols.end()) return Failure{"no symbol '" + name + "' in linked code"};
  return found->second;
}

std::vector<std::string> Code::symbol_names() const {
  std::vector<std::string> names;
  for (const auto& [name, address] : impl_->symbols) names.push_back(name);
  return names;
}

const LinkReport& Code::report() const { return impl_->report; }

Linker::Linker(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
Linker::Linker(Linker&&) noexcept = default;
Linker& Linker::operator=(Linker&&) noexcept = default;
Linker::~Linker() = default;

namespace {

/// Why memory that was written cannot become code; nothing if it can. Systems may forbid it.
std::optional<Failure> no_executable_memory() {
  const auto bytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* page = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) return std::nullopt;  // there is none at all: whoever links says so
  const int error = mprotect(page, bytes, PROT_READ | PROT_EXEC) == 0 ? 0 : errno;
  munmap(page, bytes);
  if (error == 0) return std::nullopt;
  return Failure{std::string("this system lets no program run code that it has made (mprotect: ") +
                 std::strerror(error) + "); use JitMode::off (--jit off), or a plugin"};
}

}  // namespace

Expected<Linker> Linker::create(const LinkerOptions& options) {
  if (std::optional<Failure> failure = no_executable_memory()) return *failure;
  // Work is done by the thread that asks for it.
  auto control = orc::SelfExecutorProcessControl::Create(
      nullptr, std::make_unique<orc::InPlaceTaskDispatcher>());
  if (!control) return Failure{llvm::toString(control.takeError())};
  auto impl = std::make_shared<Impl>(options, std::move(*control));
  if (auto error = impl->define_process_symbols()) {
    return Failure{llvm::toString(std::move(error))};
  }
  return Linker(std::move(impl));
}

Expected<Code> Linker::link(const Object& object) {
  const auto start = std::chrono::steady_clock::now();
  const llvm::MemoryBufferRef bytes(llvm::StringRef(object.bytes.data(), object.bytes.size()),
                                    "object");
  if (std::optional<Failure> failure = not_linkable(bytes)) return *failure;

  auto code = std::make_unique<Code::Impl>();
  code->linker = impl_;
  Placement placement;
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->errors.clear();
    orc::JITDylib& dylib =
        impl_->session->createBareJITDylib("code" + std::to_string(impl_->links++));
    auto symbols = impl_->link_into(dylib, bytes, placement);
    if (!symbols) {
      std::string message = llvm::toString(symbols.takeError());
      impl_->remove_locked(dylib);
      if (!impl_->errors.empty()) message += '\n' + impl_->errors;
      return Failure{"link failed: " + message};
    }
    code->dylib = &dylib;
    for (const auto& [name, definition] : *symbols) {
      code->symbols[(*name).str()] = definition.getAddress().toPtr<void*>();
    }
  }
  if (impl_->options.debugger) {
    code->debugger =
        std::make_unique<detail::DebuggerRegistration>(object.bytes, placement.section_addresses);
  }
  if (impl_->options.perf_map) detail::append_to_perf_map(placement.functions);
  code->report.code_bytes = placement.code_bytes;
  code->report.mapped_bytes = placement.mapped_bytes;
  code->report.link_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return Code(std::move(code));
}

}  // namespace navjit::jit

// The interface of compiler and linker in programs without Clang and LLVM, where neither can be
// created.
#include "jit/compiler.hpp"
#include "jit/linker.hpp"

namespace navjit::jit {
namespace {

Failure absent() { return {"this program was built without a compiler"}; }

}  // namespace

struct Compiler::Impl {
  std::string description;
};

Compiler::Compiler(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Compiler::Compiler(Compiler&&) noexcept = default;
Compiler& Compiler::operator=(Compiler&&) noexcept = default;
Compiler::~Compiler() = default;

Expected<Compiler> Compiler::create(const CompileOptions&) { return absent(); }
Expected<Object> Compiler::compile(std::string_view, std::string_view, const std::stop_token&) {
  return absent();
}
double Compiler::processor_seconds() const { return 0; }
const std::string& Compiler::target_description() const { return impl_->description; }

Expected<Object> compile(std::string_view, std::string_view, const CompileOptions&) {
  return absent();
}
std::string target_description(const CompileOptions&) { return "no compiler"; }
bool has_compiler() { return false; }
std::vector<std::string> host_features() { return {}; }

struct Code::Impl {
  LinkReport report;
};

Code::Code(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Code::Code(Code&&) noexcept = default;
Code& Code::operator=(Code&&) noexcept = default;
Code::~Code() = default;
Expected<void*> Code::symbol(const std::string&) const { return absent(); }
std::vector<std::string> Code::symbol_names() const { return {}; }
const LinkReport& Code::report() const { return impl_->report; }

struct Linker::Impl {};

Linker::Linker(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
Linker::Linker(Linker&&) noexcept = default;
Linker& Linker::operator=(Linker&&) noexcept = default;
Linker::~Linker() = default;
Expected<Linker> Linker::create(const LinkerOptions&) { return absent(); }
Expected<Code> Linker::link(const Object&) { return absent(); }

}  // namespace navjit::jit

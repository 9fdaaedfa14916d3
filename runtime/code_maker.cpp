#include "runtime/code_maker.hpp"

#include <spdlog/spdlog.h>

#include <exception>

#include "codegen/module_text.hpp"
#include "runtime/instruction_set.hpp"

namespace navjit {
namespace {

std::string_view view(const std::vector<char>& bytes) { return {bytes.data(), bytes.size()}; }

constexpr const char* unit_name = "navjit_module";

jit::CompileOptions compile_options(const SpecialiserOptions& options, spdlog::logger& log) {
  jit::CompileOptions result;
  result.optimisation = options.optimisation;
  result.debug_info = options.debug_info;
  result.most_ms = longest_module_ms;
  // A debugger shows the source by line numbers that count from its beginning. So it cannot be
  // compiled on top of a parsed preamble.
  if (!options.debug_info) result.preamble = codegen::common_text();
  result.cpu = processor_for(options.instruction_set, log);
  return result;
}

}  // namespace

CodeMaker::CodeMaker(const SpecialiserOptions& options, const Cache& cache,
                     std::shared_ptr<spdlog::logger> log)
    : log_(std::move(log)),
      compile_options_(compile_options(options, *log_)),
      linker_options_{true, options.perf_map},
      cache_place_(cache),
      target_(jit::target_description(compile_options_)) {
  if (!cache_place_) return;
  try {
    cache::sha256({});
  } catch (const std::exception& error) {
    complain(complained_of_cache_, std::string(error.what()) + "; this run has no cache");
    cache_place_ = {};
  }
}

void CodeMaker::complain(bool& complained, const std::string& what) const {
  // Errors of one kind often come many at a time: the first one is a warning, the others are lines
  // of level debug.
  if (complained) {
    log_->debug("cache {}: {}", cache_place_.directory, what);
  } else {
    log_->warn("cache {}: {}", cache_place_.directory, what);
  }
  complained = true;
}

cache::ObjectCache* CodeMaker::cache() {
  if (!cache_place_) return nullptr;
  if (!cache_) {
    cache::CacheLimits limits;
    limits.max_bytes = cache_place_.max_bytes;
    auto opened = cache::ObjectCache::open(cache_place_.directory, limits);
    if (!opened) {
      complain(complained_of_cache_, opened.failure().message + "; this run has no cache");
      cache_place_ = {};
      return nullptr;
    }
    cache_ = *std::move(opened);
  }
  return &*cache_;
}

jit::Linker* CodeMaker::linker() {
  if (!linker_ && no_linker_.empty()) {
    auto made = jit::Linker::create(linker_options_);
    if (made) {
      linker_ = *std::move(made);
    } else {
      no_linker_ = made.failure().message;
    }
  }
  return linker_ ? &*linker_ : nullptr;
}

jit::Compiler* CodeMaker::compiler() {
  if (!compiler_ && no_compiler_.empty()) {
    auto made = jit::Compiler::create(compile_options_);
    if (made) {
      compiler_ = *std::move(made);
    } else {
      no_compiler_ = made.failure().message;
    }
  }
  return compiler_ ? &*compiler_ : nullptr;
}

cache::Digest CodeMaker::key(std::string_view kind, std::string_view text) const {
  return cache::sha256_of_parts({"navjit cache 1", kind, target_, text});
}

std::optional<CodeMaker::Made> CodeMaker::find(std::string_view source) {
  cache::ObjectCache* entries = cache();
  if (entries == nullptr || linker() == nullptr) return std::nullopt;
  cache::CacheHit hit = entries->load(key("object", source));
  if (!hit.rejected.empty()) complain(complained_of_entry_, "entry not used: " + hit.rejected);
  if (!hit.content) return std::nullopt;
  jit::Object object;
  object.bytes = *std::move(hit.content);
  auto code = linker()->link(object);
  if (!code) {
    complain(complained_of_entry_, "entry not used: " + code.failure().message);
    if (!code.failure().exhausted) entries->discard(key("object", source));
    return std::nullopt;
  }
  return Made{*std::move(code), std::move(object)};
}

Expected<CodeMaker::Made> CodeMaker::compile(std::string_view source, const std::stop_token& stop) {
  if (linker() == nullptr) return Failure{no_linker_};
  if (compiler() == nullptr) return Failure{no_compiler_};
  auto object = compiler()->compile(source, unit_name, stop);
  if (!object) return object.failure();
  auto code = linker()->link(*object);
  if (!code) return code.failure();
  return Made{*std::move(code), *std::move(object)};
}

void CodeMaker::store(const cache::Digest& entry, std::string_view label,
                      std::string_view content) {
  cache::ObjectCache* entries = can_store_ ? cache() : nullptr;
  if (entries == nullptr) return;
  if (const auto failure = entries->store(entry, label, content)) {
    complain(complained_of_cache_, failure->message + "; nothing more is stored in this run");
    can_store_ = false;
  }
}

void CodeMaker::keep(std::string_view source, std::string_view label, const jit::Object& object) {
  if (!cache_place_) return;
  store(key("object", source), label, view(object.bytes));
}

void CodeMaker::reject(std::string_view source) {
  complain(complained_of_entry_, "an entry holds code that gives wrong answers: removed");
  if (cache::ObjectCache* entries = cache()) entries->discard(key("object", source));
}

std::optional<std::string> CodeMaker::recall(std::string_view name) {
  cache::ObjectCache* entries = cache();
  if (entries == nullptr) return std::nullopt;
  const cache::CacheHit hit = entries->load(key("text", name));
  if (!hit.rejected.empty()) complain(complained_of_entry_, "entry not used: " + hit.rejected);
  if (!hit.content) return std::nullopt;
  return std::string(view(*hit.content));
}

void CodeMaker::remember(std::string_view name, std::string_view label, std::string_view text) {
  if (cache_place_) store(key("text", name), label, text);
}

}  // namespace navjit

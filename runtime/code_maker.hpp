// Makes linked code from source: from the cache if it is there, otherwise by compiling. Private to
// runtime/.
#pragma once

#include <spdlog/fwd.h>

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "cache/object_cache.hpp"
#include "jit/compiler.hpp"
#include "jit/linker.hpp"
#include "navjit/cache.hpp"
#include "navjit/options.hpp"

namespace navjit {

/// The largest processor time for a module, several times the longest expected time. A module that
/// the cost model misjudges must not keep all others waiting.
constexpr double longest_module_ms = 4000;

/// For one thread at a time. The compiler is made when it is first needed, so a run that finds
/// everything in the cache never makes one. The cache is never a reason to fail: trouble with it is
/// reported in one line of the log for each kind.
class CodeMaker {
 public:
  CodeMaker(const SpecialiserOptions& options, const Cache& cache,
            std::shared_ptr<spdlog::logger> log);

  struct Made {
    jit::Code code;
    jit::Object object;
  };

  /// Code for this source from the cache; nothing if it is not there.
  std::optional<Made> find(std::string_view source);
  /// Fails as stopped soon after a stop is requested.
  Expected<Made> compile(std::string_view source, const std::stop_token& stop);
  /// Makes the compiler. Must be called before one thread compiles and another asks for its time.
  void make_compiler() { compiler(); }
  /// Processor time of all compilations so far, s. Any thread may ask, once the compiler is made.
  double processor_seconds() const { return compiler_ ? compiler_->processor_seconds() : 0; }
  /// Puts the object that was compiled from this source into the cache.
  void keep(std::string_view source, std::string_view label, const jit::Object& object);
  /// Makes sure that faulty code for this source is not found in the cache again.
  void reject(std::string_view source);

  bool has_cache() const { return static_cast<bool>(cache_place_); }
  /// Text kept in the cache for code of this target, by a name.
  std::optional<std::string> recall(std::string_view name);
  void remember(std::string_view name, std::string_view label, std::string_view text);

  /// Why nothing can be compiled, or linked, in this process; empty as long as it can.
  const std::string& no_compiler() const { return no_compiler_; }
  const std::string& no_linker() const { return no_linker_; }

 private:
  cache::ObjectCache* cache();
  jit::Linker* linker();
  jit::Compiler* compiler();
  cache::Digest key(std::string_view kind, std::string_view text) const;
  void store(const cache::Digest& key, std::string_view label, std::string_view content);
  void complain(bool& complained, const std::string& what) const;

  std::shared_ptr<spdlog::logger> log_;
  jit::CompileOptions compile_options_;
  jit::LinkerOptions linker_options_;
  Cache cache_place_;
  std::string target_;  ///< what determines the code besides the source
  std::optional<cache::ObjectCache> cache_;
  std::optional<jit::Linker> linker_;
  std::optional<jit::Compiler> compiler_;
  std::string no_compiler_, no_linker_;
  bool can_store_ = true;
  bool complained_of_entry_ = false, complained_of_cache_ = false;
};

}  // namespace navjit

// How navigators are specialised, and where compiled code is kept.
#pragma once

#include "navjit/options.hpp"

namespace CLI {
class App;
}

namespace navjit::apps {

/// --cache: a directory or, if it `may_be_off`, "off"; the environment variable serves those who
/// cannot change a command line.
void add_cache_option(CLI::App& command, Cache& cache, bool may_be_off);

/// --isa.
void add_isa(CLI::App& command, InstructionSet& set);

/// What the code shall be like: --isa, --nice. --level is refused.
void add_code_options(CLI::App& command, RuntimeOptions& options);

/// What is specialised, and when: --jit, --plugin, --cache, --opt, --perf-map, --boxes.
void add_jit_options(CLI::App& command, RuntimeOptions& options);

/// All of them.
void add_runtime_options(CLI::App& command, RuntimeOptions& options);

}  // namespace navjit::apps

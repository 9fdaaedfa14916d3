#include "apps/options/runtime.hpp"

#include <CLI/CLI.hpp>

#include "apps/options/boxes.hpp"
#include "apps/options/numbers.hpp"
#include "common/choices.hpp"

namespace navjit::apps {
namespace {

using common::Choices;

const Choices<JitMode> jit_modes{{"off", JitMode::off},
                                 {"on", JitMode::on},
                                 {"wait", JitMode::wait},
                                 {"shadow", JitMode::shadow}};

}  // namespace

void add_cache_option(CLI::App& command, Cache& cache, bool may_be_off) {
  cache = Cache::user_default();
  command
      .add_option_function<std::string>(
          "--cache",
          [&cache](const std::string& text) {
            if (text.empty()) throw CLI::ValidationError("--cache", "the value is empty");
            cache = text == "off" ? Cache{} : Cache::in(text);
          },
          may_be_off ? "of compiled code: a directory, or off (default: the user's)"
                     : "directory (default: the user's)")
      ->envname("NAVJIT_CACHE")
      ->option_text(may_be_off ? "DIR|off" : "DIR");
}

void add_isa(CLI::App& command, InstructionSet& set) {
  add_choice(command, "--isa", set, common::instruction_sets,
             "instructions of generated code: native (default), sse4.2, avx2 or\navx512")
      ->option_text("SET");
}

void add_code_options(CLI::App& command, RuntimeOptions& options) {
  // There was a choice once; whoever still makes it is told.
  command
      .add_option_function<std::string>(
          "--level",
          [](const std::string&) {
            throw CLI::ValidationError(
                "--level", "answers are always exact; what may be left out is --observe's to say");
          },
          "")
      ->group("");
  add_isa(command, options.specialiser.instruction_set);
  command
      .add_option("--nice", options.specialiser.nice,
                  "priority of the compiler's thread (default: 0, as the others)")
      ->transform(count(0, 19))
      ->option_text("0..19");
}

void add_jit_options(CLI::App& command, RuntimeOptions& options) {
  options.specialiser.safety = false;  // the commands' rays never ask for it
  add_cache_option(command, options.cache, true);
  add_choice(command, "--jit", options.jit, jit_modes,
             "off, on, wait (specialise first) or shadow (compare);\n(default: on)")
      ->option_text("MODE");
  command.add_option("--plugin", options.plugin, "made by navjit specialise; used from the start")
      ->check(not_empty())
      ->option_text("FILE");
  command
      .add_option("--opt", options.specialiser.optimisation,
                  "compiler's optimisation, 0 to 3 (default: 2)")
      ->transform(count(0, 3))
      ->option_text("N");
  command.add_flag("--perf-map", options.specialiser.perf_map,
                   "name generated functions for perf (/tmp/perf-PID.map)");
  add_boxes(command, options.geometry);
}

void add_runtime_options(CLI::App& command, RuntimeOptions& options) {
  add_jit_options(command, options);
  add_code_options(command, options);
}

}  // namespace navjit::apps

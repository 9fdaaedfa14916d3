#include "apps/warmup/one_run_options.hpp"

#include <CLI/CLI.hpp>
#include <cstddef>

#include "apps/options/numbers.hpp"
#include "apps/options/runtime.hpp"
#include "apps/options/source.hpp"

namespace navjit::warmup {

std::vector<CLI::Option*> add_shared_options(CLI::App& command, RunSetup& setup) {
  const std::vector<CLI::Option*> before = command.get_options();
  apps::add_detector(command, setup.detector);
  apps::add_source(command, setup.source);
  apps::add_threads(command, setup.threads);
  apps::add_code_options(command, setup.runtime);
  command
      .add_option("--interval", setup.interval, "between points of the series, s (default: 0.02)")
      ->check(apps::number(0.001, 10.0))
      ->option_text("S");
  std::vector<CLI::Option*> added = command.get_options();
  added.erase(added.begin(), added.begin() + static_cast<std::ptrdiff_t>(before.size()));
  return added;
}

std::vector<CLI::Option*> options_of_plugins(const std::vector<CLI::Option*>& options) {
  std::vector<CLI::Option*> found;
  for (CLI::Option* option : options) {
    for (const char* name : {"detector", "--setup", "--isa"}) {
      if (option->get_name() == name) found.push_back(option);
    }
  }
  return found;
}

std::vector<std::string> words_given(const std::vector<CLI::Option*>& options) {
  std::vector<std::string> words;
  for (const CLI::Option* option : options) {
    if (option->count() == 0) continue;
    if (!option->get_positional()) words.push_back(option->get_name());
    words.push_back(option->results().at(0));
  }
  return words;
}

}  // namespace navjit::warmup

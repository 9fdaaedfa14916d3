// Options that `navjit warmup` hands on to its runs: given once, for both, so that none can be lost
// on the way.
#pragma once

#include <string>
#include <vector>

#include "apps/warmup/one_run.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace navjit::warmup {

/// Adds them to a command; gives what it added.
std::vector<CLI::Option*> add_shared_options(CLI::App& command, RunSetup& setup);

/// Those of them that `navjit specialise` has, too.
std::vector<CLI::Option*> options_of_plugins(const std::vector<CLI::Option*>& options);

/// Those that were given, as words of a command line.
std::vector<std::string> words_given(const std::vector<CLI::Option*>& options);

}  // namespace navjit::warmup

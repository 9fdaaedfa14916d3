// `navjit plugin`: plugins that were compiled from `navjit specialise --emit cpp` elsewhere.
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/numbers.hpp"
#include "runtime/make_plugin.hpp"

namespace navjit::apps {
namespace {

int seal(const std::string& library) {
  seal_plugin(library);
  return 0;
}

}  // namespace

void add_plugin(CLI::App& app, Action& action) {
  const auto library = std::make_shared<std::string>();
  CLI::App& command = *app.add_subcommand("plugin", "Plugins that were compiled elsewhere");
  command.require_subcommand(1);
  CLI::App& sealing = *command.add_subcommand("seal", "make a plugin of a shared library");
  sealing.add_option("library", *library, "file, changed in place")->check(not_empty())->required();
  sealing.callback([library, &action] { action = [library] { return seal(*library); }; });
}

}  // namespace navjit::apps

// `navjit accuracy` where the program has no reference at 113 bits.
#include <CLI/CLI.hpp>

#include "apps/commands.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {

void add_accuracy(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("accuracy", "Not in this program; see `navjit accuracy`");
  command.allow_extras();
  command.callback([&action] {
    action = []() -> int {
      throw Error("this program was built without the reference at 113 bits that `accuracy` needs");
    };
  });
}

}  // namespace navjit::apps

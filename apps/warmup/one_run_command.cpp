// `navjit warmup-run`: one run of navjit warmup, whose record goes to standard output.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/numbers.hpp"
#include "apps/options/runtime.hpp"
#include "apps/warmup/one_run_options.hpp"

namespace navjit::apps {

void add_warmup_run(CLI::App& app, Action& action) {
  const auto setup = std::make_shared<warmup::RunSetup>();
  CLI::App& command = *app.add_subcommand("warmup-run", "One run of navjit warmup");
  command.group("");  // for navjit itself
  warmup::add_shared_options(command, *setup);
  command.add_option("--seconds", setup->seconds)->check(number(0.05, 3600.0));
  command.add_option("--save-profile", setup->save_profile);
  add_jit_options(command, setup->runtime);
  command.callback([setup, &action] {
    action = [setup] {
      std::puts(to_text(run_once(*setup)).c_str());
      return 0;
    };
  });
}

}  // namespace navjit::apps

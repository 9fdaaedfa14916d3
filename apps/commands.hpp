// The subcommands. Each has a file, or a folder, of its own with its options, and one line here and
// in the list of main.cpp.
//
// Errors: what a command cannot do is thrown as a std::exception whose message is one line (what,
// where, and what to do); main prints it and exits with 1. Wrong usage that the parser does not see
// is thrown as CLI::ValidationError while it parses; main exits with 2. A command returns 1 where
// it worked and what it looked at is not as it should be.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace navjit::apps {

/// What the command line asks for: set while it is parsed, called afterwards; gives the exit
/// status.
using Action = std::function<int()>;

// Each adds a subcommand to `app`, which sets `action` if it is the one that is given. `action`
// has to outlive the parsing.
void add_accuracy(CLI::App& app, Action& action);
void add_cache(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_import(CLI::App& app, Action& action);
void add_inspect(CLI::App& app, Action& action);
void add_picture(CLI::App& app, Action& action);
void add_plugin(CLI::App& app, Action& action);
void add_profile(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_run(CLI::App& app, Action& action);
void add_scan(CLI::App& app, Action& action);
void add_simplify(CLI::App& app, Action& action);
void add_specialise(CLI::App& app, Action& action);
void add_trace(CLI::App& app, Action& action);
void add_warmup(CLI::App& app, Action& action);
void add_warmup_run(CLI::App& app, Action& action);

}  // namespace navjit::apps

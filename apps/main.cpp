// The `navjit` command: reads the command line, calls the command, turns exceptions into one line.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>

#include "apps/commands.hpp"
#include "apps/mpi/launcher.hpp"
#include "common/interruption.hpp"
#include "common/leave.hpp"
#include "common/standard_streams.hpp"
#include "common/text.hpp"
#include "jit/compiler.hpp"
#include "runtime/log_text.hpp"
#include "runtime/version.hpp"

namespace {

using namespace navjit;

constexpr void (*commands[])(CLI::App&, apps::Action&) = {
    apps::add_inspect,  apps::add_run,      apps::add_trace,      apps::add_check,
    apps::add_simplify, apps::add_cache,    apps::add_specialise, apps::add_profile,
    apps::add_plugin,   apps::add_accuracy, apps::add_warmup,     apps::add_warmup_run,
    apps::add_picture,  apps::add_scan,     apps::add_import,     apps::add_report};

/// Of the processes of one run only the first speaks: true in the others.
bool silent = false;

/// One line, whatever names from files are in it.
void print_error(const std::string& text) {
  if (silent) return;
  std::fflush(stdout);  // where both go to one place, the error has a line to itself
  std::fprintf(stderr, "navjit: %s\n", common::printable(one_line(text, 4000)).c_str());
}

/// The innermost command that was named.
const CLI::App& named_command(const CLI::App& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : named_command(*parsed.front());
}

/// What is wrong with the words after `navjit`, and where to look it up. Words that no option takes
/// are more to the point than the options that are missing for them.
std::string wrong_usage(const CLI::App& app, const CLI::Error& error) {
  const CLI::App& command = named_command(app);
  std::string name;
  for (const CLI::App* at = &command; at->get_parent() != nullptr; at = at->get_parent()) {
    name = at->get_name() + " " + name;
  }
  std::string what = error.what();
  std::vector<std::string> left = app.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {  // they are in its message alone
    std::istringstream words(what.substr(what.rfind(": ") + 1));
    for (std::string word; words >> word;) left.push_back(word);
  } else if (dynamic_cast<const CLI::RequiredError*>(&error) == nullptr) {
    left.clear();
  }
  const bool wants_command = command.get_require_subcommand_min() > 0;
  const auto strange = std::find_if(left.begin(), left.end(), [&](const std::string& word) {
    return word.starts_with("-") != wants_command;
  });
  if (strange != left.end()) {
    what = "'" + *strange + "' is no " +
           (wants_command ? "subcommand" : "option of " + name.substr(0, name.size() - 1));
  }
  return what + "; see navjit " + name + "--help";
}

/// Help names the values of options, and says which options are required besides.
void mark_required(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    const std::string& text = option->get_option_text();
    if (option->get_required() && !text.empty()) option->option_text(text + " REQUIRED");
  }
  for (CLI::App* command : app.get_subcommands({})) mark_required(*command);
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{jit::has_compiler()
                   ? "Particle transport through detectors, with navigators written while it runs"
                   : "Particle transport through detectors, with navigators that need no compiler"};
  app.name(argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "navjit");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_line(), "what this program is made of");
  bool verbose = false, quiet = false;
  CLI::Option* talk = app.add_flag("-v,--verbose", verbose, "log decisions");
  app.add_flag("-q,--quiet", quiet, "no progress line, and of the log errors alone")
      ->excludes(talk);
  apps::Action action;
  for (const auto add : commands) add(app, action);
  mark_required(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::Error& error) {
    print_error(wrong_usage(app, error));
    return 2;
  }
  spdlog::set_default_logger(spdlog::stderr_color_mt("navjit"));
  spdlog::set_level(silent    ? spdlog::level::off
                    : verbose ? spdlog::level::debug
                    : quiet   ? spdlog::level::err
                              : spdlog::level::warn);
  return action();
}

int guarded(int argc, char** argv) {
  try {
    const int status = parse_and_run(argc, argv);
    common::finish_standard_output();
    return status;
  } catch (const common::Interrupted&) {
  } catch (const std::bad_alloc&) {
    print_error(
        "out of memory; fewer --threads or --rays need less; or raise the limit (ulimit -v)");
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  common::secure_standard_streams();
  common::watch_signals();
  silent = apps::mpi::is_silent(argc, argv);
  const int status = guarded(argc, argv);
  // A launcher kills the others as soon as one ends with another status than 0: that is the first
  // one's to do, once it has spoken.
  if (silent) common::leave(0);
  const int signal = common::interruption();
  if (signal == 0) common::leave(status);
  print_error("ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")");
  common::leave(128 + signal);
}

// The `navjit` command: reads the command line, calls the command, turns exceptions into one line.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "apps/commands.hpp"

namespace {

using namespace navjit;

constexpr void (*commands[])(CLI::App&, apps::Action&) = {
    apps::add_inspect,  apps::add_run,        apps::add_trace,     apps::add_check,
    apps::add_cache,    apps::add_specialise, apps::add_profile,   apps::add_plugin,
    apps::add_accuracy, apps::add_warmup,     apps::add_warmup_run};

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Particle transport through detectors, with navigators written while it runs"};
  app.name("navjit");
  app.require_subcommand(1);
  bool verbose = false;
  app.add_flag("-v,--verbose", verbose, "log decisions");
  apps::Action action;
  for (const auto add : commands) add(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::Error& error) {
    std::fprintf(stderr, "navjit: %s; see navjit --help\n", error.what());
    return 2;
  }
  spdlog::set_default_logger(spdlog::stderr_color_mt("navjit"));
  spdlog::set_level(verbose ? spdlog::level::debug : spdlog::level::warn);
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navjit: %s\n", error.what());
    return 1;
  }
}

// `navjit cache`: upkeep of the directory of compiled code.
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <memory>

#include "apps/commands.hpp"
#include "apps/options/runtime.hpp"
#include "cache/object_cache.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps {
namespace {

enum class Task : std::uint8_t { list, verify, clear, path };
struct Options {
  Cache cache;
  Task task = Task::list;
};

std::string local_time(std::int64_t seconds) {
  const std::time_t time = static_cast<std::time_t>(seconds);
  std::tm fields{};
  char text[32] = "-";
  if (localtime_r(&time, &fields) != nullptr) {
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &fields);
  }
  return text;
}

/// Prints entries, all or those with problems; returns the number of problems.
std::size_t print(const std::vector<cache::CacheEntry>& entries, bool only_problems) {
  std::size_t problems = 0;
  std::uint64_t bytes = 0;
  for (const cache::CacheEntry& entry : entries) {
    bytes += entry.bytes;
    problems += entry.problem.empty() ? 0 : 1;
    if (only_problems && entry.problem.empty()) continue;
    std::printf(
        "%s  %7.1f kB  %.16s  %s\n", local_time(entry.last_used).c_str(),
        static_cast<double>(entry.bytes) / 1024, entry.file.c_str(),
        entry.problem.empty() ? entry.label.c_str() : ("rejected: " + entry.problem).c_str());
  }
  std::printf("%zu entries, %.1f kB, %zu rejected\n", entries.size(),
              static_cast<double>(bytes) / 1024, problems);
  return problems;
}

int cache(const Options& options) {
  const std::string& directory = options.cache.directory;
  if (directory.empty()) {
    throw Error(
        "there is no cache directory: it is off (by --cache or NAVJIT_CACHE), or none is given and "
        "neither XDG_CACHE_HOME nor HOME is an absolute path");
  }
  if (options.task == Task::path) {
    std::printf("%s\n", directory.c_str());
    return 0;
  }
  struct stat status;
  if (stat(directory.c_str(), &status) != 0 && errno == ENOENT) {
    std::printf("%s is not there yet: an empty cache\n", directory.c_str());
    return 0;
  }
  auto opened = cache::ObjectCache::open(directory, {}, false);
  if (!opened) throw Error(opened.failure().message);
  if (options.task == Task::clear) {
    const auto removed = opened->clear();
    if (!removed) throw Error(directory + ": " + removed.failure().message);
    std::printf("%zu entries removed\n", *removed);
    return 0;
  }
  const bool verify = options.task == Task::verify;
  const auto entries = opened->list(verify);
  if (!entries) throw Error(directory + ": " + entries.failure().message);
  const std::size_t problems = print(*entries, verify);
  return verify && problems > 0 ? 1 : 0;
}

}  // namespace

void add_cache(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("cache", "Look after compiled code");
  command.require_subcommand(1);
  add_cache_option(command, options->cache, false);
  const auto add_task = [&](const char* name, const char* what, Task task) {
    command.add_subcommand(name, what)->fallthrough()->callback([options, task] {
      options->task = task;
    });
  };
  add_task("list", "what is in it, last used first", Task::list);
  add_task("verify", "check every entry; exit status 1 if one is damaged", Task::verify);
  add_task("clear", "remove all entries", Task::clear);
  add_task("path", "where it is", Task::path);
  command.callback([options, &action] { action = [options] { return cache(*options); }; });
}

}  // namespace navjit::apps

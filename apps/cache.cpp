// `navjit cache`: upkeep of the directory of compiled code.
#include <sys/stat.h>

#include <cstdio>
#include <ctime>
#include <stdexcept>

#include "apps/commands.hpp"
#include "jit/object_cache.hpp"

namespace navjit::apps {
namespace {

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
std::size_t print(const std::vector<jit::CacheEntry>& entries, bool only_problems) {
  std::size_t problems = 0;
  std::uint64_t bytes = 0;
  for (const jit::CacheEntry& entry : entries) {
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

}  // namespace

int cache(const CacheOptions& options) {
  const std::string& directory = options.cache.directory;
  if (directory.empty()) {
    throw std::runtime_error(
        "there is no cache directory: none is given, and neither XDG_CACHE_HOME nor HOME is an "
        "absolute path");
  }
  if (options.action == CacheAction::path) {
    std::printf("%s\n", directory.c_str());
    return 0;
  }
  struct stat status;
  if (stat(directory.c_str(), &status) != 0 && errno == ENOENT) {
    std::printf("%s is not there yet: an empty cache\n", directory.c_str());
    return 0;
  }
  auto opened = jit::ObjectCache::open(directory, {}, false);
  if (!opened) throw std::runtime_error(opened.failure().message);
  if (options.action == CacheAction::clear) {
    const auto removed = opened->clear();
    if (!removed) throw std::runtime_error(directory + ": " + removed.failure().message);
    std::printf("%zu entries removed\n", *removed);
    return 0;
  }
  const bool verify = options.action == CacheAction::verify;
  const auto entries = opened->list(verify);
  if (!entries) throw std::runtime_error(directory + ": " + entries.failure().message);
  const std::size_t problems = print(*entries, verify);
  return verify && problems > 0 ? 1 : 0;
}

}  // namespace navjit::apps

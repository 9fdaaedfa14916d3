#include "navjit/cache.hpp"

#include <cstdlib>

namespace navjit {

Cache Cache::user_default() {
  // The XDG base directory specification says that relative paths must be ignored.
  const auto absolute = [](const char* name) -> std::string {
    const char* value = std::getenv(name);
    return value != nullptr && value[0] == '/' ? value : "";
  };
  if (const std::string base = absolute("XDG_CACHE_HOME"); !base.empty()) {
    return in(base + "/navjit");
  }
  if (const std::string home = absolute("HOME"); !home.empty()) return in(home + "/.cache/navjit");
  return {};
}

}  // namespace navjit

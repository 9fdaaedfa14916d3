#include "runtime/private_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include "cache/trust.hpp"
#include "navjit/cache.hpp"
#include "navjit/detail/expected.hpp"
#include "navjit/errors.hpp"

namespace navjit {
namespace {

/// Makes a folder in `parent`, and returns its path. Fails if it cannot be made or is not trusted.
Expected<std::string> make_in(const std::string& parent) {
  std::string path = parent + "/navjit-XXXXXX";
  if (mkdtemp(path.data()) == nullptr) {  // 0700
    return Failure{parent + ": " + std::strerror(errno)};
  }
  const auto trusted = cache::open_trusted_directory(path, false);
  if (trusted) return path;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return trusted.failure();
}

}  // namespace

PrivateFolder::PrivateFolder() {
  std::error_code none;
  const std::string temporary = std::filesystem::temp_directory_path(none).string();
  // There is none if TMPDIR names no directory.
  Expected<std::string> made = make_in(none ? "/tmp" : temporary);
  if (!made) {
    const std::string why = made.failure().message;
    const std::string user = Cache::user_default().directory;
    if (!user.empty() && cache::open_trusted_directory(user, true)) made = make_in(user);
    if (!made) throw Error("no place for temporary files (TMPDIR names one): " + why);
  }
  path_ = *made;
  temporary_.emplace(path_);
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace navjit

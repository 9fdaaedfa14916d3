#include "runtime/private_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include "cache/trust.hpp"
#include "navjit/cache.hpp"
#include "navjit/errors.hpp"

namespace navjit {
namespace {

/// Makes a folder in `parent`. Returns an empty path, and says `why`, if it cannot be made or is
/// not trusted.
std::string make_in(const std::string& parent, std::string& why) {
  std::string path = parent + "/navjit-XXXXXX";
  if (mkdtemp(path.data()) == nullptr) {  // 0700
    why = parent + ": " + std::strerror(errno);
    return {};
  }
  const auto trusted = cache::open_trusted_directory(path, false);
  if (trusted) return path;
  why = trusted.failure().message;
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return {};
}

}  // namespace

PrivateFolder::PrivateFolder() {
  std::error_code none;
  const std::string temporary = std::filesystem::temp_directory_path(none).string();
  std::string why;
  // There is none if TMPDIR names no directory.
  path_ = make_in(none ? "/tmp" : temporary, why);
  if (!path_.empty()) {
    temporary_.emplace(path_);
    return;
  }
  const std::string user = Cache::user_default().directory;
  if (!user.empty() && cache::open_trusted_directory(user, true)) {
    std::string ignored;
    path_ = make_in(user, ignored);
  }
  if (path_.empty()) throw Error("no place for temporary files (TMPDIR names one): " + why);
  temporary_.emplace(path_);
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace navjit

#include "files/temporary_path.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace navjit {
namespace {

// A signal handler can reach nothing but static storage, and take no lock. Who exchanges a pointer
// for null owns it: a path is freed by its TemporaryPath or, at the end of the process, leaked by
// the handler.
std::array<std::atomic<char*>, 64> paths;
static_assert(std::atomic<char*>::is_always_lock_free);

}  // namespace

TemporaryPath::TemporaryPath(std::string path) : path_(std::move(path)) {
  char* copy = strdup(path_.c_str());
  if (copy == nullptr) return;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    char* none = nullptr;
    if (paths[i].compare_exchange_strong(none, copy)) {
      slot_ = static_cast<int>(i);
      return;
    }
  }
  std::free(copy);
}

TemporaryPath::~TemporaryPath() {
  if (kept_) return;
  if (unlink(path_.c_str()) != 0) rmdir(path_.c_str());
  keep();
}

void TemporaryPath::keep() {
  kept_ = true;
  if (slot_ >= 0) std::free(paths[static_cast<std::size_t>(slot_)].exchange(nullptr));
  slot_ = -1;
}

void remove_temporary_paths() noexcept {
  std::array<const char*, paths.size()> left{};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const char* path = paths[i].exchange(nullptr);
    if (path != nullptr && unlink(path) != 0) left[i] = path;
  }
  // Folders, when there is nothing in them any more.
  for (const char* path : left) {
    if (path != nullptr) rmdir(path);
  }
}

}  // namespace navjit

// Files that must not outlive the process, also when a signal ends it.
#pragma once

#include <string>

namespace navjit {

/// A file, or a folder that is empty by then, that is removed when this is destroyed, and by
/// remove_temporary_paths(). It need not exist yet.
class TemporaryPath {
 public:
  explicit TemporaryPath(std::string path);
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;
  ~TemporaryPath();

  const std::string& path() const { return path_; }
  /// It is no longer temporary: it stays, whatever happens.
  void keep();

 private:
  std::string path_;
  int slot_ = -1;  ///< in the list of all; -1: it was full, and only the destructor removes it
  bool kept_ = false;
};

/// Removes all files of which there is a TemporaryPath. May be called in a signal handler, of a
/// process that is about to end.
void remove_temporary_paths() noexcept;

}  // namespace navjit

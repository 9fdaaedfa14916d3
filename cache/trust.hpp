// Whose files may become code of this process: those that only the user or root can have written.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "navjit/detail/expected.hpp"

namespace navjit::cache {

/// A file descriptor, closed on destruction; -1 for none.
class File {
 public:
  explicit File(int descriptor = -1) : descriptor_(descriptor) {}
  File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  File& operator=(File&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~File();

  int get() const { return descriptor_; }
  explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_;
};

/// Opens a directory that nobody but the user (effective uid) and root can write, replace or move:
/// symbolic links are resolved first, then the directory and every one above it has to be owned by
/// either and not be writable by group or others. As for ssh's files, with one exception: above the
/// directory itself one with the sticky bit (/tmp) passes, because there others cannot touch what
/// is not theirs. With `create`, missing directories are made, for the user alone. The failure says
/// which directory is at fault and what to do.
Expected<File> open_trusted_directory(const std::string& path, bool create);

/// Opens for reading the regular file `name` of a trusted directory. The file itself has to be
/// owned by the user or root and not be writable by others; no symbolic link. `missing` is set
/// where there is none.
Expected<File> open_trusted_file(const File& directory, const std::string& name, bool& missing);

/// The same for any path: links are resolved, and its directory is checked as above.
Expected<File> open_trusted_file(const std::string& path);

/// The whole file, at most `limit` bytes; longer ones fail. Nothing is mapped, so that a file that
/// shrinks meanwhile is an error and no signal.
Expected<std::vector<char>> read_all(const File& file, std::size_t limit);

}  // namespace navjit::cache

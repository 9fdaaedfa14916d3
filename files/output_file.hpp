// Files that are written as a whole, or not at all; and what is no file.
#pragma once

#include <sys/stat.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "files/temporary_path.hpp"

namespace navjit {

/// Where something is written. A regular file, or one that is not there yet, is written beside and
/// moved into place by finish(): until then what was there stays, and it stays for good if finish()
/// is not reached. An existing file keeps its permissions. Anything else (a device, a pipe, a
/// symbolic link, of which the target is written) is written as it is and never replaced; so is a
/// file in a directory that takes no new files. Not for several threads.
class OutputFile {
 public:
  /// Opens it, so that a place that cannot be written is known before there is anything to write.
  /// What is written through is not touched before the first write(). `mode`: permissions of the
  /// file (default: those it had, or what the umask leaves of 0666). Throws Error,
  /// naming the path; so do all others.
  explicit OutputFile(std::string path, std::optional<mode_t> mode = std::nullopt);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  const std::string& path() const { return path_; }
  void write(std::string_view bytes);
  /// Everything is written: flushes and moves it into place. To be called once.
  void finish();

 private:
  void open_beside(const struct ::stat* there, std::optional<mode_t> mode);
  void open_through(std::optional<mode_t> mode);
  void flush();
  void close();
  void move_into_place();
  [[noreturn]] void fail(int error) const;

  std::string path_;
  std::string buffer_;
  int file_ = -1;
  bool to_truncate_ = false;               ///< before the first byte
  std::optional<mode_t> mode_to_set_{};    ///< then, too
  bool standard_output_ = false;           ///< shares the file with what printf writes
  std::unique_ptr<TemporaryPath> beside_;  ///< null: written through
};

/// A whole file at once.
void write_output(const std::string& path, std::string_view bytes);

}  // namespace navjit

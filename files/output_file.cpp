#include "files/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "navjit/errors.hpp"

namespace navjit {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 16;

/// A name in the same directory that nothing else has. It is short: what is beside a file with the
/// longest of names has to have a name as well.
std::string name_beside(const std::string& path) {
  static std::atomic<unsigned> count{0};
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  return folder + ".navjit-" + std::to_string(getpid()) + "-" + std::to_string(count++);
}

/// 0, or why not.
int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

}  // namespace

OutputFile::OutputFile(std::string path, std::optional<mode_t> mode) : path_(std::move(path)) {
  struct stat there;
  const bool exists = lstat(path_.c_str(), &there) == 0;
  if (!exists && errno != ENOENT) fail(errno);
  if (exists && S_ISDIR(there.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(there.st_mode)) {
    open_through(mode);
    return;
  }
  if (exists && faccessat(AT_FDCWD, path_.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
  open_beside(exists ? &there : nullptr, mode);
  if (file_ >= 0) return;
  if (!exists) fail(errno);
  open_through(mode);
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
}

/// Leaves file_ at -1, with errno, where no file can be made.
void OutputFile::open_beside(const struct ::stat* there, std::optional<mode_t> mode) {
  if (path_.empty() || path_.back() == '/') {
    errno = ENOENT;
    return;
  }
  do {
    beside_ = std::make_unique<TemporaryPath>(name_beside(path_));
    file_ =
        ::open(beside_->path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0) beside_->keep();  // it is not ours
  } while (file_ < 0 && errno == EEXIST);
  if (file_ < 0) {
    const int error = errno;
    beside_.reset();
    errno = error;
    return;
  }
  // Root writes other users' files, too; they stay theirs. Nobody else may give files away.
  if (there != nullptr && fchown(file_, there->st_uid, there->st_gid) != 0) errno = 0;
  if (mode) {
    fchmod(file_, *mode);
  } else if (there != nullptr) {
    fchmod(file_, there->st_mode & 0777);
  }
}

void OutputFile::open_through(std::optional<mode_t> mode) {
  struct stat target = {}, out;
  // /dev/stdout, where that is a file: what is in it already stays, and what follows comes after.
  standard_output_ = stat(path_.c_str(), &target) == 0 && S_ISREG(target.st_mode) &&
                     fstat(STDOUT_FILENO, &out) == 0 && target.st_dev == out.st_dev &&
                     target.st_ino == out.st_ino;
  file_ = standard_output_ ? fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3)
                           : ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY, 0666);
  if (file_ < 0) fail(errno);
  to_truncate_ = !standard_output_;
  // Devices keep their permissions.
  if (to_truncate_ && S_ISREG(target.st_mode)) mode_to_set_ = mode;
}

void OutputFile::write(std::string_view bytes) {
  buffer_ += bytes;
  if (buffer_.size() >= buffer_bytes) flush();
}

void OutputFile::flush() {
  if (standard_output_) std::fflush(stdout);
  // Only files have a length; the first write tells what is wrong with others.
  if (to_truncate_ && ftruncate(file_, 0) != 0 && errno != EINVAL) fail(errno);
  if (mode_to_set_) fchmod(file_, *mode_to_set_);
  mode_to_set_.reset();
  to_truncate_ = false;
  const int error = write_all(file_, buffer_);
  if (error != 0) fail(error);
  buffer_.clear();
}

void OutputFile::finish() {
  flush();
  if (beside_) move_into_place();
  const int file = std::exchange(file_, -1);
  if (file >= 0 && ::close(file) != 0 && errno != EINTR) fail(errno);
}

void OutputFile::move_into_place() {
  // Some file systems tell only now that they are full.
  const int file = std::exchange(file_, -1);
  if (::close(file) != 0 && errno != EINTR) fail(errno);
  if (std::rename(beside_->path().c_str(), path_.c_str()) != 0) fail(errno);
  beside_->keep();
  beside_.reset();
}

void OutputFile::fail(int error) const {
  throw Error(path_ + ": cannot be written: " + std::strerror(error));
}

void write_output(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.finish();
}

}  // namespace navjit

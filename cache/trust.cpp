#include "cache/trust.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>

namespace navjit::cache {
namespace {

Failure system_failure(const std::string& what) { return {what + ": " + std::strerror(errno)}; }

std::string octal(mode_t mode) {
  char text[16];
  std::snprintf(text, sizeof text, "%04o", static_cast<unsigned>(mode & 07777));
  return text;
}

/// Why not to trust something with this status; nothing if it may be trusted.
std::optional<Failure> distrust(const std::string& path, const struct stat& status, bool above) {
  if (status.st_uid != geteuid() && status.st_uid != 0) {
    return Failure{path + " belongs to user " + std::to_string(status.st_uid) +
                   ", neither to you nor to root: refused"};
  }
  const bool others_write = (status.st_mode & (S_IWGRP | S_IWOTH)) != 0;
  if (others_write && !(above && (status.st_mode & S_ISVTX) != 0)) {
    // A directory for everybody (/tmp) is to stay one.
    const bool for_all = (status.st_mode & S_ISVTX) != 0 && S_ISDIR(status.st_mode);
    return Failure{path + " can be written by others (mode " + octal(status.st_mode) +
                   "): refused; " +
                   (for_all ? "use a directory of your own in it (mkdir -m 700)"
                            : "chmod go-w makes it usable")};
  }
  return std::nullopt;
}

struct FreeText {
  void operator()(char* text) const { std::free(text); }
};

Expected<std::string> resolved(const std::string& path) {
  const std::unique_ptr<char, FreeText> text(realpath(path.c_str(), nullptr));
  if (!text) return system_failure(path);
  return std::string(text.get());
}

/// Checks a resolved directory and all above it; gives the status of the directory itself. With
/// `above` the directory itself is also only above the one that is meant.
std::optional<Failure> distrust_way(const std::string& path, bool above, struct stat& status) {
  for (std::size_t at = 0; at <= path.size(); ++at) {
    if (at != 0 && at != path.size() && path[at] != '/') continue;
    if (at == path.size() && at == 1) break;  // the root was the first
    const std::string part = at == 0 ? "/" : path.substr(0, at);
    if (lstat(part.c_str(), &status) != 0) return system_failure(part);
    if (!S_ISDIR(status.st_mode)) return Failure{part + " is not a directory"};
    const bool last = part.size() == path.size();
    if (std::optional<Failure> failure = distrust(part, status, above || !last)) return failure;
  }
  return std::nullopt;
}

/// Makes the missing directories of a path, for the user alone, where the first of them may be
/// made: in a directory that is trusted.
std::optional<Failure> make_directories(const std::string& path) {
  std::string there = path.starts_with('/') ? "/" : ".";
  for (std::size_t at = 1; at <= path.size(); ++at) {
    if (at < path.size() && path[at] != '/') continue;
    const std::string part = path.substr(0, at);
    struct stat status;
    if (stat(part.c_str(), &status) == 0) {
      there = part;
      continue;
    }
    const Expected<std::string> real = resolved(there);
    if (!real) return real.failure();
    if (std::optional<Failure> failure = distrust_way(*real, true, status)) return failure;
    if (mkdir(part.c_str(), 0700) != 0 && errno != EEXIST) {
      return system_failure("cannot make the directory " + part);
    }
    there = part;
  }
  return std::nullopt;
}

}  // namespace

File::~File() {
  if (descriptor_ >= 0) close(descriptor_);
}

Expected<File> open_trusted_directory(const std::string& path, bool create) {
  if (path.empty() || path.find('\0') != std::string::npos) {
    return Failure{"not the name of a directory"};
  }
  if (create) {
    if (std::optional<Failure> failure = make_directories(path)) return *failure;
  }
  const Expected<std::string> real = resolved(path);
  if (!real) return real.failure();
  struct stat status;
  if (std::optional<Failure> failure = distrust_way(*real, false, status)) return *failure;
  File directory(open(real->c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  if (!directory) return system_failure(*real);
  struct stat opened;
  if (fstat(directory.get(), &opened) != 0) return system_failure(*real);
  if (opened.st_dev != status.st_dev || opened.st_ino != status.st_ino) {
    return Failure{*real + " was replaced while it was looked at: refused"};
  }
  return directory;
}

Expected<File> open_trusted_file(const File& directory, const std::string& name, bool& missing) {
  missing = false;
  // Not to wait for a writer if somebody made it a pipe.
  File file(openat(directory.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file) {
    missing = errno == ENOENT;
    return system_failure(name);
  }
  struct stat status;
  if (fstat(file.get(), &status) != 0) return system_failure(name);
  if (!S_ISREG(status.st_mode)) return Failure{name + " is not a regular file"};
  if (std::optional<Failure> failure = distrust(name, status, false)) return *failure;
  return file;
}

Expected<File> open_trusted_file(const std::string& path) {
  const Expected<std::string> real = resolved(path);
  if (!real) return real.failure();
  const std::size_t slash = real->rfind('/');
  const Expected<File> directory =
      open_trusted_directory(slash == 0 ? "/" : real->substr(0, slash), false);
  if (!directory) return Failure{path + ": " + directory.failure().message};
  bool missing = false;
  Expected<File> file = open_trusted_file(*directory, real->substr(slash + 1), missing);
  if (!file) return Failure{path + ": " + file.failure().message};
  return file;
}

Expected<std::vector<char>> read_all(const File& file, std::size_t limit) {
  struct stat status;
  if (fstat(file.get(), &status) != 0) return system_failure("status");
  if (status.st_size < 0 || static_cast<std::uintmax_t>(status.st_size) > limit) {
    return Failure{"longer than " + std::to_string(limit) + " bytes"};
  }
  std::vector<char> bytes(static_cast<std::size_t>(status.st_size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n =
        pread(file.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return system_failure("read");
    if (n == 0) return Failure{"became shorter while it was read"};
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

}  // namespace navjit::cache

#include "cache/object_cache.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <memory>

#include "cache/detail/cache_format.hpp"

namespace navjit::cache {
namespace {

constexpr std::string_view suffix = ".navjit";
constexpr std::string_view unfinished = "unfinished-";
/// Uses closer together are not told apart, to spare shared file systems the writing.
constexpr std::int64_t use_resolution_s = 60;
/// The unit in which entries take space on a disk.
constexpr std::uint64_t block_bytes = 4096;

Failure system_failure(const std::string& what) { return {what + ": " + std::strerror(errno)}; }

std::string name_of(const Digest& key) { return hex(key) + std::string(suffix); }

bool is_entry_name(std::string_view name) {
  return name.size() == 64 + suffix.size() && name.substr(64) == suffix &&
         name.substr(0, 64).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_unfinished_name(std::string_view name) {
  return name.size() == unfinished.size() + 16 && name.substr(0, unfinished.size()) == unfinished;
}

struct CloseDirectory {
  void operator()(DIR* directory) const { closedir(directory); }
};

/// Names of entries and of unfinished files; others are none of our business.
Expected<std::vector<std::string>> names_in(const File& directory) {
  // A descriptor of its own: positions in a directory are shared by copies.
  const int copy = openat(directory.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (copy < 0) return system_failure("cannot list the cache directory");
  const std::unique_ptr<DIR, CloseDirectory> listing(fdopendir(copy));
  if (!listing) {
    Failure failure = system_failure("cannot list the cache directory");
    close(copy);
    return failure;
  }
  std::vector<std::string> names;
  while (const dirent* entry = readdir(listing.get())) {
    if (is_entry_name(entry->d_name) || is_unfinished_name(entry->d_name)) {
      names.emplace_back(entry->d_name);
    }
  }
  return names;
}

/// A writer keeps its unfinished file locked, and the lock goes with the process: what can be
/// locked was left behind. Where a lock cannot be had at all, age decides. At worst the file of a
/// living writer is removed, who then fails to store.
void remove_if_abandoned(const File& directory, const std::string& name) {
  const File file(
      openat(directory.get(), name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file) return;
  if (flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return;
    struct stat status;
    constexpr std::int64_t long_ago_s = 3600;
    if (fstat(file.get(), &status) != 0 || std::time(nullptr) - status.st_mtime < long_ago_s) {
      return;
    }
  }
  unlinkat(directory.get(), name.c_str(), 0);
}

/// Entries can be read by whoever can read their directory.
mode_t mode_of_entries(const File& directory) {
  struct stat status;
  if (fstat(directory.get(), &status) != 0) return 0600;
  return 0600 | (status.st_mode & (S_IRGRP | S_IROTH));
}

/// A file of a new name, locked: see remove_if_abandoned.
Expected<File> make_unfinished(const File& directory, std::string& name) {
  for (int attempt = 0;; ++attempt) {
    Digest random{};
    if (getrandom(random.data(), 8, 0) != 8) return system_failure("no random numbers");
    name = std::string(unfinished) + hex(random).substr(0, 16);
    File file(openat(directory.get(), name.c_str(),
                     O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (!file) return system_failure("cannot write into the cache directory");
    flock(file.get(), LOCK_EX);
    // Before it was locked it may have been taken for abandoned.
    struct stat status;
    if (attempt == 9 || fstat(file.get(), &status) != 0 || status.st_nlink > 0) return file;
  }
}

bool write_all(const File& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file.get(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// Writing beyond the process's limit would not fail but end it by a signal.
bool exceeds_file_limit(std::uint64_t bytes) {
  rlimit limit;
  return getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
         bytes > limit.rlim_cur;
}

std::string_view view(const std::vector<char>& bytes) { return {bytes.data(), bytes.size()}; }

/// Functions of the cache promise not to throw: lack of memory and such become failures.
template <class Work>
auto without_exceptions(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::exception& error) {
    return Failure{error.what()};
  }
}

CacheHit load_entry(const File& directory, const Digest& key, std::size_t max_bytes) {
  bool missing = false;
  const std::string name = name_of(key);
  const Expected<File> file = open_trusted_file(directory, name, missing);
  if (!file) return {std::nullopt, missing ? "" : file.failure().message};
  Expected<std::vector<char>> bytes = read_all(*file, max_bytes);
  if (!bytes) return {std::nullopt, name + ": " + bytes.failure().message};
  const detail::ParsedHeader header = detail::parse_header(view(*bytes), bytes->size());
  std::string problem = detail::check_entry(view(*bytes), header);
  if (problem.empty() && header.key != key) problem = "it is the entry of another key";
  if (!problem.empty()) return {std::nullopt, name + ": " + problem};
  bytes->erase(bytes->begin(), bytes->begin() + static_cast<std::ptrdiff_t>(detail::header_bytes +
                                                                            header.label_bytes));
  struct stat status;
  // Times in the future come from a clock that was wrong.
  if (fstat(file->get(), &status) == 0 &&
      std::abs(std::time(nullptr) - status.st_mtime) > use_resolution_s) {
    futimens(file->get(), nullptr);  // may fail where the cache can only be read: no matter
  }
  return {std::move(*bytes), ""};
}

CacheEntry describe(const File& directory, const std::string& name, std::size_t max_bytes,
                    bool verify) {
  CacheEntry entry;
  entry.file = name;
  bool missing = false;
  const Expected<File> file = open_trusted_file(directory, name, missing);
  if (!file) {
    entry.problem = file.failure().message;
    return entry;
  }
  struct stat status;
  if (fstat(file->get(), &status) != 0) return entry;
  entry.bytes = static_cast<std::uint64_t>(status.st_size);
  entry.last_used = status.st_mtime;
  std::vector<char> bytes(detail::header_bytes + detail::max_label_bytes);
  if (verify) {
    Expected<std::vector<char>> all = read_all(*file, max_bytes);
    if (!all) {
      entry.problem = all.failure().message;
      return entry;
    }
    bytes = *std::move(all);
  } else {
    const ssize_t n = pread(file->get(), bytes.data(), bytes.size(), 0);
    bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  }
  const detail::ParsedHeader header = detail::parse_header(view(bytes), entry.bytes);
  entry.problem = verify ? detail::check_entry(view(bytes), header) : header.problem;
  if (entry.problem.empty() && name_of(header.key) != name) {
    entry.problem = "it is the entry of another key";
  }
  if (header.problem.empty() && bytes.size() >= detail::header_bytes + header.label_bytes) {
    entry.payload = header.content_bytes;
    entry.label = detail::printable(view(bytes).substr(detail::header_bytes, header.label_bytes));
  }
  return entry;
}

}  // namespace

Expected<ObjectCache> ObjectCache::open(const std::string& directory, const CacheLimits& limits,
                                        bool create) {
  return without_exceptions([&]() -> Expected<ObjectCache> {
    Expected<File> opened = open_trusted_directory(directory, create);
    if (!opened) return opened.failure();
    return ObjectCache(*std::move(opened), limits);
  });
}

CacheHit ObjectCache::load(const Digest& key) {
  try {
    return load_entry(directory_, key, limits_.max_entry_bytes);
  } catch (const std::exception& error) {
    return {std::nullopt, error.what()};
  }
}

std::optional<Failure> ObjectCache::store(const Digest& key, std::string_view label,
                                          std::string_view content) {
  return without_exceptions([&]() -> std::optional<Failure> {
    std::optional<Failure> failure = write(key, label, content);
    // Also after a failure: a full disk is reason to look for what can go.
    tidy(limits_.max_bytes);
    return failure;
  });
}

std::optional<Failure> ObjectCache::write(const Digest& key, std::string_view label,
                                          std::string_view content) {
  const std::string header = detail::make_header(key, detail::printable(label), content);
  const std::uint64_t bytes = header.size() + content.size();
  if (bytes > limits_.max_entry_bytes || bytes > limits_.max_bytes) {
    return Failure{"an entry of " + std::to_string(bytes) + " bytes is too large"};
  }
  if (exceeds_file_limit(bytes)) {
    return Failure{"an entry of " + std::to_string(bytes) +
                   " bytes exceeds the limit of the size of files (ulimit -f)"};
  }
  std::string temporary;
  const Expected<File> unfinished_file = make_unfinished(directory_, temporary);
  if (!unfinished_file) return unfinished_file.failure();
  const File& file = *unfinished_file;
  if (!write_all(file, header) || !write_all(file, content)) {
    Failure failure = system_failure("cannot write an entry of the cache");
    unlinkat(directory_.get(), temporary.c_str(), 0);
    return failure;
  }
  fchmod(file.get(), mode_of_entries(directory_));  // may fail: then it is the user's alone
  const std::string name = name_of(key);
  if (renameat(directory_.get(), temporary.c_str(), directory_.get(), name.c_str()) != 0) {
    Failure failure = system_failure("cannot move an entry of the cache into place");
    unlinkat(directory_.get(), temporary.c_str(), 0);
    return failure;
  }
  return std::nullopt;
}

void ObjectCache::tidy(std::uint64_t max_bytes) {
  const Expected<std::vector<std::string>> names = names_in(directory_);
  if (!names) return;
  struct Candidate {
    std::string name;
    std::uint64_t bytes;
    timespec used;
  };
  std::vector<Candidate> entries;
  std::uint64_t total = 0;
  for (const std::string& name : *names) {
    if (is_unfinished_name(name)) {
      remove_if_abandoned(directory_, name);
      continue;
    }
    struct stat status;
    if (fstatat(directory_.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    const auto size = static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
    const std::uint64_t bytes = (size + block_bytes - 1) / block_bytes * block_bytes;
    entries.push_back({name, bytes, status.st_mtim});
    total += bytes;
  }
  if (total <= max_bytes) return;
  std::sort(entries.begin(), entries.end(), [](const Candidate& a, const Candidate& b) {
    return std::pair(a.used.tv_sec, a.used.tv_nsec) < std::pair(b.used.tv_sec, b.used.tv_nsec);
  });
  for (const Candidate& entry : entries) {
    if (total <= max_bytes) break;
    // If another process was faster its space is free all the same.
    if (unlinkat(directory_.get(), entry.name.c_str(), 0) == 0 || errno == ENOENT) {
      total -= entry.bytes;
    }
  }
}

void ObjectCache::discard(const Digest& key) {
  unlinkat(directory_.get(), name_of(key).c_str(), 0);
}

Expected<std::vector<CacheEntry>> ObjectCache::list(bool verify) const {
  return without_exceptions([&]() -> Expected<std::vector<CacheEntry>> {
    const Expected<std::vector<std::string>> names = names_in(directory_);
    if (!names) return names.failure();
    std::vector<CacheEntry> entries;
    for (const std::string& name : *names) {
      if (is_entry_name(name)) {
        entries.push_back(describe(directory_, name, limits_.max_entry_bytes, verify));
      }
    }
    std::sort(entries.begin(), entries.end(), [](const CacheEntry& a, const CacheEntry& b) {
      return std::pair(-a.last_used, a.file) < std::pair(-b.last_used, b.file);
    });
    return entries;
  });
}

Expected<std::size_t> ObjectCache::clear() {
  return without_exceptions([&]() -> Expected<std::size_t> {
    const Expected<std::vector<std::string>> names = names_in(directory_);
    if (!names) return names.failure();
    std::size_t removed = 0;
    std::optional<Failure> failure;
    for (const std::string& name : *names) {
      if (is_unfinished_name(name)) {
        remove_if_abandoned(directory_, name);
      } else if (unlinkat(directory_.get(), name.c_str(), 0) == 0) {
        ++removed;
      } else if (errno != ENOENT && !failure) {
        failure = system_failure("cannot remove " + name);  // the others go all the same
      }
    }
    if (failure) return *failure;
    return removed;
  });
}

}  // namespace navjit::cache

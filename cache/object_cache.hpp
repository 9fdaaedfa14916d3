// A directory of compiled objects, shared by any number of processes. docs/cache.md has the format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cache/sha256.hpp"
#include "cache/trust.hpp"
#include "navjit/detail/expected.hpp"

namespace navjit::cache {

struct CacheLimits {
  std::uint64_t max_bytes = std::uint64_t{256} << 20;  ///< of all entries; a store evicts beyond
  std::size_t max_entry_bytes = std::size_t{64} << 20;
};

/// What `ObjectCache::list` tells of an entry.
struct CacheEntry {
  std::string file;            ///< its name in the directory
  std::uint64_t bytes = 0;     ///< of the file
  std::int64_t last_used = 0;  ///< s since 1970; exact to about a minute
  std::string label;           ///< what it was stored as; printable ASCII
  std::uint64_t payload = 0;   ///< bytes of content
  std::string problem;         ///< why it would be rejected; empty if it would not
};

/// What `ObjectCache::load` found.
struct CacheHit {
  std::optional<std::vector<char>> content;  ///< nothing: not there, or rejected
  std::string rejected;                      ///< why what is there is not used; empty otherwise
};

/// Entries are immutable files named by their key, written beside and moved into place, so that a
/// reader finds a whole entry or none, whatever happens to the writer. Each has a SHA-256 checksum
/// of its key and content; what does not match is rejected, never used. Nothing is locked: the
/// worst that processes can do to each other is work done twice.
///
/// Checksums guard against damage; against malice guards only that nobody else can write the
/// directory and its files (cache/trust.hpp), which is checked on opening and for every file.
///
/// Functions return failures and do not throw. For one thread at a time; distinct caches of one
/// directory may be used concurrently, in one process or many.
class ObjectCache {
 public:
  /// Opens a directory, and makes it (for the user alone) if `create` is set. Fails if it cannot be
  /// opened or trusted. A directory that can only be read is a cache that cannot store.
  static Expected<ObjectCache> open(const std::string& directory, const CacheLimits& limits = {},
                                    bool create = true);

  /// The content stored under a key; marks it as used.
  CacheHit load(const Digest& key);

  /// Stores content under a key, over what is there; then evicts what was used least recently until
  /// the limit is met, and removes what killed writers left. `label` is for people; characters that
  /// are not printable ASCII become '?', and it is cut at 200. Returns why it was not stored.
  std::optional<Failure> store(const Digest& key, std::string_view label, std::string_view content);

  /// Removes the entry of a key, if it is there.
  void discard(const Digest& key);

  /// All entries, most recently used first. With `verify` each is read and checked whole, else only
  /// what its first bytes tell.
  Expected<std::vector<CacheEntry>> list(bool verify) const;

  /// Removes all entries and what killed writers left; other files stay. Returns how many.
  Expected<std::size_t> clear();

 private:
  ObjectCache(File directory, const CacheLimits& limits)
      : directory_(std::move(directory)), limits_(limits) {}

  std::optional<Failure> write(const Digest& key, std::string_view label, std::string_view content);
  void tidy(std::uint64_t max_bytes);

  File directory_;
  CacheLimits limits_;
};

}  // namespace navjit::cache

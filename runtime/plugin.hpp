// Compiled navigators from a shared library that `navjit specialise` made; see docs/cache.md.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cache/trust.hpp"
#include "codegen/data/arena.hpp"
#include "geometry/navigation/geometry.hpp"
#include "navjit/detail/expected.hpp"

namespace navjit {

/// A loaded library. Its code is in memory as long as this object exists.
class Plugin {
 public:
  struct Entry {
    VolumeId volume;
    kernels::DispatchEntry dispatch;
  };

  /// Fails, saying what to do, if others than the user or root may write the file
  /// (cache/trust.hpp), if it is damaged (its seal), or if it was made for another detector, by
  /// another generator, for another binary interface, or for a processor that can do more than this
  /// one. The code has not been verified against the generic navigator yet.
  static Expected<std::shared_ptr<const Plugin>> load(const std::string& path,
                                                      const Geometry& geometry);
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;
  ~Plugin();

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  static Expected<std::shared_ptr<const Plugin>> load_checked(const std::string& path,
                                                              const Geometry& geometry);
  Plugin(cache::File file, void* library) : file_(std::move(file)), library_(library) {}

  cache::File file_;  ///< stays open: the system's loader knows the library by this descriptor
  void* library_;
  std::shared_ptr<const codegen::Arena> tables_;
  std::vector<Entry> entries_;
};

/// The seal that follows the library in a plugin's file: the library's length and SHA-256. By
/// these, damage is found before the system's loader sees the library. Loaders ignore the seal.
std::string plugin_seal(std::string_view library);

/// Why the file is not a plugin as it was written; empty if it is one.
std::string check_plugin_seal(std::string_view file);

/// Whether this processor (and the system) supports a feature of runtime/plugin_features.hpp.
bool processor_has(std::string_view feature);

}  // namespace navjit

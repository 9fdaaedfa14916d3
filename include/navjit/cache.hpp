// Where compiled navigators are kept between runs (docs/cache.md).
#pragma once

#include <cstdint>
#include <string>

#include "navjit/detail/api.hpp"

namespace NAVJIT_API navjit {

/// A directory for compiled code. By default there is none, since a library should not write to
/// disks unasked. The directory is made and checked when a Runtime first needs it; if it cannot be
/// used, everything is compiled, with one line in the log.
struct Cache {
  std::string directory{};                             ///< empty: no cache
  std::uint64_t max_bytes = std::uint64_t{256} << 20;  ///< above: the longest unused are removed

  /// The directory of the user: $XDG_CACHE_HOME/navjit, or $HOME/.cache/navjit. No cache where
  /// neither variable is set to an absolute path.
  static Cache user_default();
  /// A cache in a directory that the program chooses.
  static Cache in(std::string directory) { return {std::move(directory)}; }

  explicit operator bool() const { return !directory.empty(); }
};

}  // namespace navjit

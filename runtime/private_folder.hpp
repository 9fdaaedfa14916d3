// A folder for temporary files that plugins may be loaded from: nobody else can write it, or move
// it.
#pragma once

#include <optional>
#include <string>

#include "files/temporary_path.hpp"

namespace navjit {

/// Removed with all that is in it on destruction. It is made in the folder for temporary files, or
/// in the user's cache folder if that one is not trusted.
class PrivateFolder {
 public:
  /// Throws Error, saying why, if neither place can be used.
  PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder();

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
  std::optional<TemporaryPath> temporary_;  ///< also where a signal ends the process
};

}  // namespace navjit

// A folder for temporary files from which plugins may be loaded: nobody else can write to it, or
// move it.
#pragma once

#include <optional>
#include <string>

#include "files/temporary_path.hpp"

namespace navjit {

/// The destructor removes the folder with all that is in it. It is made in the folder for temporary
/// files, or in the user's cache folder if the former is not trusted.
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
  std::optional<TemporaryPath> temporary_;  ///< removes it also if a signal ends the process
};

}  // namespace navjit

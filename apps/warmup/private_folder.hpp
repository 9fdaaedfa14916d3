// A folder that plugins may be loaded from: nobody else can write it, or move it.
#pragma once

#include <string>

namespace navjit::warmup {

/// Gone with all that is in it on destruction. In the folder for temporary files, or in the user's
/// cache where that one is not trusted.
class PrivateFolder {
 public:
  /// Throws std::runtime_error, saying why, if neither place can be used.
  PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  ~PrivateFolder();

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace navjit::warmup

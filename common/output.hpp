// A file that may be asked for, and is written at the end.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "files/output_file.hpp"

namespace navjit::common {

/// A file that may be asked for. It is opened at the beginning, so that a place that cannot be
/// written costs no run.
class Output {
 public:
  /// An empty path: none. Throws what OutputFile throws.
  explicit Output(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }
  explicit operator bool() const { return file_.has_value(); }

  /// The whole of it. Does nothing if none is asked for.
  void write(const std::function<std::string()>& make) {
    if (!file_) return;
    file_->write(make());
    file_->finish();
  }

 private:
  std::optional<OutputFile> file_;
};

}  // namespace navjit::common

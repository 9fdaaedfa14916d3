// The file to which a benchmark writes its figures.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "files/output_file.hpp"

namespace navjit::bench {

/// A JSON file that may be asked for. It is opened at the beginning, so that a place that cannot be
/// written costs no run, and is written whole or not at all.
class JsonFile {
 public:
  /// An empty path: none. Throws Error, naming the path, if it cannot be written; so does write().
  explicit JsonFile(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }

  /// All figures; to be called once. What is no number is written as null. Does nothing if no file
  /// is asked for.
  void write(const nlohmann::ordered_json& figures) {
    if (!file_) return;
    file_->write(figures.dump(2) + '\n');
    file_->finish();
  }

 private:
  std::optional<OutputFile> file_;
};

}  // namespace navjit::bench

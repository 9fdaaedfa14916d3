// The file to which a benchmark writes its figures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "common/output.hpp"

namespace navjit::bench {

/// A JSON file that may be asked for.
class JsonFile {
 public:
  /// As common::Output.
  explicit JsonFile(const std::string& path) : file_(path) {}

  /// All figures; to be called once. What is no number is written as null. Does nothing if no file
  /// is asked for.
  void write(const nlohmann::ordered_json& figures) {
    file_.write([&] { return figures.dump(2) + '\n'; });
  }

 private:
  common::Output file_;
};

}  // namespace navjit::bench

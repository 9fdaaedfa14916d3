// The detectors that a campaign is given, as files and folders.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace navjit {

/// The given files; a folder stands for the files in it, in order of their names.
inline std::vector<std::string> gdml_files(const std::vector<std::string>& given) {
  std::vector<std::string> all;
  for (const std::string& file : given) {
    if (!std::filesystem::is_directory(file)) {
      all.push_back(file);
      continue;
    }
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(file)) {
      if (entry.path().extension() == ".gdml") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

}  // namespace navjit

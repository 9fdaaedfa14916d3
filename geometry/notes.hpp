// What a reader has to say about a file that it nevertheless reads.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "navjit/gdml.hpp"

namespace navjit {

/// Collects notes. Of each kind the first few are kept and the others counted; kinds beyond a
/// number that only a hostile file reaches are counted, too.
struct Notes {
  static constexpr std::size_t lines_of_a_kind = 3;
  static constexpr std::size_t most_kinds = 100;

  /// Something odd in the file. `what` tells the kind, and `make` returns the line, which is made
  /// only if it is kept.
  template <class Make>
  void add(const std::string& what, Make&& make) {
    if (wanted(what)) lines_.push_back(make());
  }
  /// Something common that means nothing for the geometry, or is read as in Geant4: only counted.
  void count(const std::string& what);
  /// Adds what was collected to a report.
  void tell(GdmlReport& report) const;

 private:
  /// Counts a note of a kind; true if its line is to be kept.
  bool wanted(const std::string& what);
  static std::size_t* counter(std::map<std::string, std::size_t>& kinds, const std::string& what);

  std::vector<std::string> lines_;
  std::map<std::string, std::size_t> odd_, common_;
  std::size_t others_ = 0;
};

}  // namespace navjit

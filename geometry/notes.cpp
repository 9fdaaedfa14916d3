#include "geometry/notes.hpp"

namespace navjit {

std::size_t* Notes::counter(std::map<std::string, std::size_t>& kinds, const std::string& what) {
  const auto found = kinds.find(what);
  if (found != kinds.end()) return &found->second;
  return kinds.size() < most_kinds ? &kinds[what] : nullptr;
}

bool Notes::wanted(const std::string& what) {
  std::size_t* const count = counter(odd_, what);
  ++(count == nullptr ? others_ : *count);
  return count != nullptr && *count <= lines_of_a_kind;
}

void Notes::count(const std::string& what) {
  std::size_t* const count = counter(common_, what);
  ++(count == nullptr ? others_ : *count);
}

void Notes::tell(GdmlReport& report) const {
  report.notes.insert(report.notes.end(), lines_.begin(), lines_.end());
  for (const auto& [what, count] : odd_) {
    if (count <= lines_of_a_kind) continue;
    report.notes.push_back("and " + std::to_string(count - lines_of_a_kind) + " more: " + what);
  }
  for (const auto& [what, count] : common_) {
    report.skipped.push_back(what + " (" + std::to_string(count) + ')');
  }
  if (others_ > 0) report.skipped.push_back("other notes (" + std::to_string(others_) + ')');
}

}  // namespace navjit

#include "runtime/overrides.hpp"

namespace navjit {
namespace {

constexpr std::string_view off = "off";

bool may_be_forced(Candidates search) { return facts_of(search).forced_from_outside; }

/// "NAME=off, all, ... or layers is needed".
std::string what_is_needed() {
  std::string text = "NAME=" + std::string(off), last;
  for (const SearchFacts& facts : all_searches) {
    if (!facts.forced_from_outside) continue;
    if (!last.empty()) text += ", " + last;
    last = facts.name;
  }
  return text + " or " + last + " is needed";
}

}  // namespace

Overrides parse_overrides(const World& world, std::string_view text) {
  Overrides result;
  const auto complain = [&](std::string_view entry, const std::string& what) {
    result.complaints += "'" + std::string(entry) + "': " + what + "\n";
  };
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view entry = text.substr(0, comma);
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
    const std::size_t equals = entry.rfind('=');
    const std::string_view variant =
        equals == std::string_view::npos ? std::string_view{} : entry.substr(equals + 1);
    const std::optional<Candidates> search = search_named(variant);
    if (variant != off && !(search && may_be_forced(*search))) {
      complain(entry, what_is_needed());
      continue;
    }
    const std::string_view name = entry.substr(0, equals);
    bool found = false;
    for (VolumeId v = 0; v < world.volumes.size(); ++v) {
      if (name != "*" && world.volumes[v].name != name) continue;
      result.searches[v] = search;
      found = true;
    }
    if (!found) complain(entry, "no logical volume has this name");
  }
  return result;
}

}  // namespace navjit

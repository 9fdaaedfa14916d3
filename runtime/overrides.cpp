#include "runtime/overrides.hpp"

#include <algorithm>
#include <iterator>

namespace navjit {
namespace {

/// The variants by name, each with the search that it forces.
struct Name {
  std::string_view text;
  Variant variant;
  std::optional<Candidates> candidates;
};
constexpr Name names[] = {{"off", Variant::off, {}},
                          {"all", Variant::all, Candidates::all},
                          {"lanes", Variant::lanes, Candidates::lanes},
                          {"nest", Variant::nest, Candidates::nest},
                          {"rings", Variant::rings, Candidates::rings},
                          {"wires", Variant::wires, Candidates::wires},
                          {"grid", Variant::grid, Candidates::grid},
                          {"boxes", Variant::boxes, Candidates::boxes},
                          {"scan", Variant::scan, Candidates::scan},
                          {"groups", Variant::groups, Candidates::groups},
                          {"tree", Variant::tree, Candidates::tree},
                          {"layers", Variant::layers, Candidates::layers}};

std::optional<Variant> parse_variant(std::string_view text) {
  for (const Name& name : names) {
    if (name.text == text) return name.variant;
  }
  return {};
}

/// "NAME=off, all, ... or tree is needed".
std::string what_is_needed() {
  std::string text = "NAME=";
  for (const Name& name : names) {
    if (&name != &names[0]) text += &name == std::end(names) - 1 ? " or " : ", ";
    text += name.text;
  }
  return text + " is needed";
}

}  // namespace

std::optional<Candidates> candidates_of(Variant variant) {
  return std::find_if(std::begin(names), std::end(names),
                      [&](const Name& name) { return name.variant == variant; })
      ->candidates;
}

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
    std::optional<Variant> variant;
    if (equals != std::string_view::npos) variant = parse_variant(entry.substr(equals + 1));
    if (!variant) {
      complain(entry, what_is_needed());
      continue;
    }
    const std::string_view name = entry.substr(0, equals);
    bool found = false;
    for (VolumeId v = 0; v < world.volumes.size(); ++v) {
      if (name != "*" && world.volumes[v].name != name) continue;
      result.variants[v] = *variant;
      found = true;
    }
    if (!found) complain(entry, "no logical volume has this name");
  }
  return result;
}

}  // namespace navjit

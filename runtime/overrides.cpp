#include "runtime/overrides.hpp"

namespace navjit {
namespace {

bool parse_variant(std::string_view text, Variant& variant) {
  if (text == "off") {
    variant = Variant::off;
  } else if (text == "all") {
    variant = Variant::all;
  } else if (text == "lanes") {
    variant = Variant::lanes;
  } else if (text == "nest") {
    variant = Variant::nest;
  } else if (text == "rings") {
    variant = Variant::rings;
  } else if (text == "wires") {
    variant = Variant::wires;
  } else if (text == "grid") {
    variant = Variant::grid;
  } else if (text == "boxes") {
    variant = Variant::boxes;
  } else if (text == "tree") {
    variant = Variant::tree;
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::map<VolumeId, Variant> parse_overrides(const World& world, std::string_view text,
                                            std::string* complaints) {
  std::map<VolumeId, Variant> result;
  const auto complain = [&](std::string_view entry, const char* what) {
    if (complaints != nullptr) *complaints += "'" + std::string(entry) + "': " + what + "\n";
  };
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view entry = text.substr(0, comma);
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
    const std::size_t equals = entry.rfind('=');
    Variant variant;
    if (equals == std::string_view::npos || !parse_variant(entry.substr(equals + 1), variant)) {
      complain(entry, "NAME=off, all, lanes, nest, rings, wires, grid, boxes or tree is needed");
      continue;
    }
    const std::string_view name = entry.substr(0, equals);
    bool found = false;
    for (VolumeId v = 0; v < world.volumes.size(); ++v) {
      if (name != "*" && world.volumes[v].name != name) continue;
      result[v] = variant;
      found = true;
    }
    if (!found) complain(entry, "no logical volume has this name");
  }
  return result;
}

}  // namespace navjit

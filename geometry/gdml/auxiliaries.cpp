// <auxiliary>: tags, which are kept for the program as they stand.
#include "geometry/gdml/context.hpp"

namespace navjit::gdml {
namespace {

// Recursion goes as deep as the elements are nested, which is bounded.
std::vector<Auxiliary> read_children(const XmlElement& element) {
  std::vector<Auxiliary> all;
  for (const XmlElement& child : element.children()) {
    if (child.tag != "auxiliary") continue;
    all.push_back({std::string(child.find("auxtype").value_or("")),
                   std::string(child.find("auxvalue").value_or("")),
                   std::string(child.find("auxunit").value_or("")), read_children(child)});
  }
  return all;
}

}  // namespace

Auxiliaries read_auxiliaries(FileContext& file, const XmlElement& element) {
  const auto read = [&]() -> Auxiliaries {
    std::vector<Auxiliary> all = read_children(element);
    if (all.empty()) return nullptr;
    return std::make_shared<const std::vector<Auxiliary>>(std::move(all));
  };
  if (file.loops == 0) return read();
  const auto [position, added] = file.session.auxiliaries.try_emplace(&element);
  if (added) position->second = read();
  return position->second;
}

}  // namespace navjit::gdml

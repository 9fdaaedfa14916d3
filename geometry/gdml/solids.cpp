// <solids>: chooses the reader by the tag.
#include "geometry/gdml/solids.hpp"

#include <algorithm>

#include "geometry/solids/kinds.hpp"

namespace navjit::gdml {
namespace {

SolidReader find_reader(std::string_view tag) {
  for (const auto readers : {primitive_readers(), contour_readers(), boolean_readers()}) {
    const auto found = std::find_if(readers.begin(), readers.end(),
                                    [&](const SolidKindReader& r) { return r.tag == tag; });
    if (found != readers.end()) return found->read;
  }
  for (const KindFacts& kind : all_kinds()) {
    for (const SolidElement& words : kind.elements) {
      if (words.tag != tag) continue;
      return [&words](FileContext& file, const XmlElement& element, const std::string& name) {
        return read_by_numbers(file, element, name, words);
      };
    }
  }
  return nullptr;
}

void read_solid(FileContext& file, const XmlElement& element) {
  const std::string name = file.name(element);
  NamedSolid solid;
  const bool taken = file.solids.contains(name);
  if (const SolidReader read = taken ? nullptr : find_reader(element.tag)) {
    file.open_name = name;
    solid = at_element(element, [&] { return read(file, element, name); });
  }
  solid.element = &element;
  file.define(file.solids, element, "solid", name, std::move(solid));
}

}  // namespace

NamedSolid read_dimensions(FileContext& file, const XmlElement& element, std::string_view kind,
                           const std::string& name) {
  constexpr std::string_view kinds[] = {"box",      "tube",      "cone",     "orb",   "sphere",
                                        "trd",      "trap",      "para",     "torus", "hype",
                                        "polycone", "polyhedra", "ellipsoid"};
  if (std::find(std::begin(kinds), std::end(kinds), kind) == std::end(kinds)) {
    fail(element,
         "unknown dimensions; use those of a box, tube, cone, orb, sphere, trd, trap, "
         "para, torus, hype, polycone, polyhedra or ellipsoid");
  }
  SolidReader read = find_reader(kind);
  for (const SolidKindReader& own : dimension_readers()) {
    if (own.tag == kind) read = own.read;
  }
  return at_element(element, [&] { return read(file, element, name); });
}

const NamedSolid& find_solid(FileContext& file, const XmlElement& element,
                             std::string_view attribute) {
  const NamedSolid& found =
      file.look_up(&FileContext::solids, element, "solid", file.reference(element, attribute));
  if (!found.solid) {
    fail(*found.element, "unsupported solid '" + printable(found.element->tag) +
                             "'; replace it by a supported one or take it out");
  }
  return found;
}

bool read_frame(FileContext& file, const XmlElement& child, std::string_view prefix, Frame& frame) {
  std::string_view tag = child.tag;
  if (!tag.starts_with(prefix)) return false;
  tag.remove_prefix(prefix.size());
  if (tag == "position") {
    frame.position = file.vector(child, Dimension::length);
  } else if (tag == "rotation") {
    frame.rotation = file.vector(child, Dimension::angle);
  } else if (tag == "positionref") {
    frame.position = file.look_up(file.positions, child, "position", file.reference(child));
  } else if (tag == "rotationref") {
    frame.rotation = file.look_up(file.rotations, child, "rotation", file.reference(child));
  } else {
    return false;
  }
  return true;
}

void read_solids(FileContext& file, const XmlElement& section) {
  for (const XmlElement& element : section.children()) {
    file.charge(element);
    if (element.tag == "loop") {
      file.define_if_readable(element, "loop",
                              [&] { file.loop(element, [&] { read_solids(file, element); }); });
    } else if (element.tag == "define") {
      read_define(file, element);
    } else if (element.tag == "opticalsurface" || element.tag == "auxiliary") {
      file.skip("skipped <" + std::string(element.tag) + ">");
    } else {
      file.define_if_readable(element, "solid", [&] { read_solid(file, element); });
      file.open_name.clear();
    }
  }
}

}  // namespace navjit::gdml

// The readers of single solids, by group; solids.cpp knows them all.
#pragma once

#include <functional>
#include <span>

#include "geometry/gdml/context.hpp"
#include "geometry/solids/gdml_words.hpp"

namespace navjit::gdml {

/// A function that makes a solid from an element.
using SolidReader =
    std::function<NamedSolid(FileContext&, const XmlElement&, const std::string& name)>;

struct SolidKindReader {
  std::string_view tag;
  NamedSolid (*read)(FileContext&, const XmlElement&, const std::string& name);
};

/// A solid whose element in GDML is described by SolidFacts.
NamedSolid read_by_numbers(FileContext& file, const XmlElement& element, const std::string& name,
                           const SolidElement& words);
/// box, tube, cone, ...
std::span<const SolidKindReader> primitive_readers();
/// tube, polycone and polyhedra as a paramvol gives their dimensions
std::span<const SolidKindReader> dimension_readers();
/// xtru, arb8, tessellated, ...: solids that are given by corners and contours
std::span<const SolidKindReader> contour_readers();
/// union, subtraction, intersection
std::span<const SolidKindReader> boolean_readers();

/// The solid of a kind whose dimensions a paramvol gives. Fails on unknown kinds.
NamedSolid read_dimensions(FileContext& file, const XmlElement& element, std::string_view kind,
                           const std::string& name);

/// The angle in rad that a polycone or polyhedra spans, generic or not: where the attribute is
/// missing or not above 0 it is the whole circle, with a note, as in Geant4's solids.
double opening(FileContext& file, const XmlElement& element, const char* attribute, double unit);

/// The union of solids that are where they should be. `size` is that of the largest of them, with
/// the number of all parts. Fails if that is too large for a boolean.
NamedSolid united(FileContext& file, const XmlElement& element, const std::string& name,
                  const std::vector<Solid>& solids, BooleanSize size);

/// The solid that an element refers to. Fails if it is not defined or of an unsupported kind.
const NamedSolid& find_solid(FileContext& file, const XmlElement& element,
                             std::string_view attribute = "ref");

/// A position and rotation, given by an element in place or by reference to a definition. The tags
/// are `prefix` + "position" or "rotation", also with "ref" appended. Both zero if not given.
struct Frame {
  Vector position{0, 0, 0}, rotation{0, 0, 0};
};
/// True if the child is a position or rotation; `frame` then has it.
bool read_frame(FileContext& file, const XmlElement& child, std::string_view prefix, Frame& frame);

}  // namespace navjit::gdml

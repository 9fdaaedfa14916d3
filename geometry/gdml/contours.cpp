// Solids that are given by corners or contours: lists of children or of attributes.
#include <algorithm>

#include "geometry/gdml/solids.hpp"

namespace navjit::gdml {
namespace {

NamedSolid made(Solid solid) {
  NamedSolid result;
  result.solid = std::move(solid);
  return result;
}

double length_unit(FileContext& file, const XmlElement& element) {
  return file.unit(element, "lunit", Dimension::length);
}
double angle_unit(FileContext& file, const XmlElement& element) {
  return file.unit(element, "aunit", Dimension::angle);
}

NamedSolid read_xtru(FileContext& file, const XmlElement& element, const std::string& name) {
  const double unit = length_unit(file, element);
  std::vector<PlanarPoint> polygon;
  std::vector<ExtrudedSection> sections;
  for (const XmlElement& child : element.children()) {
    file.charge(child);
    if (child.tag == "twoDimVertex") {
      polygon.push_back({file.length(child, "x", unit), file.length(child, "y", unit)});
    } else if (child.tag == "section") {
      // In the order of the file, whatever zOrder says, as in Geant4.
      sections.push_back(
          {file.length(child, "zPosition", unit), file.length(child, "xOffset", unit, 0),
           file.length(child, "yOffset", unit, 0), file.number(child, "scalingFactor", 1)});
    } else {
      fail(child, "unknown element here; use twoDimVertex or section");
    }
  }
  return made(make_extruded(name, polygon, sections));
}

NamedSolid read_para(FileContext& file, const XmlElement& element, const std::string& name) {
  const double unit = 0.5 * length_unit(file, element), angle = angle_unit(file, element);
  return made(make_para(name, file.length(element, "x", unit), file.length(element, "y", unit),
                        file.length(element, "z", unit), file.number(element, "alpha") * angle,
                        file.number(element, "theta") * angle,
                        file.number(element, "phi") * angle));
}

/// The defined position that an attribute names.
Vec3 corner(FileContext& file, const XmlElement& element, std::string_view attribute) {
  const Vector& p =
      file.look_up(file.positions, element, "position", file.reference(element, attribute));
  return {p[0], p[1], p[2]};
}

NamedSolid read_tet(FileContext& file, const XmlElement& element, const std::string& name) {
  return made(make_tet(name, corner(file, element, "vertex1"), corner(file, element, "vertex2"),
                       corner(file, element, "vertex3"), corner(file, element, "vertex4")));
}

NamedSolid read_tessellated(FileContext& file, const XmlElement& element, const std::string& name) {
  std::vector<FacetCorners> facets;
  constexpr std::string_view names[] = {"vertex1", "vertex2", "vertex3", "vertex4"};
  for (const XmlElement& child : element.children()) {
    file.charge(child);
    const bool quadrangular = child.tag == "quadrangular";
    if (!quadrangular && child.tag != "triangular") {
      fail(child, "unknown element here; use triangular or quadrangular");
    }
    FacetCorners facet;
    for (std::size_t i = 0; i < (quadrangular ? 4 : 3); ++i) {
      facet.push_back(corner(file, child, names[i]));
    }
    const std::string_view type = child.find("type").value_or("ABSOLUTE");
    if (type == "RELATIVE") {
      // The others are counted from the first.
      for (std::size_t i = 1; i < facet.size(); ++i) {
        facet[i].x += facet[0].x;
        facet[i].y += facet[0].y;
        facet[i].z += facet[0].z;
      }
    } else if (type != "ABSOLUTE") {
      fail(child, "type: '" + printable(type) + "' is unknown; use ABSOLUTE or RELATIVE");
    }
    facets.push_back(std::move(facet));
  }
  return made(make_tessellated(name, facets));
}

constexpr SolidKindReader readers[] = {
    {"xtru", read_xtru},
    {"para", read_para},
    {"tet", read_tet},
    {"tessellated", read_tessellated},
};

}  // namespace

std::span<const SolidKindReader> contour_readers() { return readers; }

}  // namespace navjit::gdml

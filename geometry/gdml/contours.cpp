// Solids that are given by corners or contours: lists of children or of attributes.
#include <algorithm>

#include "geometry/gdml/solids.hpp"
#include "geometry/solids/extruded_steps.hpp"

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
  // To cut it into triangles takes time with the square of the corners.
  const auto steps = bodies_between_steps(sections);
  const std::size_t cost = polygon.size() * polygon.size() / 64 * steps.size();
  if (cost > file.session.xml.elements) {
    refuse(element,
           "too many corners in the file's xtru; raise GdmlLimits::max_elements if this is "
           "meant");
  }
  file.session.xml.elements -= cost;
  std::string odd;
  std::vector<Solid> bodies;
  for (const std::vector<ExtrudedSection>& body : steps) {
    bodies.push_back(make_extruded(name, polygon, body, &odd));
  }
  if (!odd.empty()) {
    file.note(element, "its polygon touches or crosses itself: took what it surrounds", odd);
  }
  if (bodies.size() == 1) return made(std::move(bodies.front()));
  file.note(element,
            "it has two sections at one z: took the union of the bodies between such steps, as "
            "ROOT");
  return united(file, element, name, bodies, {.parts = bodies.size()});
}

NamedSolid read_arb8(FileContext& file, const XmlElement& element, const std::string& name) {
  const double unit = length_unit(file, element);
  PlanarPoint corners[8];
  for (int i = 0; i < 8; ++i) {
    const std::string attribute = "v" + std::to_string(i + 1);
    corners[i] = {file.length(element, attribute + "x", unit),
                  file.length(element, attribute + "y", unit)};
  }
  // GDML gives half of the length here.
  return made(make_arb8(name, file.length(element, "dz", unit), corners));
}

NamedSolid read_cut_tube(FileContext& file, const XmlElement& element, const std::string& name) {
  const double unit = length_unit(file, element), angle = angle_unit(file, element);
  const auto normal = [&](const char* x, const char* y, const char* z, double fallback) {
    const Vec3 n{file.number(element, x, 0), file.number(element, y, 0),
                 file.number(element, z, 0)};
    return n.x == 0 && n.y == 0 && n.z == 0 ? Vec3{0, 0, fallback} : n;
  };
  return made(make_cut_tube(
      name, file.length(element, "rmin", unit, 0), file.length(element, "rmax", unit),
      file.length(element, "z", 0.5 * unit), file.number(element, "startphi", 0) * angle,
      file.number(element, "deltaphi") * angle, normal("lowX", "lowY", "lowZ", -1),
      normal("highX", "highY", "highZ", 1)));
}

std::vector<ContourPoint> read_contour(FileContext& file, const XmlElement& element) {
  const double unit = length_unit(file, element);
  std::vector<ContourPoint> contour;
  for (const XmlElement& child : element.children()) {
    if (child.tag != "rzpoint") fail(child, "unknown element here; use rzpoint");
    file.charge(child);
    contour.push_back({file.length(child, "r", unit), file.length(child, "z", unit)});
  }
  if (contour.size() > static_cast<std::size_t>(file.session.options.limits.max_planes)) {
    refuse(element, "it has too many points; raise GdmlLimits::max_planes if this is meant");
  }
  return contour;
}

NamedSolid read_generic_polycone(FileContext& file, const XmlElement& element,
                                 const std::string& name) {
  const double angle = angle_unit(file, element);
  return made(make_generic_polycone(name, read_contour(file, element),
                                    file.number(element, "startphi", 0) * angle,
                                    opening(file, element, "deltaphi", angle)));
}

NamedSolid read_generic_polyhedra(FileContext& file, const XmlElement& element,
                                  const std::string& name) {
  const double angle = angle_unit(file, element);
  const int sides = file.integer(element, "numsides");
  if (sides > file.session.options.limits.max_planes) {
    refuse(element, "it has too many sides; raise GdmlLimits::max_planes if this is meant");
  }
  const auto cost = static_cast<std::size_t>(std::max(sides, 0));
  if (cost > file.session.xml.elements) refuse(element, "too many sides in the file");
  file.session.xml.elements -= cost;
  return made(make_generic_polyhedra(name, read_contour(file, element), sides,
                                     file.number(element, "startphi", 0) * angle,
                                     opening(file, element, "deltaphi", angle)));
}

/// The defined position that an attribute names, times a unit of the element, as in Geant4.
Vec3 corner(FileContext& file, const XmlElement& element, std::string_view attribute) {
  const Vector& p =
      file.look_up(file.positions, element, "position", file.reference(element, attribute));
  const double unit = length_unit(file, element);
  return {unit * p[0], unit * p[1], unit * p[2]};
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
      // The other corners are relative to the first.
      for (std::size_t i = 1; i < facet.size(); ++i) {
        facet[i].x += facet[0].x;
        facet[i].y += facet[0].y;
        facet[i].z += facet[0].z;
      }
    } else if (type != "ABSOLUTE") {
      file.note(child,
                "a facet's type is neither ABSOLUTE nor RELATIVE: took it for the first, as "
                "Geant4 does",
                ": '" + printable(type) + "'");
    }
    facets.push_back(std::move(facet));
  }
  std::string odd;
  NamedSolid solid = made(make_tessellated(name, facets, &odd));
  if (!odd.empty()) file.note(element, "its facets do not close on one another: closed them", odd);
  return solid;
}

constexpr SolidKindReader readers[] = {
    {"xtru", read_xtru},
    {"arb8", read_arb8},
    {"tet", read_tet},
    {"tessellated", read_tessellated},
    {"cutTube", read_cut_tube},
    {"genericPolycone", read_generic_polycone},
    {"genericPolyhedra", read_generic_polyhedra},
};

}  // namespace

std::span<const SolidKindReader> contour_readers() { return readers; }

}  // namespace navjit::gdml

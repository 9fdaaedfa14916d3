// Solids that are given by their own dimensions. GDML gives whole lengths of boxes and trapezoids
// and along z; the factories take halves.
#include <algorithm>
#include <cmath>

#include "geometry/gdml/solids.hpp"

namespace navjit::gdml {
namespace {

/// Reads the dimensions of one element in its units; mm and rad where it names none.
class Dimensions {
 public:
  Dimensions(FileContext& file, const XmlElement& element)
      : file_(file),
        element_(element),
        length_unit_(file.unit(element, "lunit", Dimension::length)),
        angle_unit_(file.unit(element, "aunit", Dimension::angle)) {}

  double length(const char* attribute) const {
    return file_.length(element_, attribute, length_unit_);
  }
  double length(const char* attribute, double fallback) const {
    return file_.length(element_, attribute, length_unit_, fallback);
  }
  /// A number without a unit.
  double plain(const char* attribute) const { return file_.number(element_, attribute); }
  double plain(const char* attribute, double fallback) const {
    return file_.number(element_, attribute, fallback);
  }
  double half(const char* attribute) const {
    return file_.length(element_, attribute, 0.5 * length_unit_);
  }
  double angle(const char* attribute) const {
    return file_.number(element_, attribute) * angle_unit_;
  }
  double angle(const char* attribute, double fallback) const {
    return file_.number(element_, attribute, fallback) * angle_unit_;
  }
  /// A number of sides, which cost memory as elements do.
  int sides(const char* attribute) const {
    const int n = file_.integer(element_, attribute);
    check_count(n, "sides");
    const auto cost = static_cast<std::size_t>(std::max(n, 0));
    if (cost > file_.session.xml.elements) fail(element_, "too many sides in the file");
    file_.session.xml.elements -= cost;
    return n;
  }
  /// The <zplane> children.
  std::vector<ZPlane> z_planes() const {
    std::vector<ZPlane> planes;
    for (const XmlElement& child : element_.children()) {
      if (child.tag != "zplane") fail(child, "unknown element here; use zplane");
      file_.charge(child);
      planes.push_back({file_.length(child, "z", length_unit_),
                        file_.length(child, "rmin", length_unit_, 0),
                        file_.length(child, "rmax", length_unit_)});
    }
    if (planes.size() < 2) fail(element_, "it has less than two <zplane>s; add some");
    check_count(static_cast<int>(planes.size()), "z planes");
    return planes;
  }

 private:
  void check_count(int n, const char* what) const {
    const int most = file_.session.options.limits.max_planes;
    if (n <= most) return;
    fail(element_, "it has more than " + std::to_string(most) + ' ' + what +
                       "; raise GdmlLimits::max_planes if this is meant");
  }

  FileContext& file_;
  const XmlElement& element_;
  double length_unit_, angle_unit_;
};

Solid read_box(const Dimensions& d, const std::string& name) {
  return make_box(name, d.half("x"), d.half("y"), d.half("z"));
}

Solid read_tube(const Dimensions& d, const std::string& name) {
  return make_tube(name, d.length("rmin", 0), d.length("rmax"), d.half("z"), d.angle("startphi", 0),
                   d.angle("deltaphi"));
}

Solid read_cone(const Dimensions& d, const std::string& name) {
  return make_cone(name, d.length("rmin1", 0), d.length("rmax1"), d.length("rmin2", 0),
                   d.length("rmax2"), d.half("z"), d.angle("startphi", 0), d.angle("deltaphi"));
}

Solid read_trd(const Dimensions& d, const std::string& name) {
  return make_trd(name, d.half("x1"), d.half("x2"), d.half("y1"), d.half("y2"), d.half("z"));
}

Solid read_trap(const Dimensions& d, const std::string& name) {
  return make_trap(name, d.half("z"), d.angle("theta", 0), d.angle("phi", 0), d.half("y1"),
                   d.half("x1"), d.half("x2"), d.angle("alpha1", 0), d.half("y2"), d.half("x3"),
                   d.half("x4"), d.angle("alpha2", 0));
}

Solid read_orb(const Dimensions& d, const std::string& name) {
  return make_orb(name, d.length("r"));
}

Solid read_sphere(const Dimensions& d, const std::string& name) {
  return make_sphere(name, d.length("rmin", 0), d.length("rmax"), d.angle("startphi", 0),
                     d.angle("deltaphi"), d.angle("starttheta", 0), d.angle("deltatheta"));
}

Solid read_polycone(const Dimensions& d, const std::string& name) {
  return make_polycone(name, d.z_planes(), d.angle("startphi", 0), d.angle("deltaphi"));
}

Solid read_polyhedra(const Dimensions& d, const std::string& name) {
  return make_polyhedra(name, d.z_planes(), d.sides("numsides"), d.angle("startphi", 0),
                        d.angle("deltaphi"));
}

Solid read_torus(const Dimensions& d, const std::string& name) {
  return make_torus(name, d.length("rmin", 0), d.length("rmax"), d.length("rtor"),
                    d.angle("startphi", 0), d.angle("deltaphi"));
}

Solid read_ellipsoid(const Dimensions& d, const std::string& name) {
  return make_ellipsoid(name, d.length("ax"), d.length("by"), d.length("cz"), d.length("zcut1", 0),
                        d.length("zcut2", 0));
}

// Half lengths for once.
Solid read_eltube(const Dimensions& d, const std::string& name) {
  return make_eltube(name, d.length("dx"), d.length("dy"), d.length("dz"));
}

// dx and dy are slopes.
Solid read_elcone(const Dimensions& d, const std::string& name) {
  return make_elcone(name, d.plain("dx"), d.plain("dy"), d.length("zmax"), d.length("zcut"));
}

// The length is a half.
Solid read_paraboloid(const Dimensions& d, const std::string& name) {
  return make_paraboloid(name, d.length("rlo"), d.length("rhi"), d.length("dz"));
}

Solid read_hype(const Dimensions& d, const std::string& name) {
  return make_hype(name, d.length("rmin", 0), d.length("rmax"), d.angle("inst", 0),
                   d.angle("outst", 0), d.half("z"));
}

Solid read_twistedbox(const Dimensions& d, const std::string& name) {
  return make_twistedbox(name, d.angle("PhiTwist"), d.half("x"), d.half("y"), d.half("z"));
}

Solid read_twistedtrd(const Dimensions& d, const std::string& name) {
  return make_twistedtrd(name, d.half("x1"), d.half("x2"), d.half("y1"), d.half("y2"), d.half("z"),
                         d.angle("PhiTwist"));
}

Solid read_twistedtrap(const Dimensions& d, const std::string& name) {
  return make_twistedtrap(name, d.angle("PhiTwist"), d.half("z"), d.angle("Theta", 0),
                          d.angle("Phi", 0), d.half("y1"), d.half("x1"), d.half("x2"), d.half("y2"),
                          d.half("x3"), d.half("x4"), d.angle("Alph", 0));
}

// Either radii at the ends and a length, or radii in the middle and the z of the ends; the azimuth
// is given, or is one of so many segments.
Solid read_twistedtubs(const Dimensions& d, const std::string& name) {
  const double twist = d.angle("twistedangle");
  const double segments = d.plain("nseg", 0);
  const double phi = segments != 0 ? d.angle("totphi") / segments : d.angle("phi", 0);
  const double length = d.length("zlen", 0);
  if (length == 0) {
    return make_twistedtubs(name, twist, d.length("midinnerrad", 0), d.length("midouterrad", 0),
                            d.length("negativeEndz", 0), d.length("positiveEndz", 0), phi);
  }
  const double waist = std::cos(twist / 2);
  return make_twistedtubs(name, twist, d.length("endinnerrad") * waist,
                          d.length("endouterrad") * waist, -length / 2, length / 2, phi);
}

template <Solid (*read)(const Dimensions&, const std::string&)>
NamedSolid primitive(FileContext& file, const XmlElement& element, const std::string& name) {
  NamedSolid result;
  result.solid = read(Dimensions(file, element), name);
  return result;
}

constexpr SolidKindReader readers[] = {
    {"box", primitive<read_box>},
    {"tube", primitive<read_tube>},
    {"trd", primitive<read_trd>},
    {"cone", primitive<read_cone>},
    {"trap", primitive<read_trap>},
    {"polycone", primitive<read_polycone>},
    {"polyhedra", primitive<read_polyhedra>},
    {"sphere", primitive<read_sphere>},
    {"orb", primitive<read_orb>},
    {"torus", primitive<read_torus>},
    {"ellipsoid", primitive<read_ellipsoid>},
    {"eltube", primitive<read_eltube>},
    {"elcone", primitive<read_elcone>},
    {"paraboloid", primitive<read_paraboloid>},
    {"hype", primitive<read_hype>},
    {"twistedbox", primitive<read_twistedbox>},
    {"twistedtrd", primitive<read_twistedtrd>},
    {"twistedtrap", primitive<read_twistedtrap>},
    {"twistedtubs", primitive<read_twistedtubs>},
};

}  // namespace

std::span<const SolidKindReader> primitive_readers() { return readers; }

}  // namespace navjit::gdml

// Solids that are given by their own dimensions. GDML gives whole lengths of boxes, of trapezoids
// and along z; the makers of solids take halves. Solids that take numbers and nothing else say
// themselves what GDML calls them (SolidFacts::elements).
#include <algorithm>
#include <cmath>

#include "geometry/gdml/solids.hpp"

namespace navjit::gdml {
namespace {

constexpr double right_angle = 1.5707963267948966;

/// Reads the dimensions of one element in its units; mm and rad where it names none. The unit of
/// angles is looked at only if there is an angle: a box may name any, as in Geant4.
class Dimensions {
 public:
  Dimensions(FileContext& file, const XmlElement& element)
      : file_(file),
        element_(element),
        length_unit_(file.unit(element, "lunit", Dimension::length)) {}

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
    return file_.number(element_, attribute) * angle_unit();
  }
  double angle(const char* attribute, double fallback) const {
    return file_.number(element_, attribute, fallback) * angle_unit();
  }
  /// An angle of which only the tangent matters: multiples of half a turn are taken off, as in
  /// Geant4. 0 where there is none.
  double slant(const char* attribute) const {
    const double given = angle(attribute, 0);
    if (!(std::abs(given) > right_angle) || !std::isfinite(given)) return given;
    note((std::string(attribute) +
          " is more than a right angle (check its unit): took off half turns")
             .c_str());
    return std::remainder(given, 2 * right_angle);
  }
  /// The angle that a polycone or polyhedra spans.
  double opening(const char* attribute) const {
    return gdml::opening(file_, element_, attribute, angle_unit());
  }
  /// A number of sides; they cost memory as elements do, and are counted like them.
  int sides(const char* attribute) const {
    const int n = file_.integer(element_, attribute);
    check_count(n, "sides");
    const auto cost = static_cast<std::size_t>(std::max(n, 0));
    if (cost > file_.session.xml.elements) gdml::refuse(element_, "too many sides in the file");
    file_.session.xml.elements -= cost;
    return n;
  }
  /// Notes that something was assumed.
  void note(const char* what) const { file_.note(element_, what); }
  bool has(const char* attribute) const { return element_.find(attribute).has_value(); }
  [[noreturn]] void refuse(const char* problem) const { fail(element_, problem); }
  /// The <zplane> children; only the first of them where the attribute `count` says how many.
  std::vector<ZPlane> z_planes(const char* count = nullptr) const {
    std::vector<ZPlane> planes;
    for (const XmlElement& child : element_.children()) {
      if (child.tag != "zplane") fail(child, "unknown element here; use zplane");
      file_.charge(child);
      planes.push_back({file_.length(child, "z", length_unit_),
                        file_.length(child, "rmin", length_unit_, 0),
                        file_.length(child, "rmax", length_unit_)});
    }
    if (count != nullptr && has(count)) keep_first(planes, count);
    if (planes.size() < 2) fail(element_, "it has less than two <zplane>s; add some");
    check_count(static_cast<int>(planes.size()), "z planes");
    return planes;
  }

 private:
  void keep_first(std::vector<ZPlane>& planes, const char* count) const {
    const int n = file_.integer(element_, count);
    if (n < 2 || static_cast<std::size_t>(n) > planes.size()) {
      fail(element_, std::string(count) + " is " + std::to_string(n) + ", and there are " +
                         std::to_string(planes.size()) +
                         " <zplane>s; give it from 2 up to their number");
    }
    if (static_cast<std::size_t>(n) == planes.size()) return;
    file_.note(element_, std::string("it has more <zplane>s than ") + count +
                             " says: took the first of them, as Geant4");
    planes.resize(static_cast<std::size_t>(n));
  }

  double angle_unit() const { return file_.unit(element_, "aunit", Dimension::angle); }

  void check_count(int n, const char* what) const {
    const int most = file_.session.options.limits.max_planes;
    if (n <= most) return;
    gdml::refuse(element_, "it has more than " + std::to_string(most) + ' ' + what +
                               "; raise GdmlLimits::max_planes if this is meant");
  }

  FileContext& file_;
  const XmlElement& element_;
  double length_unit_;
};

DivisibleShape read_box(const Dimensions& d) {
  return {.tag = "box", .x1 = d.half("x"), .y1 = d.half("y"), .hz = d.half("z")};
}

DivisibleShape read_tube(const Dimensions& d) {
  return {.tag = "tube",
          .hz = d.half("z"),
          .rmin1 = d.length("rmin", 0),
          .rmax1 = d.length("rmax"),
          .start = d.angle("startphi", 0),
          .delta = d.angle("deltaphi")};
}

DivisibleShape read_cone(const Dimensions& d) {
  return {.tag = "cone",
          .hz = d.half("z"),
          .rmin1 = d.length("rmin1", 0),
          .rmax1 = d.length("rmax1"),
          .rmin2 = d.length("rmin2", 0),
          .rmax2 = d.length("rmax2"),
          .start = d.angle("startphi", 0),
          .delta = d.angle("deltaphi")};
}

DivisibleShape read_trd(const Dimensions& d) {
  return {.tag = "trd",
          .x1 = d.half("x1"),
          .y1 = d.half("y1"),
          .x2 = d.half("x2"),
          .y2 = d.half("y2"),
          .hz = d.half("z")};
}

DivisibleShape read_para(const Dimensions& d) {
  return {.tag = "para",
          .x1 = d.half("x"),
          .y1 = d.half("y"),
          .hz = d.half("z"),
          .alpha = d.slant("alpha"),
          .theta = d.slant("theta"),
          .phi = d.angle("phi", 0)};
}

Solid read_trap(const Dimensions& d, const std::string& name) {
  Solid trap = make_trap(name, d.half("z"), d.slant("theta"), d.angle("phi", 0), d.half("y1"),
                         d.half("x1"), d.half("x2"), d.slant("alpha1"), d.half("y2"), d.half("x3"),
                         d.half("x4"), d.slant("alpha2"));
  if (trap.kind != SolidKind::trap) {
    d.note("its sides are not planar: joined its corners by straight lines (arb8)");
  }
  return trap;
}

DivisibleShape read_polycone(const Dimensions& d) {
  return {.tag = "polycone",
          .start = d.angle("startphi", 0),
          .delta = d.opening("deltaphi"),
          .planes = d.z_planes()};
}

DivisibleShape read_polyhedra(const Dimensions& d) {
  return {.tag = "polyhedra",
          .start = d.angle("startphi", 0),
          .delta = d.opening("deltaphi"),
          .planes = d.z_planes(),
          .sides = d.sides("numsides")};
}

// In a paramvol the attributes have other names; the length is a whole one nevertheless.
DivisibleShape read_tube_dimensions(const Dimensions& d) {
  return {.tag = "tube",
          .hz = d.half("hz"),
          .rmin1 = d.length("InR", 0),
          .rmax1 = d.length("OutR"),
          .start = d.angle("StartPhi", 0),
          .delta = d.angle("DeltaPhi")};
}
DivisibleShape read_polycone_dimensions(const Dimensions& d) {
  return {.tag = "polycone",
          .start = d.angle("startPhi", 0),
          .delta = d.opening("openPhi"),
          .planes = d.z_planes("numRZ")};
}
// Geant4 takes these radii as those of the edges.
DivisibleShape read_polyhedra_dimensions(const Dimensions& d) {
  DivisibleShape shape{.tag = "polyhedra",
                       .start = d.angle("startPhi", 0),
                       .delta = d.opening("openPhi"),
                       .planes = d.z_planes("numRZ"),
                       .sides = d.sides("numSide")};
  const double spanned = std::min(shape.delta, 4 * right_angle);
  const double inwards = std::cos(spanned / (2 * std::max(shape.sides, 1)));
  for (ZPlane& plane : shape.planes) {
    plane.rmin *= inwards;
    plane.rmax *= inwards;
  }
  return shape;
}

Solid read_torus(const Dimensions& d, const std::string& name) {
  const double rmax = d.length("rmax"), rtor = d.length("rtor");
  if (rmax >= rtor) {
    d.note("rmax >= rtor: took all points that near to its circle");
  }
  return make_torus(name, d.length("rmin", 0), rmax, rtor, d.angle("startphi", 0),
                    d.angle("deltaphi"));
}

Solid read_twistedtrap(const Dimensions& d, const std::string& name) {
  Solid trap = make_twistedtrap(name, d.angle("PhiTwist"), d.half("z"), d.angle("Theta", 0),
                                d.angle("Phi", 0), d.half("y1"), d.half("x1"), d.half("x2"),
                                d.half("y2"), d.half("x3"), d.half("x4"), d.angle("Alph", 0));
  if (static_cast<const kernels::TwistedTrap<double>*>(trap.shape.get())->steepening > 0) {
    d.note("its untwisted sides are not planar: took sections linear in z");
  }
  return trap;
}

// There are either radii at the ends and a length, or radii in the middle and the z of the ends.
// The azimuth is given, or is that of one of so many segments.
Solid read_twistedtubs(const Dimensions& d, const std::string& name) {
  const double twist = d.angle("twistedangle");
  const double segments = d.plain("nseg", 0);
  const double phi = segments != 0 ? d.angle("totphi") / segments : d.angle("phi", 0);
  const double length = d.length("zlen", 0);
  if (length == 0 && d.has("endouterrad")) {
    d.refuse(
        "a twisted tube needs zlen beside endinnerrad and endouterrad: without a length it has no "
        "points; add zlen, and phi or nseg and totphi");
  }
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

template <DivisibleShape (*read)(const Dimensions&)>
NamedSolid divisible(FileContext& file, const XmlElement& element, const std::string& name) {
  NamedSolid result;
  result.shape = read(Dimensions(file, element));
  result.solid = make_shape(name, *result.shape);
  return result;
}

double value_of(const Dimensions& d, const Attribute& a) {
  switch (a.meaning) {
    case Attribute::Meaning::number:
      return a.optional ? d.plain(a.name, 0) : d.plain(a.name);
    case Attribute::Meaning::length:
      return a.optional ? d.length(a.name, a.otherwise) : d.length(a.name);
    case Attribute::Meaning::half_length:
      return d.half(a.name);
    case Attribute::Meaning::angle:
      return a.optional ? d.angle(a.name, 0) : d.angle(a.name);
  }
  __builtin_unreachable();
}

constexpr SolidKindReader readers[] = {
    {"box", divisible<read_box>},
    {"tube", divisible<read_tube>},
    {"trd", divisible<read_trd>},
    {"cone", divisible<read_cone>},
    {"para", divisible<read_para>},
    {"trap", primitive<read_trap>},
    {"polycone", divisible<read_polycone>},
    {"polyhedra", divisible<read_polyhedra>},
    {"torus", primitive<read_torus>},
    {"twistedtrap", primitive<read_twistedtrap>},
    {"twistedtubs", primitive<read_twistedtubs>},
};

}  // namespace

double opening(FileContext& file, const XmlElement& element, const char* attribute, double unit) {
  const double delta = file.number(element, attribute, 0) * unit;
  if (delta > 0 || !std::isfinite(delta)) return delta;
  file.note(element, std::string("its ") + attribute +
                         " is missing or not above 0: took the whole circle, as Geant4");
  return 4 * right_angle;
}

std::span<const SolidKindReader> primitive_readers() { return readers; }

NamedSolid read_by_numbers(FileContext& file, const XmlElement& element, const std::string& name,
                           const SolidElement& words) {
  const Dimensions dimensions(file, element);
  std::array<double, SolidElement::most> values{};
  for (std::size_t i = 0; i < words.count; ++i) {
    values[i] = value_of(dimensions, words.attributes[i]);
  }
  NamedSolid result;
  result.solid = words.make(name, values);
  return result;
}

std::span<const SolidKindReader> dimension_readers() {
  static constexpr SolidKindReader table[] = {
      {"tube", divisible<read_tube_dimensions>},
      {"polycone", divisible<read_polycone_dimensions>},
      {"polyhedra", divisible<read_polyhedra_dimensions>},
  };
  return table;
}

}  // namespace navjit::gdml

// divisionvol and replicavol: many placements of one volume, written out one by one.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/gdml/structure.hpp"
#include "geometry/gdml/units.hpp"

namespace navjit::gdml {
namespace {

const XmlElement& child(const XmlElement& element, std::string_view tag) {
  for (const XmlElement& c : element.children()) {
    if (c.tag == tag) return c;
  }
  fail(element, "it has no <" + std::string(tag) + ">; add one");
}

VolumeId placed_volume(FileContext& file, const XmlElement& element) {
  const XmlElement& volume = child(element, "volumeref");
  return file.look_up(&FileContext::volumes, volume, "volume", file.reference(volume));
}

/// Adds copy `i`, turned by `turn` about z; the name of the copy ends in its number.
void add_copy(FileContext& file, const XmlElement& element, Mother& mother, VolumeId volume, int i,
              const double (&translation)[3], double turn) {
  Placement copy;
  copy.name = file.optional_name(element);
  if (copy.name.empty()) copy.name = file.session.world.volumes[volume].name + "_PV";
  copy.name += '_' + std::to_string(i);
  copy.volume = volume;
  copy.copy_number = i;
  double rotation[9];
  rotation_from_angles(0, 0, -turn, rotation);
  copy.transformation = make_transformation(translation, rotation);
  add_placement(file, element, mother, std::move(copy));
}

int positive_count(FileContext& file, const XmlElement& element, double count) {
  if (!(count >= 1 && count <= 1e9)) fail(element, "it makes no copies; check number and width");
  check_placements(file, element, static_cast<std::size_t>(count));
  return static_cast<int>(count);
}

bool nearly_equal(const DivisibleShape& a, const DivisibleShape& b) {
  const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-9; };
  return a.tag == b.tag && near(a.x1, b.x1) && near(a.x2, b.x2) && near(a.y1, b.y1) &&
         near(a.y2, b.y2) && near(a.hz, b.hz) && near(a.alpha, b.alpha) && near(a.theta, b.theta) &&
         near(a.phi, b.phi) && near(a.rmin1, b.rmin1) && near(a.rmin2, b.rmin2) &&
         near(a.rmax1, b.rmax1) && near(a.rmax2, b.rmax2) && near(a.start, b.start) &&
         near(a.delta, b.delta) && a.sides == b.sides &&
         std::equal(a.planes.begin(), a.planes.end(), b.planes.begin(), b.planes.end(),
                    [&](const ZPlane& p, const ZPlane& q) {
                      return near(p.z, q.z) && near(p.rmin, q.rmin) && near(p.rmax, q.rmax);
                    });
}

/// Volumes with the slices' shapes, whatever their own shapes are: Geant4 imposes the slices'.
struct SliceVolumes {
  FileContext& file;
  const XmlElement& element;
  VolumeId given;
  DivisibleShape shape{};  ///< of the volume last used
  VolumeId last = 0;

  VolumeId find(const DivisibleShape& wanted) {
    if (wanted.tag == shape.tag && nearly_equal(wanted, shape)) return last;
    shape = wanted;
    const NamedSolid* own = file.session.volume_solids[given];
    last = given;
    if (own == nullptr || !own->shape || !nearly_equal(*own->shape, wanted)) {
      const std::string name = file.session.world.volumes[given].solid.name;
      last = with_solid(file, element, given,
                        at_element(element, [&] { return make_shape(name, wanted); }),
                        size_of(wanted));
      file.skip("gave the volume of a <divisionvol> the shape of the slice");
    }
    return last;
  }
};

DivisionAxis division_axis(const XmlElement& element) {
  constexpr std::string_view names[] = {"kXAxis", "kYAxis", "kZAxis", "kRho", "kPhi"};
  const std::string_view axis = element.find("axis").value_or("");
  const auto* found = std::find(std::begin(names), std::end(names), axis);
  if (found == std::end(names)) {
    fail(element, "axis: '" + printable(axis) +
                      "' is unknown; use kXAxis, kYAxis, kZAxis, kRho "
                      "or kPhi");
  }
  return static_cast<DivisionAxis>(found - std::begin(names));
}

/// Geant4 wants an angle as the unit of radii, and takes its value as a number.
double division_unit(FileContext& file, const XmlElement& element, DivisionAxis axis) {
  const auto named = element.find("unit");
  const auto unit = named ? find_unit(*named) : std::nullopt;
  if (axis == DivisionAxis::rho && unit && unit->dimension == Dimension::angle) return unit->value;
  return file.unit(element, "unit",
                   axis == DivisionAxis::phi ? Dimension::angle : Dimension::length);
}

/// Whether the daughters are of the kind that they must be: Geant4 changes no other dimensions.
bool same_kind(const NamedSolid* daughter, const DivisibleShape& mother) {
  if (daughter == nullptr || daughter->element == nullptr) return false;
  const std::string_view tag = daughter->element->tag;
  return tag == mother.tag || (tag == "trap" && mother.tag == "trd");
}

constexpr double full_turn = 2 * std::numbers::pi;

Division read_counts(FileContext& file, const XmlElement& element, const DivisibleShape& shape) {
  Division d{.axis = division_axis(element)};
  const auto whole = divisible_length(shape, d.axis);
  if (!whole) {
    fail(element, "unsupported structure 'divisionvol' of a " + std::string(shape.tag) +
                      " along this axis; write its copies as physvols");
  }
  const double unit = division_unit(file, element, d.axis);
  d.offset = file.length(element, "offset", unit, 0);
  if (d.axis == DivisionAxis::phi && d.offset < 0) {
    // ROOT writes the offsets of slices in azimuth less a full turn, which turns nothing.
    d.offset = std::fmod(d.offset, full_turn) + full_turn;
    if (d.offset > full_turn - 1e-9) d.offset = 0;
  }
  d.width = file.length(element, "width", unit, 0);
  const int number = file.integer(element, "number", 0);
  if (number < 0 || d.width < 0) fail(element, "number and width must not be negative");
  if (number == 0 && d.width == 0) fail(element, "it needs a number or a width");
  d.number = positive_count(file, element,
                            number > 0 ? number : std::floor((*whole - d.offset) / d.width));
  if (static_cast<std::size_t>(d.number) * shape.planes.size() > file.session.xml.elements) {
    refuse(element,
           "too many copies of different shapes; raise GdmlLimits::max_elements if this is "
           "meant");
  }
  const int sections = static_cast<int>(shape.planes.size()) - 1;
  if (shape.sides > 0 && d.axis == DivisionAxis::phi) {
    // Between the edges, whatever `width` and `offset` say.
    if (number > 0 && number != shape.sides) {
      fail(element, "a polyhedra is divided in phi into as many slices as it has sides, " +
                        std::to_string(shape.sides));
    }
    d.number = shape.sides;
    d.width = *whole / shape.sides;
    d.offset = 0;
  } else if (sections > 0 && d.axis == DivisionAxis::z && d.width == 0) {
    if (number > sections || (shape.sides > 0 && number != sections)) {
      fail(element, "without a width it is divided at its z planes, into " +
                        std::to_string(sections) + " slices; give a width");
    }
    d.by_planes = true;
  } else if (d.width == 0) {
    d.width = (*whole - d.offset) / d.number;
  }
  if (!d.by_planes &&
      (d.offset < 0 || !(d.width > 0) || d.offset + d.width * d.number > *whole + 1e-9)) {
    fail(element, "the slices reach out of the mother; check offset, width and number");
  }
  return d;
}

}  // namespace

void read_division(FileContext& file, const XmlElement& element, Mother& mother) {
  SliceVolumes volumes{file, element, placed_volume(file, element)};
  if (mother.solid == nullptr || !mother.solid->shape) {
    fail(element,
         "unsupported structure 'divisionvol' in a mother that is no box, tube, cone, trd, para, "
         "polycone or polyhedra; write its copies as physvols");
  }
  const DivisibleShape& shape = *mother.solid->shape;
  const Division division = read_counts(file, element, shape);
  if (!same_kind(file.session.volume_solids[volumes.given], shape)) {
    fail(element, "the volume must have a solid of the mother's kind, '" + std::string(shape.tag) +
                      "'; the slices' dimensions are not those of another");
  }
  for (int i = 0; i < division.number; ++i) {
    const Slice piece = at_element(element, [&] { return slice(shape, division, i); });
    add_copy(file, element, mother, volumes.find(piece.shape), i, piece.translation, piece.turn);
  }
}

void read_replica(FileContext& file, const XmlElement& element, Mother& mother) {
  const VolumeId volume = placed_volume(file, element);
  const int count = positive_count(file, element, file.integer(element, "number", 1));
  const XmlElement& along = child(element, "replicate_along_axis");
  const XmlElement& direction = child(along, "direction");
  const char* const axes[] = {"x", "y", "z", "rho", "phi"};
  int axis = -1;
  for (int i = 0; i < 5; ++i) {
    if (file.number(direction, axes[i], 0) == 1) axis = i;
  }
  if (axis < 0) {
    fail(direction, "unsupported direction of replicas; use x, y, z, rho or phi, with value 1");
  }
  const bool outwards = axis == 3, around = axis == 4;
  const Dimension dimension = around ? Dimension::angle : Dimension::length;
  const auto quantity = [&](const XmlElement& q) {
    // Geant4 takes a unit of either kind here, as a number of mm or rad, and there are programs
    // that write angles in mm.
    const auto text = q.find("unit");
    const auto unit = text ? find_unit(*text) : std::nullopt;
    const Dimension other = around ? Dimension::length : Dimension::angle;
    if (!unit || unit->dimension != other) {
      return file.length(q, "value", file.unit(q, "unit", dimension));
    }
    file.note(q, around ? "an angle with a unit of length: took millimetres for radians, as Geant4"
                        : "a length with a unit of angle: took radians for millimetres, as Geant4");
    return file.length(q, "value", unit->value);
  };
  const double width = quantity(child(along, "width"));
  double offset = 0;
  for (const XmlElement& c : along.children()) {
    if (c.tag == "offset" && axis >= 3) offset = quantity(c);
  }
  if (outwards &&
      (mother.solid == nullptr || !mother.solid->shape || mother.solid->shape->tag != "tube")) {
    fail(element, "unsupported replicas along rho in a mother that is no tube; place tubes");
  }
  SliceVolumes shells{file, element, volume};
  for (int i = 0; i < count; ++i) {
    double translation[3] = {0, 0, 0};
    double turn = 0;
    VolumeId placed = volume;
    if (around) {
      turn = offset + width * (i + 0.5);
    } else if (outwards) {
      DivisibleShape shell = *mother.solid->shape;
      shell.rmin1 = offset + width * i;
      shell.rmax1 = offset + width * (i + 1);
      placed = shells.find(shell);
    } else {
      // Geant4 centres replicas in the mother, whatever their offset.
      translation[axis] = -width * 0.5 * (count - 1) + width * i;
    }
    add_copy(file, element, mother, placed, i, translation, turn);
  }
}

}  // namespace navjit::gdml

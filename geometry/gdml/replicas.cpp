// divisionvol and replicavol: many placements of one volume, written out one by one.
#include <algorithm>
#include <cmath>

#include "geometry/gdml/structure.hpp"

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
  return file.look_up(file.volumes, volume, "volume", file.reference(volume));
}

/// Adds copy `i`, turned by `turn` about z; its name ends in its number.
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

int positive_count(const XmlElement& element, double count) {
  if (!(count >= 1 && count <= 1e9)) fail(element, "it makes no copies; check number and width");
  return static_cast<int>(count);
}

/// The volume with the slice's shape, whatever its own: Geant4 imposes it.
VolumeId with_shape(FileContext& file, const XmlElement& element, VolumeId id,
                    const double (&half)[3]) {
  World& world = file.session.world;
  const Solid& own = world.volumes[id].solid;
  const Vec3 max = own.extent.max;
  const double difference =
      std::max({std::abs(max.x - half[0]), std::abs(max.y - half[1]), std::abs(max.z - half[2])});
  if (difference <= 1e-9) return id;
  LogicalVolume volume = world.volumes[id];
  std::vector<Placement> daughters = std::move(volume.daughters);
  volume.daughters.clear();
  volume.solid = make_box(own.name, half[0], half[1], half[2]);
  Mother copy{volume.daughters, 1, &volume.solid};
  for (Placement& daughter : daughters) add_placement(file, element, copy, std::move(daughter));
  world.volumes.push_back(std::move(volume));
  file.note("gave the volume of a <divisionvol> the shape of the slice");
  return static_cast<VolumeId>(world.volumes.size() - 1);
}

}  // namespace

void read_division(FileContext& file, const XmlElement& element, Mother& mother) {
  const std::string_view axis = element.find("axis").value_or("");
  const int i_axis = axis == "kXAxis" ? 0 : axis == "kYAxis" ? 1 : axis == "kZAxis" ? 2 : -1;
  VolumeId volume = placed_volume(file, element);
  const bool boxes = mother.solid != nullptr && mother.solid->kind == SolidKind::box &&
                     file.session.world.volumes[volume].solid.kind == SolidKind::box;
  if (i_axis < 0 || !boxes) {
    fail(element,
         "unsupported structure 'divisionvol' other than of a box into boxes along x, y or z; "
         "write its copies as physvols");
  }
  const double unit = file.unit(element, "unit", Dimension::length);
  const double offset = file.length(element, "offset", unit, 0);
  double width = file.length(element, "width", unit, 0);
  const int number = file.integer(element, "number", 0);
  const Vec3 max = mother.solid->extent.max;
  double half[3] = {max.x, max.y, max.z};
  const double mother_half = half[i_axis];
  if (number < 0 || width < 0) fail(element, "number and width must not be negative");
  if (number == 0 && width == 0) fail(element, "it needs a number or a width");
  const int count =
      positive_count(element, number > 0 ? number : std::floor((2 * mother_half - offset) / width));
  if (width == 0) width = (2 * mother_half - offset) / count;
  if (offset < 0 || !(width > 0) || offset + width * count > 2 * mother_half + 1e-9) {
    fail(element, "the slices reach out of the mother; check offset, width and number");
  }
  half[i_axis] = width / 2;
  volume = with_shape(file, element, volume, half);
  for (int i = 0; i < count; ++i) {
    double translation[3] = {0, 0, 0};
    translation[i_axis] = -mother_half + offset + (i + 0.5) * width;
    add_copy(file, element, mother, volume, i, translation, 0);
  }
}

void read_replica(FileContext& file, const XmlElement& element, Mother& mother) {
  const VolumeId volume = placed_volume(file, element);
  const int count = positive_count(element, file.integer(element, "number"));
  const XmlElement& along = child(element, "replicate_along_axis");
  const XmlElement& direction = child(along, "direction");
  const char* const axes[] = {"x", "y", "z", "phi"};
  int axis = -1;
  for (int i = 0; i < 4; ++i) {
    if (file.number(direction, axes[i], 0) == 1) axis = i;
  }
  if (axis < 0) {
    fail(direction, "unsupported direction of replicas; use x, y, z or phi, with value 1");
  }
  const Dimension dimension = axis == 3 ? Dimension::angle : Dimension::length;
  const auto quantity = [&](const XmlElement& q) {
    return file.length(q, "value", file.unit(q, "unit", dimension));
  };
  const double width = quantity(child(along, "width"));
  const double offset = axis == 3 ? quantity(child(along, "offset")) : 0;
  for (int i = 0; i < count; ++i) {
    double translation[3] = {0, 0, 0};
    double turn = 0;
    if (axis == 3) {
      turn = offset + width * (i + 0.5);
    } else {
      // Geant4 centres replicas in the mother, whatever their offset.
      translation[axis] = -width * 0.5 * (count - 1) + width * i;
    }
    add_copy(file, element, mother, volume, i, translation, turn);
  }
}

}  // namespace navjit::gdml

// Reads ROOT's volumes, assemblies and nodes.
#include <cmath>

#include "geometry/root/reading.hpp"

namespace navjit::root {
namespace {

constexpr int deepest = 256;  // levels, with those of assemblies

void add(Reading& reading, const Object& volume, std::vector<Placement>& to, Placement placement) {
  reading.name_bytes += placement.name.size();
  if (++reading.placements > reading.limits.max_placements ||
      reading.name_bytes > reading.limits.max_name_bytes) {
    volume.fail("more than " + std::to_string(reading.limits.max_placements) +
                " placements, or too long names of them; raise RootLimits::max_placements if this "
                "is meant");
  }
  to.push_back(std::move(placement));
}

Frame frame_of(Reading& reading, const Object& node, const Object& mother) {
  if (node.is("TGeoNodeOffset")) return read_slice(reading, node, mother.reference("fShape"));
  if (!node.is("TGeoNodeMatrix")) node.fail("unsupported kind of node");
  return read_frame(reading, node.reference("fMatrix"));
}

void read_node(Reading& reading, Reference reference, const Object& mother, int depth,
               std::vector<Placement>& to) {
  const Object node = reading.objects.read(reference);
  const Reference below = node.reference("fVolume");
  if (below == 0) node.fail("it places no volume");
  constexpr std::uint32_t may_overlap = 1U << 13 | 1U << 17;  // until 2010, and since then
  if ((node.bits & may_overlap) != 0) {
    reading.notes.count(
        "placements may overlap others (ROOT's \"many\"): where they do, a point belongs to the "
        "last of them, as in Geant4; see navjit check");
  }
  Placement placement;
  placement.name = node.name;
  constexpr double most = 2147483647;
  const double number = node.number("fNumber", 0);
  placement.copy_number = std::abs(number) <= most ? static_cast<int>(number) : 0;
  try {
    placement.transformation = transformation_of(frame_of(reading, node, mother));
  } catch (const GeometryError& e) {
    node.fail(e.what());
  }
  const MadeVolume& made = read_volume(reading, below, depth + 1);
  if (made.empty) {
    return reading.notes.count("flat volumes, which hold nothing, are placed: left out");
  }
  if (!made.assembly) {
    placement.volume = made.id;
    return add(reading, mother, to, std::move(placement));
  }
  for (const Placement& inner : made.placements) {
    Placement imprint = inner;
    imprint.name = placement.name + '.' + inner.name;
    imprint.transformation = compose(placement.transformation, inner.transformation);
    add(reading, mother, to, std::move(imprint));
  }
}

MadeVolume make(Reading& reading, Reference reference, int depth) {
  const Object& volume = reading.objects.at(reference);
  if (depth > deepest) {
    volume.fail("volumes are nested more than " + std::to_string(deepest) + " deep");
  }
  const Reference shape = volume.reference("fShape");
  if (shape == 0) volume.fail("it has no shape");
  MadeVolume made;
  made.assembly = reading.objects.at(shape).is("TGeoShapeAssembly");
  // The world itself must have an inside.
  made.empty = depth > 0 && is_flat(reading.objects.at(shape)) &&
               reading.objects.list(volume.reference("fNodes")).empty();
  if (made.empty) return made;
  LogicalVolume logical;
  if (!made.assembly) {
    logical.name = volume.name;
    logical.solid = read_solid(reading, shape).solid;
    const Reference medium = volume.reference("fMedium");
    if (medium == 0) reading.notes.count("volumes have no medium: their material is unknown");
    logical.material = read_material(reading, medium);
  }
  std::vector<Placement>& placements = made.assembly ? made.placements : logical.daughters;
  for (const Reference node : reading.objects.list(volume.reference("fNodes"))) {
    if (node != 0) read_node(reading, node, volume, depth, placements);
  }
  if (!made.assembly) {
    made.id = static_cast<VolumeId>(reading.world.volumes.size());
    reading.world.volumes.push_back(std::move(logical));
  }
  return made;
}

}  // namespace

const MadeVolume& read_volume(Reading& reading, Reference reference, int depth) {
  const auto known = reading.volumes.find(reference);
  if (known != reading.volumes.end()) return known->second;
  bool& open = reading.open_volumes[reference];
  if (open) reading.objects.at(reference).fail("it is within itself; remove the cycle");
  open = true;
  MadeVolume made = make(reading, reference, depth);
  return reading.volumes.insert_or_assign(reference, std::move(made)).first->second;
}

}  // namespace navjit::root

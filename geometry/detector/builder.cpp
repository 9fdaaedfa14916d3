#include "navjit/builder.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/model/world.hpp"
#include "navjit/errors.hpp"

namespace navjit {
namespace {

void require_number(double value, const std::string& what) {
  if (!std::isfinite(value) || value < 0) {
    throw GeometryError(what + " is " + std::to_string(value) +
                        "; a number that is not negative is needed");
  }
}

LogicalVolume& volume_of(World& world, VolumeId volume) {
  if (volume >= world.volumes.size()) {
    throw GeometryError("there is no volume " + std::to_string(volume));
  }
  return world.volumes[volume];
}

Placement& placement_of(World& world, VolumeId mother, std::uint32_t daughter) {
  LogicalVolume& volume = volume_of(world, mother);
  if (daughter >= volume.daughters.size()) {
    throw GeometryError("volume '" + volume.name + "' has no daughter number " +
                        std::to_string(daughter));
  }
  return volume.daughters[daughter];
}

/// Makes a new list, since copies that were made before must not change.
void add(Auxiliaries& auxiliaries, Auxiliary one) {
  auto more = auxiliaries ? *auxiliaries : std::vector<Auxiliary>{};
  more.push_back(std::move(one));
  auxiliaries = std::make_shared<const std::vector<Auxiliary>>(std::move(more));
}

/// Whether `inner` is `outer`, or is somewhere in it.
bool holds(const World& world, VolumeId outer, VolumeId inner) {
  std::vector<bool> seen(world.volumes.size(), false);
  std::vector<VolumeId> waiting{outer};
  while (!waiting.empty()) {
    const VolumeId volume = waiting.back();
    waiting.pop_back();
    if (volume == inner) return true;
    if (seen[volume]) continue;
    seen[volume] = true;
    for (const Placement& placement : world.volumes[volume].daughters) {
      waiting.push_back(placement.volume);
    }
  }
  return false;
}

}  // namespace

DetectorBuilder::DetectorBuilder() : world_(std::make_unique<World>()) {}
DetectorBuilder::DetectorBuilder(const Detector& detector)
    : world_(std::make_unique<World>(*detector.model())) {}
DetectorBuilder::~DetectorBuilder() = default;

DetectorBuilder::IsotopeId DetectorBuilder::isotope(Isotope isotope) {
  const std::string name = "isotope '" + isotope.name + "': ";
  require_number(isotope.z, name + "the charge");
  require_number(isotope.nucleons, name + "the number of nucleons");
  require_number(isotope.a, name + "the molar mass");
  world_->isotopes.push_back(std::move(isotope));
  return static_cast<IsotopeId>(world_->isotopes.size() - 1);
}

DetectorBuilder::ElementId DetectorBuilder::element(Element element) {
  const std::string name = "element '" + element.name + "': ";
  require_number(element.z, name + "the charge");
  require_number(element.a, name + "the molar mass");
  for (const IsotopeShare& share : element.isotopes) {
    if (share.isotope >= world_->isotopes.size()) {
      throw GeometryError(name + "there is no isotope " + std::to_string(share.isotope));
    }
    require_number(share.abundance, name + "the abundance of an isotope");
  }
  world_->elements.push_back(std::move(element));
  return static_cast<ElementId>(world_->elements.size() - 1);
}

DetectorBuilder::MaterialId DetectorBuilder::material(Material material) {
  const std::string name = "material '" + material.name + "': ";
  require_number(material.density, name + "the density");
  require_number(material.temperature, name + "the temperature");
  require_number(material.pressure, name + "the pressure");
  require_number(material.radiation_length, name + "the radiation length");
  double sum = 0;
  for (const ElementShare& share : material.elements) {
    if (share.element >= world_->elements.size()) {
      throw GeometryError(name + "there is no element " + std::to_string(share.element));
    }
    require_number(share.fraction, name + "the fraction of an element");
    sum += share.fraction;
  }
  if (!material.elements.empty() && !(sum > 0 && std::isfinite(sum))) {
    throw GeometryError(name + "the fractions of its elements add up to " + std::to_string(sum));
  }
  for (ElementShare& share : material.elements) share.fraction /= sum;
  if (material.radiation_length == 0 && material.density > 0) {
    // g/cm2 over g/cm3 is cm.
    material.radiation_length =
        10 * radiation_length(*world_, material.elements) / material.density;
  }
  world_->materials.push_back(std::move(material));
  return static_cast<MaterialId>(world_->materials.size() - 1);
}

VolumeId DetectorBuilder::volume(std::string name, Solid solid, MaterialId material) {
  if (material >= world_->materials.size()) {
    throw GeometryError("volume '" + name + "': there is no material " + std::to_string(material));
  }
  if (solid.shape == nullptr) {
    throw GeometryError("volume '" + name + "': its solid is none; make_box or its like makes one");
  }
  LogicalVolume volume;
  volume.name = std::move(name);
  volume.solid = std::move(solid);
  volume.material = material;
  world_->volumes.push_back(std::move(volume));
  return static_cast<VolumeId>(world_->volumes.size() - 1);
}

std::uint32_t DetectorBuilder::place(VolumeId volume, VolumeId mother, const Transformation& where,
                                     int copy_number, std::string name) {
  const LogicalVolume& placed = volume_of(*world_, volume);
  LogicalVolume& around = volume_of(*world_, mother);
  const bool circular =
      placed.daughters.empty() ? volume == mother : holds(*world_, volume, mother);
  if (circular) {
    throw GeometryError("volume '" + placed.name + "' cannot be placed in '" + around.name +
                        "', which is it or in it");
  }
  Placement placement;
  placement.volume = volume;
  placement.copy_number = copy_number;
  placement.transformation = make_transformation(where.translation, where.rotation);
  const auto number = static_cast<std::uint32_t>(around.daughters.size());
  placement.name = name.empty() ? placed.name + "_" + std::to_string(number) : std::move(name);
  around.daughters.push_back(std::move(placement));
  return number;
}

void DetectorBuilder::set_user_data(VolumeId volume, std::uint64_t data) {
  volume_of(*world_, volume).user_data = data;
}
void DetectorBuilder::set_user_data(VolumeId mother, std::uint32_t daughter, std::uint64_t data) {
  placement_of(*world_, mother, daughter).user_data = data;
}
void DetectorBuilder::add_auxiliary(VolumeId volume, Auxiliary auxiliary) {
  add(volume_of(*world_, volume).auxiliaries, std::move(auxiliary));
}
void DetectorBuilder::add_auxiliary(VolumeId mother, std::uint32_t daughter, Auxiliary auxiliary) {
  add(placement_of(*world_, mother, daughter).auxiliaries, std::move(auxiliary));
}

Detector DetectorBuilder::build(VolumeId world) const {
  World finished = *world_;
  finished.top = world;
  finish(finished);
  return Detector(std::move(finished));
}

}  // namespace navjit

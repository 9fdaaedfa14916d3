// <structure>: logical volumes and assemblies.
#include "geometry/gdml/structure.hpp"

#include <algorithm>

#include "geometry/gdml/solids.hpp"
#include "geometry/model/placed_extent.hpp"
#include "navjit/solids.hpp"

namespace navjit::gdml {
namespace {

constexpr struct {
  std::string_view tag;
  DaughterReader read;
} daughter_readers[] = {
    {"physvol", read_physvol},
    {"replicavol", read_replica},
    {"divisionvol", read_division},
    {"paramvol", read_paramvol},
};

void read_daughters(FileContext& file, const XmlElement& section, Mother& mother) {
  for (const XmlElement& element : section.children()) {
    file.charge(element);
    if (element.tag == "materialref" || element.tag == "solidref") continue;
    if (element.tag == "auxiliary" && section.tag == "volume") continue;
    if (mother.assembly != nullptr && element.tag != "physvol" && element.tag != "auxiliary") {
      file.note(element, "is read in an assembly, where Geant4 leaves it out");
    }
    if (element.tag == "loop") {
      file.loop(element, [&] { read_daughters(file, element, mother); });
      continue;
    }
    const auto* reader = std::find_if(std::begin(daughter_readers), std::end(daughter_readers),
                                      [&](const auto& r) { return r.tag == element.tag; });
    if (reader != std::end(daughter_readers)) {
      reader->read(file, element, mother);
    } else {
      file.skip("skipped <" + printable(element.tag) + "> in <" + printable(section.tag) + ">");
    }
  }
}

/// A material of which only the name is known: no step depends on more.
std::uint32_t unknown_material(FileContext& file, const std::string& name) {
  auto& materials = file.session.world.materials;
  const auto [position, added] =
      file.materials.try_emplace(name, static_cast<std::uint32_t>(materials.size()));
  if (added) materials.push_back({.name = name});
  return position->second;
}

std::uint32_t find_material(FileContext& file, const XmlElement& element) {
  const std::string name = file.reference(element);
  if (const std::uint32_t* known = find_material_named(file, name)) return *known;
  // Geant4 makes materials of these names from its NIST table.
  if (name.starts_with("G4_")) {
    file.skip("kept the name but no density of materials from Geant4's NIST table");
  } else {
    file.note(element, "material '" + printable(name) +
                           "' is not defined: kept its name; nothing else of it is known");
  }
  return unknown_material(file, name);
}

void read_volume(FileContext& file, const XmlElement& element) {
  const std::string name = file.name(element);
  if (file.volumes.contains(name)) return file.define(file.volumes, element, "volume", name, 0u);
  const NamedSolid* solid = nullptr;
  std::optional<std::uint32_t> material;
  for (const XmlElement& child : element.children()) {
    if (child.tag == "solidref") solid = &find_solid(file, child);
    if (child.tag == "materialref") material = find_material(file, child);
  }
  if (solid == nullptr) fail(element, "it has no solid; add a <solidref>");
  LogicalVolume volume;
  volume.name = name;
  volume.solid = *solid->solid;
  volume.auxiliaries = read_auxiliaries(file, element);
  if (!material) file.note(element, "it has no <materialref>: its material is unknown");
  volume.material = material ? *material : unknown_material(file, "");
  file.open_name = name;
  Mother mother{.placements = volume.daughters, .solid = solid};
  read_daughters(file, element, mother);
  const VolumeId id = add_volume(file.session, std::move(volume), solid);
  file.define(file.volumes, element, "volume", name, id);
}

void read_assembly(FileContext& file, const XmlElement& element) {
  const std::string name = file.name(element);
  Assembly assembly;
  file.open_name = name;
  Mother mother{.placements = assembly.placements, .assembly = &assembly};
  read_daughters(file, element, mother);
  assembly.depth = mother.assembly_depth;
  file.define(file.assemblies, element, "assembly", name, std::move(assembly));
}

}  // namespace

VolumeId add_volume(Session& session, LogicalVolume volume, const NamedSolid* solid) {
  session.world.volumes.push_back(std::move(volume));
  session.volume_solids.push_back(solid);
  return static_cast<VolumeId>(session.world.volumes.size() - 1);
}

VolumeId box_around(FileContext& file, const XmlElement& element, const std::string& name) {
  const Assembly& assembly = file.assemblies.at(name);
  if (assembly.placements.empty()) fail(element, "the world is an assembly that holds nothing");
  LogicalVolume box;
  box.name = name;
  Mother mother{box.daughters};
  for (const Placement& placement : assembly.placements) {
    add_placement(file, element, mother, placement);
  }
  number_imprint(assembly, box.daughters, 0);
  const Vec3 half = half_lengths_around(file.session.world, assembly.placements);
  // There is room around it, so that no face is on one of the world's.
  box.solid = make_box(name, 1.01 * half.x + 1, 1.01 * half.y + 1, 1.01 * half.z + 1);
  box.material = unknown_material(file, "");
  file.note(element, "the world is an assembly, which Geant4 refuses: put it in a box");
  return add_volume(file.session, std::move(box), nullptr);
}

VolumeId with_solid(FileContext& file, const XmlElement& element, VolumeId id, Solid solid,
                    std::size_t size) {
  // Copies cost memory as elements do, and more.
  const std::size_t cost = 16 + size + file.session.world.volumes[id].name.size() / 16;
  if (cost > file.session.xml.elements) {
    refuse(element,
           "too many copies of different shapes; raise GdmlLimits::max_elements if this is "
           "meant");
  }
  file.session.xml.elements -= cost;
  const LogicalVolume& model = file.session.world.volumes[id];
  check_placements(file, element, model.daughters.size());
  LogicalVolume volume;
  volume.name = model.name;
  volume.solid = std::move(solid);
  volume.material = model.material;
  volume.auxiliaries = model.auxiliaries;
  Mother copy{volume.daughters};
  for (const Placement& daughter : model.daughters) add_placement(file, element, copy, daughter);
  return add_volume(file.session, std::move(volume), nullptr);
}

void check_placements(FileContext& file, const XmlElement& element, std::size_t count) {
  const Session& session = file.session;
  const GdmlLimits& limits = session.options.limits;
  if (count > limits.max_placements - std::min(session.placements, limits.max_placements) ||
      session.placement_name_bytes > 64 * limits.max_placements) {
    refuse(element, "more than " + std::to_string(limits.max_placements) +
                        " placements, or too long names of them; raise GdmlLimits::max_placements "
                        "if this is meant");
  }
}

void add_placement(FileContext& file, const XmlElement& element, Mother& mother,
                   Placement placement) {
  file.session.placement_name_bytes += placement.name.size();
  check_placements(file, element, 1);
  ++file.session.placements;
  if (mother.assembly != nullptr) mother.assembly->parts.push_back({});
  mother.placements.push_back(std::move(placement));
}

void read_structure(FileContext& file, const XmlElement& section) {
  for (const XmlElement& element : section.children()) {
    file.charge(element);
    if (element.tag == "volume" || element.tag == "assembly") {
      // An assembly may stand where a volume is asked for.
      file.define_if_readable(element, "volume", [&] {
        element.tag == "volume" ? read_volume(file, element) : read_assembly(file, element);
      });
      file.open_name.clear();
    } else if (element.tag == "loop") {
      file.define_if_readable(element, "loop",
                              [&] { file.loop(element, [&] { read_structure(file, element); }); });
    } else if (element.tag == "bordersurface" || element.tag == "skinsurface" ||
               element.tag == "auxiliary") {
      file.skip("skipped <" + printable(element.tag) + ">");
    } else {
      fail(element, "unknown element in <structure>; use volume, assembly or loop");
    }
  }
}

}  // namespace navjit::gdml

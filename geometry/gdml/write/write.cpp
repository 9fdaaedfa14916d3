// Writes a detector as a GDML file.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "geometry/gdml/write/frames.hpp"
#include "geometry/gdml/write/materials.hpp"
#include "geometry/gdml/write/solids.hpp"
#include "geometry/model/order.hpp"
#include "navjit/gdml.hpp"

namespace navjit {
namespace {

using namespace gdml;

void append(std::string& out, const Auxiliary& tag, const std::string& indent) {
  out += indent + "<auxiliary" + attribute("auxtype", tag.type) + attribute("auxvalue", tag.value);
  if (!tag.unit.empty()) out += attribute("auxunit", tag.unit);
  if (tag.children.empty()) {
    out += "/>\n";
    return;
  }
  out += ">\n";
  for (const Auxiliary& child : tag.children) append(out, child, indent + "  ");
  out += indent + "</auxiliary>\n";
}

/// The same for regions: the volumes that they name have the names that they are written by, which
/// may be several for volumes of one name.
using WrittenNames = std::map<std::string, std::vector<std::string>>;
Auxiliary with_written_names(const Auxiliary& tag, const WrittenNames& written) {
  Auxiliary made = tag;
  made.children.clear();
  for (const Auxiliary& child : tag.children) {
    const auto found = child.type == "volume" ? written.find(child.value) : written.end();
    if (found == written.end()) {
      made.children.push_back(with_written_names(child, written));
      continue;
    }
    for (const std::string& name : found->second) {
      made.children.push_back(child);
      made.children.back().value = name;
    }
  }
  return made;
}

void append(std::string& out, const Auxiliaries& tags, const std::string& indent) {
  if (!tags) return;
  for (const Auxiliary& tag : *tags) append(out, tag, indent);
}

/// Readers take what a placement's name has in brackets for an index: V[1] would be read as V_0.
std::string without_brackets(std::string name) {
  std::replace(name.begin(), name.end(), '[', '(');
  std::replace(name.begin(), name.end(), ']', ')');
  return name;
}

void append_placement(std::string& out, const Placement& placement, const std::string& volume,
                      const std::string& frame) {
  out += "      <physvol";
  if (!placement.name.empty()) out += attribute("name", without_brackets(placement.name));
  if (placement.copy_number != 0) {
    out += attribute("copynumber", std::to_string(placement.copy_number));
  }
  out += "><volumeref" + attribute("ref", volume) + "/>" +
         placement_text(frame, placement.transformation);
  if (placement.auxiliaries) {
    out += '\n';
    append(out, placement.auxiliaries, "        ");
    out += "      ";
  }
  out += "</physvol>\n";
}

}  // namespace

std::string gdml_text(const Detector& detector) {
  const World& world = *detector.model();
  const WrittenMaterials materials = write_materials(world);
  SolidWriter solids;
  NameBook names;
  std::vector<std::string> volumes(world.volumes.size());
  WrittenNames written;
  std::string structure;
  for (const VolumeId id : daughters_first(world)) {
    const LogicalVolume& volume = world.volumes[id];
    volumes[id] = names.own(volume.name);
    written[volume.name].push_back(volumes[id]);
    const std::string solid = solids.add(volume.solid);
    structure += "    <volume" + attribute("name", volumes[id]) + ">\n";
    const bool has_material =
        volume.material < world.materials.size() && !materials.names[volume.material].empty();
    if (has_material) {
      structure +=
          "      <materialref" + attribute("ref", materials.names[volume.material]) + "/>\n";
    }
    structure += "      <solidref" + attribute("ref", solid) + "/>\n";
    for (std::size_t k = 0; k < volume.daughters.size(); ++k) {
      const Placement& placement = volume.daughters[k];
      append_placement(structure, placement, volumes[placement.volume],
                       volumes[id] + "_" + std::to_string(k));
    }
    append(structure, volume.auxiliaries, "      ");
    structure += "    </volume>\n";
  }
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<gdml xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:noNamespaceSchemaLocation=\"http://service-spi.web.cern.ch/service-spi/app/releases/"
      "GDML/schema/gdml.xsd\">\n";
  out += "  <define>\n" + solids.definitions() + "  </define>\n";
  out += "  <materials>\n" + materials.text + "  </materials>\n";
  out += "  <solids>\n" + solids.solids() + "  </solids>\n";
  out += "  <structure>\n" + structure + "  </structure>\n";
  if (world.auxiliaries) {
    out += "  <userinfo>\n";
    for (const Auxiliary& tag : *world.auxiliaries) {
      append(out, with_written_names(tag, written), "    ");
    }
    out += "  </userinfo>\n";
  }
  out += "  <setup name=\"Default\" version=\"1.0\"><world" + attribute("ref", volumes[world.top]) +
         "/></setup>\n</gdml>\n";
  return out;
}

}  // namespace navjit

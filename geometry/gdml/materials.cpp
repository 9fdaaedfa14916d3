// <materials>: names and densities. Isotopes and elements say nothing about the geometry.
#include "geometry/gdml/context.hpp"

namespace navjit::gdml {
namespace {

/// g/cm3; 0 where the file gives none.
double read_density(FileContext& file, const XmlElement& material) {
  for (const XmlElement& child : material.children()) {
    if (child.tag == "D") {
      return file.number(child, "value", 0) * file.unit(child, "unit", Dimension::density);
    }
    if (child.tag == "Dref") {
      const std::string name = file.reference(child);
      const auto quantity = file.quantities.find(name);
      // A quantity with a unit is kept in that unit's system; densities are kept in g/cm3.
      if (quantity != file.quantities.end()) return quantity->second;
    }
  }
  return 0;
}

}  // namespace

void read_materials(FileContext& file, const XmlElement& section) {
  for (const XmlElement& element : section.children()) {
    file.charge(element);
    if (element.tag == "loop") {
      file.loop(element, [&] { read_materials(file, element); });
    } else if (element.tag == "define") {
      read_define(file, element);
    } else if (element.tag == "material") {
      const std::string name = file.name(element);
      auto& materials = file.session.world.materials;
      const auto index = static_cast<std::uint32_t>(materials.size());
      materials.push_back({name, read_density(file, element)});
      file.define(file.materials, "material", name, index);
    } else {
      file.note("skipped <" + printable(element.tag) + "> in <materials>");
    }
  }
}

}  // namespace navjit::gdml

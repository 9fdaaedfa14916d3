#include "geometry/gdml/write/materials.hpp"

#include <optional>

#include "geometry/gdml/write/xml_text.hpp"
#include "geometry/model/vacuum.hpp"

namespace navjit::gdml {
namespace {

std::string quantity(const char* tag, double value, const char* unit) {
  return '<' + std::string(tag) + attributes({{"value", value}}) + attribute("unit", unit) + "/>";
}

std::string state_text(MaterialState state) {
  switch (state) {
    case MaterialState::undefined:
      return "";
    case MaterialState::solid:
      return attribute("state", "solid");
    case MaterialState::liquid:
      return attribute("state", "liquid");
    case MaterialState::gas:
      return attribute("state", "gas");
  }
  return "";
}

/// Whether the material was given by its Z, so that its element was made with it.
bool is_own_element(const World& world, const Material& material) {
  if (material.elements.size() != 1) return false;
  const Element& element = world.elements[material.elements[0].element];
  return element.name == material.name && element.isotopes.empty();
}

/// Whether it is a vacuum without elements: Geant4 takes no material without elements.
bool is_vacuum(const Material& material) {
  return material.elements.empty() && material.density > 0 &&
         material.density <= most_density_of_vacuum;
}
/// The element that stands for that of a vacuum, as in Geant4's own vacuum: hydrogen.
const Element thin_gas{.name = "H", .z = 1, .a = 1.00794};

}  // namespace

WrittenMaterials write_materials(const World& world) {
  WrittenMaterials made;
  NameBook names;
  std::vector<std::string> elements(world.elements.size()), isotopes;
  for (const Material& material : world.materials) {
    made.names.push_back(material.name.empty() ? "" : names.own(material.name));
  }
  // Elements that are made with a material are referred to by its name; no other has that name.
  // What refers to them has to come after them.
  std::vector<bool> comes(world.elements.size()), in_use(world.elements.size());
  for (std::size_t m = 0; m < world.materials.size(); ++m) {
    const Material& material = world.materials[m];
    const bool own = is_own_element(world, material) && !made.names[m].empty();
    const std::uint32_t element = own ? material.elements[0].element : 0;
    if (own && !comes[element] && !in_use[element]) {
      comes[element] = true;
      elements[element] = made.names[m];
    }
    for (const ElementShare& share : material.elements) in_use[share.element] = true;
  }
  NameBook isotope_names;
  std::string& out = made.text;
  for (const Isotope& isotope : world.isotopes) {
    isotopes.push_back(isotope_names.own(isotope.name));
    out += "    <isotope" + attribute("name", isotopes.back()) +
           attributes({{"Z", isotope.z}, {"N", isotope.nucleons}}) + '>' +
           quantity("atom", isotope.a, "g/mole") + "</isotope>\n";
  }
  for (std::size_t e = 0; e < world.elements.size(); ++e) {
    if (comes[e]) continue;
    const Element& element = world.elements[e];
    elements[e] = names.own(element.name);
    out += "    <element" + attribute("name", elements[e]);
    if (!element.formula.empty()) out += attribute("formula", element.formula);
    if (element.isotopes.empty()) {
      out += attributes({{"Z", element.z}}) + '>' + quantity("atom", element.a, "g/mole");
    } else {
      out += '>';
      for (const IsotopeShare& share : element.isotopes) {
        out += "<fraction" + attributes({{"n", share.abundance}}) +
               attribute("ref", isotopes[share.isotope]) + "/>";
      }
    }
    out += "</element>\n";
  }
  for (std::size_t m = 0; m < world.materials.size(); ++m) {
    const Material& material = world.materials[m];
    // Materials of Geant4's own table are known there by name.
    const bool known_elsewhere =
        material.density == 0 && material.elements.empty() && material.name.starts_with("G4_");
    if (made.names[m].empty() || known_elsewhere) continue;
    const bool alone =
        is_own_element(world, material) && elements[material.elements[0].element] == made.names[m];
    out += "    <material" + attribute("name", made.names[m]) + state_text(material.state);
    const Element* const element = alone ? &world.elements[material.elements[0].element]
                                   : is_vacuum(material) ? &thin_gas
                                                         : nullptr;
    if (element != nullptr) {
      if (!element->formula.empty()) out += attribute("formula", element->formula);
      out += attributes({{"Z", element->z}});
    }
    out += '>';
    const Material usual{};
    if (material.temperature != usual.temperature) out += quantity("T", material.temperature, "K");
    if (material.pressure != usual.pressure) out += quantity("P", material.pressure, "pascal");
    out += quantity("D", material.density, "g/cm3");
    if (element != nullptr) {
      out += quantity("atom", element->a, "g/mole");
    } else {
      for (const ElementShare& share : material.elements) {
        out += "<fraction" + attributes({{"n", share.fraction}}) +
               attribute("ref", elements[share.element]) + "/>";
      }
    }
    out += "</material>\n";
  }
  return made;
}

}  // namespace navjit::gdml

// <materials>: isotopes, elements, and materials with their densities, states and radiation
// lengths.
#include <algorithm>
#include <cmath>

#include "geometry/gdml/context.hpp"
#include "geometry/model/radiation_length.hpp"

namespace navjit::gdml {
namespace {

/// More than any material is made of; bounds what mixtures of mixtures cost.
constexpr std::size_t most_components = 120;

double unit_value(std::string_view name) { return find_unit(name)->value; }

/// The value of the element's child `tag`, or of the quantity that `tag`ref names, in `unit`.
std::optional<double> read_quantity(FileContext& file, const XmlElement& element,
                                    const std::string& tag, std::string_view unit) {
  for (const XmlElement& child : element.children()) {
    if (child.tag == tag) {
      const double named = file.unit(child, "unit", Dimension::other, unit_value(unit));
      return file.number(child, "value", 0) * named / unit_value(unit);
    }
    if (child.tag == tag + "ref") {
      const auto quantity = file.quantities.find(file.reference(child));
      if (quantity != file.quantities.end()) return quantity->second / unit_value(unit);
    }
  }
  return std::nullopt;
}

/// g/cm3; 0 where the file gives none.
double read_density(FileContext& file, const XmlElement& material) {
  for (const XmlElement& child : material.children()) {
    if (child.tag == "D") file.unit(child, "unit", Dimension::density);
  }
  return read_quantity(file, material, "D", "g/cm3").value_or(0);
}

double molar_mass(FileContext& file, const XmlElement& element) {
  return read_quantity(file, element, "atom", "g/mole").value_or(0);
}

void merge(Components& all, const MaterialComponent& one) {
  for (MaterialComponent& c : all) {
    if (c.z == one.z && c.a == one.a) {
      c.fraction += one.fraction;
      return;
    }
  }
  all.push_back(one);
}

/// Nothing if it is too much, or of no mass.
Components normalised(Components all) {
  double mass = 0;
  for (const MaterialComponent& c : all) mass += c.fraction;
  if (!(mass > 0) || !std::isfinite(mass) || all.size() > most_components) return {};
  for (MaterialComponent& c : all) c.fraction /= mass;
  return all;
}

void read_isotope(FileContext& file, const XmlElement& element) {
  file.define(file.isotopes, element, "isotope", file.name(element),
              MaterialComponent{file.number(element, "Z", 0), molar_mass(file, element), 1});
}

/// An element given by its isotopes counts as one nuclide of the mean mass.
void read_element(FileContext& file, const XmlElement& element) {
  double z = file.number(element, "Z", 0), a = molar_mass(file, element), sum = 0, mass = 0;
  for (const XmlElement& child : element.children()) {
    if (child.tag != "fraction") continue;
    const auto isotope = file.isotopes.find(file.reference(child));
    if (isotope == file.isotopes.end()) continue;
    const double n = file.number(child, "n");
    z = isotope->second.z;
    sum += n;
    mass += n * isotope->second.a;
  }
  if (sum > 0) a = mass / sum;
  file.define(file.elements, element, "element", file.name(element), MaterialComponent{z, a, 1});
}

/// What a material is made of, by mass. Empty if some of it is not known.
Components read_components(FileContext& file, const XmlElement& material) {
  Components all;
  for (const XmlElement& child : material.children()) {
    const bool by_mass = child.tag == "fraction";
    if (!by_mass && child.tag != "composite") continue;
    const double n = file.number(child, "n");
    const std::string name = file.reference(child);
    const auto element = file.elements.find(name);
    const auto other = file.compositions.find(name);
    if (element != file.elements.end()) {
      MaterialComponent c = element->second;
      c.fraction = by_mass ? n : n * c.a;
      merge(all, c);
    } else if (by_mass && other != file.compositions.end() && !other->second.empty()) {
      for (MaterialComponent c : other->second) {
        c.fraction *= n;
        merge(all, c);
      }
    } else {
      return {};
    }
    if (all.size() > most_components) return {};
  }
  if (all.empty() && material.find("Z")) {
    all.push_back({file.number(material, "Z"), molar_mass(file, material), 1});
  }
  return normalised(std::move(all));
}

void read_material(FileContext& file, const XmlElement& element) {
  const std::string name = file.name(element);
  Material material{name, read_density(file, element)};
  const std::string_view state = element.find("state").value_or("");
  material.state = state == "solid"    ? MaterialState::solid
                   : state == "liquid" ? MaterialState::liquid
                   : state == "gas"    ? MaterialState::gas
                                       : MaterialState::undefined;
  material.temperature = read_quantity(file, element, "T", "K").value_or(material.temperature);
  material.pressure = read_quantity(file, element, "P", "pascal").value_or(material.pressure);
  Components components = read_components(file, element);
  const double per_area = radiation_length(components);
  if (per_area > 0 && material.density > 0) {
    material.radiation_length = per_area / material.density * 10;
  } else {
    file.skip("gave no radiation length to a material of unknown density or composition");
  }
  auto& materials = file.session.world.materials;
  const auto index = static_cast<std::uint32_t>(materials.size());
  materials.push_back(std::move(material));
  file.define(file.compositions, element, "material", name, std::move(components));
  file.materials.try_emplace(name, index);
}

/// What materials are made of is read before them: some files give it only afterwards.
constexpr struct {
  std::string_view tag;
  ElementReader read;
} first_readers[] = {{"define", read_define}, {"isotope", read_isotope}, {"element", read_element}};

}  // namespace

void read_materials(FileContext& file, const XmlElement& section) {
  for (const auto& reader : first_readers) {
    for (const XmlElement& element : section.children()) {
      if (element.tag == reader.tag) reader.read(file, element);
    }
  }
  for (const XmlElement& element : section.children()) {
    file.charge(element);
    if (element.tag == "loop") {
      file.loop(element, [&] { read_materials(file, element); });
    } else if (element.tag == "material") {
      read_material(file, element);
    } else if (std::none_of(std::begin(first_readers), std::end(first_readers),
                            [&](const auto& r) { return r.tag == element.tag; })) {
      file.skip("skipped <" + printable(element.tag) + "> in <materials>");
    }
  }
}

}  // namespace navjit::gdml

// <materials>: isotopes, elements, and materials with their densities, states and radiation
// lengths. What cannot be read counts as not given, since no step depends on it.
#include <algorithm>
#include <cmath>

#include "geometry/gdml/context.hpp"
#include "navjit/material.hpp"

namespace navjit::gdml {
namespace {

/// More components than any material has; bounds what mixtures of mixtures cost.
constexpr std::size_t most_components = 120;

double unit_value(std::string_view name) { return find_unit(name)->value; }

/// What `read` makes of an element; nothing, with a note, if the element cannot be read.
template <class F>
auto if_readable(FileContext& file, const XmlElement& element, F&& read)
    -> std::optional<decltype(read())> {
  try {
    return at_element(element, read);
  } catch (const GdmlRefusal&) {
    throw;
  } catch (const GdmlError& e) {
    file.leave_out(element, e.what());
    return std::nullopt;
  }
}

/// A number that must not be negative.
std::optional<double> number_of(FileContext& file, const XmlElement& element,
                                const std::string& attribute) {
  return if_readable(file, element, [&] {
    const double value = file.number(element, attribute);
    if (value < 0) fail(element, attribute + ": it is negative");
    return value;
  });
}

/// The value, in `unit`, of the element's child `tag`, or of the quantity that `tag`ref names.
/// Nothing if it is negative.
std::optional<double> read_quantity(FileContext& file, const XmlElement& element,
                                    const std::string& tag, std::string_view unit,
                                    Dimension dimension) {
  const auto read = [&](const XmlElement& child) {
    double value = 0;
    if (child.tag == tag) {
      const double named = file.unit(child, "unit", dimension, unit_value(unit));
      value = file.number(child, "value", 0) * named;
    } else {
      const std::string name = file.reference(child);
      const auto quantity = file.quantities.find(name);
      if (quantity == file.quantities.end()) {
        fail(child, "quantity '" + printable(name) + "' is not defined; define it before its use");
      }
      value = quantity->second;
    }
    value /= unit_value(unit);
    if (!(value >= 0 && value <= 1e30)) fail(child, "no such value is possible; check its unit");
    return value;
  };
  for (const XmlElement& child : element.children()) {
    if (child.tag != tag && child.tag != tag + "ref") continue;
    if (const auto value = if_readable(file, child, [&] { return read(child); })) return value;
  }
  return std::nullopt;
}

/// The density in g/cm3; 0 where the file gives none.
double read_density(FileContext& file, const XmlElement& material) {
  return read_quantity(file, material, "D", "g/cm3", Dimension::density).value_or(0);
}

/// The molar mass in g/mole; 0 where the file gives none. Units of mass serve as well.
double molar_mass(FileContext& file, const XmlElement& element) {
  return read_quantity(file, element, "atom", "g/mole", Dimension::other).value_or(0);
}

/// 0 where the file gives none.
double optional_number(FileContext& file, const XmlElement& element, const std::string& attribute) {
  return element.find(attribute) ? number_of(file, element, attribute).value_or(0) : 0;
}

void merge(std::vector<ElementShare>& all, const ElementShare& one) {
  for (ElementShare& share : all) {
    if (share.element == one.element) {
      share.fraction += one.fraction;
      return;
    }
  }
  all.push_back(one);
}

/// The shares, made to add up to one; nothing if they are too many, or have no mass.
std::vector<ElementShare> normalised(std::vector<ElementShare> all) {
  double mass = 0;
  for (const ElementShare& share : all) mass += share.fraction;
  if (!(mass > 0) || !std::isfinite(mass) || all.size() > most_components) return {};
  for (ElementShare& share : all) share.fraction /= mass;
  return all;
}

/// Adds a definition to the world's list and under its name.
template <class T>
void define_in(FileContext& file, std::vector<T>& all,
               Definitions<std::uint32_t> FileContext::*definitions, const XmlElement& element,
               T value) {
  const auto index = static_cast<std::uint32_t>(all.size());
  file.define(file.*definitions, element, std::string(element.tag), value.name, index);
  all.push_back(std::move(value));
}

/// The same; it is found also by its name without an address.
template <class T>
void define_in(FileContext& file, std::vector<T>& all,
               Definitions<std::uint32_t> FileContext::*definitions,
               Definitions<std::uint32_t> FileContext::*by_bare_name, const XmlElement& element,
               T value) {
  (file.*by_bare_name).try_emplace(bare_name(value.name), static_cast<std::uint32_t>(all.size()));
  define_in(file, all, definitions, element, std::move(value));
}

void read_isotope(FileContext& file, const XmlElement& element) {
  Isotope isotope{.name = file.name(element),
                  .z = optional_number(file, element, "Z"),
                  .nucleons = optional_number(file, element, "N"),
                  .a = molar_mass(file, element)};
  define_in(file, file.session.world.isotopes, &FileContext::isotopes, element, std::move(isotope));
}

/// An element that is given by its isotopes has their mean mass.
void read_element(FileContext& file, const XmlElement& element) {
  const World& world = file.session.world;
  Element made{.name = file.name(element),
               .formula = std::string(element.find("formula").value_or("")),
               .z = optional_number(file, element, "Z"),
               .a = molar_mass(file, element)};
  double sum = 0, mass = 0;
  for (const XmlElement& child : element.children()) {
    if (child.tag != "fraction") continue;
    file.charge(child);
    const std::uint32_t* isotope = file.find(&FileContext::isotopes, file.reference(child));
    const auto n = number_of(file, child, "n");
    if (isotope == nullptr || !n) continue;
    made.isotopes.push_back({*isotope, *n});
    made.z = world.isotopes[*isotope].z;
    sum += *n;
    mass += *n * world.isotopes[*isotope].a;
  }
  if (sum > 0) made.a = mass / sum;
  define_in(file, file.session.world.elements, &FileContext::elements,
            &FileContext::elements_by_bare_name, element, std::move(made));
}

/// What a material is made of, by mass. Empty if a part of it is not known.
std::vector<ElementShare> read_shares(FileContext& file, const XmlElement& material,
                                      const std::string& material_name) {
  World& world = file.session.world;
  std::vector<ElementShare> all;
  for (const XmlElement& child : material.children()) {
    const bool by_mass = child.tag == "fraction";
    if (!by_mass && child.tag != "composite") continue;
    file.charge(child);
    const auto n = number_of(file, child, "n");
    if (!n) return {};
    const std::string name = file.reference(child);
    const std::uint32_t* element = find_element_named(file, name);
    const std::uint32_t* other = find_material_named(file, name);
    if (element != nullptr) {
      merge(all, {*element, by_mass ? *n : *n * world.elements[*element].a});
    } else if (by_mass && other != nullptr && !world.materials[*other].elements.empty()) {
      for (const ElementShare& share : world.materials[*other].elements) {
        merge(all, {share.element, share.fraction * *n});
      }
    } else {
      return {};
    }
    if (all.size() > most_components) return {};
  }
  if (all.empty() && material.find("Z")) {
    all.push_back({static_cast<std::uint32_t>(world.elements.size()), 1});
    world.elements.push_back({.name = material_name,
                              .formula = std::string(material.find("formula").value_or("")),
                              .z = optional_number(file, material, "Z"),
                              .a = molar_mass(file, material)});
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
  material.temperature =
      read_quantity(file, element, "T", "K", Dimension::temperature).value_or(material.temperature);
  material.pressure =
      read_quantity(file, element, "P", "pascal", Dimension::pressure).value_or(material.pressure);
  material.elements = if_readable(file, element, [&] {
                        return read_shares(file, element, name);
                      }).value_or(std::vector<ElementShare>{});
  const double per_area = radiation_length(file.session.world, material.elements);
  if (per_area > 0 && material.density > 0) {
    material.radiation_length = per_area / material.density * 10;
  } else {
    file.skip("gave no radiation length to a material of unknown density or composition");
  }
  define_in(file, file.session.world.materials, &FileContext::materials,
            &FileContext::materials_by_bare_name, element, std::move(material));
}

/// These are read before materials: some files give them only after the materials.
constexpr struct {
  std::string_view tag;
  ElementReader read;
} first_readers[] = {{"define", read_define}, {"isotope", read_isotope}, {"element", read_element}};

}  // namespace

std::uint32_t* find_material_named(FileContext& file, const std::string& name) {
  if (std::uint32_t* found = file.find(&FileContext::materials, name)) return found;
  return file.find(&FileContext::materials_by_bare_name, bare_name(name));
}

std::uint32_t* find_element_named(FileContext& file, const std::string& name) {
  if (std::uint32_t* found = file.find(&FileContext::elements, name)) return found;
  return file.find(&FileContext::elements_by_bare_name, bare_name(name));
}

void read_materials(FileContext& file, const XmlElement& section) {
  for (const auto& reader : first_readers) {
    for (const XmlElement& element : section.children()) {
      if (element.tag != reader.tag) continue;
      file.define_if_readable(element, reader.tag == "define" ? "section" : std::string(reader.tag),
                              [&] { reader.read(file, element); });
    }
  }
  for (const XmlElement& element : section.children()) {
    file.charge(element);
    if (element.tag == "loop") {
      file.define_if_readable(element, "loop",
                              [&] { file.loop(element, [&] { read_materials(file, element); }); });
    } else if (element.tag == "material") {
      file.define_if_readable(element, "material", [&] { read_material(file, element); });
    } else if (std::none_of(std::begin(first_readers), std::end(first_readers),
                            [&](const auto& r) { return r.tag == element.tag; })) {
      file.skip("skipped <" + printable(element.tag) + "> in <materials>");
    }
  }
}

}  // namespace navjit::gdml

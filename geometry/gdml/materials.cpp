// <materials>: isotopes, elements, and materials with their densities, states and radiation
// lengths. What cannot be read of them counts as not given: no step depends on it.
#include <algorithm>
#include <cmath>

#include "geometry/gdml/context.hpp"
#include "geometry/model/radiation_length.hpp"

namespace navjit::gdml {
namespace {

/// More than any material is made of; bounds what mixtures of mixtures cost.
constexpr std::size_t most_components = 120;

double unit_value(std::string_view name) { return find_unit(name)->value; }

/// What `read` makes of an element; nothing, and a note, where it cannot be read.
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

/// A number that is not negative.
std::optional<double> number_of(FileContext& file, const XmlElement& element,
                                const std::string& attribute) {
  return if_readable(file, element, [&] {
    const double value = file.number(element, attribute);
    if (value < 0) fail(element, attribute + ": it is negative");
    return value;
  });
}

/// The value of the element's child `tag`, or of the quantity that `tag`ref names, in `unit`.
/// Nothing where it is negative.
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

/// g/cm3; 0 where the file gives none.
double read_density(FileContext& file, const XmlElement& material) {
  return read_quantity(file, material, "D", "g/cm3", Dimension::density).value_or(0);
}

/// g/mole; 0 where the file gives none. Units of mass do as well.
double molar_mass(FileContext& file, const XmlElement& element) {
  return read_quantity(file, element, "atom", "g/mole", Dimension::other).value_or(0);
}

double atomic_number(FileContext& file, const XmlElement& element) {
  return element.find("Z") ? number_of(file, element, "Z").value_or(0) : 0;
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
              MaterialComponent{atomic_number(file, element), molar_mass(file, element), 1});
}

/// An element given by its isotopes counts as one nuclide of the mean mass.
void read_element(FileContext& file, const XmlElement& element) {
  double z = atomic_number(file, element), a = molar_mass(file, element), sum = 0, mass = 0;
  for (const XmlElement& child : element.children()) {
    if (child.tag != "fraction") continue;
    const std::string isotope_name = file.reference(child);
    const MaterialComponent* isotope = file.find(&FileContext::isotopes, isotope_name);
    const auto n = number_of(file, child, "n");
    if (isotope == nullptr || !n) continue;
    z = isotope->z;
    sum += *n;
    mass += *n * isotope->a;
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
    const auto n = number_of(file, child, "n");
    if (!n) return {};
    const std::string name = file.reference(child);
    const MaterialComponent* element = file.find(&FileContext::elements, name);
    const Components* other = file.find(&FileContext::compositions, name);
    if (element != nullptr) {
      MaterialComponent c = *element;
      c.fraction = by_mass ? *n : *n * c.a;
      merge(all, c);
    } else if (by_mass && other != nullptr && !other->empty()) {
      for (MaterialComponent c : *other) {
        c.fraction *= *n;
        merge(all, c);
      }
    } else {
      return {};
    }
    if (all.size() > most_components) return {};
  }
  if (all.empty() && material.find("Z")) {
    all.push_back({atomic_number(file, material), molar_mass(file, material), 1});
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
  Components components = if_readable(file, element, [&] {
                            return read_components(file, element);
                          }).value_or(Components{});
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

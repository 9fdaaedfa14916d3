// ROOT's media, materials, elements and isotopes.
#include <cmath>

#include "geometry/model/vacuum.hpp"
#include "geometry/root/reading.hpp"

namespace navjit::root {
namespace {

constexpr std::size_t most_components = 10'000;
constexpr double density_of_space = 1e-25;  ///< between galaxies, g/cm3, as in Geant4

/// A value that is no positive number is taken as not known; the file is still read.
double or_zero(double value) { return std::isfinite(value) && value > 0 ? value : 0; }

std::uint32_t add_element(Reading& reading, Element element) {
  const auto [found, added] =
      reading.elements.try_emplace({element.name, element.z, element.a},
                                   static_cast<std::uint32_t>(reading.world.elements.size()));
  if (added) reading.world.elements.push_back(std::move(element));
  return found->second;
}

/// `a` is the molar mass where the element itself gives none.
std::uint32_t read_element(Reading& reading, const Object& given, double a) {
  Element element{.name = given.name, .formula = given.name, .z = or_zero(given.number("fZ", 0))};
  const double own = or_zero(given.number("fA", 0));
  element.a = own > 0 ? own : a;
  const auto known = reading.elements.find({element.name, element.z, element.a});
  if (known != reading.elements.end()) return known->second;
  const std::size_t count = given.count("fNisotopes", most_components);
  const std::vector<Reference> isotopes =
      count == 0 ? std::vector<Reference>{} : reading.objects.list(given.reference("fIsotopes"));
  if (count > 0 && isotopes.size() >= count) {
    const std::span<const double> abundances = given.numbers("fAbundances", count);
    for (std::size_t i = 0; i < count; ++i) {
      if (isotopes[i] == 0) continue;
      const Object& isotope = reading.objects.at(isotopes[i]);
      element.isotopes.push_back(
          {static_cast<std::uint32_t>(reading.world.isotopes.size()), or_zero(abundances[i])});
      reading.world.isotopes.push_back({.name = isotope.name,
                                        .z = or_zero(isotope.number("fZ", 0)),
                                        .nucleons = or_zero(isotope.number("fN", 0)),
                                        .a = or_zero(isotope.number("fA", 0))});
    }
  }
  return add_element(reading, std::move(element));
}

std::vector<ElementShare> shares_of_mixture(Reading& reading, const Object& mixture) {
  const std::size_t count = mixture.count("fNelements", most_components);
  const std::span<const double> z = mixture.numbers("fZmixture", count),
                                a = mixture.numbers("fAmixture", count),
                                weights = mixture.numbers("fWeights", count);
  const std::vector<Reference> elements = reading.objects.list(mixture.reference("fElements"));
  std::vector<ElementShare> shares;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t element =
        i < elements.size() && elements[i] != 0
            ? read_element(reading, reading.objects.at(elements[i]), or_zero(a[i]))
            : add_element(reading, {.name = mixture.name + "_" + std::to_string(i),
                                    .z = or_zero(z[i]),
                                    .a = or_zero(a[i])});
    shares.push_back({element, or_zero(weights[i])});
    sum += shares.back().fraction;
  }
  if (!(sum > 0 && std::isfinite(sum))) return {};
  for (ElementShare& share : shares) share.fraction /= sum;
  return shares;
}

std::vector<ElementShare> shares_of(Reading& reading, const Object& material) {
  if (material.is("TGeoMixture")) return shares_of_mixture(reading, material);
  const double z = or_zero(material.number("fZ", 0)), a = or_zero(material.number("fA", 0));
  if (const Reference element = material.reference("fElement")) {
    const Object& given = reading.objects.at(element);
    // An effective charge is not that of an element.
    if (given.number("fZ", 0) == z) return {{read_element(reading, given, a), 1}};
  }
  if (z < 0.5 || a == 0) return {};
  return {{add_element(reading, {.name = material.name, .z = z, .a = a}), 1}};
}

Material make(Reading& reading, const Object& given) {
  Material material{given.name, or_zero(given.number("fDensity", 0))};
  const double state = given.number("fState", 0);
  if (state == 1 || state == 2 || state == 3) {
    material.state = static_cast<MaterialState>(static_cast<int>(state));
  }
  if (const double kelvin = or_zero(given.number("fTemperature", 0)); kelvin > 0) {
    material.temperature = kelvin;
  }
  material.elements = shares_of(reading, given);
  // ROOT gives no radiation length to a material whose A or Z is less than this, whatever its
  // density: it is a vacuum. A density of 0 would mean that it is not known.
  constexpr double least = 0.9;
  if (!given.is("TGeoMixture") &&
      (given.number("fZ", 0) < least || given.number("fA", 0) < least)) {
    if (material.density > most_density_of_vacuum) {
      reading.notes.count("materials without charge or mass have a density: taken as a vacuum");
    }
    if (!(material.density > 0 && material.density <= most_density_of_vacuum)) {
      material.density = density_of_space;
    }
  }
  const double per_area = navjit::radiation_length(reading.world, material.elements);
  constexpr double no_interaction = 1e20;  // ROOT's value for a vacuum
  const double own = std::abs(given.number("fRadLen", 0));
  if (per_area > 0 && material.density > 0) {
    material.radiation_length = per_area / material.density * cm;
  } else if (own > 0 && own < no_interaction) {
    material.radiation_length = own * cm;
  }
  return material;
}

}  // namespace

std::uint32_t read_material(Reading& reading, Reference medium) {
  const Reference reference = medium == 0 ? 0 : reading.objects.at(medium).reference("fMaterial");
  const auto [known, added] = reading.materials.try_emplace(
      reference, static_cast<std::uint32_t>(reading.world.materials.size()));
  const std::uint32_t number = known->second;
  if (!added) return number;
  Material material = reference == 0 ? Material{} : make(reading, reading.objects.at(reference));
  reading.world.materials.push_back(std::move(material));
  return number;
}

}  // namespace navjit::root

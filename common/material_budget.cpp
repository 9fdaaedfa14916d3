#include "common/material_budget.hpp"

#include <cmath>

namespace navjit::common {

double interaction_length(const World& world, const Material& material) {
  double inverse = 0;
  for (const ElementShare& share : material.elements) {
    const double a = share.element < world.elements.size() ? world.elements[share.element].a : 0;
    if (!(a > 0)) return 0;
    inverse += share.fraction / (35 * std::cbrt(a));
  }
  return inverse > 0 ? 1 / inverse : 0;
}

MaterialRates rates_of(const World& world, const Material& material) {
  MaterialRates rates;
  if (material.radiation_length > 0) rates.radiation_lengths = 1 / material.radiation_length;
  rates.mass = material.density / 10;  // of g/cm3 and mm
  const double length = interaction_length(world, material);
  if (length > 0) rates.interaction_lengths = rates.mass / length;
  return rates;
}

std::vector<MaterialRates> material_rates(const World& world) {
  std::vector<MaterialRates> rates(world.volumes.size());
  for (std::size_t v = 0; v < rates.size(); ++v) {
    const std::uint32_t number = world.volumes[v].material;
    if (number < world.materials.size()) rates[v] = rates_of(world, world.materials[number]);
  }
  return rates;
}

}  // namespace navjit::common

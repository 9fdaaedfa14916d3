#include "navjit/material.hpp"

#include <cmath>

#include "geometry/model/world.hpp"

namespace navjit {

double radiation_length(double z, double a) {
  if (!(z >= 0.5 && a > 0 && z < 1000 && std::isfinite(a))) return 0;
  // Logarithms of what screens the field of the nucleus, and that of its electrons. The statistical
  // model does not describe light atoms.
  struct Logarithms {
    double nucleus, electrons;
  };
  constexpr Logarithms light[] = {{5.31, 6.144}, {4.79, 5.621}, {4.74, 5.805}, {4.71, 5.924}};
  const auto nearest = static_cast<int>(std::lround(z));
  const Logarithms l = nearest <= 4 ? light[nearest - 1]
                                    : Logarithms{std::log(184.15) - std::log(z) / 3,
                                                 std::log(1194.0) - 2 * std::log(z) / 3};
  constexpr double fine_structure = 1 / 137.035999084;
  const double b = (fine_structure * z) * (fine_structure * z);
  const double coulomb = b * (1 / (1 + b) + 0.20206 + b * (-0.0369 + b * (0.0083 - 0.002 * b)));
  constexpr double grams_per_cm2 = 716.408;  // 1 / (4 alpha r_e^2 N_A), times 1 g/mol
  return grams_per_cm2 * a / (z * z * (l.nucleus - coulomb) + z * l.electrons);
}

double radiation_length(std::span<const MaterialComponent> components) {
  double mass = 0, inverse = 0;
  for (const MaterialComponent& c : components) {
    const double length = radiation_length(c.z, c.a);
    if (!(length > 0)) return 0;
    mass += c.fraction;
    inverse += c.fraction / length;
  }
  const double length = mass / inverse;
  return length > 0 && std::isfinite(length) ? length : 0;
}

double radiation_length(const World& world, std::span<const ElementShare> shares) {
  std::vector<MaterialComponent> components;
  for (const ElementShare& share : shares) {
    const Element& element = world.elements[share.element];
    components.push_back({element.z, element.a, share.fraction});
  }
  return radiation_length(components);
}

}  // namespace navjit

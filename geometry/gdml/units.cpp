#include "geometry/gdml/units.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>

namespace navjit::gdml {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double mm = 1, m = 1e3, cm = 10, km = 1e6;
constexpr double um = 1e-6 * m, nm = 1e-9 * m;
constexpr double s = 1e9, ev = 1e-6, e_si = 1.602176634e-19;
constexpr double joule = ev / e_si, kg = joule * s * s / (m * m), gram = 1e-3 * kg;
constexpr double coulomb = 1 / e_si, volt = 1e-6, pascal = joule / (m * m * m);

// The frequent ones first: the search is linear.
constexpr Unit units[] = {
    {"mm", mm, Dimension::length},
    {"cm", cm, Dimension::length},
    {"deg", pi / 180, Dimension::angle},
    {"rad", 1, Dimension::angle},
    {"degree", pi / 180, Dimension::angle},
    {"radian", 1, Dimension::angle},
    {"m", m, Dimension::length},
    {"um", um, Dimension::length},
    {"nm", nm, Dimension::length},
    {"km", km, Dimension::length},
    {"millimeter", mm, Dimension::length},
    {"centimeter", cm, Dimension::length},
    {"decimeter", 0.1 * m, Dimension::length},
    {"meter", m, Dimension::length},
    {"metre", m, Dimension::length},
    {"kilometer", km, Dimension::length},
    {"micrometer", um, Dimension::length},
    {"micron", um, Dimension::length},
    {"nanometer", nm, Dimension::length},
    {"angstrom", 1e-10 * m, Dimension::length},
    {"Ang", 1e-10 * m, Dimension::length},
    {"fermi", 1e-15 * m, Dimension::length},
    {"fm", 1e-15 * m, Dimension::length},
    {"parsec", 3.0856775807e16 * m, Dimension::length},
    {"pc", 3.0856775807e16 * m, Dimension::length},
    {"mrad", 1e-3, Dimension::angle},
    {"milliradian", 1e-3, Dimension::angle},
    {"g/cm3", 1, Dimension::density},
    {"mg/cm3", 1e-3, Dimension::density},
    {"kg/m3", 1e-3, Dimension::density},
    {"sr", 1, Dimension::other},
    {"steradian", 1, Dimension::other},
    {"mm2", mm* mm, Dimension::other},
    {"cm2", cm* cm, Dimension::other},
    {"m2", m* m, Dimension::other},
    {"km2", km* km, Dimension::other},
    {"mm3", mm* mm* mm, Dimension::other},
    {"cm3", cm* cm* cm, Dimension::other},
    {"cc", cm* cm* cm, Dimension::other},
    {"m3", m* m* m, Dimension::other},
    {"km3", km* km* km, Dimension::other},
    {"L", 1e6, Dimension::other},
    {"liter", 1e6, Dimension::other},
    {"barn", 1e-28 * m* m, Dimension::other},
    {"ns", 1, Dimension::other},
    {"nanosecond", 1, Dimension::other},
    {"ps", 1e-12 * s, Dimension::other},
    {"picosecond", 1e-12 * s, Dimension::other},
    {"us", 1e-6 * s, Dimension::other},
    {"microsecond", 1e-6 * s, Dimension::other},
    {"ms", 1e-3 * s, Dimension::other},
    {"millisecond", 1e-3 * s, Dimension::other},
    {"s", s, Dimension::other},
    {"second", s, Dimension::other},
    {"Hz", 1 / s, Dimension::other},
    {"hertz", 1 / s, Dimension::other},
    {"eV", ev, Dimension::other},
    {"electronvolt", ev, Dimension::other},
    {"keV", 1e3 * ev, Dimension::other},
    {"MeV", 1, Dimension::other},
    {"GeV", 1e9 * ev, Dimension::other},
    {"TeV", 1e12 * ev, Dimension::other},
    {"PeV", 1e15 * ev, Dimension::other},
    {"J", joule, Dimension::other},
    {"joule", joule, Dimension::other},
    {"kg", kg, Dimension::other},
    {"kilogram", kg, Dimension::other},
    {"g", gram, Dimension::other},
    {"gram", gram, Dimension::other},
    {"mg", 1e-3 * gram, Dimension::other},
    {"milligram", 1e-3 * gram, Dimension::other},
    {"K", 1, Dimension::other},
    {"kelvin", 1, Dimension::other},
    {"mole", 1, Dimension::other},
    {"mol", 1, Dimension::other},
    {"g/mole", gram, Dimension::other},
    {"kg/mole", kg, Dimension::other},
    {"C", coulomb, Dimension::other},
    {"coulomb", coulomb, Dimension::other},
    {"A", coulomb / s, Dimension::other},
    {"ampere", coulomb / s, Dimension::other},
    {"V", volt, Dimension::other},
    {"volt", volt, Dimension::other},
    {"kV", 1e3 * volt, Dimension::other},
    {"MV", 1e6 * volt, Dimension::other},
    {"tesla", volt* s / (m * m), Dimension::other},
    {"T", volt* s / (m * m), Dimension::other},
    {"gauss", 1e-4 * volt* s / (m * m), Dimension::other},
    {"kilogauss", 0.1 * volt* s / (m * m), Dimension::other},
    {"pascal", pascal, Dimension::other},
    {"Pa", pascal, Dimension::other},
    {"bar", 1e5 * pascal, Dimension::other},
    {"atmosphere", 101325 * pascal, Dimension::other},
    {"atm", 101325 * pascal, Dimension::other},
};

constexpr struct {
  std::string_view name;
  double value;
} constants[] = {
    {"pi", pi},      {"twopi", 2 * pi},      {"halfpi", pi / 2},
    {"pi2", pi* pi}, {"e", std::numbers::e}, {"gamma", std::numbers::egamma},
};

}  // namespace

std::optional<Unit> find_unit(std::string_view name) {
  const auto* unit = std::find_if(std::begin(units), std::end(units),
                                  [&](const Unit& u) { return u.name == name; });
  if (unit == std::end(units)) return std::nullopt;
  return *unit;
}

std::optional<double> find_builtin(std::string_view name) {
  for (const auto& constant : constants) {
    if (constant.name == name) return constant.value;
  }
  const auto unit = find_unit(name);
  if (!unit || unit->dimension == Dimension::density) return std::nullopt;
  return unit->value;
}

}  // namespace navjit::gdml

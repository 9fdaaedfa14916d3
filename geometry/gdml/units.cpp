// The values follow from the definitions of the SI and from the Review of Particle Physics; the
// names are those that CLHEP's evaluator and Geant4's table of units know.
#include "geometry/gdml/units.hpp"

#include <numbers>
#include <span>

namespace navjit::gdml {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double kilo = 1e3, mega = 1e6, giga = 1e9, tera = 1e12, peta = 1e15;
constexpr double deci = 1e-1, centi = 1e-2, milli = 1e-3, micro = 1e-6, nano = 1e-9, pico = 1e-12;

constexpr double mm = 1, m = 1e3, cm = 10, km = 1e6;
constexpr double s = 1e9, ev = 1e-6, e_si = 1.602176634e-19;
constexpr double joule = ev / e_si, kg = joule * s * s / (m * m), gram = 1e-3 * kg;
constexpr double coulomb = 1 / e_si, ampere = coulomb / s, volt = 1e-6;
constexpr double hertz = 1 / s, newton = joule / m, watt = joule / s;
constexpr double pascal = joule / (m * m * m), bar = 1e5 * pascal, atmosphere = 101325 * pascal;
constexpr double ohm = volt / ampere, farad = coulomb / volt, weber = volt * s;
constexpr double tesla = weber / (m * m), gauss = 1e-4 * tesla, henry = weber / ampere;
constexpr double gray = joule / kg, curie = 3.7e10 * hertz;
constexpr double barn = 1e-28 * m * m, liter = 1e-3 * m * m * m, parsec = 3.0856775807e16 * m;

constexpr auto length = Dimension::length, angle = Dimension::angle, density = Dimension::density,
               molar_mass = Dimension::molar_mass, temperature = Dimension::temperature,
               pressure = Dimension::pressure, other = Dimension::other;

// clang-format off
/// What both expressions and `unit` attributes know. Frequent ones are first: the search is linear.
constexpr Unit in_expressions[] = {
    {"mm", mm, length}, {"cm", cm, length}, {"deg", pi / 180, angle}, {"rad", 1, angle},
    {"degree", pi / 180, angle}, {"radian", 1, angle}, {"m", m, length}, {"um", micro * m, length},
    {"nm", nano * m, length}, {"km", km, length}, {"millimeter", mm, length},
    {"centimeter", cm, length}, {"decimeter", deci * m, length}, {"meter", m, length},
    {"metre", m, length}, {"kilometer", km, length}, {"micrometer", micro * m, length},
    {"micron", micro * m, length}, {"nanometer", nano * m, length},
    {"angstrom", 1e-10 * m, length}, {"Ang", 1e-10 * m, length}, {"fermi", 1e-15 * m, length},
    {"fm", 1e-15 * m, length}, {"parsec", parsec, length}, {"pc", parsec, length},
    {"mrad", milli, angle}, {"milliradian", milli, angle},
    {"sr", 1, other}, {"steradian", 1, other},
    // areas, volumes, inverse lengths
    {"mm2", mm * mm, other}, {"cm2", cm * cm, other}, {"m2", m * m, other}, {"km2", km * km, other},
    {"barn", barn, other}, {"millibarn", milli * barn, other}, {"mbarn", milli * barn, other},
    {"microbarn", micro * barn, other}, {"nanobarn", nano * barn, other},
    {"picobarn", pico * barn, other},
    {"mm3", mm * mm * mm, other}, {"cm3", cm * cm * cm, other}, {"cc", cm * cm * cm, other},
    {"m3", m * m * m, other}, {"km3", km * km * km, other}, {"L", liter, other},
    {"liter", liter, other}, {"litre", liter, other}, {"cL", centi * liter, other},
    {"centiliter", centi * liter, other}, {"mL", milli * liter, other},
    {"milliliter", milli * liter, other},
    {"dpt", 1 / m, other}, {"diopter", 1 / m, other}, {"dioptre", 1 / m, other},
    // time, frequency, activity
    {"ns", nano * s, other}, {"nanosecond", nano * s, other}, {"ps", pico * s, other},
    {"picosecond", pico * s, other}, {"us", micro * s, other}, {"microsecond", micro * s, other},
    {"ms", milli * s, other}, {"millisecond", milli * s, other}, {"s", s, other},
    {"second", s, other},
    {"Hz", hertz, other}, {"hertz", hertz, other}, {"kHz", kilo * hertz, other},
    {"kilohertz", kilo * hertz, other}, {"MHz", mega * hertz, other},
    {"megahertz", mega * hertz, other},
    {"Bq", hertz, other}, {"becquerel", hertz, other}, {"kBq", kilo * hertz, other},
    {"kilobecquerel", kilo * hertz, other}, {"MBq", mega * hertz, other},
    {"megabecquerel", mega * hertz, other}, {"GBq", giga * hertz, other},
    {"gigabecquerel", giga * hertz, other}, {"Ci", curie, other}, {"curie", curie, other},
    {"mCi", milli * curie, other}, {"millicurie", milli * curie, other},
    {"uCi", micro * curie, other}, {"microcurie", micro * curie, other},
    // energy, power, dose
    {"eV", ev, other}, {"electronvolt", ev, other}, {"keV", kilo * ev, other},
    {"kiloelectronvolt", kilo * ev, other}, {"MeV", mega * ev, other},
    {"megaelectronvolt", mega * ev, other}, {"GeV", giga * ev, other},
    {"gigaelectronvolt", giga * ev, other}, {"TeV", tera * ev, other},
    {"teraelectronvolt", tera * ev, other}, {"PeV", peta * ev, other},
    {"petaelectronvolt", peta * ev, other}, {"J", joule, other}, {"joule", joule, other},
    {"kJ", kilo * joule, other}, {"kilojoule", kilo * joule, other}, {"MJ", mega * joule, other},
    {"megajoule", mega * joule, other}, {"GJ", giga * joule, other},
    {"gigajoule", giga * joule, other},
    {"W", watt, other}, {"watt", watt, other}, {"kW", kilo * watt, other},
    {"kilowatt", kilo * watt, other}, {"MW", mega * watt, other}, {"megawatt", mega * watt, other},
    {"GW", giga * watt, other}, {"gigawatt", giga * watt, other},
    {"Gy", gray, other}, {"gray", gray, other}, {"kilogray", kilo * gray, other},
    {"milligray", milli * gray, other}, {"microgray", micro * gray, other}, {"Sv", gray, other},
    {"sievert", gray, other},
    // mass, force, pressure, temperature, amount
    {"kg", kg, other}, {"kilogram", kg, other}, {"g", gram, other}, {"gram", gram, other},
    {"mg", milli * gram, other}, {"milligram", milli * gram, other},
    {"N", newton, other}, {"newton", newton, other}, {"kN", kilo * newton, other},
    {"kilonewton", kilo * newton, other},
    {"pascal", pascal, pressure}, {"Pa", pascal, pressure}, {"bar", bar, pressure},
    {"mbar", milli * bar, pressure}, {"millibar", milli * bar, pressure},
    {"kbar", kilo * bar, pressure}, {"kilobar", kilo * bar, pressure},
    {"atmosphere", atmosphere, pressure}, {"atm", atmosphere, pressure},
    {"K", 1, temperature}, {"kelvin", 1, temperature}, {"mole", 1, other}, {"mol", 1, other},
    // electricity and magnetism
    {"C", coulomb, other}, {"coulomb", coulomb, other}, {"A", ampere, other}, {"amp", ampere, other},
    {"ampere", ampere, other}, {"mA", milli * ampere, other}, {"milliampere", milli * ampere, other},
    {"microampere", micro * ampere, other}, {"nanoampere", nano * ampere, other},
    {"V", volt, other}, {"volt", volt, other}, {"kV", kilo * volt, other},
    {"kilovolt", kilo * volt, other}, {"MV", mega * volt, other}, {"megavolt", mega * volt, other},
    {"ohm", ohm, other}, {"S", 1 / ohm, other}, {"siemens", 1 / ohm, other}, {"F", farad, other},
    {"farad", farad, other}, {"mF", milli * farad, other}, {"millifarad", milli * farad, other},
    {"uF", micro * farad, other}, {"microfarad", micro * farad, other}, {"nF", nano * farad, other},
    {"nanofarad", nano * farad, other}, {"pF", pico * farad, other},
    {"picofarad", pico * farad, other}, {"Wb", weber, other}, {"weber", weber, other},
    {"tesla", tesla, other}, {"T", tesla, other}, {"gauss", gauss, other}, {"Gs", gauss, other},
    {"kilogauss", kilo * gauss, other}, {"kGs", kilo * gauss, other}, {"H", henry, other},
    {"henry", henry, other},
    // light
    {"cd", 1, other}, {"candela", 1, other}, {"lm", 1, other}, {"lumen", 1, other},
    {"lx", 1 / (m * m), other}, {"lux", 1 / (m * m), other},
};

/// What only `unit` attributes know: as names in expressions these would hide typing errors.
constexpr Unit in_attributes[] = {
    {"g/cm3", 1, density}, {"mg/cm3", milli, density}, {"kg/m3", milli, density},
    {"g/mole", gram, molar_mass}, {"g/mol", gram, molar_mass}, {"kg/mole", kg, molar_mass},
    {"kg/mol", kg, molar_mass},
    {"mum", micro * m, length},
    {"kilometer2", km * km, other}, {"meter2", m * m, other}, {"centimeter2", cm * cm, other},
    {"millimeter2", mm * mm, other}, {"kilometer3", km * km * km, other},
    {"meter3", m * m * m, other}, {"centimeter3", cm * cm * cm, other},
    {"millimeter3", mm * mm * mm, other}, {"dL", deci * liter, other},
    {"mubarn", micro * barn, other}, {"nbarn", nano * barn, other}, {"pbarn", pico * barn, other},
    {"mus", micro * s, other}, {"min", 60 * s, other}, {"minute", 60 * s, other},
    {"h", 3600 * s, other}, {"hour", 3600 * s, other}, {"d", 86400 * s, other},
    {"day", 86400 * s, other},
    {"eplus", 1, other}, {"e+", 1, other}, {"meV", milli * ev, other},
    {"ug", micro * gram, other}, {"microgram", micro * gram, other},
    {"muA", micro * ampere, other}, {"nA", nano * ampere, other},
    {"G", gauss, other}, {"kG", kilo * gauss, other},
    {"kGy", kilo * gray, other}, {"mGy", milli * gray, other}, {"uGy", micro * gray, other},
    {"perCent", 1e-2, other}, {"perThousand", 1e-3, other}, {"perMillion", 1e-6, other},
    {"percent", 1e-2, other}, {"%", 1e-2, other},
    // These are not in Geant4's table, but in those of programs that add to it.
    {"in", 2.54 * cm, length}, {"inch", 2.54 * cm, length}, {"ft", 30.48 * cm, length},
    {"foot", 30.48 * cm, length},
};
// clang-format on

constexpr struct {
  std::string_view name;
  double value;
} constants[] = {
    {"pi", pi},      {"twopi", 2 * pi},      {"halfpi", pi / 2},
    {"pi2", pi* pi}, {"e", std::numbers::e}, {"gamma", std::numbers::egamma},
};

std::optional<Unit> find_in(std::span<const Unit> units, std::string_view name) {
  for (const Unit& unit : units) {
    if (unit.name == name) return unit;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Unit> find_unit(std::string_view name) {
  const auto unit = find_in(in_expressions, name);
  return unit ? unit : find_in(in_attributes, name);
}

std::optional<double> find_builtin(std::string_view name) {
  for (const auto& constant : constants) {
    if (constant.name == name) return constant.value;
  }
  const auto unit = find_in(in_expressions, name);
  return unit ? std::optional(unit->value) : std::nullopt;
}

}  // namespace navjit::gdml

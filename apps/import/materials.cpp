#include "apps/import/materials.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace navjit::apps {
namespace {

struct ElementData {
  std::string_view symbol;
  double a;  ///< g/mol, standard atomic weights of IUPAC, abridged
};

/// By charge, hydrogen first.
constexpr ElementData elements[]{
    {"H", 1.008},   {"He", 4.0026}, {"Li", 6.94},   {"Be", 9.0122}, {"B", 10.81},   {"C", 12.011},
    {"N", 14.007},  {"O", 15.999},  {"F", 18.998},  {"Ne", 20.180}, {"Na", 22.990}, {"Mg", 24.305},
    {"Al", 26.982}, {"Si", 28.085}, {"P", 30.974},  {"S", 32.06},   {"Cl", 35.45},  {"Ar", 39.95},
    {"K", 39.098},  {"Ca", 40.078}, {"Sc", 44.956}, {"Ti", 47.867}, {"V", 50.942},  {"Cr", 51.996},
    {"Mn", 54.938}, {"Fe", 55.845}, {"Co", 58.933}, {"Ni", 58.693}, {"Cu", 63.546}, {"Zn", 65.38},
    {"Ga", 69.723}, {"Ge", 72.630}, {"As", 74.922}, {"Se", 78.971}, {"Br", 79.904}, {"Kr", 83.798},
    {"Rb", 85.468}, {"Sr", 87.62},  {"Y", 88.906},  {"Zr", 91.224}, {"Nb", 92.906}, {"Mo", 95.95},
    {"Tc", 97},     {"Ru", 101.07}, {"Rh", 102.91}, {"Pd", 106.42}, {"Ag", 107.87}, {"Cd", 112.41},
    {"In", 114.82}, {"Sn", 118.71}, {"Sb", 121.76}, {"Te", 127.60}, {"I", 126.90},  {"Xe", 131.29},
    {"Cs", 132.91}, {"Ba", 137.33}, {"La", 138.91}, {"Ce", 140.12}, {"Pr", 140.91}, {"Nd", 144.24},
    {"Pm", 145},    {"Sm", 150.36}, {"Eu", 151.96}, {"Gd", 157.25}, {"Tb", 158.93}, {"Dy", 162.50},
    {"Ho", 164.93}, {"Er", 167.26}, {"Tm", 168.93}, {"Yb", 173.05}, {"Lu", 174.97}, {"Hf", 178.49},
    {"Ta", 180.95}, {"W", 183.84},  {"Re", 186.21}, {"Os", 190.23}, {"Ir", 192.22}, {"Pt", 195.08},
    {"Au", 196.97}, {"Hg", 200.59}, {"Tl", 204.38}, {"Pb", 207.2},  {"Bi", 208.98}, {"Po", 209},
    {"At", 210},    {"Rn", 222},    {"Fr", 223},    {"Ra", 226},    {"Ac", 227},    {"Th", 232.04},
    {"Pa", 231.04}, {"U", 238.03}};

struct Known {
  std::string_view name;
  double density;  ///< g/cm3; solids and liquids as the Review of Particle Physics has them
  std::string_view formula;
  MaterialState state = MaterialState::solid;
};

constexpr Known materials[]{
    {"Vacuum", 1e-25, "H", MaterialState::gas},
    {"Air", 0.001205, "N1562O420Ar9", MaterialState::gas},  // dry, 20 C, by atoms in 1991
    {"Water", 1.0, "H2O", MaterialState::liquid},
    {"Aluminium", 2.699, "Al"},
    {"Beryllium", 1.848, "Be"},
    {"Carbon", 2.210, "C"},
    {"Copper", 8.960, "Cu"},
    {"Gold", 19.32, "Au"},
    {"Iron", 7.874, "Fe"},
    {"Lead", 11.35, "Pb"},
    {"PMMA", 1.190, "C5H8O2"},
    {"Polyethylene", 0.890, "CH2"},
    {"Polystyrene", 1.060, "C8H8"},
    {"Quartz", 2.200, "SiO2"},
    {"Silicon", 2.329, "Si"},
    {"Titanium", 4.540, "Ti"},
    {"Tungsten", 19.30, "W"}};

std::optional<std::size_t> element_of(std::string_view symbol) {
  for (std::size_t i = 0; i < std::size(elements); ++i) {
    if (elements[i].symbol == symbol) return i;
  }
  return std::nullopt;
}

/// Atoms of each element, by its place in the table. Throws UsageError.
std::map<std::size_t, double> atoms_of(std::string_view formula) {
  std::map<std::size_t, double> atoms;
  for (std::size_t at = 0; at < formula.size();) {
    std::size_t end = at + 1;
    if (end < formula.size() && formula[end] >= 'a' && formula[end] <= 'z') ++end;
    const auto element = element_of(formula.substr(at, end - at));
    double count = 0;
    std::size_t digits = end;
    while (digits < formula.size() && digits < end + 9 && formula[digits] >= '0' &&
           formula[digits] <= '9') {
      count = 10 * count + (formula[digits++] - '0');
    }
    if (digits == end) count = 1;
    if (!element || count == 0) {
      throw UsageError("'" + std::string(formula) +
                       "' is no formula; write one like Al2O3, of elements up to U");
    }
    atoms[*element] += count;
    at = digits;
  }
  return atoms;
}

std::string listed_materials() {
  std::string all;
  for (const Known& known : materials) all += (all.empty() ? "" : ", ") + std::string(known.name);
  return all;
}

}  // namespace

std::vector<std::string> known_materials() {
  std::vector<std::string> names;
  for (const Known& known : materials) names.emplace_back(known.name);
  return names;
}

DetectorBuilder::MaterialId add_material(DetectorBuilder& builder, const MaterialWish& wish) {
  const auto found = std::find_if(std::begin(materials), std::end(materials),
                                  [&](const Known& known) { return known.name == wish.name; });
  const bool known = found != std::end(materials);
  Material material{.name = wish.name};
  const bool said = wish.density > 0 || !wish.formula.empty();
  if (!known && !said && wish.name.starts_with("G4_")) return builder.material(material);
  material.density = wish.density > 0 ? wish.density : known ? found->density : 0;
  const std::string_view formula = !wish.formula.empty() ? std::string_view(wish.formula)
                                   : known               ? found->formula
                                                         : std::string_view();
  if (material.density == 0 || formula.empty()) {
    throw UsageError("material '" + wish.name +
                     "' is not known: give its --density and --formula, or a name of Geant4's "
                     "(G4_...), or one of " +
                     listed_materials());
  }
  if (known) material.state = found->state;
  for (const auto& [element, atoms] : atoms_of(formula)) {
    const ElementData& data = elements[element];
    const auto id = builder.element({.name = std::string(data.symbol),
                                     .formula = std::string(data.symbol),
                                     .z = static_cast<double>(element + 1),
                                     .a = data.a});
    material.elements.push_back({id, atoms * data.a});
  }
  return builder.material(std::move(material));
}

}  // namespace navjit::apps

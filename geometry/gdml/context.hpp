// What the parts of the reader share: the state of one file, and typed access to attributes.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/gdml/expressions.hpp"
#include "geometry/gdml/units.hpp"
#include "geometry/gdml/xml.hpp"
#include "geometry/model/world.hpp"
#include "geometry/notes.hpp"
#include "geometry/solids/boolean_size.hpp"

namespace navjit::gdml {

using Vector = std::array<double, 3>;

/// The dimensions of a solid that can be divided, as the file gives them: half lengths and radii in
/// mm, angles in rad. Those that a kind of solid does not have are zero.
struct DivisibleShape {
  std::string_view tag;  ///< "box", "tube", "cone", "trd", "para", "polycone", "polyhedra", "trap"
  double x1 = 0, y1 = 0, x2 = 0, y2 = 0;  ///< at -hz and at hz; box and para use the first two
  double hz = 0;
  double alpha = 0, theta = 0, phi = 0;               ///< para, trap
  double rmin1 = 0, rmax1 = 0, rmin2 = 0, rmax2 = 0;  ///< cone; the tube has the first two
  double start = 0, delta = 0;                        ///< azimuth
  std::vector<ZPlane> planes{};
  int sides = 0;

  friend bool operator==(const DivisibleShape&, const DivisibleShape&) = default;
};
/// Throws GeometryError if the dimensions make no solid.
Solid make_shape(const std::string& name, const DivisibleShape& shape);

/// A solid of the file. One that is not supported is an error only once it is used.
struct NamedSolid {
  std::optional<Solid> solid;
  const XmlElement* element = nullptr;
  std::optional<DivisibleShape> shape;  ///< of the kinds that can be divided
  BooleanSize size;
};

/// Placements that are made together, relative to a frame of their own.
struct Assembly {
  /// A placement, or all those of an assembly within this one.
  struct Part {
    const Assembly* nested = nullptr;
  };

  std::vector<Placement> placements{};
  std::vector<Part> parts{};  ///< in the order of the placements
  int depth = 1;              ///< levels of assemblies
};

struct Setup {
  std::string name, world;
  const XmlElement* world_element;
};

struct FileContext;

/// What a file shares with its modules.
struct Session {
  explicit Session(const GdmlOptions& the_options)
      : options(the_options), xml{options.limits.max_bytes, options.limits.max_elements} {}

  const GdmlOptions& options;
  std::filesystem::path main_file;
  XmlBudget xml;
  int open_files = 0;
  std::size_t loop_elements = 0;
  std::size_t loop_name_bytes = 0;
  std::size_t left_out = 0;
  /// Those of elements within loops, where they are the same every time.
  std::map<const XmlElement*, Auxiliaries> auxiliaries;
  std::size_t placements = 0;
  std::size_t placement_name_bytes = 0;
  std::size_t boolean_parts = 0;  ///< of all booleans: a part counts in each that it is in
  World world;
  std::vector<const NamedSolid*> volume_solids;  ///< of the world's volumes
  Notes notes;
  /// Files read or being read, by canonical path.
  std::map<std::string, std::unique_ptr<FileContext>> files;
  std::vector<FileContext*> files_in_order;
};

/// A name's definition, read or still being read.
template <class T>
using Definitions = StringMap<T>;

/// One GDML file. Names of values and frames are its own; a material, solid or volume that it lacks
/// is looked for in the other files that were read, as in Geant4's stores.
struct FileContext {
  explicit FileContext(Session& the_session) : session(the_session) {}

  Session& session;
  std::unique_ptr<XmlDocument> document;
  bool complete = false;  ///< false while it is being read
  std::string problem;    ///< why it could not be read

  Evaluator evaluator;
  Definitions<Vector> positions, rotations, scales;
  Definitions<double> quantities;
  Definitions<std::uint32_t> materials, elements, isotopes;  ///< indices into the world's
  /// Under their names without the addresses ("0x55d...") that Geant4 appends when it writes; of
  /// several with the same name the first holds.
  Definitions<std::uint32_t> materials_by_bare_name, elements_by_bare_name;
  Definitions<NamedSolid> solids;
  Definitions<VolumeId> volumes;
  Definitions<Assembly> assemblies;
  std::vector<Setup> setups;
  /// Under "KIND NAME": what is wrong with definitions that could not be read.
  Definitions<std::string> broken;
  int loops = 0;          ///< how many loops are being read: names hold indices there
  std::string open_name;  ///< the solid, volume or assembly that is being read

  /// Notes something odd at an element; `what` names the kind of note, of which only the first few
  /// are kept.
  void note(const XmlElement& element, const std::string& what, const std::string& detail = {}) {
    session.notes.add(what, [&] {
      return describe(element) + ": " + what + (detail.empty() ? "" : ": ") + detail;
    });
  }
  /// The same where the error says what is wrong with the element.
  void note(const XmlElement& element, const std::string& what, const GdmlError& error);
  /// Counts something common that was skipped.
  void skip(const std::string& what) { session.notes.count(what); }

  /// The `name` of an element with its indices resolved. Fails if it is missing.
  std::string name(const XmlElement& element);
  /// The same; empty if there is none. It names nothing that others refer to, so that brackets
  /// which hold no index are kept, with a note.
  std::string optional_name(const XmlElement& element);
  /// The `ref` of an element.
  std::string reference(const XmlElement& element, std::string_view attribute = "ref");

  double number(const XmlElement& element, std::string_view attribute);
  double number(const XmlElement& element, std::string_view attribute, double fallback);
  int integer(const XmlElement& element, std::string_view attribute);
  int integer(const XmlElement& element, std::string_view attribute, int fallback);
  /// Whether the unit that the attribute names is of that kind, or the attribute is missing.
  static bool has_unit_of(const XmlElement& element, std::string_view attribute,
                          Dimension dimension);
  /// The value of the unit that the attribute names; `fallback` where it is missing.
  double unit(const XmlElement& element, std::string_view attribute, Dimension dimension,
              double fallback = 1);
  /// A length of at most 1e30 mm; `unit` is in mm. Polynomials of such lengths stay finite.
  double length(const XmlElement& element, std::string_view attribute, double unit);
  double length(const XmlElement& element, std::string_view attribute, double unit,
                double fallback);
  /// x, y, z in the element's `unit`; a missing coordinate is `fallback`.
  Vector vector(const XmlElement& element, Dimension dimension, double fallback = 0);
  /// Evaluates an expression; an error says where it stands.
  double evaluate(const XmlElement& element, std::string_view expression, std::string_view what);

  /// Resolves indices in a name where it is in a loop, and checks its length.
  std::string resolved(const XmlElement& element, std::string_view text, bool always = false);

  /// Charges the name of an element that a loop repeats against the limit on such names.
  void charge_name(const XmlElement& element, std::string_view name);

  /// Notes that an element was left out, and why: `message` is that of the error.
  void leave_out(const XmlElement& element, const std::string& message);
  /// Runs `read`, which reads the definition of a `what`. If that fails it is noted, and is an
  /// error only for what uses the definition.
  void define_if_readable(const XmlElement& element, const std::string& what,
                          const std::function<void()>& read);
  /// Runs `body` for every turn of a <loop>.
  void loop(const XmlElement& element, const std::function<void()>& body);
  /// Charges an element against the limit on loops, if a loop is being read.
  void charge(const XmlElement& element);
  /// The same for an expression, if it is a long one.
  void charge_expression(const XmlElement& element, std::string_view expression);

  /// The definition of a name, in this file or else in one that was read before; null if there is
  /// none.
  template <class T>
  T* find(Definitions<T> FileContext::*definitions, const std::string& wanted) {
    const auto own = (this->*definitions).find(wanted);
    if (own != (this->*definitions).end()) return &own->second;
    for (FileContext* other : session.files_in_order) {
      const auto found = (other->*definitions).find(wanted);
      if (found != (other->*definitions).end()) return &found->second;
    }
    return nullptr;
  }
  /// The same. Fails where there is none, and says where the name is defined if that is too late.
  template <class T>
  T& look_up(Definitions<T> FileContext::*definitions, const XmlElement& element,
             const std::string& what, const std::string& wanted) {
    if (!broken.empty()) check_readable(element, what, wanted);
    if (T* found = find(definitions, wanted)) return *found;
    for (const FileContext* other : session.files_in_order) {
      other->check_readable(element, what, wanted);
    }
    fail_unknown(element, what, wanted);
  }
  /// The definition of a name of this file. Fails in the same way where there is none.
  template <class T>
  T& look_up(Definitions<T>& definitions, const XmlElement& element, const std::string& what,
             const std::string& wanted) {
    const auto found = definitions.find(wanted);
    if (!broken.empty()) check_readable(element, what, wanted);
    if (found == definitions.end()) fail_unknown(element, what, wanted);
    return found->second;
  }
  /// Adds a definition unless the name is taken: the first one holds, as in Geant4.
  template <class T>
  void define(Definitions<T>& definitions, const XmlElement& element, const std::string& what,
              const std::string& as,
              T value) {  // NOLINT(performance-unnecessary-value-param): moved from
    if (!definitions.try_emplace(as, std::move(value)).second) {
      note(element, "left out, since the first of several " + what + "s of the same name holds");
    }
  }

  /// Fails if there is a definition of a `what` of this name that could not be read.
  void check_readable(const XmlElement& element, const std::string& what,
                      const std::string& wanted) const;

 private:
  [[noreturn]] void fail_unknown(const XmlElement& element, const std::string& what,
                                 const std::string& wanted);
};

/// A name without the address that Geant4 appends to it.
inline std::string bare_name(const std::string& name) { return name.substr(0, name.find("0x")); }

/// Of this name or, as Geant4 looks for them, of the same name without an address; null if there is
/// none.
std::uint32_t* find_material_named(FileContext& file, const std::string& name);
std::uint32_t* find_element_named(FileContext& file, const std::string& name);

/// A function that reads one kind of element.
using ElementReader = void (*)(FileContext&, const XmlElement&);

/// Runs `f`; errors of expressions and of the geometry become GdmlErrors at the element.
template <class F>
decltype(auto) at_element(const XmlElement& element, F&& f) {
  try {
    return f();
  } catch (const BrokenDefinition& e) {
    fail_needing(element, e.what());
  } catch (const ExpressionError& e) {
    fail(element, e.what());
  } catch (const GeometryError& e) {
    fail(element, printable(e.what()));
  }
}

/// The <auxiliary> children of an element; null if it has none.
Auxiliaries read_auxiliaries(FileContext& file, const XmlElement& element);

void read_define(FileContext& file, const XmlElement& section);
void read_materials(FileContext& file, const XmlElement& section);
void read_solids(FileContext& file, const XmlElement& section);
void read_structure(FileContext& file, const XmlElement& section);
/// Reads another file, once. `from` is the element that asks for it; null for the main file.
FileContext& read_file(Session& session, const std::filesystem::path& path, const XmlElement* from);
/// The setup named `wanted`; where that is empty the one named "Default", or else the first.
const Setup& choose_setup(const FileContext& file, const std::string& wanted);

}  // namespace navjit::gdml

#include "geometry/gdml/context.hpp"

#include <cmath>

namespace navjit::gdml {
namespace {

bool is_empty(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// What messages call a dimension, and which units they suggest.
struct DimensionWords {
  const char *kind, *units;
};
constexpr DimensionWords words_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
      return {"length", "use mm, cm, m, km, um or nm"};
    case Dimension::angle:
      return {"angle", "use deg, rad or mrad"};
    case Dimension::density:
      return {"density", "use g/cm3, mg/cm3 or kg/m3"};
    case Dimension::temperature:
      return {"temperature", "use K"};
    case Dimension::pressure:
      return {"pressure", "use pascal, bar or atmosphere"};
    case Dimension::molar_mass:
      return {"molar mass", "use g/mole"};
    case Dimension::other:
      break;
  }
  return {"this kind", "use a unit that Geant4 knows"};
}

/// The first element of the tree that defines the name, in whatever section.
const XmlElement* find_definition(const XmlElement& root, const std::string& what,
                                  const std::string& wanted) {
  const auto defines = [&](const XmlElement& element) {
    return element.find("name") == wanted &&
           (element.tag == what || (what == "solid" && element.find("ref") == std::nullopt));
  };
  for (const XmlElement& section : root.children()) {
    if (what == "solid" && section.tag != "solids") continue;
    for (const XmlElement& element : section.children()) {
      if (defines(element)) return &element;
    }
  }
  return nullptr;
}

}  // namespace

std::string FileContext::resolved(const XmlElement& element, std::string_view text, bool always) {
  if (text.size() > session.options.limits.max_name_length) {
    refuse(element, "a name is longer than " +
                        std::to_string(session.options.limits.max_name_length) +
                        " characters; raise GdmlLimits::max_name_length if this is meant");
  }
  if (loops == 0 && !always) return std::string(text);
  std::string name = at_element(element, [&] { return evaluator.resolve_brackets(text); });
  charge_name(element, name);
  return name;
}

void FileContext::charge_name(const XmlElement& element, std::string_view name) {
  if (loops == 0) return;
  session.loop_name_bytes += name.size();
  if (session.loop_name_bytes > 512 * session.options.limits.max_loop_iterations) {
    refuse(element,
           "loops make too long names; raise GdmlLimits::max_loop_iterations if this is meant");
  }
}

std::string FileContext::name(const XmlElement& element) {
  const auto value = element.find("name");
  if (!value || value->empty()) fail(element, "it has no name; add a 'name' attribute");
  return resolved(element, *value);
}

std::string FileContext::optional_name(const XmlElement& element) {
  const std::string_view text = element.find("name").value_or("");
  try {
    return resolved(element, text, true);
  } catch (const GdmlRefusal&) {
    throw;
  } catch (const GdmlError& e) {
    charge_name(element, text);
    note(element, "kept a name as it is written: what it has in brackets is no index", e);
    return std::string(text);
  }
}

std::string FileContext::reference(const XmlElement& element, std::string_view attribute) {
  const auto value = element.find(attribute);
  if (!value || value->empty()) {
    fail(element, "attribute '" + std::string(attribute) + "' is missing; name what is meant");
  }
  return resolved(element, *value);
}

double FileContext::evaluate(const XmlElement& element, std::string_view expression,
                             std::string_view what) {
  if (is_empty(expression)) {
    note(element, std::string(what) + " is empty and counts as 0, as in Geant4");
    return 0;
  }
  charge_expression(element, expression);
  try {
    return evaluator.evaluate(expression);
  } catch (const BrokenDefinition& e) {
    fail_needing(element, e.what());
  } catch (const ExpressionError& e) {
    fail(element, std::string(what) + ": " + e.what());
  }
}

double FileContext::number(const XmlElement& element, std::string_view attribute) {
  const auto value = element.find(attribute);
  if (!value) {
    fail(element, "attribute '" + std::string(attribute) + "' is missing; give it a number");
  }
  return evaluate(element, *value, attribute);
}

double FileContext::number(const XmlElement& element, std::string_view attribute, double fallback) {
  const auto value = element.find(attribute);
  return value ? evaluate(element, *value, attribute) : fallback;
}

int FileContext::integer(const XmlElement& element, std::string_view attribute) {
  const auto value = element.find(attribute);
  if (!value) {
    fail(element, "attribute '" + std::string(attribute) + "' is missing; give it an integer");
  }
  if (is_empty(*value)) return static_cast<int>(evaluate(element, *value, attribute));
  charge_expression(element, *value);
  try {
    return evaluator.evaluate_integer(*value);
  } catch (const BrokenDefinition& e) {
    fail_needing(element, e.what());
  } catch (const ExpressionError& e) {
    fail(element, std::string(attribute) + ": " + e.what());
  }
}

int FileContext::integer(const XmlElement& element, std::string_view attribute, int fallback) {
  return element.find(attribute) ? integer(element, attribute) : fallback;
}

bool FileContext::has_unit_of(const XmlElement& element, std::string_view attribute,
                              Dimension dimension) {
  const auto text = element.find(attribute);
  if (!text) return true;
  const auto found = find_unit(*text);
  return found && (dimension == Dimension::other || found->dimension == dimension);
}

double FileContext::unit(const XmlElement& element, std::string_view attribute, Dimension dimension,
                         double fallback) {
  const auto text = element.find(attribute);
  if (!text) return fallback;
  if (!has_unit_of(element, attribute, dimension)) {
    const DimensionWords words = words_of(dimension);
    fail(element, std::string(attribute) + ": '" + printable(*text) + "' is not a unit of " +
                      words.kind + "; " + words.units);
  }
  return find_unit(*text)->value;
}

double FileContext::length(const XmlElement& element, std::string_view attribute,
                           double unit_length) {
  const double value = number(element, attribute) * unit_length;
  if (!(std::abs(value) <= 1e30)) {
    fail(element, std::string(attribute) + ": the length is beyond 1e30 mm; check its unit");
  }
  return value;
}

double FileContext::length(const XmlElement& element, std::string_view attribute,
                           double unit_length, double fallback) {
  return element.find(attribute) ? length(element, attribute, unit_length) : fallback;
}

Vector FileContext::vector(const XmlElement& element, Dimension dimension, double fallback) {
  if (dimension != Dimension::other && !has_unit_of(element, "unit", dimension)) {
    const Vector zero = vector(element, Dimension::other, fallback);
    if (zero == Vector{0, 0, 0}) {
      note(element, "its unit is of another kind: took zero, which is the same in any unit");
      return zero;
    }
  }
  const double factor = dimension == Dimension::other ? 1 : unit(element, "unit", dimension);
  return {length(element, "x", factor, fallback), length(element, "y", factor, fallback),
          length(element, "z", factor, fallback)};
}

void FileContext::charge(const XmlElement& element) {
  if (loops == 0) return;
  if (++session.loop_elements > session.options.limits.max_loop_iterations) {
    refuse(element, "loops process more than " +
                        std::to_string(session.options.limits.max_loop_iterations) +
                        " elements; raise GdmlLimits::max_loop_iterations if this is meant");
  }
}

void FileContext::charge_expression(const XmlElement& element, std::string_view expression) {
  constexpr std::size_t usual = 128;  // characters: up to this an expression costs nothing extra
  if (loops == 0 || expression.size() < usual) return;
  session.loop_elements += expression.size() / usual - 1;
  charge(element);
}

void FileContext::loop(const XmlElement& element, const std::function<void()>& body) {
  const auto variable = element.find("for");
  if (!variable) fail(element, "attribute 'for' is missing; name the loop's variable");
  // Geant4 starts from the variable's own value where there is no 'from'.
  const long long from = element.find("from") ? integer(element, "from") : integer(element, "for");
  const long long to = integer(element, "to");
  const long long step = integer(element, "step");
  if (from < to && step <= 0) fail(element, "the loop never ends; make 'step' positive");
  if (from > to && step >= 0) fail(element, "the loop never ends; make 'step' negative");
  if (from == to && step <= 0) fail(element, "the loop never ends; make 'step' positive");
  if (from > to) note(element, "a loop that counts down: ran no turn, as Geant4 does");
  const struct Inside {
    explicit Inside(int& the_loops) : loops(the_loops) { ++loops; }
    ~Inside() { --loops; }
    int& loops;
  } inside(loops);
  for (long long i = from; i <= to; i += step) {
    charge(element);
    at_element(element, [&] { evaluator.set_variable(*variable, static_cast<double>(i)); });
    body();
  }
}

void FileContext::note(const XmlElement& element, const std::string& what, const GdmlError& error) {
  const std::string message = error.what(), place = describe(element) + ": ";
  note(element, what, message.starts_with(place) ? message.substr(place.size()) : message);
}

void FileContext::leave_out(const XmlElement& element, const std::string& message) {
  constexpr std::size_t most = 10'000;
  if (++session.left_out > most) {
    refuse(element,
           "more than " + std::to_string(most) + " definitions cannot be read; mend the file");
  }
  // The place that the message names is that of the part which is wrong.
  const bool whole = message.starts_with(describe(element) + ": ");
  session.notes.add("left out, since it cannot be read", [&] {
    return message + (whole ? "; left out" : "; left out with " + label(element));
  });
}

void FileContext::define_if_readable(const XmlElement& element, const std::string& what,
                                     const std::function<void()>& read) {
  std::string message;
  try {
    return at_element(element, read);
  } catch (const GdmlRefusal&) {
    throw;
  } catch (const GdmlError& e) {
    message = e.what();
  }
  leave_out(element, message);
  std::string name;
  try {
    name = optional_name(element);
  } catch (const GdmlRefusal&) {
    throw;
  } catch (const GdmlError&) {
    return;  // nothing can refer to it
  }
  if (name.empty()) return;
  if (what == "value") {
    evaluator.define_broken(name, message);
  } else {
    broken.insert_or_assign(what + ' ' + name, message);
  }
}

void FileContext::check_readable(const XmlElement& element, const std::string& what,
                                 const std::string& wanted) const {
  const auto found = broken.find(what + ' ' + wanted);
  if (found != broken.end()) fail_needing(element, found->second);
}

void FileContext::fail_unknown(const XmlElement& element, const std::string& what,
                               const std::string& wanted) {
  const std::string quoted = what + " '" + printable(wanted) + "'";
  if (wanted == open_name) refuse(element, quoted + " contains itself; remove the cycle");
  if (const XmlElement* later = find_definition(*document->root, what, wanted)) {
    fail(element, quoted + " is defined only later, or by itself, in line " +
                      std::to_string(later->line) +
                      "; move its definition before its use, or break the cycle");
  }
  fail(element, quoted + " is not defined; define it before its use");
}

}  // namespace navjit::gdml

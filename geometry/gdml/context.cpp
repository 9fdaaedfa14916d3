#include "geometry/gdml/context.hpp"

#include <cmath>

namespace navjit::gdml {
namespace {

std::string known_units(Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
      return "use mm, cm, m, km, um or nm";
    case Dimension::angle:
      return "use deg, rad or mrad";
    case Dimension::density:
      return "use g/cm3, mg/cm3 or kg/m3";
    case Dimension::other:
      break;
  }
  return "use a unit that Geant4 knows";
}

/// The first element of the tree that defines the name, in any section.
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
    fail(element, "a name is longer than " +
                      std::to_string(session.options.limits.max_name_length) +
                      " characters; raise GdmlLimits::max_name_length if this is meant");
  }
  if (loops == 0 && !always) return std::string(text);
  return at_element(element, [&] { return evaluator.resolve_brackets(text); });
}

std::string FileContext::name(const XmlElement& element) {
  const auto value = element.find("name");
  if (!value || value->empty()) fail(element, "it has no name; add a 'name' attribute");
  return resolved(element, *value);
}

std::string FileContext::optional_name(const XmlElement& element) {
  return resolved(element, element.find("name").value_or(""), true);
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
  try {
    return evaluator.evaluate(expression);
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
  try {
    return evaluator.evaluate_integer(*value);
  } catch (const ExpressionError& e) {
    fail(element, std::string(attribute) + ": " + e.what());
  }
}

int FileContext::integer(const XmlElement& element, std::string_view attribute, int fallback) {
  return element.find(attribute) ? integer(element, attribute) : fallback;
}

double FileContext::unit(const XmlElement& element, std::string_view attribute, Dimension dimension,
                         double fallback) {
  const auto text = element.find(attribute);
  if (!text) return fallback;
  const auto found = find_unit(*text);
  if (!found || (dimension != Dimension::other && found->dimension != dimension)) {
    fail(element, std::string(attribute) + ": '" + printable(*text) + "' is not a unit of " +
                      (dimension == Dimension::length  ? "length"
                       : dimension == Dimension::angle ? "angle"
                                                       : "this kind") +
                      "; " + known_units(dimension));
  }
  return found->value;
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
  const double factor = dimension == Dimension::other ? 1 : unit(element, "unit", dimension);
  return {length(element, "x", factor, fallback), length(element, "y", factor, fallback),
          length(element, "z", factor, fallback)};
}

void FileContext::charge(const XmlElement& element) {
  if (loops == 0) return;
  if (++session.loop_elements > session.options.limits.max_loop_iterations) {
    fail(element, "loops process more than " +
                      std::to_string(session.options.limits.max_loop_iterations) +
                      " elements; raise GdmlLimits::max_loop_iterations if this is meant");
  }
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
  ++loops;
  for (long long i = from; i <= to; i += step) {
    charge(element);
    at_element(element, [&] { evaluator.set_variable(*variable, static_cast<double>(i)); });
    body();
  }
  --loops;
}

void FileContext::fail_unknown(const XmlElement& element, const std::string& what,
                               const std::string& wanted) {
  const std::string quoted = what + " '" + printable(wanted) + "'";
  if (wanted == open_name) fail(element, quoted + " contains itself; remove the cycle");
  if (const XmlElement* later = find_definition(*document->root, what, wanted)) {
    fail(element, quoted + " is defined only later, or by itself, in line " +
                      std::to_string(later->line) +
                      "; move its definition before its use, or break the cycle");
  }
  fail(element, quoted + " is not defined; define it before its use");
}

}  // namespace navjit::gdml

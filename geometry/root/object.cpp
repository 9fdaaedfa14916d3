// The questions that one object answers.
#include <algorithm>
#include <cmath>

#include "geometry/printable.hpp"
#include "geometry/root/objects.hpp"

namespace navjit::root {

const Object::Value* Object::find(std::string_view member) const {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const auto& m) { return m.first == member; });
  return found == members.end() ? nullptr : &found->second;
}

double Object::number(std::string_view member) const {
  const Value* value = find(member);
  const double* number = value == nullptr ? nullptr : std::get_if<double>(value);
  if (number == nullptr) fail("it has no number " + std::string(member));
  if (!std::isfinite(*number)) fail(std::string(member) + " is no finite number");
  return *number;
}

double Object::number(std::string_view member, double fallback) const {
  return find(member) == nullptr ? fallback : number(member);
}

std::size_t Object::count(std::string_view member, std::size_t most) const {
  const double value = number(member);
  if (!(value >= 0 && value <= static_cast<double>(most))) {
    fail(std::string(member) + " is " + std::to_string(value) + "; at most " +
         std::to_string(most) + " are read");
  }
  return static_cast<std::size_t>(value);
}

std::span<const double> Object::numbers(std::string_view member, std::size_t least) const {
  const Value* value = find(member);
  const auto* all = value == nullptr ? nullptr : std::get_if<std::vector<double>>(value);
  if (value == nullptr && least == 0) return {};
  if (all == nullptr || all->size() < least) {
    fail("it has no " + std::to_string(least) + " numbers " + std::string(member));
  }
  if (std::any_of(all->begin(), all->end(), [](double x) { return !std::isfinite(x); })) {
    fail("a number of " + std::string(member) + " is not finite");
  }
  return *all;
}

Reference Object::reference(std::string_view member) const {
  const Value* value = find(member);
  const Reference* reference = value == nullptr ? nullptr : std::get_if<Reference>(value);
  return reference == nullptr ? 0 : *reference;
}

std::string Object::label() const { return printable(type) + " '" + printable(name) + "'"; }

void Object::fail(const std::string& problem) const { throw FormatError(label() + ": " + problem); }

}  // namespace navjit::root

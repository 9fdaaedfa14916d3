// Writes XML: escaped text, numbers that are read back unchanged, names that are unique.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace navjit::gdml {

/// Text, escaped for an attribute.
std::string escaped(std::string_view text);

/// The shortest decimal number that is read back as this one.
std::string number_text(double value);

/// ` name="text"`.
std::string attribute(std::string_view name, std::string_view text);

using Numbers = std::initializer_list<std::pair<std::string_view, double>>;

/// ` a="1" b="2.5"`.
std::string attributes(Numbers numbers);

/// Makes names unique, so that references can tell them apart.
class NameBook {
 public:
  /// The name itself, or the name with a number if it is taken or empty.
  std::string own(const std::string& name) {
    const auto [taken, is_free] = next_number_.try_emplace(name.empty() ? "nameless" : name, 2);
    if (is_free) return taken->first;
    // The next number is kept, since a million corners may share one name.
    for (int& number = taken->second;;) {
      const std::string unique = name + '_' + std::to_string(number++);
      if (next_number_.try_emplace(unique, 2).second) return unique;
    }
  }

 private:
  std::unordered_map<std::string, int> next_number_;  ///< by name that is taken
};

}  // namespace navjit::gdml

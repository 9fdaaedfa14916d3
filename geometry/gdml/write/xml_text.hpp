// XML as it is written: escaped text, numbers that are read back as they are, names of their own.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace navjit::gdml {

/// Text within an attribute.
std::string escaped(std::string_view text);

/// The shortest decimal number that is read back as this one.
std::string number_text(double value);

/// ` name="text"`.
std::string attribute(std::string_view name, std::string_view text);

using Numbers = std::initializer_list<std::pair<std::string_view, double>>;

/// ` a="1" b="2.5"`.
std::string attributes(Numbers numbers);

/// Names that references can tell apart.
class NameBook {
 public:
  /// The name, or that and a number if it is taken or empty.
  std::string own(const std::string& name) {
    std::string unique = name.empty() ? "nameless" : name;
    for (int i = 2; !taken_.insert(unique).second; ++i) unique = name + '_' + std::to_string(i);
    return unique;
  }

 private:
  std::unordered_set<std::string> taken_;
};

}  // namespace navjit::gdml

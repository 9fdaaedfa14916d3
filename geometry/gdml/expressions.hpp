// Values of GDML expressions: numbers, names, operators and functions, with CLHEP's rules.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>

namespace navjit::gdml {

/// What is wrong with an expression; the caller adds where it stands.
struct ExpressionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The expression names a definition that could not be read; the message tells where that is.
struct BrokenDefinition : ExpressionError {
  using ExpressionError::ExpressionError;
};

struct StringHash : std::hash<std::string_view> {
  using is_transparent = void;
};
/// Keyed by names of the file; looked up without making a string.
template <class T>
using StringMap = std::unordered_map<std::string, T, StringHash, std::equal_to<>>;

/// The named values of one file, and the values of expressions over them and the built-in units.
/// As in CLHEP, ^ and ** are powers, bind tighter than a sign and group from the left, and blanks
/// around a name that is defined are not part of it.
class Evaluator {
 public:
  Evaluator();
  ~Evaluator();

  /// Throws ExpressionError if the file has already defined the name, or it is not a name.
  void define_constant(std::string_view name, double value);
  void define_variable(std::string_view name, double value);
  /// From now on whatever uses the name, or an element of the matrix of that name, throws
  /// BrokenDefinition with this message.
  void define_broken(std::string_view name, const std::string& message);
  /// The value that the file has defined for the name, if it has.
  std::optional<double> defined(std::string_view name) const;
  /// Sets a defined variable; throws ExpressionError otherwise.
  void set_variable(std::string_view name, double value);

  /// A finite number. Throws ExpressionError.
  double evaluate(std::string_view expression);
  /// Throws ExpressionError if the value is not an integer that an int holds.
  int evaluate_integer(std::string_view expression);
  /// Replaces brackets by what GDML means by them: m[i] by m_{i-1}, m[i,j] by m_{i-1}_{j-1}.
  std::string resolve_brackets(std::string_view text);

 private:
  struct Value {
    double number;
    bool variable = false;
    bool builtin = false;  ///< a unit, kept for the next look-up; the file may redefine it
  };
  struct Parser;

  void define(std::string_view name, double value, bool variable);
  const double* find(std::string_view name);
  void check_readable(std::string_view name) const;
  double parse(const std::string& expression);
  double parse_compiled(const std::string& expression);

  StringMap<Value> values_;
  StringMap<std::string> broken_;
  StringMap<std::unique_ptr<Parser>> compiled_;  ///< by expression, the first ones met
  std::unique_ptr<Parser> parser_;               ///< for the others
};

}  // namespace navjit::gdml

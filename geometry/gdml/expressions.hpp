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

/// What is wrong with an expression; the caller adds where the expression stands.
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
/// A map by names of the file; a look-up makes no string.
template <class T>
using StringMap = std::unordered_map<std::string, T, StringHash, std::equal_to<>>;

/// The named values of one file, and the values of expressions over them and the built-in units.
/// As in CLHEP, ^ and ** are powers, bind tighter than a sign and group from the left, and blanks
/// around a name that is defined are not part of it.
class Evaluator {
 public:
  Evaluator();
  ~Evaluator();

  /// Throws ExpressionError if the file has already defined the name, or if it is no name.
  void define_constant(std::string_view name, double value);
  void define_variable(std::string_view name, double value);
  /// From now on, an expression with this name, or with an element of the matrix of this name,
  /// throws BrokenDefinition with this message.
  void define_broken(std::string_view name, const std::string& message);
  /// The value that the file has defined for the name; nothing if there is none.
  std::optional<double> defined(std::string_view name) const;
  /// Changes a defined variable; throws ExpressionError if there is none of this name.
  void set_variable(std::string_view name, double value);

  /// The value, a finite number. Throws ExpressionError.
  double evaluate(std::string_view expression);
  /// Throws ExpressionError if the value is not an integer that an int holds.
  int evaluate_integer(std::string_view expression);
  /// Replaces brackets as GDML means them: m[i] by m_{i-1}, m[i,j] by m_{i-1}_{j-1}.
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
  StringMap<std::unique_ptr<Parser>> compiled_;  ///< by expression; those that were met first
  std::unique_ptr<Parser> parser_;               ///< for all other expressions
};

}  // namespace navjit::gdml

#include "geometry/gdml/expressions.hpp"

#include <muParser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "geometry/gdml/units.hpp"
#include "geometry/gdml/xml.hpp"

namespace navjit::gdml {
namespace {

// Longer and deeper than anything that people write; bounds the parser's work.
constexpr std::size_t longest_expression = 10'000;
constexpr std::size_t most_compiled = 100;

constexpr std::string_view blanks = " \t\r\n";
constexpr std::string_view name_characters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
constexpr std::string_view other_characters = " \t\r\n.,+-*/^()<>=!&|";

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_name(std::string_view text) {
  return !text.empty() && !is_digit(text.front()) &&
         text.find_first_not_of(name_characters) == std::string_view::npos;
}

std::string in_quotes(std::string_view text) { return "'" + printable(text) + "'"; }

/// The value of a decimal number that is beyond the range of doubles. strtod() would want the
/// decimal point of the program's locale.
double out_of_range(std::string_view text) {
  // Where the first digit other than 0 stands: how many powers of ten above or below 1.
  const std::string_view digits = text.substr(0, text.find_first_of("eE"));
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  double power = first == std::string_view::npos ? 0.0
                 : first < point                 ? static_cast<double>(point - first)
                                                 : -static_cast<double>(first - point);
  if (digits.size() < text.size()) {
    const std::string_view exponent = text.substr(digits.size() + 1);
    // As a double, since the exponent may be beyond all whole numbers.
    double value = 0;
    const std::string_view bare = exponent.substr(exponent.starts_with('+') ? 1 : 0);
    const auto [end, error] =
        std::from_chars(bare.data(), bare.data() + bare.size(), value, std::chars_format::fixed);
    power = error == std::errc::result_out_of_range
                ? (bare.starts_with('-') ? -1 : 1) * std::numeric_limits<double>::infinity()
                : power + value;
  }
  const double size = power > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return text.starts_with('-') ? -size : size;
}

/// Reads a plain number; most values in real files are such. Those beyond the range of doubles
/// become infinite or zero.
bool read_number(std::string_view text, double& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const char first = text.empty() ? ' ' : text[text.starts_with('-') && text.size() > 1];
  if (!is_digit(first) && first != '.') return false;  // from_chars would take "inf"
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range) value = out_of_range(text);
  return true;
}

bool is_sign(char c) { return c == '+' || c == '-'; }

/// CLHEP takes several signs in a row for one: `--5` is 5, `10-+-3` is 13. After an operand the
/// first of them is the operator. Returns where they end; a single sign is left as it is.
std::size_t take_signs(const std::string& expression, std::size_t begin, std::string& text) {
  bool negative = false;
  std::size_t end = begin, count = 0;
  const auto last = text.find_last_not_of(blanks);
  const bool after_operand =
      last != std::string::npos && (name_characters.find(text[last]) != std::string_view::npos ||
                                    text[last] == ')' || text[last] == '.');
  for (std::size_t i = begin; i < expression.size(); ++i) {
    if (blanks.find(expression[i]) != std::string_view::npos) continue;
    if (!is_sign(expression[i])) break;
    if (count++ > 0 || !after_operand) negative = negative != (expression[i] == '-');
    end = i + 1;
  }
  if (count == 1) {
    text += expression[begin];
    return begin + 1;
  }
  if (after_operand) text += expression[begin];
  if (negative) text += '-';
  return end;
}

/// The expression in the parser's spelling. Throws on characters that mean more to the parser.
std::string checked(const std::string& expression) {
  std::string text;
  for (std::size_t i = 0; i < expression.size(); ++i) {
    const char c = expression[i];
    if (is_sign(c)) {
      i = take_signs(expression, i, text) - 1;
      continue;
    }
    // There may be blanks between a function's name and its parenthesis.
    if (c == '(') {
      const auto name = text.find_last_not_of(blanks);
      if (name != std::string::npos && name_characters.find(text[name]) != std::string_view::npos) {
        text.resize(name + 1);
      }
    }
    if (name_characters.find(c) == std::string_view::npos &&
        other_characters.find(c) == std::string_view::npos) {
      throw ExpressionError(in_quotes(expression) + " is not a number or expression");
    }
    const bool power = c == '*' && i + 1 < expression.size() && expression[i + 1] == '*';
    if (power) ++i;
    text += power ? '^' : c;
  }
  return text;
}

double divide(double a, double b) {
  if (b == 0) throw ExpressionError("division by zero");
  return a / b;
}
double plus(double a) { return a; }
double minus(double a) { return 0 - a; }
double add(double a, double b) { return a + b; }
double subtract(double a, double b) { return a - b; }
double multiply(double a, double b) { return a * b; }
double power(double a, double b) { return std::pow(a, b); }
double equal(double a, double b) { return a == b; }
double unequal(double a, double b) { return a != b; }
double less(double a, double b) { return a < b; }
double greater(double a, double b) { return a > b; }
double less_equal(double a, double b) { return a <= b; }
double greater_equal(double a, double b) { return a >= b; }
double logical_and(double a, double b) { return a != 0 && b != 0; }
double logical_or(double a, double b) { return a != 0 || b != 0; }

double absolute(double a) { return std::abs(a); }
double square_root(double a) { return std::sqrt(a); }
double smaller(double a, double b) { return std::min(a, b); }
double larger(double a, double b) { return std::max(a, b); }
double sine(double a) { return std::sin(a); }
double cosine(double a) { return std::cos(a); }
double tangent(double a) { return std::tan(a); }
double arc_sine(double a) { return std::asin(a); }
double arc_cosine(double a) { return std::acos(a); }
double arc_tangent(double a) { return std::atan(a); }
double arc_tangent2(double a, double b) { return std::atan2(a, b); }
double sinh_of(double a) { return std::sinh(a); }
double cosh_of(double a) { return std::cosh(a); }
double tanh_of(double a) { return std::tanh(a); }
double exponential(double a) { return std::exp(a); }
double logarithm(double a) { return std::log(a); }
double logarithm10(double a) { return std::log10(a); }
double round_up(double a) { return std::ceil(a); }
double round_down(double a) { return std::floor(a); }

}  // namespace

/// muParser without its own operators, functions and constants: its power groups from the right, it
/// assigns to variables, and its optimiser rounds differently.
struct Evaluator::Parser : mu::Parser {
  explicit Parser(Evaluator& evaluator) {
    ClearConst();
    ClearFun();
    ClearInfixOprt();
    ClearPostfixOprt();
    EnableBuiltInOprt(false);
    EnableOptimizer(false);
    DefineOprtChars("+-*/^<>=!&|");
    DefineInfixOprtChars("+-");
    DefineOprt("||", logical_or, mu::prLOR);
    DefineOprt("&&", logical_and, mu::prLAND);
    DefineOprt("==", equal, mu::prLOGIC);
    DefineOprt("!=", unequal, mu::prLOGIC);
    DefineOprt("<=", less_equal, mu::prCMP);
    DefineOprt(">=", greater_equal, mu::prCMP);
    DefineOprt("<", less, mu::prCMP);
    DefineOprt(">", greater, mu::prCMP);
    DefineOprt("+", add, mu::prADD_SUB);
    DefineOprt("-", subtract, mu::prADD_SUB);
    DefineOprt("*", multiply, mu::prMUL_DIV);
    DefineOprt("/", divide, mu::prMUL_DIV);
    DefineOprt("^", power, mu::prPOW, mu::oaLEFT);
    DefineInfixOprt("+", plus, mu::prINFIX);
    DefineInfixOprt("-", minus, mu::prINFIX);
    DefineFun("abs", absolute);
    DefineFun("sqrt", square_root);
    DefineFun("min", smaller);
    DefineFun("max", larger);
    DefineFun("pow", power);
    DefineFun("sin", sine);
    DefineFun("cos", cosine);
    DefineFun("tan", tangent);
    DefineFun("asin", arc_sine);
    DefineFun("acos", arc_cosine);
    DefineFun("atan", arc_tangent);
    DefineFun("atan2", arc_tangent2);
    DefineFun("sinh", sinh_of);
    DefineFun("cosh", cosh_of);
    DefineFun("tanh", tanh_of);
    DefineFun("exp", exponential);
    DefineFun("log", logarithm);
    DefineFun("log10", logarithm10);
    DefineFun("ceil", round_up);
    DefineFun("floor", round_down);
    SetVarFactory(find_variable, &evaluator);
  }

  static double* find_variable(const char* name, void* evaluator) {
    const double* value = static_cast<Evaluator*>(evaluator)->find(name);
    if (value == nullptr) {
      throw ExpressionError("unknown name " + in_quotes(name) +
                            "; define it before its use (units are mm, cm, deg, ...)");
    }
    // This is safe: nothing is left in the parser that assigns.
    return const_cast<double*>(value);
  }
};

Evaluator::Evaluator() = default;
Evaluator::~Evaluator() = default;

void Evaluator::define_constant(std::string_view name, double value) { define(name, value, false); }

void Evaluator::define_variable(std::string_view name, double value) { define(name, value, true); }

void Evaluator::define(std::string_view name, double value, bool variable) {
  name = trimmed(name);
  const auto [position, added] = values_.try_emplace(std::string(name), Value{value, variable});
  if (added) return;
  if (!position->second.builtin) {
    throw ExpressionError(in_quotes(name) + " is already defined; rename one of the two");
  }
  position->second = {value, variable};
}

void Evaluator::set_variable(std::string_view name, double value) {
  name = trimmed(name);
  if (!broken_.empty()) check_readable(name);
  const auto found = values_.find(name);
  if (found == values_.end() || !found->second.variable) {
    throw ExpressionError("variable " + in_quotes(name) +
                          " is not defined; add a <variable> to the " + "file's <define>");
  }
  found->second.number = value;
}

void Evaluator::define_broken(std::string_view name, const std::string& message) {
  broken_.try_emplace(std::string(trimmed(name)), message);
  // Parsers remember the addresses of the values whose names they have met.
  compiled_.clear();
  parser_.reset();
}

std::optional<double> Evaluator::defined(std::string_view name) const {
  const auto found = values_.find(trimmed(name));
  if (found == values_.end() || found->second.builtin) return std::nullopt;
  return found->second.number;
}

/// Elements of a matrix have its name with one or two numbers appended.
void Evaluator::check_readable(std::string_view name) const {
  for (int indices = 0; indices <= 2; ++indices) {
    const auto found = broken_.find(name);
    if (found != broken_.end()) throw BrokenDefinition(found->second);
    while (!name.empty() && is_digit(name.back())) name.remove_suffix(1);
    if (!name.ends_with('_')) return;
    name.remove_suffix(1);
  }
}

const double* Evaluator::find(std::string_view name) {
  if (!broken_.empty()) check_readable(name);
  const auto found = values_.find(name);
  if (found != values_.end()) return &found->second.number;
  const auto builtin = find_builtin(name);
  if (!builtin) return nullptr;
  return &values_.try_emplace(std::string(name), Value{*builtin, false, true}).first->second.number;
}

double Evaluator::evaluate(std::string_view expression) {
  std::string_view text = trimmed(expression);
  if (text.empty()) throw ExpressionError("the value is empty; write a number");
  if (text.size() > longest_expression) throw ExpressionError("the expression is too long");
  double value = 0;
  if (!read_number(text, value)) {
    const std::string resolved = resolve_brackets(text);
    if (text.find('[') != std::string_view::npos && resolved.find("_-") != std::string::npos) {
      throw ExpressionError("an index in " + in_quotes(text) + " is below 1; GDML counts from 1");
    }
    const double* named = is_name(resolved) ? find(resolved) : nullptr;
    value = named != nullptr ? *named : parse(resolved);
  }
  if (!std::isfinite(value)) {
    throw ExpressionError("the value of " + in_quotes(text) + " is not a finite number");
  }
  return value;
}

double Evaluator::parse(const std::string& expression) {
  try {
    return parse_compiled(expression);
  } catch (...) {
    // A parser that failed in the middle cannot be asked again.
    compiled_.erase(expression);
    parser_.reset();
    throw;
  }
}

double Evaluator::parse_compiled(const std::string& expression) {
  const auto compiled = compiled_.find(expression);
  Parser* parser = compiled != compiled_.end() ? compiled->second.get() : nullptr;
  try {
    if (parser == nullptr) {
      const std::string text = checked(expression);
      // Loops evaluate the same few expressions again and again.
      auto& slot = compiled_.size() < most_compiled ? compiled_[expression] : parser_;
      if (slot == nullptr) slot = std::make_unique<Parser>(*this);
      parser = slot.get();
      parser->SetExpr(text);
    }
    int results = 0;
    const double* value = parser->Eval(results);
    if (results != 1) throw ExpressionError(in_quotes(expression) + " has more than one value");
    return *value;
  } catch (const mu::ParserError& e) {
    throw ExpressionError(in_quotes(expression) +
                          " is not a number or expression: " + printable(e.GetMsg()));
  }
}

int Evaluator::evaluate_integer(std::string_view expression) {
  const double value = evaluate(expression);
  if (value != std::trunc(value) || std::abs(value) > std::numeric_limits<int>::max()) {
    throw ExpressionError(in_quotes(expression) + " must be an integer");
  }
  return static_cast<int>(value);
}

std::string Evaluator::resolve_brackets(std::string_view text) {
  std::string result;
  for (;;) {
    const auto open = text.find('[');
    const auto close = text.find(']');
    if (open == std::string_view::npos && close == std::string_view::npos) break;
    if (close == std::string_view::npos || open > close) {
      throw ExpressionError("brackets do not match in " + in_quotes(text));
    }
    std::string_view indices = text.substr(open + 1, close - open - 1);
    if (indices.find('[') != std::string_view::npos) {
      throw ExpressionError("brackets within brackets in " + in_quotes(text));
    }
    result += text.substr(0, open);
    for (;;) {
      const auto comma = std::min(indices.find(','), indices.size());
      const auto index = static_cast<long long>(evaluate_integer(indices.substr(0, comma))) - 1;
      result += '_' + std::to_string(index);
      if (comma == indices.size()) break;
      indices.remove_prefix(comma + 1);
    }
    text.remove_prefix(close + 1);
  }
  return result += text;
}

}  // namespace navjit::gdml

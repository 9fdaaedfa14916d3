#include "geometry/gdml/expressions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace navjit::gdml {
namespace {

constexpr double pi = std::numbers::pi;

class GdmlExpressions : public ::testing::Test {
 protected:
  void SetUp() override {
    evaluator_.define_constant("width", 40);
    evaluator_.define_variable("i", 3);
    evaluator_.define_constant("row_0", 1.5);
    evaluator_.define_constant("row_1", 2.5);
    evaluator_.define_constant("row_2", 3.5);
    evaluator_.define_constant("table_1_2", 42);
  }
  std::string error(const std::string& expression) {
    try {
      evaluator_.evaluate(expression);
    } catch (const ExpressionError& e) {
      return e.what();
    }
    ADD_FAILURE() << "'" << expression << "' has a value";
    return {};
  }
  Evaluator evaluator_;
};

TEST_F(GdmlExpressions, HaveTheValuesOfClhep) {
  const struct {
    const char* text;
    double value;
  } table[] = {
      {"1", 1},
      {" -2.5e-3 ", -2.5e-3},
      {"+7", 7},
      {".5", 0.5},
      {"5.", 5},
      {"1e-400", 0},
      {"-1e-400", 0},
      {"0.000e999999999999999999", 0},
      {"7.5e-400", 0},
      {"max (2, 3)", 3},
      {"sqrt\t( 4 )", 2},
      {"--5", 5},
      {"- -5", 5},
      {"-+5+10", 5},
      {"10-+-3", 13},
      {"10 - - - 3", 7},
      {"2*--3", 6},
      {"(--width)-1e-5*0", 40},
      {"width", 40},
      {"width/2+1", 21},
      {"2*(i-1)", 4},
      {"-width", -40},
      {"3--2", 5},
      {"2*-3", -6},
      {"2^3", 8},
      {"2**3", 8},
      {"2^3^2", 64},  // groups from the left
      {"2**3**2", 64},
      {"-2^2", -4},  // binds tighter than a sign
      {"2^-1", 0.5},
      {"10-4-3", 3},
      {"100/5/2", 10},
      {"1+2*3", 7},
      {"5*cm", 50},
      {"2*m+3*mm", 2003},
      {"1*km", 1e6},
      {"1*um", 1e-3},
      {"90*deg", pi / 2},
      {"180*degree", pi},
      {"2*rad", 2},
      {"5*mrad", 5e-3},
      {"pi", pi},
      {"twopi", 2 * pi},
      {"halfpi", pi / 2},
      {"10*MeV/GeV", 0.01},
      {"sin(30*deg)", 0.5},
      {"cos(60*deg)", 0.5},
      {"tan(45*deg)", 1},
      {"asin(1)", pi / 2},
      {"acos(0)", pi / 2},
      {"atan(1)", pi / 4},
      {"atan2(1,-1)", 3 * pi / 4},
      {"sqrt(2)", std::sqrt(2.0)},
      {"exp(1)", std::exp(1.0)},
      {"log(exp(2))", 2},
      {"log10(1000)", 3},
      {"pow(2,10)", 1024},
      {"min(1,2)", 1},
      {"max(1,2)", 2},
      {"abs(-3)", 3},
      {"i > 2", 1},
      {"i == 3 && width != 40", 0},
      {"i < 3 || width >= 40", 1},
      {"row[1]", 1.5},
      {"row[i]", 3.5},
      {"row[i-1]*2", 5},
      {"row[1]+row[2]", 4},
      {"table[2,3]", 42},
      {"table[i-1, i]", 42},
      {"row_0", 1.5},
  };
  for (const auto& row : table) {
    EXPECT_DOUBLE_EQ(evaluator_.evaluate(row.text), row.value) << row.text;
    EXPECT_DOUBLE_EQ(evaluator_.evaluate(row.text), row.value) << row.text << " again";
  }
}

TEST_F(GdmlExpressions, ThatFailFailAgain) {
  // What a module or a second <materials> repeats is evaluated again.
  for (const char* text : {"1auxtype=3", "1 +", "width * nothing", "2 3", "(1", "1)", "max(1",
                           "1/0", "width = 2", "1 == ", "a=b=c", "sin()", "2-7width"}) {
    const std::string first = error(text);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(error(text), first) << text;
    EXPECT_EQ(evaluator_.evaluate("2 * width"), 80) << text;
  }
}

TEST_F(GdmlExpressions, RoundAsWritten) {
  // No folding of constants, no fused or reordered operations.
  evaluator_.define_variable("x", 0.1);
  const volatile double x = 0.1;
  EXPECT_EQ(evaluator_.evaluate("x*3+x*4"), x * 3 + x * 4);
  EXPECT_EQ(evaluator_.evaluate("x*3*7"), x * 3 * 7);
  EXPECT_EQ(evaluator_.evaluate("0.1+0.2+x"), 0.1 + 0.2 + x);
}

TEST_F(GdmlExpressions, FollowVariables) {
  EXPECT_EQ(evaluator_.evaluate("i*2"), 6);
  evaluator_.set_variable("i", 10);
  EXPECT_EQ(evaluator_.evaluate("i*2"), 20);
  EXPECT_EQ(evaluator_.evaluate("i"), 10);
  EXPECT_THROW(evaluator_.set_variable("width", 1), ExpressionError);
  EXPECT_THROW(evaluator_.set_variable("j", 1), ExpressionError);
}

TEST_F(GdmlExpressions, DefineNamesOnce) {
  EXPECT_THROW(evaluator_.define_constant("width", 1), ExpressionError);
  EXPECT_THROW(evaluator_.define_variable("width", 1), ExpressionError);
  // The file's own names come before units, even those already used.
  EXPECT_EQ(evaluator_.evaluate("2*m"), 2000);
  evaluator_.define_constant("m", 5);
  EXPECT_EQ(evaluator_.evaluate("2*m"), 10);
}

TEST_F(GdmlExpressions, ResolveBracketsInNames) {
  EXPECT_EQ(evaluator_.resolve_brackets("plain"), "plain");
  EXPECT_EQ(evaluator_.resolve_brackets("cell[i]"), "cell_2");
  EXPECT_EQ(evaluator_.resolve_brackets("cell[i,2*i]_x"), "cell_2_5_x");
  EXPECT_EQ(evaluator_.resolve_brackets("a[1]b[2]"), "a_0b_1");
  EXPECT_EQ(evaluator_.resolve_brackets("a[0]"), "a_-1");
}

TEST_F(GdmlExpressions, AreRefusedIfTheyHaveNoNumber) {
  for (const char* text : {"",
                           "  ",
                           "+",
                           "-",
                           ".",
                           "e5",
                           "abc",
                           "1+",
                           "*2",
                           "(1",
                           "1)",
                           "((((",
                           "1 2",
                           "1,2",
                           "sin",
                           "sin()",
                           "sin(1,2)",
                           "pow(1)",
                           "nofunction(1)",
                           "5mm",
                           "0x10",
                           "\"text\"",
                           "1;2",
                           "#",
                           "$",
                           "1?2:3",
                           "rnd()",
                           "inf",
                           "nan",
                           "-inf",
                           "1e999",
                           "-1e999",
                           "1/0",
                           "sqrt(-1)",
                           "log(0)",
                           "2***3",
                           "row[",
                           "row]",
                           "row[[1]]",
                           "row[0]",
                           "row[4]",
                           "row[1.5]",
                           "row[]",
                           "row[1e10]",
                           "\xc3\xa9",
                           "a b",
                           "i=5",
                           "i+=1",
                           "_pi",
                           "_e",
                           "x'"}) {
    EXPECT_THROW(evaluator_.evaluate(text), ExpressionError) << text;
  }
  EXPECT_EQ(evaluator_.evaluate("i"), 3) << "an expression has assigned to a variable";
  EXPECT_NE(error("1+unknown").find("unknown name 'unknown'"), std::string::npos);
  EXPECT_NE(error("1/(2-2)").find("division by zero"), std::string::npos);
  EXPECT_NE(error("row[0]").find("below 1"), std::string::npos);
}

TEST_F(GdmlExpressions, SurviveHugeOnes) {
  EXPECT_THROW(evaluator_.evaluate(std::string(1'000'000, '(')), ExpressionError);
  EXPECT_THROW(evaluator_.evaluate(std::string(9000, '(')), ExpressionError);
  EXPECT_THROW(evaluator_.evaluate(std::string(9000, '-')), ExpressionError);
  std::string sum = "0";
  for (int n = 0; n < 4000; ++n) sum += "+1";
  EXPECT_EQ(evaluator_.evaluate(sum), 4000);
  EXPECT_EQ(evaluator_.evaluate(std::string(4000, '(') + "1" + std::string(4000, ')')), 1);
}

TEST_F(GdmlExpressions, BlanksAroundADefinedNameAreNotPartOfIt) {
  evaluator_.define_constant("gap ", 2);
  EXPECT_EQ(evaluator_.evaluate("2*gap"), 4);
  EXPECT_EQ(evaluator_.defined("gap"), 2);
  EXPECT_THROW(evaluator_.define_constant(" gap", 3), ExpressionError);
  evaluator_.define_variable("\tk", 1);
  evaluator_.set_variable("k ", 5);
  EXPECT_EQ(evaluator_.evaluate("k"), 5);
  evaluator_.define_broken("lost ", "no value");
  EXPECT_EQ(error("lost"), "no value");
}

TEST_F(GdmlExpressions, IntegersHaveNoFraction) {
  EXPECT_EQ(evaluator_.evaluate_integer("2*i+1"), 7);
  EXPECT_EQ(evaluator_.evaluate_integer("-3"), -3);
  EXPECT_THROW(evaluator_.evaluate_integer("1.5"), ExpressionError);
  EXPECT_THROW(evaluator_.evaluate_integer("1e10"), ExpressionError);
}

}  // namespace
}  // namespace navjit::gdml

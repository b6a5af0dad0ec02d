#include "execution/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "language/made_program.hpp"

namespace probewright::execution {
namespace {

using ::testing::HasSubstr;

class EvaluationTest : public ::testing::Test {
protected:
  Value value(const Operand& operand) { return Evaluation(program, make.block, host).value(operand); }
  double number(const Operand& operand) { return Evaluation(program, make.block, host).number(operand); }
  double of(Function function, std::vector<double> arguments) {
    std::vector<Operand> operands;
    for (const double argument : arguments)
      operands.push_back(Operand::of(argument));
    return number(make.call(function, operands));
  }
  double of(Operation operation, double left, double right) {
    return number(make.binary(operation, Operand::of(left), right));
  }
  std::string alarm(const Operand& operand) {
    try {
      number(operand);
    } catch (const control::Alarm& caught) {
      return caught.text();
    }
    return "no alarm";
  }
  std::string alarm(Function function, std::vector<double> arguments) {
    std::vector<Operand> operands;
    for (const double argument : arguments)
      operands.push_back(Operand::of(argument));
    return alarm(make.call(function, operands));
  }
  std::string alarm(Operation operation, double left, double right) {
    return alarm(make.binary(operation, Operand::of(left), right));
  }

  MadeProgram program{"P", {}};
  RecordingHost host;
  Make make;
};

TEST_F(EvaluationTest, TrigonometryIsExactAtMultiplesOfNinetyDegrees) {
  for (int turn = -8; turn <= 8; ++turn) {
    EXPECT_EQ(of(Function::Sin, {360.0 * turn}), 0);
    EXPECT_EQ(of(Function::Sin, {360.0 * turn + 90}), 1);
    EXPECT_EQ(of(Function::Sin, {360.0 * turn + 180}), 0);
    EXPECT_EQ(of(Function::Sin, {360.0 * turn + 270}), -1);
    EXPECT_EQ(of(Function::Cos, {360.0 * turn}), 1);
    EXPECT_EQ(of(Function::Cos, {360.0 * turn + 90}), 0);
    EXPECT_EQ(of(Function::Cos, {360.0 * turn + 180}), -1);
    EXPECT_EQ(of(Function::Cos, {360.0 * turn - 90}), 0);
    EXPECT_EQ(of(Function::Tan, {180.0 * turn}), 0);
  }
  EXPECT_DOUBLE_EQ(of(Function::Sin, {30}), 0.5);
  EXPECT_DOUBLE_EQ(of(Function::Cos, {60}), 0.5);
  EXPECT_DOUBLE_EQ(of(Function::Tan, {45}), 1);
  EXPECT_DOUBLE_EQ(of(Function::Tan, {-225}), -1);
  EXPECT_NEAR(of(Function::Sin, {123.456}), std::sin(123.456 * std::numbers::pi / 180), 1e-15);
  EXPECT_NEAR(of(Function::Cos, {-223.456}), std::cos(-223.456 * std::numbers::pi / 180), 1e-15);
}

TEST_F(EvaluationTest, FunctionsGiveTheirKnownValues) {
  EXPECT_DOUBLE_EQ(of(Function::Asin, {0.5}), 30);
  EXPECT_DOUBLE_EQ(of(Function::Acos, {-1}), 180);
  EXPECT_DOUBLE_EQ(of(Function::Acos, {1 + 1e-13}), 0);
  EXPECT_DOUBLE_EQ(of(Function::Atan, {1}), 45);
  EXPECT_DOUBLE_EQ(of(Function::Atan2, {1, -1}), 135);
  EXPECT_DOUBLE_EQ(of(Function::Atan2, {-1, -1}), -135);
  EXPECT_DOUBLE_EQ(of(Function::Atan2, {30.5, 80.1}), 20.84553392675195);
  EXPECT_EQ(of(Function::Sqrt, {144}), 12);
  EXPECT_EQ(of(Function::Square, {-1.5}), 2.25);
  EXPECT_DOUBLE_EQ(of(Function::Ln, {std::numbers::e}), 1);
  EXPECT_EQ(of(Function::Log, {1000}), 3);
  EXPECT_DOUBLE_EQ(of(Function::Exp, {1}), std::numbers::e);
  EXPECT_EQ(of(Function::Abs, {-3.5}), 3.5);
  EXPECT_EQ(of(Function::Integer, {-3.7}), -3);
  EXPECT_EQ(of(Function::Truncate, {3.7}), 3);
  EXPECT_DOUBLE_EQ(of(Function::Fraction, {-42.25}), -0.25);
  EXPECT_EQ(of(Function::Sign, {-0.1}), -1);
  EXPECT_EQ(of(Function::Sign, {0}), 0);
  EXPECT_EQ(of(Function::Sign, {7}), 1);
  EXPECT_EQ(of(Function::RootSumOfSquares, {3, 4}), 5);
  EXPECT_EQ(of(Function::Round, {2.5}), 3);
  EXPECT_EQ(of(Function::Round, {-2.5}), -3);
  EXPECT_EQ(of(Function::RoundUp, {3.1}), 4);
  EXPECT_EQ(of(Function::RoundUp, {-3.6}), -3);
  EXPECT_EQ(of(Function::Minimum, {3, -1, 2}), -1);
  EXPECT_EQ(of(Function::Maximum, {3, -1}), 3);
  EXPECT_EQ(of(Function::Bound, {0, 10, 12}), 10);
  EXPECT_EQ(of(Function::Bound, {0, 10, -2}), 0);
  EXPECT_EQ(of(Function::Bound, {0, 10, 2}), 2);
}

TEST_F(EvaluationTest, OperationsOnIntegersAndBits) {
  EXPECT_EQ(of(Operation::IntegerDivide, 7, 4.1), 1);
  EXPECT_EQ(of(Operation::IntegerDivide, -7, 2), -3);
  EXPECT_EQ(of(Operation::Modulo, 7, 4), 3);
  EXPECT_EQ(of(Operation::Modulo, -7, 4), -3);
  EXPECT_EQ(of(Operation::BitAnd, 12, 10), 8);
  EXPECT_EQ(of(Operation::BitOr, 12, 10), 14);
  EXPECT_EQ(of(Operation::BitExclusiveOr, 12, 10), 6);
  EXPECT_EQ(number(make.unary(Operation::BitNot, Operand::of(0))), -1);
  EXPECT_EQ(number(make.unary(Operation::Not, Operand::of(2))), 0);
  EXPECT_EQ(number(make.unary(Operation::Negate, Operand::of(2))), -2);
  EXPECT_EQ(of(Operation::ExclusiveOr, 3, 4), 0);
  EXPECT_EQ(of(Operation::ExclusiveOr, 3, 0), 1);
  EXPECT_EQ(of(Operation::Power, -2, 3), -8);
  EXPECT_EQ(of(Operation::Power, 0, 0), 1);
}

TEST_F(EvaluationTest, LogicLooksRightOnlyWhenItMatters) {
  const Operand bad = make.binary(Operation::Divide, Operand::of(1), 0);
  EXPECT_EQ(number(make.binary(Operation::And, Operand::of(0), bad)), 0);
  EXPECT_EQ(number(make.binary(Operation::Or, Operand::of(5), bad)), 1);
  EXPECT_EQ(alarm(make.binary(Operation::And, Operand::of(1), bad)), "the divisor is 0");
}

TEST_F(EvaluationTest, ComparisonsOfNumbersAndTexts) {
  for (const double left : {-1.0, 0.0, 1.0}) {
    for (const double right : {-1.0, 0.0, 1.0}) {
      EXPECT_EQ(of(Operation::Equal, left, right), left == right);
      EXPECT_EQ(of(Operation::NotEqual, left, right), left != right);
      EXPECT_EQ(of(Operation::Less, left, right), left < right);
      EXPECT_EQ(of(Operation::LessEqual, left, right), left <= right);
      EXPECT_EQ(of(Operation::Greater, left, right), left > right);
      EXPECT_EQ(of(Operation::GreaterEqual, left, right), left >= right);
    }
  }
  const auto text = [this](const char* characters) { return make.text(characters); };
  EXPECT_EQ(number(make.binary(Operation::Equal, text("ABC"), text("ABC"))), 1);
  EXPECT_EQ(number(make.binary(Operation::NotEqual, text("ABC"), text("abc"))), 1);
  EXPECT_EQ(number(make.binary(Operation::Less, text("AB"), text("B"))), 1);
  EXPECT_EQ(alarm(make.binary(Operation::Equal, text("1"), 1)), "a number and a text cannot be compared");
}

class Sinumerik : public RecordingHost {
public:
  double relativeEquality() const override { return 1e-12; }
};

TEST_F(EvaluationTest, ComparisonsForgiveWhatTheControlForgives) {
  // The manual's own example: 61.02 - 61.01 is not above 0.01, though the doubles say so.
  Sinumerik sinumerik;
  const Operand difference = make.binary(Operation::Subtract, Operand::of(61.02), 61.01);
  const Operand above = make.binary(Operation::Greater, difference, 0.01);
  const Operand same = make.binary(Operation::Equal, difference, 0.01);
  EXPECT_EQ(number(above), 1);
  EXPECT_EQ(number(same), 0);
  Evaluation forgiving(program, make.block, sinumerik);
  EXPECT_EQ(forgiving.number(above), 0);
  EXPECT_EQ(forgiving.number(same), 1);
}

TEST_F(EvaluationTest, TextsAndVariables) {
  host.variables[3] = std::string("RING");
  host.variables[4] = 12.5;
  EXPECT_EQ(value(make.value(3)), Value("RING"));
  EXPECT_EQ(value(make.value(4)), Value(12.5));
  EXPECT_EQ(value(make.binary(Operation::Concatenate, make.value(3), make.value(4))), Value("RING12.5"));
  EXPECT_EQ(value(make.binary(Operation::Concatenate, Operand::of(7), make.text("_OK"))), Value("7_OK"));
  EXPECT_EQ(value(make.call(Function::Host, {make.text("a")}, "NAME")), Value("NAME"));
  EXPECT_EQ(value(make.call(Function::Host, std::vector<Operand>(9, Operand::of(1)), "COUNT")), Value(9.0));
  EXPECT_EQ(number(make.node({.operation = Operation::Undefined, .a = make.q(99)})), 1);
  EXPECT_EQ(number(make.node({.operation = Operation::Undefined, .a = make.q(4)})), 0);
  // A variable whose number is computed: Q[Q4 - 9.5] is Q3.
  const std::uint32_t indirect = make.q(make.binary(Operation::Subtract, make.value(4), 9.5));
  EXPECT_EQ(value(make.node({.operation = Operation::Variable, .a = indirect})), Value("RING"));
  EXPECT_EQ(alarm(make.binary(Operation::Add, make.value(3), 1)), "a number is needed here, this is the text \"RING\"");
  EXPECT_EQ(alarm(make.call(Function::Sqrt, {make.text("x")})), "a number is needed here, this is the text \"x\"");
}

TEST_F(EvaluationTest, RefusesWhatHasNoResult) {
  EXPECT_EQ(alarm(Operation::Divide, 1, 0), "the divisor is 0");
  EXPECT_EQ(alarm(Operation::Modulo, 1, 0), "the divisor is 0");
  EXPECT_EQ(alarm(Operation::IntegerDivide, 1, 0), "the divisor is 0");
  EXPECT_THAT(alarm(Operation::Power, 0, -1), HasSubstr("divides by zero"));
  EXPECT_THAT(alarm(Operation::Power, -2, 0.5), HasSubstr("-2 has no power 0.5"));
  EXPECT_THAT(alarm(Operation::Power, 10, 400), HasSubstr("too large"));
  EXPECT_THAT(alarm(Operation::BitAnd, 3e9, 1), HasSubstr("integer"));
  EXPECT_EQ(alarm(Function::Sqrt, {-4}), "the square root of -4 does not exist");
  EXPECT_EQ(alarm(Function::Ln, {0}), "the logarithm of 0 does not exist");
  EXPECT_EQ(alarm(Function::Log, {-1}), "the logarithm of -1 does not exist");
  EXPECT_EQ(alarm(Function::Asin, {1.001}), "the arc sine of 1.001 does not exist");
  EXPECT_EQ(alarm(Function::Acos, {-2}), "the arc cosine of -2 does not exist");
  EXPECT_EQ(alarm(Function::Tan, {90}), "the tangent of 90 does not exist");
  EXPECT_EQ(alarm(Function::Tan, {-270}), "the tangent of -270 does not exist");
  EXPECT_THAT(alarm(Function::Exp, {1e4}), HasSubstr("too large"));
  EXPECT_THAT(alarm(Function::Bound, {3, 2, 1}), HasSubstr("lower bound"));
  EXPECT_EQ(alarm(Operand{}), "a value is missing");
  EXPECT_EQ(alarm(Function::Atan2, {1}), "an argument of the function is missing");
}

TEST_F(EvaluationTest, DeepExpressionsAreRefusedNotCrashedOn) {
  Operand sum = Operand::of(0);
  for (int i = 0; i < 1000000; ++i)
    sum = make.binary(Operation::Add, sum, 1);
  EXPECT_THAT(alarm(sum), HasSubstr("nested too deep"));
  Operand joined = make.text("");
  for (int i = 0; i < 1000000; ++i)
    joined = make.binary(Operation::Concatenate, joined, 1);
  EXPECT_THROW(value(joined), control::Alarm);
}

/// An expression as a tree for the evaluation and as the same C++ calculation beside it.
struct Grown {
  Operand operand;
  double expected;
};

Grown grow(Make& make, std::mt19937_64& random, int depth) {
  std::uniform_real_distribution<double> literal(-100, 100);
  if (depth == 0) {
    const double x = literal(random);
    return {Operand::of(x), x};
  }
  const Grown left = grow(make, random, depth - 1),
              right = grow(make, random, static_cast<int>(random() % static_cast<unsigned>(depth)));
  const double a = left.expected, b = right.expected;
  const double radians = std::numbers::pi / 180;
  switch (random() % 11) {
    case 0:
      return {make.binary(Operation::Add, left.operand, right.operand), a + b};
    case 1:
      return {make.binary(Operation::Subtract, left.operand, right.operand), a - b};
    case 2:
      return {make.binary(Operation::Multiply, left.operand, right.operand), a * b};
    case 3:
      return {make.binary(Operation::Divide, left.operand, right.operand), a / b};
    case 4:
      return {make.unary(Operation::Negate, left.operand), -a};
    case 5:
      return {make.call(Function::Abs, {left.operand}), std::fabs(a)};
    case 6:
      return {make.call(Function::Sqrt, {make.call(Function::Abs, {left.operand})}), std::sqrt(std::fabs(a))};
    case 7:
      return {make.call(Function::RootSumOfSquares, {left.operand, right.operand}), std::hypot(a, b)};
    case 8:
      return {make.call(Function::Maximum, {left.operand, right.operand}), a > b ? a : b};
    case 9:
      return {make.call(Function::Atan2, {left.operand, right.operand}), std::atan2(a, b) / radians};
    default:
      return {make.binary(Operation::Less, left.operand, right.operand), a < b ? 1.0 : 0.0};
  }
}

TEST_F(EvaluationTest, RandomExpressionsAgreeWithTheCompiler) {
  std::mt19937_64 random(4711);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    make.block.clear();
    const Grown grown = grow(make, random, 6);
    if (!std::isfinite(grown.expected)) continue;
    try {
      EXPECT_DOUBLE_EQ(number(grown.operand), grown.expected);
      ++compared;
    } catch (const control::Alarm& refused) {
      EXPECT_EQ(refused.text(), "the divisor is 0");
    }
  }
  EXPECT_GT(compared, 18000);
}

}  // namespace
}  // namespace probewright::execution

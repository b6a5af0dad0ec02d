#include "conversion/sinumerik_formulas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "conversion/call.hpp"
#include "language/sinumerik/keywords.hpp"
#include "language/sinumerik/operators.hpp"

namespace probewright::conversion {

using language::Block;
using language::Function;
using language::Node;
using language::Operand;
using language::Operation;
using language::VariableRef;
using language::VariableSpace;

namespace {

constexpr int firstSettableCode = 54;
constexpr int furtherSettableCodes = 505;
constexpr int firstControlParameter = 100;
constexpr int toolRadius = 108;
constexpr int toolLength = 114;
constexpr int firstResult = 115;
constexpr int firstSpaceAngle = 120, lastSpaceAngle = 122;  ///< of the tilted working plane

/// "SIN"; empty if there is no such function of one argument.
std::string_view functionName(Function function) {
  if (function == Function::Integer) function = Function::Truncate;  // INT leaves the decimals off, too
  for (const language::sinumerik::FunctionEntry& each : language::sinumerik::functions())
    if (each.function == function && function != Function::Host && each.mostArguments == 1) return each.name;
  return {};
}

/// The value of an expression of numbers alone.
std::optional<double> constantOf(const Block& block, const Operand& operand) {
  if (operand.isLiteral()) return operand.number;
  if (!operand.present()) return std::nullopt;
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  const auto left = [&] { return constantOf(block, node.left); };
  switch (node.operation) {
    case Operation::Number:
      return node.number;
    case Operation::Negate:
      if (const auto value = left()) return -*value;
      return std::nullopt;
    case Operation::Power:
      if (const auto base = left(), exponent = constantOf(block, node.right); base && exponent) {
        const double value = std::pow(*base, *exponent);
        if (std::isfinite(value)) return value;
      }
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

/// A whole power of a factor, as products: "POT(R1)*R1" for 3.
std::string wholePower(const std::string& base, int exponent) {
  if (exponent == 1) return base;
  if (exponent % 2 == 1) return fmt::format("{}*{}", wholePower(base, exponent - 1), base);
  return fmt::format("POT({})", wholePower(base, exponent / 2));
}

}  // namespace

std::string factorText(const std::string& expression) {
  int depth = 0;
  bool tight = true;
  for (std::size_t i = 0; i < expression.size(); ++i) {
    const char c = expression[i];
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    if (depth == 0 && std::string_view("+-*/<>= ").find(c) != std::string_view::npos) tight = false;
  }
  return tight ? expression : fmt::format("({})", expression);
}

std::string sinumerikText(const Quantity& quantity) { return expressionText(quantity); }

std::string settableCode(int number) {
  return number == 0 ? "G599" : number < 5 ? fmt::format("G{}", 53 + number) : fmt::format("G{}", 500 + number);
}

std::string addressWord(std::string_view address, const Quantity& value) {
  const bool direct = address.size() == 1 && value.isNumber();
  return fmt::format("{}{}{}", address, direct ? "" : "=", sinumerikText(value));
}

std::optional<int> settableOf(std::string_view code) {
  if (code.size() < 3 || code.front() != 'G') return std::nullopt;
  int number = 0;
  for (const char c : code.substr(1)) {
    if (!isDigit(c)) return std::nullopt;
    number = number * 10 + (c - '0');
  }
  if (number >= firstSettableCode && number <= 57) return number - 53;
  if (number >= furtherSettableCodes && number <= 599) return number - 500;
  return number == 500 ? std::optional(0) : std::nullopt;
}

std::string SinumerikFormulas::variable(const VariableRef& variable) {
  const int number = static_cast<int>(variable.index[0].number);
  const bool indirect = !variable.index[0].isLiteral();
  if (indirect) throw NotCarriedOver("a parameter whose number is computed has no twin on a SINUMERIK");
  std::string name;
  switch (variable.space) {
    case VariableSpace::Q:
      if (number < firstControlParameter) return fmt::format("R{}", number);
      // Tool data count in millimetres.
      if (number == toolRadius) return inch_ ? "($P_TOOLR/25.4)" : "$P_TOOLR";
      if (number == toolLength) return inch_ ? "($P_TOOLL[1]/25.4)" : "$P_TOOLL[1]";
      if (number < firstResult || (number >= firstSpaceAngle && number <= lastSpaceAngle)) {
        throw NotCarriedOver(fmt::format("the control itself fills Q{}", number),
                             "take the value from a system variable of the SINUMERIK by hand");
      }
      if (shared_) return fmt::format("R{}", number + sharedQ);
      name = fmt::format("_Q{}", number);
      break;
    case VariableSpace::QL:
      name = fmt::format("_QL{}", number);
      break;
    case VariableSpace::QR:
      if (shared_) return fmt::format("R{}", number + sharedQR);
      name = fmt::format("_QR{}", number);
      break;
    case VariableSpace::QS:
      name = fmt::format("_QS{}", number);
      break;
    default:
      throw NotCarriedOver("this variable has no twin on a SINUMERIK");
  }
  declared_.insert(name);
  return name;
}

std::string SinumerikFormulas::formula(const Block& block, const Operand& operand) {
  if (const auto constant = constantOf(block, operand)) return exactText(*constant);
  if (!operand.present()) return {};
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  switch (node.operation) {
    case Operation::Text:
      return fmt::format("\"{}\"", block.at(node.text));
    case Operation::Variable:
      return variable(block.variables[node.a]);
    case Operation::Negate:
      return fmt::format("-{}", factor(block, node.left));
    case Operation::Call:
      return call(block, node);
    case Operation::Power:
      return power(block, node);
    default:
      break;
  }
  const language::sinumerik::BinaryOperator* sign = language::sinumerik::operatorOf(node.operation);
  if (sign == nullptr) throw NotCarriedOver("this condition has no twin on a SINUMERIK");
  if (sign->priority == language::sinumerik::Priority::Comparison && rounded_ && rounded_->decide(block, node)) {
    // Numbers that are nearly the same are equal here, but 0 and another number never are.
    return fmt::format("{}-{}{}0", formula(block, node.left), factor(block, node.right), sign->symbol);
  }
  const char* blank = sign->symbol.front() >= 'A' ? " " : "";
  // Sums are computed from left to right anyway.
  const bool sum = node.operation == Operation::Add || node.operation == Operation::Subtract;
  const std::string left = sum ? formula(block, node.left) : factor(block, node.left);
  return fmt::format("{}{}{}{}{}", left, blank, sign->symbol, blank, factor(block, node.right));
}

std::string SinumerikFormulas::factor(const Block& block, const Operand& side) {
  if (side.isLiteral() && side.number < 0) return fmt::format("({})", formula(block, side));
  return factorText(formula(block, side));
}

std::string SinumerikFormulas::power(const Block& block, const Node& node) {
  constexpr double largestProduct = 16;
  const auto exponent = constantOf(block, node.right);
  if (exponent && *exponent == 0) return "1";
  if (exponent && *exponent == 0.5) return fmt::format("SQRT({})", formula(block, node.left));
  if (exponent && *exponent == std::trunc(*exponent) && std::abs(*exponent) <= largestProduct) {
    const std::string product = wholePower(factor(block, node.left), static_cast<int>(std::abs(*exponent)));
    return *exponent > 0 ? product : fmt::format("1/({})", product);
  }
  // Logarithms are of positive numbers only.
  doubts_.emplace_back(
      "this power is computed by logarithms: a base of 0 or less stops the program, and a result that is a whole "
      "number "
      "may come out a little less",
      "write the power as a product, or see to it that the base is positive and round the result");
  return fmt::format("EXP({}*LN({}))", factor(block, node.right), formula(block, node.left));
}

std::string SinumerikFormulas::call(const Block& block, const Node& node) {
  const auto argument = [&](std::uint32_t i) { return formula(block, block.operands[node.a + i]); };
  if (const std::string_view name = functionName(node.function); !name.empty()) {
    return fmt::format("{}({})", name, argument(0));
  }
  switch (node.function) {
    case Function::Atan:
      return fmt::format("ATAN2({},1)", argument(0));
    case Function::Log:
      doubts_.emplace_back(
          "LOG is computed by natural logarithms: a result that is a whole number may come out a little less",
          "round the result where a whole number is meant");
      return fmt::format("(LN({})/LN(10))", argument(0));
    case Function::Fraction:
      return fmt::format("({0}-TRUNC({0}))", factorText(argument(0)));
    case Function::Sign:
      return fmt::format("(({0}>0)-({0}<0))", factorText(argument(0)));
    case Function::RootSumOfSquares:
      return fmt::format("SQRT(POT({})+POT({}))", argument(0), argument(1));
    default:
      break;
  }
  if (node.function == Function::Host && block.at(node.text) == "ANG") {
    // FN 13 counts from 0 to 360 degrees, ATAN2 from -180 to 180.
    const std::string angle = fmt::format("ATAN2({},{})", argument(0), argument(1));
    return fmt::format("({0}-360*TRUNC(({0}-359.999999999)/360))", angle);
  }
  throw NotCarriedOver("this function has no twin on a SINUMERIK");
}

Quantity SinumerikFormulas::quantity(const Block& block, const Operand& operand) {
  if (operand.isLiteral()) return operand.number;
  if (!operand.present()) return {};
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  const auto isNumber = [&](const Operand& side) { return side.isLiteral(); };
  switch (node.operation) {
    case Operation::Number:
      return node.number;
    case Operation::Variable: {
      const VariableRef& variable = block.variables[node.a];
      const bool radius =
          variable.space == VariableSpace::Q && variable.index[0].isLiteral() && variable.index[0].number == toolRadius;
      if (inch_ && radius) return sinumerikBallRadius / millimetresOfInch;
      break;
    }
    case Operation::Negate:
      return -quantity(block, node.left);
    case Operation::Add:
      return quantity(block, node.left) + quantity(block, node.right);
    case Operation::Subtract:
      return quantity(block, node.left) - quantity(block, node.right);
    case Operation::Multiply:
      if (isNumber(node.left)) return quantity(block, node.right) * node.left.number;
      if (isNumber(node.right)) return quantity(block, node.left) * node.right.number;
      break;
    case Operation::Divide:
      if (isNumber(node.right) && node.right.number != 0) return quantity(block, node.left) / node.right.number;
      break;
    default:
      break;
  }
  return Quantity::of(factorText(formula(block, operand)));
}

}  // namespace probewright::conversion

#include "execution/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "language/word_column.hpp"

namespace probewright::execution {

namespace {

constexpr int deepestExpression = 1000;
/// Joining texts in a loop ends here. Far beyond what a variable of a control takes.
constexpr std::size_t longestText = 100'000;
constexpr double degree = std::numbers::pi / 180;
/// How far rounding may carry an argument out of the domain of a function.
constexpr double domainSlack = 1e-12;

struct SineCosine {
  double sine, cosine;
};

SineCosine sineCosine(double degrees) {
  // Reduced to -45..45 degrees without loss, so that multiples of 90 come out exact.
  int quadrant = 0;
  const double rest = std::remquo(degrees, 90, &quadrant) * degree;
  const double s = std::sin(rest), c = std::cos(rest);
  switch (static_cast<unsigned>(quadrant) & 3U) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

class Depth {
public:
  explicit Depth(int& depth) : depth_(depth) { ++depth_; }
  Depth(const Depth&) = delete;
  Depth& operator=(const Depth&) = delete;
  ~Depth() { --depth_; }

private:
  int& depth_;
};

bool equal(double a, double b, double relative) {
  return a == b || std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

}  // namespace

SourcePlace Evaluation::place() const {
  return {program_.file(), block_.position.line, columnOfFirstWord(block_.at(block_.source))};
}

void Evaluation::refuse(Refusal refusal, std::string text, std::string advice) const {
  throw control::Alarm(host_.code(refusal), std::move(text), std::move(advice));
}

Value Evaluation::value(const Operand& operand) {
  if (operand.isLiteral()) return operand.number;
  if (!operand.present()) refuse(Refusal::MissingValue, "a value is missing");
  if (isNumeric(operand)) return number(operand);
  return evaluate(block_.nodes[static_cast<std::size_t>(operand.node)]);
}

double Evaluation::number(const Operand& operand) {
  if (operand.isLiteral()) return operand.number;
  const double result = this->operand(operand);
  if (!std::isfinite(result)) refuse(Refusal::Overflow, "the result of the calculation is too large");
  return result;
}

namespace {

/// Twelve significant digits: what lies after them is noise of computing.
double shown(double value) {
  if (value == 0 || value == std::trunc(value)) return value;
  const double digits = 11 - std::floor(std::log10(std::abs(value)));
  const double scale = std::pow(10.0, digits);
  const double rounded = std::round(value * scale) / scale;
  return std::isfinite(rounded) && digits < 300 ? rounded : value;
}

}  // namespace

std::string Host::numberText(double value) const { return formatShortest(shown(value)); }

Value Host::valueFor(const VariableRef&, const Operand& operand, Evaluation& evaluation) {
  return evaluation.value(operand);
}

std::optional<std::string> Evaluation::shownText(const Operand& operand) {
  if (operand.node < 0) return std::nullopt;
  const Node& node = block_.nodes[static_cast<std::size_t>(operand.node)];
  if (node.operation != Operation::Variable) return std::nullopt;
  return host_.shownText(block_.variables[node.a], *this);
}

std::string Evaluation::text(const Operand& operand) {
  if (auto shown = shownText(operand)) return std::move(*shown);
  Value result = value(operand);
  if (auto* text = std::get_if<std::string>(&result)) return std::move(*text);
  return host_.numberText(std::get<double>(result));
}

double Evaluation::operand(const Operand& operand) {
  if (operand.isLiteral()) return operand.number;
  if (!operand.present()) refuse(Refusal::MissingValue, "a value is missing");
  return evaluateNumber(block_.nodes[static_cast<std::size_t>(operand.node)]);
}

std::int32_t Evaluation::integer(const Operand& operand) {
  const double rounded = std::round(this->operand(operand));
  if (!(std::abs(rounded) <= std::numeric_limits<std::int32_t>::max())) {
    refuse(Refusal::Overflow, fmt::format("{} does not fit into an integer of 32 bits", formatShortest(rounded)));
  }
  return static_cast<std::int32_t>(rounded);
}

bool Evaluation::isNumeric(const Operand& operand) const {
  if (operand.isLiteral()) return true;
  if (!operand.present()) return false;
  const Node& node = block_.nodes[static_cast<std::size_t>(operand.node)];
  switch (node.operation) {
    case Operation::Text:
    case Operation::Variable:
    case Operation::Concatenate:
    case Operation::AxisName:
      return false;
    case Operation::Call:
      return node.function != Function::Host;
    default:
      return true;
  }
}

Value Evaluation::evaluate(const Node& node) {
  switch (node.operation) {
    case Operation::Text:
    case Operation::AxisName:
      return std::string(at(node.text));
    case Operation::Variable:
      return host_.read(block_.variables[node.a], *this);
    case Operation::Concatenate: {
      const Depth depth(depth_);
      if (depth_ > deepestExpression) refuse(Refusal::TooComplex, "this expression is nested too deep");
      std::string joined = text(node.left);
      joined += text(node.right);
      if (joined.size() > longestText) {
        refuse(Refusal::Overflow, fmt::format("this text becomes longer than {} characters", longestText),
               "look for a loop that makes a text longer and longer");
      }
      return joined;
    }
    case Operation::Call:
      if (node.function == Function::Host) return callHost(node);
      return callNumber(node);
    default:
      return evaluateNumber(node);
  }
}

double Evaluation::evaluateNumber(const Node& node) {
  if (node.operation == Operation::Number) return node.number;
  const Depth depth(depth_);
  if (depth_ > deepestExpression) {
    refuse(Refusal::TooComplex, "this expression is nested too deep", "split it over several blocks");
  }
  return compute(node);
}

double Evaluation::compute(const Node& node) {
  switch (node.operation) {
    case Operation::Number:
      return node.number;
    case Operation::Variable:
    case Operation::Text:
    case Operation::Concatenate:
    case Operation::AxisName: {
      const Value result = evaluate(node);
      if (const auto* number = std::get_if<double>(&result)) return *number;
      refuse(Refusal::TypeMismatch,
             fmt::format("a number is needed here, this is the text \"{}\"", std::get<std::string>(result)),
             "convert the text to a number first");
    }
    case Operation::Negate:
      return -operand(node.left);
    case Operation::Not:
      return operand(node.left) == 0 ? 1 : 0;
    case Operation::BitNot:
      return ~integer(node.left);
    case Operation::Add:
      return operand(node.left) + operand(node.right);
    case Operation::Subtract:
      return operand(node.left) - operand(node.right);
    case Operation::Multiply:
      return operand(node.left) * operand(node.right);
    case Operation::Divide:
    case Operation::IntegerDivide:
    case Operation::Modulo: {
      const double dividend = operand(node.left), divisor = operand(node.right);
      if (divisor == 0) {
        refuse(Refusal::DivisionByZero, "the divisor is 0", "compare the divisor with 0 in a block before this one");
      }
      if (node.operation == Operation::Divide) return dividend / divisor;
      return node.operation == Operation::Modulo ? std::fmod(dividend, divisor) : std::trunc(dividend / divisor);
    }
    case Operation::Power: {
      const double base = operand(node.left), exponent = operand(node.right);
      if (base == 0 && exponent < 0) {
        refuse(Refusal::DivisionByZero, "zero to a negative power divides by zero",
               "compare the base with 0 in a block before this one");
      }
      if (base < 0 && exponent != std::trunc(exponent)) {
        refuse(Refusal::Domain,
               fmt::format("the negative number {} has no power {}", formatShortest(base), formatShortest(exponent)));
      }
      return std::pow(base, exponent);
    }
    case Operation::Equal:
    case Operation::NotEqual:
    case Operation::Less:
    case Operation::LessEqual:
    case Operation::Greater:
    case Operation::GreaterEqual:
      return compare(node);
    case Operation::And:
      return operand(node.left) != 0 && operand(node.right) != 0 ? 1 : 0;
    case Operation::Or:
      return operand(node.left) != 0 || operand(node.right) != 0 ? 1 : 0;
    case Operation::ExclusiveOr:
      return (operand(node.left) != 0) != (operand(node.right) != 0) ? 1 : 0;
    case Operation::BitAnd:
      return integer(node.left) & integer(node.right);
    case Operation::BitOr:
      return integer(node.left) | integer(node.right);
    case Operation::BitExclusiveOr:
      return integer(node.left) ^ integer(node.right);
    case Operation::Undefined:
      return host_.isDefined(block_.variables[node.a], *this) ? 0 : 1;
    case Operation::Call: {
      if (node.function != Function::Host) return callNumber(node);
      const Value result = callHost(node);
      if (const auto* number = std::get_if<double>(&result)) return *number;
      refuse(Refusal::TypeMismatch, fmt::format("a number is needed here, {} gives the text \"{}\"", at(node.text),
                                                std::get<std::string>(result)));
    }
  }
  refuse(Refusal::TooComplex, "this operation is unknown");
}

double Evaluation::compare(const Node& node) {
  int order = 0;
  const auto ofNumbers = [this](double left, double right) {
    if (equal(left, right, host_.relativeEquality())) return 0;
    return left < right ? -1 : 1;
  };
  if (isNumeric(node.left) && isNumeric(node.right)) {
    order = ofNumbers(operand(node.left), operand(node.right));
  } else {
    Value left = value(node.left), right = value(node.right);
    if (isText(left) != isText(right)) {
      if (auto shown = shownText(isText(left) ? node.right : node.left))
        (isText(left) ? right : left) = std::move(*shown);
    }
    if (isText(left) != isText(right)) {
      refuse(Refusal::TypeMismatch, "a number and a text cannot be compared",
             "convert the text to a number first, or the number to a text");
    }
    if (isText(left)) {
      order = std::get<std::string>(left).compare(std::get<std::string>(right));
    } else {
      order = ofNumbers(std::get<double>(left), std::get<double>(right));
    }
  }
  switch (node.operation) {
    case Operation::Equal:
      return order == 0 ? 1 : 0;
    case Operation::NotEqual:
      return order != 0 ? 1 : 0;
    case Operation::Less:
      return order < 0 ? 1 : 0;
    case Operation::LessEqual:
      return order <= 0 ? 1 : 0;
    case Operation::Greater:
      return order > 0 ? 1 : 0;
    default:
      return order >= 0 ? 1 : 0;
  }
}

double Evaluation::callNumber(const Node& node) {
  const auto argument = [&](std::uint32_t index) {
    if (index >= node.b) refuse(Refusal::MissingValue, "an argument of the function is missing");
    return operand(block_.operands[node.a + index]);
  };
  const auto domain = [&](const char* what, double x) {
    refuse(Refusal::Domain, fmt::format("{} of {} does not exist", what, formatShortest(x)),
           "check where this value comes from, in the blocks before this one");
  };
  const double x = argument(0);
  switch (node.function) {
    case Function::Sin:
      return sineCosine(x).sine;
    case Function::Cos:
      return sineCosine(x).cosine;
    case Function::Tan: {
      const auto [sine, cosine] = sineCosine(x);
      if (cosine == 0) domain("the tangent", x);
      return sine / cosine;
    }
    case Function::Asin:
    case Function::Acos: {
      if (!(std::abs(x) <= 1 + domainSlack))
        domain(node.function == Function::Asin ? "the arc sine" : "the arc cosine", x);
      const double inside = std::clamp(x, -1.0, 1.0);
      return (node.function == Function::Asin ? std::asin(inside) : std::acos(inside)) / degree;
    }
    case Function::Atan:
      return std::atan(x) / degree;
    case Function::Atan2:
      return std::atan2(x, argument(1)) / degree;
    case Function::Sqrt:
      if (!(x >= 0)) domain("the square root", x);
      return std::sqrt(x);
    case Function::Square:
      return x * x;
    case Function::Ln:
    case Function::Log:
      if (!(x > 0)) domain("the logarithm", x);
      return node.function == Function::Ln ? std::log(x) : std::log10(x);
    case Function::Exp:
      return std::exp(x);
    case Function::Abs:
      return std::abs(x);
    case Function::Integer:
    case Function::Truncate:
      return std::trunc(x);
    case Function::Fraction:
      return x - std::trunc(x);
    case Function::Sign:
      return x > 0 ? 1 : x < 0 ? -1 : 0;
    case Function::RootSumOfSquares:
      return std::hypot(x, argument(1));
    case Function::Round:
      return std::round(x);
    case Function::RoundUp:
      return std::ceil(x);
    case Function::Minimum:
    case Function::Maximum: {
      double best = x;
      for (std::uint32_t i = 1; i < node.b; ++i) {
        best = node.function == Function::Minimum ? std::min(best, argument(i)) : std::max(best, argument(i));
      }
      return best;
    }
    case Function::Bound: {
      const double upper = argument(1), checked = argument(2);
      if (x > upper) {
        refuse(Refusal::Domain,
               fmt::format("the lower bound {} is above the upper bound {}", formatShortest(x), formatShortest(upper)));
      }
      return std::clamp(checked, x, upper);
    }
    case Function::Host:
      break;
  }
  refuse(Refusal::TooComplex, "this function is unknown");
}

Value Evaluation::callHost(const Node& node) {
  const Depth depth(depth_);
  if (depth_ > deepestExpression) refuse(Refusal::TooComplex, "this expression is nested too deep");
  const std::string_view name = at(node.text);
  const auto operands = std::span(block_.operands).subspan(node.a, node.b);
  const auto evaluateInto = [&](std::span<Value> values) {
    for (std::size_t i = 0; i < operands.size(); ++i)
      values[i] = value(operands[i]);
    return host_.call(name, values);
  };
  std::array<Value, 4> few;
  if (operands.size() <= few.size()) return evaluateInto(std::span(few).first(operands.size()));
  std::vector<Value> many(operands.size());
  return evaluateInto(many);
}

}  // namespace probewright::execution

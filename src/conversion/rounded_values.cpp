#include "conversion/rounded_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace probewright::conversion {

using namespace language;

namespace {

/// Q100 to Q199: the control and its cycles fill them.
constexpr int firstFilled = 100, lastFilled = 199;
/// Kinds only rise, so each pass but the last has raised one; what takes more passes is not what people write.
constexpr int mostPasses = 10;

bool isWhole(double number) { return number == std::trunc(number); }

int numberOf(const VariableRef& variable) {
  return variable.index[0].isLiteral() ? static_cast<int>(variable.index[0].number) : -1;
}

/// An array and parameters whose number is computed are one variable.
std::string nameOf(const Block& block, const VariableRef& variable) {
  const bool named = variable.space == VariableSpace::User || variable.space == VariableSpace::System;
  return named ? std::string(block.at(variable.name))
               : fmt::format("{} {}", static_cast<int>(variable.space), numberOf(variable));
}

}  // namespace

RoundedValues::RoundedValues(Program& program, const Job& job) {
  Block block;
  const auto forEachAssignment = [&](const auto& use) {
    const auto read = [&](Program& each) {
      Diagnostics ignored;
      for (BlockPosition at = each.begin(); each.parse(at, block, ignored); at = block.next) {
        for (const Instruction& instruction : block.instructions)
          if (const auto* assign = std::get_if<Assign>(&instruction))
            use(nameOf(block, block.variables[assign->variable]), assign->value);
      }
    };
    read(program);
    for (const auto& other : job.others)
      read(*other);
  };
  forEachAssignment([&](const std::string& name, const Operand&) { kinds_.emplace(name, Kind::Whole); });
  bool changed = true;
  for (int pass = 0; changed && pass < mostPasses; ++pass) {
    changed = false;
    forEachAssignment([&](const std::string& name, const Operand& value) {
      Kind& kind = kinds_[name];
      const Kind found = std::max(kind, kindOf(block, value));
      changed = changed || found != kind;
      kind = found;
    });
  }
}

RoundedValues::Kind RoundedValues::kindOf(double written) {
  if (isWhole(written)) return Kind::Whole;
  constexpr double finest = 1e-9;  // what has more decimals comes as near to another number as a rounding does
  const double decimals = written / finest;
  const double slack = 4 * std::numeric_limits<double>::epsilon() * std::abs(decimals);
  return std::abs(decimals - std::round(decimals)) <= slack ? Kind::Written : Kind::Rounded;
}

RoundedValues::Kind RoundedValues::kindOf(const Block& block, const VariableRef& variable) const {
  const int number = numberOf(variable);
  if (variable.space == VariableSpace::System) return Kind::Measured;
  if (variable.space == VariableSpace::Q && number >= firstFilled && number <= lastFilled) return Kind::Measured;
  if (const auto found = kinds_.find(nameOf(block, variable)); found != kinds_.end()) return found->second;
  const bool ofCycles = variable.space == VariableSpace::Q
                            ? number > lastFilled
                            : variable.space == VariableSpace::User && block.at(variable.name).starts_with("_OV");
  return ofCycles ? Kind::Measured : Kind::Written;
}

RoundedValues::Kind RoundedValues::kindOf(const Block& block, const Operand& operand) const {
  if (operand.isLiteral()) return kindOf(operand.number);
  if (!operand.present()) return Kind::Whole;
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  const auto computed = [](Kind of) { return of == Kind::Written ? Kind::Rounded : of; };
  switch (node.operation) {
    case Operation::Number:
      return kindOf(node.number);
    case Operation::Variable:
      return kindOf(block, block.variables[node.a]);
    case Operation::Negate:
      return kindOf(block, node.left);
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Multiply:
      return computed(std::max(kindOf(block, node.left), kindOf(block, node.right)));
    case Operation::Divide:
    case Operation::Power:
      return std::max({Kind::Rounded, kindOf(block, node.left), kindOf(block, node.right)});
    case Operation::Call:
      break;
    default:
      return Kind::Whole;  // texts, logic, whole quotients
  }
  Kind most = Kind::Whole;
  for (std::uint32_t i = 0; i < node.b; ++i)
    most = std::max(most, kindOf(block, block.operands[node.a + i]));
  switch (node.function) {
    case Function::Integer:
    case Function::Truncate:
    case Function::Round:
    case Function::RoundUp:
    case Function::Sign:
      return Kind::Whole;
    case Function::Abs:
    case Function::Minimum:
    case Function::Maximum:
    case Function::Bound:
      return most;
    case Function::Host:  // of the control's own only ANG computes; the others count, look up or read
      return block.at(node.text) == "ANG" ? std::max(Kind::Rounded, most) : Kind::Whole;
    default:
      return std::max(Kind::Rounded, most);
  }
}

bool RoundedValues::decide(const Block& block, const Node& comparison) const {
  const auto isZero = [](const Operand& side) { return side.isLiteral() && side.number == 0; };
  if (isZero(comparison.left) || isZero(comparison.right)) return false;
  return std::max(kindOf(block, comparison.left), kindOf(block, comparison.right)) == Kind::Rounded;
}

}  // namespace probewright::conversion

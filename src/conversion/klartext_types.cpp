#include <fmt/format.h>

#include <cmath>

#include "conversion/klartext_formulas.hpp"
#include "conversion/sinumerik_formulas.hpp"

/// The types of SINUMERIK variables in Klartext, whose parameters are all real numbers.
namespace probewright::conversion {

using namespace language;
using sinumerik::Type;

void KlartextFormulas::declare(std::string_view name, std::string_view type) {
  Type known = Type::Real;
  if (sinumerik::typeOf(type, known)) declare(name, known);
}

Type KlartextFormulas::typeOf(const Block& block, const VariableRef& variable) const {
  if (variable.space != VariableSpace::User) return Type::Real;
  const std::string_view name = block.at(variable.name);
  if (const auto own = types_.find(name); own != types_.end()) return own->second;
  return isGlobal(name) ? globalData_->at(std::string(name)).type() : Type::Real;
}

bool KlartextFormulas::isWhole(const Block& block, const Operand& operand) const {
  if (operand.isLiteral()) return operand.number == std::floor(operand.number);
  if (!operand.present()) return true;
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  switch (node.operation) {
    case Operation::Number:
      return node.number == std::floor(node.number);
    case Operation::Variable: {
      const Type type = typeOf(block, block.variables[node.a]);
      return type == Type::Int || type == Type::Bool;
    }
    case Operation::Negate:
      return isWhole(block, node.left);
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Multiply:
      return isWhole(block, node.left) && isWhole(block, node.right);
    case Operation::Call:
      return node.function == Function::Round || node.function == Function::Truncate;
    default:
      return false;
  }
}

bool KlartextFormulas::isTruth(const Block& block, const Operand& operand) const {
  if (operand.isLiteral()) return operand.number == 0 || operand.number == 1;
  if (!operand.present()) return true;
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  if (node.operation == Operation::Number) return node.number == 0 || node.number == 1;
  return node.operation == Operation::Variable && typeOf(block, block.variables[node.a]) == Type::Bool;
}

std::string KlartextFormulas::asType(Type type, const std::string& parameter) {
  if (type == Type::Bool) return fmt::format("ABS (SGN {})", factorText(parameter));
  if (type != Type::Int) return parameter;
  // Halves go up, of negative numbers too; INT of Klartext leaves the decimals off.
  const std::string above = helper(fmt::format("{} + 0.5", parameter));
  return fmt::format("INT {0} + INT ((SGN (FRAC {0}) - 1) / 2)", above);
}

std::string KlartextFormulas::assigned(const Block& block, const VariableRef& variable, const std::string& parameter) {
  return asType(typeOf(block, variable), parameter);
}

std::string KlartextFormulas::assigned(const Block& block, const VariableRef& variable, const Operand& operand) {
  const Type type = typeOf(block, variable);
  const std::string text = formula(block, operand);
  if (type == Type::Bool && isTruth(block, operand)) return text;
  if (type == Type::Int && isWhole(block, operand)) return text;
  if (type == Type::Int && operand.isLiteral()) return exactText(std::floor(operand.number + 0.5));
  return asType(type, text);
}

}  // namespace probewright::conversion

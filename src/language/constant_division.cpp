#include "language/constant_division.hpp"

#include <algorithm>
#include <optional>

namespace probewright::language {

namespace {

constexpr int deepest = 32;

/// The value of an operand that has no variable in it.
std::optional<double> constantOf(const Block& block, const Operand& operand, int depth) {
  if (!operand.present() || depth > deepest) return std::nullopt;
  if (operand.isLiteral()) return operand.number;
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  if (node.operation == Operation::Number) return node.number;
  const auto left = constantOf(block, node.left, depth + 1);
  if (!left) return std::nullopt;
  if (node.operation == Operation::Negate) return -*left;
  const auto right = constantOf(block, node.right, depth + 1);
  if (!right) return std::nullopt;
  switch (node.operation) {
    case Operation::Add:
      return *left + *right;
    case Operation::Subtract:
      return *left - *right;
    case Operation::Multiply:
      return *left * *right;
    default:
      return std::nullopt;
  }
}

}  // namespace

bool dividesByZero(const Block& block) {
  return std::ranges::any_of(block.nodes, [&](const Node& node) {
    const bool divides = node.operation == Operation::Divide || node.operation == Operation::IntegerDivide ||
                         node.operation == Operation::Modulo;
    return divides && constantOf(block, node.right, 0) == 0.0;
  });
}

}  // namespace probewright::language

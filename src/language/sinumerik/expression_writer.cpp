#include <fmt/format.h>

#include <cmath>

#include "base/number_text.hpp"
#include "language/sinumerik/keywords.hpp"
#include "language/sinumerik/operators.hpp"
#include "language/sinumerik/writer.hpp"

namespace probewright::language::sinumerik {

using namespace language;

std::string writeNumber(double value) {
  std::string text = formatShortest(value == 0 ? 0 : value);
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    const long long exponent = parseInteger(text.substr(e + 1)).value_or(0);
    text = fmt::format("{}EX{}", text.substr(0, e), exponent);
  }
  return text;
}

std::string writeVariable(const Block& block, const VariableRef& variable) {
  std::string text;
  const double number = variable.index[0].isLiteral() ? variable.index[0].number : -1;
  const bool plainR = variable.space == VariableSpace::R && number >= 0 && number < 1e6 && number == std::floor(number);
  if (plainR) return fmt::format("R{}", number);
  text = variable.space == VariableSpace::R ? "R" : std::string(block.at(variable.name));
  char separator = '[';
  for (const Operand& index : variable.index) {
    if (!index.present()) break;
    text += separator;
    text += writeExpression(block, index);
    separator = ',';
  }
  if (separator == ',') text += ']';
  return text;
}

namespace {

std::string writeOperand(const Block& block, const Operand& operand, Priority outer);

std::string writeCall(const Block& block, const Node& node) {
  const Operand* arguments = block.operands.data() + node.a;
  if (block.at(node.text) == "CHAIN")
    return fmt::format("{}:{}", writeOperand(block, arguments[0], Priority::Chain),
                       writeOperand(block, arguments[1], Priority::Sign));
  std::string text = fmt::format("{}(", block.at(node.text));
  for (std::uint32_t i = 0; i < node.b; ++i) {
    if (i > 0) text += ',';
    text += writeExpression(block, arguments[i]);
  }
  text += ')';
  return text;
}

/// `outer`: the weakest priority that needs no parentheses here.
std::string writeOperand(const Block& block, const Operand& operand, Priority outer) {
  if (!operand.present()) return {};
  if (operand.isLiteral()) {
    std::string text = writeNumber(operand.number);
    return text.front() == '-' && outer > Priority::Comparison ? fmt::format("({})", text) : text;
  }
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  Priority own = Priority::Single;
  std::string text;
  switch (node.operation) {
    case Operation::Number:
      return writeOperand(block, Operand::of(node.number), outer);
    case Operation::Text:
      return fmt::format("\"{}\"", block.at(node.text));
    case Operation::AxisName:
      return std::string(block.at(node.text));
    case Operation::Variable:
      return writeVariable(block, block.variables[node.a]);
    case Operation::Negate:
    case Operation::Not:
    case Operation::BitNot:
      own = Priority::Sign;
      text = node.operation == Operation::Negate ? "-" : node.operation == Operation::Not ? "NOT " : "B_NOT ";
      text += writeOperand(block, node.left, Priority::Sign);
      break;
    case Operation::Call:
      own = block.at(node.text) == "CHAIN" ? Priority::Chain : Priority::Single;
      text = writeCall(block, node);
      break;
    default: {
      const BinaryOperator* op = operatorOf(node.operation);
      if (op == nullptr) return "0";
      own = op->priority;
      const bool word = op->symbol.front() >= 'A';
      text = writeOperand(block, node.left, own) + (word ? " " : "") + std::string(op->symbol) + (word ? " " : "") +
             writeOperand(block, node.right, static_cast<Priority>(static_cast<int>(own) + 1));
    }
  }
  return own < outer ? fmt::format("({})", text) : text;
}

}  // namespace

std::string writeExpression(const Block& block, const Operand& operand) {
  return writeOperand(block, operand, Priority::Comparison);
}

}  // namespace probewright::language::sinumerik

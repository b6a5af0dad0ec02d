#include "language/klartext/formula_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "language/klartext/lexer.hpp"

namespace probewright::language::klartext {

std::string_view functionName(Function function) {
  switch (function) {
    case Function::Sin:
      return "SIN";
    case Function::Cos:
      return "COS";
    case Function::Tan:
      return "TAN";
    case Function::Asin:
      return "ASIN";
    case Function::Acos:
      return "ACOS";
    case Function::Atan:
      return "ATAN";
    case Function::Sqrt:
      return "SQRT";
    case Function::Square:
      return "SQ";
    case Function::Ln:
      return "LN";
    case Function::Log:
      return "LOG";
    case Function::Exp:
      return "EXP";
    case Function::Abs:
      return "ABS";
    case Function::Integer:
      return "INT";
    case Function::Fraction:
      return "FRAC";
    case Function::Sign:
      return "SGN";
    default:
      return {};
  }
}

std::string_view operatorText(Operation operation) {
  switch (operation) {
    case Operation::Add:
      return " + ";
    case Operation::Subtract:
      return " - ";
    case Operation::Multiply:
      return " * ";
    case Operation::Divide:
      return " / ";
    case Operation::Modulo:
      return " % ";
    case Operation::Power:
      return " ^ ";
    case Operation::Concatenate:
      return " || ";
    default:
      return {};
  }
}

namespace {

/// The names of string functions' arguments, in the order of their operands.
std::array<std::string_view, 4> argumentNames(std::string_view function) {
  if (function == "TOCHAR") return {"DAT", "DECIMALS", "", ""};
  if (function == "SUBSTR") return {"SRC_", "BEG", "LEN", ""};
  if (function == "SYSSTR") return {"ID", "NR", "IDX", "LEN"};
  if (function == "TONUMB" || function == "STRLEN") return {"SRC_", "", "", ""};
  if (function == "INSTR") return {"SRC_", "SEA_", "BEG", ""};
  if (function == "STRCOMP") return {"SRC_", "SEA_", "", ""};
  return {"KEY_", "TAG_", "ATR_", "IDX"};
}

class FormulaWriter {
public:
  explicit FormulaWriter(const Block& block) : block_(block) {}

  std::string formula(const Operand& operand) const {
    if (!operand.present()) return {};
    if (operand.isLiteral()) return writeNumber(operand.number);
    const Node& node = block_.nodes[static_cast<std::size_t>(operand.node)];
    const std::string_view sign = operatorText(node.operation);
    if (!sign.empty()) return fmt::format("{}{}{}", primary(node.left), sign, primary(node.right));
    switch (node.operation) {
      case Operation::Number:
        return writeNumber(node.number);
      case Operation::Text:
        return fmt::format("\"{}\"", block_.at(node.text));
      case Operation::Variable:
        return writeVariable(block_.variables[node.a]);
      case Operation::Negate:
        return fmt::format("-{}", primary(node.left));
      case Operation::Call:
        return call(node);
      default:
        return {};
    }
  }

private:
  /// As an operand of an operator: in parentheses unless it is a number, a parameter or a text.
  std::string primary(const Operand& operand) const {
    const std::string text = formula(operand);
    if (operand.isLiteral()) return operand.number < 0 ? fmt::format("({})", text) : text;
    const Operation operation = block_.nodes[static_cast<std::size_t>(operand.node)].operation;
    const bool plain = operation == Operation::Variable || operation == Operation::Text ||
                       operation == Operation::Number || operation == Operation::Call;
    return plain ? text : fmt::format("({})", text);
  }

  std::string call(const Node& node) const {
    const auto argument = [&](std::uint32_t i) { return block_.operands[node.a + i]; };
    if (node.function != Function::Host) {
      return fmt::format("{} ({})", functionName(node.function), formula(argument(0)));
    }
    const std::string_view name = block_.at(node.text);
    const auto names = argumentNames(name);
    std::string text = fmt::format("{}(", name);
    for (std::uint32_t i = 0; i < node.b && i < names.size() && !names[i].empty(); ++i) {
      const Operand value = argument(i);
      if (value.isLiteral() && value.number == -1) continue;
      text += fmt::format(" {}{}", names[i], value.isLiteral() ? writeNumber(value.number) : formula(value));
    }
    return text + " )";
  }

  const Block& block_;
};

}  // namespace

std::string writeNumber(double number) {
  if (number == 0) return "0";  // both zeros
  std::array<char, 400> buffer{};
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, std::chars_format::fixed);
  return error == std::errc() ? std::string(buffer.data(), end) : fmt::format("{}", number);
}

std::string writeSigned(double number) {
  const std::string text = writeNumber(number);
  return text.front() == '-' ? text : fmt::format("+{}", text);
}

std::string writeVariable(const VariableRef& variable) {
  std::string_view space = "Q";
  if (variable.space == VariableSpace::QL) space = "QL";
  if (variable.space == VariableSpace::QR) space = "QR";
  if (variable.space == VariableSpace::QS) space = "QS";
  return fmt::format("{}{}", space, writeNumber(variable.index[0].number));
}

std::string writeValue(const Block& block, const Operand& operand) {
  if (operand.isLiteral()) return writeSigned(operand.number);
  if (!operand.present()) return {};
  const Node& node = block.nodes[static_cast<std::size_t>(operand.node)];
  if (node.operation == Operation::Variable) return fmt::format("+{}", writeVariable(block.variables[node.a]));
  return writeFormula(block, operand);
}

std::string writePath(std::string_view path) {
  const auto isPlain = [](char c) {
    return isLetter(upper(c)) || isDigit(c) || std::string_view("_.-\\/:$#&+").find(c) != std::string_view::npos;
  };
  Lexer lexer(path);
  const bool isVariable = lexer.acceptPrefix("Q") && (lexer.acceptPrefix("S"), isDigit(lexer.here()));
  const bool plain = !path.empty() && path.front() != ':' && !isVariable && std::ranges::all_of(path, isPlain);
  return plain ? std::string(path) : fmt::format("\"{}\"", path);
}

std::string writeFormula(const Block& block, const Operand& operand) { return FormulaWriter(block).formula(operand); }

}  // namespace probewright::language::klartext

#include <fmt/format.h>

#include "language/din_iso/parser.hpp"

/// D00 to D38, the twins of FN 0 to FN 38. "Dnn:" is followed by what stands behind FN nn in Klartext.
namespace probewright::language::din_iso {

using klartext::isDigit;

bool BlockParser::parameterAddress(int number) {
  const bool matches = lexer_.peek() == 'P' && isDigit(lexer_.here(1)) && isDigit(lexer_.here(2)) &&
                       (lexer_.here(1) - '0') * 10 + (lexer_.here(2) - '0') == number;
  if (matches) lexer_.advance(3);
  return matches;
}

std::optional<Operand> BlockParser::parameterValue(int number) {
  const std::string name = fmt::format("P{:02}", number);
  if (!parameterAddress(number)) {
    error(fmt::format("{} with its value is expected here", name));
    return std::nullopt;
  }
  return value(name);
}

bool BlockParser::function() {
  lexer_.advance();
  const std::optional<double> written = lexer_.number();
  if (!written || *written > 38) return error("a number from 0 to 38 is expected behind D");
  const int number = static_cast<int>(*written);
  if (lexer_.accept(':')) return functionBody(number);
  switch (number) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 5:
    case 6:
    case 7:
    case 8:
    case 13:
      return assignmentOf(number);
    case 9:
    case 10:
    case 11:
    case 12:
      return jumpOf(number);
    case 14: {
      const std::size_t first = block_.words.size();
      const std::optional<Operand> message = parameterValue(1);
      if (!message) return false;
      addWord(0, *message);
      emit(Command{constant("FN14"), {}, -1, wordsSince(first)});
      return expectEnd();
    }
    case 15:
    case 19:
    case 20:
    case 29:
      parameterAddress(1);
      return textCommand(fmt::format("FN{}", number));
    case 18:
      return systemRead();
    default:
      parameterAddress(1);
      return functionBody(number);
  }
}

/// D01 Q5 P01 +Q1 P02 +2.
bool BlockParser::assignmentOf(int number) {
  const std::optional<std::uint32_t> target = variableIndex();
  if (!target) return false;
  const auto call = [&](Function function, std::initializer_list<Operand> arguments) {
    Node node;
    node.operation = Operation::Call;
    node.function = function;
    node.a = static_cast<std::uint32_t>(block_.operands.size());
    node.b = static_cast<std::uint32_t>(arguments.size());
    block_.operands.insert(block_.operands.end(), arguments);
    return push(node);
  };
  if (number == 0 && parameterAddress(1)) {
    const std::optional<std::string_view> text = lexer_.quoted();
    const std::optional<Operand> assigned = text ? textOperand(ref(*text)) : value("P01");
    if (!assigned) return false;
    emit(Assign{*target, *assigned});
    return expectEnd();
  }
  const std::optional<Operand> left = parameterValue(1);
  if (!left) return false;
  Operand result;
  if (number >= 5 && number <= 7) {
    result = call(number == 5 ? Function::Sqrt : number == 6 ? Function::Sin : Function::Cos, {*left});
  } else {
    const std::optional<Operand> right = parameterValue(2);
    if (!right) return false;
    switch (number) {
      case 1:
        result = binary(Operation::Add, *left, *right);
        break;
      case 2:
        result = binary(Operation::Subtract, *left, *right);
        break;
      case 3:
        result = binary(Operation::Multiply, *left, *right);
        break;
      case 4:
        result = binary(Operation::Divide, *left, *right);
        break;
      case 8:
        result = call(Function::RootSumOfSquares, {*left, *right});
        break;
      default:
        result = callHost("ANG", {*left, *right});
        break;
    }
  }
  emit(Assign{*target, result});
  return expectEnd();
}

/// D09 P01 +Q1 P02 +5 P03 10; D09 P01 +Q1 IS UNDEFINED P03 "NAME".
bool BlockParser::jumpOf(int number) {
  static constexpr std::array<Operation, 4> operations = {Operation::Equal, Operation::NotEqual, Operation::Greater,
                                                          Operation::Less};
  const std::size_t variables = block_.variables.size();
  const std::optional<Operand> left = parameterValue(1);
  if (!left) return false;
  Jump jump;
  if (block_.variables.size() > variables && lexer_.acceptKeyword("IS")) {
    const bool undefined = lexer_.acceptKeyword("UNDEFINED");
    if (!undefined && !lexer_.acceptKeyword("DEFINED")) return error("DEFINED or UNDEFINED is expected behind IS");
    Node node;
    node.operation = Operation::Undefined;
    node.a = static_cast<std::uint32_t>(block_.variables.size() - 1);
    jump.condition = push(node);
    if (!undefined) {
      Node invert;
      invert.operation = Operation::Not;
      invert.left = jump.condition;
      jump.condition = push(invert);
    }
  } else {
    if (!parameterAddress(2)) return error("P02 with its value is expected here");
    const std::optional<std::string_view> text = lexer_.quoted();
    const std::optional<Operand> right = text ? textOperand(ref(*text)) : value("P02");
    if (!right) return false;
    jump.condition = binary(operations[static_cast<std::size_t>(number - 9)], *left, *right);
  }
  if (!parameterAddress(3)) return error("P03 with the label to jump to is expected here");
  if (!labelName(jump.label, jump.labelValue)) return false;
  emit(jump);
  return expectEnd();
}

/// D18 Q25 ID210 NR4 IDX3.
bool BlockParser::systemRead() {
  Command command;
  lexer_.acceptPrefix("SYSREAD");
  const std::optional<std::uint32_t> target = variableIndex();
  if (!target) return false;
  command.variable = static_cast<std::int32_t>(*target);
  lexer_.accept('=');
  const std::size_t first = block_.words.size();
  if (!lexer_.acceptPrefix("ID")) return error("ID with the group of the system datum is expected here");
  if (!word(addressOf("ID"), "ID")) return false;
  if (lexer_.acceptPrefix("NR") && !word(addressOf("NR"), "NR")) return false;
  if (lexer_.acceptPrefix("IDX") && !word(addressOf("IDX"), "IDX")) return false;
  command.words = wordsSince(first);
  command.name = constant("FN18");
  emit(command);
  return expectEnd();
}

}  // namespace probewright::language::din_iso

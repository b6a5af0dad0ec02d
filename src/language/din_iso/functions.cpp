#include <fmt/format.h>

#include "language/din_iso/parser.hpp"
#include "language/klartext/formula_writer.hpp"
#include "language/klartext/writer.hpp"

/// D00 to D38, the twins of FN 0 to FN 38. "Dnn:" is followed by what stands after FN nn in Klartext.
namespace probewright::language::din_iso {

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
  if (!written || *written > 38) return error("a number from 0 to 38 is expected after D");
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
      emit(Command{constant(nameOf(CommandKind::Fn14)), {}, -1, wordsSince(first)});
      return expectEnd();
    }
    case 15:
      return printing();
    case 19:
    case 29:
      return valuesForPlc(number);
    case 20:
      parameterAddress(1);
      return textCommand(klartext::functionCommand(number));
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
  if (number == 0 && lexer_.acceptKeyword("SET")) return setUndefined(*target);
  std::optional<Operand> result;
  if (number == 0 && parameterAddress(1)) {
    const std::optional<std::string_view> text = lexer_.quoted();
    result = text ? textOperand(ref(*text)) : value("P01");
  } else {
    const std::optional<Operand> left = parameterValue(1);
    if (!left) return false;
    const bool alone = number == 0 || (number >= 5 && number <= 7);
    const std::optional<Operand> right = alone ? Operand{} : parameterValue(2);
    if (!right) return false;
    result = number == 0 ? *left : functionResult(number, *left, *right);
  }
  if (!result) return false;
  emit(Assign{*target, *result});
  return expectEnd();
}

/// D09 P01 +Q1 P02 +5 P03 10; D09 P01 +Q1 IS UNDEFINED P03 "NAME".
bool BlockParser::jumpOf(int number) {
  const std::size_t variables = block_.variables.size();
  const std::optional<Operand> left = parameterValue(1);
  if (!left) return false;
  std::optional<Operand> condition;
  if (block_.variables.size() > variables && lexer_.acceptKeyword("IS")) {
    condition = definedCondition();
  } else {
    if (!parameterAddress(2)) return error("P02 with its value is expected here");
    condition = comparison(number, *left, "P02");
  }
  if (!condition) return false;
  Jump jump;
  jump.condition = *condition;
  if (!parameterAddress(3)) return error("P03 with the label to jump to is expected here");
  if (!labelName(jump.label, jump.labelValue)) return false;
  emit(jump);
  return expectEnd();
}

/// True if P02 stands in the rest of the block as an address: not in quotation marks, nor as a part of a name or path.
bool BlockParser::secondParameterFollows() {
  const auto isOfName = [](char c) { return klartext::isWordByte(c) || c == '_' || c == '.' || c == '/' || c == '\\'; };
  const std::size_t begin = lexer_.offset();
  bool found = false;
  while (!lexer_.atEnd()) {
    if (lexer_.quoted()) continue;
    found = parameterAddress(2);
    if (found) break;
    // A name takes its digits along, as in Q1; what follows them is something else.
    const bool isName = isOfName(lexer_.here());
    lexer_.advance();
    while (isName && isOfName(lexer_.here()))
      lexer_.advance();
    while (isName && isDigit(lexer_.here()))
      lexer_.advance();
  }
  lexer_.seek(begin);
  return found;
}

/// D15 P01 20; D15 P01 1 P02 +Q1: what stands between the slashes of FN 15: PRINT 1/+Q1.
bool BlockParser::printing() {
  const bool byAddresses = parameterAddress(1);
  lexer_.acceptKeyword("PRINT");
  if (!byAddresses || !secondParameterFollows()) return textCommand(CommandKind::Fn15);
  std::string text;
  for (int i = 1; i == 1 || !lexer_.atEnd(); ++i) {
    const std::optional<Operand> each = i == 1 ? value("P01") : parameterValue(i);
    if (!each) return false;
    text += (text.empty() ? "" : "/") + klartext::writeValue(block_, *each);
  }
  emit(Command{constant(nameOf(CommandKind::Fn15)), constant(text), -1, {}});
  return true;
}

/// D19 P01 +10 P02 +Q3; D29 with P01 to P08.
bool BlockParser::valuesForPlc(int number) {
  const std::size_t first = block_.words.size();
  const int most = static_cast<int>(klartext::mostPlcValues(number));
  for (int i = 1; i == 1 || !lexer_.atEnd(); ++i) {
    if (i > most) return error(fmt::format("D{} hands over at most {} values, P01 to P{:02}", number, most, most));
    const std::optional<Operand> each = parameterValue(i);
    if (!each) return false;
    addWord(static_cast<std::uint32_t>(i), *each);
  }
  emit(Command{constant(nameOf(klartext::functionCommand(number))), {}, -1, wordsSince(first)});
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
  if (!systemDatum()) return false;
  command.words = wordsSince(first);
  command.name = constant(nameOf(CommandKind::Fn18));
  emit(command);
  return expectEnd();
}

}  // namespace probewright::language::din_iso

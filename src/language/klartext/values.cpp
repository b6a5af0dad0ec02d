#include <fmt/format.h>

#include <algorithm>

#include "language/klartext/formula_writer.hpp"
#include "language/klartext/parser.hpp"

/// Numbers, parameters and words: what all kinds of blocks are made of.
namespace probewright::language::klartext {

Operand BlockParser::push(const Node& node) {
  block_.nodes.push_back(node);
  return {0, static_cast<std::int32_t>(block_.nodes.size() - 1)};
}

Operand BlockParser::textOperand(TextRef text) {
  Node node;
  node.operation = Operation::Text;
  node.text = text;
  return push(node);
}

Operand BlockParser::variableOperand(const VariableRef& variable) {
  block_.variables.push_back(variable);
  Node node;
  node.operation = Operation::Variable;
  node.a = static_cast<std::uint32_t>(block_.variables.size() - 1);
  return push(node);
}

Operand BlockParser::negated(Operand operand) {
  if (operand.isLiteral()) return Operand::of(-operand.number);
  Node node;
  node.operation = Operation::Negate;
  node.left = operand;
  return push(node);
}

Operand BlockParser::binary(Operation operation, Operand left, Operand right) {
  Node node;
  node.operation = operation;
  node.left = left;
  node.right = right;
  return push(node);
}

Operand BlockParser::callHost(std::string_view function, std::initializer_list<Operand> arguments) {
  Node node;
  node.operation = Operation::Call;
  node.function = Function::Host;
  node.text = constant(function);
  node.a = static_cast<std::uint32_t>(block_.operands.size());
  node.b = static_cast<std::uint32_t>(arguments.size());
  block_.operands.insert(block_.operands.end(), arguments);
  return push(node);
}

bool BlockParser::variableFollows() {
  if (lexer_.peek() != 'Q') return false;
  std::size_t i = 1;
  const char kind = upper(lexer_.here(i));
  if (kind == 'L' || kind == 'R' || kind == 'S') ++i;
  while (isBlankOrReturn(lexer_.here(i)))
    ++i;
  return isDigit(lexer_.here(i));
}

std::optional<VariableRef> BlockParser::variable() {
  constexpr double mostDigits = 99999;
  if (!variableFollows()) {
    error("a parameter Q, QL, QR or QS with its number is expected");
    return std::nullopt;
  }
  lexer_.advance();
  VariableRef variable;
  switch (upper(lexer_.here())) {
    case 'L':
      variable.space = VariableSpace::QL;
      break;
    case 'R':
      variable.space = VariableSpace::QR;
      break;
    case 'S':
      variable.space = VariableSpace::QS;
      break;
    default:
      variable.space = VariableSpace::Q;
      break;
  }
  if (variable.space != VariableSpace::Q) lexer_.advance();
  lexer_.peek();
  double number = 0;
  const std::size_t start = lexer_.offset();
  for (; isDigit(lexer_.here()); lexer_.advance())
    number = std::min(number * 10 + (lexer_.here() - '0'), mostDigits);
  const std::string_view digits = lexer_.text().substr(start, lexer_.offset() - start);
  variable.index[0] = Operand::of(number);
  const bool few = variable.space == VariableSpace::QL || variable.space == VariableSpace::QR;
  const int most = few ? 499 : 1999;
  if (number > most) {
    constexpr std::size_t longestQuote = 20;
    std::string name = writeVariable(variable);
    if (number == mostDigits)
      name = fmt::format("{}{}", name.substr(0, name.find('9')), digits.substr(0, longestQuote));
    error(fmt::format("there is no parameter {}", name), fmt::format("their numbers go up to {}", most));
    variable.index[0] = Operand::of(0);
  }
  return variable;
}

std::optional<std::uint32_t> BlockParser::variableIndex() {
  const std::optional<VariableRef> found = variable();
  if (!found) return std::nullopt;
  block_.variables.push_back(*found);
  return static_cast<std::uint32_t>(block_.variables.size() - 1);
}

std::optional<Operand> BlockParser::value(std::string_view what) {
  bool negative = false;
  for (char c = lexer_.peek(); c == '+' || c == '-'; c = lexer_.peek()) {
    if (c == '-') negative = !negative;
    lexer_.advance();
  }
  if (const std::optional<double> number = lexer_.number()) return Operand::of(negative ? -*number : *number);
  if (variableFollows()) {
    const std::optional<VariableRef> found = variable();
    const Operand operand = variableOperand(*found);
    return negative ? negated(operand) : operand;
  }
  error(std::string("a number or a Q parameter is expected for ").append(what));
  return std::nullopt;
}

std::optional<Operand> BlockParser::textOrVariable(std::string_view what) {
  if (const std::optional<std::string_view> text = lexer_.quoted()) return textOperand(ref(*text));
  if (variableFollows()) return variableOperand(*variable());
  error(std::string("a text in quotation marks or a parameter is expected for ").append(what));
  return std::nullopt;
}

Word& BlockParser::addWord(std::uint32_t address, Operand operand, WordMode mode) {
  Word& added = block_.words.emplace_back();
  added.address = address;
  added.mode = mode;
  added.value = operand;
  added.column = lexer_.column();
  added.line = lexer_.line();
  return added;
}

bool BlockParser::word(std::uint32_t address, std::string_view what, WordMode mode) {
  const std::uint32_t column = lexer_.column();
  const std::uint32_t line = lexer_.line();
  const std::optional<Operand> operand = value(what);
  if (!operand) return false;
  Word& added = addWord(address, *operand, mode);
  added.column = column > 1 ? column - 1 : 1;
  added.line = line;
  return true;
}

WordRange BlockParser::wordsSince(std::size_t first) const {
  return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(block_.words.size() - first)};
}

std::optional<Operand> BlockParser::valueBehindWords(std::string_view what) {
  // Words in any language, with or without colon: "ANGLE: +30", "HSC-MODE:1", "PKT.ODNIESIENIA +50".
  bool insideWord = false;
  for (;;) {
    if (lexer_.peek() == '\0') break;
    const char c = lexer_.here();
    const bool decimal = (c == '.' || c == ',') && isDigit(lexer_.here(1)) && !insideWord;
    const char following = upper(lexer_.here(1));
    const bool sign = (c == '+' || c == '-') && (!isLetter(following) || following == 'Q');
    if (isDigit(c) || decimal || sign || (!insideWord && variableFollows())) return value(what);
    insideWord = isWordByte(c);
    lexer_.advance();
    if (isBlankOrReturn(lexer_.here())) insideWord = false;
  }
  error(std::string("a number or a Q parameter is expected for ").append(what));
  return std::nullopt;
}

}  // namespace probewright::language::klartext

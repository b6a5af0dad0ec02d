#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "language/klartext/parser.hpp"

/// Assignments Q = formula. Precedence, lowest first: || ; + - ; * / % ; ^ ; functions, signs and parentheses.
/// Operators of one rank are computed from left to right, powers from right to left. Functions take the value after
/// them: SIN Q1 + 2 is (SIN Q1) + 2.
namespace probewright::language::klartext {

namespace {

constexpr int deepestNesting = 200;

struct NamedFunction {
  std::string_view name;
  Function function;
};

// Longer names before those they begin with.
constexpr std::array<NamedFunction, 15> functions = {{{"SIN", Function::Sin},
                                                      {"COS", Function::Cos},
                                                      {"TAN", Function::Tan},
                                                      {"ASIN", Function::Asin},
                                                      {"ACOS", Function::Acos},
                                                      {"ATAN", Function::Atan},
                                                      {"SQRT", Function::Sqrt},
                                                      {"SQ", Function::Square},
                                                      {"LN", Function::Ln},
                                                      {"LOG", Function::Log},
                                                      {"EXP", Function::Exp},
                                                      {"ABS", Function::Abs},
                                                      {"INT", Function::Integer},
                                                      {"FRAC", Function::Fraction},
                                                      {"SGN", Function::Sign}}};

constexpr std::array<std::string_view, 8> stringFunctions = {"TOCHAR", "SUBSTR", "SYSSTR",  "TONUMB",
                                                             "INSTR",  "STRLEN", "STRCOMP", "CFGREAD"};

}  // namespace

/// False, with a complaint, if a formula has more terms one in the other than an evaluation goes down. Operands stand
/// before the operation that takes them.
bool BlockParser::formulasFit() {
  constexpr int deepest = 500;
  if (block_.nodes.size() <= static_cast<std::size_t>(deepest)) return true;
  std::vector<int> depths(block_.nodes.size(), 1);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const Node& node = block_.nodes[i];
    const auto take = [&](const Operand& operand) {
      if (operand.node >= 0) depths[i] = std::max(depths[i], depths[static_cast<std::size_t>(operand.node)] + 1);
    };
    take(node.left);
    take(node.right);
    if (node.operation == Operation::Call) {
      for (std::uint32_t k = 0; k < node.b; ++k)
        take(block_.operands[node.a + k]);
    }
    if (depths[i] <= deepest) continue;
    lexer_.seek(0);
    return error("a formula of this block has too many terms", "compute it in several blocks");
  }
  return true;
}

bool BlockParser::assignment() {
  const std::optional<std::uint32_t> variable = variableIndex();
  if (!variable || !expect('=', "the parameter")) return false;
  const std::optional<Operand> result = formula();
  if (!result) return false;
  emit(Assign{*variable, *result});
  return expectEnd();
}

std::optional<Operand> BlockParser::formula() {
  std::optional<Operand> left = sum();
  while (left && lexer_.peek() == '|' && lexer_.here(1) == '|') {
    lexer_.advance(2);
    const std::optional<Operand> right = sum();
    if (!right) return std::nullopt;
    left = binary(Operation::Concatenate, *left, *right);
  }
  return left;
}

std::optional<Operand> BlockParser::sum() {
  std::optional<Operand> left = product();
  while (left) {
    const char c = lexer_.peek();
    if (c != '+' && c != '-') break;
    lexer_.advance();
    const std::optional<Operand> right = product();
    if (!right) return std::nullopt;
    left = binary(c == '+' ? Operation::Add : Operation::Subtract, *left, *right);
  }
  return left;
}

std::optional<Operand> BlockParser::product() {
  std::optional<Operand> left = power();
  while (left) {
    const char c = lexer_.peek();
    Operation operation = Operation::Multiply;
    if (c == '*') {
      lexer_.advance();
    } else if (c == '/') {
      operation = Operation::Divide;
      lexer_.advance();
    } else if (c == '%') {
      operation = Operation::Modulo;
      lexer_.advance();
    } else if (c == 'D' && lexer_.acceptKeyword("DIV")) {
      operation = Operation::Divide;
    } else {
      break;
    }
    const std::optional<Operand> right = power();
    if (!right) return std::nullopt;
    left = binary(operation, *left, *right);
  }
  return left;
}

/// a ^ b ^ c is a ^ (b ^ c).
std::optional<Operand> BlockParser::power() {
  const std::optional<Operand> base = signedPrimary();
  if (!base || !lexer_.accept('^')) return base;
  if (++depth_ > deepestNesting) {
    error("this formula is nested too deeply", "compute it in several blocks");
    return std::nullopt;
  }
  const std::optional<Operand> exponent = power();
  --depth_;
  if (!exponent) return std::nullopt;
  return binary(Operation::Power, *base, *exponent);
}

/// A sign belongs to the value after it: -2 ^ 2 is 4.
std::optional<Operand> BlockParser::signedPrimary() {
  bool negative = false;
  for (char c = lexer_.peek(); c == '+' || c == '-'; c = lexer_.peek()) {
    if (c == '-') negative = !negative;
    lexer_.advance();
  }
  const std::optional<Operand> value = primary();
  return value && negative ? negated(*value) : value;
}

std::optional<Operand> BlockParser::primary() {
  if (const std::optional<double> number = lexer_.number()) return Operand::of(*number);
  if (variableFollows()) return variableOperand(*variable());
  if (++depth_ > deepestNesting) {
    error("this formula is nested too deeply", "compute it in several blocks");
    return std::nullopt;
  }
  std::optional<Operand> result;
  if (lexer_.accept('(')) {
    result = formula();
    if (result && !expect(')', "the expression in parentheses")) result = std::nullopt;
  } else if (const std::optional<std::string_view> text = lexer_.quoted()) {
    result = textOperand(ref(*text));
  } else {
    result = functionCall();
  }
  --depth_;
  return result;
}

std::optional<Operand> BlockParser::functionCall() {
  lexer_.peek();
  if (lexer_.acceptKeyword("PI")) {
    return Operand::of(3.14159265358979323846);
  }
  for (const std::string_view name : stringFunctions) {
    if (lexer_.acceptKeyword(name)) return stringFunction(name);
  }
  const std::size_t start = lexer_.offset();
  const auto takesArgument = [&](std::string_view name) {
    if (!lexer_.acceptPrefix(name)) return false;
    if (!isLetter(lexer_.here()) || variableFollows()) return true;
    lexer_.seek(start);
    return false;
  };
  const bool negate = takesArgument("NEG");
  const NamedFunction* found = nullptr;
  for (std::size_t i = 0; !negate && i < functions.size(); ++i) {
    if (takesArgument(functions[i].name)) {
      found = &functions[i];
      break;
    }
  }
  if (!negate && found == nullptr) {
    error("a number, a parameter, a function or a parenthesis is expected in this formula");
    return std::nullopt;
  }
  std::optional<Operand> argument = signedPrimary();
  if (!argument) return std::nullopt;
  if (found == nullptr) return negated(*argument);
  Node node;
  node.operation = Operation::Call;
  node.function = found->function;
  node.a = static_cast<std::uint32_t>(block_.operands.size());
  node.b = 1;
  block_.operands.push_back(*argument);
  return push(node);
}

/// The arguments of string functions have names; the host gets them in a fixed order, 0 for BEG and
/// -1 for other numbers that are left out:
/// TOCHAR(value, decimals) SUBSTR(text, begin, length) SYSSTR(id, nr, idx, length) TONUMB(text)
/// INSTR(text, searched, begin) STRLEN(text [, is undefined]) STRCOMP(text, text) CFGREAD(key, tag, attribute, index).
std::optional<Operand> BlockParser::stringFunction(std::string_view name) {
  struct Named {
    std::string_view keyword;
    bool text;
  };
  std::array<Named, 4> names{};
  std::size_t count = 0;
  const auto takes = [&](std::string_view keyword) { names[count++] = {keyword, false}; };
  const auto takesText = [&](std::string_view keyword) { names[count++] = {keyword, true}; };
  if (name == "TOCHAR") takes("DAT"), takes("DECIMALS");
  if (name == "SUBSTR") takesText("SRC_"), takes("BEG"), takes("LEN");
  if (name == "SYSSTR") takes("ID"), takes("NR"), takes("IDX"), takes("LEN");
  if (name == "TONUMB" || name == "STRLEN") takesText("SRC_");
  if (name == "INSTR") takesText("SRC_"), takesText("SEA_"), takes("BEG");
  if (name == "STRCOMP") takesText("SRC_"), takesText("SEA_");
  if (name == "CFGREAD") takesText("KEY_"), takesText("TAG_"), takesText("ATR_"), takes("IDX");

  if (!expect('(', name)) return std::nullopt;
  std::array<Operand, 4> arguments{};
  while (!lexer_.accept(')')) {
    std::size_t i = 0;
    const std::size_t start = (lexer_.peek(), lexer_.offset());
    for (; i < count; ++i) {
      // "ID" begins "IDX" as well: the shorter one is followed by a value.
      if (lexer_.acceptPrefix(names[i].keyword)) {
        if (!isLetter(lexer_.here()) || names[i].text || variableFollows()) break;
        lexer_.seek(start);
      }
    }
    if (i == count) {
      error(std::string("this is not an argument of ").append(name));
      return std::nullopt;
    }
    const std::optional<Operand> argument = names[i].text ? textOrVariable(names[i].keyword) : value(names[i].keyword);
    if (!argument) return std::nullopt;
    const bool counts = names[i].keyword == "BEG" || names[i].keyword == "LEN" || names[i].keyword == "DECIMALS";
    if (counts && argument->isLiteral() && argument->number < 0) {
      error(fmt::format("{} of {} is 0 or more", names[i].keyword, name));
      return std::nullopt;
    }
    arguments[i] = *argument;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (arguments[i].present()) continue;
    if (names[i].text) {
      error(std::string("the argument ").append(names[i].keyword).append(" of ").append(name).append(" is missing"));
      return std::nullopt;
    }
    arguments[i] = Operand::of(names[i].keyword == "BEG" ? 0 : -1);
  }
  if (name == "STRLEN" && arguments[0].node >= 0) {
    const Node& text = block_.nodes[static_cast<std::size_t>(arguments[0].node)];
    if (text.operation == Operation::Variable) {
      Node undefined;
      undefined.operation = Operation::Undefined;
      undefined.a = text.a;
      return callHost(name, {arguments[0], push(undefined)});
    }
  }
  switch (count) {
    case 1:
      return callHost(name, {arguments[0]});
    case 2:
      return callHost(name, {arguments[0], arguments[1]});
    case 3:
      return callHost(name, {arguments[0], arguments[1], arguments[2]});
    default:
      return callHost(name, {arguments[0], arguments[1], arguments[2], arguments[3]});
  }
}

}  // namespace probewright::language::klartext

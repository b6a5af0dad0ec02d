#include <algorithm>
#include <array>
#include <charconv>

#include "base/number_text.hpp"
#include "language/sinumerik/block_parser.hpp"

namespace probewright::language::sinumerik {

using namespace language;

namespace {

constexpr int deepestNesting = 60;
/// Operators of one priority in a row: each lies one level deeper when the value is computed.
constexpr int mostTerms = 500;

/// The binary operator that is at the cursor; its priority is None if there is none.
BinaryOperator operatorAt(const Cursor& cursor) {
  const char c = cursor.peek();
  if (isCapital(c)) {
    if (c != 'D' && c != 'M' && c != 'B' && c != 'A' && c != 'X' && c != 'O') return {};
    const std::string_view name = cursor.peekName();
    for (const BinaryOperator& entry : binaryOperators())
      if (entry.symbol == name) return entry;
    return {};
  }
  switch (c) {
    case '+':
    case '-':
    case '*':
    case '/':
    case '<':
    case '>':
    case '=':
      break;
    case ':':
      return {":", Operation::Call, Priority::Chain};
    default:
      return {};
  }
  for (const BinaryOperator& entry : binaryOperators())
    if (cursor.rest().starts_with(entry.symbol)) return entry;
  return {};
}

/// AX1 to AX31: the axes of the machine by their numbers.
bool isMachineAxis(std::string_view name) {
  if (!name.starts_with("AX")) return false;
  const auto number = parseInteger(name.substr(2));
  return number && *number >= 1 && *number <= 31;
}

/// How the value of an axis counts.
constexpr std::array<std::string_view, 5> dimensions = {"AC", "IC", "DC", "ACP", "ACN"};

constexpr Priority above(Priority priority) { return static_cast<Priority>(static_cast<int>(priority) + 1); }

}  // namespace

Operand BlockParser::parseExpression() { return parseBinary(Priority::Comparison); }

Operand BlockParser::parseBinary(Priority lowest) {
  if (++depth_ > deepestNesting) {
    fail(cursor_.offset(), "this expression is nested too deeply", "Split it into several assignments.");
    return {};
  }
  cursor_.skipBlanks();
  const bool makesText = lowest <= Priority::Concatenation && cursor_.rest().starts_with("<<");
  Operand left = makesText ? emptyText() : parseUnary();  // <<R1 is ""<<R1
  for (int terms = 1;; ++terms) {
    cursor_.skipBlanks();
    const BinaryOperator op = operatorAt(cursor_);
    if (op.priority == Priority::None || op.priority < lowest || failed_) break;
    if (terms == mostTerms) {
      fail(cursor_.offset(), "this expression has too many terms", "Split it into several assignments.");
      break;
    }
    cursor_.advance(op.symbol.size());
    const Operand right = parseBinary(above(op.priority));
    if (failed_) break;
    Node node;
    node.operation = op.operation;
    node.left = left;
    node.right = right;
    if (op.operation == Operation::Call) {  // frames are chained with ':'
      node.left = node.right = {};
      node.a = static_cast<std::uint32_t>(block_->operands.size());
      node.b = 2;
      node.text = block_->add("CHAIN");
      block_->operands.push_back(left);
      block_->operands.push_back(right);
    }
    left = add(node);
  }
  --depth_;
  return left;
}

Operand BlockParser::parseUnary() {
  cursor_.skipBlanks();
  const char c = cursor_.peek();
  Operation operation = Operation::Negate;
  if (c == '-' || c == '+') {
    cursor_.advance();
    if (c == '+') operation = Operation::Add;
  } else if (c == 'N' && cursor_.peekName() == "NOT") {
    cursor_.advance(3);
    operation = Operation::Not;
  } else if (c == 'B' && cursor_.peekName() == "B_NOT") {
    cursor_.advance(5);
    operation = Operation::BitNot;
  } else {
    return parsePrimary();
  }
  if (++depth_ > deepestNesting) {
    fail(cursor_.offset(), "this expression is nested too deeply", "Split it into several assignments.");
    return {};
  }
  const Operand operand = parseUnary();
  --depth_;
  if (failed_ || operation == Operation::Add) return operand;
  if (operation == Operation::Negate && operand.isLiteral()) return Operand::of(-operand.number);
  Node node;
  node.operation = operation;
  node.left = operand;
  return add(node);
}

Operand BlockParser::parsePrimary() {
  cursor_.skipBlanks();
  const char c = cursor_.peek();
  if (isDigit(c) || c == '.') {
    double value = 0;
    if (takeNumber(value)) return Operand::of(value);
  }
  if (c == '(') {
    cursor_.advance();
    const Operand inner = parseExpression();
    expect(')', "at the end of the parenthesis");
    if (!failed_ && inner.node >= 0) {
      Node& node = block_->nodes[static_cast<std::size_t>(inner.node)];
      if (node.operation != Operation::Call) node.b = inParentheses;
    }
    return inner;
  }
  if (c == '"') return parseString();
  if (c == '\'') return parseQuotedConstant();
  if (c == '$' || isNameStart(c)) return parseNamedValue();
  std::string advice;
  if (c == '=') advice = "'=' assigns; a comparison is written '=='.";
  fail(cursor_.offset(), cursor_.atEnd() ? "a value is missing at the end of the block" : "a value was expected here",
       std::move(advice));
  return {};
}

Operand BlockParser::emptyText() {
  Node node;
  node.operation = Operation::Text;
  node.text = block_->add("");
  return add(node);
}

Operand BlockParser::parseString() {
  const std::size_t start = cursor_.offset() + 1;
  const std::size_t end = upper_.find('"', start);
  if (end == std::string::npos) {
    fail(start - 1, "this text has no closing quotation mark", "Close the text with \" in the same block.");
    return {};
  }
  cursor_.moveTo(end + 1);
  Node node;
  node.operation = Operation::Text;
  node.text = original(start, end - start);
  return add(node);
}

/// 'H1F' hexadecimal, 'B101' binary, 'x' the code of a character.
Operand BlockParser::parseQuotedConstant() {
  const std::size_t start = cursor_.offset() + 1;
  const std::size_t end = upper_.find('\'', start);
  if (end == std::string::npos || end == start) {
    fail(start - 1, "this constant in apostrophes is not complete",
         "Write 'H1F' for hexadecimal, 'B101' for binary, 'A' for the code of a character.");
    return {};
  }
  cursor_.moveTo(end + 1);
  if (end - start == 1) return Operand::of(static_cast<unsigned char>(line_[start]));
  const int base = upper_[start] == 'H' ? 16 : upper_[start] == 'B' ? 2 : upper_[start] == 'D' ? 10 : 0;
  std::uint64_t value = 0;
  const char* first = upper_.data() + start + 1;
  const char* last = upper_.data() + end;
  if (base != 0) {
    const auto [stop, error] = std::from_chars(first, last, value, base);
    if (error == std::errc() && stop == last) return Operand::of(static_cast<double>(value));
  }
  fail(start - 1, "this constant in apostrophes is neither hexadecimal nor binary",
       "Write 'H1F' for hexadecimal, 'B101' for binary, 'A' for the code of a character.");
  return {};
}

Operand BlockParser::parseNamedValue() {
  const std::size_t start = cursor_.offset();
  Node node;
  if (cursor_.peek() != '$') {
    const bool letterOnly = !isNameStart(cursor_.peek(1));
    const char letter = cursor_.peek();
    if (letterOnly && !(letter == 'R' && (isDigit(cursor_.peek(1)) || cursor_.peek(1) == '['))) {
      // One letter, perhaps with digits, names an axis: variables begin with two letters.
      cursor_.advance();
      cursor_.digits();
      node.operation = Operation::AxisName;
      node.text = upper(cursor_.since(start));
      return add(node);
    }
    if (!letterOnly) {
      const std::string_view name = cursor_.peekName();
      if (name == "TRUE" || name == "FALSE") {
        cursor_.advance(name.size());
        return Operand::of(name == "TRUE" ? 1 : 0);
      }
      Cursor ahead = cursor_;
      ahead.advance(name.size());
      ahead.skipBlanks();
      if (ahead.peek() == '(') {
        cursor_.advance(name.size());
        return parseFunction(name, start);
      }
      if (isMachineAxis(name)) {
        cursor_.advance(name.size());
        node.operation = Operation::AxisName;
        node.text = upper(name);
        return add(node);
      }
      if (keywordOf(name) != Keyword::None && keywordOf(name) != Keyword::Statement) {
        fail(start, "a value was expected here, not the reserved word " + std::string(name));
        return {};
      }
    }
  }
  node.operation = Operation::Variable;
  node.a = parseVariable();
  return failed_ ? Operand{} : add(node);
}

Operand BlockParser::parseFunction(std::string_view name, std::size_t start) {
  std::array<Operand, 32> arguments;
  std::size_t count = 0;
  cursor_.take('(');
  if (!cursor_.take(')')) {
    do {
      if (count == arguments.size()) {
        fail(cursor_.offset(), "this call has too many arguments");
        return {};
      }
      arguments[count++] = parseExpression();
    } while (!failed_ && cursor_.take(','));
    if (!expect(')', "at the end of the arguments")) return {};
  }
  const FunctionEntry* entry = functionOf(name);
  if (entry == nullptr && std::ranges::find(dimensions, name) != dimensions.end()) {
    fail(start, std::string(name) + " is written behind the name of an axis only, and there is none before it",
         "The axes are X, Y, Z, A, B, C, U, V, W and E, also with a number: X1=" + std::string(name) + "(5).");
    return {};
  }
  if (entry == nullptr) {
    std::vector<std::string_view> names;
    for (const FunctionEntry& known : functions())
      names.push_back(known.name);
    const std::string_view close = closestName(name, names);
    fail(start, "there is no function " + std::string(name),
         close.empty() ? "Subprograms are called in a block of their own; arrays are indexed with [ ]."
                       : "Did you mean " + std::string(close) + "?");
    return {};
  }
  if (static_cast<int>(count) < entry->fewestArguments || static_cast<int>(count) > entry->mostArguments) {
    const std::string wanted = entry->fewestArguments == entry->mostArguments
                                   ? std::to_string(entry->fewestArguments)
                                   : "at least " + std::to_string(entry->fewestArguments);
    fail(start, std::string(name) + " takes " + wanted + " argument" + (entry->fewestArguments == 1 ? "" : "s") +
                    ", but " + std::to_string(count) + (count == 1 ? " is given" : " are given"));
    return {};
  }
  Node node;
  node.operation = Operation::Call;
  node.function = entry->function;
  node.text = upper(start, name.size());
  node.a = static_cast<std::uint32_t>(block_->operands.size());
  node.b = static_cast<std::uint32_t>(count);
  block_->operands.insert(block_->operands.end(), arguments.begin(), arguments.begin() + count);
  return add(node);
}

std::uint32_t BlockParser::parseVariable() {
  cursor_.skipBlanks();
  const std::size_t start = cursor_.offset();
  VariableRef variable;
  if (cursor_.peek() == '$') {
    cursor_.advance();
    if (cursor_.peek() == '$') cursor_.advance();
    if (cursor_.name().empty()) {
      fail(start, "the name of a system variable is missing after $");
      return 0;
    }
    variable.space = VariableSpace::System;
    variable.name = upper(cursor_.since(start));
  } else if (cursor_.peek() == 'R' && !isNameStart(cursor_.peek(1))) {
    variable.space = VariableSpace::R;
    cursor_.advance();
    const std::string_view digits = cursor_.digits();
    if (digits.size() > 6) {
      fail(start, "the number of this R parameter is too large", "R parameters have the numbers 0 to 9999 at most.");
      return 0;
    }
    if (!digits.empty()) {
      double number = 0;
      for (const char c : digits)
        number = number * 10 + (c - '0');
      variable.index[0] = Operand::of(number);
    }
  } else {
    variable.space = VariableSpace::User;
    variable.name = upper(cursor_.name());
    if (variable.name.length == 0) {
      fail(start, "the name of a variable was expected");
      return 0;
    }
  }
  if (cursor_.peek() == ' ' || cursor_.peek() == '\t') {
    Cursor ahead = cursor_;
    ahead.skipBlanks();
    if (ahead.peek() == '[') cursor_ = ahead;
  }
  if (cursor_.peek() == '[') parseIndices(variable);
  if (!failed_ && variable.space == VariableSpace::R && !variable.index[0].present())
    fail(start, "the number of the R parameter is missing", "Write R1 or R[expression].");
  if (failed_) return 0;
  block_->variables.push_back(variable);
  return static_cast<std::uint32_t>(block_->variables.size() - 1);
}

void BlockParser::parseIndices(VariableRef& variable) {
  const std::size_t start = cursor_.offset();
  cursor_.advance();
  // NAME[] and NAME[,] hand over a whole array.
  Cursor ahead = cursor_;
  while (ahead.take(',')) {
  }
  if (ahead.take(']')) {
    cursor_ = ahead;
    return;
  }
  for (std::size_t i = 0;; ++i) {
    if (i == std::size(variable.index)) {
      fail(start, "a variable has at most three indices");
      return;
    }
    cursor_.skipBlanks();
    // Empty brackets hand over a whole array.
    if (i == 0 && variable.space == VariableSpace::User && cursor_.take(']')) return;
    // Components of frames are words of their own: after an axis in frames of the program.
    const std::string_view name = cursor_.peekName();
    const Operand before = i > 0 ? variable.index[i - 1] : Operand{};
    const bool behindAxis =
        before.node >= 0 && block_->nodes[static_cast<std::size_t>(before.node)].operation == Operation::AxisName;
    const bool component = (variable.space == VariableSpace::System || behindAxis) &&
                           (name == "TR" || name == "FI" || name == "RT" || name == "SC" || name == "MI");
    if (component) {
      cursor_.advance(2);
      Node node;
      node.operation = Operation::AxisName;
      node.text = upper(name);
      variable.index[i] = add(node);
    } else {
      variable.index[i] = parseExpression();
    }
    if (failed_) return;
    if (cursor_.take(',')) continue;
    expect(']', "at the end of the indices");
    return;
  }
}

}  // namespace probewright::language::sinumerik

#include <fmt/format.h>

#include <algorithm>

#include "language/klartext/parser.hpp"

/// TOOL CALL and TOOL DEF.
namespace probewright::language::klartext {

namespace {

constexpr double highestTool = 32767;

bool isToolAxis(char letter) { return letter >= 'X' && letter <= 'Z'; }

/// The control has these tool axes, too.
bool isParallelAxis(char letter) { return letter >= 'U' && letter <= 'W'; }

}  // namespace

/// The tool itself: its number with its index, its name, or a parameter with one of them.
bool BlockParser::toolIdentity(ToolCall& call) {
  if (lexer_.peek() == '+') lexer_.advance();
  if (const std::optional<std::string_view> name = lexer_.quoted()) {
    call.name = textOperand(ref(*name));
  } else if (isDigit(lexer_.peek())) {
    double number = 0;
    for (; isDigit(lexer_.here()); lexer_.advance())
      number = std::min(number * 10 + (lexer_.here() - '0'), 1e9);
    if (number > highestTool) return error("there is no tool with such a number", "tool numbers go up to 32767");
    call.number = Operand::of(number);
    if (lexer_.here() == '.' && isDigit(lexer_.here(1))) {
      lexer_.advance();
      call.index = Operand::of(lexer_.here() - '0');
      while (isDigit(lexer_.here()))
        lexer_.advance();
    }
  } else if (variableFollows()) {
    const VariableRef tool = *variable();
    (tool.space == VariableSpace::QS ? call.name : call.number) = variableOperand(tool);
  } else if (lexer_.peek() == '"') {
    return error("the quotation mark that ends the tool name is missing");
  }
  return true;
}

/// S, F, DL, DR or DR2 of a tool call.
bool BlockParser::toolWord(ToolCall& call) {
  const char c = lexer_.peek();
  if (c == 'D' && upper(lexer_.here(1)) != 'L' && upper(lexer_.here(1)) != 'R') {
    return error("the tool axis, S, F, DL, DR, DR2 or M is expected here",
                 "oversizes of a tool are written DL+0.1, DR-0.05 and DR2+0.1");
  }
  const std::size_t start = lexer_.offset();
  const auto twice = [&](std::string_view word) {
    lexer_.seek(start);
    return error(std::string(word).append(" is given twice in this block"), "remove one of the two");
  };
  if (c == 'S') {
    if (call.spindleSpeed.present() || call.cuttingSpeed.present()) return twice("the spindle speed");
    lexer_.advance();
    if (lexer_.accept('(')) {  // S(VC = 120): a cutting speed
      if (!lexer_.acceptPrefix("VC") || !expect('=', "VC"))
        return diagnostics_.empty() ? error("VC = with a cutting speed is expected in the parentheses after S") : false;
      const std::optional<Operand> speed = value("VC");
      if (!speed || !expect(')', "the cutting speed")) return false;
      call.cuttingSpeed = *speed;
    } else {
      const std::optional<Operand> speed = value("the spindle speed S");
      if (!speed) return false;
      call.spindleSpeed = *speed;
    }
  } else if (c == 'F') {
    if (call.feed.present()) return twice("the feed");
    bool rapid = false;
    bool automatic = false;
    if (!feedWord(call.feed, &rapid, &automatic)) return false;
  } else {
    Operand* delta = upper(lexer_.here(1)) == 'L' ? &call.deltaLength : &call.deltaRadius;
    lexer_.advance(2);
    // DR2+0.1 is the corner radius; DR2 alone would be the radius.
    const char sign = lexer_.here(1);
    if (delta == &call.deltaRadius && lexer_.here() == '2' && !isDigit(sign) && sign != '.') {
      delta = &call.deltaRadius2;
      lexer_.advance();
    }
    if (lexer_.here() == ':') lexer_.advance();
    const std::optional<Operand> amount = value("the tool oversize");
    if (!amount) return false;
    if (delta->present()) return twice("the oversize");
    *delta = *amount;
  }
  return true;
}

bool BlockParser::toolCall() {
  ToolCall call;
  if (!toolIdentity(call)) return false;
  for (;;) {
    const char c = lexer_.peek();
    if (c == '\0') break;
    if (isParallelAxis(c) && !isWordByte(lexer_.here(1))) {
      return error(fmt::format("the tool axis {} is not available: tools lie along X, Y or Z here", c),
                   "choose the tool axis X, Y or Z");
    }
    if (isToolAxis(c) && call.axis == 0 && !isWordByte(lexer_.here(1))) {
      call.axis = c;
      lexer_.advance();
    } else if (c == 'S' || c == 'F' || c == 'D') {
      if (!toolWord(call)) return false;
    } else if (c == 'M') {
      if (!machineFunction(nullptr)) return false;
    } else {
      return error("the tool axis, S, F, DL, DR, DR2 or M is expected here",
                   "write the name of a tool in quotation marks: TOOL CALL \"TASTER\" Z");
    }
  }
  const Instruction instruction = call;
  emitWithMachineFunctions(&instruction);
  return true;
}

bool BlockParser::toolDefinition() {
  const std::size_t first = block_.words.size();
  if (lexer_.atEnd()) return error("a tool number or name is expected after TOOL DEF");
  if (const std::optional<std::string_view> name = lexer_.quoted()) {
    addWord(addressOf("T"), textOperand(ref(*name)));
  } else if (!word(addressOf("T"), "the tool number")) {
    return false;
  }
  while (!lexer_.atEnd()) {
    const char c = lexer_.peek();
    if (c != 'L' && c != 'R') return error("L or R is expected here");
    lexer_.advance();
    if (!word(addressOf({&c, 1}), "the tool dimension")) return false;
  }
  emit(Command{constant(nameOf(CommandKind::ToolDefinition)), {}, -1, wordsSince(first)});
  return true;
}

}  // namespace probewright::language::klartext

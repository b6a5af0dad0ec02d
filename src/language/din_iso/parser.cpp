#include "language/din_iso/parser.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "language/klartext/program.hpp"

/// The kinds of blocks: program head and end, calls, labels; all that consists of words is in words.cpp.
namespace probewright::language::din_iso {

void BlockParser::parse() {
  const auto skipSign = [this]() {
    if (lexer_.peek() != '/') return;
    block_.skippable = true;
    lexer_.advance();
  };
  skipSign();
  if (lexer_.peek() == 'N' && isDigit(lexer_.here(1))) {
    lexer_.advance();
    while (isDigit(lexer_.here()))
      lexer_.advance();
  }
  skipSign();
  if (!statement() || !numbersFit() || !formulasFit()) block_.instructions.clear();
}

bool BlockParser::statement() {
  const char first = lexer_.peek();
  const char second = upper(lexer_.here(1));
  switch (first) {
    case '\0':
    case '*':
      return true;
    case '%':
      return percent();
    case 'Q':
      if (variableFollows()) return assignment();
      break;
    case 'D':
      if (isDigit(second)) return function();
      break;
    case 'L':
      return labelCall();
    default:
      break;
  }
  // What newer controls added is in DIN/ISO programs as it is in Klartext.
  for (const std::string_view keyword :
       {"PLANE", "FUNCTION", "TRANS", "PRESET", "DECLARE", "SQL", "ERROR", "TABDATA", "SEL", "OPEN"}) {
    const std::size_t start = lexer_.offset();
    if (!lexer_.acceptKeyword(keyword)) continue;
    lexer_.seek(start);
    return klartext::BlockParser::statement();
  }
  return words();
}

/// %NAME G71 begins and ends the program; %NAME calls another one; %:TAB: "file" selects one.
bool BlockParser::percent() {
  lexer_.advance();
  if (lexer_.here() == ':') return selectionByPercent();
  if (lexer_.here() == '<' && lexer_.here(1) == '>' && lexer_.here(2) == '%') {
    lexer_.advance(3);
    CallProgram call;
    call.nameValue = callHost("SELECTED PGM", {});
    emit(call);
    return expectEnd();
  }
  CallProgram call;
  if (const std::optional<std::string_view> quoted = lexer_.quoted()) {
    if (quoted->empty()) return error("the name of a program is expected after %");
    call.name = ref(*quoted);
    emit(call);
    return expectEnd();
  }
  if (lexer_.peek() == 'Q' && upper(lexer_.here(1)) == 'S' && variableFollows()) {
    call.nameValue = variableOperand(*variable());
    emit(call);
    return expectEnd();
  }
  const std::string_view rest = lexer_.restOfLine();
  if (rest.empty()) return error("the name of a program is expected after %");
  if (!checkPath(rest) || !expectEnd()) return false;
  const std::size_t blank = rest.find_last_of(" \t");
  const std::string_view unit = blank == std::string_view::npos ? std::string_view() : rest.substr(blank + 1);
  const bool inch = unit == "G70" || unit == "g70";
  if (!inch && unit != "G71" && unit != "g71") {
    if (first_) return error("G71 (mm) or G70 (inch) is expected after the name of the program");
    call.name = ref(rest);
    emit(call);
    return true;
  }
  if (!first_) {
    emit(EndProgram{});
    return true;
  }
  std::string_view name = rest.substr(0, blank);
  name = trimmedAtEnd(name, blanksAndReturn);
  emit(Command{
      constant(nameOf(CommandKind::BeginProgram)), constant(fmt::format("{} {}", name, inch ? "INCH" : "MM")), -1, {}});
  return true;
}

bool BlockParser::selectionByPercent() {
  struct Selection {
    std::string_view sign, name;
  };
  static constexpr std::array<Selection, 4> selections = {
      {{":PGM:", "SEL PGM"}, {":TAB:", "SEL TABLE"}, {":PAT:", "SEL PATTERN"}, {":CNT:", "SEL CONTOUR"}}};
  for (const Selection& selection : selections) {
    if (!lexer_.acceptPrefix(selection.sign)) continue;
    Command command;
    const std::size_t first = block_.words.size();
    if (const std::optional<std::string_view> text = lexer_.quoted()) {
      command.text = ref(*text);
    } else if (variableFollows() && upper(lexer_.here(1)) == 'S') {
      addWord(0, variableOperand(*variable()));
    } else {
      const std::string_view name = lexer_.restOfLine();
      if (!checkPath(name)) return false;
      command.text = ref(name);
    }
    if (command.text.length == 0 && block_.words.size() == first) {
      return error(fmt::format("the name of a file is expected after %{}", selection.sign));
    }
    if (!expectEnd()) return false;
    command.name = constant(selection.name);
    command.words = wordsSince(first);
    emit(command);
    return true;
  }
  // %:NAME.I: a program in the folder of the caller.
  lexer_.advance();
  CallProgram call;
  const std::string_view name = lexer_.restOfLine();
  if (name.empty()) return error("the name of a program is expected after %:");
  if (!checkPath(name) || !expectEnd()) return false;
  call.name = ref(name);
  emit(call);
  return true;
}

/// L1 and L1,0 call a subprogram, L1,5 repeats a part.
bool BlockParser::labelCall() {
  lexer_.advance();
  CallLabel call;
  if (!labelName(call.label, call.labelValue)) return false;
  if (lexer_.accept(',') && !repeats(call)) return false;
  emit(call);
  return expectEnd();
}

/// After G98.
bool BlockParser::labelDefinition() {
  if (!lexer_.accept('L')) return error("L with the number or name of the label is expected after G98");
  LabelMark mark;
  Operand computed;
  if (!labelName(mark.label, computed)) return false;
  if (computed.present()) return error("the label that G98 sets cannot be a parameter");
  mark.end = block_.at(mark.label) == "0";
  emit(mark);
  return expectEnd();
}

}  // namespace probewright::language::din_iso

#include "language/klartext/meant_word.hpp"
#include "language/klartext/parser.hpp"
#include "language/klartext/pattern.hpp"
#include "language/klartext/program.hpp"

/// Labels, calls and selections of other files.
namespace probewright::language::klartext {

bool BlockParser::labelName(TextRef& label, Operand& labelValue) {
  if (const std::optional<std::string_view> name = lexer_.quoted()) {
    if (name->empty()) return error("a label name may not be empty");
    const std::string named = namedLabel(*name);
    const bool marks = named != *name;
    const bool asWritten = marks && *(name->data() - 1) == '"' && *(name->data() + name->size()) == '"';
    label = !marks      ? ref(*name)
            : asWritten ? ref(std::string_view(name->data() - 1, name->size() + 2))
                        : block_.add(named);
    return true;
  }
  if (isDigit(lexer_.peek())) {
    const std::size_t start = lexer_.offset();
    while (isDigit(lexer_.here()))
      lexer_.advance();
    label = ref(canonicalLabel(lexer_.text().substr(start, lexer_.offset() - start)));
    return true;
  }
  if (variableFollows()) {
    labelValue = variableOperand(*variable());
    return true;
  }
  return error("a label number, a label name in quotation marks or a QS parameter is expected");
}

bool BlockParser::label() {
  LabelMark mark;
  Operand computed;
  if (!labelName(mark.label, computed)) return false;
  if (computed.present()) return error("the label of LBL itself cannot be a parameter");
  mark.end = block_.at(mark.label) == "0";
  emit(mark);
  return expectEnd();
}

/// The number of repeats; with the number 0 nothing is repeated: the label is called as a subprogram.
bool BlockParser::repeats(CallLabel& call) {
  const std::optional<Operand> number = value("the number of repeats");
  if (!number) return false;
  if (!number->isLiteral() || number->number != 0) call.repeats = *number;
  return true;
}

bool BlockParser::callLabel() {
  CallLabel call;
  if (!labelName(call.label, call.labelValue)) return false;
  // REP without a number calls a subprogram. Older programs show the repeats still to come as well: REP 2/2.
  if (lexer_.acceptPrefix("REP") && !lexer_.atEnd()) {
    if (!repeats(call)) return false;
    if (lexer_.accept('/') && !value("the number of repeats")) return false;
  }
  emit(call);
  return expectEnd();
}

/// A path without quotation marks.
bool BlockParser::checkPath(std::string_view path) {
  if (path.find('"') == std::string_view::npos) return true;
  return error("the quotation marks of this name do not match", "write the name between two quotation marks");
}

bool BlockParser::callSelectedProgram() {
  CallProgram call;
  call.nameValue = callHost("SELECTED PGM", {});
  emit(call);
  return expectEnd();
}

bool BlockParser::callProgram() {
  CallProgram call;
  if (lexer_.atEnd()) {
    return error("the name of a program is expected after CALL PGM",
                 "write its name, or CALL SELECTED PGM for the one that SEL PGM names");
  }
  if (const std::optional<std::string_view> name = lexer_.quoted()) {
    call.name = ref(*name);
    if (!expectEnd()) return false;
  } else if (variableFollows() && upper(lexer_.here(1)) == 'S') {
    call.nameValue = variableOperand(*variable());
    if (!expectEnd()) return false;
  } else {
    call.name = ref(lexer_.restOfLine());
    if (!checkPath(block_.at(call.name))) return false;
  }
  emit(call);
  return true;
}

/// SEL PGM, SEL CYCLE, SEL TABLE, SEL PATTERN, SEL CONTOUR... with a path as it stands, in quotation marks, or a QS
/// parameter.
bool BlockParser::selection() {
  lexer_.peek();
  const std::size_t start = lexer_.offset();
  while (isLetter(lexer_.here()) || lexer_.here() == '-')
    lexer_.advance();
  const std::string_view kind = lexer_.text().substr(start, lexer_.offset() - start);
  std::string name = "SEL ";
  for (const char c : kind)
    name += upper(c);
  if (name != "SEL PGM" && name != "SEL TABLE" && name != "SEL PATTERN" && name != "SEL CONTOUR" &&
      name != "SEL CYCLE" && name != "SEL CORR-TABLE") {
    lexer_.seek(start);
    return error("PGM, CYCLE, TABLE, PATTERN, CONTOUR or CORR-TABLE is expected after SEL",
                 meantWord(lexer_, {"PGM", "CYCLE", "TABLE", "PATTERN", "CONTOUR", "CORR-TABLE"}));
  }
  Command command;
  for (const std::string_view system : {"TCS", "WPL"}) {
    if (name == "SEL CORR-TABLE" && lexer_.acceptKeyword(system)) name.append(" ").append(system);
  }
  const std::size_t first = block_.words.size();
  if (const std::optional<std::string_view> text = lexer_.quoted()) {
    command.text = ref(*text);
  } else if (variableFollows() && upper(lexer_.here(1)) == 'S') {
    addWord(0, variableOperand(*variable()));
  } else {
    command.text = ref(lexer_.restOfLine());
    if (command.text.length == 0) return error("the name of a file is expected here");
    if (!checkPath(block_.at(command.text))) return false;
  }
  command.name = constant(name);
  command.words = wordsSince(first);
  emit(command);
  return true;
}

bool BlockParser::cycleCall() {
  Command command;
  const std::size_t first = block_.words.size();
  if (lexer_.acceptKeyword("PAT")) {
    command.text = constant("PAT");
  } else if (lexer_.acceptKeyword("POS")) {
    command.text = constant("POS");
  }
  Move words;
  const std::string_view form = block_.at(command.text);
  if (!moveWords(words, pathWords(form.empty() ? "CYCL CALL" : form == "POS" ? "CYCL CALL POS" : "CYCL CALL PAT")))
    return false;
  if (words.feed.present()) addWord(addressOf("F"), words.feed);
  command.words = wordsSince(first);
  command.name = constant(nameOf(CommandKind::CycleCall));
  const Instruction instruction = command;
  emitWithMachineFunctions(&instruction);
  return true;
}

/// PATTERN DEF: the points are computed when the block is carried out; what it may say is known here.
bool BlockParser::patternDefinition() {
  if (!lexer_.acceptKeyword("DEF")) return error("DEF is expected after PATTERN");
  const std::string_view text = lexer_.restOfBlock();
  const auto points = patternPoints(text, [](std::string_view) { return 1.0; });
  if (!points) return error(points.error().message, points.error().advice);
  emit(Command{constant(nameOf(CommandKind::PatternDefinition)), ref(text), -1, {}});
  return true;
}

}  // namespace probewright::language::klartext

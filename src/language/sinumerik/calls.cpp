#include <array>

#include "language/sinumerik/block_parser.hpp"

namespace probewright::language::sinumerik {

using namespace language;

namespace {

constexpr std::size_t mostArguments = 127;

}  // namespace

/// "(a,,b)": one word per position; an omitted argument has an absent value.
WordRange BlockParser::parseArguments() {
  std::array<Word, mostArguments> words;
  std::size_t count = 0;
  cursor_.take('(');
  cursor_.skipBlanks();
  if (!cursor_.take(')')) {
    for (;;) {
      if (count == words.size()) {
        fail(cursor_.offset(), "this call has too many arguments");
        return {};
      }
      cursor_.skipBlanks();
      Word& word = words[count];
      word.address = static_cast<std::uint32_t>(count++);
      word.column = static_cast<std::uint32_t>(cursor_.offset()) + 1;
      if (cursor_.peek() != ',' && cursor_.peek() != ')') word.value = parseExpression();
      if (failed_) return {};
      if (cursor_.take(',')) continue;
      if (cursor_.take(')')) break;
      fail(cursor_.offset(), "',' or ')' expected between the arguments");
      return {};
    }
  }
  const WordRange range{static_cast<std::uint32_t>(block_->words.size()), static_cast<std::uint32_t>(count)};
  block_->words.insert(block_->words.end(), words.begin(), words.begin() + count);
  return range;
}

void BlockParser::parseProgramCall(TextRef name, Meant meant) {
  CallProgram call;
  call.name = name;
  call.maybeCycle = meant == Meant::ProgramOrCycle;
  cursor_.skipBlanks();
  if (cursor_.peek() == '(') call.arguments = parseArguments();
  if (!failed_) block_->instructions.emplace_back(call);
}

/// CALL "NAME", CALL NAMEVARIABLE, EXTCALL "PATH", EXTCALL("PATH"); CALL ["NAME"] BLOCK FROM TO LAST.
void BlockParser::parseCall(std::size_t start) {
  cursor_.skipBlanks();
  if (cursor_.peekName() == "BLOCK") {
    RepeatSection section;
    if (!isFirstStatement())
      return fail(start, "CALL BLOCK must be in a block of its own", "Begin a new line with it.");
    if (!parseCalledSection(section.from, section.to)) return;
    block_->instructions.emplace_back(section);
    return expectEnd("the section to call");
  }
  if (cursor_.atEnd()) return fail(start, "the program to call is missing", "Write CALL \"NAME\".");
  CallProgram call;
  call.nameValue = parseExpression();
  if (failed_) return;
  if (!call.nameValue.isLiteral()) {
    const Node& node = block_->nodes[static_cast<std::size_t>(call.nameValue.node)];
    if (node.operation == Operation::Text) {
      call.name = node.text;
      call.nameValue = {};
    }
  } else {
    return fail(start, "CALL needs the name of a program", "Write CALL \"NAME\".");
  }
  cursor_.skipBlanks();
  if (cursor_.peekName() == "BLOCK" && !parseCalledSection(call.from, call.to)) return;
  block_->instructions.emplace_back(call);
}

/// BLOCK FROM TO LAST after CALL.
bool BlockParser::parseCalledSection(TextRef& from, TextRef& to) {
  constexpr const char* advice = "Write CALL \"NAME\" BLOCK FIRSTLABEL TO LASTLABEL.";
  cursor_.advance(5);
  from = parseTarget();
  cursor_.skipBlanks();
  if (from.length == 0 || cursor_.peekName() != "TO") {
    fail(cursor_.offset(),
         from.length == 0 ? "the first label of the section to call was expected" : "TO expected after the first label",
         advice);
    return false;
  }
  cursor_.advance(2);
  to = parseTarget();
  if (to.length == 0) fail(cursor_.offset(), "the last label of the section to call was expected", advice);
  return !failed_;
}

/// PCALL /_N_WKS_DIR/_N_PART_WPD/_N_SUB_SPF(arguments).
void BlockParser::parsePathCall(std::size_t start) {
  cursor_.skipBlanks();
  const std::size_t first = cursor_.offset();
  while (isNamePart(cursor_.peek()) || cursor_.peek() == '/' || cursor_.peek() == '.')
    cursor_.advance();
  const std::string_view path = cursor_.since(first);
  if (path.empty()) return fail(start, "the path of the program to call is missing", "Write PCALL PATH(arguments).");
  parseProgramCall(upper(path), Meant::Program);
}

/// MCALL NAME(arguments) calls after each motion; MCALL alone ends that.
void BlockParser::parseModalCall() {
  CallProgram call;
  call.modal = call.maybeCycle = true;
  cursor_.skipBlanks();
  if (isNameStart(cursor_.peek())) {
    const std::size_t start = cursor_.offset();
    cursor_.name();
    call.name = upper(cursor_.since(start));
    cursor_.skipBlanks();
    if (cursor_.peek() == '(') call.arguments = parseArguments();
  }
  if (!failed_) block_->instructions.emplace_back(call);
}

/// Statements whose text is kept whole.
void BlockParser::parseRest(std::string_view name) {
  Command command;
  command.name = upper(name);
  command.text = restOfBlock();
  if (command.text.length == 0)
    return fail(cursor_.offset(), "after " + std::string(name) + " the statement is missing");
  block_->instructions.emplace_back(command);
}

}  // namespace probewright::language::sinumerik

#include <array>

#include "language/sinumerik/block_parser.hpp"

namespace probewright::sinumerik {

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

void BlockParser::parseProgramCall(TextRef name, bool maybeCycle) {
  CallProgram call;
  call.name = name;
  call.maybeCycle = maybeCycle;
  cursor_.skipBlanks();
  if (cursor_.peek() == '(') call.arguments = parseArguments();
  if (!failed_) block_->instructions.emplace_back(call);
}

/// CALL "NAME", CALL NAMEVARIABLE, EXTCALL "PATH", EXTCALL("PATH").
void BlockParser::parseCall(std::size_t start) {
  cursor_.skipBlanks();
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
  block_->instructions.emplace_back(call);
}

/// PCALL /_N_WKS_DIR/_N_PART_WPD/_N_SUB_SPF(arguments).
void BlockParser::parsePathCall(std::size_t start) {
  cursor_.skipBlanks();
  const std::size_t first = cursor_.offset();
  while (isNamePart(cursor_.peek()) || cursor_.peek() == '/' || cursor_.peek() == '.')
    cursor_.advance();
  const std::string_view path = cursor_.since(first);
  if (path.empty()) return fail(start, "the path of the program to call is missing", "Write PCALL PATH(arguments).");
  parseProgramCall(upper(path), false);
}

/// MCALL NAME(arguments) calls after each motion; MCALL alone ends that.
void BlockParser::parseModalCall() {
  Command command;
  command.name = block_->add("MCALL");
  cursor_.skipBlanks();
  const std::size_t start = cursor_.offset();
  if (isNameStart(cursor_.peek())) {
    cursor_.name();
    command.text = upper(cursor_.since(start));
    cursor_.skipBlanks();
    if (cursor_.peek() == '(') command.words = parseArguments();
  }
  if (!failed_) block_->instructions.emplace_back(command);
}

/// Statements whose text is kept whole.
void BlockParser::parseRest(std::string_view name) {
  Command command;
  command.name = upper(name);
  command.text = restOfBlock();
  if (command.text.length == 0)
    return fail(cursor_.offset(), "behind " + std::string(name) + " the statement is missing");
  block_->instructions.emplace_back(command);
}

}  // namespace probewright::sinumerik

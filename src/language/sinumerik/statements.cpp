#include <iterator>

#include "language/sinumerik/block_parser.hpp"

namespace probewright::language::sinumerik {

using namespace language;

namespace {

JumpDirection directionOf(std::string_view name) {
  switch (name.size() > 4 ? name[4] : '\0') {
    case 'F':
      return JumpDirection::Forward;
    case 'B':
      return JumpDirection::Backward;
    case 'S':
      return JumpDirection::ProgramStart;
    default:
      return JumpDirection::ForwardThenBackward;
  }
}

bool isStructure(Keyword keyword) {
  switch (keyword) {
    case Keyword::Else:
    case Keyword::EndIf:
    case Keyword::For:
    case Keyword::EndFor:
    case Keyword::While:
    case Keyword::EndWhile:
    case Keyword::Loop:
    case Keyword::EndLoop:
    case Keyword::Repeat:
    case Keyword::RepeatBlock:
    case Keyword::Until:
    case Keyword::Case:
    case Keyword::Procedure:
    case Keyword::External:
    case Keyword::Declare:
    case Keyword::Define:
    case Keyword::SynchronizedAction:
      return true;
    default:
      return false;
  }
}

}  // namespace

/// True if nothing of the block has been read before.
bool BlockParser::isFirstStatement() const {
  return block_->instructions.empty() && after_.empty() && axisWords_.empty() && owner_ == Owner::Move &&
         !motionGiven_ && !feed_.present() && compensationName_.length == 0 && suppression_.length == 0;
}

/// A statement that begins with a name of two or more letters.
void BlockParser::parseNamed() {
  const std::size_t start = cursor_.offset();
  const std::string_view name = cursor_.name();
  const Keyword keyword = keywordOf(name);
  if (keyword == Keyword::None) return parseUserName(name, start);
  if (isStructure(keyword) && !isFirstStatement())
    return fail(start, std::string(name) + " must be in a block of its own", "Begin a new line with it.");
  parseKeyword(keyword, name, start);
}

void BlockParser::pushStructure(Structure kind, Operand condition) {
  Structured structured;
  structured.kind = kind;
  structured.condition = condition;
  block_->instructions.emplace_back(structured);
}

void BlockParser::parseKeyword(Keyword keyword, std::string_view name, std::size_t start) {
  switch (keyword) {
    case Keyword::If:
      return parseIf(start);
    case Keyword::Else:
      pushStructure(Structure::Else);
      return expectEnd("ELSE");
    case Keyword::EndIf:
      pushStructure(Structure::EndIf);
      return expectEnd("ENDIF");
    case Keyword::Case:
      return parseCase();
    case Keyword::For:
      return parseFor();
    case Keyword::EndFor:
      pushStructure(Structure::EndFor);
      return expectEnd("ENDFOR");
    case Keyword::While:
      pushStructure(Structure::While, parseExpression());
      return expectEnd("the condition");
    case Keyword::EndWhile:
      pushStructure(Structure::EndWhile);
      return expectEnd("ENDWHILE");
    case Keyword::Loop:
      pushStructure(Structure::Loop);
      return expectEnd("LOOP");
    case Keyword::EndLoop:
      pushStructure(Structure::EndLoop);
      return expectEnd("ENDLOOP");
    case Keyword::Repeat:
    case Keyword::RepeatBlock:
      return parseRepeat(name, start);
    case Keyword::Until:
      pushStructure(Structure::Until, parseExpression());
      return expectEnd("the condition");
    case Keyword::Goto:
      return parseJump(name, {});
    case Keyword::Define:
    case Keyword::Redefine:
    case Keyword::IsoCall:
    case Keyword::SynchronizedAction:
      return parseRest(name);
    case Keyword::Declare:
      return parseDeclaration(start);
    case Keyword::Procedure:
    case Keyword::External:
      return parseProcedure(name);
    case Keyword::Call:
    case Keyword::ExternalCall:
      return parseCall(start);
    case Keyword::PathCall:
      return parsePathCall(start);
    case Keyword::ModalCall:
      return parseModalCall();
    case Keyword::Return:
      return parseReturn(name);
    case Keyword::Transform:
      return setOwner(Owner::Transform, upper(name), start);
    case Keyword::Motion:
      setMotion(name == "CIP"  ? MoveKind::ArcThroughPoint
                : name == "CT" ? MoveKind::ArcTangential
                               : MoveKind::Modal,
                start);
      motionName_ = upper(name);
      if (motion_ == MoveKind::Modal && !failed_) block_->instructions.emplace_back(language::Modal{motionName_, {}});
      return;
    case Keyword::Suppress:
      suppression_ = upper(name);
      takeGroup(suppression_, start);
      return;
    case Keyword::MoveWord:
      return parseMoveWord(name, start);
    case Keyword::Setting:
      return parseSetting(name, start);
    case Keyword::Measure:
      return parseMeasure(name, start);
    case Keyword::Axial:
      return parseAxial(name, start);
    case Keyword::Modal:
    case Keyword::Statement:
      return parseStatement(keyword, name);
    case Keyword::Reserved:
    case Keyword::None:
      break;
  }
  fail(start, "no statement begins with " + std::string(name));
}

/// RET, ENDPROC, RET("TARGET",after,levels,start).
void BlockParser::parseReturn(std::string_view name) {
  language::Return order;
  cursor_.skipBlanks();
  if (cursor_.peek() == '(' && name == "RET") {
    const std::size_t start = cursor_.offset();
    const WordRange words = parseArguments();
    if (failed_) return;
    Operand* const places[] = {&order.target, &order.behind, &order.levels, &order.start};
    if (words.count > std::size(places))
      return fail(start, "RET has at most four arguments",
                  "Write RET(\"TARGET\",1,2): destination, 1 for the block after it, number of program levels.");
    for (std::uint32_t i = 0; i < words.count; ++i)
      *places[i] = block_->words[words.first + i].value;
    if (order.target.isLiteral())
      return fail(start, "the destination of RET is a text", "Write it in quotation marks: RET(\"LABEL\").");
  }
  after_.emplace_back(order);
}

void BlockParser::parseIf(std::size_t start) {
  const Operand condition = parseExpression();
  if (failed_) return;
  cursor_.skipBlanks();
  if (cursor_.atEnd()) {
    if (!isFirstStatement()) return fail(start, "IF with ELSE or ENDIF must be in a block of its own");
    return pushStructure(Structure::If, condition);
  }
  const std::size_t at = cursor_.offset();
  if (cursor_.peek() == '=')
    return fail(at, "the condition of IF ends at '='", "'=' assigns; a comparison is written '=='.");
  const std::string_view name = cursor_.peekName();
  if (keywordOf(name) != Keyword::Goto)
    return fail(at, "after the condition of IF only GOTOF, GOTOB, GOTO, GOTOC or GOTOS may follow",
                "Write the statement into the next block and close with ENDIF.");
  cursor_.advance(name.size());
  parseJump(name, condition);
}

/// The destination of a jump or a repetition: a label or a block number. Empty if none stands here.
TextRef BlockParser::parseTarget() {
  cursor_.skipBlanks();
  const std::size_t start = cursor_.offset();
  if ((cursor_.peek() == 'N' || cursor_.peek() == ':') && isDigit(cursor_.peek(1))) {
    cursor_.advance();
    cursor_.digits();
  } else if (isNameStart(cursor_.peek()) && isNameStart(cursor_.peek(1))) {
    // Programs have labels such as START, which is a statement too; words of the flow are not labels.
    const Keyword keyword = keywordOf(cursor_.peekName());
    const bool flow =
        isStructure(keyword) || keyword == Keyword::If || keyword == Keyword::Goto || keyword == Keyword::Reserved;
    if (!flow) cursor_.name();
  }
  return upper(cursor_.since(start));
}

void BlockParser::parseJump(std::string_view name, Operand condition) {
  Jump jump;
  jump.direction = directionOf(name);
  jump.ignoreMissing = name == "GOTOC";
  jump.condition = condition;
  if (jump.direction != JumpDirection::ProgramStart) {
    const Cursor before = cursor_;
    const std::size_t start = cursor_.offset();
    jump.label = parseTarget();
    cursor_.skipBlanks();
    const bool computed =
        jump.label.length == 0 || cursor_.peek() == '<' || cursor_.peek() == '[' || cursor_.peek() == '(';
    if (computed) {
      cursor_ = before;
      jump.label = {};
      cursor_.skipBlanks();
      if (cursor_.peek() != '"' && cursor_.peek() != '$' && !isNameStart(cursor_.peek()))
        return fail(start, std::string(name) + " needs a destination", "Write a label or a block number: GOTOF N100.");
      jump.labelValue = parseExpression();
    }
    if (cursor_.peek() == ':') cursor_.advance();  // GOTOF LABEL: is written now and then
  }
  if (!failed_) block_->instructions.emplace_back(jump);
}

void BlockParser::parseCase() {
  const Operand selector = parseExpression();
  if (failed_) return;
  cursor_.skipBlanks();
  if (cursor_.peekName() != "OF") return fail(cursor_.offset(), "OF expected after the selector of CASE");
  cursor_.advance(2);
  bool any = false;
  for (;;) {
    cursor_.skipBlanks();
    if (cursor_.atEnd()) break;
    Operand condition;
    const bool isDefault = cursor_.peekName() == "DEFAULT";
    if (isDefault) {
      cursor_.advance(7);
    } else {
      Node node;
      node.operation = Operation::Equal;
      node.left = selector;
      node.right = parseExpression();
      if (failed_) return;
      condition = add(node);
    }
    cursor_.skipBlanks();
    const std::string_view name = cursor_.peekName();
    if (keywordOf(name) != Keyword::Goto)
      return fail(cursor_.offset(), "each case is followed by GOTOF, GOTOB, GOTO or GOTOC with a destination");
    cursor_.advance(name.size());
    parseJump(name, condition);
    any = true;
    if (isDefault) break;
  }
  if (!any) return fail(cursor_.offset(), "CASE has no branch", "Write CASE expression OF 1 GOTOF LABEL ...");
  expectEnd("DEFAULT");
}

void BlockParser::parseFor() {
  Structured loop;
  loop.kind = Structure::For;
  loop.variable = parseVariable();
  if (failed_ || !expect('=', "after the variable of FOR")) return;
  loop.from = parseExpression();
  if (failed_) return;
  cursor_.skipBlanks();
  if (cursor_.peekName() != "TO") return fail(cursor_.offset(), "TO expected after the first value of FOR");
  cursor_.advance(2);
  loop.to = parseExpression();
  block_->instructions.emplace_back(loop);
  expectEnd("the last value of FOR");
}

/// REPEAT alone begins a loop that UNTIL ends; with labels it repeats a section of the program.
void BlockParser::parseRepeat(std::string_view name, std::size_t start) {
  const bool onlyBlock = name == "REPEATB";
  cursor_.skipBlanks();
  if (cursor_.atEnd()) {
    if (onlyBlock) return fail(start, "REPEATB needs the label of the block to repeat");
    return pushStructure(Structure::Repeat);
  }
  RepeatSection section;
  section.onlyBlock = onlyBlock;
  section.from = parseTarget();
  cursor_.skipBlanks();
  if (section.from.length == 0) return fail(cursor_.offset(), "the label of the section to repeat was expected");
  const bool counted = cursor_.peek() == 'P' && !isNameStart(cursor_.peek(1));
  if (!cursor_.atEnd() && !counted && !onlyBlock) section.to = parseTarget();
  cursor_.skipBlanks();
  if (cursor_.peek() == 'P' && !isNameStart(cursor_.peek(1))) {
    cursor_.advance();
    section.times = parseValue(nullptr);
  }
  if (failed_) return;
  block_->instructions.emplace_back(section);
  expectEnd("REPEAT");
}

/// A name that is not a keyword: a variable that is assigned to, a program or a cycle that is called.
void BlockParser::parseUserName(std::string_view name, std::size_t start) {
  cursor_.skipBlanks();
  const char next = cursor_.peek();
  if (next == '=' || next == '[') {
    cursor_.moveTo(start);
    return parseAssignment(start);
  }
  if (next == ':') return fail(start, "the label " + std::string(name) + " is not at the beginning of its block");
  if (!axisWords_.empty() || motionGiven_)
    return fail(start, "the call of " + std::string(name) + " is in a block with a motion",
                "Write the call into a block of its own, or check the spelling of " + std::string(name) + ".");
  parseProgramCall(upper(name), Meant::ProgramOrCycle);
}

void BlockParser::parseAssignment(std::size_t start) {
  cursor_.moveTo(start);
  Assign assign;
  assign.variable = parseVariable();
  if (failed_) return;
  cursor_.skipBlanks();
  if (cursor_.peek() != '=' || cursor_.peek(1) == '=')
    return fail(cursor_.offset(), "'=' expected after the variable",
                "Write NAME=value; comparisons are written after IF, WHILE or UNTIL.");
  cursor_.advance();
  cursor_.skipBlanks();
  const std::string_view name = cursor_.peekName();
  if (name == "SET" || name == "REP" || name == "CALCDAT") return parseFill(assign.variable);
  assign.value = parseExpression();
  if (!failed_) block_->instructions.emplace_back(assign);
}

/// FINEA[X], IPOBRKA[X]=50, also FINEA=X: how an axis ends its block.
void BlockParser::parseAxial(std::string_view name, std::size_t start) {
  Word axis, value;
  value.address = 1;
  if (cursor_.take('[')) {
    axis.value = parseExpression();
    if (failed_ || !expect(']', "after the axis")) return;
    if (cursor_.take('=')) value.value = parseExpression();
  } else if (cursor_.take('(')) {
    axis.value = parseExpression();
    if (!failed_ && cursor_.take(',')) value.value = parseExpression();
    if (!failed_) expect(')', "after the axis");
  } else if (cursor_.take('=')) {
    axis.value = parseExpression();
  } else {
    return fail(start, std::string(name) + " needs an axis", "Write " + std::string(name) + "[X].");
  }
  if (failed_) return;
  const auto first = static_cast<std::uint32_t>(block_->words.size());
  block_->words.push_back(axis);
  if (value.value.present()) block_->words.push_back(value);
  block_->instructions.emplace_back(
      Command{upper(name), {}, -1, {first, static_cast<std::uint32_t>(block_->words.size()) - first}});
}

/// SET(...) and REP(...) fill arrays; CALCDAT(...) leaves its result in one of its arguments.
void BlockParser::parseFill(std::uint32_t variable) {
  const std::string_view name = cursor_.name();
  cursor_.skipBlanks();
  if (cursor_.peek() != '(') return fail(cursor_.offset(), "'(' expected after " + std::string(name));
  const WordRange words = parseArguments();
  if (!failed_) block_->instructions.emplace_back(Command{upper(name), {}, static_cast<std::int32_t>(variable), words});
}

/// DIAMONA[X], DIAMOFA[X], DIAM90A[X], DIACYCOFA[X]: as the function of the channel; what they say of other axes, and
/// DIAMCHANA (as the channel), changes nothing.
void BlockParser::parseAxialDiameter(std::string_view name) {
  if (!expect('[', "after an axial function for diameters")) return;
  const Operand axis = parseExpression();
  if (failed_ || !expect(']', "after the axis")) return;
  const Node* node = axis.node >= 0 ? &block_->nodes[static_cast<std::size_t>(axis.node)] : nullptr;
  if (node == nullptr || node->operation != Operation::AxisName || block_->at(node->text) != "X") return;
  std::string_view whole = name == "DIACYCOFA" ? "DIAMCYCOF" : name.substr(0, name.size() - 1);
  if (whole != "DIAMCHAN") block_->instructions.emplace_back(Modal{block_->add(whole), {}});
}

/// NAME or NAME(arguments).
void BlockParser::parseStatement(Keyword keyword, std::string_view name) {
  if (name.starts_with("DIA") && name.ends_with("A")) return parseAxialDiameter(name);
  Command command;
  command.name = upper(name);
  if (keyword == Keyword::Modal && !takeGroup(command.name, static_cast<std::size_t>(name.data() - upper_.data())))
    return;
  cursor_.skipBlanks();
  if (cursor_.peek() == '(') {
    command.words = parseArguments();
  } else if (cursor_.peek() == '=') {
    return fail(cursor_.offset(), std::string(name) + " is a word of the language and cannot be assigned to",
                "Choose another name for the variable.");
  } else if (name == "SETAL") {
    return fail(cursor_.offset(), "SETAL needs the number of the alarm", "Write SETAL(65000).");
  }
  if (failed_) return;
  if (keyword == Keyword::Modal) {
    block_->instructions.emplace_back(Modal{command.name, command.words});
  } else {
    block_->instructions.emplace_back(command);
  }
}

}  // namespace probewright::language::sinumerik

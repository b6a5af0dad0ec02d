#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "language/sinumerik/block_parser.hpp"
#include "language/sinumerik/block_words.hpp"

namespace probewright::language::sinumerik {

using namespace language;

namespace {

constexpr const char* addressAdvice = "An address is a letter with a value (X10), or written with '=' (X=R1, X1=10).";

/// G functions whose words do not belong to a motion of group 1.
bool isTransformG(int number) { return (number >= 110 && number <= 112) || number == 58 || number == 59; }
/// The number after the letter: 12 of "S12".
double extensionOf(std::uint32_t address) {
  double number = 0;
  for (std::uint32_t digits = address >> 8; digits != 0; digits >>= 8)
    number = number * 10 + ((digits & 0xff) - '0');
  return number;
}

/// G functions of Fanuc controls that the language of the SINUMERIK does not have.
bool isOfIsoDialect(int number) {
  const auto within = [number](int first, int last) { return number >= first && number <= last; };
  return within(20, 24) || within(27, 32) || within(43, 44) || within(49, 52) || within(65, 69) || within(72, 73) ||
         within(76, 89) || within(98, 99);
}

bool isCommandG(int number) { return number == 4 || number == 74 || number == 75; }

}  // namespace

/// A statement that begins with one letter: an address with its value.
void BlockParser::parseAddress() {
  const std::size_t start = cursor_.offset();
  const char letter = cursor_.peek();
  if (letter == 'R') {
    Cursor ahead = cursor_;
    ahead.advance();
    ahead.digits();
    ahead.skipBlanks();
    if (ahead.peek() == '=' || ahead.peek() == '[') return parseAssignment(start);
    return fail(start, "an R parameter needs a value here", "Write R1=value.");
  }
  cursor_.advance();
  switch (letter) {
    case 'G':
      return parseG(start);
    case 'M':
      return parseM(start);
    case 'T':
      return parseT(start);
    case 'L':
      return parseL(start);
    case 'F': {
      Cursor ahead = cursor_;
      ahead.digits();
      ahead.skipBlanks();
      if (isDigit(cursor_.peek()) && ahead.peek() == '=') {  // F2= to F7=: feeds that inputs switch to
        cursor_ = ahead;
        parseValue(nullptr);
        return;
      }
      feedColumn_ = static_cast<std::uint32_t>(start) + 1;
      if (feed_.present()) return fail(start, "the feed F appears twice in this block");
      if (beginsFeedFunction({"FPO"})) {  // the feed at the block's end, and how it gets there
        feed_ = parseExpression();
        for (int i = 0; i < 2 && !failed_ && cursor_.take(','); ++i)
          parseExpression();
        if (!failed_) expect(')', "after the feed and its two coefficients");
        return;
      }
      feed_ = parseValue(nullptr);
      return;
    }
    case 'S':
    case 'D':
    case 'H':
      return parseModalAddress(letter, start);
    case 'P': {
      auto* call = block_->instructions.empty() ? nullptr : std::get_if<CallProgram>(&block_->instructions.back());
      if (call == nullptr)
        return fail(start, "P counts how often a subprogram is called, but there is no call before it",
                    "Write the call first: L100 P3.");
      call->times = parseValue(nullptr);
      return;
    }
    case 'N':
      return fail(start, "a block number is only allowed at the beginning of a block", "Begin a new line with N.");
    case '_':
      return fail(start, "a name begins with two letters or underscores");
    default: {
      std::uint32_t address = static_cast<unsigned char>(letter);
      if (!parseExtension(address)) return;
      parseAxisWord(address, start);
    }
  }
}

/// Reads the digits of an extended address such as X1= or S2= and adds them to `address`; nothing if the digits are
/// the value.
bool BlockParser::parseExtension(std::uint32_t& address) {
  if (!isDigit(cursor_.peek())) return true;
  Cursor ahead = cursor_;
  const std::string_view digits = ahead.digits();
  const Cursor afterDigits = ahead;
  ahead.skipBlanks();
  if (ahead.peek() != '=' || ahead.peek(1) == '=') return true;
  if (digits.size() > 3) {
    fail(cursor_.offset(), "the number of this address has more than three digits", addressAdvice);
    return false;
  }
  for (std::size_t i = 0; i < digits.size(); ++i)
    address |= static_cast<std::uint32_t>(static_cast<unsigned char>(digits[i])) << (8 * (i + 1));
  cursor_ = afterDigits;
  return true;
}

/// The same for S[SPINU]=: `index` is the extension where only the run knows it, and absent otherwise.
bool BlockParser::parseExtension(std::uint32_t& address, Operand& index) {
  if (cursor_.peek() != '[') return parseExtension(address);
  const std::size_t start = cursor_.offset();
  cursor_.advance();
  index = parseExpression();
  if (failed_ || !expect(']', "after the extension of the address")) return false;
  cursor_.skipBlanks();
  if (cursor_.peek() != '=') {
    fail(cursor_.offset(), "'=' expected after the extension of the address", "Write S[1]=500.");
    return false;
  }
  if (!index.isLiteral()) return true;
  if (!(index.number >= 0 && index.number <= 999) || index.number != std::floor(index.number)) {
    fail(start, "the extension of an address is a whole number from 0 to 999", addressAdvice);
    return false;
  }
  const std::string digits = fmt::format("{}", index.number);
  for (std::size_t i = 0; i < digits.size(); ++i)
    address |= static_cast<std::uint32_t>(static_cast<unsigned char>(digits[i])) << (8 * (i + 1));
  index = {};
  return true;
}

/// A number without a sign. True with a complaint if it is too large, or written as other languages write it.
bool BlockParser::takeNumber(double& value) {
  const std::size_t start = cursor_.offset();
  if (!cursor_.number(value)) return false;
  if (std::isinf(value)) {
    fail(start, "this number is too large to compute with", "Numbers reach up to 1.7EX308.");
  } else if (cursor_.peek() == 'E') {
    Cursor ahead = cursor_;
    ahead.advance();
    const bool sign = ahead.peek() == '-' || ahead.peek() == '+';
    if (sign) ahead.advance();
    const std::string_view digits = ahead.digits();
    ahead.skipBlanks();
    if (!digits.empty() && ahead.peek() != '=')
      fail(start, "this number has an exponent as other languages write it",
           fmt::format("Write EX before the exponent: {}EX{}{}.", cursor_.since(start),
                       sign ? std::string(1, cursor_.peek(1)) : "", digits));
  }
  return true;
}

/// The value written directly after an address letter. False if there is none.
bool BlockParser::parseShortValue(double& value) {
  const char sign = cursor_.peek();
  if (sign == '-' || sign == '+') {
    cursor_.advance();
    cursor_.skipBlanks();
  }
  if (!takeNumber(value)) return false;
  if (sign == '-') value = -value;
  return true;
}

/// The value of an address: digits directly after it, or '=' and an expression. `mode` null: no AC, IC, DC.
Operand BlockParser::parseValue(WordMode* mode) {
  cursor_.skipBlanks();
  if (cursor_.peek() != '=') {
    double value = 0;
    if (parseShortValue(value)) return Operand::of(value);
    fail(cursor_.offset(), "the value of the address is missing", addressAdvice);
    return {};
  }
  cursor_.advance();
  cursor_.skipBlanks();
  const char c = cursor_.peek();
  if (mode != nullptr && (c == 'A' || c == 'I' || c == 'D')) {
    const std::string_view name = cursor_.peekName();
    bool known = true;
    if (name == "AC")
      *mode = WordMode::Absolute;
    else if (name == "IC")
      *mode = WordMode::Incremental;
    else if (name == "DC")
      *mode = WordMode::DirectShortest;
    else if (name == "ACP")
      *mode = WordMode::DirectPositive;
    else if (name == "ACN")
      *mode = WordMode::DirectNegative;
    else
      known = false;
    if (known) {
      cursor_.advance(name.size());
      if (!expect('(', "after AC, IC, DC, ACP or ACN")) return {};
      const Operand value = parseExpression();
      expect(')', "after the value");
      return value;
    }
  }
  return parseExpression();
}

void BlockParser::addMoveWord(std::uint32_t address, std::size_t start) {
  Word word;
  word.address = address;
  word.column = static_cast<std::uint32_t>(start) + 1;
  if (!parseDimensionedValue(word)) word.value = parseValue(&word.mode);
  axisWords_.push_back(word);
}

/// Goes behind "=NAME(" if the name is one of `names`.
bool BlockParser::beginsFeedFunction(std::initializer_list<std::string_view> names) {
  Cursor ahead = cursor_;
  if (!ahead.take('=')) return false;
  ahead.skipBlanks();
  const std::string_view name = ahead.peekName();
  if (std::ranges::find(names, name) == names.end()) return false;
  ahead.advance(name.size());
  if (!ahead.take('(')) return false;
  cursor_ = ahead;
  return true;
}

/// X=DAC(value), DIC, RAC, RIC: a diameter or a radius, whatever DIAMON says. The run computes what to add or take off.
bool BlockParser::parseDimensionedValue(Word& word) {
  Cursor ahead = cursor_;
  if (!ahead.take('=')) return false;
  ahead.skipBlanks();
  const std::string_view name = ahead.peekName();
  if (!isDimensionFunction(name)) return false;
  ahead.advance(name.size());
  cursor_ = ahead;
  word.mode = name[1] == 'A' ? WordMode::Absolute : WordMode::Incremental;
  if (!expect('(', "after DAC, DIC, RAC or RIC")) return true;
  const Operand value = parseExpression();
  if (failed_ || !expect(')', "after the value")) return true;
  word.value = value;
  if (word.address != addressOf("X")) return true;
  Node node;
  node.operation = Operation::Call;
  node.function = Function::Host;
  node.text = block_->add(name);
  node.a = static_cast<std::uint32_t>(block_->operands.size());
  node.b = 1;
  block_->operands.push_back(value);
  block_->nodes.push_back(node);
  word.value = {0, static_cast<std::int32_t>(block_->nodes.size() - 1)};
  return true;
}

void BlockParser::parseAxisWord(std::uint32_t address, std::size_t start) {
  cursor_.skipBlanks();
  const char c = cursor_.peek();
  if (c != '=' && c != '-' && c != '+' && c != '.' && !isDigit(c)) {
    const std::string name = addressName(address);
    return fail(start, "the address " + name + " has no value", addressAdvice);
  }
  addMoveWord(address, start);
}

void BlockParser::parseModalAddress(char letter, std::size_t start) {
  std::uint32_t address = static_cast<unsigned char>(letter);
  Word word, extension;
  if (!parseExtension(address, extension.value)) return;
  if (letter != 'H' && !extension.value.present() && !takeOnce("the address " + addressName(address), start)) return;
  word.address = address;
  word.column = static_cast<std::uint32_t>(start) + 1;
  word.value = parseValue(nullptr);
  if (failed_) return;
  if (owner_ != Owner::Move && owner_ != Owner::Transform && letter == 'S') {  // G4 S, G25 S: no speed of the spindle
    axisWords_.push_back(word);
    return;
  }
  const auto first = static_cast<std::uint32_t>(block_->words.size());
  block_->words.push_back(word);
  extension.address = 1;
  if (extension.value.present()) block_->words.push_back(extension);
  block_->instructions.emplace_back(
      Modal{upper(start, 1), {first, static_cast<std::uint32_t>(block_->words.size()) - first}});
}

void BlockParser::setMotion(MoveKind kind, std::size_t start) {
  if (motionGiven_) return fail(start, "this block has two motions (G functions of group 1)", "Remove one of them.");
  motionGiven_ = true;
  motion_ = kind;
}

void BlockParser::setOwner(Owner owner, TextRef name, std::size_t start) {
  if (owner_ != Owner::Move) {
    return fail(start,
                std::string(block_->at(name)) + " cannot be in one block with " + std::string(block_->at(ownerName_)),
                "Write each into a block of its own.");
  }
  owner_ = owner;
  ownerName_ = name;
}

/// False with a complaint if the block has a function of the same group already.
bool BlockParser::takeGroup(TextRef name, std::size_t start) {
  const std::optional<int> group = groupOf(block_->at(name));
  if (!group) return true;
  const std::uint64_t bit = std::uint64_t{1} << *group;
  if ((groups_ & bit) == 0) {
    groups_ |= bit;
    return true;
  }
  fail(start, fmt::format("{} is the second G function of group {} in this block", block_->at(name), *group),
       "Keep one of the two: the control refuses the block with alarm 12060.");
  return false;
}

void BlockParser::parseG(std::size_t start) {
  cursor_.skipBlanks();
  if (cursor_.peek() == '[') return parseSetting(cursor_.since(start).substr(0, 1), start);
  const std::size_t numberStart = cursor_.offset();
  const std::string_view digits = cursor_.digits();
  int number = 0;
  for (const char c : digits)
    number = number < 100000 ? number * 10 + (c - '0') : number;
  if (digits.empty()) return fail(start, "the number of the G function is missing");
  if (!isGFunction(number))
    return fail(start, "the control has no function G" + std::string(digits),
                isOfIsoDialect(number)
                    ? "It belongs to the ISO dialect and to RS-274 (Fanuc, LinuxCNC), which are not read; "
                      "write the program in the language of the control, inches and mm as G70 and G71."
                    : "");
  const bool plain = numberStart == start + 1 && (digits.size() == 1 || digits[0] != '0');
  const TextRef name = plain ? upper(start, digits.size() + 1) : block_->add(fmt::format("G{}", number));
  if (!takeGroup(name, start)) return;
  switch (number) {
    case 0:
      setMotion(MoveKind::Rapid, start);
      motionName_ = name;
      return;
    case 1:
      setMotion(MoveKind::Linear, start);
      motionName_ = name;
      return;
    case 2:
      setMotion(MoveKind::ArcClockwise, start);
      motionName_ = name;
      return;
    case 3:
      setMotion(MoveKind::ArcCounterclockwise, start);
      motionName_ = name;
      return;
    case 33:
    case 34:
    case 35:
    case 63:
    case 331:
    case 332:
    case 335:
    case 336:
      setMotion(MoveKind::Modal, start);
      motionName_ = name;
      break;
    case 40:
    case 41:
    case 42:
      compensation_ = number == 40   ? RadiusCompensation::Off
                      : number == 41 ? RadiusCompensation::Left
                                     : RadiusCompensation::Right;
      compensationName_ = name;
      return;
    case 53:
    case 153:
      suppression_ = name;
      return;
    default:
      if (isTransformG(number)) return setOwner(Owner::Transform, name, start);
      if (isCommandG(number)) return setOwner(Owner::Command, name, start);
      if (number == 25 || number == 26) return setOwner(Owner::Modal, name, start);
  }
  if (!failed_) block_->instructions.emplace_back(Modal{name, {}});
}

void BlockParser::parseM(std::size_t start) {
  constexpr double highest = 999999999;
  const auto isNumber = [&](const Operand& value) {
    return value.isLiteral() && value.number >= 0 && value.number <= highest;
  };
  std::uint32_t address = 'M';
  Operand spindle;
  if (!parseExtension(address, spindle)) return;
  cursor_.skipBlanks();
  MachineFunction function;
  if (address != 'M') spindle = Operand::of(extensionOf(address));
  if (spindle.present()) {
    const Operand value = parseValue(nullptr);
    if (failed_) return;
    if (isNumber(value)) {
      function.number = static_cast<int>(value.number);
      function.argument = spindle;
    } else if (value.isLiteral()) {
      return fail(start, "the number of an M function is 0 or more");
    } else {
      function.number = -1;
      function.argument = value;
      function.words = {static_cast<std::uint32_t>(block_->words.size()), 1};
      block_->words.push_back({1, WordMode::Plain, spindle, static_cast<std::uint32_t>(start) + 1, 0});
    }
  } else if (cursor_.peek() == '=') {
    const Operand value = parseValue(nullptr);
    if (failed_) return;
    if (value.isLiteral()) {
      if (!isNumber(value)) return fail(start, "the number of an M function is 0 or more");
      function.number = static_cast<int>(value.number);
    } else {
      function.number = -1;
      function.argument = value;
    }
  } else {
    const std::string_view digits = cursor_.digits();
    if (digits.empty() || digits.size() > 9) return fail(start, "the number of the M function is missing");
    for (const char c : digits)
      function.number = function.number * 10 + (c - '0');
  }
  const bool plain = !function.argument.present();
  if (const int number = function.number; number == 3 || number == 4 || number == 5 || number == 19 || number == 70) {
    const bool known = plain || function.argument.isLiteral();
    std::string turns =
        plain ? "an M function of the spindle" : fmt::format("an M function of spindle {}", function.argument.number);
    if (known && !takeOnce(std::move(turns), start, "14760")) return;
  }
  switch (plain ? function.number : -1) {
    case 0:
    case 1:
      after_.emplace_back(Stop{function.number == 1, {}});
      return;
    case 2:
    case 30:
      after_.emplace_back(EndProgram{});
      return;
    case 17:
      after_.emplace_back(Return{});
      return;
    default:
      block_->instructions.emplace_back(function);
  }
}

void BlockParser::parseT(std::size_t start) {
  std::uint32_t address = 'T';
  ToolCall call;
  if (!parseExtension(address, call.index)) return;
  if (!call.index.present() && !takeOnce("the address " + addressName(address), start)) return;
  cursor_.skipBlanks();
  const bool assigned = cursor_.peek() == '=';
  Operand value = parseValue(nullptr);
  if (failed_) return;
  if (!value.isLiteral() && !assigned)
    return fail(start, "the number of the tool is missing", "Write T5 or T=\"NAME\".");
  if (value.isLiteral() && value.number < 0)
    return fail(start, "the number of a tool is 0 or more", "Write T5 or T=\"NAME\".");
  const bool text = !value.isLiteral() && value.present() &&
                    (block_->nodes[static_cast<std::size_t>(value.node)].operation == Operation::Text ||
                     block_->nodes[static_cast<std::size_t>(value.node)].operation == Operation::Concatenate);
  (text ? call.name : call.number) = value;
  if (address != 'T') call.index = Operand::of(extensionOf(address));
  block_->instructions.emplace_back(call);
}

void BlockParser::parseL(std::size_t start) {
  const std::string_view digits = cursor_.digits();
  if (digits.empty()) return fail(start, "the number of the subprogram is missing", "Write L100.");
  parseProgramCall(upper(start, digits.size() + 1), Meant::Program);
}

}  // namespace probewright::language::sinumerik

#include <algorithm>

#include "language/klartext/parser.hpp"

#include <fmt/format.h>

#include <utility>

/// M functions: alone or at the end of a block, with the words that some of them take.
namespace probewright::language::klartext {

namespace {

/// True for functions that act when the block's motion has ended.
bool actsAtEnd(int number) {
  switch (number) {
    case 0:
    case 1:
    case 2:
    case 5:
    case 6:
    case 9:
    case 30:
    case 89:
    case 97:
    case 98:
    case 99:
      return true;
    default:
      return false;
  }
}

/// The way that an M function turns the spindle: 1 clockwise, -1 the other way, 0 if it is about something else.
int turnOfSpindle(int number) {
  if (number == 3 || number == 13) return 1;
  return number == 4 || number == 14 ? -1 : 0;
}

bool takesAxes(int number) { return number == 94 || number == 116 || number == 118 || number == 138; }

bool takesFeed(int number) { return number == 103 || number == 128 || number == 140; }

}  // namespace

bool BlockParser::machineFunction(Move* move) {
  const std::size_t start = lexer_.offset();
  lexer_.advance();
  const std::optional<double> written = lexer_.number();
  if (!written || *written > 9999) return error("a number from 0 to 9999 is expected after M");
  const int number = static_cast<int>(*written);
  if (move != nullptr && (number == 91 || number == 92)) {
    (number == 91 ? move->machineCoordinates : move->machineReference2) = true;
    if (!move->machineCoordinates || !move->machineReference2) return true;
    return contradicts(start, 91, 92);
  }
  for (std::size_t i = 0; i < pendingCount_; ++i) {
    const int other = pending_[i].function.number;
    const bool turnsBack = turnOfSpindle(other) * turnOfSpindle(number) < 0;
    const bool otherFeed = (other == 109 && number == 110) || (other == 110 && number == 109);
    if (turnsBack || otherFeed) return contradicts(start, other, number);
  }
  if (pendingCount_ == pending_.size()) return error("there are too many M functions in this block");
  MachineFunction function;
  function.number = number;
  const std::size_t first = block_.words.size();
  if (number == 140 || number == 120 || number == 124) {
    const std::string_view keyword = number == 140 ? "MB" : number == 120 ? "LA" : "T";
    if (lexer_.acceptPrefix(keyword)) {
      if (number == 140 && lexer_.acceptKeyword("MAX")) {
        addWord(addressOf("MB"), {});
      } else if (!word(addressOf(keyword), keyword)) {
        return false;
      }
    } else if (number == 140) {
      return error("MB with the retraction distance is expected after M140", "write M140 MB MAX or M140 MB50");
    }
  }
  while (takesAxes(number)) {
    const bool incremental = lexer_.peek() == 'I';
    const char letter = upper(incremental ? lexer_.here(1) : lexer_.peek());
    if (std::string_view("XYZABCUVW").find(letter) == std::string_view::npos || letter == '\0') break;
    const std::uint32_t column = lexer_.column();
    const std::size_t begin = lexer_.offset();
    lexer_.advance(incremental ? 2 : 1);
    const char next = lexer_.peek();
    const bool valued = next == '+' || next == '-' || isDigit(next) || next == '.' || next == 'Q';
    if (valued && number != 118) {  // the others name axes: this is where the block moves to
      lexer_.seek(begin);
      break;
    }
    if (!valued) {
      addWord(addressOf({&letter, 1}), {});
      block_.words.back().column = column;
    } else if (!word(addressOf({&letter, 1}), {&letter, 1})) {
      return false;
    }
  }
  if (takesFeed(number) && lexer_.peek() == 'F') {
    bool rapid = false;
    bool automatic = false;
    if (!feedWord(function.argument, &rapid, &automatic)) return false;
    if (rapid && move != nullptr) move->rapid = true;
  }
  function.words = wordsSince(first);
  pending_[pendingCount_++] = {function, actsAtEnd(number)};
  return true;
}

/// Two M functions that act at the same time and exclude each other; the second one stands at `start`.
bool BlockParser::contradicts(std::size_t start, int first, int second) {
  lexer_.seek(start);
  return error(fmt::format("M{} and M{} exclude each other in one block", first, second),
               "remove one of the two, or write it in a block of its own");
}

bool BlockParser::machineFunctionBlock() {
  Move feedOnly;
  bool hasFeed = false;
  while (!lexer_.atEnd()) {
    if (lexer_.peek() == 'M') {
      if (!machineFunction(nullptr)) return false;
    } else if (lexer_.peek() == 'F') {
      if (std::exchange(hasFeed, true)) return error("the feed is given twice in this block", "remove one of the two");
      const std::size_t before = block_.words.size();
      if (!feedWord(feedOnly.feed, &feedOnly.rapid, &feedOnly.autoFeed)) return false;
      if (block_.words.size() > before) feedOnly.words = wordsSince(before);  // FU, FZ
    } else {
      return expectEnd();
    }
  }
  if (hasFeed) {
    const Instruction instruction = feedOnly;
    emitWithMachineFunctions(&instruction);
  } else {
    emitWithMachineFunctions(nullptr);
  }
  return true;
}

void BlockParser::emitWithMachineFunctions(const Instruction* instruction) {
  const auto isStop = [](const Instruction& each) {
    const auto* stop = std::get_if<Stop>(&each);
    return stop != nullptr && !stop->optional;
  };
  // STOP M0 stops once.
  const bool stops =
      (instruction != nullptr && isStop(*instruction)) || std::ranges::any_of(block_.instructions, isStop);
  const auto emitFunction = [&](const MachineFunction& function) {
    switch (function.number) {
      case 0:
        if (!stops) emit(Stop{});
        break;
      case 1:
        if (!stops) emit(Stop{.optional = true});
        break;
      case 2:
      case 30:
        emit(EndProgram{});
        break;
      case 99:
        emit(Command{constant(nameOf(CommandKind::CycleCall)), {}, -1, {}});
        break;
      default:
        emit(function);
        break;
    }
  };
  for (std::size_t i = 0; i < pendingCount_; ++i) {
    if (!pending_[i].atEnd) emitFunction(pending_[i].function);
  }
  if (instruction != nullptr) block_.instructions.push_back(*instruction);
  for (std::size_t i = 0; i < pendingCount_; ++i) {
    if (pending_[i].atEnd) emitFunction(pending_[i].function);
  }
  pendingCount_ = 0;
}

}  // namespace probewright::language::klartext

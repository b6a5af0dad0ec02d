#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "language/din_iso/parser.hpp"
#include "language/din_iso/path_words.hpp"

/// Blocks of words: G functions, coordinates, F, S, T and M. The words are gathered first, for G functions may stand
/// anywhere in the block.
namespace probewright::language::din_iso {

namespace {

constexpr std::string_view axisLetters = "XYZABCUVW";

/// G functions that decide what a block does.
bool isFunction(int number) {
  static constexpr std::array<int, 24> functions = {4,  24, 25, 26, 27, 28, 29, 30, 31, 36, 38, 39,
                                                    51, 53, 54, 55, 62, 72, 73, 79, 80, 98, 99, 247};
  return std::ranges::find(functions, number) != functions.end() || oldMachiningCycle(number) != 0;
}

}  // namespace

bool BlockParser::words() {
  for (char c = lexer_.peek(); c != '\0'; c = lexer_.peek()) {
    if (!wordOf(c)) return false;
    if (function_ == 98 || function_ >= 200) return true;  // the rest of the block was theirs
  }
  return emitWords();
}

bool BlockParser::wordOf(char address) {
  switch (address) {
    case 'G':
      return preparatory();
    case 'I':
    case 'J':
    case 'K': {
      if (centreCount_ == centre_.size()) return error("there are too many coordinates of a centre in this block");
      lexer_.advance();
      Word& added = centre_[centreCount_];
      added = {};
      added.address = static_cast<std::uint32_t>(address == 'I' ? 'X' : address == 'J' ? 'Y' : 'Z');
      added.mode = mode_;
      added.column = lexer_.column() - 1;
      const std::optional<Operand> found = value({&address, 1});
      if (!found) return false;
      added.value = *found;
      for (std::size_t i = 0; i < centreCount_; ++i) {
        if (centre_[i].address == added.address)
          return errorAt(added, fmt::format("{} is given twice in this block", address), "remove one of the two");
      }
      ++centreCount_;
      return true;
    }
    case 'R':
    case 'H':
      return coordinate(address, address == 'R' ? "the radius R" : "the angle H");
    case 'F': {
      if (std::exchange(feedGiven_, true))
        return error("the feed is given twice in this block", "remove one of the two");
      bool rapid = false;
      const std::size_t first = block_.words.size();
      if (!feedWord(move_.feed, &rapid, &move_.autoFeed)) return false;
      if (rapid) move_.rapid = true;
      for (std::size_t i = first; i < block_.words.size() && coordinateCount_ < mostWords; ++i)
        coordinates_[coordinateCount_++] = block_.words[i];
      block_.words.resize(first);
      return true;
    }
    case 'S':
      return spindleOrClearance();
    case 'T':
      return toolWordOrTolerance();
    case 'D':
      return toolWord(tool_);
    case 'L': {
      lexer_.advance();
      return valueOnce(length_, "the tool length L");
    }
    case 'P':
      return parameterWord();
    case 'M':
      return machineFunction(&move_);
    default:
      break;
  }
  if (axisLetters.find(address) != std::string_view::npos && !isLetter(upper(lexer_.here(1)))) {
    return coordinate(address, {&address, 1});
  }
  if (axisLetters.find(address) != std::string_view::npos && upper(lexer_.here(1)) == 'Q') {
    return coordinate(address, {&address, 1});
  }
  return error("this is not a word of the DIN/ISO language",
               "begin the block with G, an axis, I, J, K, T, S, F, M, L, D or Q; begin comments with ';' and end the "
               "block with '*'");
}

bool BlockParser::preparatory() {
  const std::size_t start = lexer_.offset();
  lexer_.advance();
  if (!isDigit(lexer_.here())) return error("the number of a G function is expected after G");
  int number = 0;
  for (; isDigit(lexer_.here()) && number <= 9999; lexer_.advance())
    number = number * 10 + (lexer_.here() - '0');
  if (number == 90 || number == 91) {
    mode_ = number == 90 ? WordMode::Absolute : WordMode::Incremental;
    emit(Modal{constant(fmt::format("G{}", number)), {}});
    return true;
  }
  if (isPath(number)) {
    if (motion_) {
      lexer_.seek(start);
      return error("a block has one path function only", "write the other one in a block of its own");
    }
    motion_ = true;
    path_ = number;
    emit(Modal{constant(fmt::format("G{}", number)), {}});
    return true;
  }
  const auto once = [&](int& group, std::string_view what) {
    const int other = std::exchange(group, number);
    if (other < 0) return true;
    lexer_.seek(start);
    return error(fmt::format("G{} and G{} are two {} in one block", other, number, what), "remove one of the two");
  };
  if (number >= 17 && number <= 19 && !once(axisFunction_, "tool axes")) return false;
  if (number >= 40 && number <= 44 && !once(compensationFunction_, "radius compensations")) return false;
  switch (number) {
    case 17:
    case 18:
    case 19:
      axis_ = number == 17 ? 'Z' : number == 18 ? 'Y' : 'X';
      return true;
    case 40:
      move_.compensation = RadiusCompensation::Off;
      return true;
    case 41:
      move_.compensation = RadiusCompensation::Left;
      return true;
    case 42:
      move_.compensation = RadiusCompensation::Right;
      return true;
    case 43:
    case 44: {
      if (coordinateCount_ == mostWords) return error("there are too many words in this block");
      Word& added = coordinates_[coordinateCount_++];
      added = {};
      added.address = addressOf("R");
      added.mode = WordMode::DirectShortest;
      added.value = Operand::of(number == 43 ? 1 : -1);
      added.column = lexer_.column() - 3;
      return true;
    }
    case 70:
    case 71:
      if ((number == 70) == inch_) return true;
      lexer_.seek(start);
      return error(fmt::format("G{} changes the unit in the middle of the program", number),
                   fmt::format("the unit comes after the name of the program: %NAME G{}", number));
    case 50:  // protection of the program
      return true;
    default:
      break;
  }
  if (number >= 200 && number != 247 && !isFunction(number)) {
    function_ = number;
    return measuringOrMachining(number);
  }
  if (number == 20) {
    lexer_.seek(start);
    return error("the tool axis of G20 is not available", "choose the tool axis Z, Y or X with G17, G18 or G19");
  }
  if (!isFunction(number)) {
    lexer_.seek(start);
    return error(fmt::format("the function G{} is not available", number),
                 "take it out, or write what it does with other functions");
  }
  return takeFunction(number);
}

bool BlockParser::takeFunction(int number) {
  if (function_ >= 0) {
    return error(fmt::format("G{} and G{} cannot be in one block", function_, number),
                 "write a block for each of them");
  }
  function_ = number;
  if (number == 98) return nothingBefore() && labelDefinition();
  if (number == 247) return measuringOrMachining(number);
  if (number == 39) {
    parameterAddress(1);
    const std::optional<std::string_view> quoted = lexer_.quoted();
    name_ = quoted ? *quoted : lexer_.restOfLine();
    if (name_.empty()) return error("the name of a program is expected after G39 P01");
    if (!checkPath(name_)) return false;
  }
  return true;
}

bool BlockParser::coordinate(char address, std::string_view what) {
  if (coordinateCount_ == mostWords) return error("there are too many words in this block");
  Word added;
  added.address = static_cast<std::uint32_t>(static_cast<unsigned char>(address));
  added.mode = mode_;
  added.column = lexer_.column();
  lexer_.advance();
  if (function_ == 28) {  // G28 X Y: mirrored axes have no values
    const char next = lexer_.peek();
    if (next == '+' || next == '-' || isDigit(next)) return error("axes to be mirrored have no values");
  } else {
    const std::optional<Operand> found = value(what);
    if (!found) return false;
    added.value = *found;
  }
  if (find({&address, 1}) != nullptr && find({&address, 1})->mode != WordMode::DirectShortest) {
    return errorAt(added, fmt::format("{} is given twice in this block", address), "remove one of the two");
  }
  coordinates_[coordinateCount_++] = added;
  return true;
}

/// P01 to P99 with a value, of functions that number their parameters.
bool BlockParser::parameterWord() {
  if (!isDigit(lexer_.here(1)) || !isDigit(lexer_.here(2))) {
    return error("P with two digits is expected here: P01, P02...");
  }
  const int number = (lexer_.here(1) - '0') * 10 + (lexer_.here(2) - '0');
  const std::uint32_t column = lexer_.column();
  lexer_.advance(3);
  if (function_ == 55 && number <= 2) return referencePlaneWord(number);
  if (parameterCount_ == parameters_.size()) return error("there are too many parameters P in this block");
  Word added;
  added.address = static_cast<std::uint32_t>(number);
  added.column = column;
  if (const char axis = lexer_.peek(); oldMachiningCycle(function_) != 0 && axis >= 'X' && axis <= 'Z') {
    lexer_.advance();
    added.address |= static_cast<std::uint32_t>(axis) << 8;
  }
  const std::optional<Operand> found = value(fmt::format("the parameter P{:02}", number));
  if (!found) return false;
  added.value = *found;
  if (parameter(added.address) != nullptr)
    return errorAt(added, fmt::format("P{:02} is given twice in this block", number), "remove one of the two");
  parameters_[parameterCount_++] = added;
  return true;
}

/// G55 P01 is the number of the parameter for the result, P02 the probing axis with its direction.
bool BlockParser::referencePlaneWord(int parameter) {
  if (parameter == 1) {
    if (variableFollows()) {
      parameters_[0].value = variable()->index[0];
    } else {
      const std::optional<double> number = lexer_.number();
      if (!number) return error("the number of the parameter for the result is expected after P01");
      parameters_[0].value = Operand::of(*number);
    }
    parameters_[0].address = 1;
    parameterCount_ = std::max<std::size_t>(parameterCount_, 1);
    return true;
  }
  probingAxis_ = lexer_.peek();
  if (probingAxis_ == '\0' || axisLetters.find(probingAxis_) == std::string_view::npos) {
    probingAxis_ = 0;
    return error("the probing axis is expected after P02");
  }
  lexer_.advance();
  const char sign = lexer_.peek();
  if (sign != '+' && sign != '-') return error("the probing direction + or - is expected after the axis");
  lexer_.advance();
  probingPositive_ = sign == '+';
  return true;
}

bool BlockParser::spindleOrClearance() {
  if (function_ != 80 && function_ != 36) return toolWord(tool_);
  lexer_.advance();
  return valueOnce(tool_.spindleSpeed, function_ == 80 ? "the set-up clearance S" : "the spindle angle S");
}

/// Reads a value into `operand`, which must not have one yet.
bool BlockParser::valueOnce(Operand& operand, std::string_view what) {
  if (operand.present()) return error(fmt::format("{} is given twice in this block", what), "remove one of the two");
  const std::optional<Operand> found = value(what);
  if (found) operand = *found;
  return found.has_value();
}

bool BlockParser::toolWordOrTolerance() {
  lexer_.advance();
  if (function_ == 62) return valueOnce(length_, "the tolerance T");
  if (toolCalled_) return error("a block calls one tool only");
  toolCalled_ = true;
  if (!toolIdentity(tool_)) return false;
  if (tool_.number.present() || tool_.name.present()) return true;
  return error("the number or the name of the tool is expected after T", "write T5 G17 or T\"TASTER\" G17");
}

bool BlockParser::emitTool() {
  const bool oversize = tool_.deltaLength.present() || tool_.deltaRadius.present() || tool_.deltaRadius2.present();
  const bool speed = tool_.spindleSpeed.present() || tool_.cuttingSpeed.present();
  if (!toolCalled_ && !speed && !oversize) {
    emitToolAxis();
    return true;
  }
  tool_.axis = axis_;
  // In a block without path the feed is the one that FAUTO takes.
  if (toolCalled_ && coordinateCount_ == 0 && !motion_ && !move_.machineCoordinates) {
    tool_.feed = move_.feed;
    move_.feed = {};
  }
  emit(tool_);
  return true;
}

bool BlockParser::emitPath() {
  if (centreCount_ > 0) {
    if (move_.machineCoordinates || move_.machineReference2) {
      return errorAt(centre_[0], "M91 and M92 take axes in straight lines only, not I, J and K",
                     "write the centre in the coordinates of the workpiece, in a block of its own");
    }
    Move centre;
    centre.kind = MoveKind::SetCentre;
    const std::size_t first = block_.words.size();
    block_.words.insert(block_.words.end(), centre_.begin(),
                        centre_.begin() + static_cast<std::ptrdiff_t>(centreCount_));
    centre.words = wordsSince(first);
    emit(centre);
  }
  const bool moves = coordinateCount_ > 0 || move_.feed.present() || move_.autoFeed ||
                     move_.compensation != RadiusCompensation::Unchanged;
  if (!moves) {
    emitWithMachineFunctions(nullptr);
    return true;
  }
  move_.kind = MoveKind::Modal;
  move_.variant = constant("G");
  const std::size_t first = block_.words.size();
  block_.words.insert(block_.words.end(), coordinates_.begin(),
                      coordinates_.begin() + static_cast<std::ptrdiff_t>(coordinateCount_));
  move_.words = wordsSince(first);
  if (path_ >= 0) {
    if (std::optional<PathMistake> mistake = pathMistake(path_, block_, move_))
      return errorAt(mistake->word, std::move(mistake->message), std::move(mistake->advice));
  }
  const Instruction instruction = move_;
  emitWithMachineFunctions(&instruction);
  return true;
}

bool BlockParser::emitWords() {
  if (function_ >= 0) return emitFunction();
  if (parameterCount_ > 0 || length_.present()) {
    return error("parameters P and the length L need a G function that takes them");
  }
  return emitTool() && emitPath();
}

}  // namespace probewright::language::din_iso

#include "language/sinumerik/block_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "language/sinumerik/block_words.hpp"

namespace probewright::language::sinumerik {

using namespace language;

namespace {

/// AX[v]= and IP[v]= may stand several times in a block.
bool isComputedAxis(std::uint32_t address) {
  return address == addressOf("AX[]") || address == addressOf("=AX") || address == addressOf("IP[]") ||
         address == addressOf("=IP");
}

}  // namespace

void BlockParser::takeLine(std::string_view line) {
  line_ = line;
  upper_.assign(line);
  char* text = upper_.data();
  std::size_t length = upper_.size();
  if (std::memchr(text, '"', length) == nullptr) {
    if (const void* comment = std::memchr(text, ';', length); comment != nullptr)
      length = static_cast<std::size_t>(static_cast<const char*>(comment) - text);
    for (std::size_t i = 0; i < length; ++i) {
      const char c = text[i];
      text[i] = static_cast<char>(c - (static_cast<unsigned char>(c - 'a') < 26 ? 32 : 0));
    }
  } else {
    bool inText = false;
    for (std::size_t i = 0; i < length; ++i) {
      const char c = text[i];
      if (c == '"') inText = !inText;
      if (!inText && c == ';') length = i;
      if (!inText && c >= 'a' && c <= 'z') text[i] = static_cast<char>(c - 32);
    }
  }
  upper_.resize(length);
  Block& block = *block_;
  block.source = block.add(line);
  upperOffset_ = block.add(upper_).offset;
  cursor_ = Cursor(upper_);
}

TextRef BlockParser::upper(std::size_t offset, std::size_t length) const {
  return {upperOffset_ + static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(length)};
}

TextRef BlockParser::upper(std::string_view part) const {
  return upper(static_cast<std::size_t>(part.data() - upper_.data()), part.size());
}

TextRef BlockParser::original(std::size_t offset, std::size_t length) const {
  return {block_->source.offset + static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(length)};
}

Operand BlockParser::add(const Node& node) {
  block_->nodes.push_back(node);
  return {0, static_cast<std::int32_t>(block_->nodes.size() - 1)};
}

void BlockParser::fail(std::size_t offset, std::string message, std::string advice) {
  if (!failed_) {
    Diagnostic mistake;
    mistake.place = *place_;
    mistake.place.column = static_cast<std::uint32_t>(offset) + 1;
    mistake.message = std::move(message);
    mistake.excerpt = std::string(line_);
    mistake.advice = std::move(advice);
    diagnostics_->push_back(std::move(mistake));
  }
  failed_ = true;
  cursor_.moveToEnd();
}

TextRef BlockParser::restOfBlock() {
  cursor_.skipBlanks();
  std::string_view rest = cursor_.rest();
  rest = trimmedAtEnd(rest);
  const TextRef ref = upper(rest);
  cursor_.moveToEnd();
  return ref;
}

void BlockParser::expectEnd(const char* after) {
  cursor_.skipBlanks();
  if (!cursor_.atEnd())
    fail(cursor_.offset(), std::string("nothing may follow ") + after + " in its block",
         "Write what follows into a block of its own.");
}

bool BlockParser::expect(char c, const char* what) {
  if (cursor_.take(c)) return true;
  fail(cursor_.offset(), std::string("'") + c + "' expected " + what);
  return false;
}

/// "/" and "/0" to "/9": the level of block skip. False if none stands here.
bool BlockParser::takeSkip() {
  if (cursor_.peek() != '/') return false;
  block_->skippable = true;
  cursor_.advance();
  if (isDigit(cursor_.peek())) {
    block_->skipLevel = static_cast<std::uint8_t>(cursor_.peek() - '0');
    cursor_.advance();
  }
  cursor_.skipBlanks();
  return true;
}

void BlockParser::parse(std::string_view line, const SourcePlace& place, Block& block, Diagnostics& diagnostics) {
  block_ = &block;
  diagnostics_ = &diagnostics;
  place_ = &place;
  failed_ = false;
  depth_ = 0;
  axisWords_.clear();
  after_.clear();
  owner_ = Owner::Move;
  motion_ = MoveKind::Modal;
  motionGiven_ = polar_ = false;
  motionName_ = compensationName_ = suppression_ = ownerName_ = {};
  compensation_ = RadiusCompensation::Unchanged;
  feed_ = {};
  groups_ = 0;
  taken_.clear();
  takeLine(line);

  cursor_.skipBlanks();
  if (cursor_.peek() == '%') return;  // the header line of an archive names the program
  takeSkip();
  const std::size_t numberStart = cursor_.offset();
  if ((cursor_.peek() == 'N' || cursor_.peek() == ':') && isDigit(cursor_.peek(1))) {
    cursor_.advance();
    cursor_.digits();
    block.label = upper(cursor_.since(numberStart));
    cursor_.skipBlanks();
    takeSkip();
  }
  if (isNameStart(cursor_.peek())) {
    const std::size_t start = cursor_.offset();
    const std::string_view name = cursor_.name();
    cursor_.skipBlanks();
    if (cursor_.peek() == ':' && name.size() > 1 && isNameStart(name[1])) {
      cursor_.advance();
      block.label = upper(start, name.size());
    } else if (cursor_.peek() == ':') {
      fail(start, std::string(name) + " cannot be a label: the names of labels begin with two letters or underscores",
           "Write LA1: or another name.");
    } else {
      cursor_.moveTo(start);
    }
  }
  parseStatements();
  finish();
  if (failed_) block.instructions.clear();
}

void BlockParser::parseStatements() {
  for (;;) {
    cursor_.skipBlanks();
    if (cursor_.atEnd()) return;
    const char first = cursor_.peek();
    if (isNameStart(first) && !isNameStart(cursor_.peek(1))) {
      parseAddress();
    } else if (isNameStart(first)) {
      parseNamed();
    } else if (first == '$') {
      parseAssignment(cursor_.offset());
    } else {
      const std::string found(1, first);
      if (first == ':' && !block_->instructions.empty())
        return fail(cursor_.offset(), "what comes before this ':' is not a label",
                    "The name of a label begins with two letters or underscores: LA1:.");
      fail(cursor_.offset(), "'" + found + "' cannot begin a statement",
           "Addresses are letters with a value (X10), everything else is written NAME=value or NAME(arguments).");
    }
  }
}

void BlockParser::emitMove() {
  Block& block = *block_;
  Move move;
  move.kind = motion_;
  move.polar = polar_;
  move.compensation = compensation_;
  move.machineCoordinates = suppression_.length != 0;
  move.variant = suppression_;
  move.feed = feed_;
  move.words = {static_cast<std::uint32_t>(block.words.size()), static_cast<std::uint32_t>(axisWords_.size())};
  block.words.insert(block.words.end(), axisWords_.begin(), axisWords_.end());
  block.instructions.emplace_back(move);
}

/// False with a complaint if the block has had `what` already: an address, an axis, the turning of a spindle.
bool BlockParser::takeOnce(std::string what, std::size_t start, std::string_view alarm) {
  if (std::ranges::find(taken_, what) != taken_.end()) {
    fail(start, what + " appears twice in this block",
         fmt::format("Keep one of the two: the control refuses the block with alarm {}.", alarm));
    return false;
  }
  taken_.push_back(std::move(what));
  return true;
}

/// False with a complaint if the block has an address twice.
bool BlockParser::addressesOnce() {
  for (std::size_t i = 0; i < axisWords_.size(); ++i) {
    const std::uint32_t address = axisWords_[i].address;
    if (isComputedAxis(address)) continue;
    const bool moved = !taken_.empty() && std::ranges::find(taken_, "the axis " + addressName(address)) != taken_.end();
    for (std::size_t j = 0; j < i || moved; ++j) {
      if (!moved && address != axisWords_[j].address) continue;
      fail(axisWords_[i].column - 1, "the address " + addressName(address) + " appears twice in this block",
           "Write each address once in a block.");
      return false;
    }
  }
  return true;
}

/// False with a complaint if the words of the block do not belong to what they stand with, as far as the block itself
/// says what that is.
bool BlockParser::wordsFit() {
  const Block& block = *block_;
  if (axisWords_.empty()) return true;
  std::optional<Takes> takes;
  TextRef name = motionName_;
  WordRange words;
  if (owner_ == Owner::Move) {
    const auto* move = std::get_if<Move>(&block.instructions.back());
    if (!motionGiven_ || move == nullptr) return true;
    words = move->words;
    switch (motion_) {
      case MoveKind::Rapid:
      case MoveKind::Linear:
        takes = Takes::Line;
        break;
      case MoveKind::ArcClockwise:
      case MoveKind::ArcCounterclockwise:
        takes = Takes::Arc;
        break;
      case MoveKind::ArcThroughPoint:
        takes = Takes::Points;
        break;
      case MoveKind::ArcTangential:
        takes = Takes::Tangent;
        break;
      default:
        takes = block.at(name).starts_with('G') ? Takes::Thread : Takes::Spline;
    }
  } else {
    name = ownerName_;
    words = {static_cast<std::uint32_t>(block.words.size() - axisWords_.size()),
             static_cast<std::uint32_t>(axisWords_.size())};
    const std::string_view owner = block.at(name);
    takes = owner_ == Owner::Modal                                  ? Takes::Limit
            : owner == "G4"                                         ? Takes::Dwell
            : owner == "G74" || owner == "G75"                      ? Takes::Fixed
            : owner_ == Owner::Command                              ? Takes::Measure
            : owner == "G110" || owner == "G111" || owner == "G112" ? Takes::Pole
            : owner.find("ROT") != std::string_view::npos           ? Takes::Turn
                                                                    : Takes::Frame;
  }
  const std::optional<WordMistake> mistake = wordMistake(*takes, block.at(name), block, words, std::nullopt);
  if (!mistake) return true;
  fail(mistake->column > 0 ? mistake->column - 1 : 0, mistake->message,
       fmt::format("{} The control refuses the block with alarm {}.", mistake->advice, mistake->alarm));
  return false;
}

void BlockParser::finish() {
  if (failed_) return;
  Block& block = *block_;
  if (!addressesOnce()) return;
  if (owner_ == Owner::Move && !axisWords_.empty()) {
    emitMove();
  } else {
    if (motionGiven_ && motion_ != MoveKind::Modal && owner_ != Owner::Command)
      block.instructions.emplace_back(Modal{motionName_, {}});
    if (compensationName_.length != 0) block.instructions.emplace_back(Modal{compensationName_, {}});
    if (feed_.present()) {
      const Word word{addressOf("F"), WordMode::Plain, feed_, feedColumn_, 0};
      if (owner_ == Owner::Command) {
        axisWords_.push_back(word);
      } else {
        block.instructions.emplace_back(Modal{block.add("F"), {static_cast<std::uint32_t>(block.words.size()), 1}});
        block.words.push_back(word);
      }
    }
    if (owner_ != Owner::Move) {
      const WordRange words{static_cast<std::uint32_t>(block.words.size()),
                            static_cast<std::uint32_t>(axisWords_.size())};
      block.words.insert(block.words.end(), axisWords_.begin(), axisWords_.end());
      if (owner_ == Owner::Transform) block.instructions.emplace_back(Transform{ownerName_, words, {}});
      if (owner_ == Owner::Modal) block.instructions.emplace_back(Modal{ownerName_, words});
      if (owner_ == Owner::Command)
        block.instructions.emplace_back(Command{ownerName_, motionGiven_ ? motionName_ : TextRef{}, -1, words});
    } else if (suppression_.length != 0) {
      block.instructions.emplace_back(Modal{suppression_, {}});
    }
  }
  if (!wordsFit()) return;
  block.instructions.insert(block.instructions.end(), after_.begin(), after_.end());
}

}  // namespace probewright::language::sinumerik

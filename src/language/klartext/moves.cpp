#include <fmt/format.h>

#include "language/klartext/parser.hpp"

/// Path functions: L, LP, LN, CC, C, CR, CT, CP, CTP, RND, CHF, APPR, DEP and single axis blocks.
namespace probewright::language::klartext {

bool BlockParser::feedWord(Operand& feed, bool* rapid, bool* autoFeed) {
  lexer_.advance();
  const char c = lexer_.peek();
  if (c == 'M' && upper(lexer_.here(1)) == 'A' && upper(lexer_.here(2)) == 'X') {
    lexer_.advance(3);
    if (lexer_.here() == 'T') {  // FMAXT: a path with the time it takes
      lexer_.advance();
      return value("F MAXT").has_value();
    }
    const bool functionFollows = upper(lexer_.here()) == 'M' && isDigit(lexer_.here(1));
    if (isWordByte(lexer_.here()) && !functionFollows) return error("this is not a feed rate", "Did you mean FMAX?");
    *rapid = true;
    return true;
  }
  if (c == 'A' && lexer_.acceptKeyword("AUTO")) {
    *autoFeed = true;
    return true;
  }
  if (c == 'U' || c == 'Z' || c == 'T') {  // per revolution, per tooth, as a time
    lexer_.advance();
    const char name[2] = {'F', c};
    return word(addressOf({name, 2}), "the feed");
  }
  const std::optional<Operand> programmed = value("the feed F");
  if (!programmed) return false;
  feed = *programmed;
  return true;
}

/// Takes F or M without a value, as older controls list what a block leaves open: "L X+10 R F M". `following` may come
/// after it, else the end of the block.
bool BlockParser::leftOpen(char following) {
  const std::size_t start = lexer_.offset();
  lexer_.advance();
  const bool blank = !isWordByte(lexer_.here());
  const char next = lexer_.peek();
  const bool rapid = next == 'M' && upper(lexer_.here(1)) == 'A';
  if (blank && !rapid && (next == '\0' || next == following)) return true;
  lexer_.seek(start);
  return false;
}

bool BlockParser::axisWord(WordMode mode) {
  const char letter = lexer_.peek();
  lexer_.advance();
  const char name[1] = {letter};
  const std::string_view axis(name, 1);
  return word(addressOf(axis), axis, mode);
}

bool BlockParser::radiusWord(Move& move) {
  lexer_.advance();
  const char c = upper(lexer_.here());
  const char following = lexer_.here(c == '\0' ? 0 : 1);
  const bool wordEnds = !isDigit(following) && !isWordByte(following) && following != '.' && following != ',';
  if (wordEnds && (c == '0' || c == 'L' || c == 'R')) {
    lexer_.advance();
    move.compensation = c == '0'   ? RadiusCompensation::Off
                        : c == 'L' ? RadiusCompensation::Left
                                   : RadiusCompensation::Right;
    return true;
  }
  if (c == 'O' && wordEnds)
    return error("R with the letter O is not a radius compensation", "Did you mean R0, with a zero?");
  const char sign = lexer_.peek();
  // "R F M" is how older controls list what a block leaves open.
  if ((c != sign || c == '\0') && (sign == 'F' || sign == 'M' || sign == '\0')) return true;
  if (sign == '+' || sign == '-') {
    // R+ and R- of single axis blocks stand without a number.
    const std::size_t start = lexer_.offset();
    lexer_.advance();
    const char next = lexer_.peek();
    const bool alone = !isDigit(next) && next != '.' && next != ',' && next != 'Q';
    if (alone) {
      addWord(addressOf("R"), Operand::of(sign == '+' ? 1 : -1), WordMode::DirectShortest);
      return true;
    }
    lexer_.seek(start);
  }
  return word(addressOf("R"), "the radius R");
}

/// Refuses a word that a block has twice.
bool BlockParser::eachOnce(WordRange range) {
  for (std::uint32_t i = 1; i < range.count; ++i) {
    const Word& word = block_.words[range.first + i];
    for (std::uint32_t k = 0; k < i; ++k) {
      const Word& other = block_.words[range.first + k];
      if (other.address != word.address || other.mode == WordMode::DirectShortest) continue;
      return error(fmt::format("{} is given twice in this block", addressName(word.address)), "remove one of the two");
    }
  }
  return true;
}

bool BlockParser::moveWords(Move& move) {
  const std::size_t first = block_.words.size();
  bool wordsEnded = false;
  const auto axes = [&](WordMode mode) {
    if (wordsEnded) return error("axes must come before M functions that have words of their own");
    return axisWord(mode);
  };
  for (;;) {
    const char c = lexer_.peek();
    switch (c) {
      case '\0':
        if (!wordsEnded) move.words = wordsSince(first);
        return eachOnce(move.words);
      case 'X':
      case 'Y':
      case 'Z':
      case 'A':
      case 'B':
      case 'U':
      case 'V':
      case 'W':
        if (!axes(WordMode::Plain)) return false;
        break;
      case 'C':
        if (upper(lexer_.here(1)) == 'C' && upper(lexer_.here(2)) == 'A') {
          lexer_.advance(3);
          if (!word(addressOf("CCA"), "CCA")) return false;
        } else if (!axes(WordMode::Plain)) {
          return false;
        }
        break;
      case 'I':
        lexer_.advance();
        if (upper(lexer_.here()) == 'P') {
          const char name[2] = {'P', upper(lexer_.here(1))};
          if (name[1] != 'A' && name[1] != 'R') return error("PA or PR is expected after I");
          lexer_.advance(2);
          if (!word(addressOf({name, 2}), {name, 2}, WordMode::Incremental)) return false;
        } else if (std::string_view("XYZABCUVW").find(lexer_.peek()) != std::string_view::npos && !lexer_.atEnd()) {
          if (!axes(WordMode::Incremental)) return false;
        } else {
          return error("an axis is expected after I");
        }
        break;
      case 'P': {
        const char name[2] = {'P', upper(lexer_.here(1))};
        if (name[1] != 'A' && name[1] != 'R') return error("PA or PR is expected");
        lexer_.advance(2);
        if (!word(addressOf({name, 2}), {name, 2})) return false;
        break;
      }
      case 'N':
      case 'T': {
        const char name[2] = {c, upper(lexer_.here(1))};
        if (name[1] < 'X' || name[1] > 'Z') {
          return error("this word is not known in a path block", "check the spelling of this word");
        }
        lexer_.advance(2);
        if (!word(addressOf({name, 2}), {name, 2})) return false;
        break;
      }
      case 'R':
        if (!radiusWord(move)) return false;
        break;
      case 'D': {
        if (upper(lexer_.here(1)) != 'R') return error("DR+ or DR- is expected");
        lexer_.advance(2);
        const char sign = lexer_.peek();
        if (sign != '+' && sign != '-') return error("+ or - is expected after DR");
        lexer_.advance();
        addWord(addressOf("DR"), Operand::of(sign == '+' ? 1 : -1));
        break;
      }
      case 'L':
        if (!lexer_.acceptPrefix("LEN")) {
          return error("this word is not known in a path block", "check the spelling of this word");
        }
        if (!word(addressOf("LEN"), "LEN")) return false;
        break;
      case 'F':
        if (!leftOpen('M') && !feedWord(move.feed, &move.rapid, &move.autoFeed)) return false;
        break;
      case 'M': {
        if (leftOpen('\0')) break;
        const std::size_t before = block_.words.size();
        if (!machineFunction(&move)) return false;
        if (!wordsEnded && block_.words.size() > before) {
          move.words = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(before - first)};
          wordsEnded = true;
        }
        break;
      }
      default:
        return error("an axis, R0/RL/RR, F or M is expected here", "check the spelling of this word");
    }
  }
}

bool BlockParser::move(MoveKind kind, Coordinates coordinates) {
  Move move;
  move.kind = kind;
  move.polar = coordinates == Coordinates::Polar;
  if ((kind == MoveKind::Chamfer || kind == MoveKind::Rounding) && lexer_.peek() != 'R') {
    if (!word(addressOf("R"), kind == MoveKind::Chamfer ? "the length of the chamfer" : "the radius")) return false;
    const std::size_t first = block_.words.size() - 1;
    Move rest;
    if (!moveWords(rest)) return false;
    move.feed = rest.feed;
    move.rapid = rest.rapid;
    move.autoFeed = rest.autoFeed;
    move.compensation = rest.compensation;
    move.words = wordsSince(first);
  } else if (!moveWords(move)) {
    return false;
  }
  const Instruction instruction = move;
  emitWithMachineFunctions(&instruction);
  return true;
}

bool BlockParser::arc(Coordinates coordinates) {
  Move move;
  move.kind = MoveKind::Modal;
  move.polar = coordinates == Coordinates::Polar;
  if (!moveWords(move)) return false;
  for (std::uint32_t i = 0; i < move.words.count; ++i) {
    const Word& found = block_.words[move.words.first + i];
    if (found.address != addressOf("DR")) continue;
    move.kind = found.value.number > 0 ? MoveKind::ArcCounterclockwise : MoveKind::ArcClockwise;
  }
  const Instruction instruction = move;
  emitWithMachineFunctions(&instruction);
  return true;
}

bool BlockParser::arcWithRadius() {
  const std::size_t first = block_.words.size();
  if (!arc()) return false;
  for (std::size_t i = first; i < block_.words.size(); ++i) {
    const Word& found = block_.words[i];
    if (found.address == addressOf("R") && found.mode != WordMode::DirectShortest) return true;
  }
  return error("an arc CR needs its radius R",
               "add R with the radius: positive for an arc up to a half circle, negative beyond");
}

bool BlockParser::approachOrDepart(MoveKind kind) {
  static constexpr std::array<std::string_view, 4> variants = {"LCT", "LT", "LN", "CT"};
  Move move;
  move.kind = kind;
  move.polar = lexer_.peek() == 'P';
  if (move.polar) lexer_.advance();
  for (const std::string_view variant : variants) {
    lexer_.peek();
    const std::size_t start = lexer_.offset();
    if (!lexer_.acceptKeyword(variant)) continue;
    move.variant = {static_cast<std::uint32_t>(start), static_cast<std::uint32_t>(variant.size())};
    break;
  }
  if (move.variant.length == 0) {
    return error("LT, LN, CT, LCT or one of their polar forms PLT, PLN, PCT, PLCT is expected");
  }
  if (!moveWords(move)) return false;
  const auto has = [&](std::string_view address) {
    for (std::uint32_t i = 0; i < move.words.count; ++i) {
      if (block_.words[move.words.first + i].address == addressOf(address)) return true;
    }
    return false;
  };
  const bool straight = move.variant.length == 2 && upper(block_.at(move.variant)[0]) == 'L';
  if (straight && !has("LEN")) return error("LEN with the length of the line is expected in this block");
  if (!straight && !has("R")) return error("R with the radius of the arc is expected in this block");
  if (!straight && move.variant.length == 2 && !has("CCA")) {
    return error("CCA with the angle of the arc is expected in this block");
  }
  const Instruction instruction = move;
  emitWithMachineFunctions(&instruction);
  return true;
}

}  // namespace probewright::language::klartext

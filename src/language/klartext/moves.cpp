#include <fmt/format.h>

#include "language/klartext/parser.hpp"
#include "language/klartext/path_words.hpp"

/// Path functions: L, LP, LN, CC, C, CR, CT, CP, CTP, RND, CHF, APPR, DEP and single axis blocks.
namespace probewright::language::klartext {

bool BlockParser::feedWord(Operand& feed, bool* rapid, bool* autoFeed) {
  lexer_.advance();
  const char c = lexer_.peek();
  if (c == 'M' && upper(lexer_.here(1)) == 'A' && upper(lexer_.here(2)) == 'X') {
    lexer_.advance(3);
    if (upper(lexer_.here()) == 'T') {  // FMAXT: a path with the time it takes
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

/// Reads one word of a path block that is no M function: into block_.words, or a feed or a compensation into `move`.
bool BlockParser::pathWord(Move& move) {
  const auto named = [&](std::string_view first, std::string_view seconds, std::string_view expected, WordMode mode) {
    const char name[2] = {first.front(), upper(lexer_.here(1))};
    if (seconds.find(name[1]) == std::string_view::npos || name[1] == '\0')
      return error(std::string(expected), "check the spelling of this word");
    lexer_.advance(2);
    return word(addressOf({name, 2}), {name, 2}, mode);
  };
  const char c = lexer_.peek();
  switch (c) {
    case 'X':
    case 'Y':
    case 'Z':
    case 'A':
    case 'B':
    case 'U':
    case 'V':
    case 'W':
      return axisWord(WordMode::Plain);
    case 'C':
      if (upper(lexer_.here(1)) != 'C' || upper(lexer_.here(2)) != 'A') return axisWord(WordMode::Plain);
      lexer_.advance(3);
      return word(addressOf("CCA"), "CCA");
    case 'I':
      lexer_.advance();
      if (upper(lexer_.here()) == 'P') return named("P", "AR", "PA or PR is expected after I", WordMode::Incremental);
      if (std::string_view("XYZABCUVW").find(lexer_.peek()) == std::string_view::npos || lexer_.atEnd())
        return error("an axis is expected after I");
      return axisWord(WordMode::Incremental);
    case 'P':
      return named("P", "AR", "PA or PR is expected", WordMode::Plain);
    case 'N':
      return named("N", "XYZ", "this word is not known in a path block", WordMode::Plain);
    case 'T':
      return named("T", "XYZ", "this word is not known in a path block", WordMode::Plain);
    case 'R':
      return radiusWord(move);
    case 'D': {
      if (upper(lexer_.here(1)) != 'R') return error("DR+ or DR- is expected");
      lexer_.advance(2);
      const char sign = lexer_.peek();
      if (sign != '+' && sign != '-') return error("+ or - is expected after DR");
      lexer_.advance();
      addWord(addressOf("DR"), Operand::of(sign == '+' ? 1 : -1));
      return true;
    }
    case 'L':
      if (!lexer_.acceptPrefix("LEN"))
        return error("this word is not known in a path block", "check the spelling of this word");
      return word(addressOf("LEN"), "LEN");
    case 'F':
      return leftOpen('M') || feedWord(move.feed, &move.rapid, &move.autoFeed);
    default:
      return error("an axis, R0/RL/RR, F or M is expected here", "check the spelling of this word");
  }
}

/// Refuses the words from `from` on if the function does not take them, or if the block has them already.
bool BlockParser::belongs(const PathWords& function, std::size_t first, std::size_t from) {
  const auto isPlaneAxis = [](const Word& word) { return word.address >= 'X' && word.address <= 'Z'; };
  for (std::size_t i = from; i < block_.words.size(); ++i) {
    const Word& added = block_.words[i];
    if (!takes(function, added)) {
      return error(fmt::format("{} takes no {}", function.name, writtenName(added)),
                   adviceAgainst(function, added.address));
    }
    const bool polar = function.end == EndPoint::Polar || function.end == EndPoint::PolarArc;
    for (std::size_t k = first; k < i; ++k) {
      const Word& other = block_.words[k];
      if (other.address == added.address)
        return error(fmt::format("{} is given twice in this block", addressName(added.address)),
                     "remove one of the two");
      if (!polar || !isPlaneAxis(added) || !isPlaneAxis(other)) continue;
      return error(
          fmt::format("{} takes one axis beside PR and PA, the one along the tool, and this block has {} and {}",
                      function.name, addressName(other.address), addressName(added.address)),
          fmt::format("take the axes of the plane away, or write {} for them", function.twin));
    }
  }
  return true;
}

/// The words of a path block up to its end. Words, feeds and compensations that `function` does not take, or that stand
/// twice, are mistakes at their places.
bool BlockParser::moveWords(Move& move, const PathWords& function) {
  const std::size_t first = block_.words.size();
  bool wordsEnded = false;
  bool feedGiven = false;
  for (char c = lexer_.peek(); c != '\0'; c = lexer_.peek()) {
    const std::size_t start = lexer_.offset();
    const std::uint32_t column = lexer_.column();
    const std::size_t before = block_.words.size();
    if (c == 'M') {
      if (leftOpen('\0')) continue;
      if (!machineFunction(&move)) return false;
      if (!wordsEnded && block_.words.size() > before) {
        move.words = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(before - first)};
        wordsEnded = true;
      }
      continue;
    }
    Move one;
    if (!pathWord(one)) return false;
    const std::size_t end = lexer_.offset();
    const auto refuse = [&](std::string message, std::string advice) {
      lexer_.seek(start);
      return error(std::move(message), std::move(advice));
    };
    const bool added = block_.words.size() > before;
    if (added) block_.words[before].column = column;
    if (added && wordsEnded) return refuse("axes must come before M functions that have words of their own", {});
    const bool perTurn = added && c == 'F';  // FU, FZ
    if (one.feed.present() || one.rapid || one.autoFeed || perTurn) {
      if (!function.feed)
        return refuse(fmt::format("{} takes no feed", function.name), "write the feed in the path block after it");
      if (feedGiven) return refuse("the feed is given twice in this block", "remove one of the two");
      feedGiven = true;
      if (one.feed.present()) move.feed = one.feed;
      move.rapid = move.rapid || one.rapid;
      move.autoFeed = one.autoFeed;
    } else if (one.compensation != RadiusCompensation::Unchanged) {
      const bool sided = one.compensation != RadiusCompensation::Off;
      if (function.compensations == Compensations::None || (sided && function.compensations != Compensations::All)) {
        return refuse(fmt::format("{} takes no {}", function.name,
                                  one.compensation == RadiusCompensation::Off    ? "R0"
                                  : one.compensation == RadiusCompensation::Left ? "RL"
                                                                                 : "RR"),
                      fmt::format("take it away: {} takes {}", function.name, summaryOf(function)));
      }
      if (move.compensation != RadiusCompensation::Unchanged)
        return refuse("the radius compensation is given twice in this block", "remove one of the two");
      move.compensation = one.compensation;
    }
    lexer_.seek(start);
    if (added && !perTurn && !belongs(function, first, before)) return false;
    lexer_.seek(end);
  }
  if (!wordsEnded) move.words = wordsSince(first);
  return true;
}

bool BlockParser::move(MoveKind kind, const PathWords& function) {
  Move move;
  move.kind = kind;
  move.polar = function.end == EndPoint::Polar;
  const bool corner = kind == MoveKind::Chamfer || kind == MoveKind::Rounding;
  const std::size_t first = block_.words.size();
  if (corner && lexer_.peek() != 'R') {  // "CHF 2"
    if (!word(addressOf("R"), kind == MoveKind::Chamfer ? "the length of the chamfer" : "the radius")) return false;
    Move rest;
    if (!moveWords(rest, function)) return false;
    for (std::uint32_t i = 0; i < rest.words.count; ++i) {
      if (block_.words[rest.words.first + i].address == addressOf("R"))
        return error("R is given twice in this block", "remove one of the two");
    }
    move.feed = rest.feed;
    move.rapid = rest.rapid;
    move.autoFeed = rest.autoFeed;
    move.words = wordsSince(first);
  } else if (!moveWords(move, function)) {
    return false;
  }
  const Instruction instruction = move;
  emitWithMachineFunctions(&instruction);
  return true;
}

bool BlockParser::arc(const PathWords& function) {
  Move move;
  move.kind = MoveKind::Modal;
  move.polar = function.end == EndPoint::PolarArc;
  if (!moveWords(move, function)) return false;
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
  if (!arc(pathWords("CR"))) return false;
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
  const std::string function = fmt::format("{} {}{}", kind == MoveKind::Approach ? "APPR" : "DEP",
                                           move.polar ? "P" : "", upperCase(block_.at(move.variant)));
  if (function == "DEP PLT" || function == "DEP PLN" || function == "DEP PCT") {
    return error(fmt::format("there is no {}: only DEP LCT has an end point, and so a polar form", function),
                 fmt::format("write DEP {}", std::string_view(function).substr(5)));
  }
  if (!moveWords(move, pathWords(function))) return false;
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

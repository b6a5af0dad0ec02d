#include <fmt/format.h>

#include <algorithm>

#include "cycles/heidenhain/probe_words.hpp"
#include "language/klartext/parser.hpp"

/// Cycles in the old form, whose parts are blocks of their own: TCH PROBE 0.0, 0.1 and CYCL DEF 7.0, 7.1, 7.2. The
/// parts of one cycle are parsed together; within a part words in any language may stand before the values.
namespace probewright::language::klartext {

namespace {

constexpr std::string_view axisLetters = "XYZABCUVW";

bool isTransform(int cycle) {
  return cycle == 7 || cycle == 8 || cycle == 10 || cycle == 11 || cycle == 19 || cycle == 26 || cycle == 247;
}

/// The last part that a touch probe cycle cannot do without.
int lastPart(int cycle) {
  switch (cycle) {
    case 1:
      return 2;
    case 3:
    case 4:
    case 31:
    case 32:
    case 33:
      return 3;
    default:
      return 1;
  }
}

bool isSetting(int cycle) { return cycle == 9 || cycle == 12 || cycle == 13 || cycle == 32; }

}  // namespace

/// Goes on to the next part of the cycle; leaves `part` as it is after the last one.
bool BlockParser::nextPart(std::string_view first, std::string_view second, Part& part) {
  lexer_.liftLimit(block_.source.length);
  for (;;) {
    if (!lexer_.nextLine()) {
      part.part = -1;
      return true;
    }
    lexer_.limitToLine();
    if (lexer_.peek() == '/') lexer_.advance();
    if (isDigit(lexer_.peek())) lexer_.number();
    if (lexer_.peek() == '/') lexer_.advance();
    if (!lexer_.atEnd() && lexer_.peek() != '*') break;
    lexer_.liftLimit(block_.source.length);
  }
  if (!lexer_.acceptPrefix(first) || !lexer_.acceptPrefix(second)) return error("a part of the cycle is expected here");
  const auto integer = [&]() {
    int value = 0;
    for (lexer_.peek(); isDigit(lexer_.here()); lexer_.advance())
      value = std::min(value * 10 + (lexer_.here() - '0'), 9999);
    return value;
  };
  part.cycle = integer();
  lexer_.advance();
  part.part = integer();
  return true;
}

bool BlockParser::axisList(Axes axes) {
  const std::size_t first = block_.words.size();
  while (!lexer_.atEnd()) {
    if (!listedAxis(axes)) return false;
  }
  return eachOnce(first, "block");
}

bool BlockParser::listedAxis(Axes axes) {
  const bool incremental = lexer_.peek() == 'I';
  if (incremental) lexer_.advance();
  const char axis = lexer_.peek();
  if (axis == '\0' || axisLetters.find(axis) == std::string_view::npos) {
    return error("an axis letter is expected here");
  }
  const std::uint32_t column = lexer_.column();
  lexer_.advance();
  if (axes == Axes::WithValues)
    return word(addressOf({&axis, 1}), {&axis, 1}, incremental ? WordMode::Incremental : WordMode::Plain);
  addWord(addressOf({&axis, 1}), {}).column = column;
  return true;
}

bool BlockParser::oldProbeCycle(int number) {
  lexer_.advance();
  Part part{number, 0};
  for (lexer_.peek(); isDigit(lexer_.here()); lexer_.advance())
    part.part = std::min(part.part * 10 + (lexer_.here() - '0'), 99);
  if (part.part != 0) {
    return error("this part of a touch probe cycle stands alone",
                 fmt::format("begin with TCH PROBE {}.0 and keep the parts together", number));
  }
  const std::size_t first = block_.words.size();
  lexer_.limitToLine();
  int last = -1;
  while (part.part >= 0) {
    if (part.part != last + 1)
      return error("the parts of a touch probe cycle must follow each other, beginning with 0");
    last = part.part;
    if (!oldProbePart(part)) return false;
    if (!nextPart("TCH", "PROBE", part)) return false;
  }
  if (last < lastPart(number)) {
    return error(fmt::format("part {}.{} of this touch probe cycle is missing", number, last + 1),
                 fmt::format("write TCH PROBE {}.{} below this block", number, last + 1));
  }
  emit(CycleCall{number, constant("TCH PROBE"), wordsSince(first)});
  return true;
}

bool BlockParser::oldProbePart(Part part) {
  using namespace cycles::heidenhain::probe_word;
  const auto behindWords = [&](std::uint32_t address, std::string_view what) {
    const std::optional<Operand> found = valueBehindWords(what);
    if (found) addWord(address, *found);
    return found.has_value();
  };
  const auto resultParameter = [&]() {
    const std::optional<VariableRef> found = variable();
    if (!found) return false;
    if (found->space != VariableSpace::Q) {
      return error("the result goes into a Q parameter; QL, QR and QS are not possible here",
                   "write Qn, and copy it afterwards: QR5 = Q5");
    }
    addWord(result, found->index[0]);
    return true;
  };
  const auto probingAxis = [&]() {
    const std::size_t index = axisLetters.find(lexer_.peek());
    if (lexer_.atEnd() || index == std::string_view::npos) return error("the probing axis is expected here");
    lexer_.advance();
    addWord(axis, Operand::of(static_cast<double>(index)));
    return true;
  };
  const auto coordinates = [&]() {
    const std::size_t first = block_.words.size();
    if (!axisList(Axes::WithValues)) return false;
    for (std::size_t i = first; i < block_.words.size(); ++i) {
      const char letter = static_cast<char>(block_.words[i].address);
      block_.words[i].address = coordinate + static_cast<std::uint32_t>(axisLetters.find(letter));
    }
    return true;
  };
  switch (part.cycle * 10 + part.part) {
    case 0: {  // a name, the result parameter, the axis with the direction
      lexer_.peek();
      std::size_t start = std::string_view::npos;
      for (std::size_t at = lexer_.offset(); lexer_.here() != '\0' && lexer_.here() != ';'; at = lexer_.offset()) {
        const bool behindBlank = at == 0 || isBlankOrReturn(lexer_.text()[at - 1]);
        if (behindBlank && variableFollows()) start = at;
        if (lexer_.offset() == at) lexer_.advance();
      }
      if (start == std::string_view::npos) return error("the parameter for the result, Qn, is expected here");
      lexer_.seek(start);
      if (!resultParameter() || !probingAxis()) return false;
      const char sign = lexer_.peek();
      if (sign != '+' && sign != '-') return error("the probing direction + or - is expected after the axis");
      lexer_.advance();
      addWord(direction, Operand::of(sign == '+' ? 1 : -1));
      return expectEnd();
    }
    case 1:
    case 12:
    case 42:
      return coordinates();
    case 11:
      return probingAxis() && behindWords(angle, "the probing angle") && expectEnd();
    case 21: {
      if (!behindWords(height, "the clearance height")) return false;
      if (!lexer_.accept('R')) return error("the radius R of the calibration workpiece is expected here");
      const std::optional<Operand> size = value("the radius");
      if (!size) return false;
      addWord(radius, *size);
      return behindWords(outside, "the direction, inside 0 or outside 1") && expectEnd();
    }
    case 31:
    case 41:
      return resultParameter() && expectEnd();
    case 32:
      return probingAxis() && behindWords(angle, "the probing angle") && expectEnd();
    case 33:
    case 43: {
      if (!behindWords(distance, "the maximum measuring path")) return false;
      Operand speed;
      bool rapid = false;
      bool automatic = false;
      if (lexer_.peek() != 'F') return error("the feed rate F for measuring is expected here");
      if (!feedWord(speed, &rapid, &automatic)) return false;
      if (speed.present()) addWord(feed, speed);
      if (!lexer_.acceptPrefix("MB")) return error("the retraction path MB is expected here");
      if (lexer_.acceptKeyword("MAX")) {
        addWord(retraction, {});
      } else {
        const std::optional<Operand> back = value("MB");
        if (!back) return false;
        addWord(retraction, *back);
      }
      if (lexer_.atEnd()) return true;
      return behindWords(referenceSystem, "the reference system 0 or 1") && expectEnd();
    }
    case 34:
      return behindWords(errorMode, "the error mode 0 or 1") && expectEnd();
    case 91:
      return behindWords(datum, "the coordinate of the datum") &&
             behindWords(referenceSystem, "the reference system 0 or 1") && expectEnd();
    case 301:
      return behindWords(height, "the clearance height") && expectEnd();
    case 311:
    case 321:
    case 331:
      if (!behindWords(check, "measuring 0 or checking 1")) return false;
      if (variableFollows() && !resultParameter()) return false;
      return expectEnd();
    case 312:
    case 322:
    case 332:
      return behindWords(height, "the clearance height") && expectEnd();
    case 313:
    case 323:
    case 333:
      return behindWords(teeth, "the probing of the teeth 0 or 1") && expectEnd();
    default:
      break;
  }
  const bool known = part.cycle <= 4 || part.cycle == 9 || (part.cycle >= 30 && part.cycle <= 33);
  if (!known) {
    return error("there is no touch probe cycle of this form with this number",
                 "cycles from 400 on are written TCH PROBE 411 NAME ~ and Qn=value");
  }
  if (part.part != 0) return error("this touch probe cycle has no part with this number");
  return true;
}

bool BlockParser::oldCycle(int number) {
  lexer_.advance();
  Part part{number, 0};
  for (lexer_.peek(); isDigit(lexer_.here()); lexer_.advance())
    part.part = std::min(part.part * 10 + (lexer_.here() - '0'), 99);
  if (part.part != 0) {
    return error("this part of a cycle stands alone",
                 fmt::format("begin with CYCL DEF {}.0 and keep the parts together", number));
  }
  const std::size_t first = block_.words.size();
  std::string_view text;
  lexer_.limitToLine();
  int last = -1;
  while (part.part >= 0) {
    if (part.part <= last) return error("the parts of a cycle must follow each other in order");
    last = part.part;
    if (number == 12 && part.part == 1) {
      lexer_.acceptKeyword("PGM");
      const std::optional<std::string_view> quoted = lexer_.quoted();
      text = quoted ? *quoted : lexer_.restOfLine();
      if (text.empty()) return error("the name of a program is expected after CYCL DEF 12.1 PGM");
      if (!checkPath(text)) return false;
    } else if (part.part > 0 && (isTransform(number) || isSetting(number)) && !oldCyclePart(part)) {
      return false;
    }
    if (!nextPart("CYCL", "DEF", part)) return false;
  }
  if ((isTransform(number) || isSetting(number)) && last < 1) {
    return error(fmt::format("part {}.1 of this cycle is missing", number),
                 fmt::format("write CYCL DEF {}.1 with its values below this block", number));
  }
  const WordRange words = wordsSince(first);
  const TextRef name =
      constant(isTransform(number) || isSetting(number) ? fmt::format("CYCL DEF {}", number) : std::string("CYCL DEF"));
  if (isTransform(number)) {
    emit(Transform{name, words, {}});
  } else if (isSetting(number)) {
    emit(Command{name, ref(text), -1, words});
  } else {
    emit(CycleCall{number, name, words});
  }
  return true;
}

bool BlockParser::oldCyclePart(Part part) {
  // An empty list of axes ends a mirror image, tilting or a tolerance; everything else has a value.
  const bool mayBeEmpty = part.cycle == 8 || part.cycle == 12 || part.cycle == 19 || part.cycle == 32 || part.part > 1;
  if (lexer_.atEnd() && mayBeEmpty) return true;
  const auto behindWords = [&](std::string_view address, std::string_view what) {
    const std::optional<Operand> found = valueBehindWords(what);
    if (found) addWord(addressOf(address), *found);
    return found.has_value();
  };
  switch (part.cycle) {
    case 7:
      if (lexer_.accept('#')) return word(addressOf("#"), "the row of the datum table") && expectEnd();
      if (lexer_.atEnd()) return error("an axis with its shift, or # with a row of the datum table, is expected here");
      return axisList(Axes::WithValues);
    case 8:
      return axisList(Axes::LettersOnly);
    case 9:
      return behindWords("T", "the dwell time") && expectEnd();
    case 10: {
      const bool incremental = lexer_.peek() == 'I';
      if (!behindWords("ROT", "the angle ROT")) return false;
      if (incremental) block_.words.back().mode = WordMode::Incremental;
      return expectEnd();
    }
    case 11:
      return behindWords("SCL", "the scaling factor SCL") && expectEnd();
    case 13:
      return behindWords("ANG", "the spindle angle") && expectEnd();
    case 19: {
      const std::size_t first = block_.words.size();
      while (!lexer_.atEnd()) {
        const char c = lexer_.peek();
        const bool incremental = c == 'I';
        const char axis = incremental ? upper(lexer_.here(1)) : c;
        const char next = lexer_.here(incremental ? 2 : 1);
        if (axis >= 'A' && axis <= 'C' && (!isWordByte(next) || upper(next) == 'Q')) {
          lexer_.advance(incremental ? 2 : 1);
          if (!word(addressOf({&axis, 1}), {&axis, 1}, incremental ? WordMode::Incremental : WordMode::Plain)) {
            return false;
          }
        } else if (c == 'F') {
          Operand feed;
          bool rapid = false;
          bool automatic = false;
          if (!feedWord(feed, &rapid, &automatic)) return false;
          if (feed.present()) addWord(addressOf("F"), feed);
        } else if (!behindWords("DIST", "the set-up clearance")) {
          return false;
        }
      }
      return eachOnce(first, "block");
    }
    case 26: {
      const std::size_t first = block_.words.size();
      while (!lexer_.atEnd()) {
        const char axis = lexer_.peek();
        if (axis == 'C' && upper(lexer_.here(1)) == 'C') {
          const char name[3] = {'C', 'C', upper(lexer_.here(2))};
          lexer_.advance(3);
          if (!word(addressOf({name, 3}), "the centre of scaling")) return false;
        } else if (axisLetters.find(axis) != std::string_view::npos) {
          lexer_.advance();
          if (!word(addressOf({&axis, 1}), "the scaling factor")) return false;
        } else {
          return error("an axis or the centre CCX, CCY, CCZ is expected here");
        }
      }
      return eachOnce(first, "block");
    }
    case 32: {
      if (part.part == 1) return behindWords("T", "the tolerance T") && expectEnd();
      if (!behindWords("HSC", "the machining mode")) return false;
      return lexer_.atEnd() || (behindWords("TA", "the tolerance TA of rotary axes") && expectEnd());
    }
    case 247: {
      const std::optional<Operand> row = valueBehindWords("the row of the preset table");
      if (row) addWord(339, *row);
      return row && expectEnd();
    }
    default:
      return true;
  }
}

}  // namespace probewright::language::klartext

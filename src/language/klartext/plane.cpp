#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "language/klartext/meant_word.hpp"
#include "language/klartext/parser.hpp"

/// PLANE, TRANS, FUNCTION and PRESET blocks.
///
/// PLANE becomes Transform "PLANE SPATIAL"... Words: the definition's own (SPA, SPB, SPC, PROP, PROM, ROT, EULP, EULN,
/// EULR, BX..BZ, NX..NZ, P1X..P3Z, axes), and the positioning after it: MOVE, TURN or STAY without value, DIST, MB
/// (absent value: MAX), F, FMAX without value, SEQ, SYM (+1 or -1), TABL or COOR (TABLE ROT, COORD ROT) without
/// value.
namespace probewright::language::klartext {

namespace {

/// A form of PLANE: the words that define the plane. All of them are needed unless `how` says otherwise.
enum class Needed : std::uint8_t { All, One, AtLeastOne };
struct Variant {
  std::string_view keyword;
  std::string_view name;
  std::string_view words;  ///< separated by blanks; EULPR is called EULP in a block, and so on
  std::string_view example;
  Needed how = Needed::All;
};

constexpr std::array<Variant, 9> variants = {
    {{"SPATIAL", "PLANE SPATIAL", "SPA SPB SPC", "PLANE SPATIAL SPA+0 SPB+45 SPC+0 TURN FMAX"},
     {"PROJECTED", "PLANE PROJECTED", "PROPR PROMIN ROT", "PLANE PROJECTED PROPR+24 PROMIN+24 ROT+0 TURN FMAX"},
     {"EULER", "PLANE EULER", "EULPR EULNU EULROT", "PLANE EULER EULPR+45 EULNU+20 EULROT+22 TURN FMAX"},
     {"VECTOR", "PLANE VECTOR", "BX BY BZ NX NY NZ", "PLANE VECTOR BX+1 BY+0 BZ+0 NX+0 NY-0.5 NZ+0.8 TURN FMAX"},
     {"POINTS", "PLANE POINTS", "P1X P1Y P1Z P2X P2Y P2Z P3X P3Y P3Z",
      "PLANE POINTS P1X+0 P1Y+0 P1Z+0 P2X+9 P2Y+0 P2Z+0 P3X+0 P3Y+9 P3Z+4 TURN FMAX"},
     {"RELATIVE", "PLANE RELATIVE", "SPA SPB SPC", "PLANE RELATIV SPB-45 TURN FMAX", Needed::One},
     {"RELATIV", "PLANE RELATIVE", "SPA SPB SPC", "PLANE RELATIV SPB-45 TURN FMAX", Needed::One},
     {"AXIAL", "PLANE AXIAL", "A B C", "PLANE AXIAL B-45 TURN FMAX", Needed::AtLeastOne},
     {"RESET", "PLANE RESET", "", "PLANE RESET TURN FMAX"}}};

std::vector<std::string_view> listed(std::string_view words) {
  std::vector<std::string_view> all;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    all.push_back(words.substr(0, end));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return all;
}

// Longer words before those they begin with.
constexpr std::array<std::string_view, 24> definitionWords = {
    "SPA", "SPB", "SPC", "PROPR", "PROMIN", "EULPR", "EULNU", "EULROT", "ROT", "BX",  "BY",  "BZ",
    "NX",  "NY",  "NZ",  "P1X",   "P1Y",    "P1Z",   "P2X",   "P2Y",    "P2Z", "P3X", "P3Y", "P3Z"};

constexpr std::array<std::string_view, 3> spaceAngleWords = {"SPA", "SPB", "SPC"};

/// Ways to the plane that exclude each other.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> exclusive = {
    {{"MOVE", "TURN"}, {"MOVE", "STAY"}, {"TURN", "STAY"}, {"SEQ", "SYM"}, {"TABL", "COOR"}}};

/// The word of an option as programs write it.
std::string_view optionName(std::uint32_t address) {
  if (address == addressOf("TABL")) return "TABLE ROT";
  if (address == addressOf("COOR")) return "COORD ROT";
  static constexpr std::array<std::string_view, 8> options = {"MOVE", "TURN", "STAY", "DIST", "MB", "SEQ", "SYM", "F"};
  const auto found = std::ranges::find_if(options, [&](std::string_view name) { return addressOf(name) == address; });
  return found == options.end() ? "FMAX" : *found;
}

}  // namespace

bool BlockParser::plane() {
  const Variant* variant = nullptr;
  for (const Variant& candidate : variants) {
    if (variant == nullptr && lexer_.acceptKeyword(candidate.keyword)) variant = &candidate;
  }
  if (variant == nullptr) {
    return error(
        "SPATIAL, PROJECTED, EULER, VECTOR, POINTS, RELATIVE, AXIAL or RESET is expected after PLANE",
        meantWord(lexer_, {"SPATIAL", "PROJECTED", "EULER", "VECTOR", "POINTS", "RELATIVE", "AXIAL", "RESET"}));
  }
  const std::size_t first = block_.words.size();
  const std::vector<std::string_view> own = listed(variant->words);
  while (!lexer_.atEnd()) {
    const char c = lexer_.peek();
    if (c == 'M' && isDigit(lexer_.here(1))) {
      if (!machineFunction(nullptr)) return false;
      continue;
    }
    const std::size_t start = lexer_.offset();
    const std::uint32_t column = lexer_.column();
    const std::uint32_t line = lexer_.line();
    const std::size_t before = block_.words.size();
    const auto refuse = [&](std::string message, std::string advice) {
      lexer_.seek(start);
      return error(std::move(message), std::move(advice));
    };
    const auto name = std::ranges::find_if(definitionWords, [&](auto word) { return lexer_.acceptPrefix(word); });
    std::string written;
    if (name != definitionWords.end()) {
      written = *name;
      if (std::ranges::find(own, *name) == own.end())
        return refuse(fmt::format("{} takes no {}", variant->name, *name), fmt::format("write {}", variant->example));
      if (!word(addressOf(*name), *name)) return false;
    } else if (variant->keyword == "AXIAL" && ((c >= 'A' && c <= 'C') || c == 'I') && upper(lexer_.here(1)) != 'O') {
      const bool incremental = c == 'I';
      if (incremental) lexer_.advance();
      const char axis = lexer_.peek();
      lexer_.advance();
      written = axis;
      if (!word(addressOf({&axis, 1}), {&axis, 1}, incremental ? WordMode::Incremental : WordMode::Plain)) return false;
    } else {
      if (!planeOption()) return false;
      if (block_.words.size() > before) written = optionName(block_.words[before].address);
    }
    if (block_.words.size() == before) continue;
    Word& added = block_.words[before];
    added.column = column;
    added.line = line;
    const auto has = [&](std::string_view address) {
      return std::ranges::any_of(std::span(block_.words).subspan(first, before - first),
                                 [&](const Word& other) { return other.address == addressOf(address); });
    };
    const bool feed = written == "F" || written == "FMAX";
    if (feed ? has("F") || has("FMAX") : has(addressName(added.address))) {
      return refuse(fmt::format("{} is given twice in this block", feed ? "the feed" : written),
                    "remove one of the two");
    }
    for (const auto& [one, other] : exclusive) {
      const bool isOne = added.address == addressOf(one);
      if ((!isOne && added.address != addressOf(other)) || !has(isOne ? other : one)) continue;
      return refuse(fmt::format("{} and {} exclude each other", optionName(addressOf(isOne ? other : one)), written),
                    "remove one of the two");
    }
  }
  return planeComplete(variant->name, first) && emitPlane(variant->name, first);
}

bool BlockParser::emitPlane(std::string_view name, std::size_t first) {
  const Instruction instruction = Transform{constant(name), wordsSince(first), {}};
  emitWithMachineFunctions(&instruction);
  return true;
}

/// What a PLANE block lacks, or has too much of as a whole. A control takes none without MOVE, TURN or STAY, but
/// PLANE RESET, which moves nothing then.
bool BlockParser::planeComplete(std::string_view name, std::size_t first) {
  const Variant& variant = *std::ranges::find(variants, name, &Variant::name);
  const auto has = [&](std::string_view address) {
    return std::ranges::any_of(std::span(block_.words).subspan(first),
                               [&](const Word& word) { return word.address == addressOf(address); });
  };
  const std::string example = fmt::format("write {}", variant.example);
  std::vector<std::string_view> given, missing;
  for (const std::string_view word : listed(variant.words))
    (has(word) ? given : missing).push_back(word);
  if (given.empty() && !missing.empty()) return error("the values that define the plane are missing", example);
  if (variant.how == Needed::All && !missing.empty())
    return error(fmt::format("{} lacks {}", name, fmt::join(missing, ", ")), example);
  if (variant.how == Needed::One && given.size() > 1)
    return error(fmt::format("{} turns about one axis, and this block has {}", name, fmt::join(given, ", ")), example);
  if (!has("MOVE") && !has("TURN") && !has("STAY") && variant.keyword != "RESET") {
    return error("this block does not say how the rotary axes get to the plane",
                 "add TURN FMAX, MOVE DIST50 FMAX or STAY, which leaves them where they are");
  }
  for (const std::string_view word : {"DIST", "MB"}) {
    if (!has(word) || has("MOVE") || (word == "MB" && has("TURN"))) continue;
    return error(fmt::format("{} belongs to {}", word, word == "DIST" ? "MOVE" : "MOVE and TURN"),
                 fmt::format("take it away, or write MOVE {}50", word));
  }
  return true;
}

bool BlockParser::planeOption() {
  const auto flag = [&](std::string_view name) {
    addWord(addressOf(name), {});
    return true;
  };
  if (lexer_.acceptKeyword("MOVE")) return flag("MOVE");
  if (lexer_.acceptKeyword("TURN")) return flag("TURN");
  if (lexer_.acceptKeyword("STAY")) return flag("STAY");
  if (lexer_.acceptPrefix("DIST") || lexer_.acceptPrefix("ABST")) return word(addressOf("DIST"), "DIST");
  if (lexer_.acceptPrefix("MB")) {
    if (lexer_.acceptKeyword("MAX")) return flag("MB");
    return word(addressOf("MB"), "MB");
  }
  for (const std::string_view side : {"SEQ", "SYM"}) {
    if (!lexer_.acceptPrefix(side)) continue;
    const char sign = lexer_.peek();
    if (sign != '+' && sign != '-') return error("+ or - is expected here");
    lexer_.advance();
    addWord(addressOf(side), Operand::of(sign == '+' ? 1 : -1));
    return true;
  }
  if (lexer_.acceptKeyword("TABLE"))
    return (lexer_.acceptKeyword("ROT") || error("ROT is expected here")) && flag("TABL");
  if (lexer_.acceptKeyword("COORD"))
    return (lexer_.acceptKeyword("ROT") || error("ROT is expected here")) && flag("COOR");
  if (lexer_.peek() == 'F') {
    Operand feed;
    bool rapid = false;
    bool automatic = false;
    if (!feedWord(feed, &rapid, &automatic)) return false;
    if (rapid) return flag("FMAX");
    if (feed.present()) addWord(addressOf("F"), feed);
    return true;
  }
  return error(
      "this word is not known in a PLANE block",
      "MOVE, TURN, STAY, DIST, MB, F, SEQ+, SEQ-, SYM+, SYM-, COORD ROT and TABLE ROT may follow the definition");
}

/// TRANS DATUM AXIS X+10 | TABLE TABLINE 5 ["table"] | RESET, TRANS MIRROR AXIS X | RESET, TRANS ROTATION ROT+10 |
/// RESET, TRANS SCALE SCL0.5 | RESET.
bool BlockParser::transformation() {
  Transform transform;
  const std::size_t first = block_.words.size();
  std::string_view name;
  if (lexer_.acceptKeyword("DATUM")) {
    if (lexer_.acceptKeyword("AXIS")) {
      name = "TRANS DATUM AXIS";
      if (lexer_.atEnd()) return error("an axis with its shift is expected here", "write TRANS DATUM AXIS X+10");
      if (!axisList(Axes::WithValues)) return false;
    } else if (lexer_.acceptKeyword("TABLE")) {
      name = "TRANS DATUM TABLE";
      while (!lexer_.atEnd()) {
        if (const std::optional<std::string_view> table = lexer_.quoted()) {
          transform.option = ref(*table);
        } else if (lexer_.acceptPrefix("TABLINE")) {
          if (!word(addressOf("#"), "the row of the datum table")) return false;
        } else {
          return error("TABLINE with a row or the name of a datum table in quotation marks is expected here");
        }
      }
    } else if (lexer_.acceptKeyword("RESET")) {
      name = "TRANS DATUM RESET";
    } else {
      return error("AXIS, TABLE or RESET is expected after TRANS DATUM", meantWord(lexer_, {"AXIS", "TABLE", "RESET"}));
    }
  } else if (lexer_.acceptKeyword("MIRROR")) {
    name = lexer_.acceptKeyword("RESET") ? "TRANS MIRROR RESET" : "TRANS MIRROR AXIS";
    if (name == "TRANS MIRROR AXIS") {
      if (!lexer_.acceptKeyword("AXIS")) return error("AXIS or RESET is expected after TRANS MIRROR");
      if (lexer_.atEnd()) return error("the mirrored axes are expected here", "write TRANS MIRROR AXIS X");
      if (!axisList(Axes::LettersOnly)) return false;
    }
  } else if (lexer_.acceptKeyword("ROTATION")) {
    name = lexer_.acceptKeyword("RESET") ? "TRANS ROTATION RESET" : "TRANS ROTATION";
    if (name == "TRANS ROTATION") {
      const bool incremental = lexer_.accept('I');
      if (!lexer_.acceptPrefix("ROT")) return error("ROT with an angle or RESET is expected after TRANS ROTATION");
      if (!word(addressOf("ROT"), "ROT", incremental ? WordMode::Incremental : WordMode::Plain)) return false;
    }
  } else if (lexer_.acceptKeyword("SCALE")) {
    name = lexer_.acceptKeyword("RESET") ? "TRANS SCALE RESET" : "TRANS SCALE";
    if (name == "TRANS SCALE") {
      if (!lexer_.acceptPrefix("SCL")) return error("SCL with a factor or RESET is expected after TRANS SCALE");
      if (!word(addressOf("SCL"), "SCL")) return false;
    }
  } else {
    return error("DATUM, MIRROR, ROTATION or SCALE is expected after TRANS",
                 meantWord(lexer_, {"DATUM", "MIRROR", "ROTATION", "SCALE"}));
  }
  transform.words = wordsSince(first);
  transform.name = constant(name);
  emit(transform);
  return expectEnd();
}

namespace {

/// A word after FUNCTION that is not what a control has there but nearly so; functions that are not known here pass.
std::string meantFunction(Lexer& lexer) {
  static const std::vector<std::string> functions = {
      "TCPM", "MODE",    "RESET",     "AFC",       "CORRDATA", "COUNT", "DCM",     "DRESS",   "DWELL",   "FACING",
      "FEED", "LIFTOFF", "PARAXCOMP", "PARAXMODE", "POLARKIN", "PROG",  "S-PULSE", "SPINDLE", "TURNDATA"};
  const std::size_t start = (lexer.peek(), lexer.offset());
  for (const std::string& function : functions) {
    if (!lexer.acceptKeyword(function)) continue;
    lexer.seek(start);
    return {};
  }
  return meantWord(lexer, functions);
}

}  // namespace

/// FUNCTION TCPM becomes Modal "FUNCTION TCPM" with the words F (1 = F TCP, 0 = F CONT), AXIS (1 = AXIS POS, 0 = AXIS
/// SPAT), PATH (1 = PATHCTRL AXIS, 0 = PATHCTRL VECTOR), REFP (REFPNT 0 = TIP-TIP, 1 = TIP-CENTER, 2 = CENTER-CENTER),
/// FLIM (the limit of the feed, absent: FMAX);
/// FUNCTION RESET TCPM becomes Modal "FUNCTION RESET TCPM"; all
/// others are Command "FUNCTION" with their text.
bool BlockParser::functionKeyword() {
  const auto choice = [&](std::string_view address, std::string_view one, std::string_view zero) {
    const bool isOne = lexer_.acceptKeyword(one);
    if (!isOne && !lexer_.acceptKeyword(zero)) {
      return error(std::string(one).append(" or ").append(zero).append(" is expected here"));
    }
    addWord(addressOf(address), Operand::of(isOne ? 1 : 0));
    return true;
  };
  if (lexer_.acceptKeyword("RESET")) {
    if (lexer_.acceptKeyword("TCPM")) {
      emit(Modal{constant("FUNCTION RESET TCPM"), {}});
      return expectEnd();
    }
    if (std::string meant = meantFunction(lexer_); !meant.empty())
      return error("this is not a function that FUNCTION RESET resets", std::move(meant));
    emit(Command{constant(nameOf(CommandKind::FunctionReset)), ref(lexer_.restOfBlock()), -1, {}});
    return true;
  }
  if (!lexer_.acceptKeyword("TCPM")) {
    const std::size_t start = (lexer_.peek(), lexer_.offset());
    if (lexer_.acceptKeyword("MODE")) {
      const bool known = lexer_.acceptKeyword("MILL") || lexer_.acceptKeyword("TURN") ||
                         lexer_.acceptKeyword("GRIND") || lexer_.acceptKeyword("DRESS") || lexer_.acceptKeyword("SET");
      if (!known) {
        return error("MILL, TURN, GRIND, DRESS or SET is expected after FUNCTION MODE",
                     meantWord(lexer_, {"MILL", "TURN", "GRIND", "DRESS", "SET"}));
      }
      lexer_.seek(start);
    } else if (std::string meant = meantFunction(lexer_); !meant.empty()) {
      return error("this is not a word of a FUNCTION block", std::move(meant));
    }
    return textCommand(CommandKind::Function);
  }
  const std::size_t first = block_.words.size();
  while (!lexer_.atEnd()) {
    const std::size_t start = (lexer_.peek(), lexer_.offset());
    if (lexer_.acceptKeyword("F")) {
      const bool tcp = lexer_.acceptKeyword("TCP");
      if (tcp || lexer_.acceptKeyword("CONT")) {
        addWord(addressOf("F"), Operand::of(tcp ? 1 : 0));
        continue;
      }
      if (isLetter(lexer_.peek()) && !variableFollows())
        return error("TCP, CONT or a feed is expected after F", meantWord(lexer_, {"TCP", "CONT"}));
    }
    lexer_.seek(start);
    if (lexer_.peek() == 'F') {  // the feed limit of the compensating movement
      bool rapid = false;
      bool automatic = false;
      Operand feed;
      if (!feedWord(feed, &rapid, &automatic)) return false;
      addWord(addressOf("FLIM"), feed);
    } else if (lexer_.acceptKeyword("AXIS")) {
      if (!choice("AXIS", "POS", "SPAT")) return false;
    } else if (lexer_.acceptKeyword("PATHCTRL")) {
      if (!choice("PATH", "AXIS", "VECTOR")) return false;
    } else if (lexer_.acceptKeyword("REFPNT")) {
      static constexpr std::array<std::string_view, 3> points = {"TIP-TIP", "TIP-CENTER", "CENTER-CENTER"};
      const std::string written = upperCase(lexer_.chunk());
      const auto point = std::ranges::find(points, written);
      if (point == points.end()) return error("TIP-TIP, TIP-CENTER or CENTER-CENTER is expected after REFPNT");
      addWord(addressOf("REFP"), Operand::of(static_cast<double>(point - points.begin())));
    } else {
      return error("F TCP, F CONT, AXIS POS, AXIS SPAT, PATHCTRL or REFPNT is expected here");
    }
  }
  if (!eachOnce(first, "block")) return false;
  const WordRange words = wordsSince(first);
  emit(Modal{constant("FUNCTION TCPM"), words});
  return true;
}

/// PRESET SELECT #5 [KEEP TRANS] [WP] | PRESET COPY #1 TO #5 [SELECT TARGET [KEEP TRANS]] | PRESET CORR X+1: words #
/// and TO with the rows, axes, and without value KEEP and SEL. A row may be named by its DOC text instead: #, TO as
/// text.
bool BlockParser::presetKeyword() {
  const std::size_t first = block_.words.size();
  CommandKind kind = CommandKind::PresetSelect;
  const auto row = [&](std::string_view address, std::string_view behind) {
    if (const std::optional<std::string_view> text = lexer_.quoted()) {
      addWord(addressOf(address), textOperand(ref(*text)));
      return true;
    }
    return expect('#', behind) && word(addressOf(address), "the row of the preset table");
  };
  const auto keepTransformations = [&]() {
    if (!lexer_.acceptKeyword("KEEP")) return true;
    if (!lexer_.acceptKeyword("TRANS")) return error("TRANS is expected after KEEP");
    addWord(addressOf("KEEP"), {});
    return true;
  };
  if (lexer_.acceptKeyword("SELECT")) {
    kind = CommandKind::PresetSelect;
    if (!row("#", nameOf(kind)) || !keepTransformations()) return false;
    lexer_.acceptKeyword("WP");
    if (!keepTransformations()) return false;
  } else if (lexer_.acceptKeyword("COPY")) {
    kind = CommandKind::PresetCopy;
    if (!row("#", nameOf(kind))) return false;
    if (!lexer_.acceptKeyword("TO")) return error("TO #row is expected here");
    if (!row("TO", "TO")) return false;
    if (lexer_.acceptKeyword("SELECT")) {
      if (!lexer_.acceptKeyword("TARGET")) return error("TARGET is expected after SELECT");
      addWord(addressOf("SEL"), {});
      if (!keepTransformations()) return false;
    }
  } else if (lexer_.acceptKeyword("CORR")) {
    kind = CommandKind::PresetCorrection;
    if (lexer_.atEnd()) return error("an axis with its correction is expected here", "write PRESET CORR X+0.1");
    while (!lexer_.atEnd()) {
      const auto angle = std::ranges::find_if(spaceAngleWords, [&](auto word) { return lexer_.acceptPrefix(word); });
      if (angle != spaceAngleWords.end()) {
        if (!word(addressOf(*angle), *angle)) return false;
      } else if (!listedAxis(Axes::WithValues)) {
        return false;
      }
    }
  } else {
    return error("SELECT, COPY or CORR is expected after PRESET", meantWord(lexer_, {"SELECT", "COPY", "CORR"}));
  }
  if (!eachOnce(first, "block")) return false;
  const WordRange words = wordsSince(first);
  emit(Command{constant(nameOf(kind)), {}, -1, words});
  return expectEnd();
}

}  // namespace probewright::language::klartext

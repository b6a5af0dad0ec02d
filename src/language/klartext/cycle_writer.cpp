#include "language/klartext/cycle_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "cycles/heidenhain/probe_words.hpp"
#include "language/klartext/block_extent.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/formula_writer.hpp"
#include "language/klartext/lexer.hpp"

namespace probewright::language::klartext {

namespace {

namespace probe_word = cycles::heidenhain::probe_word;
constexpr std::string_view axisLetters = "XYZABCUVW";

std::span<const Word> wordsOf(const Block& block, WordRange range) {
  return std::span<const Word>(block.words).subspan(range.first, range.count);
}

std::string_view sourceLine(const Block& block, std::uint32_t line) {
  std::string_view text = block.at(block.source);
  for (; line > 0; --line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  while (!text.empty() && (isBlankOrReturn(text.back()) || text.back() == '~'))
    text.remove_suffix(1);
  return text;
}

/// The name after the number of a cycle in the block's own text, up to its first parameter.
std::string cycleTitle(const Block& block) {
  Lexer lexer(withoutBlockNumber(sourceLine(block, 0)));
  const bool known = (lexer.acceptPrefix("TCH") && lexer.acceptPrefix("PROBE")) || lexer.acceptPrefix("CYCL DEF") ||
                     lexer.acceptPrefix("GLOBAL DEF");
  // In DIN/ISO cycles with names have three digits.
  const bool dinIso = !known && lexer.acceptPrefix("G") && isDigit(lexer.here(1)) && isDigit(lexer.here(2));
  if (!known && !dinIso) return {};
  lexer.peek();
  while (isDigit(lexer.here()) || lexer.here() == '.')
    lexer.advance();
  std::string_view title = lexer.restOfLine();
  // Parameters in the first line are written below it.
  for (std::size_t i = 0; i + 1 < title.size(); ++i) {
    const bool begins = upper(title[i]) == 'Q' && (i == 0 || isBlankOrReturn(title[i - 1]));
    if (!begins) continue;
    const std::size_t end = title.find_first_not_of("QSLRqslr0123456789 \t", i);
    const bool parameter = end != std::string_view::npos && title[end] == '=';
    if (parameter) title = title.substr(0, i);
  }
  title = trimmedAtEnd(title, blanksAndReturn);
  return std::string(title);
}

/// The title of an old-form cycle; its usual one if the block's text has none.
std::string titleOfParts(const Block& block, int number) {
  std::string title = cycleTitle(block);
  if (!title.empty()) return title;
  switch (number) {
    case 7:
      return "DATUM SHIFT";
    case 8:
      return "MIRROR IMAGE";
    case 9:
      return "DWELL TIME";
    case 10:
      return "ROTATION";
    case 11:
      return "SCALING FACTOR";
    case 12:
      return "PGM CALL";
    case 13:
      return "ORIENTATION";
    case 19:
      return "WORKING PLANE";
    case 32:
      return "TOLERANCE";
    default:
      return title;
  }
}

std::string headOf(std::string_view kind, int number, const std::string& title) {
  return title.empty() ? fmt::format("{} {}", kind, number) : fmt::format("{} {} {}", kind, number, title);
}

std::string unsignedValue(const Block& block, const Operand& operand) {
  const std::string text = writeValue(block, operand);
  return text.starts_with('+') ? text.substr(1) : text;
}

}  // namespace

std::string_view feedPerTurn(const Block& block, const Word& word) {
  if (word.value.node < 0) return {};
  const Node& node = block.nodes[static_cast<std::size_t>(word.value.node)];
  if (node.operation != Operation::Call || node.function != Function::Host) return {};
  const std::string_view written = block.at(node.text);
  return written == "FU" || written == "FZ" ? written : std::string_view();
}

namespace {

std::string parameterText(const Block& block, const Word& word) {
  std::string_view name = "Q";
  if (word.value.node >= 0) {
    const Node& node = block.nodes[static_cast<std::size_t>(word.value.node)];
    const std::string_view written = block.at(node.text);
    if (node.operation == Operation::Text) {
      if (written == "FMAX" || written == "FAUTO") return fmt::format("Q{}={}", word.address, written);
      name = "QS";
    } else if (node.operation == Operation::Call && node.function == Function::Host && written == "PREDEF") {
      return fmt::format("Q{}=PREDEF", word.address);
    } else if (!feedPerTurn(block, word).empty()) {
      return fmt::format("Q{}={}{}", word.address, written, unsignedValue(block, block.operands[node.a]));
    }
  }
  return fmt::format("{}{}={}", name, word.address, writeValue(block, word.value));
}

std::string parameterCycle(const Block& block, std::string_view kind, int number, std::span<const Word> words) {
  std::string text = headOf(kind, number, cycleTitle(block));
  for (const Word& word : words) {
    text += fmt::format(" ~\n    {}", parameterText(block, word));
    const std::string_view comment = commentOfLine(block, word.line);
    if (!comment.empty()) text += fmt::format(" {}", comment);
  }
  return text;
}

/// The parts of an old-form cycle: each entry is the text after "TCH PROBE n.k".
std::string inParts(std::string_view kind, int number, const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += '\n';
    text += fmt::format("{} {}.{}{}{}", kind, number, i, parts[i].empty() ? "" : " ", parts[i]);
  }
  return text;
}

std::string axisName(double index) { return std::string(axisLetters.substr(static_cast<std::size_t>(index), 1)); }

class ProbeParts {
public:
  ProbeParts(const Block& block, const CycleCall& call) : block_(block), words_(wordsOf(block, call.parameters)) {}

  std::vector<std::string> parts(int number) const {
    const std::string title = cycleTitle(block_);
    switch (number) {
      case 0:
        return {fmt::format("REF. PLANE Q{} {}{}", literal(probe_word::result), axisName(literal(probe_word::axis)),
                            literal(probe_word::direction) > 0 ? "+" : "-"),
                coordinates()};
      case 1:
        return {title, fmt::format("{} ANGLE: {}", axisName(literal(probe_word::axis)), text(probe_word::angle)),
                coordinates()};
      case 2:
        return {title, fmt::format("HEIGHT: {} R {} DIRECTION: {}", text(probe_word::height), text(probe_word::radius),
                                   text(probe_word::outside))};
      case 3: {
        std::vector<std::string> parts = {
            title, fmt::format("Q{}", literal(probe_word::result)),
            fmt::format("{} ANGLE: {}", axisName(literal(probe_word::axis)), text(probe_word::angle)), path()};
        if (find(probe_word::errorMode)) parts.push_back(fmt::format("ERRORMODE {}", text(probe_word::errorMode)));
        return parts;
      }
      case 4:
        return {title, fmt::format("Q{}", literal(probe_word::result)), coordinates(), path()};
      case 9:
        return {title, fmt::format("DATUM {} REFERENCE SYSTEM {}", text(probe_word::datum),
                                   text(probe_word::referenceSystem))};
      case 30:
        return {title, fmt::format("HEIGHT: {}", text(probe_word::height))};
      default: {
        std::string check = fmt::format("CHECK: {}", text(probe_word::check));
        if (find(probe_word::result)) check += fmt::format(" Q{}", literal(probe_word::result));
        std::vector<std::string> parts = {title, check, fmt::format("HEIGHT: {}", text(probe_word::height))};
        if (find(probe_word::teeth)) parts.push_back(fmt::format("PROBING THE TEETH: {}", text(probe_word::teeth)));
        return parts;
      }
    }
  }

private:
  const Word* find(std::uint32_t address) const {
    const auto found = std::ranges::find(words_, address, &Word::address);
    return found == words_.end() ? nullptr : &*found;
  }
  double literal(std::uint32_t address) const {
    const Word* word = find(address);
    return word == nullptr ? 0 : word->value.number;
  }
  std::string text(std::uint32_t address) const {
    const Word* word = find(address);
    return word == nullptr ? std::string("+0") : writeValue(block_, word->value);
  }
  std::string coordinates() const {
    std::string out;
    for (const Word& word : words_) {
      if (word.address < probe_word::coordinate) continue;
      out += fmt::format("{}{}{}{}", out.empty() ? "" : " ", word.mode == WordMode::Incremental ? "I" : "",
                         axisName(word.address - probe_word::coordinate), writeValue(block_, word.value));
    }
    return out;
  }
  std::string path() const {
    const Word* back = find(probe_word::retraction);
    std::string out = fmt::format("DIST {}", text(probe_word::distance));
    out += find(probe_word::feed) ? fmt::format(" F{}", text(probe_word::feed)) : std::string(" FMAX");
    out += back != nullptr && !back->value.present() ? std::string(" MB MAX")
                                                     : fmt::format(" MB{}", text(probe_word::retraction));
    if (find(probe_word::referenceSystem)) {
      out += fmt::format(" REFERENCE SYSTEM: {}", text(probe_word::referenceSystem));
    }
    return out;
  }

  const Block& block_;
  std::span<const Word> words_;
};

/// Words with incremental signs, blanks between. The row of a table has no sign.
std::string plainWords(const Block& block, std::span<const Word> words) {
  std::string out;
  for (const Word& word : words) {
    const bool isRow = word.address == '#';
    out += fmt::format("{}{}{}{}", out.empty() ? "" : " ", word.mode == WordMode::Incremental ? "I" : "",
                       addressName(word.address),
                       isRow ? unsignedValue(block, word.value) : writeValue(block, word.value));
  }
  return out;
}

/// PRESET SELECT and PRESET COPY.
std::string presetText(const Block& block, std::string_view name, std::span<const Word> words) {
  std::string out(name);
  for (const Word& word : words) {
    const std::string address = addressName(word.address);
    if (address == "KEEP") {
      out += " KEEP TRANS";
    } else if (address == "SEL") {
      out += " SELECT TARGET";
    } else {
      const std::string row = unsignedValue(block, word.value);
      out += fmt::format(" {}{}{}", address == "TO" ? "TO " : "", row.starts_with('"') ? "" : "#", row);
    }
  }
  return out;
}

std::string_view planeWord(std::uint32_t address) {
  struct Named {
    std::string_view address, written;
  };
  static constexpr std::array<Named, 7> names = {{{"PROP", "PROPR"},
                                                  {"PROM", "PROMIN"},
                                                  {"EULP", "EULPR"},
                                                  {"EULN", "EULNU"},
                                                  {"EULR", "EULROT"},
                                                  {"TABL", "TABLE ROT"},
                                                  {"COOR", "COORD ROT"}}};
  for (const Named& name : names) {
    if (addressOf(name.address) == address) return name.written;
  }
  return {};
}

std::string planeWords(const Block& block, std::span<const Word> words) {
  std::string out;
  for (const Word& word : words) {
    const std::string_view own = planeWord(word.address);
    const std::string name = own.empty() ? addressName(word.address) : std::string(own);
    if (word.address == addressOf("SEQ") || word.address == addressOf("SYM")) {
      out += fmt::format(" {}{}", name, word.value.number > 0 ? '+' : '-');
    } else if (word.address == addressOf("MB") && !word.value.present()) {
      out += " MB MAX";
    } else if (word.address == addressOf("F")) {
      out += fmt::format(" F{}", unsignedValue(block, word.value));
    } else {
      out += fmt::format(" {}{}{}", word.mode == WordMode::Incremental ? "I" : "", name, writeValue(block, word.value));
    }
  }
  return out;
}

}  // namespace

std::string_view commentOfLine(const Block& block, std::uint32_t line) {
  const std::string_view text = sourceLine(block, line);
  bool inText = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') inText = !inText;
    if (text[i] == ';' && !inText) return text.substr(i);
  }
  return {};
}

std::string commentOf(const Block& block) {
  std::string comment(commentOfLine(block, 0));
  const auto lines = static_cast<std::uint32_t>(std::ranges::count(block.at(block.source), '\n'));
  for (std::uint32_t line = 1; line <= lines; ++line) {
    if (comment.empty()) {
      comment = commentOfLine(block, line);
    } else {
      comment.append(" ~\n").append(sourceLine(block, line));
    }
  }
  return comment;
}

std::string writeCycle(const Block& block, const CycleCall& call) {
  const std::string_view kind = block.at(call.name);
  const std::span<const Word> words = wordsOf(block, call.parameters);
  const bool touchProbe = kind == "TCH PROBE";
  const bool oldForm = touchProbe && (call.number <= 4 || call.number == 9 || (call.number >= 30 && call.number <= 33));
  if (oldForm) return inParts(kind, call.number, ProbeParts(block, call).parts(call.number));
  if (words.empty()) {
    // The parts of old machining cycles are kept as they stand.
    std::string text;
    for (std::string_view rest = block.at(block.source); !rest.empty();) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      std::string_view line = withoutBlockNumber(rest.substr(0, end));
      line = trimmedAtEnd(line, blanksAndReturn);
      text += fmt::format("{}{}", text.empty() ? "" : "\n", line);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return text;
  }
  return parameterCycle(block, kind, call.number, words);
}

std::string writeTransform(const Block& block, const Transform& transform) {
  const TransformKind kind = kindOf(block, transform);
  const std::string_view name = nameOf(kind);
  const std::span<const Word> words = wordsOf(block, transform.words);
  if (isPlane(kind)) return std::string(name) + planeWords(block, words);
  if (isTrans(kind)) {
    std::string text(name);
    if (transform.option.length > 0) text += fmt::format(" \"{}\"", block.at(transform.option));
    for (const Word& word : words) {
      const std::string_view sign = word.mode == WordMode::Incremental ? "I" : "";
      text += word.address == '#'
                  ? fmt::format(" TABLINE {}", unsignedValue(block, word.value))
                  : fmt::format(" {}{}{}", sign, addressName(word.address), writeValue(block, word.value));
    }
    return text;
  }
  if (kind == TransformKind::PresetByCycle) return parameterCycle(block, "CYCL DEF", 247, words);
  const int number = std::stoi(std::string(name.substr(name.rfind(' ') + 1)));
  std::vector<std::string> parts = {titleOfParts(block, number)};
  if (number == 7) {
    for (const Word& word : words)
      parts.push_back(plainWords(block, {&word, 1}));
  } else {
    const std::string text = number == 19 ? planeWords(block, words) : plainWords(block, words);
    parts.push_back(text.substr(std::min(text.find_first_not_of(' '), text.size())));
  }
  return inParts("CYCL DEF", number, parts);
}

std::string writeCommand(const Block& block, const Command& command) {
  const CommandKind kind = kindOf(block, command);
  const std::string_view name = nameOf(kind);
  const std::string_view text = block.at(command.text);
  const std::span<const Word> words = wordsOf(block, command.words);
  const auto value = [&](std::size_t i) {
    return i < words.size() ? writeValue(block, words[i].value) : std::string();
  };
  const std::string variable =
      command.variable < 0 ? std::string() : writeVariable(block.variables[static_cast<std::size_t>(command.variable)]);
  if (kind == CommandKind::Fn14) return fmt::format("FN 14: ERROR = {}", value(0));
  if (kind == CommandKind::Fn17 || kind == CommandKind::Fn18) {
    const bool writes = kind == CommandKind::Fn17;
    std::string out = writes ? std::string("FN 17: SYSWRITE") : fmt::format("FN 18: SYSREAD {} =", variable);
    for (const Word& word : words) {
      const bool isValue = word.address == addressOf("VAL");
      const std::string written = isValue ? writeFormula(block, word.value) : unsignedValue(block, word.value);
      out += isValue ? fmt::format(" = {}", written) : fmt::format(" {}{}", addressName(word.address), written);
    }
    return out;
  }
  if (kind == CommandKind::Fn23 || kind == CommandKind::Fn24) {
    return fmt::format("FN {}: {} = CDATA Q{}", name.substr(2), variable, writeNumber(words[0].value.number));
  }
  if (kind == CommandKind::Fn25) {
    return fmt::format("FN 25: PRESET = {}/{}/{}", addressName(words[0].address), value(0), value(1));
  }
  if (kind == CommandKind::Fn27) {
    return fmt::format("FN 27: TABWRITE {}/\"{}\" = {}", value(0), text, variable.empty() ? value(1) : variable);
  }
  if (kind == CommandKind::Fn28) return fmt::format("FN 28: TABREAD {} = {}/\"{}\"", variable, value(0), text);
  if (kind == CommandKind::GlobalDefinition) {
    return parameterCycle(block, "GLOBAL DEF", static_cast<int>(words[0].value.number), words.subspan(1));
  }
  if (kind == CommandKind::ProgramCall)
    return inParts("CYCL DEF", 12, {titleOfParts(block, 12), fmt::format("PGM {}", writePath(text))});
  if (kind == CommandKind::DwellTime) {
    return inParts("CYCL DEF", 9, {titleOfParts(block, 9), words.empty() ? "" : fmt::format("DWELL {}", value(0))});
  }
  if (kind == CommandKind::SpindleOrientation) {
    return inParts("CYCL DEF", 13, {titleOfParts(block, 13), words.empty() ? "" : fmt::format("ANGLE {}", value(0))});
  }
  if (kind == CommandKind::Tolerance) {
    std::vector<std::string> parts = {titleOfParts(block, 32), words.empty() ? "" : fmt::format("T{}", value(0))};
    if (words.size() > 1) {
      parts.push_back(fmt::format("HSC-MODE:{}", writeNumber(words[1].value.number)));
      if (words.size() > 2) parts.back() += fmt::format(" TA{}", value(2));
    }
    return inParts("CYCL DEF", 32, parts);
  }
  if (kind == CommandKind::ToolDefinition) {
    const std::string tool = unsignedValue(block, words[0].value);
    return words.size() > 1 ? fmt::format("TOOL DEF {} {}", tool, plainWords(block, words.subspan(1)))
                            : fmt::format("TOOL DEF {}", tool);
  }
  if (kind == CommandKind::CycleCall) return fmt::format("CYCL CALL {} {}", text, plainWords(block, words));
  if (kind == CommandKind::PresetSelect || kind == CommandKind::PresetCopy) return presetText(block, name, words);
  if (kind == CommandKind::PresetCorrection) return fmt::format("PRESET CORR {}", plainWords(block, words));
  if (name.starts_with("SEL ")) {
    return words.empty() ? fmt::format("{} \"{}\"", name, text)
                         : fmt::format("{} {}", name, writeFormula(block, words[0].value));
  }
  if (kind == CommandKind::SetUndefined) return fmt::format("FN 0: {} SET UNDEFINED", variable);
  if (name.starts_with("TABDATA")) {
    const std::string target = variable.empty() ? std::string() : fmt::format("{} = ", variable);
    const std::string entry = words.size() > 2 ? fmt::format(" = {}", value(2)) : std::string();
    return fmt::format("{} {}{} COLUMN {} KEY {}{}", name, target, text, writeFormula(block, words[0].value),
                       writeFormula(block, words[1].value), entry);
  }
  if (kind == CommandKind::Error) return fmt::format("ERROR = {}", text);
  if (kind == CommandKind::Fn19 || kind == CommandKind::Fn29) {
    std::string values;
    for (const Word& each : words)
      values += (values.empty() ? "" : "/") + writeValue(block, each.value);
    return fmt::format("FN {}: PLC={}", name.substr(2), values);
  }
  if (isFunction(kind)) {
    const std::string_view number = name.substr(2);
    const std::string_view keyword = number == "15"   ? "PRINT "
                                     : number == "16" ? "F-PRINT "
                                     : number == "20" ? "WAIT FOR "
                                     : number == "26" ? "TABOPEN "
                                     : number == "37" ? "EXPORT "
                                     : number == "38" ? "SEND "
                                                      : "";
    return fmt::format("FN {}: {}{}", number, keyword, text);
  }
  return text.empty() ? std::string(name) : fmt::format("{} {}", name, text);
}

}  // namespace probewright::language::klartext

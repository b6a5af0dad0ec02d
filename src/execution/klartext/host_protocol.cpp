#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/host.hpp"
#include "language/klartext/lexer.hpp"

/// FN 16: F-PRINT mask / target. A mask holds format lines
///   "X = %9.3LF in %S", Q31, QS4;
/// and keywords. CALL_PATH writes the path of the program, M_CLOSE closes the file, M_APPEND, M_APPEND_MAX20
/// (kilobytes) and M_TRUNCATE say how it goes on, M_EMPTY_HIDE leaves out lines whose texts are empty until
/// M_EMPTY_SHOW, L_ENGLISH, L_GERMAN... restrict the lines after them to one language of the control until L_ALL. %F,
/// %LF, %D and %I take numbers, %S texts (%RS raw), %% is a percent sign, \n a new line. DAY, MONTH, STR_MONTH, YEAR2,
/// YEAR4, HOUR, MIN and SEC stand where parameters may. Lines that begin with * are comments.
namespace probewright::language::klartext {

using control::Alarm;

namespace {

constexpr std::array<std::string_view, 12> months = {"JAN", "FEB", "MAR", "APR", "MAY", "JUN",
                                                     "JUL", "AUG", "SEP", "OCT", "NOV", "DEC"};
constexpr std::size_t widestField = 200;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (isBlank(text.front()) || text.front() == '\n'))
    text.remove_prefix(1);
  while (!text.empty() && (isBlank(text.back()) || text.back() == '\n'))
    text.remove_suffix(1);
  return text;
}

[[noreturn]] void refuse(std::string text) {
  throw Alarm("FN 16: mask wrong", std::move(text), "correct the mask file of FN 16");
}

/// The statements of a mask: format lines end with ';', keywords with the line.
std::vector<std::string_view> statementsOf(std::string_view mask) {
  std::vector<std::string_view> statements;
  while (!mask.empty()) {
    mask = mask.substr(std::min(mask.find_first_not_of(" \t\r\n;"), mask.size()));
    if (mask.empty()) break;
    const bool format = mask.front() == '"';
    bool inText = false;
    std::size_t end = 0;
    for (; end < mask.size(); ++end) {
      if (mask[end] == '"' && (end == 0 || mask[end - 1] != '\\')) inText = !inText;
      if (!inText && (mask[end] == ';' || (!format && mask[end] == '\n'))) break;
    }
    if (mask.front() == '*') {
      mask = mask.substr(std::min(mask.find('\n'), mask.size()));
      continue;
    }
    statements.push_back(trimmed(mask.substr(0, end)));
    mask = mask.substr(std::min(end, mask.size()));
  }
  return statements;
}

/// Files that the run itself leaves, whatever their case.
bool isOwnFile(std::string_view name) {
  static constexpr std::array<std::string_view, 8> own = {"TOOL.T",      "TCHPROBE.TP", "PRESET.PR",    "TOOLTURN.TRN",
                                                          "AXSHIFT.TAB", "REPORT.HTML", "RESULTS.JSON", "QR.TXT"};
  return std::ranges::any_of(own, [&](std::string_view each) { return std::ranges::equal(each, name, {}, {}, upper); });
}

std::string padded(std::string text, std::size_t width, bool left) {
  if (text.size() >= width) return text;
  const std::string blanks(width - text.size(), ' ');
  return left ? text + blanks : blanks + text;
}

class LineFormatter {
public:
  LineFormatter(std::string_view line, const std::function<Value(std::string_view)>& read, const std::tm& time)
      : line_(line), read_(read), time_(time) {}

  /// True if the line had text parameters and all of them were empty.
  bool onlyEmptyTexts() const { return texts_ > 0 && texts_ == emptyTexts_; }

  std::string format() {
    std::size_t close = 1;
    while (close < line_.size() && (line_[close] != '"' || line_[close - 1] == '\\'))
      ++close;
    if (close >= line_.size()) refuse(fmt::format("the text {} is not closed by a quotation mark", excerptOf(line_)));
    if (line_.find('"', close + 1) != std::string_view::npos) {
      refuse(fmt::format("the format line {} does not end with ;", excerptOf(line_)));
    }
    const std::string_view text = line_.substr(1, close - 1);
    arguments_ = line_.substr(close + 1);
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\\' && i + 1 < text.size()) {
        ++i;
        out += text[i] == 'n' ? '\n' : text[i] == 't' ? '\t' : text[i];
      } else if (text[i] != '%') {
        out += text[i];
      } else if (i + 1 < text.size() && text[i + 1] == '%') {
        out += '%';
        ++i;
      } else {
        i = field(text, i + 1, out);
      }
    }
    if (!trimmed(arguments_).empty()) {
      refuse(fmt::format("the format line {} has more parameters than %", excerptOf(line_)));
    }
    return out;
  }

private:
  std::size_t field(std::string_view text, std::size_t i, std::string& out) {
    bool left = false;
    bool plus = false;
    bool zeros = false;
    for (; i < text.size() && std::string_view("-+0 ").find(text[i]) != std::string_view::npos; ++i) {
      left = left || text[i] == '-';
      plus = plus || text[i] == '+';
      zeros = zeros || text[i] == '0';
    }
    const auto digits = [&]() {
      std::size_t value = 0;
      for (; i < text.size() && isDigit(text[i]); ++i)
        value = std::min(value * 10 + static_cast<std::size_t>(text[i] - '0'), widestField);
      return value;
    };
    std::size_t width = digits();
    std::optional<std::size_t> decimals;
    if (i < text.size() && text[i] == '.') {
      ++i;
      decimals = std::min<std::size_t>(digits(), 15);
    }
    while (i < text.size() && (upper(text[i]) == 'L' || upper(text[i]) == 'R'))
      ++i;
    if (i >= text.size()) refuse("a format ends after its %");
    const Value value = next();
    std::string written;
    switch (upper(text[i])) {
      case 'F': {
        if (isText(value)) refuse("%F needs a number, not a text");
        written = formatFixed(std::get<double>(value), static_cast<int>(decimals.value_or(3)));
        break;
      }
      case 'D':
      case 'I':
        if (isText(value)) refuse("%D needs a number, not a text");
        written = formatFixed(std::round(std::get<double>(value)), 0);
        break;
      case 'S':
        ++texts_;
        if (isText(value) && std::get<std::string>(value).empty()) ++emptyTexts_;
        written = isText(value) ? std::get<std::string>(value) : formatShortest(std::get<double>(value));
        if (decimals) written = written.substr(0, *decimals);
        out += padded(std::move(written), width, left);
        return i;
      default:
        refuse(fmt::format("%{} is not a format; %F, %LF, %D, %I and %S are", text[i]));
    }
    if (plus && written.front() != '-') written.insert(written.begin(), '+');
    if (zeros && !left && written.size() < width) {
      const std::size_t sign = written.front() == '-' || written.front() == '+' ? 1 : 0;
      written.insert(sign, width - written.size(), '0');
    }
    out += padded(std::move(written), width, left);
    return i;
  }

  Value next() {
    arguments_ = trimmed(arguments_);
    if (arguments_.empty() || arguments_.front() != ',') refuse("a format line has more % than parameters");
    arguments_.remove_prefix(1);
    const std::size_t end = std::min(arguments_.find(','), arguments_.size());
    const std::string_view name = trimmed(arguments_.substr(0, end));
    arguments_.remove_prefix(end);
    if (name == "DAY") return static_cast<double>(time_.tm_mday);
    if (name == "MONTH") return static_cast<double>(time_.tm_mon + 1);
    if (name == "STR_MONTH") return std::string(months[static_cast<std::size_t>(std::clamp(time_.tm_mon, 0, 11))]);
    if (name == "YEAR2") return static_cast<double>(time_.tm_year % 100);
    if (name == "YEAR4") return static_cast<double>(time_.tm_year + 1900);
    if (name == "HOUR") return static_cast<double>(time_.tm_hour);
    if (name == "MIN") return static_cast<double>(time_.tm_min);
    if (name == "SEC") return static_cast<double>(time_.tm_sec);
    return read_(name);
  }

  std::string_view line_;
  std::string_view arguments_;
  int texts_ = 0;
  int emptyTexts_ = 0;
  const std::function<Value(std::string_view)>& read_;
  const std::tm& time_;
};

}  // namespace

std::string_view languageWord(control::DialogLanguage language) {
  constexpr std::array<std::string_view, 5> words = {"L_ENGLISH", "L_RUSSIAN", "L_SWEDISH", "L_CHINESE", "L_POLISH"};
  return words[static_cast<std::size_t>(language)];
}

ProtocolResult formatProtocol(std::string_view mask, const std::function<Value(std::string_view)>& read,
                              std::int64_t secondsSince1970, std::string_view callPath,
                              control::DialogLanguage language) {
  const auto seconds = static_cast<std::time_t>(secondsSince1970);
  std::tm time{};
  if (gmtime_r(&seconds, &time) == nullptr) refuse("the date of the machine's clock is out of range");
  ProtocolResult result;
  bool shown = true;
  bool hideEmpty = false;
  for (const std::string_view statement : statementsOf(mask)) {
    if (statement.front() == '"') {
      if (!shown) continue;
      LineFormatter formatter(statement, read, time);
      const std::string line = formatter.format();
      if (!hideEmpty || !formatter.onlyEmptyTexts()) result.text.append(line).append("\n");
    } else if (statement == "M_CLOSE") {
      result.close = true;
    } else if (statement == "M_APPEND") {
      result.going = ProtocolResult::Going::Append;
    } else if (statement.starts_with("M_APPEND_MAX")) {
      const auto kilobytes = parseInteger(statement.substr(12));
      if (!kilobytes || *kilobytes < 1) refuse(fmt::format("{} needs a size in kilobytes", statement));
      result.going = ProtocolResult::Going::Append;
      result.mostBytes = static_cast<std::size_t>(std::min<std::int64_t>(*kilobytes, 1'000'000)) * 1024;
    } else if (statement == "M_TRUNCATE") {
      result.going = ProtocolResult::Going::Truncate;
    } else if (statement == "M_EMPTY_HIDE" || statement == "M_EMPTY_SHOW") {
      hideEmpty = statement == "M_EMPTY_HIDE";
    } else if (statement == "CALL_PATH") {
      if (shown) result.text.append(callPath).append("\n");
    } else if (statement == "L_ALL") {
      shown = true;
    } else if (statement.starts_with("L_")) {
      shown = statement == languageWord(language);
    } else {
      refuse(fmt::format("{} is neither a format line nor a keyword", excerptOf(statement)));
    }
  }
  return result;
}

/// The parameter that a text names: "Q5", "QL3", "QS1", with or without a plus.
Value KlartextHost::readNamed(std::string_view name, Evaluation& evaluation) {
  if (name.starts_with('+')) name.remove_prefix(1);
  VariableRef variable;
  std::size_t letters = 1;
  const char kind = name.size() > 1 ? upper(name[1]) : '\0';
  if (kind == 'S') variable.space = VariableSpace::QS;
  if (kind == 'L') variable.space = VariableSpace::QL;
  if (kind == 'R') variable.space = VariableSpace::QR;
  if (variable.space != VariableSpace::Q) ++letters;
  const auto number = parseInteger(name.substr(std::min(letters, name.size())));
  if (name.empty() || upper(name[0]) != 'Q' || !number || *number < 0) {
    refuse(fmt::format("{} is not a Q parameter", excerptOf(name)));
  }
  variable.index[0] = Operand::of(static_cast<double>(*number));
  return read(variable, evaluation);
}

double KlartextHost::numberNamed(std::string_view name, Evaluation& evaluation) {
  const Value value = readNamed(name, evaluation);
  if (isText(value)) throw Alarm("Wrong data type", fmt::format("{} is a text, not a number", name));
  return std::get<double>(value);
}

/// FN 38: SEND /"X = %F" / +Q1: the text with its values, among the messages.
void KlartextHost::send(std::string_view text, Evaluation& evaluation) {
  const std::size_t open = text.find('"');
  const std::size_t close = text.rfind('"');
  if (open == std::string_view::npos || close == open) {
    message(fmt::format("FN38 {}", text));
    return;
  }
  std::string mask(text.substr(open, close + 1 - open));
  for (const char c : text.substr(close + 1))
    mask += c == '/' ? ',' : c;
  const ProtocolResult sent = formatProtocol(
      mask, [&](std::string_view name) { return readNamed(name, evaluation); },
      static_cast<std::int64_t>(machineSeconds()), levels_.back().file, control_.panel.language);
  message(fmt::format("FN 38: {}", trimmed(sent.text)));
}

/// :'QS1' or :'QL3' in a path, also with a colon after it, stands for the value of the parameter.
void KlartextHost::insertParameters(std::string& text, Evaluation& evaluation) {
  for (std::size_t at = text.find(":'Q"); at != std::string::npos; at = text.find(":'Q", at)) {
    const std::size_t end = text.find('\'', at + 2);
    if (end == std::string::npos) {
      throw Alarm("FN 16: file missing", fmt::format("the quotation mark after {} is missing", text.substr(at, 20)),
                  "write the parameter as :'QS1'");
    }
    const Value value = readNamed(std::string_view(text).substr(at + 2, end - at - 2), evaluation);
    const std::string inserted = isText(value) ? std::get<std::string>(value) : formatShortest(std::get<double>(value));
    const std::size_t behind = end + 1 < text.size() && text[end + 1] == ':' ? end + 2 : end + 1;
    text.replace(at, behind - at, inserted);
    at += inserted.size();
  }
}

void KlartextHost::protocol(const Command& command, Evaluation& evaluation) {
  std::string text(evaluation.at(command.text));
  insertParameters(text, evaluation);
  std::erase(text, '"');
  const auto trimmedPart = [&](std::size_t from, std::size_t to) {
    return std::string(trimmed(std::string_view(text).substr(from, to - from)));
  };
  const std::size_t first = text.find('/');
  if (first == std::string::npos) {
    throw Alarm("FN 16: file missing", "FN 16 needs a mask file and a target, separated by /",
                "write FN 16: F-PRINT MASK.A / LOG.TXT");
  }
  // Either path may hold slashes itself: the mask is the shortest beginning that names a file.
  std::size_t slash = first;
  Result<std::string> bytes = readHostFile(trimmedPart(0, first));
  for (std::size_t next = first; !bytes && (next = text.find('/', next + 1)) != std::string::npos;) {
    if (Result<std::string> longer = readHostFile(trimmedPart(0, next))) {
      bytes = std::move(longer);
      slash = next;
    }
  }
  if (!bytes) {
    std::string mask = trimmedPart(0, first);
    if (mask.empty()) mask = trimmedPart(0, text.rfind('/'));
    throw Alarm("FN 16: file missing", fmt::format("the mask file {}: {}", excerptOf(mask), bytes.error().message),
                "put it beside the program, or check how its name is written");
  }
  const std::string target = trimmedPart(slash + 1, text.size());

  const auto read = [&](std::string_view name) { return readNamed(name, evaluation); };
  const ProtocolResult result = formatProtocol(*bytes, read, static_cast<std::int64_t>(machineSeconds()),
                                               levels_.back().file, control_.panel.language);
  if (target == "SCLR:") return;  // closes the window of an earlier message
  if (target.starts_with("SCREEN:")) {
    if (!result.text.empty()) message(std::string(trimmed(result.text)));
    return;
  }
  writeProtocol(protocolFile(target), result);
}

/// The target of FN 16 as a name in the folder of the run.
std::string KlartextHost::protocolFile(const std::string& target) const {
  constexpr std::size_t longestName = 248;  // bytes; file systems take 255
  const std::string name = fileNameOf(target);
  const auto refuseName = [&](std::string reason) {
    throw Alarm("FN 16: file wrong", std::move(reason), "write another name after the / of FN 16");
  };
  if (name.empty()) {
    throw Alarm("FN 16: file missing", "FN 16 has no name of a file after its /",
                "write FN 16: F-PRINT MASK.A / LOG.TXT");
  }
  if (name == "." || name == "..") refuseName(fmt::format("{} is a folder, not a file", name));
  if (name.size() > longestName) {
    refuseName(fmt::format("The name {}... has {} bytes, at most {} are possible", name.substr(0, 40), name.size(),
                           longestName));
  }
  const bool table = std::ranges::any_of(
      control_.tables.datums, [&](const auto& each) { return std::ranges::equal(each.first, name, {}, upper, upper); });
  if (isOwnFile(name) || table) refuseName(fmt::format("The run writes {} itself", name));
  if (options_.isInput && options_.isInput(name)) refuseName(fmt::format("{} is read by this run", name));
  return name;
}

/// A file that stands open goes on; one that was closed, or comes from an earlier program, begins anew unless the mask
/// says otherwise.
void KlartextHost::writeProtocol(const std::string& name, const ProtocolResult& result) {
  bool& open = protocolOpen_[name];
  const auto written = control_.panel.files().find(name);
  const std::size_t size = written == control_.panel.files().end() ? 0 : written->second.size();
  const bool full = result.mostBytes > 0 && size + result.text.size() > result.mostBytes;
  const bool goesOn =
      result.going == ProtocolResult::Going::Append || (open && result.going == ProtocolResult::Going::AsOpen);
  if (full) {
    message(fmt::format("FN 16: {} has reached the size that M_APPEND_MAX allows", name));
  } else if (goesOn) {
    control_.panel.appendToFile(name, result.text);
  } else {
    control_.panel.file(name, result.text);
  }
  open = !result.close;
}

}  // namespace probewright::language::klartext

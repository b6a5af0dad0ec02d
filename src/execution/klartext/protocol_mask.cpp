#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "control/alarm.hpp"
#include "execution/format_field.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/protocol_mask.hpp"
#include "language/klartext/lexer.hpp"

/// FN 16: F-PRINT mask / target. A mask holds format lines
///   "X = %9.3LF in %S", Q31, QS4;
/// and keywords. CALL_PATH writes the path of the program, M_CLOSE closes the file, M_APPEND, M_APPEND_MAX20
/// (kilobytes) and M_TRUNCATE say how it goes on, M_EMPTY_HIDE leaves out lines whose texts are empty until
/// M_EMPTY_SHOW, L_ENGLISH, L_GERMAN... restrict the lines after them to one language of the control until L_ALL. %F,
/// %LF, %D and %I take numbers, %S texts (%RS raw), %% is a percent sign, \n a new line. DAY, MONTH, STR_MONTH, YEAR2,
/// YEAR4, HOUR, MIN and SEC stand where parameters may. Lines that begin with * are comments.
namespace probewright::execution::klartext {

using control::Alarm;

namespace {

constexpr std::array<std::string_view, 12> months = {"JAN", "FEB", "MAR", "APR", "MAY", "JUN",
                                                     "JUL", "AUG", "SEP", "OCT", "NOV", "DEC"};
constexpr FormatLimits limits = {.flags = "-+0 ", .width = 200, .decimals = 15};

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
    statements.push_back(trimmed(mask.substr(0, end), lineBlanks));
    mask = mask.substr(std::min(end, mask.size()));
  }
  return statements;
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
    if (!trimmed(arguments_, lineBlanks).empty()) {
      refuse(fmt::format("the format line {} has more parameters than %", excerptOf(line_)));
    }
    return out;
  }

private:
  std::size_t field(std::string_view text, std::size_t i, std::string& out) {
    const FormatField field = readField(text, i, limits);
    while (i < text.size() && (upper(text[i]) == 'L' || upper(text[i]) == 'R'))
      ++i;
    if (i >= text.size()) refuse("a format ends after its %");
    const Value value = next();
    std::string written;
    switch (upper(text[i])) {
      case 'F': {
        if (isText(value)) refuse("%F needs a number, not a text");
        written = formatFixed(std::get<double>(value), static_cast<int>(field.decimals.value_or(3)));
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
        if (field.decimals) written = written.substr(0, *field.decimals);
        out += filled(std::move(written), field, Content::Text);
        return i;
      default:
        refuse(fmt::format("%{} is not a format; %F, %LF, %D, %I and %S are", text[i]));
    }
    out += filled(std::move(written), field, Content::Number);
    return i;
  }

  Value next() {
    arguments_ = trimmed(arguments_, lineBlanks);
    if (arguments_.empty() || arguments_.front() != ',') refuse("a format line has more % than parameters");
    arguments_.remove_prefix(1);
    const std::size_t end = std::min(arguments_.find(','), arguments_.size());
    const std::string_view name = trimmed(arguments_.substr(0, end), lineBlanks);
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
  constexpr std::array<std::string_view, 6> words = {"L_ENGLISH", "L_RUSSIAN", "L_SWEDISH",
                                                     "L_CHINESE", "L_POLISH",  "L_GERMAN"};
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

}  // namespace probewright::execution::klartext

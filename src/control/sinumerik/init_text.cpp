#include "control/sinumerik/init_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "control/sinumerik/text.hpp"

namespace probewright::control::sinumerik {

namespace {

bool isSpace(char c) { return isBlankOrReturn(c) || c == '\n'; }
bool beginsName(char c) { return isLetter(c) || c == '_' || c == '$'; }
bool isNameCharacter(char c) { return beginsName(c) || isDigit(c); }

std::string printable(std::string_view text) {
  std::string excerpt(text.substr(0, 120));
  for (char& c : excerpt) {
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  }
  while (!excerpt.empty() && (excerpt.back() == '?' || excerpt.back() == ' '))
    excerpt.pop_back();
  return excerpt;
}

/// A mistake within a line, for the one place that makes a diagnostic of it.
struct Mistake {
  std::size_t at;
  std::string message, advice;
};

std::optional<double> parseBased(std::string_view digits, double base) {
  double value = 0;
  if (digits.empty()) return std::nullopt;
  for (const char c : digits) {
    double digit = 99;
    if (isDigit(c)) digit = c - '0';
    if (c >= 'A' && c <= 'F') digit = c - 'A' + 10;
    if (c >= 'a' && c <= 'f') digit = c - 'a' + 10;
    if (digit >= base) return std::nullopt;
    value = value * base + digit;
  }
  return value < 9007199254740992.0 ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<double> parseNumber(std::string_view text) {
  if (text.size() >= 4 && text.front() == '\'' && text.back() == '\'') {
    const char base = text[1];
    const std::string_view digits = text.substr(2, text.size() - 3);
    if (base == 'H' || base == 'h') return parseBased(digits, 16);
    if (base == 'B' || base == 'b') return parseBased(digits, 2);
    return std::nullopt;
  }
  const std::string upper = upperCase(text);
  const std::size_t exponentAt = upper.find("EX");
  const auto mantissa = parseDecimal(std::string_view(text).substr(0, std::min(exponentAt, text.size())));
  if (!mantissa) return std::nullopt;
  if (exponentAt == std::string::npos) return mantissa;
  const auto exponent = parseInteger(text.substr(exponentAt + 2));
  if (!exponent || *exponent < -330 || *exponent > 330) return std::nullopt;
  // Decimal text is rounded once, so the exponent goes back into the text.
  const std::size_t sign = text[0] == '+' ? 1 : 0;
  const std::string scientific = fmt::format("{}e{}", text.substr(sign, exponentAt - sign), *exponent);
  double value = 0;
  const char* last = scientific.data() + scientific.size();
  const auto [end, error] = std::from_chars(scientific.data(), last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Reads one text. Positions are bytes in the current line.
class InitText::Reader {
public:
  Reader(InitText& text, std::string file, DataStore& store, Diagnostics& diagnostics, int channel,
         const ArraySizes& sizes)
      : text_(text),
        file_(std::move(file)),
        store_(store),
        diagnostics_(diagnostics),
        sizes_(sizes),
        wanted_(channel) {}

  void readAll() {
    text_.insertLine_ = firstEnd_ = text_.lines_.size();
    for (line_ = 0; line_ < text_.lines_.size(); ++line_) {
      content_ = text_.lines_[line_];
      at_ = 0;
      try {
        readLine();
      } catch (const Mistake& mistake) {
        diagnostics_.push_back(
            {Severity::Error, place(mistake.at), mistake.message, printable(content_), mistake.advice, {}});
      }
    }
    if (wanted_ != 1 && !sawChannel_) {
      text_.insertLine_ = firstEnd_;
      text_.newSection_ = fmt::format("CHANDATA({})", wanted_);
    }
  }

private:
  SourcePlace place(std::size_t at) const { return {file_, line_ + 1, static_cast<std::uint32_t>(at + 1)}; }
  bool atEnd() const { return at_ >= content_.size() || content_[at_] == ';'; }
  char peek() const { return at_ < content_.size() ? content_[at_] : '\0'; }
  void skipBlanks() {
    while (at_ < content_.size() && isSpace(content_[at_]))
      ++at_;
  }
  std::string_view readWord() {
    const std::size_t begin = at_;
    while (at_ < content_.size() && isNameCharacter(content_[at_]))
      ++at_;
    return content_.substr(begin, at_ - begin);
  }
  [[noreturn]] void fail(std::size_t at, std::string message, std::string advice = {}) const {
    throw Mistake{at, std::move(message), std::move(advice)};
  }
  void note(std::size_t at, std::string message) {
    diagnostics_.push_back({Severity::Note, place(at), std::move(message), printable(content_), {}, {}});
  }
  void expect(char wanted, std::string_view advice) {
    skipBlanks();
    if (peek() != wanted) fail(at_, fmt::format("'{}' expected", wanted), std::string(advice));
    ++at_;
  }

  void readLine() {
    if (line_ == 0 && content_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    skipBlanks();
    if (peek() == '%') return;
    if (peek() == '/') ++at_;
    skipBlockNumber();
    for (skipBlanks(); !atEnd(); skipBlanks()) {
      if (!readStatement()) return;
    }
  }

  void skipBlockNumber() {
    skipBlanks();
    std::size_t i = at_;
    if (peek() != 'N' && peek() != 'n' && peek() != ':') return;
    ++i;
    const std::size_t digits = i;
    while (i < content_.size() && isDigit(content_[i]))
      ++i;
    if (i > digits && (i == content_.size() || !isNameCharacter(content_[i]))) at_ = i;
  }

  /// False: the rest of the line has no meaning here.
  bool readStatement() {
    const std::size_t begin = at_;
    if (!beginsName(peek())) {
      note(begin, "this statement is kept but not used");
      return false;
    }
    const std::string word = upperCase(readWord());
    if (word == "CHANDATA") return readChannel();
    if (word == "M17" || word == "M30" || word == "M2" || word == "M02" || word == "RET") {
      if (current_ == wanted_) text_.insertLine_ = std::min(text_.insertLine_, line_);
      firstEnd_ = std::min(firstEnd_, line_);
      return true;
    }
    skipBlanks();
    if (peek() != '[' && peek() != '=') {
      note(begin, "this statement is kept but not used");
      return false;
    }
    readAssignment(word);
    return true;
  }

  bool readChannel() {
    expect('(', "write CHANDATA(1)");
    const std::size_t begin = at_;
    while (isDigit(peek()))
      ++at_;
    const auto number = parseInteger(content_.substr(begin, at_ - begin));
    if (!number || *number < 1 || *number > 99) fail(begin, "the number of a channel is expected", "write CHANDATA(1)");
    expect(')', "write CHANDATA(1)");
    // New data of the wanted channel belong before the data of the next one.
    if (current_ == wanted_ && *number != wanted_) text_.insertLine_ = std::min(text_.insertLine_, line_);
    if (*number == wanted_ && !sawChannel_) text_.insertLine_ = text_.lines_.size();
    if (*number == wanted_) sawChannel_ = true;
    current_ = static_cast<int>(*number);
    return true;
  }

  std::vector<DataIndex> readIndices() {
    std::vector<DataIndex> indices;
    skipBlanks();
    if (peek() != '[') return indices;
    const std::size_t open = at_;
    do {
      ++at_;
      skipBlanks();
      const std::size_t begin = at_;
      if (peek() == '-' || peek() == '+') ++at_;
      readWord();
      if (at_ == begin) fail(at_, "an index is expected", "indices are numbers, axes or TR, FI, RT, SC, MI");
      indices.emplace_back(content_.substr(begin, at_ - begin));
      skipBlanks();
    } while (peek() == ',');
    if (peek() != ']') fail(open, "the bracket is not closed", "write ] after the last index");
    ++at_;
    return indices;
  }

  void readAssignment(std::string_view word) {
    const std::vector<DataIndex> indices = readIndices();
    const DataKey key(word, indices);
    expect('=', "write the datum, = and its value");
    skipBlanks();
    Assignment assignment;
    assignment.line = line_;
    assignment.begin = at_;
    const bool known = readValue(key, assignment);
    assignment.end = at_;
    if (!known) {
      note(assignment.begin,
           fmt::format("the value of {} is not a constant; the line is kept but not used", key.text()));
      while (!atEnd())
        ++at_;
      return;
    }
    for (const auto& [each, value] : assignment.values)
      requireIndices(each, assignment.begin);
    if (current_ != wanted_) return;
    if (assignment.form == Form::FrameChain) {
      store_.loadFrame(assignment.frame, frame_);
    } else {
      for (const auto& [each, value] : assignment.values)
        store_.load(each, value);
    }
    text_.assignments_.push_back(std::move(assignment));
  }

  /// No array has negative indices or so many elements; R parameters end at 9999.
  void requireIndices(const DataKey& key, std::size_t at) const {
    constexpr long long mostElements = 999'999, lastParameter = 9999;
    for (const std::string& index : key.indices) {
      const bool isNumber = isDigit(index[0]) || index[0] == '-' || index[0] == '+';
      const auto number = parseInteger(index);
      if (!isNumber || (number && *number >= 0 && *number <= (key.name == "R" ? lastParameter : mostElements)))
        continue;
      if (key.name == "R")
        fail(at, fmt::format("there is no R parameter {}", index), "R parameters have the numbers 0 to 9999");
      fail(at, fmt::format("{} has no element with the index {}", key.name, index),
           "indices are whole numbers from 0 to 999999, axes or TR, FI, RT, SC, MI");
    }
  }

  bool readValue(const DataKey& key, Assignment& assignment) {
    if (atEnd()) fail(at_, "a value is expected after =", "write a number, a string in quotation marks or a frame");
    const std::size_t begin = at_;
    if (beginsName(peek())) {
      const std::string word = upperCase(readWord());
      skipBlanks();
      if (word == "SET" && peek() == '(') return readList(key, assignment);
      if (peek() == '(' && isFrameFunction(word)) {
        at_ = begin;
        return readFrame(key, assignment);
      }
      at_ = begin;
    }
    const auto value = readConstant();
    if (!value) {
      at_ = begin;
      return false;
    }
    // An operator after the constant makes it an expression.
    if (operatorFollows() || (!atEnd() && !isSpace(peek()))) {
      at_ = begin;
      return false;
    }
    assignment.values.emplace_back(key, *value);
    return true;
  }

  bool operatorFollows() {
    const std::size_t end = at_;
    skipBlanks();
    const bool sign = at_ < content_.size() && std::string_view("+-*/<>:").find(peek()) != std::string_view::npos;
    const std::string word = upperCase(readWord());
    at_ = end;
    constexpr std::array words = {"DIV", "MOD", "AND", "OR", "XOR", "B_AND", "B_OR", "B_XOR"};
    return sign || std::find(words.begin(), words.end(), word) != words.end();
  }

  /// A number, a truth value or a string; nothing if an expression stands there.
  std::optional<DataValue> readConstant() {
    const std::size_t begin = at_;
    if (peek() == '"') {
      const std::size_t close = content_.find('"', at_ + 1);
      if (close == std::string_view::npos) fail(begin, "the string is not closed", "write \" after it");
      at_ = close + 1;
      return DataValue(std::string(content_.substr(begin + 1, close - begin - 1)));
    }
    if (beginsName(peek())) {
      const std::string word = upperCase(readWord());
      if (word == "TRUE") return DataValue(true);
      if (word == "FALSE") return DataValue(false);
      return std::nullopt;
    }
    if (peek() == '\'') {
      const std::size_t close = content_.find('\'', at_ + 1);
      if (close == std::string_view::npos) fail(begin, "the number is not closed", "write ' after it");
      at_ = close + 1;
    } else {
      if (peek() == '-' || peek() == '+') ++at_;
      if (beginsName(peek()) || peek() == '(') return std::nullopt;
      while (isNameCharacter(peek()) || peek() == '.') {
        const bool exponent = at_ > begin && upperCase(content_.substr(at_ - 1, 2)) == "EX";
        ++at_;
        if (exponent && (peek() == '-' || peek() == '+')) ++at_;
      }
    }
    const std::string_view text = content_.substr(begin, at_ - begin);
    const auto number = parseNumber(text);
    if (!number) {
      fail(begin, fmt::format("\"{}\" is not a number", printable(text.empty() ? content_.substr(begin, 1) : text)),
           "write it with a decimal point, such as -12.5 or 1.2EX-3");
    }
    return DataValue(*number);
  }

  bool readList(const DataKey& key, Assignment& assignment) {
    assignment.form = Form::List;
    const auto first = key.indices.empty() ? std::optional(0LL) : parseInteger(key.indices.back());
    if (!first || *first > 1'000'000) fail(assignment.begin, "a list needs a number as its last index");
    DataKey each = key;
    if (each.indices.empty()) {
      const std::vector<int> sizes = sizes_ ? sizes_(key.name) : std::vector<int>();
      each.indices.assign(std::max<std::size_t>(sizes.size(), 1), "0");
    }
    const DataKey begin = each;
    for (long long offset = 0;; ++offset) {
      ++at_;
      skipBlanks();
      each.indices = begin.indices;
      each.indices.back() = std::to_string(*first + offset);
      wrapAround(each);
      if (peek() != ',' && peek() != ')') {
        const auto value = readConstant();
        if (!value) return false;
        assignment.values.emplace_back(each, *value);
        skipBlanks();
      } else if (peek() == ',') {
        return false;
      }
      if (peek() == ')') break;
      if (peek() != ',') fail(at_, "',' or ')' expected in the list");
    }
    ++at_;
    return true;
  }

  /// Brings a last index beyond the end of its row into the rows that follow.
  void wrapAround(DataKey& key) const {
    const std::vector<int> sizes = sizes_ ? sizes_(key.name) : std::vector<int>();
    if (sizes.size() != key.indices.size()) return;
    for (std::size_t i = sizes.size(); i-- > 1;) {
      const auto index = parseInteger(key.indices[i]), outer = parseInteger(key.indices[i - 1]);
      if (!index || !outer || *index < sizes[i]) return;
      key.indices[i] = std::to_string(*index % sizes[i]);
      key.indices[i - 1] = std::to_string(*outer + *index / sizes[i]);
    }
  }

  static bool isFrameFunction(std::string_view word) {
    return word == "CTRANS" || word == "CFINE" || word == "CROT" || word == "CROTS" || word == "CSCALE" ||
           word == "CMIRROR";
  }

  bool readFrame(const DataKey& key, Assignment& assignment) {
    assignment.form = Form::FrameChain;
    assignment.frame = key;
    frame_ = Frame();
    for (bool first = true;; first = false) {
      const std::size_t begin = at_;
      const std::string function = upperCase(readWord());
      if (!isFrameFunction(function)) {
        at_ = begin;
        return false;
      }
      const auto arguments = readAxisValues(function == "CMIRROR");
      if (!arguments) return false;
      const auto link = frameFunction(function, *arguments);
      if (!link) fail(begin, link.error().message, link.error().advice);
      const auto chained = first ? link : chain(frame_, *link);
      if (!chained) fail(begin, chained.error().message, chained.error().advice);
      frame_ = *chained;
      const std::size_t end = at_;
      skipBlanks();
      if (peek() != ':') {
        at_ = end;
        break;
      }
      ++at_;
      skipBlanks();
    }
    for (const std::string_view axis : {"X", "Y", "Z"})
      addComponents(assignment, axis);
    // Axes that only the frame before had are neutral from here on.
    for (const auto& [axis, values] : store_.frame(key).others)
      frame_.others.try_emplace(axis);
    for (const auto& [axis, values] : frame_.others)
      addComponents(assignment, axis);
    return true;
  }

  void addComponents(Assignment& assignment, std::string_view axis) const {
    for (const FramePart part : allFrameParts) {
      DataKey key = assignment.frame;
      key.indices.emplace_back(axis);
      key.indices.emplace_back(name(part));
      assignment.values.emplace_back(key, frame_.get(axis, part));
    }
  }

  /// "(X,10,Y,5)"; "(X,Y)" for mirroring. Nothing if a value is not a constant.
  std::optional<std::vector<AxisValue>> readAxisValues(bool axesOnly) {
    std::vector<AxisValue> values;
    expect('(', "write the axes and values in brackets");
    skipBlanks();
    while (peek() != ')') {
      AxisValue value;
      const std::size_t begin = at_;
      value.axis = upperCase(readWord());
      if (value.axis.empty() || isDigit(value.axis[0])) fail(begin, "the name of an axis is expected");
      skipBlanks();
      if (!axesOnly) {
        expect(',', "write axis and value in turn, such as CTRANS(X,10,Y,5)");
        skipBlanks();
        const auto constant = readConstant();
        const double* number = constant ? std::get_if<double>(&*constant) : nullptr;
        if (number == nullptr) return std::nullopt;
        value.value = *number;
        skipBlanks();
      }
      values.push_back(value);
      if (values.size() > 64) fail(begin, "too many axes");
      if (peek() == ',') {
        ++at_;
        skipBlanks();
        if (peek() == ')') fail(at_, "the name of an axis is expected");
        continue;
      }
      if (std::string_view("+-*/<>[(").find(peek()) != std::string_view::npos && peek() != '\0') return std::nullopt;
      if (peek() != ')') fail(at_, "',' or ')' expected");
    }
    ++at_;
    return values;
  }

  InitText& text_;
  std::string file_;
  DataStore& store_;
  Diagnostics& diagnostics_;
  const ArraySizes& sizes_;
  int wanted_ = 1, current_ = 1;
  bool sawChannel_ = false;
  std::size_t line_ = 0, at_ = 0, firstEnd_ = 0;
  std::string_view content_;
  Frame frame_;  ///< of the chain that was read last
};

InitText InitText::parse(std::string_view bytes, std::string file, DataStore& store, Diagnostics& diagnostics,
                         int channel, const ArraySizes& sizes) {
  InitText text;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const std::size_t length = end == std::string_view::npos ? bytes.size() : end + 1;
    text.lines_.emplace_back(bytes.substr(0, length));
    bytes.remove_prefix(length);
  }
  Reader(text, std::move(file), store, diagnostics, channel, sizes).readAll();
  return text;
}

}  // namespace probewright::control::sinumerik

#include "simulation/step_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <vector>

#include "base/text.hpp"

namespace probewright::simulation {
namespace {

/// Lists of lists of points of a complex entity need 5.
constexpr std::size_t kDeepest = 64;

bool isNameLetter(char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '!'; }

constexpr std::string_view kBlanks = " \t\r\n";

/// What ends a text.
enum class TextEnd : std::uint8_t {
  Standard,    ///< a quote; a doubled one is a letter
  BeforeSign,  ///< a quote before a comma or a closing bracket, as OpenCASCADE takes it: others are letters
};

bool isBeforeSign(std::string_view bytes, std::size_t at, std::string_view signs) {
  const std::size_t next = bytes.find_first_not_of(kBlanks, at);
  return next != std::string_view::npos && signs.find(bytes[next]) != std::string_view::npos;
}

/// The place behind the text that begins with the quote at `begin`; npos if it has no end.
std::size_t endOfText(std::string_view bytes, std::size_t begin, TextEnd by) {
  for (std::size_t at = begin; (at = bytes.find('\'', at + 1)) != std::string_view::npos;) {
    if (by == TextEnd::BeforeSign && isBeforeSign(bytes, at + 1, ",)")) return at + 1;
    if (by == TextEnd::BeforeSign) continue;
    if (at + 1 == bytes.size() || bytes[at + 1] != '\'') return at + 1;
    ++at;
  }
  return std::string_view::npos;
}

/// False where a text by the standard cannot end: within it stands a quote that is not doubled.
bool mayEndText(std::string_view bytes, std::size_t at) { return isBeforeSign(bytes, at, ",);/"); }

/// "-12", "1.", ".5", "6.02E-7".
bool isNumber(std::string_view text) {
  const auto digits = [&] {
    const std::size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
    text.remove_prefix(count);
    return count;
  };
  const auto has = [&](std::string_view signs) {
    const bool found = !text.empty() && signs.find(text.front()) != std::string_view::npos;
    if (found) text.remove_prefix(1);
    return found;
  };
  has("+-");
  std::size_t count = digits();
  if (has(".")) count += digits();
  if (count == 0) return false;
  if (!has("Ee")) return text.empty();
  has("+-");
  return digits() > 0 && text.empty();
}

bool beginsWith(std::string_view text, std::string_view capitals) {
  return upperCase(text.substr(0, capitals.size())) == capitals;
}

constexpr std::string_view kEnd = "END-ISO-10303-21";

tl::unexpected<Diagnostic> cutShort(const std::string& file, std::uint64_t line) {
  return fail({file, line, 0}, fmt::format("the STEP file ends before {}", kEnd),
              "the file was cut short; copy or export it again");
}

class Scanner {
public:
  Scanner(std::string_view text, const std::string& file, TextEnd textEnd, const std::stop_token& stop)
      : text_(text), file_(file), textEnd_(textEnd), stop_(stop) {}

  /// A text has ended where none can: quotes in texts are not doubled.
  bool hasStrayQuotes() const { return strayQuotes_; }

  Result<StepText> scan() {
    while (at_ < text_.size()) {
      if (stop_.stop_requested()) return fail(SourcePlace{file_, line_, 0}, "reading the STEP file was interrupted");
      if (auto read = statement(); !read) return tl::unexpected(std::move(read.error()));
      if (atEnd_) return finish();
    }
    return cutShort(file_, line_);
  }

private:
  tl::unexpected<Diagnostic> broken(const std::string& what, std::uint64_t line) const {
    return fail({file_, line, 0}, what, "the file is damaged; copy or export it again");
  }

  /// Goes over blanks and comments.
  Result<void> skip() {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') ++line_;
      if (c == '/' && text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) return broken("a comment of the STEP file has no end", line_);
        line_ += static_cast<std::uint64_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                       text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        at_ = end + 1;
      } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
        break;
      }
    }
    return {};
  }

  std::uint64_t number() {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    at_ = static_cast<std::size_t>(end - text_.data());
    return error == std::errc{} ? value : 0;
  }

  std::string_view word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && isNameLetter(text_[at_]))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  Result<void> text() {
    const std::size_t end = endOfText(text_, at_, textEnd_);
    if (end == std::string_view::npos) return broken("a text of the STEP file has no end", line_);
    line_ += static_cast<std::uint64_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                   text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at_ = end;
    strayQuotes_ = strayQuotes_ || !mayEndText(text_, at_);
    return {};
  }

  /// True at a sign, a digit or a decimal point; a name between points (.TRUE.) is none.
  bool beginsNumber() const {
    const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    return isDigit(text_[at_]) || text_[at_] == '+' || text_[at_] == '-' || (text_[at_] == '.' && isDigit(next));
  }

  /// A number among the arguments of `name`.
  Result<void> value(const std::string& name) {
    const std::size_t end = std::min(text_.find_first_of(",();'/ \t\r\n", at_), text_.size());
    const std::string_view number = text_.substr(at_, end - at_);
    if (!isNumber(number)) return broken(fmt::format("{}: \"{}\" is not a number", name, number), line_);
    at_ = end;
    return {};
  }

  /// Up to and with the semicolon.
  Result<void> statement() {
    if (auto skipped = skip(); !skipped) return skipped;
    if (at_ == text_.size()) return {};
    const std::uint64_t begin = line_;
    std::uint64_t id = 0;
    if (text_[at_] == '#') {
      ++at_;
      id = number();
      if (auto skipped = skip(); !skipped) return skipped;
      if (id != 0 && at_ < text_.size() && text_[at_] == '=') {
        ++at_;
        if (auto skipped = skip(); !skipped) return skipped;
        if (!inData_) {
          return broken(fmt::format("#{} stands outside of the section DATA", id), begin);
        }
        const auto [place, isNew] = result_.entities.try_emplace(id, StepEntity{begin, word()});
        if (!isNew) {
          return broken(fmt::format("the STEP file has two entities #{}, the first in line {}", id, place->second.line),
                        begin);
        }
      } else {
        return broken("an entity of the STEP file has no number", begin);
      }
    } else if (beginsWith(text_.substr(at_), kEnd)) {
      atEnd_ = true;
      return {};
    } else if (auto known = section(begin); !known) {
      return known;
    }
    return arguments(id, begin);
  }

  /// Follows the keywords that begin the sections.
  Result<void> section(std::uint64_t begin) {
    const std::size_t at = at_;
    const std::string keyword = upperCase(word());
    at_ = keyword == "DATA" ? at_ : at;
    if (keyword == "HEADER") hasHeader_ = true;
    if (keyword == "ENDSEC") inData_ = false;
    if (keyword != "DATA") return {};
    if (!hasHeader_) return broken("the STEP file has no section HEADER before its section DATA", begin);
    inData_ = true;
    if (auto skipped = skip(); !skipped) return skipped;
    if (at_ == text_.size() || text_[at_] != '(') return {};
    return fail(
        {file_, begin, 0},
        "the section DATA has parameters, as the second edition of ISO 10303-21 permits: such files cannot be read",
        "export the part as AP203 or AP214, or write DATA; there");
  }

  Result<void> arguments(std::uint64_t id, std::uint64_t begin) {
    const std::string name = id == 0 ? "the header" : fmt::format("#{}", id);
    std::size_t depth = 0;
    while (at_ < text_.size()) {
      if (auto skipped = skip(); !skipped) return skipped;
      if (at_ == text_.size()) break;
      switch (text_[at_]) {
        case '\'':
          if (auto read = text(); !read) return read;
          continue;
        case '(':
          if (++depth > kDeepest) return broken(fmt::format("the brackets of {} are nested too deeply", name), begin);
          break;
        case ')':
          if (depth-- == 0) return broken(fmt::format("{} has a bracket ) too many", name), line_);
          break;
        case '#':
          ++at_;
          if (const std::uint64_t to = number(); id != 0) result_.references.emplace_back(id, to);
          continue;
        case ';':
          ++at_;
          if (depth > 0) return broken(fmt::format("{} lacks a closing bracket", name), begin);
          return {};
        case '"':
          at_ = std::min(text_.find('"', at_ + 1), text_.size() - 1);
          break;
        default:
          if (id != 0 && beginsNumber()) {
            if (auto read = value(name); !read) return read;
            continue;
          }
          if (!isNameLetter(text_[at_])) break;
          word();
          continue;
      }
      ++at_;
    }
    return broken(fmt::format("the STEP file ends within {}", name), begin);
  }

  Result<StepText> finish() {
    for (const auto& [from, to] : result_.references) {
      if (result_.entities.contains(to)) continue;
      result_.dangling = from;
      result_.missing = to;
      break;
    }
    return std::move(result_);
  }

  std::string_view text_;
  const std::string& file_;
  TextEnd textEnd_;
  const std::stop_token& stop_;
  bool strayQuotes_ = false;
  bool hasHeader_ = false;
  bool inData_ = false;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
  bool atEnd_ = false;
  StepText result_;
};

}  // namespace

std::uint64_t circularEntity(const StepText& text) {
  // Takes away whatever refers to nothing that is left; what stays refers in circles, or to such a circle.
  std::map<std::uint64_t, std::size_t> open;  // references that an entity still has
  std::multimap<std::uint64_t, std::uint64_t> users;
  for (const auto& [from, to] : text.references) {
    if (!text.entities.contains(to)) continue;
    ++open[from];
    users.emplace(to, from);
  }
  std::vector<std::uint64_t> free;
  for (const auto& [id, entity] : text.entities) {
    if (!open.contains(id)) free.push_back(id);
  }
  while (!free.empty()) {
    const std::uint64_t id = free.back();
    free.pop_back();
    const auto [first, last] = users.equal_range(id);
    for (auto user = first; user != last; ++user) {
      if (--open[user->second] > 0) continue;
      open.erase(user->second);
      free.push_back(user->second);
    }
  }
  if (open.empty()) return 0;
  // Following references from anywhere ends in the circle.
  std::map<std::uint64_t, std::uint64_t> next;
  for (const auto& [from, to] : text.references) {
    if (open.contains(from) && open.contains(to)) next.try_emplace(from, to);
  }
  std::uint64_t at = next.begin()->first;
  for (std::size_t step = 0; step < next.size(); ++step)
    at = next.at(at);
  return at;
}

std::optional<EndlessNumber> endlessNumber(std::string_view bytes) {
  constexpr std::string_view kParts = "0123456789.+-", kEnds = ",;() \t\r\n=";
  constexpr std::size_t kFewest = 3;  // digits of such an exponent
  constexpr std::size_t kSection = 72;
  for (std::size_t at = 0; (at = bytes.find_first_of("EeDd", at)) != std::string_view::npos; ++at) {
    const std::size_t before = bytes.find_last_not_of(kParts, at == 0 ? 0 : at - 1);
    const std::size_t first = before == std::string_view::npos ? 0 : before + 1;
    const std::size_t last = std::min(bytes.find_first_not_of(kParts, at + 1), bytes.size());
    if (first >= at || last < at + 1 + kFewest || bytes[at + 1] == '-') continue;
    // In a directory of IGES, D in column 73 is the section.
    const std::size_t lineEnd = bytes.find_last_of("\r\n", at);
    if (bytes[at] == 'D' && at - (lineEnd == std::string_view::npos ? 0 : lineEnd + 1) == kSection) continue;
    if (first > 0 && kEnds.find(bytes[first - 1]) == std::string_view::npos) continue;
    if (last < bytes.size() && kEnds.find(bytes[last]) == std::string_view::npos) continue;
    const std::string_view text = bytes.substr(first, last - first);
    std::string number(text);
    number[at - first] = 'E';
    if (number.starts_with('+')) number.erase(0, 1);
    if (const std::size_t plus = number.find("E+"); plus != std::string::npos) number.erase(plus + 1, 1);
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc::result_out_of_range || end != number.data() + number.size()) continue;
    const auto lines = std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(first), '\n');
    return EndlessNumber{text, 1 + static_cast<std::uint64_t>(lines)};
  }
  return std::nullopt;
}

namespace {

/// The places behind the texts of a STEP file, by the places of their first quotes.
std::optional<std::vector<std::pair<std::size_t, std::size_t>>> textsOf(std::string_view bytes, TextEnd by) {
  std::vector<std::pair<std::size_t, std::size_t>> texts;
  for (std::size_t at = 0; (at = bytes.find_first_of("'/", at)) != std::string_view::npos;) {
    if (bytes[at] == '/') {
      at = bytes.substr(at, 2) == "/*" ? std::min(bytes.find("*/", at + 2), bytes.size()) : at + 1;
      continue;
    }
    const std::size_t end = endOfText(bytes, at, by);
    if (end == std::string_view::npos || (by == TextEnd::Standard && !mayEndText(bytes, end))) return std::nullopt;
    texts.emplace_back(at, end);
    at = end;
  }
  return texts;
}

}  // namespace

std::string withCapitalExponents(std::string bytes) {
  auto texts = textsOf(bytes, TextEnd::Standard);
  if (!texts) texts = textsOf(bytes, TextEnd::BeforeSign);
  if (!texts) texts.emplace();
  auto text = texts->begin();
  for (std::size_t i = 1; i + 1 < bytes.size(); ++i) {
    for (; text != texts->end() && i >= text->first; ++text)
      i = std::max(i, text->second);
    if (i + 1 >= bytes.size()) break;
    if (bytes[i] != 'e' || (!isDigit(bytes[i - 1]) && bytes[i - 1] != '.')) continue;
    const char next = bytes[i + 1];
    if (isDigit(next) || next == '-' || next == '+') bytes[i] = 'E';
  }
  return bytes;
}

Result<StepText> scanStep(std::string_view bytes, const std::string& file, const std::stop_token& stop) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (bytes.starts_with(mark)) bytes.remove_prefix(mark.size());
  std::string_view content = bytes;
  const auto skipBlanks = [&] {
    content.remove_prefix(std::min(content.find_first_not_of(" \t\r\n"), content.size()));
  };
  skipBlanks();
  // Comments may stand anywhere, also before the first word.
  while (content.starts_with("/*") && content.find("*/", 2) != std::string_view::npos) {
    content.remove_prefix(content.find("*/", 2) + 2);
    skipBlanks();
  }
  if (content.empty()) return fail({file, 0, 0}, "the STEP file is empty", "export the part again");
  if (!beginsWith(content, "ISO-10303-21")) {
    return fail({file, 1, 1}, "not a STEP file: it does not begin with ISO-10303-21",
                "export the part as STEP (AP203, AP214 or AP242), or name an IGES or STL file with its own extension");
  }
  const auto sameLetter = [](char one, char other) { return upper(one) == upper(other); };
  const auto theEnd = std::search(bytes.begin(), bytes.end(), kEnd.begin(), kEnd.end(), sameLetter);
  if (theEnd == bytes.end()) {
    return cutShort(file, 1 + static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.end(), '\n')));
  }
  Scanner byStandard(bytes, file, TextEnd::Standard, stop);
  Result<StepText> scanned = byStandard.scan();
  if (scanned && !byStandard.hasStrayQuotes()) return scanned;
  Result<StepText> tolerant = Scanner(bytes, file, TextEnd::BeforeSign, stop).scan();
  if (tolerant) return tolerant;
  // A quote that is not doubled leads the first reader to places far behind it.
  return scanned || scanned.error().place.line <= tolerant.error().place.line ? std::move(scanned)
                                                                              : std::move(tolerant);
}

}  // namespace probewright::simulation

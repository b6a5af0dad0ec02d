#include "language/klartext/lexer.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

namespace probewright::language::klartext {

namespace {

constexpr std::array<double, 23> powersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                                1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Length of the typographic quotation mark (UTF-8 or CP1252) at `text`, or 0.
std::size_t typographicQuote(std::string_view text) {
  if (text.size() >= 3 && text[0] == '\xE2' && text[1] == '\x80' && text[2] >= '\x9C' && text[2] <= '\x9F') return 3;
  if (!text.empty() && (text[0] == '\x93' || text[0] == '\x94' || text[0] == '\x84')) return 1;
  return 0;
}

}  // namespace

bool endsWithContinuation(std::string_view line) {
  line = trimmedAtEnd(line, blanksAndReturn);
  return !line.empty() && line.back() == '~';
}

void Lexer::skipSeparators() {
  while (p_ < end_) {
    const char c = *p_;
    if (isBlankOrReturn(c)) {
      ++p_;
    } else if (c == '\n') {
      lineStart_ = ++p_;
      ++line_;
    } else if (c == '~') {
      const char* q = p_ + 1;
      while (q < end_ && isBlankOrReturn(*q))
        ++q;
      if (q < end_ && *q != '\n') return;
      p_ = q;
    } else if (c == ';') {
      p_ = comments_ == Comments::ToBlockEnd ? end_ : lineEnd();
    } else if (static_cast<unsigned char>(c) < ' ') {
      ++p_;
    } else {
      return;
    }
  }
}

const char* Lexer::lineEnd() const {
  const void* found = std::memchr(p_, '\n', static_cast<std::size_t>(end_ - p_));
  return found ? static_cast<const char*>(found) : end_;
}

bool Lexer::acceptPrefix(std::string_view text) {
  if (peek() == '\0') return false;
  const char* next = p_;
  for (const char wanted : text) {
    if (next == end_ || (wanted == ' ' ? !isBlank(*next) : upper(*next) != wanted)) return false;
    ++next;
    while (wanted == ' ' && next < end_ && isBlank(*next))
      ++next;
  }
  p_ = next;
  return true;
}

bool Lexer::acceptKeyword(std::string_view keyword) {
  const char* start = (peek(), p_);
  if (!acceptPrefix(keyword)) return false;
  if (p_ < end_ && isWordByte(*p_)) {
    p_ = start;
    return false;
  }
  return true;
}

std::optional<double> Lexer::number() {
  const char first = peek();
  if (!isDigit(first) && !((first == '.' || first == ',') && isDigit(here(1)))) return std::nullopt;
  const char* start = p_;
  std::uint64_t mantissa = 0;
  int digits = 0;
  int decimals = 0;
  bool separated = false;
  const char* q = p_;
  for (; q < end_; ++q) {
    if (isDigit(*q)) {
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(*q - '0');
      if (mantissa != 0) ++digits;
      if (separated) ++decimals;
    } else if ((*q == '.' || *q == ',') && !separated) {
      separated = true;
    } else {
      break;
    }
  }
  p_ = q;
  // Up to 15 digits and 22 decimals, both mantissa and divisor are exact doubles, so the quotient is correctly rounded.
  if (digits <= 15 && decimals <= 22) {
    return static_cast<double>(mantissa) / powersOfTen[static_cast<std::size_t>(decimals)];
  }
  std::string text(start, q);
  for (char& c : text) {
    if (c == ',') c = '.';
  }
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  // Too small is 0; from_chars says the same of too large.
  if (problem == std::errc::result_out_of_range) value = std::strtod(text.c_str(), nullptr);
  if (std::isinf(value) && !tooLarge_) tooLarge_ = static_cast<std::size_t>(start - begin_);
  return value;
}

std::optional<std::string_view> Lexer::quoted() {
  if (peek() == '\0') return std::nullopt;
  const char* stop = lineEnd();
  const std::string_view rest(p_, static_cast<std::size_t>(stop - p_));
  if (rest.front() == '"') {
    const std::size_t close = rest.find('"', 1);
    if (close == std::string_view::npos) return std::nullopt;
    p_ += close + 1;
    return rest.substr(1, close - 1);
  }
  const std::size_t open = typographicQuote(rest);
  if (open == 0) return std::nullopt;
  for (std::size_t i = open; i < rest.size(); ++i) {
    const std::size_t close = rest[i] == '"' ? 1 : typographicQuote(rest.substr(i));
    if (close == 0) continue;
    p_ += i + close;
    return rest.substr(open, i - open);
  }
  return std::nullopt;
}

std::string_view Lexer::restOfLine() { return peek() == '\0' ? std::string_view() : restUntil(lineEnd()); }

std::string_view Lexer::restOfBlock() { return peek() == '\0' ? std::string_view() : restUntil(end_); }

std::string_view Lexer::restUntil(const char* stop) {
  std::string_view rest(p_, static_cast<std::size_t>(stop - p_));
  bool inText = false;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '"') inText = !inText;
    if (rest[i] == ';' && !inText) {
      rest = rest.substr(0, i);
      break;
    }
  }
  p_ += rest.size();
  while (!rest.empty() && (isBlankOrReturn(rest.back()) || rest.back() == '~'))
    rest.remove_suffix(1);
  return rest;
}

std::string_view Lexer::chunk() {
  if (peek() == '\0') return {};
  const char* start = p_;
  while (p_ < end_ && !isBlankOrReturn(*p_) && *p_ != '\n' && *p_ != ';')
    ++p_;
  return {start, static_cast<std::size_t>(p_ - start)};
}

bool Lexer::nextLine() {
  p_ = lineEnd();
  if (p_ == end_) return false;
  lineStart_ = ++p_;
  ++line_;
  return true;
}

void Lexer::limitToLine() { end_ = lineEnd(); }

}  // namespace probewright::language::klartext

#pragma once

#include <string>
#include <string_view>

/// Characters and texts of programs and files. Only letters of ASCII have a case; every other byte stays as it is,
/// whatever the encoding.
namespace probewright {

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool isCapital(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool isLetter(char c) { return isCapital(c) || (c >= 'a' && c <= 'z'); }
/// A space or a tabulator.
constexpr bool isBlank(char c) { return c == ' ' || c == '\t'; }
/// A blank, or what files of other systems have before the end of a line: carriage return.
constexpr bool isBlankOrReturn(char c) { return isBlank(c) || c == '\r'; }

constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
constexpr char lower(char c) { return isCapital(c) ? static_cast<char>(c - 'A' + 'a') : c; }

inline std::string upperCase(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals)
    c = upper(c);
  return capitals;
}

inline std::string lowerCase(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    c = lower(c);
  return small;
}

/// `text` without the characters of `blanks` at both ends, or at its end only.
constexpr std::string_view trimmed(std::string_view text, std::string_view blanks = " \t") {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}
constexpr std::string_view trimmedAtEnd(std::string_view text, std::string_view blanks = " \t") {
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// The blanks of texts with lines, and of lines that may end with a carriage return.
inline constexpr std::string_view lineBlanks = " \t\r\n";
inline constexpr std::string_view blanksAndReturn = " \t\r";

}  // namespace probewright

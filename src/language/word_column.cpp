#include "language/word_column.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace probewright::language {

namespace {

bool isWordSign(char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '$'; }
bool sameLetter(char a, char b) { return upper(a) == upper(b); }

}  // namespace

std::uint32_t columnOfFirstWord(std::string_view source) {
  std::size_t at = 0;
  const auto skip = [&](auto&& belongs) {
    while (at < source.size() && belongs(source[at]))
      ++at;
  };
  skip(isBlank);
  if (at < source.size() && source[at] == '/') {
    ++at;
    if (at + 1 < source.size() && isDigit(source[at]) && !isDigit(source[at + 1])) ++at;
    skip(isBlank);
  }
  std::size_t number = at;
  if (number < source.size() && (source[number] == 'N' || source[number] == 'n' || source[number] == ':')) ++number;
  if (number < source.size() && isDigit(source[number])) {
    at = number;
    skip(isDigit);
    skip(isBlank);
  }
  return static_cast<std::uint32_t>(at) + 1;
}

std::uint32_t columnOf(std::string_view word, std::string_view source) {
  for (auto from = source.begin();;) {
    const auto found = std::search(from, source.end(), word.begin(), word.end(), sameLetter);
    if (word.empty() || found == source.end()) return columnOfFirstWord(source);
    const auto behind = found + static_cast<std::ptrdiff_t>(word.size());
    const bool begins = found == source.begin() || !isWordSign(*(found - 1)) || isDigit(*(found - 1));
    if (begins && (behind == source.end() || !isWordSign(*behind)))
      return static_cast<std::uint32_t>(found - source.begin()) + 1;
    from = found + 1;
  }
}

}  // namespace probewright::language

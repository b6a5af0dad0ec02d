#include "reports/screen_lines.hpp"

#include <algorithm>
#include <string_view>

#include "base/utf8.hpp"
#include "words/words.hpp"

namespace probewright::reports {

namespace {

/// One text of a line. A label is that of a result or a word of the screen, with its unit in brackets or without.
std::string cell(const std::string& text, const control::CycleRecord& cycle, control::DialogLanguage language) {
  const std::size_t unit = text.ends_with(']') ? text.rfind(" [") : std::string::npos;
  const std::string label = text.substr(0, unit), rest = unit == std::string::npos ? std::string() : text.substr(unit);
  const auto named = std::ranges::find_if(cycle.results, [&](const control::ResultRecord& result) {
    return !result.label.empty() && result.label == label;
  });
  if (named != cycle.results.end()) return words::characteristic(language, named->kind.of, label) + rest;
  return words::translated(language, label) + rest;
}

}  // namespace

std::string screenLine(const std::string& line, const control::CycleRecord& cycle, control::DialogLanguage language) {
  if (language == control::DialogLanguage::English) return line;
  if (const std::string whole = words::translated(language, line); whole != line) return whole;
  std::string text;
  std::size_t at = 0;
  while (at < line.size()) {
    const std::size_t begin = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t end = std::min(line.find("  ", begin), line.size());
    const std::string english = line.substr(begin, end - begin), word = cell(english, cycle, language);
    std::size_t blanks = begin - at;
    if (at > 0) {
      const std::size_t edge = characterCount(line.substr(0, end)),
                        without = characterCount(text) + characterCount(word);
      blanks = edge > without + 2 ? edge - without : 2;
    }
    text += std::string(blanks, ' ') + word;
    at = end;
  }
  return text;
}

}  // namespace probewright::reports

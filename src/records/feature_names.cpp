#include "records/feature_names.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "base/text.hpp"

namespace probewright::records {

namespace {

std::string_view withoutBlanks(std::string_view text) { return trimmed(text, blanksAndReturn); }

/// Takes the block's number away, if there is one.
std::string_view withoutNumber(std::string_view line) {
  line = withoutBlanks(line);
  std::size_t digits = !line.empty() && (line.front() == 'N' || line.front() == 'n') ? 1 : 0;
  const std::size_t first = digits;
  while (digits < line.size() && isDigit(line[digits]))
    ++digits;
  return digits > first ? withoutBlanks(line.substr(digits)) : line;
}

bool startsWithMessage(std::string_view line) {
  constexpr std::string_view word = "MSG";
  return line.size() >= word.size() &&
         std::ranges::equal(line.substr(0, word.size()), word, [](char a, char b) { return upper(a) == b; });
}

/// The name that a line gives to what follows.
std::optional<std::string_view> nameIn(std::string_view line) {
  line = withoutNumber(line);
  if (line.starts_with('*')) {
    line = withoutBlanks(line.substr(1));
    if (!line.starts_with('-')) return std::nullopt;
    return withoutBlanks(line.substr(1));
  }
  if (!startsWithMessage(line)) return std::nullopt;
  line = withoutBlanks(line.substr(3));
  if (!line.starts_with('(')) return std::nullopt;
  line = withoutBlanks(line.substr(1));
  if (!line.starts_with('"')) return "";
  const std::size_t end = line.find('"', 1);
  return end == std::string_view::npos ? "" : withoutBlanks(line.substr(1, end - 1));
}

/// Without line ends and other characters that have no place in a field.
std::string inOneLine(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
  return text;
}

}  // namespace

FeatureNames::FeatureNames(const RunInfo& run, const ReadableText& text) {
  for (const ProgramSource& program : run.programs) {
    auto& names = names_[program.path];
    std::string_view rest = program.text;
    for (std::uint64_t number = 1; !rest.empty(); ++number) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      if (const auto name = nameIn(rest.substr(0, end))) names[number] = inOneLine(text(std::string(*name)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
}

std::string FeatureNames::at(const SourcePlace& place) const {
  const auto program = names_.find(place.file);
  if (program == names_.end()) return {};
  const auto after = program->second.upper_bound(place.line);
  return after == program->second.begin() ? std::string() : std::prev(after)->second;
}

}  // namespace probewright::records

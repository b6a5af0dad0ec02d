#include "language/din_iso/block_extent.hpp"

#include "language/klartext/lexer.hpp"

namespace probewright::language::din_iso {

namespace {

void skipBlanks(std::string_view& text) {
  while (!text.empty() && isBlankOrReturn(text.front()))
    text.remove_prefix(1);
}

void skipDigits(std::string_view& text) {
  while (!text.empty() && isDigit(text.front()))
    text.remove_prefix(1);
}

/// The end of the line's statement: the place of its end sign, or npos if it has none.
std::size_t endSign(std::string_view line) {
  bool inText = false;
  std::size_t comment = line.size();
  for (std::size_t i = 0; i < line.size() && comment == line.size(); ++i) {
    if (line[i] == '"') inText = !inText;
    if (line[i] == ';' && !inText) comment = i;
  }
  const std::string_view whole = trimmedAtEnd(line, blanksAndReturn);
  if (whole.ends_with('*')) return whole.size() - 1;
  const std::string_view statement = trimmedAtEnd(line.substr(0, comment), blanksAndReturn);
  return statement.ends_with('*') ? statement.size() - 1 : std::string_view::npos;
}

bool isParameterCycle(std::string_view line) {
  std::string_view rest = withoutBlockNumber(line);
  if (rest.empty() || upper(rest.front()) != 'G') return false;
  rest.remove_prefix(1);
  std::size_t digits = 0;
  while (digits < rest.size() && isDigit(rest[digits]))
    ++digits;
  return digits >= 3;
}

bool isParameterLine(std::string_view line) {
  skipBlanks(line);
  if (line.empty() || upper(line.front()) != 'Q') return false;
  line.remove_prefix(1);
  if (!line.empty() && upper(line.front()) == 'S') line.remove_prefix(1);
  const std::size_t before = line.size();
  skipDigits(line);
  const bool number = line.size() < before;
  skipBlanks(line);
  return number && !line.empty() && line.front() == '=';
}

}  // namespace

std::string_view withoutBlockNumber(std::string_view text) {
  const auto skipSign = [&text]() {
    skipBlanks(text);
    if (!text.empty() && text.front() == '/') text.remove_prefix(1);
    skipBlanks(text);
  };
  skipSign();
  if (text.size() > 1 && upper(text.front()) == 'N' && isDigit(text[1])) {
    text.remove_prefix(1);
    skipDigits(text);
  }
  skipSign();
  return text;
}

BlockExtent blockExtent(std::string_view text) {
  BlockExtent extent;
  extent.lines = 0;
  const auto lineAt = [&text](std::size_t offset) { return text.substr(offset, text.find('\n', offset) - offset); };
  std::size_t begin = 0;
  const bool cycle = isParameterCycle(lineAt(0));
  for (;;) {
    const std::string_view line = lineAt(begin);
    ++extent.lines;
    extent.length = begin + line.size();
    extent.next = extent.length < text.size() ? extent.length + 1 : text.size();
    const std::size_t end = endSign(line);
    extent.statement = end == std::string_view::npos ? extent.length : begin + end;
    if (end != std::string_view::npos || extent.next >= text.size()) return extent;
    begin = extent.next;
    std::uint64_t empty = 0;  // lines, which some editors put between the parameters of a cycle
    while (cycle && trimmedAtEnd(lineAt(begin), blanksAndReturn).empty() && text.find('\n', begin) < text.size()) {
      begin = text.find('\n', begin) + 1;
      ++empty;
    }
    if (cycle && isParameterLine(lineAt(begin))) {
      extent.lines += empty;
      continue;
    }
    if (!klartext::endsWithContinuation(line)) return extent;
    begin = extent.next;
  }
}

}  // namespace probewright::language::din_iso

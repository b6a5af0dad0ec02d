#include "language/klartext/block_extent.hpp"

#include <algorithm>
#include <array>

#include "base/utf8.hpp"
#include "language/klartext/lexer.hpp"

namespace probewright::language::klartext {

namespace {

struct Line {
  std::string_view text;  ///< without the line end
  std::size_t next = 0;
};

Line lineAt(std::string_view text, std::size_t offset) {
  const std::size_t end = text.find('\n', offset);
  if (end == std::string_view::npos) return {text.substr(offset), text.size()};
  return {text.substr(offset, end - offset), end + 1};
}

void skipBlanks(std::string_view& text) {
  while (!text.empty() && isBlankOrReturn(text.front()))
    text.remove_prefix(1);
}

bool skipWord(std::string_view& text, std::string_view word) {
  skipBlanks(text);
  if (text.size() < word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (upper(text[i]) != word[i]) return false;
  }
  text.remove_prefix(word.size());
  return true;
}

std::string_view skipDigits(std::string_view& text) {
  std::size_t count = 0;
  while (count < text.size() && isDigit(text[count]))
    ++count;
  const std::string_view digits = text.substr(0, count);
  text.remove_prefix(count);
  return digits;
}

/// What the first line of a cycle says about the lines after it.
struct CycleHead {
  enum class Kind { None, Parts, Parameters };
  Kind kind = Kind::None;
  char keyword = 0;  ///< T: TCH PROBE, C: CYCL DEF
  std::string_view number;
  std::string_view part;  ///< after the point
  bool numbered = false;  ///< the line has a block number
};

CycleHead cycleHead(std::string_view line) {
  std::string_view rest = withoutBlockNumber(line);
  if (rest.empty() || (upper(rest.front()) != 'T' && upper(rest.front()) != 'C')) return {};
  CycleHead head;
  head.keyword = upper(rest.front());
  std::string_view untouched = line;
  skipBlanks(untouched);
  head.numbered = !untouched.empty() && isDigit(untouched.front());
  const bool known = head.keyword == 'T' ? skipWord(rest, "TCH") && skipWord(rest, "PROBE")
                                         : skipWord(rest, "CYCL") && skipWord(rest, "DEF");
  if (!known) return {};
  skipBlanks(rest);
  head.number = skipDigits(rest);
  if (head.number.empty()) return {};
  if (rest.size() > 1 && rest[0] == '.' && isDigit(rest[1])) {
    rest.remove_prefix(1);
    head.part = skipDigits(rest);
    head.kind = CycleHead::Kind::Parts;
  } else if (head.number.size() >= 3 && rest.find('=') == std::string_view::npos) {
    head.kind = CycleHead::Kind::Parameters;
  }
  return head;
}

bool isCommentLine(std::string_view line) {
  const std::string_view rest = withoutBlockNumber(line);
  return rest.empty() || rest.front() == ';' || rest.front() == '*';
}

bool isParameterLine(std::string_view line, bool headIsNumbered) {
  skipBlanks(line);
  if (line.empty() || upper(line.front()) != 'Q') return false;
  line.remove_prefix(1);
  if (!line.empty() && upper(line.front()) == 'S') line.remove_prefix(1);
  skipBlanks(line);
  const std::string_view number = skipDigits(line);
  skipBlanks(line);
  if (number.empty() || line.empty() || line.front() != '=') return false;
  // In a program without block numbers an assignment looks the same; cycles' parameters begin at Q200.
  return headIsNumbered || number.size() >= 4 || (number.size() == 3 && number.front() >= '2');
}

/// In double-byte encodings '~' can be the second byte of a character at the end of a comment.
bool mayBeHalfCharacter(std::string_view line) {
  line = trimmedAtEnd(line, blanksAndReturn);
  line.remove_suffix(1);
  std::size_t high = 0;
  while (high < line.size() && (static_cast<unsigned char>(line[line.size() - 1 - high]) & 0x80U) != 0)
    ++high;
  return high % 2 != 0 && !isUtf8(line.substr(line.size() - high));
}

bool isContinued(std::string_view text, const Line& line) {
  if (!endsWithContinuation(line.text)) return false;
  if (!mayBeHalfCharacter(line.text)) return true;
  std::string_view following = lineAt(text, line.next).text;
  skipBlanks(following);
  return following.empty() || !isDigit(following.front());
}

/// Empty lines before the next parameter of a cycle, which some editors put there: goes on to the line with the
/// parameter and says how many lines it skipped; none if no parameter follows.
std::uint64_t skipEmptyLines(std::string_view text, Line& line) {
  Line parameter = line;
  std::uint64_t count = 0;
  for (; trimmedAtEnd(parameter.text, blanksAndReturn).empty() && parameter.next < text.size(); ++count)
    parameter = lineAt(text, parameter.next);
  if (count == 0 || !isParameterLine(parameter.text, true)) return 0;
  line = parameter;
  return count;
}

/// True for a line that cannot be the next parameter of a cycle: it begins a block of its own.
bool beginsBlock(std::string_view line) {
  const std::string_view text = withoutBlockNumber(line);
  constexpr std::array<std::string_view, 13> keywords = {"TCH",  "CYCL",  "TOOL", "CALL",     "LBL",   "FN",    "END",
                                                         "STOP", "PLANE", "L",    "FUNCTION", "TRANS", "GLOBAL"};
  return std::ranges::any_of(keywords, [&](std::string_view keyword) {
    std::string_view rest = text;
    return skipWord(rest, keyword) && (rest.empty() || !isLetter(rest.front())) && rest.find('=') > rest.find(' ');
  });
}

}  // namespace

bool endsOpen(std::string_view block) {
  const std::string_view line = block.substr(block.rfind('\n') + 1);
  return endsWithContinuation(line) && !mayBeHalfCharacter(line);
}

std::string_view withoutBlockNumber(std::string_view text) {
  skipBlanks(text);
  if (!text.empty() && text.front() == '/') text.remove_prefix(1);
  skipBlanks(text);
  skipDigits(text);
  skipBlanks(text);
  if (!text.empty() && text.front() == '/') text.remove_prefix(1);
  skipBlanks(text);
  return text;
}

BlockExtent blockExtent(std::string_view text) {
  BlockExtent extent;
  extent.lines = 0;
  Line line = lineAt(text, 0);
  const std::string_view first = line.text;

  const CycleHead head = cycleHead(first);
  const bool parameters = head.kind == CycleHead::Kind::Parameters;
  const auto takeContinued = [&]() {
    for (;;) {
      ++extent.lines;
      if (!isContinued(text, line) || line.next >= text.size()) break;
      Line following = lineAt(text, line.next);
      if (parameters) {
        extent.lines += skipEmptyLines(text, following);
        if (beginsBlock(following.text)) break;
      }
      line = following;
    }
    extent.length = static_cast<std::size_t>(line.text.data() - text.data()) + line.text.size();
    extent.next = line.next;
  };
  takeContinued();

  if (head.kind == CycleHead::Kind::None) return extent;
  const bool parts = head.kind == CycleHead::Kind::Parts;
  if (!parts && extent.lines > 1) return extent;
  // Comment lines in between belong to the block only if a part of the cycle follows them.
  std::uint64_t comments = 0;
  for (std::size_t probe = extent.next; probe < text.size();) {
    line = lineAt(text, probe);
    bool belongs = false;
    if (parts) {
      const CycleHead part = cycleHead(line.text);
      belongs = part.kind == CycleHead::Kind::Parts && part.keyword == head.keyword && part.number == head.number &&
                part.part != "0";
    } else {
      belongs = isParameterLine(line.text, head.numbered);
    }
    if (belongs) {
      extent.lines += comments;
      comments = 0;
      takeContinued();
      probe = extent.next;
    } else if (isCommentLine(line.text) && !endsWithContinuation(line.text) && comments < 50) {
      ++comments;
      probe = line.next;
    } else {
      break;
    }
  }
  return extent;
}

}  // namespace probewright::language::klartext

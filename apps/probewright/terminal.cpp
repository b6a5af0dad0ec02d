#include "terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "base/utf8.hpp"

namespace probewright::app {

namespace {

constexpr std::size_t furtherIn = 4;
constexpr std::size_t deep = 12;  ///< a line that begins here is a column already
constexpr std::size_t fewestColumns = 20;

/// The bytes of the character, or of the colour, that begins here; `columns` grows by what it takes.
std::size_t step(std::string_view line, std::size_t at, std::size_t& columns) {
  if (line[at] == '\033') {
    const std::size_t end = line.find('m', at);
    return (end == std::string_view::npos ? line.size() : end + 1) - at;
  }
  std::size_t size = 1;
  while (at + size < line.size() && continuesCharacter(line[at + size]))
    ++size;
  ++columns;
  return size;
}

/// Where the lines below the first one begin.
std::size_t indentOf(std::string_view line, std::size_t columns) {
  const std::size_t text = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t gap = line.find("  ", text);
  const std::size_t second = gap == std::string_view::npos ? gap : line.find_first_not_of(' ', gap);
  if (second != std::string_view::npos && second <= columns / 2) return second;
  return std::min(text >= deep ? text : text + furtherIn, columns / 2);
}

std::string fittedLine(std::string_view line, std::size_t columns) {
  const std::size_t indent = indentOf(line, columns);
  std::string result;
  std::size_t begin = 0, room = columns;
  while (true) {
    std::size_t width = 0, blank = 0, gap = 0, at = begin;
    bool word = false;  // no break between the blanks before the first word
    for (; at < line.size() && width <= room; at += step(line, at, width)) {
      if (line[at] != ' ') {
        word = true;
      } else if (word) {
        blank = at;
        if (at + 1 < line.size() && line[at + 1] == ' ') gap = at;
      }
    }
    if (at >= line.size() && width <= room) return result.append(line.substr(begin));
    std::size_t end = gap > begin + (at - begin) / 2 ? gap : blank;
    if (end == 0) end = line.find(' ', at);
    if (end == std::string_view::npos) return result.append(line.substr(begin));
    const std::size_t last = line.find_last_not_of(' ', end);
    result.append(line.substr(begin, last + 1 - begin));
    begin = line.find_first_not_of(' ', end);
    if (begin == std::string_view::npos) return result;
    result += '\n';
    result.append(indent, ' ');
    room = columns - indent;
  }
}

}  // namespace

std::size_t columnsOf(std::FILE* stream) {
  winsize size{};
  const int file = fileno(stream);
  if (file < 0 || isatty(file) == 0 || ioctl(file, TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_col;
}

std::string fitted(std::string_view text, std::size_t columns) {
  if (columns < fewestColumns) return std::string(text);
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += fittedLine(text.substr(0, end), columns);
    if (end < text.size()) result += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

void put(std::string_view text, std::FILE* stream) {
  const std::size_t columns = columnsOf(stream);
  const std::string lines = columns == 0 ? std::string(text) : fitted(text, columns);
  std::fwrite(lines.data(), 1, lines.size(), stream);
}

}  // namespace probewright::app

#include "control/heidenhain/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "base/utf8.hpp"

namespace probewright::control::heidenhain {

namespace {

constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

std::vector<std::string> splitLines(std::string_view bytes) {
  std::vector<std::string> lines;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const std::size_t length = end == std::string_view::npos ? bytes.size() : end + 1;
    lines.emplace_back(bytes.substr(0, length));
    bytes.remove_prefix(length);
  }
  return lines;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> found;
  std::size_t i = 0;
  while (i < text.size()) {
    while (i < text.size() && isBlank(text[i]))
      ++i;
    const std::size_t begin = i;
    while (i < text.size() && !isBlank(text[i]))
      ++i;
    if (i > begin) found.push_back(text.substr(begin, i - begin));
  }
  return found;
}

std::string normalizedKey(std::string_view key) {
  // What most rows are called is the shortest text of its number already.
  constexpr std::size_t longestExact = 15;
  const bool digits = !key.empty() && key.size() <= longestExact && std::ranges::all_of(key, isDigit);
  if (digits && (key.front() != '0' || key.size() == 1)) return std::string(key);
  const auto number = parseDecimal(key);
  return number ? formatShortest(*number) : std::string(key);
}

/// An excerpt that is safe to print and not endless.
std::string excerptOf(std::string_view content) {
  std::string excerpt(content.substr(0, 120));
  for (char& c : excerpt) {
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  }
  return excerpt;
}

}  // namespace

Result<TextTable> TextTable::parse(std::string_view bytes, std::string file, Diagnostics& diagnostics) {
  TextTable table;
  table.file_ = std::move(file);
  table.lines_ = splitLines(bytes);
  table.utf8_ = probewright::isUtf8(bytes);
  const std::size_t lineCount = table.lines_.size();
  const auto content = [&table](std::size_t line) {
    return std::string_view(table.lines_[line]).substr(0, table.contentSize(line));
  };

  if (const std::size_t nul = bytes.find('\0'); nul != std::string_view::npos) {
    const auto line = static_cast<std::size_t>(std::count(bytes.begin(), bytes.begin() + static_cast<long>(nul), '\n'));
    return fail(SourcePlace{table.file_, line + 1, 0}, "this is not a text table: it contains NUL bytes",
                "export the table from the control as text");
  }

  std::size_t line = 0;
  while (line < lineCount && trimmed(content(line)).empty())
    ++line;
  std::string_view first = line < lineCount ? content(line) : std::string_view();
  if (first.starts_with(byteOrderMark)) first.remove_prefix(byteOrderMark.size());
  const auto firstWords = words(first);
  if (firstWords.size() < 2 || firstWords[0] != "BEGIN") {
    Diagnostic error{Severity::Error, {table.file_, line + 1, 1}, {}, excerptOf(first), {}, {}};
    error.message = "a table begins with a line such as \"BEGIN TOOL.T MM\"";
    error.advice = "add the line, or check that this is the right file";
    return tl::unexpected(error);
  }
  const auto unit = std::find_if(firstWords.begin() + 1, firstWords.end(),
                                 [](std::string_view word) { return word == "MM" || word == "INCH"; });
  for (auto word = firstWords.begin() + 1; word != firstWords.end() && word != unit; ++word)
    table.name_ += *word;
  if (unit == firstWords.end()) {
    diagnostics.push_back({Severity::Warning,
                           {table.file_, line + 1, 1},
                           "the BEGIN line names no unit; millimetres are taken",
                           excerptOf(first),
                           "write MM or INCH at its end",
                           {}});
  } else if (*unit == "INCH") {
    table.unit_ = TableUnit::Inch;
  }
  ++line;

  // Tables of newer controls carry a definition of their columns here.
  if (line < lineCount && trimmed(content(line)).starts_with("#STRUCTBEGIN")) {
    while (line < lineCount && !trimmed(content(line)).starts_with("#STRUCTEND"))
      ++line;
    ++line;
  }
  while (line < lineCount && trimmed(content(line)).empty())
    ++line;
  if (line >= lineCount || trimmed(content(line)) == "[END]") {
    return fail(SourcePlace{table.file_, std::min(line, lineCount) + 1, 1},
                "the header line with the names of the columns is missing",
                "write it below the BEGIN line, each name where its column begins");
  }
  table.readHeader(line, diagnostics);
  table.readRows(line + 1, diagnostics);
  return table;
}

TextTable TextTable::create(std::string_view name, TableUnit unit, std::span<const NewColumn> columns) {
  std::string text = fmt::format("BEGIN {} {}\r\n", name, unit == TableUnit::Inch ? "INCH" : "MM");
  for (const NewColumn& column : columns)
    text += fmt::format("{:<{}}", column.name, column.width);
  text += "\r\n[END]\r\n";
  Diagnostics none;
  return parse(text, std::string(name), none).value();
}

void TextTable::readHeader(std::size_t line, Diagnostics& diagnostics) {
  headerLine_ = line;
  const std::string_view content = std::string_view(lines_[line]).substr(0, contentSize(line));
  std::set<std::string_view> seen;
  for (const std::string_view word : words(content)) {
    const auto byte = static_cast<std::size_t>(word.data() - content.data());
    const std::size_t start = characters(content.substr(0, byte));
    if (!columns_.empty()) columns_.back().end = start;
    columns_.push_back({std::string(word), start, TableColumn::toLineEnd});
    if (!seen.insert(word).second) {
      diagnostics.push_back({Severity::Warning,
                             {file_, line + 1, static_cast<std::uint32_t>(byte + 1)},
                             fmt::format("column {} appears twice; the first one counts", excerptOf(word)),
                             {},
                             {},
                             {}});
    }
  }
  // Rows may be indented further to the left than the header.
  columns_.front().start = 0;
  shapes_.resize(columns_.size());
  for (const std::string_view name : {"T", "NO", "NR", "D"}) {
    if (const auto column = findColumn(name)) {
      keyColumn_ = *column;
      break;
    }
  }
}

void TextTable::readRows(std::size_t first, Diagnostics& diagnostics) {
  std::size_t line = first;
  for (; line < lines_.size(); ++line) {
    const std::string_view content = std::string_view(lines_[line]).substr(0, contentSize(line));
    const std::string_view text = trimmed(content);
    if (text == "[END]") break;
    if (text.empty()) continue;
    const std::string_view key = trimmedCell(line, keyColumn_);
    if (key.empty()) {
      diagnostics.push_back({Severity::Warning,
                             {file_, line + 1, 1},
                             fmt::format("this line has no entry in column {}; it is kept but not used",
                                         excerptOf(columns_[keyColumn_].name)),
                             excerptOf(content),
                             "give the row its number where the column begins",
                             {}});
      continue;
    }
    if (!rowOfKey_.try_emplace(normalizedKey(key), rowLines_.size()).second) {
      diagnostics.push_back({Severity::Warning,
                             {file_, line + 1, 1},
                             fmt::format("row {} appears twice; the first one counts", excerptOf(key)),
                             excerptOf(content),
                             "remove one of the two rows",
                             {}});
      continue;
    }
    rowLines_.push_back(line);
    for (std::size_t column = 0; column < columns_.size(); ++column)
      noteShape(line, column);
    warnOfCrossing(line, diagnostics);
  }
  if (line == lines_.size()) {
    diagnostics.push_back({Severity::Warning,
                           {file_, lines_.size(), 0},
                           "the table ends without the line [END]; it may be cut off",
                           {},
                           "check that the file was transferred completely",
                           {}});
  }
}

void TextTable::warnOfCrossing(std::size_t line, Diagnostics& diagnostics) const {
  const std::string_view content = std::string_view(lines_[line]).substr(0, contentSize(line));
  for (std::size_t column = 1; column < columns_.size(); ++column) {
    const std::size_t begin = byteOf(content, columns_[column].start);
    if (begin == 0 || begin >= content.size() || isBlank(content[begin]) || isBlank(content[begin - 1])) continue;
    diagnostics.push_back(
        {Severity::Warning,
         {file_, line + 1, static_cast<std::uint32_t>(begin + 1)},
         fmt::format("an entry reaches across the beginning of column {}", excerptOf(columns_[column].name)),
         excerptOf(content),
         "entries stand below the name of their column; move it there",
         {}});
    return;
  }
}

void TextTable::noteShape(std::size_t line, std::size_t column) {
  const std::string_view text = trimmedCell(line, column);
  if (text.empty()) return;
  Shape& shape = shapes_[column];
  if (!shape.text && !shape.number) {
    const Field place = field(line, column);
    const std::string_view whole = std::string_view(lines_[line]).substr(place.begin, place.end - place.begin);
    const std::size_t width = columns_[column].end == TableColumn::toLineEnd
                                  ? characters(whole)
                                  : columns_[column].end - columns_[column].start;
    const std::size_t lead = characters(whole.substr(0, static_cast<std::size_t>(text.data() - whole.data())));
    shape.right = lead > 0 && lead + characters(text) + 1 >= width;
  }
  if (!parseDecimal(text)) {
    shape.text = true;
    return;
  }
  shape.number = true;
  if (text.front() == '+') shape.plus = true;
  if (const std::size_t point = text.find('.'); point != std::string_view::npos) {
    shape.decimals = std::max(shape.decimals, static_cast<int>(std::min<std::size_t>(text.size() - point - 1, 12)));
  }
}

std::size_t TextTable::contentSize(std::size_t line) const {
  std::size_t size = lines_[line].size();
  if (size > 0 && lines_[line][size - 1] == '\n') --size;
  if (size > 0 && lines_[line][size - 1] == '\r') --size;
  return size;
}

namespace {

/// True if eight characters of one byte each come first.
bool isAsciiFor8(std::string_view text) {
  std::uint64_t bytes = 0;
  if (text.size() < sizeof bytes) return false;
  std::memcpy(&bytes, text.data(), sizeof bytes);
  return (bytes & 0x8080808080808080U) == 0;
}

}  // namespace

std::size_t TextTable::byteOf(std::string_view content, std::size_t character) const {
  if (!utf8_) return std::min(character, content.size());
  std::size_t byte = 0;
  while (character > 0 && byte < content.size()) {
    const std::size_t step = character >= 8 && isAsciiFor8(content.substr(byte)) ? 8 : 1;
    byte += step;
    character -= step;
    while (byte < content.size() && continuesCharacter(content[byte]))
      ++byte;
  }
  return byte;
}

std::size_t TextTable::characters(std::string_view text) const { return utf8_ ? characterCount(text) : text.size(); }

TextTable::Field TextTable::field(std::size_t line, std::size_t column) const {
  const std::string_view content = std::string_view(lines_[line]).substr(0, contentSize(line));
  const std::size_t begin = byteOf(content, columns_[column].start);
  const bool last = columns_[column].end == TableColumn::toLineEnd;
  return {begin, last ? content.size() : byteOf(content, columns_[column].end)};
}

std::string_view TextTable::trimmedCell(std::size_t line, std::size_t column) const {
  const Field place = field(line, column);
  return trimmed(std::string_view(lines_[line]).substr(place.begin, place.end - place.begin));
}

std::optional<std::size_t> TextTable::findColumn(std::string_view column) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(),
                                  [column](const TableColumn& candidate) { return candidate.name == column; });
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::optional<std::size_t> TextTable::findRow(std::string_view key) const {
  const auto found = rowOfKey_.find(normalizedKey(key));
  if (found == rowOfKey_.end()) return std::nullopt;
  return found->second;
}

std::vector<std::string> TextTable::keys() const {
  std::vector<std::string> keys;
  keys.reserve(rowLines_.size());
  for (const std::size_t line : rowLines_)
    keys.emplace_back(trimmedCell(line, keyColumn_));
  return keys;
}

std::optional<std::string> TextTable::cell(std::string_view row, std::string_view column) const {
  const auto rowIndex = findRow(row);
  const auto columnIndex = findColumn(column);
  if (!rowIndex || !columnIndex) return std::nullopt;
  return std::string(trimmedCell(rowLines_[*rowIndex], *columnIndex));
}

SourcePlace TextTable::place(std::string_view row, std::string_view column) const {
  const auto rowIndex = findRow(row);
  const auto columnIndex = findColumn(column);
  if (!rowIndex || !columnIndex) return {file_, 0, 0};
  const std::size_t line = rowLines_[*rowIndex];
  return {file_, line + 1, static_cast<std::uint32_t>(field(line, *columnIndex).begin + 1)};
}

tl::unexpected<Diagnostic> TextTable::failAt(std::size_t line, std::size_t column, std::string message,
                                             std::string advice) const {
  Diagnostic error;
  error.place = {file_, line + 1, static_cast<std::uint32_t>(field(line, column).begin + 1)};
  error.message = std::move(message);
  error.excerpt = excerptOf(std::string_view(lines_[line]).substr(0, contentSize(line)));
  error.advice = std::move(advice);
  return tl::unexpected(error);
}

Result<void> TextTable::checkCell(std::size_t line, std::size_t column, std::string_view text) const {
  const TableColumn& place = columns_[column];
  const bool unprintable =
      std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (unprintable || (utf8_ && !probewright::isUtf8(text))) {
    return failAt(line, column, fmt::format("column {} cannot hold this text", place.name),
                  "use one line of printable text in the encoding of the table");
  }
  const std::size_t capacity =
      place.end == TableColumn::toLineEnd ? TableColumn::toLineEnd : place.end - place.start - 1;
  if (characters(text) > capacity) {
    return failAt(line, column,
                  fmt::format("\"{}\" is too wide for column {}, which holds {} characters", excerptOf(text),
                              place.name, capacity),
                  "shorten the entry, or widen the column in the header line and in all rows");
  }
  return {};
}

void TextTable::writeCell(std::size_t line, std::size_t column, std::string_view text) {
  const TableColumn& place = columns_[column];
  std::string& bytes = lines_[line];
  const std::size_t missing = [&] {
    const std::size_t length = characters(std::string_view(bytes).substr(0, contentSize(line)));
    return place.start > length ? place.start - length : 0;
  }();
  bytes.insert(contentSize(line), missing, ' ');

  const Field old = field(line, column);
  const std::string_view whole = std::string_view(bytes).substr(old.begin, old.end - old.begin);
  const std::string_view before = trimmed(whole);
  const std::size_t size = characters(text);
  const bool last = place.end == TableColumn::toLineEnd;
  const std::size_t oldWidth = characters(whole);
  const std::size_t width = last ? std::max(oldWidth, size) : place.end - place.start;
  std::size_t lead = 0;
  if (before.empty()) {
    if (shapes_[column].right && !last && size + 1 <= width) lead = width - 1 - size;
  } else {
    const std::size_t oldLead = characters(whole.substr(0, static_cast<std::size_t>(before.data() - whole.data())));
    const std::size_t oldEnd = oldLead + characters(before);
    const bool rightAligned = oldLead > 0 && oldEnd + 1 >= width;
    lead = rightAligned ? (oldEnd > size ? oldEnd - size : 0) : oldLead;
    if (lead + size + (last ? 0 : 1) > width) lead = last ? oldLead : width - 1 - size;
  }
  std::string cell(lead, ' ');
  cell += text;
  // A line that ends within this column needs no blanks after the entry, except those it already had.
  const std::size_t padTo = oldWidth;
  if (lead + size < padTo) cell.append(padTo - lead - size, ' ');
  bytes.replace(old.begin, old.end - old.begin, cell);
}

Result<void> TextTable::setCell(std::string_view row, std::string_view column, std::string_view text) {
  const auto columnIndex = findColumn(column);
  if (!columnIndex) {
    return fail(SourcePlace{file_, headerLine_ + 1, 0}, fmt::format("the table has no column {}", column),
                "add the column on the control, or use a table that has it");
  }
  const auto rowIndex = findRow(row);
  if (!rowIndex) {
    return fail(SourcePlace{file_, 0, 0}, fmt::format("the table has no row {}", row), "add the row to the table");
  }
  if (*columnIndex == keyColumn_) {
    return failAt(rowLines_[*rowIndex], keyColumn_, "the number of a row cannot be changed", "add a new row instead");
  }
  text = trimmed(text);
  const std::size_t line = rowLines_[*rowIndex];
  if (auto checked = checkCell(line, *columnIndex, text); !checked) return checked;
  if (trimmedCell(line, *columnIndex) == text) return {};
  writeCell(line, *columnIndex, text);
  noteShape(line, *columnIndex);
  return {};
}

NumberStyle TextTable::numberStyle(std::string_view column, const NumberStyle& fallback) const {
  const auto index = findColumn(column);
  if (!index) return fallback;
  const Shape& shape = shapes_[*index];
  return {shape.decimals >= 0 ? shape.decimals : fallback.decimals, shape.number ? shape.plus : fallback.plusSign};
}

Result<void> TextTable::setNumber(std::string_view row, std::string_view column, double value,
                                  const NumberStyle& style) {
  if (!std::isfinite(value)) {
    return fail(place(row, column), fmt::format("column {} takes only finite numbers", column));
  }
  const NumberStyle actual = numberStyle(column, style);
  return setCell(row, column,
                 actual.plusSign ? formatSigned(value, actual.decimals) : formatFixed(value, actual.decimals));
}

Result<void> TextTable::addRow(std::string_view key) {
  key = trimmed(key);
  if (findRow(key)) return fail(SourcePlace{file_, 0, 0}, fmt::format("row {} exists already", key));
  if (key.empty() || key == "[END]" || words(key).size() != 1) {
    return fail(SourcePlace{file_, 0, 0}, fmt::format("\"{}\" cannot name a row", excerptOf(key)), "use a number");
  }
  if (auto checked = checkCell(headerLine_, keyColumn_, key); !checked) return checked;

  const auto number = parseDecimal(key);
  std::size_t at = rowLines_.size();
  while (number && at > 0) {
    const auto other = parseDecimal(trimmedCell(rowLines_[at - 1], keyColumn_));
    if (!other || *other < *number) break;
    --at;
  }
  // After the row before it, or before the row after it, or after the header.
  std::size_t line = headerLine_ + 1;
  if (at > 0) {
    line = rowLines_[at - 1] + 1;
  } else if (!rowLines_.empty()) {
    line = rowLines_[0];
  }
  const std::size_t model = rowLines_.empty() ? headerLine_ : rowLines_[at > 0 ? at - 1 : 0];
  std::string lineEnd = lines_[model].substr(contentSize(model));
  if (!lineEnd.ends_with('\n')) lineEnd = lines_[headerLine_].ends_with("\r\n") ? "\r\n" : "\n";
  std::string& previous = lines_[line - 1];
  if (previous.ends_with('\r')) {
    previous += '\n';
  } else if (!previous.ends_with('\n')) {
    previous += lineEnd;
  }
  const std::size_t width = characters(std::string_view(lines_[model]).substr(0, contentSize(model)));
  lines_.insert(lines_.begin() + static_cast<std::ptrdiff_t>(line), std::string(width, ' ') + lineEnd);
  for (std::size_t& rowLine : rowLines_) {
    if (rowLine >= line) ++rowLine;
  }
  for (auto& [name, index] : rowOfKey_) {
    if (index >= at) ++index;
  }
  rowLines_.insert(rowLines_.begin() + static_cast<std::ptrdiff_t>(at), line);
  rowOfKey_.emplace(normalizedKey(key), at);
  writeCell(line, keyColumn_, key);
  noteShape(line, keyColumn_);
  return {};
}

std::string TextTable::bytes() const {
  std::string bytes;
  for (const std::string& line : lines_)
    bytes += line;
  return bytes;
}

}  // namespace probewright::control::heidenhain

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.hpp"

/// The text tables of HEIDENHAIN controls (TOOL.T, TCHPROBE.TP, PRESET.PR, datum tables .D, user tables .TAB).
///
///     BEGIN TOOL.T MM
///     T     NAME            L           R
///     1     PROBE           +120.5      +3
///     [END]
///
/// The names in the header line stand where their columns begin; a column reaches to the beginning of the next one.
namespace probewright::control::heidenhain {

enum class TableUnit { Millimetre, Inch };

/// Places count characters from 0: bytes in a table in a one-byte code page, code points in a UTF-8 table.
struct TableColumn {
  static constexpr std::size_t toLineEnd = static_cast<std::size_t>(-1);
  std::string name;
  std::size_t start = 0;
  std::size_t end = toLineEnd;  ///< where the next column starts
};

/// How a number is written where the column shows no example.
struct NumberStyle {
  int decimals = 4;
  bool plusSign = true;  ///< "+12.5000" instead of "12.5000"
};

/// One table, held as the bytes of its file. Whatever isn't set stays as it was: unknown columns, spacing, line ends,
/// definition blocks between #STRUCTBEGIN and #STRUCTEND, text after [END].
///
/// A row is named by its key: the text of column T, NO, NR or D (the first of these that exists, otherwise the first
/// column). Numeric keys compare as numbers: "5.10" is "5.1". Column names compare exactly.
class TextTable {
public:
  /// Reads a table. Errors: no BEGIN line, no header line, NUL bytes. Warnings go to `diagnostics`: missing [END], a
  /// key or a column that comes twice (the first one counts), a row without a key (kept, not accessible), an entry that
  /// reaches into the next column.
  static Result<TextTable> parse(std::string_view bytes, std::string file, Diagnostics& diagnostics);

  /// An empty table: the BEGIN line, the header line and [END].
  struct NewColumn {
    std::string_view name;
    std::size_t width = 0;  ///< characters, with the separating blank
  };
  static TextTable create(std::string_view name, TableUnit unit, std::span<const NewColumn> columns);

  const std::string& file() const { return file_; }
  const std::string& name() const { return name_; }  ///< as the BEGIN line names it, without blanks
  TableUnit unit() const { return unit_; }
  bool isUtf8() const { return utf8_; }
  std::span<const TableColumn> columns() const { return columns_; }
  const TableColumn& keyColumn() const { return columns_[keyColumn_]; }
  bool hasColumn(std::string_view column) const { return findColumn(column).has_value(); }
  bool hasRow(std::string_view key) const { return findRow(key).has_value(); }
  /// The keys in the order of the file.
  std::vector<std::string> keys() const;

  /// The bytes of a cell without surrounding blanks, in the encoding of the file; nothing if there is no such cell.
  std::optional<std::string> cell(std::string_view row, std::string_view column) const;

  /// Where a cell stands, for messages; line 0 if there is no such cell.
  SourcePlace place(std::string_view row, std::string_view column) const;

  /// Replaces the text of one cell and nothing else. `text` is in the encoding of the file. Errors: no such row or
  /// column, text wider than the column, line breaks, text that isn't UTF-8 in a UTF-8 table.
  Result<void> setCell(std::string_view row, std::string_view column, std::string_view text);

  /// Writes a number with as many decimals as the column shows (`style` if it shows none) and a plus sign if the column
  /// shows one. Error if it isn't finite or doesn't fit.
  Result<void> setNumber(std::string_view row, std::string_view column, double value, const NumberStyle& style = {});

  /// Inserts an empty row after the last row with a smaller key. Error if the row exists or the key doesn't fit.
  Result<void> addRow(std::string_view key);

  /// How numbers of this column are written.
  NumberStyle numberStyle(std::string_view column, const NumberStyle& fallback) const;

  std::string bytes() const;

private:
  struct Field {
    std::size_t begin, end;  ///< bytes in the line
  };
  /// What the cells of a column look like.
  struct Shape {
    int decimals = -1;  ///< -1: no cell has a decimal point
    bool plus = false, number = false, text = false, right = false;
  };

  std::optional<std::size_t> findColumn(std::string_view column) const;
  std::optional<std::size_t> findRow(std::string_view key) const;
  std::size_t contentSize(std::size_t line) const;
  std::size_t byteOf(std::string_view content, std::size_t character) const;
  std::size_t characters(std::string_view text) const;
  Field field(std::size_t line, std::size_t column) const;
  std::string_view trimmedCell(std::size_t line, std::size_t column) const;
  void readHeader(std::size_t line, Diagnostics& diagnostics);
  void readRows(std::size_t first, Diagnostics& diagnostics);
  void warnOfCrossing(std::size_t line, Diagnostics& diagnostics) const;
  void noteShape(std::size_t line, std::size_t column);
  void writeCell(std::size_t line, std::size_t column, std::string_view text);
  Result<void> checkCell(std::size_t line, std::size_t column, std::string_view text) const;
  tl::unexpected<Diagnostic> failAt(std::size_t line, std::size_t column, std::string message,
                                    std::string advice) const;

  std::string file_, name_;
  TableUnit unit_ = TableUnit::Millimetre;
  bool utf8_ = true;
  std::vector<std::string> lines_;  ///< with their line ends
  std::vector<TableColumn> columns_;
  std::vector<Shape> shapes_;
  std::size_t keyColumn_ = 0;
  std::size_t headerLine_ = 0;
  std::vector<std::size_t> rowLines_;                      ///< rows in the order of the file
  std::unordered_map<std::string, std::size_t> rowOfKey_;  ///< normalized key -> index into rowLines_
};

}  // namespace probewright::control::heidenhain

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "control/control_kind.hpp"
#include "control/heidenhain/columns.hpp"
#include "control/heidenhain/text_table.hpp"

/// Tables whose columns are known: numbers with units in place of text.
namespace probewright::control::heidenhain {

enum class CellKind {
  Integer,
  Length,  ///< mm here, inches in the file of an inch table
  Feed,    ///< mm/min here, 1 inch/min in the file of an inch table
  Angle,   ///< degrees
  Number,  ///< without a unit, or with one that inch tables keep (minutes)
  Text,
};

/// One known column. `decimals` is what the control shows in a millimetre table; lengths in an inch table have one
/// more.
struct ColumnSpec {
  Column column;
  std::string_view otherName;  ///< the name on other versions of the control; may be empty
  std::size_t width = 0;       ///< in tables created here, with the separating blank
  CellKind kind = CellKind::Text;
  int decimals = 0;
  std::string_view meaning;
  std::string_view initial = {};    ///< text of a new row
  ControlSet controls = onBothTNC;  ///< in tables created here: left out on the others
  std::string_view signs =
      {};  ///< the entries of a text, one character each; an empty cell counts as the first; none: any text

  constexpr std::string_view name() const { return column.name(); }
};

/// A text table and what its columns mean. Columns may be named by either of their names; unknown columns stay
/// reachable through `text`.
class TypedTable {
public:
  TypedTable(TextTable table, std::span<const ColumnSpec> columns) : table_(std::move(table)), columns_(columns) {}

  /// Reads and checks a table: an entry of a known number column that isn't a number is an error in `diagnostics`, and
  /// so are a text that its column does not have and a missing key column. The table is usable all the same: such a
  /// cell counts as empty.
  static Result<TypedTable> parse(std::string_view bytes, std::string file, std::span<const ColumnSpec> columns,
                                  Diagnostics& diagnostics);

  /// A table with the columns of `kind` and rows 0 to `rows` - 1.
  static TypedTable create(std::string_view name, TableUnit unit, std::span<const ColumnSpec> columns, ControlKind kind,
                           std::size_t rows);

  const TextTable& table() const { return table_; }
  TextTable& table() { return table_; }

  bool hasRow(std::string_view row) const { return table_.hasRow(row); }
  bool hasColumn(Column column) const { return table_.hasColumn(nameInFile(column.name())); }

  /// The number in mm, degrees, mm/min; nothing if the row, the column or the entry is missing.
  std::optional<double> number(std::string_view row, NumberColumn column) const;
  double numberOr(std::string_view row, NumberColumn column, double fallback) const {
    return number(row, column).value_or(fallback);
  }
  /// The text of the cell; empty if there is none.
  std::string text(std::string_view row, Column column) const;

  /// Writes a number given in mm, degrees, mm/min. A missing row is added. Errors as TextTable::setNumber.
  Result<void> setNumber(std::string_view row, NumberColumn column, double value);
  Result<void> setText(std::string_view row, Column column, std::string_view value);

  /// Adds a row with the initial entries of its columns; does nothing if it exists.
  Result<void> ensureRow(std::string_view row);

  Diagnostics check() const;

private:
  const ColumnSpec* find(std::string_view column) const;
  std::string_view nameInFile(std::string_view column) const;
  double millimetresPerUnit(const ColumnSpec* spec) const;

  TextTable table_;
  std::span<const ColumnSpec> columns_;
};

}  // namespace probewright::control::heidenhain

#include "control/heidenhain/typed_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/number_text.hpp"

namespace probewright::control::heidenhain {

namespace {

constexpr double millimetresPerInch = 25.4;

/// Adds the row and lets `set` write into it; adds nothing if that fails.
template <class Set>
Result<void> inNewRow(TypedTable& table, std::string_view row, const Set& set) {
  TypedTable grown = table;
  if (auto added = grown.ensureRow(row); !added) return added;
  if (auto done = set(grown); !done) return done;
  table = std::move(grown);
  return {};
}

/// What is wrong with an entry, and what to write.
struct Mistake {
  std::string message, advice;
};

std::optional<Mistake> mistakeIn(std::string_view entry, const ColumnSpec& column, std::string_view name) {
  if (column.kind == CellKind::Text) {
    if (column.signs.empty() || (entry.size() == 1 && column.signs.find(entry.front()) != std::string_view::npos))
      return std::nullopt;
    return Mistake{fmt::format("column {} takes {}", name, fmt::join(column.signs, " or ")),
                   fmt::format("{}; an empty entry is {}", column.meaning, column.signs.front())};
  }
  const auto value = parseDecimal(entry);
  const bool isWhole = column.kind == CellKind::Integer;
  if (value && (!isWhole || *value == std::round(*value))) return std::nullopt;
  return Mistake{fmt::format("column {} takes a {}number", name, isWhole ? "whole " : ""),
                 isWhole ? "write a number without decimal places, or leave the entry empty"
                         : "write a number with a decimal point, or leave the entry empty"};
}

}  // namespace

Result<TypedTable> TypedTable::parse(std::string_view bytes, std::string file, std::span<const ColumnSpec> columns,
                                     Diagnostics& diagnostics) {
  auto table = TextTable::parse(bytes, std::move(file), diagnostics);
  if (!table) return tl::unexpected(table.error());
  TypedTable typed(std::move(*table), columns);
  const Diagnostics found = typed.check();
  diagnostics.insert(diagnostics.end(), found.begin(), found.end());
  return typed;
}

TypedTable TypedTable::create(std::string_view name, TableUnit unit, std::span<const ColumnSpec> columns,
                              ControlKind kind, std::size_t rows) {
  std::vector<TextTable::NewColumn> header;
  for (const ColumnSpec& column : columns) {
    if (column.controls.contains(kind))
      header.push_back({column.name(), std::max(column.width, column.name().size() + 1)});
  }
  TypedTable table(TextTable::create(name, unit, header), columns);
  for (std::size_t row = 0; row < rows; ++row) {
    if (auto added = table.ensureRow(std::to_string(row)); !added) throw std::logic_error(added.error().message);
  }
  return table;
}

Diagnostics TypedTable::check() const {
  Diagnostics diagnostics;
  const ColumnSpec& key = columns_.front();
  if (table_.keyColumn().name != key.name() && table_.keyColumn().name != key.otherName) {
    diagnostics.push_back({Severity::Error,
                           {table_.file(), 0, 0},
                           fmt::format("the table has no column {}; rows cannot be found", key.name()),
                           {},
                           "check that this is the right kind of table",
                           {}});
    return diagnostics;
  }
  // Tables of different kinds may have the same key.
  std::string_view missing;
  for (const ColumnSpec& column : columns_) {
    const std::string_view name = nameInFile(column.name());
    if (name == table_.keyColumn().name) continue;
    if (table_.hasColumn(name)) {
      missing = {};
      break;
    }
    if (missing.empty() && column.kind != CellKind::Text) missing = name;
  }
  if (!missing.empty()) {
    diagnostics.push_back({Severity::Error,
                           {table_.file(), 0, 0},
                           fmt::format("the table has none of the columns that are read from it, such as {}", missing),
                           {},
                           "check that this is the right kind of table",
                           {}});
    return diagnostics;
  }
  for (const std::string& row : table_.keys()) {
    for (const ColumnSpec& column : columns_) {
      const std::string_view name = nameInFile(column.name());
      const auto entry = table_.cell(row, name);
      if (!entry || entry->empty()) continue;
      if (auto wrong = mistakeIn(*entry, column, name))
        diagnostics.push_back({Severity::Error,
                               table_.place(row, name),
                               std::move(wrong->message),
                               entry->substr(0, 60),
                               std::move(wrong->advice),
                               {}});
    }
  }
  return diagnostics;
}

const ColumnSpec* TypedTable::find(std::string_view column) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(), [column](const ColumnSpec& spec) {
    return spec.name() == column || (!spec.otherName.empty() && spec.otherName == column);
  });
  return found == columns_.end() ? nullptr : &*found;
}

std::string_view TypedTable::nameInFile(std::string_view column) const {
  if (table_.hasColumn(column)) return column;
  const ColumnSpec* spec = find(column);
  if (spec == nullptr) return column;
  return table_.hasColumn(spec->name()) || spec->otherName.empty() ? spec->name() : spec->otherName;
}

double TypedTable::millimetresPerUnit(const ColumnSpec* spec) const {
  const bool length = spec != nullptr && (spec->kind == CellKind::Length || spec->kind == CellKind::Feed);
  return length && table_.unit() == TableUnit::Inch ? millimetresPerInch : 1.0;
}

std::optional<double> TypedTable::number(std::string_view row, NumberColumn column) const {
  const auto entry = table_.cell(row, nameInFile(column.name()));
  if (!entry) return std::nullopt;
  const auto value = parseDecimal(*entry);
  if (!value) return std::nullopt;
  return *value * millimetresPerUnit(find(column.name()));
}

std::string TypedTable::text(std::string_view row, Column column) const {
  return table_.cell(row, nameInFile(column.name())).value_or(std::string());
}

Result<void> TypedTable::setNumber(std::string_view row, NumberColumn column, double value) {
  if (!hasRow(row)) return inNewRow(*this, row, [&](TypedTable& grown) { return grown.setNumber(row, column, value); });
  const ColumnSpec* spec = find(column.name());
  const std::string_view name = nameInFile(column.name());
  const double written = value / millimetresPerUnit(spec);
  if (spec == nullptr || !std::isfinite(value)) return table_.setNumber(row, name, written);
  const bool signedKind = spec->kind == CellKind::Length || spec->kind == CellKind::Angle;
  NumberStyle style = {spec->decimals, signedKind};
  if (spec->kind == CellKind::Length && table_.unit() == TableUnit::Inch) ++style.decimals;
  // Entries that somebody has typed in short say nothing of how exactly the control counts.
  const NumberStyle shown = table_.numberStyle(name, style);
  for (int decimals = std::max(shown.decimals, style.decimals);; --decimals) {
    auto set =
        table_.setCell(row, name, shown.plusSign ? formatSigned(written, decimals) : formatFixed(written, decimals));
    // A column that is too narrow for them gets as many as it has room for.
    if (set || decimals <= shown.decimals) return set;
  }
}

Result<void> TypedTable::setText(std::string_view row, Column column, std::string_view value) {
  if (!hasRow(row)) return inNewRow(*this, row, [&](TypedTable& grown) { return grown.setText(row, column, value); });
  return table_.setCell(row, nameInFile(column.name()), value);
}

Result<void> TypedTable::ensureRow(std::string_view row) {
  if (table_.hasRow(row)) return {};
  if (auto added = table_.addRow(row); !added) return added;
  for (const ColumnSpec& column : columns_) {
    if (column.initial.empty() || !hasColumn(column.column)) continue;
    const auto initial = parseDecimal(column.initial);
    auto set = initial && column.kind != CellKind::Text
                   ? setNumber(row, NumberColumn::named(column.name()), *initial)
                   : table_.setCell(row, nameInFile(column.name()), column.initial);
    if (!set) return set;
  }
  return {};
}

}  // namespace probewright::control::heidenhain

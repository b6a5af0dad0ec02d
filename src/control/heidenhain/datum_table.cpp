#include "control/heidenhain/datum_table.hpp"

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

constexpr std::array columns = {
    ColumnSpec{"D", "NR", 7, Integer, 0, "number of the datum"},
    ColumnSpec{"X", "", 14, Length, 4, "shift", "0"},
    ColumnSpec{"Y", "", 14, Length, 4, "shift", "0"},
    ColumnSpec{"Z", "", 14, Length, 4, "shift", "0"},
    ColumnSpec{"A", "", 14, Angle, 4, "shift of the rotary axis", "0"},
    ColumnSpec{"B", "", 14, Angle, 4, "shift of the rotary axis", "0"},
    ColumnSpec{"C", "", 14, Angle, 4, "shift of the rotary axis", "0"},
    ColumnSpec{"U", "", 14, Length, 4, "shift of the parallel axis", "0"},
    ColumnSpec{"V", "", 14, Length, 4, "shift of the parallel axis", "0"},
    ColumnSpec{"W", "", 14, Length, 4, "shift of the parallel axis", "0"},
    ColumnSpec{"DOC", "", 17, Text, 0, "comment"},
};

}  // namespace

std::span<const ColumnSpec> datumColumns() { return columns; }

TypedTable defaultDatumTable(ControlKind kind, std::string_view name, TableUnit unit) {
  return TypedTable::create(name, unit, columns, kind, 1);
}

std::optional<Datum> findDatum(const TypedTable& table, int number) {
  const std::string row = std::to_string(number);
  if (!table.hasRow(row)) return std::nullopt;
  constexpr std::array<NumberColumn, 9> names = {"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
  std::array<double, 9> values = {};
  for (std::size_t i = 0; i < names.size(); ++i)
    values[i] = table.numberOr(row, names[i], 0.0);
  return Datum{{values[0], values[1], values[2]},
               {values[3], values[4], values[5]},
               {values[6], values[7], values[8]},
               table.text(row, "DOC")};
}

}  // namespace probewright::control::heidenhain

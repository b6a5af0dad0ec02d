#include "control/heidenhain/deflection_table.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "base/text.hpp"

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

constexpr std::array columns = {
    ColumnSpec{"NR", "", 6, Integer, 0, "number of the row"},
    ColumnSpec{"ANGLE-V", "", 12, Angle, 4, "probing direction, from the direction of the stylus"},
    ColumnSpec{"ANGLE-H", "", 12, Angle, 4, "probing direction, from the main towards the minor axis"},
    ColumnSpec{"DR", "", 14, Length, 6, "what is added to the effective ball radius"},
};

}  // namespace

std::span<const ColumnSpec> deflectionColumns() { return columns; }

Result<TypedTable> deflectionTable(const std::string& name, const std::vector<Deflection>& rows) {
  TypedTable table = TypedTable::create(name, TableUnit::Millimetre, columns, ControlKind::TNC640, 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string key = std::to_string(i);
    const struct {
      NumberColumn column;
      double value;
    } cells[] = {{"ANGLE-V", rows[i].polar}, {"ANGLE-H", rows[i].azimuth}, {"DR", rows[i].deviation}};
    for (const auto& [column, value] : cells) {
      if (const Result<void> set = table.setNumber(key, column, value); !set) return tl::unexpected(set.error());
    }
  }
  return table;
}

std::vector<Deflection> deflectionsOf(const TypedTable& table) {
  std::vector<Deflection> rows;
  for (const std::string& key : table.table().keys()) {
    const auto polar = table.number(key, "ANGLE-V");
    if (!polar) continue;
    rows.push_back({*polar, table.numberOr(key, "ANGLE-H", 0), table.numberOr(key, "DR", 0)});
  }
  std::ranges::sort(rows, {}, [](const Deflection& row) { return std::tuple(row.polar, row.azimuth); });
  return rows;
}

std::string deflectionTableName(std::string_view entry) {
  std::string name = upperCase(entry.substr(entry.find_last_of("\\/:") + 1));
  if (!name.empty() && !name.ends_with(".3DTC")) name += ".3DTC";
  return name;
}

}  // namespace probewright::control::heidenhain

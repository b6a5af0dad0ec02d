#include "control/heidenhain/preset_table.hpp"

#include <string>

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

constexpr std::array columns = {
    ColumnSpec{"NO", "NR", 7, Integer, 0, "number of the preset", false, true},
    ColumnSpec{"NR", "NO", 7, Integer, 0, "number of the preset", true, false},
    ColumnSpec{"DOC", "", 17, Text, 0, "comment"},
    ColumnSpec{"ROT", "", 11, Angle, 4, "basic rotation", true, false, "0"},
    ColumnSpec{"X", "", 14, Length, 4, "origin", false, false, "0"},
    ColumnSpec{"Y", "", 14, Length, 4, "origin", false, false, "0"},
    ColumnSpec{"Z", "", 14, Length, 4, "origin", false, false, "0"},
    ColumnSpec{"SPA", "", 11, Angle, 4, "spatial angle of the basic rotation about X", false, true, "0"},
    ColumnSpec{"SPB", "", 11, Angle, 4, "spatial angle of the basic rotation about Y", false, true, "0"},
    ColumnSpec{"SPC", "", 11, Angle, 4, "spatial angle of the basic rotation about Z", false, true, "0"},
    ColumnSpec{"A", "", 14, Angle, 4, "zero of the rotary axis", false, false, "0"},
    ColumnSpec{"B", "", 14, Angle, 4, "zero of the rotary axis", false, false, "0"},
    ColumnSpec{"C", "", 14, Angle, 4, "zero of the rotary axis", false, false, "0"},
    ColumnSpec{"U", "", 14, Length, 4, "zero of the parallel axis", false, false, "0"},
    ColumnSpec{"V", "", 14, Length, 4, "zero of the parallel axis", false, false, "0"},
    ColumnSpec{"W", "", 14, Length, 4, "zero of the parallel axis", false, false, "0"},
    ColumnSpec{"X_OFFS", "", 14, Length, 4, "axis offset", false, true, "0"},
    ColumnSpec{"Y_OFFS", "", 14, Length, 4, "axis offset", false, true, "0"},
    ColumnSpec{"Z_OFFS", "", 14, Length, 4, "axis offset", false, true, "0"},
    ColumnSpec{"A_OFFS", "", 14, Angle, 4, "axis offset", false, true, "0"},
    ColumnSpec{"B_OFFS", "", 14, Angle, 4, "axis offset", false, true, "0"},
    ColumnSpec{"C_OFFS", "", 14, Angle, 4, "axis offset", false, true, "0"},
    ColumnSpec{"U_OFFS", "", 14, Length, 4, "axis offset", false, true, "0"},
    ColumnSpec{"V_OFFS", "", 14, Length, 4, "axis offset", false, true, "0"},
    ColumnSpec{"W_OFFS", "", 14, Length, 4, "axis offset", false, true, "0"},
    ColumnSpec{"ACTNO", "", 7, Integer, 0, "number of the active preset, entered by the control", false, true},
    ColumnSpec{"LOCKED", "", 17, Text, 0, "any entry: the row is write-protected", false, true},
};

constexpr std::array<std::string_view, 3> originColumns = {"X", "Y", "Z"};
constexpr std::array<std::string_view, 3> rotationColumns = {"SPA", "SPB", "SPC"};
constexpr std::array<std::string_view, 3> rotaryColumns = {"A", "B", "C"};
constexpr std::array<std::string_view, 3> parallelColumns = {"U", "V", "W"};
constexpr std::array<std::string_view, 9> offsetColumns = {"X_OFFS", "Y_OFFS", "Z_OFFS", "A_OFFS", "B_OFFS",
                                                           "C_OFFS", "U_OFFS", "V_OFFS", "W_OFFS"};

/// Calls visit(column, value) for each number of the preset.
template <class AnyPreset, class Visit>
void forEachNumber(AnyPreset& preset, bool hasRot, Visit visit) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    visit(originColumns[i], preset.origin[axis]);
    if (!hasRot) visit(rotationColumns[i], preset.rotation[axis]);
    visit(rotaryColumns[i], preset.rotary[i]);
    visit(parallelColumns[i], preset.parallel[i]);
  }
  if (hasRot) visit("ROT", preset.rotation[2]);
  for (std::size_t i = 0; i < offsetColumns.size(); ++i)
    visit(offsetColumns[i], preset.offsets[i]);
}

bool usesRot(const TypedTable& table) { return table.hasColumn("ROT") && !table.hasColumn("SPC"); }

}  // namespace

std::span<const ColumnSpec> presetColumns() { return columns; }

TypedTable defaultPresetTable(ControlKind kind, TableUnit unit, std::size_t rows) {
  return TypedTable::create("PRESET.PR", unit, columns, kind, rows);
}

std::optional<Preset> findPreset(const TypedTable& table, int number) {
  const std::string row = std::to_string(number);
  if (!table.hasRow(row)) return std::nullopt;
  Preset preset;
  forEachNumber(preset, usesRot(table),
                [&](std::string_view column, double& value) { value = table.numberOr(row, column, 0.0); });
  preset.comment = table.text(row, "DOC");
  preset.locked = !table.text(row, "LOCKED").empty();
  return preset;
}

Result<void> setPreset(TypedTable& table, int number, const Preset& preset) {
  const std::string row = std::to_string(number);
  Result<void> result = table.ensureRow(row);
  forEachNumber(preset, usesRot(table), [&](std::string_view column, const double& value) {
    if (!result || !table.hasColumn(column)) return;
    if (table.numberOr(row, column, 0.0) == value) return;
    result = table.setNumber(row, column, value);
  });
  return result;
}

}  // namespace probewright::control::heidenhain

#pragma once

#include "control/heidenhain/typed_table.hpp"

/// The tool table TOOL.T: one row per tool, or per step of a tool (5, 5.1, 5.2).
namespace probewright::control::heidenhain {

/// The columns of TOOL.T that have a meaning here. Source: spec pages on tool measurement and calibration; widths and
/// decimals as the controls write them.
std::span<const ColumnSpec> toolColumns();

/// An empty tool table as a new control has it: row 0 with length and radius 0.
TypedTable defaultToolTable(ControlKind kind, TableUnit unit = TableUnit::Millimetre);

/// The key of the first row with this name, or nothing. Names compare exactly.
std::optional<std::string> findToolNamed(const TypedTable& table, std::string_view name);

/// "5", "5.1" from the number of a TOOL CALL with its step.
std::string toolKey(int number, int step = 0);

}  // namespace probewright::control::heidenhain

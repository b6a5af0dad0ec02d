#pragma once

#include "control/heidenhain/typed_table.hpp"

/// The turning tool table TOOLTURN.TRN of a TNC 640: one row per turning tool, with the number of its row in TOOL.T,
/// where column TYP says TURN. Source: spec page of cycle 485.
namespace probewright::control::heidenhain {

std::span<const ColumnSpec> turningToolColumns();

/// A table without rows.
TypedTable defaultTurningToolTable(TableUnit unit = TableUnit::Millimetre);

}  // namespace probewright::control::heidenhain

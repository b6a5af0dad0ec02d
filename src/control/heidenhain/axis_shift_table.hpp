#pragma once

#include "control/heidenhain/typed_table.hpp"

/// AXSHIFT.TAB: where cycle 440 found the tool touch probe when it calibrated, one row per traverse range. The manuals
/// name no place for these data; name and layout of the table are Probewright's.
namespace probewright::control::heidenhain {

std::span<const ColumnSpec> axisShiftColumns();

TypedTable defaultAxisShiftTable();

}  // namespace probewright::control::heidenhain

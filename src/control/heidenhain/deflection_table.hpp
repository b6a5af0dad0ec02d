#pragma once

#include <string>
#include <vector>

#include "control/heidenhain/typed_table.hpp"

/// The compensation tables *.3DTC in which a 3-D calibration keeps how a touch probe responds by direction. Source:
/// cycle 460, which leaves their layout open; the columns are Probewright's.
namespace probewright::control::heidenhain {

/// A row: touches at `polar` degrees from the direction of the stylus and `azimuth` degrees from the main towards the
/// minor axis, with the spindle at the calibration angle, need `deviation` mm on top of the ball radius.
struct Deflection {
  double polar = 0, azimuth = 0, deviation = 0;
};

std::span<const ColumnSpec> deflectionColumns();

/// A table of the given name that holds `rows`.
Result<TypedTable> deflectionTable(const std::string& name, const std::vector<Deflection>& rows);

/// All rows, by growing polar angle, then by growing azimuth.
std::vector<Deflection> deflectionsOf(const TypedTable& table);

/// The key of Tables::deflections for an entry of column DR2TABLE: its file name in capitals, with its ending.
std::string deflectionTableName(std::string_view entry);

}  // namespace probewright::control::heidenhain

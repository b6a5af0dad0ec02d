#pragma once

#include <array>

#include "control/heidenhain/typed_table.hpp"
#include "geometry/primitives.hpp"

/// Datum tables .D: shifts of the datum, called with cycle 7 or TRANS DATUM TABLE.
namespace probewright::control::heidenhain {

std::span<const ColumnSpec> datumColumns();

/// A row of a datum table; mm and degrees; entries that the table doesn't have are 0.
struct Datum {
  Vector3 shift = Vector3::Zero();      ///< X, Y, Z
  std::array<double, 3> rotary = {};    ///< A, B, C
  std::array<double, 3> parallel = {};  ///< U, V, W
  std::string comment;                  ///< DOC
};

/// A datum table with row 0, all zero. `name`: "ZEROSHIFT.D".
TypedTable defaultDatumTable(ControlKind kind, std::string_view name = "ZEROSHIFT.D",
                             TableUnit unit = TableUnit::Millimetre);

std::optional<Datum> findDatum(const TypedTable& table, int number);

}  // namespace probewright::control::heidenhain

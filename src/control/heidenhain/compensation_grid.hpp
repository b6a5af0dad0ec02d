#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "control/heidenhain/typed_table.hpp"
#include "geometry/primitives.hpp"
#include "machine/description.hpp"

/// The compensation table of cycle 453, *.kco: how much further the tip is than the axes tell, on a grid of positions
/// of the rotary axes. The manual leaves its form open.
namespace probewright::control::heidenhain {

class CompensationGrid {
public:
  struct GridAxis {
    std::size_t axis = 0;       ///< index into the machine's axes
    std::vector<double> nodes;  ///< degrees, rising
  };

  /// The grid of a table: each position of the axes that it names must be there once. Fails, naming the table's row.
  static Result<CompensationGrid> of(const TypedTable& table, const machine::MachineDescription& machine);

  const std::vector<GridAxis>& axes() const { return axes_; }
  std::size_t size() const { return values_.size(); }
  /// The positions of the axes of the grid at one of its nodes; all others are 0.
  machine::AxisPositions node(std::size_t index) const;
  const Vector3& value(std::size_t index) const { return values_[index]; }
  /// The row of the table.
  const std::string& row(std::size_t index) const { return rows_[index]; }
  void setValue(std::size_t index, const Vector3& value) { values_[index] = value; }

  /// Linear between the nodes in each axis; beyond the border the value there. Angles that differ by full turns count
  /// alike where that leads into the grid.
  Vector3 at(const machine::AxisPositions& axes) const;

  /// The table with the values of the grid.
  Result<void> enter(TypedTable& table) const;

private:
  std::vector<GridAxis> axes_;
  std::vector<Vector3> values_;    ///< the first axis varies slowest
  std::vector<std::string> rows_;  ///< of the table, by index of the values
};

}  // namespace probewright::control::heidenhain

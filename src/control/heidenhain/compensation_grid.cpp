#include "control/heidenhain/compensation_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace probewright::control::heidenhain {

namespace {

constexpr std::array<NumberColumn, 3> axisColumns = {"A", "B", "C"};
constexpr std::array<NumberColumn, 3> valueColumns = {"DX", "DY", "DZ"};

tl::unexpected<Diagnostic> failAt(const TypedTable& table, const std::string& row, std::string_view column,
                                  std::string message, std::string advice = {}) {
  return fail(table.table().place(row, column), std::move(message), std::move(advice));
}

}  // namespace

Result<CompensationGrid> CompensationGrid::of(const TypedTable& table, const machine::MachineDescription& machine) {
  CompensationGrid grid;
  const std::vector<std::string> rows = table.table().keys();
  if (rows.empty()) return fail({table.table().file()}, "the compensation table has no grid positions", "add rows");
  std::vector<NumberColumn> columns;
  for (const NumberColumn column : axisColumns) {
    if (!table.number(rows.front(), column)) continue;
    const auto axis = machine.axisIndex(column.name());
    if (!axis || machine.axes[*axis].kind != machine::AxisKind::Rotary) {
      return failAt(table, rows.front(), column.name(), fmt::format("the machine has no rotary axis {}", column.name()),
                    "leave the column empty");
    }
    GridAxis own{*axis, {}};
    for (const std::string& row : rows) {
      const auto position = table.number(row, column);
      if (!position) return failAt(table, row, column.name(), "the position of the axis is missing", "enter it");
      own.nodes.push_back(*position);
    }
    std::ranges::sort(own.nodes);
    own.nodes.erase(std::unique(own.nodes.begin(), own.nodes.end()), own.nodes.end());
    grid.axes_.push_back(std::move(own));
    columns.push_back(column);
  }
  std::size_t nodes = 1;
  for (const GridAxis& axis : grid.axes_)
    nodes *= axis.nodes.size();
  if (grid.axes_.empty() || nodes != rows.size()) {
    return fail({table.table().file()},
                fmt::format("{} rows are not a grid of {} positions", rows.size(), grid.axes_.empty() ? 0 : nodes),
                "enter every combination of the positions of its axes once");
  }
  grid.values_.assign(nodes, Vector3::Zero());
  grid.rows_.assign(nodes, {});
  for (const std::string& row : rows) {
    std::size_t index = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::vector<double>& own = grid.axes_[i].nodes;
      const auto found = std::ranges::find(own, *table.number(row, columns[i]));
      index = index * own.size() + static_cast<std::size_t>(found - own.begin());
    }
    if (!grid.rows_[index].empty()) return failAt(table, row, "NR", "this grid position is there twice", "remove one");
    grid.rows_[index] = row;
    for (std::size_t i = 0; i < 3; ++i)
      grid.values_[index][static_cast<Eigen::Index>(i)] = table.numberOr(row, valueColumns[i], 0);
  }
  return grid;
}

machine::AxisPositions CompensationGrid::node(std::size_t index) const {
  machine::AxisPositions positions;
  for (auto axis = axes_.rbegin(); axis != axes_.rend(); ++axis) {
    positions[axis->axis] = axis->nodes[index % axis->nodes.size()];
    index /= axis->nodes.size();
  }
  return positions;
}

Vector3 CompensationGrid::at(const machine::AxisPositions& axes) const {
  // One corner of the cell after the other, with its weight.
  struct Corner {
    std::size_t index = 0;
    double weight = 1;
  };
  std::vector<Corner> corners = {{}};
  for (const GridAxis& axis : axes_) {
    const std::vector<double>& nodes = axis.nodes;
    double position = axes[axis.axis];
    if (position < nodes.front() || position > nodes.back()) {
      const double turned = nodes.front() + std::fmod(std::fmod(position - nodes.front(), 360) + 360, 360);
      // Nearer to the border that is nearer on the circle.
      position = turned <= nodes.back()                                 ? turned
                 : turned - nodes.back() < nodes.front() + 360 - turned ? nodes.back()
                                                                        : nodes.front();
    }
    const auto above = std::min<std::size_t>(
        static_cast<std::size_t>(std::ranges::upper_bound(nodes, position) - nodes.begin()), nodes.size() - 1);
    const std::size_t below = above == 0 ? 0 : above - 1;
    const double share = above == below ? 0 : (position - nodes[below]) / (nodes[above] - nodes[below]);
    std::vector<Corner> next;
    for (const Corner& corner : corners) {
      next.push_back({corner.index * nodes.size() + below, corner.weight * (1 - share)});
      if (share > 0) next.push_back({corner.index * nodes.size() + above, corner.weight * share});
    }
    corners = std::move(next);
  }
  Vector3 value = Vector3::Zero();
  for (const Corner& corner : corners)
    value += corner.weight * values_[corner.index];
  return value;
}

Result<void> CompensationGrid::enter(TypedTable& table) const {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto set = table.setNumber(rows_[i], valueColumns[axis], values_[i][static_cast<Eigen::Index>(axis)] + 0.0);
      if (!set) return set;
    }
  }
  return {};
}

}  // namespace probewright::control::heidenhain

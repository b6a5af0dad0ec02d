#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/excerpt.hpp"
#include "execution/klartext/tables.hpp"
#include "language/klartext/commands.hpp"
#include "language/klartext/lexer.hpp"

/// Several columns take as many parameters, one after the other.
namespace probewright::execution::klartext {

using control::Alarm;
using control::heidenhain::NumberColumn;
using control::heidenhain::NumberStyle;
using control::heidenhain::TextTable;

namespace {

std::vector<std::string> columnsOf(std::string_view text) {
  std::vector<std::string> columns;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    std::string_view name = text.substr(0, end);
    name = trimmed(name, blanksAndReturn);
    columns.emplace_back(name);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return columns;
}

template <class T>
void orAlarm(const Result<T>& done) {
  if (!done) throw Alarm("Table write error", done.error().message, done.error().advice);
}

/// Of a number in a column that shows no decimal places: a whole one needs none.
NumberStyle styleOf(double number) {
  constexpr double half = 0.5e-4;  // of the last of four decimal places
  return std::abs(number - std::round(number)) < half ? NumberStyle{.decimals = 0} : NumberStyle{};
}

VariableRef behind(VariableRef variable, std::size_t count) {
  variable.index[0].number += static_cast<double>(count);
  return variable;
}

}  // namespace

void Tables::open(std::string_view path) {
  if (path.empty()) throw Alarm("Table missing", "FN 26 names no table", "write FN 26: TABOPEN TABLE.TAB");
  const Result<std::string> bytes = run_.readHostFile(path);
  if (!bytes) {
    throw Alarm("Table missing", fmt::format("The table {} cannot be read: {}", excerptOf(path), bytes.error().message),
                "put the table beside the program");
  }
  Diagnostics mistakes;
  Result<TextTable> table = TextTable::parse(*bytes, fileNameOf(path), mistakes);
  if (!table) throw Alarm("Table wrong", table.error().message, table.error().advice);
  table_ = std::move(*table);
}

void Tables::write(const Command& command, Evaluation& evaluation) {
  if (!table_) throw Alarm("Table missing", "No table is open for FN 27", "program FN 26: TABOPEN before it");
  const std::span<const Word> words = evaluation.words(command.words);
  const std::string row = std::to_string(std::lround(evaluation.number(words[0].value)));
  if (!table_->hasRow(row)) orAlarm(table_->addRow(row));
  const std::vector<std::string> columns = columnsOf(evaluation.at(command.text));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    Value value;
    if (command.variable >= 0) {
      const VariableRef& first = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
      value = parameters_.read(behind(first, i));
    } else {
      value = evaluation.value(words[1].value);
    }
    if (isText(value)) {
      orAlarm(table_->setCell(row, columns[i], std::get<std::string>(value)));
    } else {
      const double number = std::get<double>(value);
      orAlarm(table_->setNumber(row, columns[i], number, styleOf(number)));
    }
  }
  control_.panel.file(table_->file(), table_->bytes());
}

/// TABDATA READ, WRITE, ADD: an entry of the tool table or of the preset table, in the unit of the table's numbers: mm
/// and degrees. A preset in force changes at once.
void Tables::tableData(const Command& command, Evaluation& evaluation) {
  const CommandKind way = kindOf(evaluation.block(), command);
  std::string kind(evaluation.at(command.text));
  std::ranges::transform(kind, kind.begin(), upper);
  if (kind.starts_with("CORR")) {
    run_.leaveOut(fmt::format("{} of the correction table {}", nameOf(way), kind));
    return;
  }
  auto& table = kind == "TOOL" ? control_.tables.tools : control_.tables.presets;
  if (kind != "TOOL" && kind != "PRESET") {
    throw Alarm("Table missing", fmt::format("TABDATA knows no table {}", excerptOf(kind)), "name TOOL or PRESET");
  }
  const std::string columnName = evaluation.text(find(command.words, "COL", evaluation)->value);
  const auto column = NumberColumn::named(columnName);
  const std::string row = evaluation.text(find(command.words, "KEY", evaluation)->value);
  if (!table.hasRow(row) || !table.hasColumn(column)) {
    throw Alarm("Table entry missing",
                fmt::format("{} has no {}", table.table().name(),
                            table.hasRow(row) ? fmt::format("column {}", columnName) : fmt::format("row {}", row)),
                "correct COLUMN or KEY");
  }
  if (way == CommandKind::TabdataRead) {
    const VariableRef& target = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
    const std::string cell = table.text(row, column);
    const auto number = parseDecimal(cell);
    if (target.space == VariableSpace::QS) {
      parameters_.write(target, cell);
    } else if (number || cell.empty() || cell == "-") {
      parameters_.write(target, number ? table.numberOr(row, column, 0) : 0);
    } else {
      throw Alarm("Wrong data type", fmt::format("\"{}\" in column {} is not a number", cell, columnName),
                  "read it into a QS parameter");
    }
    return;
  }
  const Value value = evaluation.value(find(command.words, "VAL", evaluation)->value);
  if (isText(value)) {
    if (way == CommandKind::TabdataAdd) throw Alarm("Wrong data type", "TABDATA ADD adds numbers, not texts");
    control_.writeText(table, row, column, std::get<std::string>(value));
    return;
  }
  const double before = way == CommandKind::TabdataAdd ? table.numberOr(row, column, 0) : 0;
  writeNumber(kind == "TOOL", row, columnName, before + std::get<double>(value));
}

void Tables::writeNumber(bool tool, const std::string& row, const std::string& column, double value) {
  if (tool) {
    control_.writeNumber(control_.tables.tools, row, NumberColumn::named(column), value);
    if (row != control_.tool.row) return;
    tools_.refresh();
    control_.applyCoordinates();
    tools_.publishTool();
    return;
  }
  control::heidenhain::Control::PresetChange change;
  constexpr std::array<std::string_view, 3> origin = {"X", "Y", "Z"}, angles = {"SPA", "SPB", "SPC"};
  for (std::size_t i = 0; i < 3; ++i) {
    if (column == origin[i]) change.origin[i] = value;
    if (column == angles[i]) change.spaceAngles[i] = value;
  }
  const auto axis = control_.channel.description().axisIndex(column.substr(0, column.find("_OFFS")));
  if (axis && column.ends_with("_OFFS")) change.rotaryOffset[*axis] = value;
  const bool known = std::ranges::count(origin, column) + std::ranges::count(angles, column) > 0 ||
                     (axis && column.ends_with("_OFFS") &&
                      control_.channel.description().axes[*axis].kind == machine::AxisKind::Rotary);
  if (!known) {
    control_.writeNumber(control_.tables.presets, row, NumberColumn::named(column), value);
    return;
  }
  const auto number = parseInteger(row);
  if (number) control_.writePreset(static_cast<int>(*number), change);
}

void Tables::read(const Command& command, Evaluation& evaluation) {
  if (!table_) throw Alarm("Table missing", "No table is open for FN 28", "program FN 26: TABOPEN before it");
  const std::string row = std::to_string(std::lround(evaluation.number(evaluation.words(command.words)[0].value)));
  const VariableRef& first = evaluation.block().variables[static_cast<std::size_t>(command.variable)];
  const std::vector<std::string> columns = columnsOf(evaluation.at(command.text));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::optional<std::string> cell = table_->cell(row, columns[i]);
    if (!cell) {
      throw Alarm("Table entry missing",
                  fmt::format("{} has no row {} with column {}", table_->file(), row, columns[i]),
                  "correct the row or the name of the column");
    }
    if (first.space == VariableSpace::QS) {
      parameters_.write(behind(first, i), *cell);
      continue;
    }
    const std::optional<double> number = parseDecimal(*cell);
    if (!number) {
      throw Alarm("Wrong data type", fmt::format("\"{}\" in column {} is not a number", *cell, columns[i]),
                  "read it into a QS parameter");
    }
    parameters_.write(behind(first, i), *number);
  }
}

}  // namespace probewright::execution::klartext

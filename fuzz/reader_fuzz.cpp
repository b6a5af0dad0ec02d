#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "control/heidenhain/axis_shift_table.hpp"
#include "control/heidenhain/compensation_grid.hpp"
#include "control/heidenhain/datum_table.hpp"
#include "control/heidenhain/deflection_table.hpp"
#include "control/heidenhain/kinematic_tables.hpp"
#include "control/heidenhain/preset_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "control/heidenhain/turning_tool_table.hpp"
#include "machine/machine_file.hpp"
#include "session/answers.hpp"
#include "session/heidenhain/beliefs.hpp"
#include "session/sinumerik/beliefs.hpp"
#include "setup/setup.hpp"

using namespace probewright;
using namespace probewright::control::heidenhain;
using control::ControlKind;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void requireTexts(const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics)
    require(!format(diagnostic).empty());
}

/// What is read comes back to the byte; what is set is there when the table is read again.
template <class Look>
void table(std::string_view bytes, std::span<const ColumnSpec> columns, Look look) {
  Diagnostics diagnostics;
  auto table = TypedTable::parse(bytes, "TABLE", columns, diagnostics);
  requireTexts(diagnostics);
  if (!table) return;
  require(table->table().bytes() == bytes);
  look(*table);
  if (table->table().keys().size() > 20) return;
  for (const ColumnSpec& column : columns.subspan(1)) {
    const bool text = column.kind == CellKind::Text;
    const bool set = text ? table->setText("3", column.column, "A").has_value()
                          : table->setNumber("3", NumberColumn::named(column.name()), 4).has_value();
    if (!set) continue;
    Diagnostics again;
    const auto read = TypedTable::parse(table->table().bytes(), "TABLE", columns, again);
    require(read.has_value() && read->hasRow("3"));
    require(text ? read->text("3", column.column) == "A"
                 : read->number("3", NumberColumn::named(column.name())).has_value());
  }
}

void probes(const TypedTable& table) { findProbe(table, 1); }
void datums(const TypedTable& table) { findDatum(table, 1); }
void numbers(const TypedTable& table) {
  for (const std::string& key : table.table().keys()) {
    table.number(key, "X");
    table.number(key, "ZL");
    table.text(key, "TYPE");
  }
}
void tools(const TypedTable& table) {
  findToolNamed(table, "PROBE");
  numbers(table);
}
void deflections(const TypedTable& table) {
  const auto rows = deflectionsOf(table);
  require(rows.size() <= table.table().keys().size());
  if (rows.size() > 50) return;
  const auto made = deflectionTable("T1.3DTC", rows);
  if (made) require(deflectionsOf(*made).size() == rows.size());
}

void kinematics(const TypedTable& table) { require(entriesOf(table).size() <= table.table().keys().size()); }
void saved(const TypedTable& table) {
  for (const SavedKinematics& record : savedKinematicsOf(table))
    require(record.entries.size() <= table.table().keys().size());
}
/// What a grid says at its nodes is what its table says; elsewhere it is a number.
void grids(const TypedTable& table) {
  static const machine::MachineDescription machine = machine::readMachine("mill5-table-table").value();
  const auto grid = CompensationGrid::of(table, machine);
  if (!grid) {
    require(!format(grid.error()).empty());
    return;
  }
  bool finite = true;
  for (std::size_t i = 0; i < grid->size(); ++i)
    finite = finite && grid->value(i).allFinite();
  for (std::size_t i = 0; finite && i < grid->size(); ++i)
    require(grid->at(grid->node(i)) == grid->value(i));
}

void answers(std::string_view text) {
  const auto read = session::parseAnswers(text, "ANSWERS.TXT");
  if (!read) {
    require(!format(read.error()).empty());
    return;
  }
  // Written out again, they say the same.
  std::string written;
  for (const auto& [question, answer] : *read)
    written += question + " = " + answer + "\n";
  require(session::parseAnswers(written, "ANSWERS.TXT") == *read);
}

void parameters(std::string_view text) {
  Diagnostics diagnostics;
  const auto read = probewright::setup::parseSetup(text, "setup.toml", diagnostics);
  if (!read) return;
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Diagnostics mistakes;
    const MachineParameters values = session::heidenhain::machineParameters(read->beliefs, kind, mistakes);
    requireTexts(mistakes);
    require(values.mp6160 >= -1 && values.maxTouchFeed >= 0);
  }
  Diagnostics mistakes;
  session::sinumerik::sinumerikData(read->beliefs, mistakes);
  requireTexts(mistakes);
}

}  // namespace

// The first byte selects a reader, the rest is what it reads: the tables of HEIDENHAIN controls, those of
// kinematics included, the answers of an operator, the [parameters] of a setup.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 12) {
    case 0:
      table(text, toolColumns(), tools);
      break;
    case 1:
      table(text, probeColumns(), probes);
      break;
    case 2:
      table(text, presetColumns(), numbers);
      break;
    case 3:
      table(text, datumColumns(), datums);
      break;
    case 4:
      table(text, turningToolColumns(), numbers);
      break;
    case 5:
      table(text, axisShiftColumns(), numbers);
      break;
    case 6:
      table(text, deflectionColumns(), deflections);
      break;
    case 7:
      answers(text);
      break;
    case 8:
      table(text, kinematicColumns(), kinematics);
      break;
    case 9:
      table(text, savedKinematicColumns(), saved);
      break;
    case 10:
      table(text, gridColumns(), grids);
      break;
    default:
      parameters(text);
      break;
  }
  return 0;
}

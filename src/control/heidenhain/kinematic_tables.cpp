#include "control/heidenhain/kinematic_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "control/alarm.hpp"

namespace probewright::control::heidenhain {

namespace {

using enum CellKind;

constexpr std::array kinematicSpecs = {
    ColumnSpec{"NR", "", 5, Integer, 0, "number of the entry"},
    ColumnSpec{"KEY", "", 8, Text, 0,
               "TRANS: way from the axis before to this one; ROT: compensation of its direction; AXIS: its machine "
               "datum; BASE: by which the tool is further than the axes tell"},
    ColumnSpec{"AXIS", "", 8, Text, 0, "X, Y, Z, or the rotary axis"},
    ColumnSpec{"VALUE", "", 22, Number, 9, "mm, degrees"},
};

constexpr std::array savedSpecs = {
    ColumnSpec{"NR", "", 6, Integer, 0, "number of the row"},
    ColumnSpec{"RECORD", "", 20, Text, 0, "name of the record"},
    ColumnSpec{"DATE", "", 22, Text, 0, "when it was saved"},
    ColumnSpec{"KINEMATIC", "", 12, Text, 0, "the kinematics that it was saved from"},
    ColumnSpec{"CODE", "", 8, Integer, 0, "code number of an iTNC 530"},
    ColumnSpec{"KEY", "", 8, Text, 0, "as in KINEMATIC.TAB"},
    ColumnSpec{"AXIS", "", 8, Text, 0, ""},
    ColumnSpec{"VALUE", "", 22, Number, 9, ""},
};

constexpr std::array gridSpecs = {
    ColumnSpec{"NR", "", 6, Integer, 0, "number of the grid position"},
    ColumnSpec{"A", "", 14, Angle, 4, "position of the rotary axis; empty: it is not of the grid"},
    ColumnSpec{"B", "", 14, Angle, 4, ""},
    ColumnSpec{"C", "", 14, Angle, 4, ""},
    ColumnSpec{"DX", "", 16, Length, 7, "how much further the tip is than the axes tell"},
    ColumnSpec{"DY", "", 16, Length, 7, ""},
    ColumnSpec{"DZ", "", 16, Length, 7, ""},
};

void check(const Result<void>& done) {
  if (!done) throw Alarm("Table write error", done.error().message, done.error().advice);
}

void put(TypedTable& table, const std::string& row, const KinematicEntry& entry) {
  check(table.setText(row, "KEY", entry.key));
  check(table.setText(row, "AXIS", entry.axis));
  check(table.setNumber(row, "VALUE", entry.value + 0.0));
}

KinematicEntry entryIn(const TypedTable& table, const std::string& row) {
  return {table.text(row, "KEY"), table.text(row, "AXIS"), table.numberOr(row, "VALUE", 0)};
}

}  // namespace

std::span<const ColumnSpec> kinematicColumns() { return kinematicSpecs; }
std::span<const ColumnSpec> savedKinematicColumns() { return savedSpecs; }
std::span<const ColumnSpec> gridColumns() { return gridSpecs; }

TypedTable kinematicTable(const Kinematics& kinematics, ControlKind kind) {
  TypedTable table = TypedTable::create(kinematicTableName, TableUnit::Millimetre, kinematicSpecs, kind, 0);
  const std::vector<KinematicEntry> entries = kinematics.entries(kinematics.data());
  for (std::size_t i = 0; i < entries.size(); ++i)
    put(table, std::to_string(i), entries[i]);
  return table;
}

std::vector<KinematicEntry> entriesOf(const TypedTable& table) {
  std::vector<KinematicEntry> entries;
  for (const std::string& row : table.table().keys())
    entries.push_back(entryIn(table, row));
  return entries;
}

TypedTable emptySavedKinematics(ControlKind kind) {
  return TypedTable::create(savedKinematicsName, TableUnit::Millimetre, savedSpecs, kind, 0);
}

std::vector<SavedKinematics> savedKinematicsOf(const TypedTable& table) {
  std::vector<SavedKinematics> records;
  for (const std::string& row : table.table().keys()) {
    const std::string name = table.text(row, "RECORD");
    auto record = std::ranges::find(records, name, &SavedKinematics::name);
    if (record == records.end()) {
      records.push_back({name,
                         table.text(row, "DATE"),
                         table.text(row, "KINEMATIC"),
                         static_cast<int>(std::lround(table.numberOr(row, "CODE", 0))),
                         {}});
      record = records.end() - 1;
    }
    record->entries.push_back(entryIn(table, row));
  }
  return records;
}

TypedTable savedKinematicsTable(const std::vector<SavedKinematics>& records, ControlKind kind) {
  TypedTable table = emptySavedKinematics(kind);
  std::size_t number = 0;
  for (const SavedKinematics& record : records) {
    for (const KinematicEntry& entry : record.entries) {
      const std::string row = std::to_string(number++);
      check(table.setText(row, "RECORD", record.name));
      check(table.setText(row, "DATE", record.date));
      check(table.setText(row, "KINEMATIC", record.identifier));
      if (record.code != 0) check(table.setNumber(row, "CODE", record.code));
      put(table, row, entry);
    }
  }
  return table;
}

}  // namespace probewright::control::heidenhain

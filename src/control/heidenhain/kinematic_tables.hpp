#pragma once

#include <string>
#include <vector>

#include "control/heidenhain/kinematics.hpp"
#include "control/heidenhain/typed_table.hpp"

/// The files in which a control keeps its kinematics. The manuals name DATA450.KD and *.kco and leave their layout
/// open, and name no file of the active kinematics: columns, and the name KINEMATIC.TAB, are Probewright's.
namespace probewright::control::heidenhain {

inline constexpr const char* kinematicTableName = "KINEMATIC.TAB";
inline constexpr const char* savedKinematicsName = "DATA450.KD";

std::span<const ColumnSpec> kinematicColumns();
std::span<const ColumnSpec> savedKinematicColumns();
std::span<const ColumnSpec> gridColumns();

/// KINEMATIC.TAB: an entry of the active kinematics a row.
TypedTable kinematicTable(const Kinematics& kinematics, ControlKind kind);
/// The entries that the table holds, in the order of its rows.
std::vector<KinematicEntry> entriesOf(const TypedTable& table);

/// One record of DATA450.KD.
struct SavedKinematics {
  std::string name;  ///< a number or, on the TNC 640, up to 16 characters
  std::string date;
  std::string identifier;  ///< of the kinematics that it was saved from
  int code = 0;            ///< iTNC 530: code number that was entered under MOD; 0: none
  std::vector<KinematicEntry> entries;
};

TypedTable emptySavedKinematics(ControlKind kind);
std::vector<SavedKinematics> savedKinematicsOf(const TypedTable& table);
/// A table that holds these records and nothing else.
TypedTable savedKinematicsTable(const std::vector<SavedKinematics>& records, ControlKind kind);

}  // namespace probewright::control::heidenhain

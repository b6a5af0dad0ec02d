#pragma once

#include "control/heidenhain/typed_table.hpp"

/// The tool table TOOL.T: one row per tool, or per step of a tool (5, 5.1, 5.2).
namespace probewright::control::heidenhain {

/// The columns of TOOL.T that have a meaning here. Source: spec pages on tool measurement and calibration; widths and
/// decimals as the controls write them.
std::span<const ColumnSpec> toolColumns();

/// A row of TOOL.T; mm and degrees. Entries that the table doesn't have are 0, empty or nothing.
struct Tool {
  std::string number;  ///< "5", "5.1"
  std::string name;
  double length = 0, radius = 0, radius2 = 0;
  double deltaLength = 0, deltaRadius = 0, deltaRadius2 = 0;
  bool locked = false;                          ///< TL = L
  std::string replacement;                      ///< RT
  std::string type;                             ///< TYP: "MILL", "DRILL", "TCHP"
  int teeth = 0;                                ///< CUT
  double wearLength = 0, wearRadius = 0;        ///< LTOL, RTOL; 0: not monitored
  double breakLength = 0, breakRadius = 0;      ///< LBREAK, RBREAK; 0: not monitored
  std::optional<double> radialOffset;           ///< R-OFFS of tool measurement; nothing: the tool radius
  double axialOffset = 0;                       ///< L-OFFS of tool measurement
  std::optional<int> probe;                     ///< TP_NO: row of the touch probe table
  double centreOffset1 = 0, centreOffset2 = 0;  ///< CAL-OF1, CAL-OF2 (iTNC 530 with several calibration sets)
  double calibrationAngle = 0;                  ///< CAL-ANG (iTNC 530)

  double totalLength() const { return length + deltaLength; }
  double totalRadius() const { return radius + deltaRadius; }
};

/// An empty tool table as a new control has it: row 0 with length and radius 0.
TypedTable defaultToolTable(ControlKind kind, TableUnit unit = TableUnit::Millimetre);

/// The tool in row `number` ("5", "5.1"), or nothing.
std::optional<Tool> findTool(const TypedTable& table, std::string_view number);

/// The key of the first row with this name, or nothing. Names compare exactly.
std::optional<std::string> findToolNamed(const TypedTable& table, std::string_view name);

/// "5", "5.1" from the number of a TOOL CALL with its step.
std::string toolKey(int number, int step = 0);

}  // namespace probewright::control::heidenhain

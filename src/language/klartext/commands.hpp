#pragma once

#include <cstdint>
#include <string_view>

#include "language/block.hpp"

/// Which commands and transformations the HEIDENHAIN languages have. A Command or Transform of a block carries the name
/// of its kind, and only names of this list: whoever carries out, writes or checks blocks asks for the kind and
/// visits all of them.
namespace probewright::language::klartext {

enum class CommandKind : std::uint8_t {
  BeginProgram,
  BlankForm,
  Section,
  Error,    ///< ERROR =: marked by the control
  Declare,  ///< DECLARE, but for strings
  OpenFile,
  Monitoring,
  SetUndefined,  ///< FN 0: Q5 SET UNDEFINED
  Fn14,
  Fn15,
  Fn16,
  Fn17,
  Fn18,
  Fn19,
  Fn20,
  Fn21,
  Fn22,
  Fn23,
  Fn24,
  Fn25,
  Fn26,
  Fn27,
  Fn28,
  Fn29,
  Fn37,
  Fn38,
  TabdataRead,
  TabdataWrite,
  TabdataAdd,
  Sql,
  DwellTime,           ///< cycle 9
  ProgramCall,         ///< cycle 12
  SpindleOrientation,  ///< cycle 13
  Tolerance,           ///< cycle 32
  CycleCall,
  GlobalDefinition,
  PatternDefinition,
  ToolDefinition,
  SelectProgram,
  SelectTable,
  SelectPattern,
  SelectContour,
  SelectCycle,
  SelectCorrectionTable,
  SelectToolCorrectionTable,       ///< SEL CORR-TABLE TCS
  SelectWorkpieceCorrectionTable,  ///< SEL CORR-TABLE WPL
  PresetSelect,
  PresetCopy,
  PresetCorrection,
  Function,       ///< FUNCTION but for TCPM, with its text
  FunctionReset,  ///< FUNCTION RESET but for TCPM
  Contour,
  FreeLine,  ///< free contour programming: FL, FLT, FC, FCT, FPOL, FSELECT
  FreeLineTangential,
  FreeArc,
  FreeArcTangential,
  FreePole,
  FreeSelection,
};

enum class TransformKind : std::uint8_t {
  DatumShift,     ///< cycle 7
  Mirror,         ///< cycle 8
  Rotation,       ///< cycle 10
  Scaling,        ///< cycle 11
  Tilting,        ///< cycle 19
  AxisScaling,    ///< cycle 26
  PresetByCycle,  ///< cycle 247
  TransDatumAxis,
  TransDatumTable,
  TransDatumReset,
  TransMirror,
  TransMirrorReset,
  TransRotation,
  TransRotationReset,
  TransScale,
  TransScaleReset,
  PlaneSpatial,
  PlaneProjected,
  PlaneEuler,
  PlaneVector,
  PlanePoints,
  PlaneRelative,
  PlaneAxial,
  PlaneReset,
};

/// "FN18", "CYCL DEF 13", "PLANE SPATIAL": the name that a block carries.
std::string_view nameOf(CommandKind kind);
std::string_view nameOf(TransformKind kind);

/// FN 14 to 29, 37 and 38.
CommandKind functionCommand(int number);

/// Throws std::logic_error for a name that is not in the list: a parser made it up.
CommandKind kindOf(const Block& block, const Command& command);
TransformKind kindOf(const Block& block, const Transform& transform);

/// How many values FN 19 and FN 29 hand over to the PLC at most.
constexpr unsigned mostPlcValues(int number) { return number == 19 ? 2 : 8; }

/// True for FN 14 to FN 38.
bool isFunction(CommandKind kind);
/// True for PLANE and TRANS.
bool isPlane(TransformKind kind);
bool isTrans(TransformKind kind);

}  // namespace probewright::language::klartext

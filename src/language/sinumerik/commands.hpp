#pragma once

#include <cstdint>
#include <string_view>

#include "language/block.hpp"

namespace probewright::language::sinumerik {

/// Which commands the control carries out. A Command of a block carries the word of the program; several words can be
/// one kind. The host visits all kinds.
enum class CommandKind : std::uint8_t {
  Declare,              ///< DEF
  Define,               ///< DEFINE: a macro, which the parser has put in
  Fill,                 ///< SET(..), REP(..)
  Message,              ///< MSG
  StopPreprocessing,    ///< STOPRE
  GroupFunction,        ///< G[group]=number
  RaiseAlarm,           ///< SETAL
  Dwell,                ///< G4
  FixedPoint,           ///< G75
  ReferencePoint,       ///< G74
  Measure,              ///< MEAS, MEAW, MEASA, MEAWA
  OrientSpindle,        ///< SPOS, SPOSA
  PositionAxis,         ///< POS, POSA, POSP
  SpeedLimit,           ///< LIMS
  AxisFeed,             ///< FA
  WriteFile,            ///< WRITE
  ReadFile,             ///< READ
  DeleteFile,           ///< DELETE
  ExecuteText,          ///< EXECSTRING
  FindTool,             ///< GETSELT, GETEXET
  CircleThroughPoints,  ///< CALCDAT
  CallIsoProgram,       ///< ISOCALL
  ToolLengthOffset,     ///< TOFFL
  ToolRadiusOffset,     ///< TOFFR
  OffsetNumber,         ///< DL
  BeginRecording,       ///< CONTPRON, CONTDCON, CTABDEF: what follows makes a table of a contour or a curve
  EndRecording,         ///< EXECUTE, CTABEND
  SynchronizedAction,   ///< WHEN, ID, SETINT...
  Other,  ///< words that say nothing about where the tool goes, or are named because they do (keywords.hpp: Effect)
};

/// The kind of the command called `name` (upper case).
CommandKind commandKind(std::string_view name);
inline CommandKind kindOf(const Block& block, const Command& command) { return commandKind(block.at(command.name)); }

}  // namespace probewright::language::sinumerik

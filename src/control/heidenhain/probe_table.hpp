#pragma once

#include "control/heidenhain/typed_table.hpp"

/// The touch probe table TCHPROBE.TP: one row per touch probe. Source: general page, section 14.
namespace probewright::control::heidenhain {

std::span<const ColumnSpec> probeColumns();

/// A row of TCHPROBE.TP; mm, mm/min, degrees. What is missing or empty has the value given here.
struct TouchProbe {
  std::string type;                             ///< TYPE, "TS460"
  double centreOffset1 = 0, centreOffset2 = 0;  ///< CAL_OF1, CAL_OF2: ball centre from the spindle axis
  double calibrationAngle = 0;                  ///< CAL_ANG: spindle angle when probing
  double feed = 300;                            ///< F
  double rapid = 2000;                          ///< FMAX
  double maximumTravel = 10;                    ///< DIST: no contact within it is an error
  double setUpClearance = 2;                    ///< SET_UP
  bool prepositionAtMachineRapid = false;       ///< F_PREPOS = FMAX_MACHINE
  bool track = false;                           ///< TRACK = ON: the spindle is oriented to the probing direction
  std::string serial;
  std::string stylus;  ///< STYLUS: "SIMPLE", "L-TYPE"
};

/// A touch probe table with probes 0 and 1 as the values of TouchProbe say. Both controls: what the iTNC 530 keeps in
/// machine parameters stands here.
TypedTable defaultProbeTable(ControlKind kind, TableUnit unit = TableUnit::Millimetre);

std::optional<TouchProbe> findProbe(const TypedTable& table, int number);

}  // namespace probewright::control::heidenhain

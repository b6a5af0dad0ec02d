#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "control/channel.hpp"
#include "control/control_kind.hpp"
#include "control/heidenhain/coordinates.hpp"
#include "control/heidenhain/machine_parameters.hpp"
#include "control/heidenhain/q_parameters.hpp"
#include "control/heidenhain/typed_table.hpp"
#include "control/journal.hpp"
#include "control/operator_panel.hpp"

/// Everything a HEIDENHAIN control knows while a program runs.
namespace probewright::control::heidenhain {

struct CameraMonitoring;

/// The tables of the control, as their files stand.
struct Tables {
  TypedTable tools;                          ///< TOOL.T
  TypedTable probes;                         ///< TCHPROBE.TP; the iTNC 530 uses machine parameters instead
  TypedTable presets;                        ///< PRESET.PR
  std::map<std::string, TypedTable> datums;  ///< datum tables by the name a program uses
  std::optional<TypedTable> turningTools;    ///< TOOLTURN.TRN of a TNC 640 that turns
  /// Results of 3-D calibrations, *.3DTC, by file name; column DR2TABLE of the tool table refers to them.
  std::map<std::string, TypedTable> deflections;
  std::optional<TypedTable> axisShifts;  ///< AXSHIFT.TAB of an iTNC 530: what cycle 440 has calibrated
};

/// The tool in the spindle.
struct ActiveTool {
  int number = 0;
  int index = 0;    ///< of a stepped tool: T 5.1
  std::string row;  ///< key of its row in TOOL.T: "5" or "5.1"
  std::string name;
  char axis = 'Z';
  double length = 0;  ///< L + DL of the table
  double radius = 0;  ///< R + DR of the table
  double radius2 = 0;
  double deltaLength = 0, deltaRadius = 0, deltaRadius2 = 0;  ///< of the TOOL CALL block
  double spindleSpeed = 0;
  double feed = 0;       ///< mm/min, for FAUTO
  std::string probeRow;  ///< row of the touch probe table (TP_NO); empty if the tool is not a touch probe
  bool called = false;   ///< a TOOL CALL has been carried out
};

/// What cycle 441 sets for all cycles that follow; absent values leave the tables in force.
struct ProbingOverrides {
  std::optional<double> positioningFeed;  ///< Q396, mm/min
  std::optional<bool> machineRapid;       ///< Q397
  std::optional<bool> track;              ///< Q399
  std::optional<bool> interrupt;          ///< Q400
};

class Kinematics;

/// mm/min in one unit of feed of a program whose lengths count in units of `unit` mm: in an INCH program F100 is 10
/// inches a minute.
constexpr double feedUnit(double unit) { return unit == 1 ? 1 : unit / 10; }

class Control {
public:
  Control(ControlKind kind, machine::Machine& machine, Tables tables, MachineParameters parameters = {});
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  ControlKind kind() const { return kind_; }
  bool isTNC640() const { return kind_ == ControlKind::TNC640; }
  /// mm/min in one unit of feed of the program under way.
  double feedUnit() const { return heidenhain::feedUnit(unit); }

  Journal journal;
  OperatorPanel panel;
  Channel channel;
  Tables tables;
  MachineParameters parameters;
  QParameters q;
  Coordinates coordinates;
  std::shared_ptr<Kinematics> kinematics;  ///< the active one; never null
  ActiveTool tool;
  /// Preset origins carry more digits here than their table can show.
  std::string activeDatumTable;     ///< key of Tables::datums; empty: none selected
  double unit = 1;                  ///< mm in one program unit: 25.4 in a program that ends in INCH
  double mainUnit = 1;              ///< the same of the main program: results and logs count in it (Q113)
  std::string programPath;          ///< of the main program, for logs
  double startSeconds = 0;          ///< machine clock when the program began
  std::int64_t wallClockStart = 0;  ///< seconds since 1970 (UTC) that logs show for startSeconds
  /// Values of GLOBAL DEF by Q number, each with the unit of the program that it is in.
  struct GlobalDefinition {
    double value = 0;
    double unit = 1;
    std::string text = {};  ///< FMAX or FAUTO, which stands for the value
  };
  std::map<int, GlobalDefinition> globalDefinitions;
  ProbingOverrides overrides;  ///< reset at the end of the main program
  bool turningMode = false;    ///< FUNCTION MODE TURN
  bool grindingMode = false;   ///< FUNCTION MODE GRIND, or FUNCTION DRESS
  /// Radius of the ring or pin with which cycle 2 has last calibrated; 0 before.
  double calibrationRingRadius = 0;

  /// Calls a tool by the key of its row, or its replacement if it is locked; throws Alarm if TOOL.T has no such row.
  void callTool(const std::string& row, std::optional<char> axis, double deltaLength, double deltaRadius,
                double deltaRadius2);
  /// The key of the row whose NAME is `name`; throws Alarm if there is none.
  std::string toolRowNamed(const std::string& name) const;
  /// Puts length and radius of the active tool's row into effect again; while a touch probe cycle measures, those of
  /// the calibration data if MP7411 says so.
  void refreshTool();
  /// Takes over what the touch probe in the spindle tells: its serial number into the touch probe table, and what the
  /// table says of collisions.
  void meetProbe();
  /// A touch probe cycle begins or ends to measure. With the calibration data of MP7411 = 0, length and radius of tool
  /// table and TOOL CALL are overwritten by them until it ends.
  void setProbing(bool probing);
  /// Measured lengths and radii of probes are in the tool table, not in the calibration data of MP7411 = 0.
  bool keepsCalibrationInTable() const { return isTNC640() || (parameters.mp7411 && !probeByHand()); }
  /// iTNC 530: TOOL CALL 0 names no tool but the axis of the touch probe, which the operator has put into the spindle.
  bool probeByHand() const { return !isTNC640() && tool.called && tool.number == 0; }
  /// Which tool of the machine that probe is.
  machine::ToolOrder handProbe;

  /// Activates a row of the preset table; resets nothing else. Throws Alarm if there is no such row.
  void activatePreset(int row);
  /// Writes values into a row of the preset table (created if absent) and, if it is the active one, into effect.
  /// `origin` by X, Y, Z; absent values stay. Throws Alarm, with nothing written, if the table refuses it.
  struct PresetChange {
    std::array<std::optional<double>, 3> origin;       ///< machine coordinates, mm
    std::array<std::optional<double>, 3> spaceAngles;  ///< SPA, SPB, SPC
    std::array<std::optional<double>, machine::maximumAxes> rotaryOffset;
  };
  void writePreset(int row, const PresetChange& change);
  /// Throws Alarm if the row is locked.
  void requireWritablePreset(int row) const;
  /// Reads a row; nothing if there is none.
  std::optional<ActivePreset> presetRow(int row) const;

  /// Hands the coordinate chain to the channel. To be called after any change of `coordinates` or the tool.
  void applyCoordinates();

  /// Hands the active kinematics to the channel. To be called after any change of it.
  void applyKinematics();

  /// A number to be written into a table: mm, degrees, mm/min.
  struct NumberCell {
    TypedTable& table;
    std::string row;  ///< is added where the table does not have it
    NumberColumn column;
    double value;
  };
  /// Writes cells that belong together and records what changed. Throws Alarm, with nothing written, if a table refuses
  /// one of them.
  void writeNumbers(const std::vector<NumberCell>& cells);
  /// Throws the same, and writes nothing.
  void requireRoomFor(const std::vector<NumberCell>& cells) const;
  /// Write a cell (numbers in mm, degrees, mm/min) and record what changed. Throw Alarm if the table refuses it.
  void writeNumber(TypedTable& table, const std::string& row, NumberColumn column, double value);
  void writeText(TypedTable& table, const std::string& row, Column column, const std::string& value);
  /// Changes one of the calibration data of MP7411 = 0 and records it as the entry `name`.
  void writeCalibration(double MachineParameters::*member, const std::string& name, double value);

private:
  /// The row called, or, where it is locked, the first of its replacement tools (RT) that is not. Throws Alarm.
  std::string usableTool(const std::string& called);
  /// The tables of cells as they are once the cells are written.
  static std::map<TypedTable*, TypedTable> tablesWith(const std::vector<NumberCell>& cells);
  void note(const TypedTable& table, const std::string& row, Column column, const std::string& before);

  ControlKind kind_;
  bool probing_ = false;
  std::map<int, ActivePreset> exactPresets_;  ///< rows written in this run, unrounded

public:
  std::shared_ptr<CameraMonitoring> cameraMonitoring;  ///< null: Visual Setup Control (option 136) is not enabled
};

}  // namespace probewright::control::heidenhain

#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/channel.hpp"
#include "control/journal.hpp"
#include "control/operator_panel.hpp"
#include "control/sinumerik/data_store.hpp"
#include "control/sinumerik/frame.hpp"
#include "control/sinumerik/result_output.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "control/working_plane.hpp"

/// Everything a SINUMERIK control knows while a program runs.
namespace probewright::control::sinumerik {

/// The tool in the spindle or turret.
struct ActiveTool {
  int number = 0;  ///< T number
  int edge = 0;    ///< D number; 0: no offset active
  std::string name;
  int type = 0;                                       ///< $TC_DP1
  int position = 0;                                   ///< $TC_DP2, cutting edge position
  int dl = 0;                                         ///< active DL number: additive and setup offset; 0: none
  double radius = 0;                                  ///< with wear and offsets
  double correctionAngle = 0;                         ///< $TC_DP10
  double programmedLength = 0, programmedRadius = 0;  ///< TOFFL and TOFFR: added to L1 and to the radius
  bool isProbe() const { return type == 580 || (type >= 710 && type <= 714); }
  bool isTurning() const { return type >= 500 && type < 600; }
};

/// What CYCLE996 keeps of a rotary axis between its calls, beside _OVR[40] to _OVR[71].
struct MeasuredRotaryAxis {
  std::optional<Vector3> tool;  ///< from the ball of the probe to the tool adapter, mm
  double otherAngle = 0;        ///< degrees from the basic setting: where the other rotary axis stood
};

/// The frames in effect, from the outside in. Machine from workpiece = base : settable : swivel : programmed.
struct ActiveFrames {
  int settable = 0;  ///< n of $P_UIFR[n]: 1 = G54; 0 = G500
  /// The basic frames that act, from the outside in: system, global, channel frames by the names of their data.
  std::vector<std::pair<DataKey, Frame>> basic;
  Frame base;               ///< their chain
  Frame settableFrame;      ///< $P_IFRAME
  Frame toolOriented;       ///< $P_WPFRAME, $P_TOOLFRAME: swivelled planes of CYCLE800
  Frame programmed;         ///< $P_PFRAME
  bool suppressed = false;  ///< G53, SUPA for one block
};

class Control {
public:
  /// `told`: the machine as it was commissioned on the control; nothing: as it says of itself. Swivel data set 1
  /// describes it, where `data` have no other.
  Control(machine::Machine& machine, DataStore data, std::optional<machine::MachineDescription> told = std::nullopt);
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  Journal journal;
  OperatorPanel panel;
  Channel channel;
  DataStore data;
  ResultOutput output;

  int plane = 17;  ///< 17, 18, 19
  ActiveTool tool;
  ActiveFrames frames;
  bool swivelled = false;           ///< a CYCLE800 swivel is active: coordinates follow the rotary axes
  bool transformation = false;      ///< TRAORI: the tip holds its place
  bool diameter = false;            ///< DIAMON: the X axis counts diameters
  double unit = 1;                  ///< mm in one program unit: 25.4 with G70/G700 on a metric control
  int level = 1;                    ///< program level
  bool modalCall = false;           ///< MCALL is in effect
  bool radiusCompensation = false;  ///< G41 or G42 is active
  bool dryRun = false, programTest = false, blockSearch = false;
  std::string programPath;
  std::int64_t wallClockStart = 0;
  std::array<double, 500> ovr{};  ///< _OVR; the cycles clear all but those that CYCLE996 keeps
  static constexpr std::size_t firstKept = 32, afterKept = 72;
  std::array<int, 20> ovi{};  ///< _OVI
  std::array<MeasuredRotaryAxis, 2> measuredAxes;
  int carrier = 0;  ///< the swivel data set that CYCLE800 works with; 0: none so far

  control::WorkingPlane workingPlane() const { return control::WorkingPlane::ofG(plane); }

  /// Loads tool `number`; 0 empties the spindle. Throws Alarm 17190 if it has no data. D1 becomes active.
  void loadTool(int number);
  /// The number of the tool called `name`; throws Alarm 17190 if there is none.
  int toolNumbered(const std::string& name) const;
  /// Activates an offset (0: none). Throws Alarm 17180 if the tool has no such edge.
  void selectEdge(int edge);
  /// DL=: the additive offset of the active edge (0: none), in effect at once. Throws Alarm 17182 unless it is a whole
  /// number from 0 to 6.
  void selectAdditiveOffset(double number);
  /// Reads the data of the active tool and edge and puts them into effect, as D does. What a program writes into them
  /// has no effect before that.
  void refreshTool();

  /// Activates settable frame n (0: G500). Throws Alarm 18310 if there is none.
  void activateSettable(int number);
  /// Activates what data management holds: reads base and settable frames from the store again, as G54 to G599 and
  /// corrections by measuring cycles do, then handOverFrames().
  void applyFrames();
  /// Hands the active frames to the channel. To be called after any change of frames, plane or tool.
  void handOverFrames();
  /// Sets the active basic frame whose data are `key` ($P_CHBFR[0]) without touching these data: $P_CHBFRAME[0]=...
  void setActiveBasicFrame(const DataKey& key, const Frame& frame);
  /// The active basic frame of these data; neutral if there is none.
  Frame activeBasicFrame(const DataKey& key) const;
  /// MD 20150 $MC_GCODE_RESET_VALUES: the number of the G function that a channel begins with in G group `group`; 0 if
  /// the datum has no value.
  int initialFunction(int group) const;
  /// The base frames that have values: all global ones by number ($P_NCBFR), then the channel's ($P_CHBFR), as they are
  /// chained from the outside in.
  std::vector<DataKey> baseFrameKeys() const;
  /// Machine coordinates from workpiece coordinates.
  Eigen::Affine3d machineFromWorkpiece() const;
  /// Machine coordinates from the coordinates inside which settable frame is entered.
  Eigen::Affine3d machineFromBase() const;

  /// The machine as the control was told when it was set up, whatever its data say since.
  const machine::MachineDescription& told() const { return told_; }
  /// Lets coordinates follow the kinematics that counts: TRAORI that of its machine data, CYCLE800 that of its data
  /// set. To be called when one of them begins or ends. Throws Alarm 4342 or 62181 if the machine is not as they say.
  void useKinematics();

  /// Sets a datum of the store and records the change.
  void write(const DataKey& key, double value);

  double machineData(std::string_view name, double otherwise = 0) const { return data.number(name, {}, otherwise); }

private:
  /// The edge in effect, in the active plane, with what TOFFL and TOFFR add.
  void applyTool();

  ToolEdge edge_;                     ///< as it was read
  machine::MachineDescription told_;  ///< the machine as the control was told, without what its data say since
};

}  // namespace probewright::control::sinumerik

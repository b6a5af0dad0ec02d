#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/believed_kinematics.hpp"
#include "control/control_kind.hpp"
#include "geometry/primitives.hpp"

/// What a control is told of its machine before a program starts, in the words of no vendor. Nothing here is true of
/// itself: a length was measured on a presetter or calibrated, a zero offset was set by somebody. The control's family
/// makes its tables of it.
namespace probewright::control {

/// What the control believes of a tool.
struct BelievedTool {
  int number = 0;
  std::string name;
  std::string kind;     ///< "probe", "mill", "drill", "turn", "calibration"
  double length = 0;    ///< mm; of a probe its effective length: to the ball's lowest point, less the axial pretravel
  double radius = 0;    ///< mm; of a probe its effective ball radius: less the pretravel and the signal delay at `feed`
  int teeth = 0;        ///< cutting edges; 0: nobody knows
  int cuttingEdge = 0;  ///< 1 to 9, where the tip of a turning tool points, as SINUMERIK counts; 0: nobody knows
  bool inSpindle = false;
  Vector3 mount = Vector3::Zero();            ///< mm, from the spindle nose to where `length` begins, spindle frame
  Vector3 shankDirection = Vector3::UnitZ();  ///< unit, from the tip to the holder, spindle frame

  // Of a probe, as its control keeps them.
  double axialRadius = 0;      ///< mm; effective ball radius along the stylus
  Vector2 tipOffset = {0, 0};  ///< mm, of the ball from the spindle axis, with the spindle at `tipOffsetAngle`
  std::optional<double> tipOffsetAngle;  ///< degrees; nothing: `calibrationAngle`
  double starArm = 0;         ///< mm; above 0 a star with balls this far from its middle: `radius` is that of the star
  bool lShaped = false;       ///< the ball is at the end of an arm across the spindle axis
  int probeNumber = 1;        ///< row of the touch probe table, number of the calibration data set
  double feed = 300;          ///< mm/min, of measuring moves
  double rapid = 2000;        ///< mm/min, of moves between touches
  double maximumTravel = 10;  ///< mm
  double setUpClearance = 2;  ///< mm
  double calibrationAngle = 0;  ///< degrees, of the spindle when probing
  bool orient = false;          ///< the spindle turns the probe to the probing direction
};

/// A row of the preset table or a settable zero offset.
struct BelievedFrame {
  int index = 1;     ///< row of the preset table; of zero offsets 1 for G54 to 4 for G57, 5 for G505 to 99 for G599
  std::string name;  ///< "G54"; empty for presets
  Vector3 origin = Vector3::Zero();
  Vector3 rotation = Vector3::Zero();    ///< degrees about X, Y, Z, in this order about fixed axes
  std::map<std::string, double> rotary;  ///< degrees, by the name of the rotary axis
  bool active = false;
};

/// A tool touch probe as it was fitted.
struct BelievedToolProbe {
  Vector3 centre = Vector3::Zero();  ///< mm, machine coordinates, of the upper face of its contact
  double width = 0;                  ///< mm, of the contact in X: its diameter or edge; 0: nobody knows
  double widthY = 0;                 ///< mm, in Y
  double pretravel = 0;              ///< mm, by which calibrating has found it lower and narrower
  bool cuboid = false;
  Vector3 least = Vector3::Zero(), most = Vector3::Zero();  ///< mm, machine coordinates, where its contact ends
  /// Whether it signals when a tool pushes it towards +X, -X, +Y, -Y, +Z, -Z of the machine.
  std::array<bool, 6> gives = {true, true, true, true, false, true};
};

/// A machine parameter or setting datum, passed on to the control as it is written.
struct BelievedParameter {
  std::variant<double, std::string> value;  ///< true and false become 1 and 0
  SourcePlace place;
};

/// What the machine is for, as whoever commissioned the control has set it.
enum class Technology { Milling, Turning };

struct Beliefs {
  std::string file;                    ///< that says so, for messages
  std::optional<ControlKind> control;  ///< nothing: what the program is for
  std::filesystem::path tables;        ///< folder with the control's own table files, which go first; empty if none
  Technology technology = Technology::Milling;
  BelievedKinematics kinematics;
  std::vector<BelievedTool> tools;
  std::vector<BelievedFrame> presets;
  std::vector<BelievedFrame> zeroOffsets;
  std::vector<BelievedToolProbe> toolProbes;  ///< controls that know one only know the first
  std::map<std::string, BelievedParameter> parameters;
  std::map<std::string, std::string> answers;  ///< of the operator, by the name of the question
};

}  // namespace probewright::control

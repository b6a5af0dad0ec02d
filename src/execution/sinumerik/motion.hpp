#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/sinumerik/control.hpp"
#include "execution/evaluation.hpp"
#include "execution/names.hpp"
#include "execution/sinumerik/corner.hpp"
#include "execution/sinumerik/radius_compensation.hpp"
#include "language/block.hpp"

namespace probewright::execution::sinumerik {

using control::AxisPositions;
using control::sinumerik::Control;

/// The modal state of a channel as far as motions need it.
struct MotionState {
  language::MoveKind group1 = language::MoveKind::Linear;
  bool incremental = false;  ///< G91
  double feed = 0;           ///< F as programmed
  int feedType = 94;         ///< 93, 94, 95, 96, 97
  bool feedInInch = false;   ///< G700
  /// Millimetres in one unit of system variables and frames: `unit`, that of positions, with G700 only.
  double variableUnit(double unit) const { return feedInInch ? unit : 1; }
  double spindleSpeed = 0;            ///< S: rev/min; m/min with constant cutting speed
  bool constantCuttingSpeed = false;  ///< G96, G961, G962
  double speedLimit = 0;              ///< LIMS, rev/min; 0: none
  double speedBefore = 0;             ///< S before G96, rev/min
  int spindleDirection = 5;           ///< 3, 4, 5
  int thread = 0;                     ///< 33, 34, 35, 331, 332: lines whose feed is pitch times speed; 0: none
  bool otherPath = false;             ///< a spline, a polynomial, an involute: its lines go straight
  double pitch = 0;                   ///< of the last thread, mm along its axis
  bool rpyAngles = false;             ///< ORIRPY, ORIRPY2: A2, B2, C2 are RPY angles, not Euler angles
  bool rpyAboutX = false;             ///< ORIRPY2: they turn about X first
  Vector3 pole = Vector3::Zero();     ///< of polar coordinates, program coordinates
  language::RadiusCompensation compensation = language::RadiusCompensation::Off;
  bool cornerArc = true;                   ///< G450; false: G451
  double modalRounding = 0;                ///< RNDM, mm; 0: corners stay as they are
  double modalCornerFeed = 0;              ///< FRCM; 0: corners have the feed of their block
  std::map<std::string, double> axisFeed;  ///< FA[axis]
  std::array<int, 70> gGroup{};            ///< $P_GG: active function of each G group; 0: as after reset
  std::uint64_t pieces = 0;                ///< of arcs, beyond one a block, since Host::takeWork was asked
};

/// What the last MEAS or MEAW found.
struct Measurement {
  bool triggered = false;
  AxisPositions latched;
  ProgramPlace tip;
};

/// Carries out the motions of a channel: straight lines, arcs, polar coordinates, roundings and chamfers, tool radius
/// compensation, measuring blocks. Throws Alarm.
class PathMotion {
public:
  PathMotion(Control& control, MotionState& state);

  void carryOut(const language::Move& move, Evaluation& evaluation);
  /// G110, G111, G112: the pole lies at `words` from there.
  void setPole(const Vector3& from, language::WordRange words, Evaluation& evaluation);
  /// Where the last motion ended, program coordinates.
  Vector3 lastPosition() const { return start(); }
  /// MEAS=, MEAW=.
  void measure(const language::Command& command, Evaluation& evaluation);
  /// POS[axis]=.
  void position(const std::string& axis, language::WordMode mode, double value);
  /// G75: the named axes to the tool change position.
  void approachFixedPoint(const language::Command& command, Evaluation& evaluation);
  /// Carries out what tool radius compensation still holds back.
  void flush();
  void setCompensation(language::RadiusCompensation compensation);

  /// Told of every word of a motion that is not carried out.
  std::function<void(std::string_view word)> onIgnoredWord;

  const Measurement& measurement() const { return measurement_; }

  /// 0, 1, 2 for X, Y, Z, nothing for other names.
  static std::optional<std::size_t> linearAxis(std::uint32_t address);
  /// The index of the machine's axis of that name in capitals, or nothing.
  std::optional<std::size_t> machineAxis(std::uint32_t address) const;
  /// The program angle of a rotary axis.
  double programAngle(std::size_t axis) const;

private:
  /// What the words of one block ask for, in program coordinates, mm and degrees.
  struct Words {
    control::Target target;
    bool anyLinear = false, anyRotary = false;
    std::array<std::optional<std::pair<language::WordMode, double>>, 3> centre;  ///< I, J, K
    std::array<std::optional<double>, 3> middle;                                 ///< I1, J1, K1
    std::optional<double> radius, opening, polarAngle, polarRadius;
    bool polarAngleIncremental = false, polarRadiusIncremental = false;
    std::array<std::optional<double>, 3> direction;  ///< A3, B3, C3
    std::array<std::optional<double>, 3> angles;     ///< A2, B2, C2
    int turns = 0;
    std::optional<double> angle;  ///< ANG, towards the 1st axis of the plane
    std::optional<Corner> corner;
    double cornerFeed = 0;  ///< FRC

    bool anyMotion() const {
      return anyLinear || anyRotary || centre[0] || centre[1] || centre[2] || opening || turns > 0;
    }
  };
  Words read(language::WordRange range, Evaluation& evaluation);
  std::uint32_t axisOf(const language::Word& word, std::uint32_t& computed, Evaluation& evaluation) const;
  void readAxis(std::uint32_t address, language::WordMode mode, double value, Words& words);
  bool readArcWord(std::uint32_t address, language::WordMode mode, double value, Words& words);
  double rotaryTarget(std::size_t axis, language::WordMode mode, double value) const;
  void resolvePolar(Words& words) const;
  bool readOrientationWord(std::uint32_t address, double value, Words& words);
  void resolveOrientation(Words& words) const;
  double threadFeed(const Words& words, const Vector3& way);

  Vector3 start() const;
  Vector3 endOf(const Words& words) const;
  control::Feed feed(language::MoveKind kind, const Vector3& from, const Vector3& to) const;
  void checkWords(const language::Move& move, Evaluation& evaluation) const;
  void moveStraight(const Words& words, language::MoveKind kind);
  PathElement arc(const Words& words, language::MoveKind kind) const;
  PathElement arcAboutCentre(const Words& words, bool clockwise, Vector3 from, Vector3 to) const;
  PathElement arcThroughPoint(const Words& words, Vector3 from, Vector3 to) const;
  PathElement tangentialArc(Vector3 from, Vector3 to) const;
  bool readCornerWord(std::uint32_t address, double value, Words& words);
  bool resolveAngle(Words& words, language::MoveKind kind);
  std::optional<Corner> cornerOf(const Words& words, control::Feed next) const;
  void append(const PathElement& element, const std::optional<Corner>& corner);
  void run(const PathElement& element);
  bool leavesContact() const;
  void travel(const control::Target& target, control::Feed feed);
  void moveWithoutFrames(const language::Move& move, Evaluation& evaluation);

  Control& control_;
  MotionState& state_;
  Measurement measurement_;
  Vector3 direction_ = Vector3::Zero();  ///< of the last motion at its end, for CT; zero: nothing has moved yet
  std::vector<std::uint32_t> axisCodes_;
  CornerMaker corners_;
  RadiusCompensator compensator_;
  std::optional<Vector3> programmed_;  ///< end of the programmed contour while the tool stands elsewhere
  std::optional<Words> openLine_;      ///< a line with ANG alone: it ends where the line of the next block begins
};

}  // namespace probewright::execution::sinumerik

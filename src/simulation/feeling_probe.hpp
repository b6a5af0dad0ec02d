#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "simulation/body_guard.hpp"
#include "simulation/contact_search.hpp"
#include "simulation/edge_contact.hpp"
#include "simulation/tool_shape.hpp"
#include "simulation/true_kinematics.hpp"
#include "simulation/truth.hpp"

/// A probe in the hands of another machine: somebody else moves the axes, this tells what the sensors say.
namespace probewright::simulation {

/// What the sensors say, and what must not be.
struct Felt {
  bool touch = false;      ///< the touch probe signals
  bool byStylus = false;   ///< its stylus touched, not its ball
  bool toolTouch = false;  ///< the tool touch probe signals
  bool collision = false;
  bool operator==(const Felt&) const = default;
};

/// Where the axes stand and what they carry, asked again and again in the order of time.
struct Moment {
  machine::AxisPositions axes;  ///< as their measuring systems read
  int tool = 0;                 ///< number of the tool in the spindle; 0 for none
  double spindleSpeed = 0;      ///< revolutions/min, above 0 clockwise (M3)
  double seconds = 0;           ///< since the question before
  double spindleAngle = 0;      ///< degrees, to which the spindle was oriented last, as Machine::orientSpindle() counts
};

/// The sensors of a machine that a control of another house moves, one short step after another.
///
/// Step. From one question to the next the axes travel in a straight line of axis space, and everything between is
/// searched: nothing is passed because a step was long. A step faster than any axis (3 mm or 30 degrees in a
/// millisecond) is not a motion but a new zero, as homing sets it: what the tool is within then counts as touched, not
/// what lies between.
///
/// Touch probe. The ball touches; the axes travel on by the pretravel and what its noise adds, then for the signal
/// delay; the signal comes, and stays until the ball is off. The stylus signals as the ball does, at once. While it is
/// deflected the stylus gives way: only the body collides, and a ball that is pushed in by more than
/// `deepestDeflection`.
///
/// Tool touch probe. It signals at the touch of an edge of the cutter that stands in the spindle, looked for at each
/// question and, while the spindle turns, at every 2 degrees; until the cutter is off. Pushed where it does not give
/// way, or by an edge that cuts, it is a collision.
///
/// Collision. Anything else that touches, as long as it does, bodies of the machine too. After pullOff() what touches
/// then may be moved off.
class FeelingProbe {
public:
  /// `inSpindle`: the tool that is meant while the control says that there is none, before its first tool change.
  FeelingProbe(Truth truth, std::optional<int> inSpindle);
  FeelingProbe(const FeelingProbe&) = delete;
  FeelingProbe& operator=(const FeelingProbe&) = delete;

  Felt feel(const Moment& moment);
  void pullOff();

  /// Told what happens, in words, when it begins: touches, collisions, tools that the setup does not have.
  void onEvent(std::function<void(const std::string&)> tell) { tell_ = std::move(tell); }

private:
  /// A sensor from its first touch on.
  struct Deflection {
    Touch touch;
    Vector3 tip = Vector3::Zero();  ///< of the tool at the first touch, table frame
    double toGo = 0;                ///< mm that the axes travel until the signal comes on its way
    double toWait = 0;              ///< seconds that it takes then
    bool signals() const { return toGo <= 0 && toWait <= 0; }
    void advance(double length, double seconds);
  };
  /// What a step has travelled from some instant on.
  struct Rest {
    double length = 0, seconds = 0;
  };

  void changeTool(int number);
  /// The shapes of the tool as the spindle is turned.
  void orient(double degrees);
  Motion stepTo(const Moment& moment) const;
  void feelWithCutter(const Rest& whole, bool turnsTable);
  /// What the edges of the cutter touch of the tool touch probes now.
  std::optional<Touch> edgeTouch(double turned);
  void feelCollision(const Motion& step);
  bool stillDeflected() const;
  bool pushedTooFar() const;
  /// What touches that must not, where the tool stands.
  std::optional<Touch> obstacle() const;
  /// What bodies of the machine touch on a step, and where the axes stand.
  void feelBodies(const Motion& step);
  bool bodiesTouch() const;
  Pose pose() const { return kinematics_.tableFromSpindle(slides_, clock_); }
  void tell(const std::string& what) const {
    if (tell_) tell_(what);
  }
  std::string describe(const Touch& touch, const char* part) const;

  Truth truth_;
  TrueKinematics kinematics_;
  Surroundings all_, withoutToolProbes_, toolProbesOnly_;
  std::optional<int> inSpindle_;
  std::optional<int> number_;  ///< of the tool, as the control says; nothing before the first question
  const TrueTool* tool_ = nullptr;
  ToolShape feeler_;                   ///< ball and stylus of a probe
  ToolShape blunt_;                    ///< its body, or all of a cutter: what must touch nothing
  ToolShape carrier_;                  ///< shank and holder of a cutter
  ToolShape whole_;                    ///< all of the tool, to bodies of the machine
  std::unique_ptr<BodyGuard> guard_;   ///< null: the machine has no bodies
  std::optional<CuttingEdges> edges_;  ///< of a cutter
  machine::AxisPositions reading_, slides_;
  double clearance_ = 0;  ///< mm, of the edges from the tool touch probes, at least
  double clock_ = 0;
  double orientation_ = 0;  ///< degrees, of a spindle that stands
  double spindleDegrees_ = 0, degreesPerSecond_ = 0;
  std::optional<Deflection> deflection_;  ///< of the touch probe
  std::optional<Deflection> pushed_;      ///< of a tool touch probe; the touch's solid counts the tool touch probes
  bool broken_ = false;                   ///< the deflection is a collision
  bool pulledOff_ = false;                ///< what touches may be moved off, until nothing does
  bool colliding_ = false;
  std::mt19937_64 noise_;
  std::normal_distribution<double> gaussian_;
  std::function<void(const std::string&)> tell_;
};

}  // namespace probewright::simulation

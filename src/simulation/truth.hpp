#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "geometry/primitives.hpp"
#include "machine/description.hpp"
#include "simulation/cutter.hpp"
#include "simulation/machine_body.hpp"
#include "simulation/solid.hpp"
#include "simulation/tool_touch_probe.hpp"

/// What is true in a virtual world: where things really are and how far the machine is from its builder's drawing.
/// Plain data; a VirtualMachine is built from it and no control ever sees it.
namespace probewright::simulation {

enum class SolidRole { Part, Fixture, Ring, Sphere, GaugeBlock, ToolProbe };

/// A solid that lies on the table and travels with it.
struct PlacedSolid {
  std::shared_ptr<const Solid> solid;
  Pose tableFromSolid = Pose::Identity();
  std::string name;  ///< for messages and reports: "part", "vice"
  SolidRole role = SolidRole::Part;
  bool ofMachine = false;  ///< the machine's own table: it may stand close to its neighbours
};

/// A deviation that depends on where one axis stands (q, mm or degrees):
/// sum of polynomial[k] * (q / 1000)^k, plus amplitude * sin(360 degrees * q / wavelength + phase).
/// Polynomial and amplitude in mm; degrees for a rotary axis.
struct Deviation {
  /// Linear axes: the direction in which the tool deviates relative to the workpiece, base frame at zero position. Its
  /// own direction makes it a positioning error. Rotary axes always deviate in angle and ignore it.
  Vector3 direction = Vector3::UnitX();
  std::vector<double> polynomial;
  double amplitude = 0;
  double wavelength = 100;  ///< mm or degrees, > 0
  double phase = 0;         ///< degrees
};

/// How one axis differs from its display. What the axis truly does at the reading q:
/// slide = q .. q + backlash (it has followed the last motion in + to q, in - to q + backlash),
/// true position = slide * (1 + scale) + offset, and the deviations on top.
struct AxisErrors {
  double scale = 0;     ///< mm per mm or degrees per degree
  double offset = 0;    ///< mm or degrees at reading 0
  double backlash = 0;  ///< mm or degrees, >= 0
  std::vector<Deviation> deviations;
};

/// While `axis` travels in +, the tool drifts relative to the workpiece towards + of axis `towards` by `degrees`.
struct Squareness {
  std::size_t axis = 0;
  std::size_t towards = 0;
  double degrees = 0;
};

/// Where the axis of rotation of a rotary axis truly lies.
struct RotaryAxisError {
  std::size_t axis = 0;
  Vector3 position = Vector3::Zero();     ///< mm, base frame at zero position
  Vector3 orientation = Vector3::Zero();  ///< degrees about base X, Y, Z together (a rotation vector; small)
};

/// The spindle moves in the base frame by `amount` * (1 - exp(-t / timeConstant)).
struct ThermalDrift {
  Vector3 amount = Vector3::Zero();  ///< mm, reached after a long time
  double timeConstant = 3600;        ///< seconds, > 0
};

/// All that separates a real machine from its description. The default is a perfect machine.
struct MachineErrors {
  std::vector<AxisErrors> axes;  ///< by axis index; missing ones are perfect
  std::vector<Squareness> squareness;
  std::vector<RotaryAxisError> rotaryAxes;
  Vector3 spindleTilt = Vector3::Zero();  ///< degrees about X, Y, Z of the spindle frame at the nose (rotation vector)
  std::vector<ThermalDrift> thermal;
};

/// A touch probe as it truly is. Frame: the spindle's at spindle angle 0; of a tool across the spindle axis its own,
/// see toolFrame() in tool_shape.hpp.
struct TrueProbe {
  double ballRadius = 3;
  double stylusRadius = 1.5;   ///< of the shaft; 0 for none
  double stylusLength = 50;    ///< from the ball's centre to the face of the body
  double bodyRadius = 30;      ///< 0 for none
  double bodyLength = 100;     ///< upwards from that face
  Vector2 tipOffset = {0, 0};  ///< of the ball from the spindle axis, mm; turns with the spindle
  /// mm; above 0 the tip is a star: four balls, this far from its middle in +X, +Y, -X, -Y. The middle has the tip
  /// offset.
  double starArm = 0;

  /// How much further the axes travel along their path from contact to signal, mm. With n the outward normal of the
  /// surface in the turned spindle frame, e the part of n along the stylus, phi the angle of n about it:
  /// (1 - e^2) * (pretravel + lobing * cos(3 * (phi - lobingPhase))) + e^2 * axialPretravel
  double pretravel = 0;
  double lobing = 0;
  double lobingPhase = 0;  ///< degrees
  double axialPretravel = 0;

  double repeatability = 0;  ///< standard deviation of the signal along the path, mm
  double signalDelay = 0;    ///< seconds from signal to latched position; the axes travel on meanwhile
  bool switchedOn = true;
  std::string serial;  ///< that its interface tells; empty for none
};

enum class ToolKind { Probe, Cutter };

/// A tool in the magazine as it truly is.
struct TrueTool {
  int number = 0;
  std::string name;
  ToolKind kind = ToolKind::Probe;
  /// From the spindle nose (of lathes: from `mount`) to the lowest point along the tool: of a probe, of its ball.
  double length = 100;
  Vector3 mount = Vector3::Zero();            ///< from the spindle nose to where `length` begins, spindle frame
  Vector3 shankDirection = Vector3::UnitZ();  ///< from the tip to the holder, spindle frame; unit
  double radius = 5;                          ///< of a cutter, without the run-out of its teeth
  TrueCutter cutter;                          ///< if kind is Cutter
  TrueProbe probe;                            ///< if kind is Probe
};

struct Truth {
  machine::MachineDescription machine;  ///< as its builder describes it
  MachineErrors errors;
  std::vector<PlacedSolid> solids;
  std::vector<MachineBody> bodies;
  /// Each has a solid of the same name and of role ToolProbe in `solids`, which is drawn and stops what runs into it.
  std::vector<TrueToolProbe> toolProbes;
  /// Found by the control's name, else by number, where control or machine have no name for it; 0 is the empty spindle.
  std::vector<TrueTool> tools;
  machine::AxisPositions start;
  /// Degrees between the positions of a rotary axis with a Hirth coupling, from 0 on, by axis index; 0: it stands
  /// anywhere.
  machine::AxisPositions hirthGrid;
  std::uint64_t seed = 1;
};

/// `machine` as it truly is: squareness and the errors of rotary axes put into its chains.
machine::MachineDescription trueDescription(const machine::MachineDescription& machine, const MachineErrors& errors);

}  // namespace probewright::simulation

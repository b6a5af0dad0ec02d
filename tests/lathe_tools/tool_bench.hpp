#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "setup/calibrated_beliefs.hpp"
#include "simulation/tool_shape.hpp"
#include "simulation/tool_touch_probe.hpp"
#include "support/lathe_bench.hpp"

/// A lathe with a tool touch probe at its bed, tools in its turret, and calls of CYCLE982.
namespace probewright::testing_support {

/// The contact of the tool touch probe: a cube of 20 mm, its middle at X150 Z400 in the plane of the tools.
inline constexpr double half = 10;
inline const Vector3 probeMiddle(150, 0, 400);

/// Lays a cube like that on the bed, its stem behind it.
inline simulation::TrueToolProbe& placeCube(simulation::Truth& truth, const Vector3& middle,
                                            const std::string& name = "TT", const Pose& tilt = Pose::Identity()) {
  const Pose pose = translation(middle) * tilt * translation({0, half, 0}) * rotation(Vector3::UnitX(), -90);
  return placeToolProbe(truth, simulation::ContactElement::cuboid(2 * half, 2 * half, 2 * half).on(6, 30), pose, name);
}

/// Where the tip of a tool points, by its cutting edge position: along Z, along X.
inline Vector2 pointing(int position) {
  static constexpr std::array<std::array<int, 2>, 9> all = {
      {{0, 0}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  return {all[static_cast<std::size_t>(position)][0], all[static_cast<std::size_t>(position)][1]};
}

/// A turning tool with an insert whose tip is `lengths` (X, Z) from the reference point of the turret.
inline simulation::TrueTool turningTool(int number, int position, const Vector2& lengths, double nose) {
  simulation::TrueTool tool;
  tool.number = number;
  tool.name = fmt::format("TURN{}", number);
  tool.kind = simulation::ToolKind::Cutter;
  tool.radius = nose;
  tool.length = 60;
  // The holder lies away from where the tip points.
  const Vector2 points = pointing(position);
  const Vector3 tip(points.y(), 0, points.x());
  tool.shankDirection = tip.x() != 0 ? Vector3(-tip.x(), 0, 0) : Vector3(0, 0, -tip.z());
  tool.mount = Vector3(-lengths.x(), 0, -lengths.y()) + tool.length * tool.shankDirection;
  simulation::TrueInsert insert;
  insert.noseRadius = nose;
  const Matrix3 frame = simulation::toolFrame(tool);
  const Vector3 across = std::abs(tool.shankDirection.x()) > 0.5 ? Vector3::UnitZ() : Vector3::UnitX();
  insert.orientation = degreesFromRadians(std::atan2(frame.col(1).dot(across), frame.col(0).dot(across)));
  const Vector3 plane = std::cos(radiansFromDegrees(insert.orientation)) * frame.col(0) +
                        std::sin(radiansFromDegrees(insert.orientation)) * frame.col(1);
  const double middle = degreesFromRadians(std::atan2(tip.dot(frame.col(2)), tip.dot(plane)));
  // Both faces of a corner are reached; a tip that points along an axis reaches one.
  insert.firstNormal = middle - 50;
  insert.secondNormal = middle + 50;
  insert.edgeLength = 3;
  tool.cutter.insert = insert;
  return tool;
}

/// A mill or drill that points to -Z (axial) or -X (radial), its tip `lengths` (X, Z) from the reference point.
inline simulation::TrueTool rotatedTool(int number, bool radial, const Vector2& lengths, double radius, int teeth = 0) {
  simulation::TrueTool tool;
  tool.number = number;
  tool.name = fmt::format("MILL{}", number);
  tool.kind = simulation::ToolKind::Cutter;
  tool.radius = radius;
  tool.length = 50;
  tool.shankDirection = radial ? Vector3::UnitX() : Vector3::UnitZ();
  tool.mount = Vector3(-lengths.x(), 0, -lengths.y()) + tool.length * tool.shankDirection;
  for (int i = 0; i < teeth; ++i)
    tool.cutter.teeth.push_back({.angle = 360.0 * i / teeth});
  return tool;
}

/// A pin across the plane: it touches every side of the contact.
inline simulation::TrueTool calibrationPin(int number, const Vector2& lengths, double radius) {
  simulation::TrueTool tool;
  tool.number = number;
  tool.name = "PIN";
  tool.kind = simulation::ToolKind::Cutter;
  tool.radius = radius;
  tool.length = 70;
  tool.shankDirection = Vector3::UnitY();
  tool.mount = Vector3(-lengths.x() + radius, 63, -lengths.y() + radius);
  return tool;
}

inline void add(setup::Setup& setup, const simulation::TrueTool& tool, const std::string& kind) {
  setup.world.truth.tools.push_back(tool);
  control::BelievedTool believed;
  believed.number = tool.number;
  believed.name = tool.name;
  believed.kind = kind;
  setup::believeAsCalibrated(believed, tool);
  setup.beliefs.tools.push_back(believed);
}

/// A lathe with the probe at `probeMiddle`, which the control knows exactly.
inline setup::Setup toolSetup(const std::function<void(simulation::TrueToolProbe&)>& change = {}) {
  setup::Setup setup = latheSetup({});
  simulation::TrueToolProbe& probe = placeCube(setup.world.truth, probeMiddle);
  if (change) change(probe);
  setup.beliefs.toolProbes = setup::believedToolProbes(setup.world);
  return setup;
}

/// The name of a trigger point of the plane G18: axis 1 is Z, 2 is X.
inline std::string triggerName(int axis, double direction, const char* system = "TP") {
  return fmt::format("$SNS_MEA_{}_TRIG_{}_DIR_AX{}", system, direction < 0 ? "MINUS" : "PLUS", axis);
}

/// A program that calls tool `number`, goes to `start` (Z, X; radius) round the first probe, and then `call`.
inline std::string measuring(int number, const Vector2& start, const std::string& call) {
  const std::string beside =
      std::abs(start.y() - probeMiddle.x()) < 25 ? "" : fmt::format("G0 Z460 X{:.9f}\n", start.y());
  return fmt::format("DIAMOF\nT{} D1\n{}G0 Z{:.9f}\nG0 X{:.9f}\n{}", number, beside, start.x(), start.y(), call);
}

/// Away from the middle of the probe, against where the tip points.
inline Vector2 startOf(int position, double away = 40) {
  return Vector2(probeMiddle.z(), probeMiddle.x()) - away * pointing(position);
}

}  // namespace probewright::testing_support

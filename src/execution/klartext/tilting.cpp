#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "control/alarm.hpp"
#include "control/scoped.hpp"
#include "execution/klartext/tilting.hpp"
#include "execution/motion/tilted_plane.hpp"
#include "machine/rotary_solver.hpp"

namespace probewright::execution::klartext {

using control::Alarm;
using control::heidenhain::rotationFromSpaceAngles;

namespace {

Matrix3 about(const Vector3& axis, double degrees) { return rotation(axis, degrees).linear(); }

[[noreturn]] void refuse(std::string text) {
  throw Alarm("Plane definition wrong", std::move(text), "check the values of the PLANE block");
}

}  // namespace

void Tilting::plane(TransformKind kind, WordRange words, Evaluation& evaluation) {
  const auto value = [&](std::string_view address) { return numberOr(words, address, 0, evaluation); };
  const auto vector = [&](std::string_view prefix) {
    const std::string head(prefix);
    return Vector3(value(head + "X"), value(head + "Y"), value(head + "Z"));
  };
  const auto checked = [](const Vector3& v, const char* what) {
    if (v.norm() < 1e-9) refuse(fmt::format("{} has no length", what));
    return v;
  };
  const auto spaceAngles = [&] { return rotationFromSpaceAngles({value("SPA"), value("SPB"), value("SPC")}); };
  switch (kind) {
    case TransformKind::PlaneReset:
      return tilt(std::nullopt, words, evaluation);
    case TransformKind::PlaneSpatial:
      return tilt(spaceAngles(), words, evaluation);
    case TransformKind::PlaneProjected:
      return tilt(motion::planeOfProjections(value("PROP"), value("PROM")) * about(Vector3::UnitZ(), value("ROT")),
                  words, evaluation);
    case TransformKind::PlaneEuler:
      return tilt(about(Vector3::UnitZ(), value("EULP")) * about(Vector3::UnitX(), value("EULN")) *
                      about(Vector3::UnitZ(), value("EULR")),
                  words, evaluation);
    case TransformKind::PlaneVector: {
      const Vector3 base = checked(vector("B"), "the base vector");
      const Vector3 normal = checked(vector("N"), "the normal vector");
      checked(base.normalized().cross(normal.normalized()), "the base vector square to the normal vector");
      return tilt(motion::planeAlong(base, normal), words, evaluation);
    }
    case TransformKind::PlanePoints: {
      const Vector3 p1 = vector("P1");
      const Vector3 along = checked(vector("P2") - p1, "the line from point 1 to point 2");
      const Vector3 normal = along.cross(vector("P3") - p1);
      return tilt(motion::planeAlong(along, checked(normal, "the triangle of the three points")), words, evaluation);
    }
    case TransformKind::PlaneRelative:
      return tilt(control_.coordinates.tilt.value_or(Matrix3::Identity()) * spaceAngles(), words, evaluation);
    case TransformKind::PlaneAxial:
      return turnAxes(words, evaluation);
    default:
      throw std::logic_error("not a form of PLANE");
  }
}

/// PLANE AXIAL: the plane is where the rotary axes are to be.
void Tilting::turnAxes(WordRange words, Evaluation& evaluation) {
  machine::AxisPositions target = control_.channel.axes();
  const machine::AxisPositions& reference = control_.coordinates.preset.rotaryOffset;
  for (const Word& word : evaluation.words(words)) {
    if (word.address < 'A' || word.address > 'C') continue;
    const std::size_t axis = run_.axisOf(static_cast<char>(word.address));
    const double angle = evaluation.number(word.value);
    target[axis] =
        word.mode == WordMode::Incremental ? target[axis] + angle : angle + control_.channel.rotaryOffset[axis];
  }
  // As the workpiece system sees it, with basic rotation, rotation and mirror image.
  const Matrix3 workpiece = machineFromWorkpiece();
  const Matrix3 axes =
      workpiece.transpose() * toolOrientation(control_.channel.description(), reference, target) * workpiece;
  control_.coordinates.tilt = axes;
  control_.coordinates.tiltIsAxial = true;
  control_.coordinates.workingPlane = {};
  positionRotaryAxes(target, words, evaluation);
  control_.applyCoordinates();
}

/// Directions of the workpiece system: preset with basic rotation, then rotation and mirror image before the tilt.
Matrix3 Tilting::machineFromWorkpiece() const {
  const control::heidenhain::Coordinates& coordinates = control_.coordinates;
  return coordinates.machineFromPreset().linear() * coordinates.workpiece.directions(coordinates.plane);
}

void Tilting::tiltByCycle19(WordRange words, Evaluation& evaluation) {
  Vector3 angles = Vector3::Zero();
  bool given = false;
  for (const Word& word : evaluation.words(words)) {
    if (word.address < 'A' || word.address > 'C') continue;
    angles[static_cast<Eigen::Index>(word.address - 'A')] = evaluation.number(word.value);
    given = true;
  }
  if (!given) {
    control_.coordinates.tilt.reset();
    control_.coordinates.workingPlane = {};
    control_.applyCoordinates();
    return;
  }
  tilt(rotationFromSpaceAngles(angles), words, evaluation);
}

/// The solutions on the side that SEQ (of the rest position) or SYM (of the point of symmetry) asks for.
void Tilting::keepWantedSide(std::vector<machine::AxisPositions>& solutions, const Vector3& toolAxis, WordRange words,
                             Evaluation& evaluation) const {
  const machine::MachineDescription& description = control_.channel.description();
  const std::optional<machine::TiltingAxis> tilting = tiltingAxis(description, toolAxis);
  if (!tilting) return;
  for (const std::string_view side : {"SEQ", "SYM"}) {
    const Word* word = find(words, side, evaluation);
    if (word == nullptr) continue;
    const double middle = side == "SYM" ? tilting->symmetry : control_.coordinates.preset.rotaryOffset[tilting->axis];
    const double sign = evaluation.number(word->value);
    std::erase_if(solutions, [&](const machine::AxisPositions& s) {
      return std::remainder(s[tilting->axis] - middle, 360.0) * sign < -1e-9;
    });
    if (!solutions.empty()) continue;
    throw Alarm("Entered angle not permitted",
                fmt::format("Axis {} reaches this plane only on the other side than {}{} asks for",
                            description.axes[tilting->axis].name, side, sign > 0 ? '+' : '-'),
                fmt::format("use the other sign, or leave {} out", side));
  }
}

/// COORD ROT, which is the standard, leaves a free rotary axis at 0. TABLE ROT turns it until the plane lies along the
/// machine's axes if the plane is turned about the tool axis only, and otherwise leaves it where it stands.
void Tilting::placeFreeAxis(const Matrix3& machineFromPlane, const Vector3& toolAxis, bool onlyTurned,
                            machine::AxisPositions& target, WordRange words, Evaluation& evaluation) const {
  const machine::MachineDescription& description = control_.channel.description();
  const machine::AxisPositions& reference = control_.coordinates.preset.rotaryOffset;
  const std::optional<std::size_t> axis = freeRotaryAxis(description, machineFromPlane * toolAxis, reference);
  if (!axis) return;
  if (find(words, "TABL", evaluation) == nullptr) {
    target[*axis] = control_.channel.rotaryOffset[*axis];
    return;
  }
  target[*axis] = control_.channel.axes()[*axis];
  if (!onlyTurned) return;
  Vector3 main = Vector3::Zero();
  main[control_.coordinates.plane.main] = 1;
  const std::optional<double> angle =
      alignedAngle(description, *axis, machineFromPlane * main, main, reference, target);
  if (!angle) {
    throw Alarm("Entered angle not permitted",
                fmt::format("Axis {} cannot turn the workpiece as TABLE ROT asks for", description.axes[*axis].name),
                "use COORD ROT");
  }
  target[*axis] = *angle;
}

/// Tilts the working plane, or ends the tilt, and positions the rotary axes as the block asks for.
void Tilting::tilt(const std::optional<Matrix3>& wanted, WordRange words, Evaluation& evaluation) {
  const machine::MachineDescription& description = control_.channel.description();
  control::heidenhain::Coordinates& coordinates = control_.coordinates;
  const machine::AxisPositions& reference = coordinates.preset.rotaryOffset;
  const machine::AxisPositions now = control_.channel.axes();

  machine::AxisPositions target = now;
  Vector3 toolAxis = Vector3::Zero();
  toolAxis[coordinates.plane.tool] = 1;
  if (!wanted) {
    for (std::size_t i = 0; i < description.axes.size(); ++i) {
      if (description.axes[i].kind == machine::AxisKind::Rotary) target[i] = reference[i];
    }
  } else {
    if (coordinates.workpiece.mirror[static_cast<std::size_t>(coordinates.plane.tool)]) {
      throw Alarm("Plane definition wrong", "The tool axis is mirrored: the tilted plane would lie upside down",
                  "mirror other axes, or end the mirror image before the plane");
    }
    const Matrix3 machineFromPlane = machineFromWorkpiece() * *wanted;
    std::vector<machine::AxisPositions> solutions =
        solveRotaryAxes(description, machineFromPlane * toolAxis, toolAxis, reference, now);
    if (solutions.empty()) {
      throw Alarm("Entered angle not permitted", "The rotary axes of the machine cannot reach this plane",
                  "choose another plane or a machine whose rotary axes reach it");
    }
    keepWantedSide(solutions, toolAxis, words, evaluation);
    const auto distance = [&](const machine::AxisPositions& s) {
      double sum = 0;
      for (std::size_t i = 0; i < description.axes.size(); ++i)
        sum += std::abs(s[i] - now[i]);
      return sum;
    };
    target = *std::ranges::min_element(solutions, {}, distance);
    const bool onlyTurned = (*wanted * toolAxis - toolAxis).norm() < 1e-9;
    placeFreeAxis(machineFromPlane, toolAxis, onlyTurned, target, words, evaluation);
  }
  publishRotaryAxes(target);
  positionRotaryAxes(target, words, evaluation);
  coordinates.tilt = wanted;
  coordinates.tiltIsAxial = false;
  coordinates.workingPlane = {};
  control_.applyCoordinates();
}

void Tilting::publishRotaryAxes(const machine::AxisPositions& target) {
  const machine::MachineDescription& description = control_.channel.description();
  for (int i = 0; i < 3; ++i) {
    const char name = static_cast<char>('A' + i);
    const auto axis = description.axisIndex(std::string_view(&name, 1));
    control_.q.setQ(120 + i, axis ? target[*axis] - control_.channel.rotaryOffset[*axis] : 0);
  }
}

/// MOVE keeps the tip, or the point DIST above it, on the workpiece, TURN moves the rotary axes alone, STAY (and cycle
/// 19 without F) moves nothing.
void Tilting::positionRotaryAxes(const machine::AxisPositions& target, WordRange words, Evaluation& evaluation) {
  publishRotaryAxes(target);
  const bool isMove = find(words, "MOVE", evaluation) != nullptr;
  const bool isTurn = find(words, "TURN", evaluation) != nullptr;
  const bool stays = find(words, "STAY", evaluation) != nullptr;
  const Word* feedWord = find(words, "F", evaluation);
  if (stays || (!isMove && !isTurn && feedWord == nullptr)) return;
  control::Feed feed = control::Feed::rapidTraverse();
  if (feedWord != nullptr) feed = checkedFeed(run_.feed(feedWord->value, evaluation));
  if (const Word* back = find(words, "MB", evaluation)) {
    std::optional<double> distance;
    if (back->value.present()) distance = run_.length(back->value, evaluation);
    motion_.retract(distance, feed);
  }
  control::Channel& channel = control_.channel;
  const machine::MachineDescription& description = channel.description();
  control::Target turned;
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    if (description.axes[i].kind == machine::AxisKind::Rotary) turned.rotary[i] = target[i] - channel.rotaryOffset[i];
  }
  const control::Scoped held(channel.holdTip, isMove);
  const control::Scoped guided(channel.toolVector, channel.toolVector);
  control_.applyCoordinates();
  if (const Word* distance = find(words, "DIST", evaluation); isMove && distance != nullptr) {
    // The point that stays on the workpiece lies that far above the tip.
    channel.toolVector -= channel.toolVector.normalized() * run_.length(distance->value, evaluation);
  }
  channel.moveTo(turned, feed);
}

}  // namespace probewright::execution::klartext

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "control/alarm.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/object_probing.hpp"
#include "cycles/heidenhain/rotation_parameters.hpp"
#include "cycles/heidenhain/rotation_transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice positionChoices[] = {{0, "no correction"},
                                      {1, "first position"},
                                      {2, "second position"},
                                      {3, "third position"},
                                      {4, "mean of the three positions"}};
constexpr Choice rotationChoices[] = {{0, "no"}, {1, "as basic rotation"}};

constexpr std::array transferOf3 = {
    option(1120, "Q1120", "position that corrects the active preset", positionChoices),
    option(1121, "Q1121", "take over the rotation", rotationChoices),
};

constexpr std::array parameters1420 =
    joined(joined(joined(position1, position2), joined(position3, std::array{signedDirection})),
           joined(travelAndReaction, transferOf3));

constexpr std::array results1420 = joined(
    firstTwoPositions,
    std::array{ResultDefinition{"Q956", "third measured position, main axis", result::actual(of::position1.number(3))},
               ResultDefinition{"Q957", "third measured position, minor axis", result::actual(of::position2.number(3))},
               ResultDefinition{"Q958", "third measured position, tool axis", result::actual(of::position3.number(3))},
               ResultDefinition{"Q961",
                                {"measured ", "space angle SPA in the workpiece coordinate system"},
                                result::actual(of::angleX).main()},
               ResultDefinition{"Q962", {"measured ", "space angle SPB"}, result::actual(of::angleY).main()},
               ResultDefinition{"Q963", {"measured ", "space angle SPC"}, result::actual(of::angleZ).main()}},
    deviationsOfFirstTwo,
    std::array{
        ResultDefinition{
            "Q986", {"deviation of the ", "third position, main axis"}, result::difference(of::position1.number(3))},
        ResultDefinition{
            "Q987", {"deviation of the ", "third position, minor axis"}, result::difference(of::position2.number(3))},
        ResultDefinition{
            "Q988", {"deviation of the ", "third position, tool axis"}, result::difference(of::position3.number(3))}},
    verdictOfRotation);

bool spanATriangle(const Vector3& p1, const Vector3& p2, const Vector3& p3) {
  const Vector3 a = p2 - p1, b = p3 - p1;
  return a.norm() >= 1e-6 && a.cross(b).norm() > 1e-6 * a.norm() * b.norm();
}

void rules(CallRules& call) {
  const auto p1 = call.numbers({1100, 1101, 1102}), p2 = call.numbers({1103, 1104, 1105}),
             p3 = call.numbers({1106, 1107, 1108});
  if (p1 && p2 && p3 && !spanATriangle(*p1, *p2, *p3))
    call.refuseUnlessBlank("Plane wrongly defined", {1100, 1101, 1102, 1103, 1104, 1105, 1106, 1107, 1108},
                           "The three points lie on one straight line", "choose points that span a triangle");
}

/// The normal of the plane through three points, on the side of `towards`.
PlaneWay normalOf(const PartPoint& p1, const PartPoint& p2, const PartPoint& p3, const PlaneWay& towards) {
  const PlaneWay cross = (p2 - p1).cross(p3 - p1);
  if (!spanATriangle(p1.vector(), p2.vector(), p3.vector()))
    throw control::Alarm("Plane wrongly defined", "The three points lie on one straight line",
                         "choose points that span a triangle");
  const PlaneWay normal = cross.normalized();
  return normal.dot(towards) < 0 ? -normal : normal;
}

Matrix3 turned(double radians, int axis) { return Eigen::AngleAxisd(radians, Vector3::Unit(axis)).toRotationMatrix(); }

/// The rotation that brings the axis of probing to `normal` (or to its opposite) by space angles about the other two
/// axes, none about itself. A plane that can be probed along the axis is never parallel to it, so nothing is singular.
///
/// With the angles a, b, c about X, Y, Z, and s, k for sine and cosine, the axis becomes
///     Rz(c) Ry(b) ex = (kb kc, kb sc, -sb),   Rz(c) Rx(a) ey = (-sc ka, kc ka, sa),   Ry(b) Rx(a) ez = (sb ka, -sa, kb
///     ka):
/// one component gives the inner angle by its sine, the quotient of the others the outer one.
Matrix3 axesOfNormal(const PlaneWay& normal, int axis) {
  const Vector3 n = normal[axis] < 0 ? Vector3(-normal.vector()) : normal.vector();
  switch (axis) {
    case 0:
      return turned(std::atan2(n.y(), n.x()), 2) * turned(std::asin(std::clamp(-n.z(), -1.0, 1.0)), 1);
    case 1:
      return turned(std::atan2(-n.x(), n.y()), 2) * turned(std::asin(std::clamp(n.z(), -1.0, 1.0)), 0);
    default:
      return turned(std::atan2(n.x(), n.z()), 1) * turned(std::asin(std::clamp(-n.y(), -1.0, 1.0)), 0);
  }
}

/// Where a plane faces: the tool axis, or to the side as a wall does.
enum class Faces { Tool, Sideways };

/// Angles about main, minor and tool axis (of the unturned system, in this order) that bring the tool axis to `normal`.
/// The third is 0; for walls across the minor axis, where the second would say nothing, the second is.
///
/// Ry(b) Rx(a) ez = (sb ka, -sa, kb ka) gives a and b as above. Rz(c) Rx(a) ez = (sa sc, -sa kc, ka), and the length of
/// its first two components is |sa|: the sign of sa is that with which c stays within a quarter turn.
Vector3 anglesOfNormal(const Vector3& n, Faces faces) {
  if (faces == Faces::Sideways && std::abs(n.y()) > std::abs(n.x())) {
    const double side = n.y() < 0 ? 1 : -1;
    return {std::atan2(side * std::hypot(n.x(), n.y()), n.z()), 0, std::atan2(side * n.x(), -side * n.y())};
  }
  return {std::asin(std::clamp(-n.y(), -1.0, 1.0)), std::atan2(n.x(), n.z()), 0};
}

/// The same as space angles about X, Y and Z in degrees.
Vector3 spaceAnglesOfNormal(const control::WorkingPlane& plane, const Vector3& normal, Faces faces) {
  const Vector3 angles = anglesOfNormal(normal, faces);
  // Read off as they are: a matrix would not tell a wall that leans over from one turned round.
  if (plane.tool == 2) return angles.unaryExpr([](double angle) { return degreesFromRadians(angle); });
  const Matrix3 axes = turned(angles.z(), 2) * turned(angles.y(), 1) * turned(angles.x(), 0);
  Matrix3 xyz;
  for (int i = 0; i < 3; ++i) {
    const int column = i == 0 ? plane.main : i == 1 ? plane.minor : plane.tool;
    xyz.col(column) = plane.xyzFromPlane(Vector3(axes.col(i)));
  }
  return control::heidenhain::spaceAnglesFromRotation(xyz);
}

constexpr LogTerm logTerms[] = {
    {"PROBING IN PLANE", "IZMERENIE PLOSKOSTI", "AVKAENNING PLAN"},
    {"Measured space angle SPA", "Измеренный пространственный угол SPA", "Uppmätt rymdvinkel SPA"},
    {"Measured space angle SPB", "Измеренный пространственный угол SPB", "Uppmätt rymdvinkel SPB"},
    {"Measured space angle SPC", "Измеренный пространственный угол SPC", "Uppmätt rymdvinkel SPC"},
};

constexpr CycleDefinition definition = {
    .number = 1420,
    .name = "1420",
    .title = "PROBING IN PLANE",
    .family = CycleFamily::Misalignment,
    .summary =
        "Measures the space angles of a plane by three touches; can take them over as 3-D basic rotation, position the "
        "rotary axes, correct the preset and monitor tolerances.",
    .parameters = parameters1420,
    .results = results1420,
    .controls = control::onTNC640,
};

void run(Context& context, const Arguments&) {
  requireRotationCycle(context);
  const auto& axes = context.channel().description().axes;
  if (context.option(1126) != 0 && std::ranges::count(axes, machine::AxisKind::Rotary, &machine::Axis::kind) < 2) {
    throw control::Alarm("Rotary axes cannot be aligned", "The machine has fewer than two rotary axes",
                         "set Q1126 = 0");
  }
  const int direction = context.option(372);
  const int axis = std::abs(direction) - 1;
  constexpr std::array<bool, 3> needed = {true, true, true};
  const std::array nominal = {nominalPosition(context, 1, needed), nominalPosition(context, 2, needed),
                              nominalPosition(context, 3, needed)};
  // The normal points along the tool axis, that of a wall towards the probe.
  const PlaneWay side = axis == 2 ? PlaneWay::unit(2) : -probing::axisDirection(axis, direction);
  const auto middles = [&](std::size_t i) { return measuredPosition(nominal[i], {}, needed).nominal; };
  const PlaneWay nominalNormal = normalOf(middles(0), middles(1), middles(2), side);

  // About which axes the plane is described: not about the one that it faces.
  int facing = axis;
  if (std::abs(nominalNormal[axis]) < 0.1) {
    if (!std::ranges::all_of(nominal, &NominalPosition::known)) {
      throw control::Alarm("Plane wrongly defined",
                           "The plane of the nominal positions lies along the probing direction",
                           "choose the axis that the plane faces (Q372)");
    }
    nominalNormal.vector().cwiseAbs().maxCoeff(&facing);
  }

  // The operator may choose other directions than Q372.
  std::array<int, 3> directions = {direction, direction, direction};
  std::array<MeasuredPosition, 3> found;
  std::vector<EvaluatedTouch> touched;
  std::optional<ObjectProbing> probing;
  for (std::size_t i = 0; i < 3; ++i) {
    PartPoint actual;
    if (nominal[i].known()) {
      actual = {*nominal[i].axes[0].actual, *nominal[i].axes[1].actual, *nominal[i].axes[2].actual};
    } else {
      if (!probing) probing.emplace(context, "point");
      const EvaluatedTouch touch = probing->touch(nominal[i], directions[i]);
      actual = touch.surface;
      touched.push_back(touch);
    }
    found[i] = measuredPosition(nominal[i], actual, axisOf(directions[i]));
  }
  if (probing) probing->leaveLastObject();
  if (touched.size() == 3) {
    notePlane(context.channel().journal(),
              std::array{touched[0].surface.vector(), touched[1].surface.vector(), touched[2].surface.vector()},
              placesOf(touched));
  }

  const PlaneWay normal = normalOf(found[0].actual, found[1].actual, found[2].actual, nominalNormal);
  // Space angles count in the workpiece coordinate system, about its X, Y and Z.
  const auto& coordinates = context.control().coordinates;
  const auto& plane = coordinates.plane;
  const Vector3 inWorkpiece =
      plane.planeFromXyz(coordinates.machineFromPreset().linear().transpose() * context.channel().frame().linear() *
                         plane.xyzFromPlane(normal).vector());
  const Vector3 space = spaceAnglesOfNormal(plane, inWorkpiece, facing == 2 ? Faces::Tool : Faces::Sideways);

  RotationFindings findings(context);
  for (std::size_t i = 0; i < 3; ++i)
    findings.add(nominal[i], found[i], directions[i]);
  findings.addAngle(961, "Measured space angle SPA", space.x());
  findings.addAngle(962, "Measured space angle SPB", space.y());
  findings.addAngle(963, "Measured space angle SPC", space.z());
  findings.finish();
  transferSpaceRotation(context, axesOfNormal(normal, facing) * axesOfNormal(nominalNormal, facing).transpose(), found);
}

}  // namespace

extern const Entry cycle1420 = {.definition = definition,
                                .conditions = {.under = Transformed::ByShiftOrRotation, .mismatchWithTcpm = true},
                                .logTerms = logTerms,
                                .rules = rules,
                                .run = run};

}  // namespace probewright::cycles::heidenhain

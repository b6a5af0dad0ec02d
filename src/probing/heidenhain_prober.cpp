#include "probing/heidenhain_prober.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "control/stopped_place.hpp"
#include "probing/arc.hpp"

namespace probewright::probing {

using control::Alarm;
using machine::Feed;
using machine::MeasureEnd;

double inProgramUnits(const control::Channel& channel, double length, const ProgramWay& direction) {
  return length / (channel.spindleFromProgram() * direction.vector()).norm();
}

ProgramWay alongTool(const control::Channel& channel, double length) {
  const ProgramWay axis = channel.toolAxis();
  return inProgramUnits(channel, length, axis) * axis;
}

double HeidenhainProber::inProgram(double length, const Vector3& direction) const {
  return inProgramUnits(channel_, length, plane_.xyzFromPlane(PlaneWay(direction)));
}

double HeidenhainProber::standOff(double extra) const {
  const double length = probe_.reach() + probe_.setUp;
  return std::max(inProgram(length, Vector3::UnitX()), inProgram(length, Vector3::UnitY())) + extra;
}

Vector3 HeidenhainProber::ballFromTip() const {
  const Vector3 above = plane_.planeFromXyz(alongTool(channel_, probe_.ballRadius)).vector();
  return probe_.aside || probe_.track ? above : above + tipOffsetNow();
}

Vector3 HeidenhainProber::positionWithTip(const Vector3& tip) const { return tip + ballFromTip(); }

Vector3 HeidenhainProber::position() const {
  return positionWithTip(plane_.planeFromXyz(channel_.position()).vector());
}

Vector3 HeidenhainProber::prePosition(const PlannedTouch& touch, double extra) const {
  const Vector3 ball =
      touch.surface - touch.direction * (inProgram(probe_.ballRadius + probe_.setUp, touch.direction) + extra);
  if (!probe_.aside && !probe_.track) return ball;
  return ball - tipOffsetAt(orientationFor(touch.direction).value_or(channel_.machine().spindle().angle));
}

Feed HeidenhainProber::positioning() const {
  return probe_.prepositionAtMachineRapid ? Feed::rapidTraverse() : Feed::at(probe_.positioningFeed);
}

void HeidenhainProber::moveTo(const Vector3& ballCentre) {
  channel_.moveTo(plane_.xyzFromPlane(PlanePlace(ballCentre - ballFromTip())), positioning());
}

void HeidenhainProber::moveHeightTo(double height) {
  Vector3 target = position();
  target[2] = height;
  moveTo(target);
}

void HeidenhainProber::moveSouthPoleTo(double height) { moveHeightTo(height + poleDepth()); }

void HeidenhainProber::moveInPlane(const Vector3& ballCentre) {
  Vector3 target = ballCentre;
  target[2] = position()[2];
  moveTo(target);
}

void HeidenhainProber::approach(const Vector3& ballCentre, double clearanceHeight) {
  const double southPole = position()[2] - poleDepth();
  if (southPole < clearanceHeight) moveSouthPoleTo(clearanceHeight);
  moveInPlane(ballCentre);
  moveHeightTo(ballCentre[2]);
}

void HeidenhainProber::moveOnArc(const Vector3& centre, double angle) {
  std::vector<ProgramPlace> tips;
  for (const Vector3& point : pointsOnArc(position(), centre, angle))
    tips.push_back(plane_.xyzFromPlane(PlanePlace(point - ballFromTip())));
  channel_.moveAlong(tips, positioning());
}

Vector3 HeidenhainProber::tipOffsetAt(double spindleAngle) const {
  if (probe_.tipOffset.isZero(0)) return Vector3::Zero();
  const double turn = radiansFromDegrees(spindleAngle - probe_.calibrationAngle);
  const Vector2 turned = Eigen::Rotation2Dd(turn) * probe_.tipOffset;
  // Spindle X and Y lie along the main and minor axis of the working plane that belongs to the tool.
  return plane_.planeFromXyz(channel_.spindleFromProgram().inverse() *
                             plane_.xyzFromPlane(Vector3(turned.x(), turned.y(), 0)));
}

Vector3 HeidenhainProber::tipOffsetNow() const { return tipOffsetAt(channel_.machine().spindle().angle); }

std::optional<double> HeidenhainProber::orientationFor(const Vector3& direction) const {
  const Vector3 inSpindle = plane_.planeFromXyz(channel_.spindleFromProgram() * plane_.xyzFromPlane(direction));
  if (!probe_.track || std::hypot(inSpindle.x(), inSpindle.y()) <= 1e-9) return std::nullopt;
  // The side that lies along the main axis at the calibration angle leads; a ball that stands aside leads itself.
  const double leading = probe_.aside ? std::atan2(probe_.tipOffset.y(), probe_.tipOffset.x()) : 0;
  return probe_.calibrationAngle + degreesFromRadians(std::atan2(inSpindle.y(), inSpindle.x()) - leading);
}

double HeidenhainProber::directionalRadius(const Vector3& xyzDirection) const {
  if (probe_.directions.rings().empty()) return 0;
  const Vector3 inSpindle = plane_.planeFromXyz(channel_.spindleFromProgram() * xyzDirection);
  const double turn = channel_.machine().spindle().angle - probe_.calibrationAngle;
  return probe_.directions.at(rotation(Vector3::UnitZ(), -turn).linear() * inSpindle);
}

EvaluatedTouch HeidenhainProber::touch(const PlannedTouch& planned) {
  return stroke(planned.direction, inProgram(probe_.distance, planned.direction), planned.surface);
}

EvaluatedTouch HeidenhainProber::stroke(const Vector3& direction, double distance,
                                        const std::optional<Vector3>& expected) {
  const ProgramPlace startTip = channel_.position();
  const Vector3 xyzDirection = plane_.xyzFromPlane(direction);
  if (const std::optional<double> angle = orientationFor(direction)) channel_.orientSpindle(*angle);
  const Vector3 start = position();
  control::TouchRecord record;
  record.target = plane_.xyzFromPlane(expected.value_or(start + direction * distance));
  record.direction = xyzDirection;

  const double directional = inProgram(directionalRadius(xyzDirection), direction);
  const double radius = ballRadius(direction);
  const Vector3 above = plane_.planeFromXyz(alongTool(channel_, probe_.ballRadius)).vector();
  std::vector<Vector3> centres;
  EvaluatedTouch touch;
  const auto finish = [&](std::string outcome) {
    record.seconds = channel_.seconds();
    record.outcome = std::move(outcome);
    touch.record = channel_.journal().touch(record);
  };
  for (int i = 0; i < std::max(1, probe_.repetitions); ++i) {
    const machine::MeasureResult result = channel_.measureTo(startTip + ProgramWay(xyzDirection * distance),
                                                             Feed::at(probe_.probingFeed), machine::Sensor::TouchProbe);
    switch (result.end) {
      case MeasureEnd::Touched:
        break;
      case MeasureEnd::NoContact:
        finish("no contact");
        throw Alarm("Touch point inaccessible",
                    fmt::format("The stylus was not deflected within {:.3f} mm; the {}",
                                distance * (channel_.spindleFromProgram() * xyzDirection).norm(),
                                control::stoppedPlace(channel_)),
                    fmt::format("check nominal values, preset and {}", probe_.distanceName));
      case MeasureEnd::DeflectedAtStart:
        finish("deflected");
        throw Alarm("Stylus already in contact",
                    control::deflectedAtStart(channel_, "The stylus is deflected before probing begins", result.detail),
                    "increase the set-up clearance or correct the nominal position");
      case MeasureEnd::NotReady:
        finish("not ready");
        throw Alarm("Touch probe not ready",
                    result.detail.empty() ? "There is no touch probe in the spindle" : result.detail,
                    "call the touch probe with TOOL CALL before the cycle, and see that it is switched on");
      case MeasureEnd::AxisLimit:
        finish("limit");
        throw Alarm(channel_.alarms.limit, result.detail,
                    "check nominal values, preset and the position of the workpiece in the machine");
      case MeasureEnd::Collision:
      case MeasureEnd::Cancelled:  // the channel throws it, and what is refused
      case MeasureEnd::Refused:
        finish("collision");
        throw Alarm(channel_.alarms.collision, result.detail);
    }
    const control::Touch latched = channel_.touchFrom(result);
    touch.latched = latched.latched;
    centres.push_back(plane_.planeFromXyz(latched.tip).vector() + above + tipOffsetNow());
    const Vector3 centre = centres.back() + direction * directional;
    record.ballCentre = plane_.xyzFromPlane(centre);
    record.surface = plane_.xyzFromPlane(centre + direction * radius);
    record.latched = latched.latched;
    finish("touched");
    channel_.retractTo(startTip, Feed::rapidTraverse());
  }
  Vector3 mean = Vector3::Zero();
  for (const Vector3& centre : centres)
    mean += centre / static_cast<double>(centres.size());
  for (const Vector3& centre : centres) {
    const double apart = (channel_.spindleFromProgram() * plane_.xyzFromPlane(centre - mean)).norm();
    if (centres.size() > 1 && probe_.confidence > 0 && apart > probe_.confidence) {
      throw Alarm("Value beyond tolerance",
                  fmt::format("Repeated measurements of one point differ by more than {:.4f} mm", probe_.confidence),
                  "clean the part, check the probe and MP6171");
    }
  }
  touch.ballCentre = mean + direction * directional;
  touch.surface = touch.ballCentre + direction * radius;
  touch.ballRadius = radius;
  return touch;
}

}  // namespace probewright::probing

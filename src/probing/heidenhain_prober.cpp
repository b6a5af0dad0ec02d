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

ProgramPlace spindlePlace(const control::Channel& channel, const machine::AxisPositions& axes) {
  return channel.programFromAxes(axes) + alongTool(channel, channel.toolVector.norm());
}

double HeidenhainProber::inProgram(double length, const PlaneWay& direction) const {
  return inProgramUnits(channel_, length, plane_.xyzFromPlane(direction));
}

double HeidenhainProber::standOff(double extra) const {
  const double length = probe_.reach() + probe_.setUp;
  return std::max(inProgram(length, PlaneWay::unit(0)), inProgram(length, PlaneWay::unit(1))) + extra;
}

PlaneWay HeidenhainProber::ballFromTip() const {
  const PlaneWay above = plane_.planeFromXyz(alongTool(channel_, probe_.ballRadius));
  return probe_.aside || probe_.track ? above : above + tipOffsetNow();
}

BallCentre HeidenhainProber::positionWithTip(const PlanePlace& tip) const { return ballAt(tip, ballFromTip()); }

BallCentre HeidenhainProber::position() const { return positionWithTip(plane_.planeFromXyz(channel_.position())); }

BallCentre HeidenhainProber::prePosition(const PlannedTouch& touch, double extra) const {
  const double away = inProgram(probe_.ballRadius + probe_.setUp, touch.direction) + extra;
  const BallCentre ball = ballAt(touch.surface, -(touch.direction * away));
  if (!probe_.aside && !probe_.track) return ball;
  return ball - tipOffsetAt(orientationFor(touch.direction).value_or(channel_.machine().spindle().angle));
}

Feed HeidenhainProber::positioning() const {
  return probe_.prepositionAtMachineRapid ? Feed::rapidTraverse() : Feed::at(probe_.positioningFeed);
}

void HeidenhainProber::moveTo(const BallCentre& ballCentre) {
  channel_.moveTo(plane_.xyzFromPlane(tipAt(ballCentre, -ballFromTip())), positioning());
}

void HeidenhainProber::moveHeightTo(double height) {
  BallCentre target = position();
  target[2] = height;
  moveTo(target);
}

void HeidenhainProber::moveSouthPoleTo(double height) { moveHeightTo(height + poleDepth()); }

void HeidenhainProber::moveInPlane(const BallCentre& ballCentre) {
  BallCentre target = ballCentre;
  target[2] = position()[2];
  moveTo(target);
}

void HeidenhainProber::approach(const BallCentre& ballCentre, double clearanceHeight) {
  const double southPole = position()[2] - poleDepth();
  if (southPole < clearanceHeight) moveSouthPoleTo(clearanceHeight);
  moveInPlane(ballCentre);
  moveHeightTo(ballCentre[2]);
}

void HeidenhainProber::moveOnArc(const PartPoint& centre, double angle) {
  const std::vector<Vector3> points = pointsOnArc(position().vector(), centre.vector(), angle);
  const PlaneWay tipFromBall = -ballFromTip();
  std::vector<ProgramPlace> tips;
  tips.reserve(points.size());
  for (const Vector3& point : points)
    tips.push_back(plane_.xyzFromPlane(tipAt(BallCentre(point), tipFromBall)));
  channel_.moveAlong(tips, positioning());
}

PlaneWay HeidenhainProber::tipOffsetAt(double spindleAngle) const {
  if (probe_.tipOffset.isZero(0)) return {};
  const double turn = radiansFromDegrees(spindleAngle - probe_.calibrationAngle);
  const Vector2 turned = Eigen::Rotation2Dd(turn) * probe_.tipOffset;
  // Spindle X and Y lie along the main and minor axis of the working plane that belongs to the tool.
  const Vector3 inSpindle = plane_.xyzFromPlane(Vector3(turned.x(), turned.y(), 0));
  return plane_.planeFromXyz(ProgramWay(channel_.spindleFromProgram().inverse() * inSpindle));
}

PlaneWay HeidenhainProber::tipOffsetNow() const { return tipOffsetAt(channel_.machine().spindle().angle); }

std::optional<double> HeidenhainProber::orientationFor(const PlaneWay& direction) const {
  const Vector3 inSpindle =
      plane_.planeFromXyz(channel_.spindleFromProgram() * plane_.xyzFromPlane(direction).vector());
  if (!probe_.track || std::hypot(inSpindle.x(), inSpindle.y()) <= 1e-9) return std::nullopt;
  // The side that lies along the main axis at the calibration angle leads; a ball that stands aside leads itself.
  const double leading = probe_.aside ? std::atan2(probe_.tipOffset.y(), probe_.tipOffset.x()) : 0;
  return probe_.calibrationAngle + degreesFromRadians(std::atan2(inSpindle.y(), inSpindle.x()) - leading);
}

double HeidenhainProber::directionalRadius(const ProgramWay& direction) const {
  if (probe_.directions.rings().empty()) return 0;
  const Vector3 inSpindle = plane_.planeFromXyz(channel_.spindleFromProgram() * direction.vector());
  const double turn = channel_.machine().spindle().angle - probe_.calibrationAngle;
  return probe_.directions.at(rotation(Vector3::UnitZ(), -turn).linear() * inSpindle);
}

EvaluatedTouch HeidenhainProber::touch(const PlannedTouch& planned) {
  return stroke(planned.direction, inProgram(probe_.distance, planned.direction), planned.surface);
}

EvaluatedTouch HeidenhainProber::stroke(const PlaneWay& direction, double distance,
                                        const std::optional<PartPoint>& expected) {
  const ProgramPlace startTip = channel_.position();
  const ProgramWay xyzDirection = plane_.xyzFromPlane(direction);
  if (const std::optional<double> angle = orientationFor(direction)) channel_.orientSpindle(*angle);
  const BallCentre start = position();
  control::TouchRecord record;
  record.target = plane_.xyzFromPlane(expected.value_or(partAt(start, direction * distance))).vector();
  record.direction = xyzDirection.vector();

  const double directional = inProgram(directionalRadius(xyzDirection), direction);
  const double radius = ballRadius(direction);
  const PlaneWay above = plane_.planeFromXyz(alongTool(channel_, probe_.ballRadius));
  std::vector<BallCentre> centres;
  EvaluatedTouch touch;
  const auto finish = [&](std::string outcome) {
    record.seconds = channel_.seconds();
    record.outcome = std::move(outcome);
    touch.record = channel_.journal().touch(record);
  };
  for (int i = 0; i < std::max(1, probe_.repetitions); ++i) {
    const machine::MeasureResult result = channel_.measureTo(startTip + xyzDirection * distance,
                                                             Feed::at(probe_.probingFeed), machine::Sensor::TouchProbe);
    switch (result.end) {
      case MeasureEnd::Touched:
        break;
      case MeasureEnd::NoContact:
        finish("no contact");
        throw Alarm("Touch point inaccessible",
                    fmt::format("The stylus was not deflected within {:.3f} mm; the {}",
                                distance * (channel_.spindleFromProgram() * xyzDirection.vector()).norm(),
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
    centres.push_back(ballAt(plane_.planeFromXyz(latched.tip), above) + tipOffsetNow());
    const BallCentre centre = centres.back() + direction * directional;
    record.ballCentre = plane_.xyzFromPlane(centre).vector();
    record.surface = plane_.xyzFromPlane(partAt(centre, direction * radius)).vector();
    record.latched = latched.latched;
    record.spindle = spindlePlace(channel_, latched.latched).vector();
    finish("touched");
    channel_.retractTo(startTip, Feed::rapidTraverse());
  }
  Vector3 mean = Vector3::Zero();
  for (const BallCentre& centre : centres)
    mean += centre.vector() / static_cast<double>(centres.size());
  for (const BallCentre& centre : centres) {
    const ProgramWay fromMean = plane_.xyzFromPlane(centre - BallCentre(mean));
    const double apart = (channel_.spindleFromProgram() * fromMean.vector()).norm();
    if (centres.size() > 1 && probe_.confidence > 0 && apart > probe_.confidence) {
      throw Alarm("Value beyond tolerance",
                  fmt::format("Repeated measurements of one point differ by more than {:.4f} mm", probe_.confidence),
                  "clean the part, check the probe and MP6171");
    }
  }
  touch.ballCentre = BallCentre(mean) + direction * directional;
  touch.surface = partAt(touch.ballCentre, direction * radius);
  touch.ballRadius = radius;
  return touch;
}

}  // namespace probewright::probing

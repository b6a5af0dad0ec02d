#include "probing/sinumerik_prober.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "probing/arc.hpp"
#include "probing/sinumerik_rapid.hpp"
#include "probing/sinumerik_stroke.hpp"

namespace probewright::probing {

using control::Alarm;
using machine::Feed;

namespace {

/// The axis that `direction` is parallel to, if any.
std::optional<int> parallelAxis(const PlaneWay& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(std::abs(direction[axis]) - 1) < 1e-12) return axis;
  }
  return std::nullopt;
}

}  // namespace

Vector3 directionFromSpindle(const control::Channel& channel, const control::WorkingPlane& plane,
                             const PlaneWay& direction) {
  const machine::MachineDescription& description = channel.description();
  const machine::AxisPositions here = channel.axes();
  Vector3 seen = channel.machineFromProgram(plane.xyzFromPlane(direction)).vector();
  if (channel.following() == control::Following::Kinematics) {
    seen = machine::baseFromTable(description, here).linear() *
           machine::baseFromTable(description, channel.reference()).linear().transpose() * seen;
  }
  return (machine::baseFromSpindle(description, here).linear().transpose() * seen).normalized();
}

double angleFromSpindle(const control::Channel& channel, const control::WorkingPlane& plane,
                        const PlaneWay& direction) {
  const Vector3 seen = plane.planeFromXyz(directionFromSpindle(channel, plane, direction));
  return degreesFromRadians(std::atan2(seen.y(), seen.x()));
}

PlanePlace SinumerikProber::position() const { return plane_.planeFromXyz(channel_.position()); }

void SinumerikProber::moveTo(const PlanePlace& tcp) {
  const bool infeedOnly = (tcp - position()).inPlane().norm() < 1e-9;
  Feed feed = Feed::at(infeedOnly ? habits_.infeedFeed : habits_.planeFeed);
  if (!habits_.monitorCollisions) feed = rapidTo(tcp);
  channel_.moveTo(plane_.xyzFromPlane(tcp), feed);
}

Feed SinumerikProber::rapidTo(const PlanePlace& tcp) const {
  return reducedRapid(channel_, plane_.xyzFromPlane(tcp), habits_.rapidPercent);
}

void SinumerikProber::moveInPlane(const PlanePlace& tcp) {
  PlanePlace target = tcp;
  target[2] = position()[2];
  moveTo(target);
}

void SinumerikProber::moveHeightTo(double height) {
  PlanePlace target = position();
  target[2] = height;
  moveTo(target);
}

void SinumerikProber::moveOnArc(const PartPoint& centre, double angle) {
  std::vector<ProgramPlace> tips;
  for (const Vector3& point : pointsOnArc(position().vector(), centre.vector(), angle))
    tips.push_back(plane_.xyzFromPlane(PlanePlace(point)));
  channel_.moveAlong(tips, Feed::at(habits_.circleFeed));
}

bool SinumerikProber::mirrored(int axis) const {
  const Matrix3 linear = channel_.frame().linear();
  const Vector3 along = plane_.xyzFromPlane(PlaneWay::unit(axis)).vector();
  return linear.determinant() < 0 && along.dot(linear * along) < 0;
}

Vector2 SinumerikProber::deviation() const {
  Vector2 deviation = probe_.positionDeviation;
  for (int axis = 0; axis < 2; ++axis)
    if (mirrored(axis)) deviation[axis] = -deviation[axis];
  return deviation;
}

double SinumerikProber::trigger(const PlaneWay& direction) const {
  if (const auto axis = parallelAxis(direction)) {
    const auto index = static_cast<std::size_t>(*axis);
    return (direction[*axis] > 0) != mirrored(*axis) ? probe_.triggerPlus[index] : -probe_.triggerMinus[index];
  }
  return ballRadius() + deviation().dot(direction.inPlane());
}

PlaneWay SinumerikProber::lateralDeviation(const PlaneWay& direction) const {
  if (probe_.monodirectional) return {};
  const PlaneWay deviation(this->deviation().x(), this->deviation().y(), 0);
  return deviation - direction * direction.dot(deviation);
}

PlaneWay SinumerikProber::toolAxis() const { return plane_.planeFromXyz(channel_.toolAxis()).normalized(); }

PlaneWay SinumerikProber::uprightTcp(const PlaneWay& direction) const {
  if (probe_.lengthToCentre) return {};
  const PlaneWay axis = toolAxis();
  PlaneWay offset = ballRadius() * (axis - std::copysign(1.0, axis.z()) * PlaneWay::unit(2));
  if (direction.z() == 0) offset[2] = 0;
  return offset;
}

void SinumerikProber::orientTo(const PlaneWay& direction) {
  if (probe_.monodirectional) alignTo(direction);
}

void SinumerikProber::alignTo(const PlaneWay& direction) {
  if (direction.inPlane().norm() < 1e-9) return;
  channel_.orientSpindle(probe_.correctionAngle + angleFromSpindle(channel_, plane_, direction));
  if (habits_.spindlePositioned) habits_.spindlePositioned();
}

MeasuredPoint SinumerikProber::measure(const PartPoint& setpoint, const PlaneWay& direction, double path, int count) {
  const auto axis = parallelAxis(direction);
  // A length that ends at the south pole makes the trigger point in front of the tool 0.
  const bool mayBeZero = axis == 2 && direction.z() < 0 && !probe_.lengthToCentre;
  if (probe_.calibrationWatched && axis && !mayBeZero && trigger(direction) == 0) {
    constexpr std::array ordinals = {"1st", "2nd", "3rd"};
    throw Alarm("61341",
                fmt::format("The probe is not calibrated in the active plane: no trigger point for the {} direction of "
                            "the {} axis",
                            direction[*axis] > 0 ? "plus" : "minus", ordinals[static_cast<std::size_t>(*axis)]),
                "calibrate with CYCLE976 or CYCLE973");
  }
  return stroke(setpoint, direction, path, count, direction * trigger(direction) + lateralDeviation(direction),
                probe_.feed);
}

MeasuredPoint SinumerikProber::measureUncompensated(const PartPoint& setpoint, const PlaneWay& direction, double path,
                                                    int count, double assumedTrigger, double feed,
                                                    control::TouchWith part) {
  return stroke(setpoint, direction, path, count, direction * assumedTrigger, feed, part);
}

MeasuredPoint SinumerikProber::stroke(const PartPoint& setpoint, const PlaneWay& direction, double path, int count,
                                      const PlaneWay& surfaceFromTcp, double feed, control::TouchWith part) {
  if (!(path > 0)) {
    throw Alarm("61308", "Measuring path DFA must be greater than 0", "correct parameter S_FA");
  }
  const PlaneWay upright = uprightTcp(direction);
  const PlanePlace start = tipAt(setpoint, -(direction * path)) - surfaceFromTcp - upright;
  const PlanePlace end = start + direction * 2 * path;
  orientTo(direction);
  moveTo(start);

  control::TouchRecord record;
  record.direction = plane_.xyzFromPlane(direction).vector();
  MeasuredPoint point;
  const auto finish = [&](std::string outcome) {
    record.seconds = channel_.seconds();
    record.outcome = std::move(outcome);
    point.record = channel_.journal().touch(record);
  };
  const Feed retract = habits_.rapidRetract ? rapidTo(end) : Feed::at(habits_.planeFeed);
  const auto probeOnce = [&](double atFeed) {
    return carryOut(channel_,
                    {.start = plane_.xyzFromPlane(start),
                     .end = plane_.xyzFromPlane(end),
                     .feed = atFeed,
                     .retract = retract,
                     .part = part,
                     .attempts = habits_.oneAttempt ? 1 : 5},
                    finish);
  };

  // Walls are touched at the height of the ball's centre, which lies above the tip where the length ends at the south
  // pole; against the tool the trigger point counts from there. The ball of an L or a star lies on an arm.
  const bool raised = direction.z() == 0 && !probe_.lengthToCentre;
  const PlaneWay height(0, 0, raised ? ballRadius() * toolAxis().z() : 0);
  const double radius = probe_.starBallRadius > 0 ? probe_.starBallRadius
                        : ballRadius() > 0        ? ballRadius()
                                                  : surfaceFromTcp.dot(direction);
  record.target = plane_.xyzFromPlane(setpoint + height).vector();
  const auto noteTouch = [&](const control::Touch& touch) {
    const PartPoint surface = partAt(plane_.planeFromXyz(touch.tip) + upright + height, surfaceFromTcp);
    record.ballCentre = plane_.xyzFromPlane(ballAt(surface, -(direction * radius))).vector();
    record.surface = plane_.xyzFromPlane(surface).vector();
    record.latched = touch.latched;
    finish("touched");
  };
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < std::max(1, count); ++i) {
    if (habits_.fastApproach && path > 1) {
      // A first quick touch, back off, then the one that counts.
      const auto quick = probeOnce(habits_.fastFeed);
      if (quick) {
        noteTouch(quick->touch);
        const PlanePlace back = plane_.planeFromXyz(quick->touch.tip) - direction * std::min(2.0, path);
        channel_.retractTo(plane_.xyzFromPlane(back), retract);
      }
    }
    const auto touch = probeOnce(feed);
    if (!touch) refuseUntouched(channel_, path);
    noteTouch(touch->touch);
    sum += plane_.planeFromXyz(touch->touch.tip).vector();
    point.latched = touch->touch.latched;
    channel_.retractTo(plane_.xyzFromPlane(start), retract);
  }
  point.tcp = PlanePlace(sum / std::max(1, count)) + upright;
  point.surface = partAt(point.tcp, surfaceFromTcp);
  return point;
}

}  // namespace probewright::probing

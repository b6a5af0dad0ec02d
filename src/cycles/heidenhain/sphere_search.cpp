#include "cycles/heidenhain/sphere_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "control/scoped.hpp"
#include "cycles/fit_records.hpp"
#include "metrology/fits.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::Following;
using control::Scoped;

namespace {

/// Indexing moves are far from anything; straight pieces this far from their curve are good enough.
constexpr double indexingTolerance = 0.05;

probing::HeidenhainProber proberOf(Context& context) {
  probing::HeidenhainProbe probe = activeProbe(context.control());
  orientToCalibration(context.channel(), probe);
  probe.positioningFeed = std::min(probe.positioningFeed, context.q(253));
  probe.prepositionAtMachineRapid = false;
  return {context.channel(), context.control().coordinates.plane, probe};
}

}  // namespace

SphereSearch::SphereSearch(Context& context, const PartInMachine& centre)
    : context_(context),
      channel_(context.channel()),
      prober_(proberOf(context)),
      centre_(centre),
      radius_(context.q(407)),
      clearance_(prober_.probe().setUp + context.q(320)),
      retraction_(context.q(408)),
      rotaryFeed_(machine::Feed::at(context.q(253))) {
  lookAlongTool();
}

SphereSearch::~SphereSearch() { context_.control().applyCoordinates(); }

Matrix3 SphereSearch::spindleAxes() const {
  const machine::AxisPositions now = channel_.axes();
  const machine::MachineDescription& machine = channel_.description();
  return machine::baseFromTable(machine, context_.control().coordinates.preset.rotaryOffset).linear() *
         machine::baseFromTable(machine, now).linear().transpose() * machine::baseFromSpindle(machine, now).linear();
}

Matrix3 SphereSearch::tilt() const {
  const Matrix3 preset = context_.control().coordinates.machineFromPreset().linear();
  return preset.transpose() * spindleAxes() * preset;
}

void SphereSearch::lookAlongTool() {
  const auto& coordinates = context_.control().coordinates;
  const control::WorkingPlane& plane = coordinates.plane;
  const Vector3 mainAxis = coordinates.machineFromPreset().linear().col(plane.main);
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.linear() = spindleAxes() * Eigen::AngleAxisd(std::atan2(mainAxis[plane.minor], mainAxis[plane.main]),
                                                     Vector3::Unit(plane.tool));
  frame.translation() = centre_.vector();
  channel_.setFollowing(Following::Kinematics, coordinates.preset.rotaryOffset);
  channel_.setFrame(frame);
}

Vector3 SphereSearch::alongTool() const { return Vector3::Unit(context_.control().coordinates.plane.tool); }

/// Height of the ball's centre with the ball at the set-up clearance over the pole.
double SphereSearch::aboveSphere() const { return radius_ + prober_.probe().ballRadius + clearance_; }

void SphereSearch::moveOver() {
  lookAlongTool();
  const BallCentre above(0, 0, aboveSphere());
  if (prober_.position().z() < above.z()) prober_.moveHeightTo(above.z());
  prober_.moveInPlane(above);
  prober_.moveHeightTo(above.z());
}

void SphereSearch::retract() {
  // Parallel to the machine's axes as the table stands: the untilted system.
  const auto& coordinates = context_.control().coordinates;
  channel_.setFollowing(Following::Kinematics, channel_.axes());
  channel_.setFrame(coordinates.machineFromPreset());
  ProgramPlace tip = channel_.position();
  tip[coordinates.plane.tool] = retraction_;
  channel_.moveTo(tip, rotaryFeed_);
  channel_.moveTo(coordinates.plane.xyzFromPlane(PlanePlace(0, 0, retraction_)), rotaryFeed_);
}

void SphereSearch::carryOut(const machine::AxisPositions& target, const std::vector<std::size_t>& axes) {
  auto& control = context_.control();
  const int function = control.parameters.strobeRotaryAxes;
  if (function >= 0) {
    for (const std::size_t axis : axes) {
      const std::string& name = channel_.description().axes[axis].name;
      if (name.size() == 1 && name[0] >= 'A' && name[0] <= 'C') control.q.setQ(120 + name[0] - 'A', target[axis]);
    }
    if (!channel_.function(function)) {
      throw Alarm("M function missing",
                  fmt::format("The machine has no M{}, which is to position the rotary axes", function),
                  "set mStrobeRotAxPos (iTNC 530: MP6602) to an M function of the machine, or to -1");
    }
  }
  if (retraction_ > 0) {
    channel_.moveAxes(target, rotaryFeed_);
    return;
  }
  // The tool turns about the sphere, at which it points.
  control::Target turned;
  for (const std::size_t axis : axes)
    turned.rotary[axis] = target[axis] - channel_.rotaryOffset[axis];
  lookAlongTool();
  const double height = prober_.position().z() - prober_.probe().ballRadius;
  const Scoped reach(channel_.toolVector, Vector3(channel_.toolVector + height * alongTool()));
  const Scoped held(channel_.holdTip, true);
  const Scoped coarse(channel_.pathTolerance, indexingTolerance);
  channel_.moveTo(turned, rotaryFeed_);
}

void SphereSearch::turnTo(const machine::AxisPositions& angles, const std::vector<std::size_t>& axes, Order order) {
  machine::AxisPositions target = channel_.axes();
  std::vector<std::size_t> turning;
  for (const std::size_t axis : axes) {
    const double degrees = angles[axis] + channel_.rotaryOffset[axis];
    if (std::abs(degrees - target[axis]) < 1e-9) continue;
    turning.push_back(axis);
  }
  if (turning.empty()) return;
  if (retraction_ > 0) retract();
  target = channel_.axes();
  const bool apart = order == Order::OneByOne && retraction_ == 0;
  std::vector<std::size_t> now;
  for (const std::size_t axis : turning) {
    now.push_back(axis);
    target[axis] = angles[axis] + channel_.rotaryOffset[axis];
    if (!apart && axis != turning.back()) continue;
    carryOut(target, now);
    target = channel_.axes();
    now.clear();
  }
  moveOver();
}

FoundSphere SphereSearch::measure(RadiusCheck check) {
  lookAlongTool();
  std::vector<Vector3> centres;
  std::vector<std::size_t> records;
  const auto keep = [&](const EvaluatedTouch& touch) {
    centres.push_back(touch.ballCentre.vector());
    records.push_back(touch.record);
  };
  const double over = aboveSphere(), ball = prober_.probe().ballRadius;
  const PlannedTouch pole{PartPoint(0, 0, radius_), -PlaneWay::unit(2)};
  prober_.moveTo(prober_.prePosition(pole, context_.q(320)));
  keep(prober_.touch(pole));
  const double equator = centres.front().z() - radius_ - ball;
  const int count = context_.option(423);
  for (int i = 0; i < count; ++i) {
    const PlaneWay outwards = probing::directionAt(context_.q(380) + i * 360.0 / count);
    const PlannedTouch touch{PartPoint(0, 0, equator) + radius_ * outwards, -outwards};
    const BallCentre start = prober_.prePosition(touch, context_.q(320));
    prober_.moveInPlane(start);
    prober_.moveTo(start);
    keep(prober_.touch(touch));
    prober_.moveHeightTo(over);
  }
  prober_.moveInPlane({0, 0, over});
  const auto fit = metrology::fitSphere(centres, withCofactors);
  if (!fit) throw Alarm("Calibration sphere not measured", fit.error().message, fit.error().advice);
  context_.channel().journal().fit(recordOf(*fit, std::move(records)));
  const double radius = fit->shape.radius - ball;
  const double permitted = context_.control().parameters.maxDevCalBall;
  const bool wrong = std::abs(radius - radius_) > permitted;
  if (wrong && check == RadiusCheck::AtSecond) return measure(RadiusCheck::Yes);
  if (wrong && check == RadiusCheck::Yes) {
    throw Alarm("Calibration sphere radius wrong",
                fmt::format("The sphere was measured with the radius {:.4f} mm, Q407 says {}; {} permits {} mm", radius,
                            formatShortest(radius_), context_.control().isTNC640() ? "maxDevCalBall" : "MP6601",
                            formatShortest(permitted)),
                "check Q407, clean the sphere, and calibrate the touch probe");
  }
  const control::WorkingPlane& plane = context_.control().coordinates.plane;
  const BallCentre centre(fit->shape.centre);
  const ProgramPlace tip = plane.xyzFromPlane(tipAt(centre, PlaneWay(0, 0, -ball)));
  FoundSphere found;
  found.sighting = {channel_.axesFromProgram(tip, channel_.axes()), Vector3(ball * alongTool() - channel_.toolVector)};
  found.centre = channel_.machineFromProgram(plane.xyzFromPlane(partAt(centre)));
  found.radius = radius;
  return found;
}

PartInMachine SphereSearch::seen(const kinematics::SphereSighting& sighting) const {
  const machine::MachineDescription& machine = channel_.description();
  Vector3 ball = machine::baseFromSpindle(machine, sighting.axes) * sighting.ball;
  if (channel_.tipDeviation) ball += channel_.tipDeviation(sighting.axes);
  return PartInMachine(machine::baseFromTable(machine, context_.control().coordinates.preset.rotaryOffset) *
                       (machine::baseFromTable(machine, sighting.axes).inverse() * ball));
}

PartInMachine presetIntoSphere(Context& context) {
  SphereSearch search(context, {});
  // The ball stands over the pole at the set-up clearance, more or less.
  const probing::HeidenhainProbe probe = activeProbe(context.control());
  const double above = context.q(407) + probe.ballRadius + probe.setUp + context.q(320);
  probing::HeidenhainProber prober(context.channel(), context.control().coordinates.plane, probe);
  const BallCentre begin = prober.position() - PlaneWay(0, 0, above);
  const control::WorkingPlane& plane = context.control().coordinates.plane;
  search.expectAt(context.channel().machineFromProgram(plane.xyzFromPlane(partAt(begin))));
  for (const RadiusCheck check : {RadiusCheck::No, RadiusCheck::Yes})
    search.expectAt(search.measure(check).centre);
  setSpherePreset(context, search.expected());
  return search.expected();
}

void setSpherePreset(Context& context, const PartInMachine& centre) {
  auto& control = context.control();
  control::heidenhain::Control::PresetChange change;
  for (std::size_t i = 0; i < 3; ++i)
    change.origin[i] = centre[static_cast<Eigen::Index>(i)];
  control.writePreset(control.coordinates.preset.row, change);
}

}  // namespace probewright::cycles::heidenhain

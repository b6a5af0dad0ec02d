#include "simulation/virtual_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace probewright::simulation {

using machine::AxisKind;
using machine::AxisPositions;
using machine::Feed;
using machine::MeasureEnd;
using machine::MeasureResult;
using machine::MoveEnd;
using machine::MoveResult;

namespace {

constexpr double measuringPrecision = 1e-7;    // mm
constexpr double positioningPrecision = 1e-4;  // mm
constexpr double mostOvertravel = 0.8;         // ball radii
constexpr double orientationSeconds = 1;
constexpr const char* cancelledText = "the run was cancelled";

constexpr const char* roleName(SolidRole role) {
  switch (role) {
    case SolidRole::Part:
      return "the part";
    case SolidRole::Fixture:
      return "the fixture";
    case SolidRole::Ring:
      return "the ring";
    case SolidRole::Sphere:
      return "the calibration sphere";
    case SolidRole::GaugeBlock:
      return "the gauge block";
    case SolidRole::ToolProbe:
      return "the tool touch probe";
  }
  return "";
}

std::string missingTool(const machine::ToolOrder& order) {
  return order.name.empty() ? fmt::format("the magazine of this machine holds no tool {}", order.number)
                            : fmt::format("the magazine of this machine holds no tool \"{}\"", order.name);
}

}  // namespace

std::uint64_t streamSeed(std::uint64_t seed, std::string_view name) {
  // FNV-1a over the name, started from the seed.
  std::uint64_t hash = 14695981039346656037ull ^ (seed * 0x9e3779b97f4a7c15ull);
  for (const char c : name)
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hash;
}

VirtualMachine::VirtualMachine(Truth truth)
    : truth_(std::move(truth)),
      kinematics_(truth_.machine, truth_.errors),
      surroundings_(truth_.solids),
      reading_(truth_.start),
      slides_(truth_.start),
      noise_(streamSeed(truth_.seed, "probe")),
      path_(pathPoint(tableFromSpindle(), PathKind::Start, 0)) {}

Pose VirtualMachine::tableFromSpindle() const { return kinematics_.tableFromSpindle(slides_, clock_); }

Vector3 VirtualMachine::tipOnTable() const { return tableFromSpindle() * shape_.tip; }

PathPoint VirtualMachine::pathPoint(const Pose& tableFromSpindle, PathKind kind, double seconds) const {
  return {tableFromSpindle * shape_.tip, tableFromSpindle.linear() * shape_.shank, kind, seconds};
}

namespace {

/// A position in a message; one of hundreds of digits says no more than its size.
std::string readable(double position) {
  return std::abs(position) < 1e9 ? fmt::format("{:.4f}", position) : fmt::format("{:.3g}", position);
}

}  // namespace

std::optional<std::string> VirtualMachine::beyondTravel(const AxisPositions& target) const {
  for (std::size_t i = 0; i < truth_.machine.axes.size(); ++i) {
    const machine::Axis& axis = truth_.machine.axes[i];
    const char* unit = axis.kind == AxisKind::Linear ? "mm" : "degrees";
    if (!std::isfinite(target[i])) return fmt::format("the target position of axis {} is not a number", axis.name);
    if (axis.kind == AxisKind::Rotary && axis.modulo) continue;
    if (target[i] < axis.minimum) {
      return fmt::format("axis {} would go to {} {}; its travel begins at {:.4f}", axis.name, readable(target[i]), unit,
                         axis.minimum);
    }
    if (target[i] > axis.maximum) {
      return fmt::format("axis {} would go to {} {}; its travel ends at {:.4f}", axis.name, readable(target[i]), unit,
                         axis.maximum);
    }
  }
  return std::nullopt;
}

Motion VirtualMachine::motionTo(const AxisPositions& target, Feed feed) const {
  const auto& axes = truth_.machine.axes;
  double linear = 0, rotary = 0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double travel = target[i] - reading_[i];
    (axes[i].kind == AxisKind::Linear ? linear : rotary) += travel * travel;
  }
  const double length = std::sqrt(linear > 0 ? linear : rotary);
  Motion motion{kinematics_, reading_, target, slides_, clock_, MotionProfile(0, 1, 1)};
  if (length == 0) return motion;
  double speed = feed.rapid ? 1e300 : feed.perMinute / 60;
  double acceleration = 1e300;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double share = std::abs(target[i] - reading_[i]) / length;
    if (share == 0) continue;
    speed = std::min(speed, axes[i].rapid / 60 / share);
    acceleration = std::min(acceleration, axes[i].acceleration / share);
  }
  motion.profile = MotionProfile(length, speed, acceleration);
  return motion;
}

std::string VirtualMachine::describe(const Touch& touch) const {
  const PlacedSolid& solid = truth_.solids[touch.solid];
  const char* part = touch.shaft ? shape_.shafts[*touch.shaft].part : "stylus tip";
  const std::string tool = tool_->name.empty() ? fmt::format("tool {}", tool_->number)
                                               : fmt::format("tool {} \"{}\"", tool_->number, tool_->name);
  const std::string what = part == std::string_view("tool") ? tool : fmt::format("the {} of {}", part, tool);
  return fmt::format("{} touched {} \"{}\" at X{:+.3f} Y{:+.3f} Z{:+.3f} on the table", what, roleName(solid.role),
                     solid.name, touch.point.x(), touch.point.y(), touch.point.z());
}

double VirtualMachine::pretravel(const Motion& motion, const Touch& touch) const {
  const TrueProbe& probe = tool_->probe;
  const Matrix3 spindleFromTable = motion.tableFromSpindleAt(touch.fraction).linear().transpose();
  const Vector3 normal = rotation(Vector3::UnitZ(), -spindleDegrees_).linear() *
                         (toolFrame(*tool_).transpose() * (spindleFromTable * touch.normal));
  const double axial = std::pow(normal.z(), 2);
  const double lobed =
      probe.lobing == 0
          ? 0
          : probe.lobing * std::cos(3 * (std::atan2(normal.y(), normal.x()) - radiansFromDegrees(probe.lobingPhase)));
  return (1 - axial) * (probe.pretravel + lobed) + axial * probe.axialPretravel;
}

VirtualMachine::Stop VirtualMachine::stopFor(const Motion& motion, const Touch& touch) {
  if (touch.shaft) return {touch, std::nullopt, touch.fraction};
  return signalStop(motion, touch);
}

VirtualMachine::Stop VirtualMachine::signalStop(const Motion& motion, const Touch& touch) {
  Stop stop{touch, std::nullopt, touch.fraction};
  const double length = motion.profile.length();
  if (length == 0) return stop;
  const TrueProbe& probe = tool_->probe;
  const double contact = touch.fraction * length;
  double signal = contact + pretravel(motion, touch) + motion.profile.speedAt(contact) * probe.signalDelay;
  if (probe.repeatability > 0) signal += probe.repeatability * gaussian_(noise_);
  const double braking = motion.profile.brakingDistanceAt(std::clamp(signal, 0.0, length));
  const double end = std::clamp(signal + braking, contact, contact + mostOvertravel * probe.ballRadius);
  stop.signal = signal / length;
  stop.end = std::min(end / length, 1.0);
  return stop;
}

void VirtualMachine::advance(const Motion& motion, const Stop& stop, PathKind kind) {
  reading_ = motion.readingAt(stop.end);
  slides_ = motion.slidesAt(stop.end);
  // Stopping early takes the time of braking from the speed reached.
  const double travelled = stop.end * motion.profile.length();
  double duration = stop.end == 1 ? motion.profile.duration() : motion.profile.secondsAt(travelled);
  double pace = 1;  // of the clock
  if (kind != PathKind::Feed || stop.end != 1 || stop.touch || duration == 0) {
    continuous_.stop();
  } else {
    AxisPositions way;
    for (std::size_t i = 0; i < truth_.machine.axes.size(); ++i)
      way[i] = reading_[i] - motion.from[i];
    const double added = continuous_.join(way, motion.profile);
    pace = added / duration;
    duration = added;
  }
  clock_ = motion.startSeconds + duration;
  if (!recording_ || (motion.profile.length() == 0 && !stop.touch)) return;
  constexpr double turnPerPoint = 2;  // degrees
  double turn = 0;
  for (std::size_t i = 0; i < truth_.machine.axes.size(); ++i) {
    if (truth_.machine.axes[i].kind == AxisKind::Rotary) turn = std::max(turn, std::abs(reading_[i] - motion.from[i]));
  }
  const int pieces = std::clamp(static_cast<int>(std::ceil(turn / turnPerPoint)), 1, 360);
  for (int i = 1; i <= pieces; ++i) {
    const double fraction = stop.end * i / pieces;
    const double seconds = motion.startSeconds + pace * motion.profile.secondsAt(fraction * motion.profile.length());
    path_.add(pathPoint(motion.tableFromSpindleAt(fraction), kind, i == pieces ? clock_ : seconds));
  }
  if (!stop.touch) return;
  PathTouch touch;
  touch.kind = kind;
  touch.solid = truth_.solids[stop.touch->solid].name;
  touch.part = stop.touch->shaft ? shape_.shafts[*stop.touch->shaft].part : "ball";
  touch.point = stop.touch->point;
  touch.normal = stop.touch->normal;
  touch.ballCentre = stop.touch->ballCentre;
  if (stop.signal) touch.latched = motion.readingAt(*stop.signal);
  touch.seconds = clock_;
  path_.add(std::move(touch));
}

MoveResult VirtualMachine::finish(const Motion& motion, std::optional<Touch> touch, PathKind kind) {
  if (!touch) {
    advance(motion, Stop{}, kind);
    return {};
  }
  const Stop stop = stopFor(motion, *touch);
  advance(motion, stop, kind);
  if (touch->shaft) return {MoveEnd::Collision, describe(*touch)};
  deflection_ = touch;
  return {MoveEnd::ProbeSignal, describe(*touch)};
}

MoveResult VirtualMachine::move(const AxisPositions& target, Feed feed) {
  if (cancelled_) return {MoveEnd::Cancelled, cancelledText};
  if (!feed.rapid && !(feed.perMinute > 0)) return {MoveEnd::Cancelled, "the feed is not above 0"};
  if (auto limit = beyondTravel(target)) return {MoveEnd::AxisLimit, *limit};
  const std::optional<Touch>& deflection = deflection_ ? deflection_ : toolContact_;
  if (deflection && !(target == reading_))
    return {MoveEnd::ProbeSignal, "the stylus is still deflected: " + describe(*deflection)};
  const Motion motion = motionTo(target, feed);
  return finish(motion, firstTouch(motion, 0, 1, shape_, surroundings_, {positioningPrecision}),
                feed.rapid ? PathKind::Rapid : PathKind::Feed);
}

MeasureResult VirtualMachine::measure(const AxisPositions& target, Feed feed) { return measure(target, feed, false); }

MeasureResult VirtualMachine::measureWithShaft(const AxisPositions& target, Feed feed) {
  return measure(target, feed, true);
}

/// Where along the shaft it touches first, and when, as exactly as a ball there would: the search for shafts is
/// made for collisions. Near the place found the way to contact is a parabola over the shaft.
Touch VirtualMachine::preciseShaftTouch(const Motion& motion, const Touch& rough) const {
  const Shaft& shaft = shape_.shafts[*rough.shaft];
  const double length = shaft.axis.norm();
  const Vector3 along = shaft.axis / length;
  ToolShape bead;
  const auto touchAt = [&](double place) {
    bead.balls = {Ball{shaft.start + along * place, shaft.radius}};
    return firstTouch(motion, 0, 1, bead, surroundings_, {measuringPrecision});
  };
  const Vector3 inSpindle = motion.tableFromSpindleAt(rough.fraction).inverse() * rough.point;
  constexpr double apart = 0.25;  // mm
  double place = std::clamp((inSpindle - shaft.start).dot(along), 0.0, length);
  for (int i = 0; i < 2; ++i) {
    const auto below = touchAt(place - apart), here = touchAt(place), above = touchAt(place + apart);
    if (!below || !here || !above) break;
    const double bend = below->fraction - 2 * here->fraction + above->fraction;
    if (bend * motion.profile.length() < 1e-7) break;
    place = std::clamp(place + apart * std::clamp(0.5 * (below->fraction - above->fraction) / bend, -1.0, 1.0), 0.0,
                       length);
  }
  Touch precise = touchAt(place).value_or(rough);
  precise.shaft = rough.shaft;
  return precise;
}

MeasureResult VirtualMachine::measure(const AxisPositions& target, Feed feed, bool shaftSignals) {
  const auto end = [&](MeasureEnd how, std::string detail) { return MeasureResult{how, reading_, std::move(detail)}; };
  if (cancelled_) return end(MeasureEnd::Cancelled, cancelledText);
  if (tool_ && tool_->kind == ToolKind::Cutter && hasToolProbe()) return measureTool(target, feed);
  if (!tool_ || tool_->kind != ToolKind::Probe)
    return end(MeasureEnd::NotReady, "there is no touch probe in the spindle");
  if (!tool_->probe.switchedOn) return end(MeasureEnd::NotReady, "the touch probe is switched off");
  if (!feed.rapid && !(feed.perMinute > 0)) return end(MeasureEnd::Cancelled, "the feed is not above 0");
  if (deflection_) return end(MeasureEnd::DeflectedAtStart, describe(*deflection_));
  if (auto limit = beyondTravel(target)) return end(MeasureEnd::AxisLimit, *limit);
  const Motion motion = motionTo(target, feed);
  auto touch = firstTouch(motion, 0, 1, shape_, surroundings_, {measuringPrecision});
  if (!touch) {
    advance(motion, Stop{}, PathKind::Measure);
    return end(MeasureEnd::NoContact, "the target was reached without contact");
  }
  const bool byShaft = touch->shaft && std::string_view(shape_.shafts[*touch->shaft].part) == shaftName;
  if (byShaft && shaftSignals) touch = preciseShaftTouch(motion, *touch);
  if (touch->shaft && !(byShaft && shaftSignals)) {
    advance(motion, Stop{touch, std::nullopt, touch->fraction}, PathKind::Measure);
    return end(MeasureEnd::Collision, describe(*touch));
  }
  const Stop stop = signalStop(motion, *touch);
  if (stop.signal && *stop.signal > 1) {
    // The stylus leans against the surface without a signal: the way back must free it as after a touch.
    advance(motion, Stop{}, PathKind::Measure);
    if (!byShaft) deflection_ = touch;
    return end(MeasureEnd::NoContact, "the target was reached before the stylus was deflected enough for a signal");
  }
  advance(motion, stop, PathKind::Measure);
  if (!byShaft) deflection_ = touch;
  return {MeasureEnd::Touched, motion.readingAt(stop.signal.value_or(stop.end)), describe(*touch)};
}

bool VirtualMachine::hasToolProbe() const {
  return std::ranges::any_of(truth_.solids,
                             [](const PlacedSolid& solid) { return solid.role == SolidRole::ToolProbe; });
}

MeasureResult VirtualMachine::measureTool(const AxisPositions& target, Feed feed) {
  const auto end = [&](MeasureEnd how, std::string detail) { return MeasureResult{how, reading_, std::move(detail)}; };
  if (!feed.rapid && !(feed.perMinute > 0)) return end(MeasureEnd::Cancelled, "the feed is not above 0");
  if (toolContact_) return end(MeasureEnd::DeflectedAtStart, describe(*toolContact_));
  if (auto limit = beyondTravel(target)) return end(MeasureEnd::AxisLimit, *limit);
  const Motion motion = motionTo(target, feed);
  const auto touch = firstTouch(motion, 0, 1, shape_, surroundings_, {measuringPrecision});
  if (!touch) {
    advance(motion, Stop{}, PathKind::Measure);
    return end(MeasureEnd::NoContact, "the target was reached without contact");
  }
  if (truth_.solids[touch->solid].role != SolidRole::ToolProbe) {
    advance(motion, Stop{touch, std::nullopt, touch->fraction}, PathKind::Measure);
    return end(MeasureEnd::Collision, describe(*touch));
  }
  const double length = motion.profile.length();
  const double contact = touch->fraction * length;
  const double stop = std::min(contact + motion.profile.brakingDistanceAt(contact), length);
  advance(motion, Stop{touch, touch->fraction, stop / length}, PathKind::Measure);
  toolContact_ = touch;
  return {MeasureEnd::Touched, motion.readingAt(touch->fraction), describe(*touch)};
}

std::optional<double> VirtualMachine::freeFrom(const Motion& motion) const {
  constexpr double clear = 1e-6;        // mm off the surface
  constexpr double firstStep = 0.002;   // mm
  constexpr double longestStep = 0.25;  // mm
  const double length = motion.profile.length();
  const auto overlaps = [&](double fraction) {
    return ballOverlap(motion.tableFromSpindleAt(fraction), shape_, surroundings_).has_value();
  };
  // On a flat surface the ball is free where it has left the plane of contact.
  const auto gap = [&](double fraction) {
    const Vector3 centre = motion.tableFromSpindleAt(fraction) * shape_.balls[deflection_->ball].centre;
    return (centre - deflection_->point).dot(deflection_->normal) - shape_.balls[deflection_->ball].radius;
  };
  const double atStart = gap(0), atEnd = gap(1);
  double fraction = 0;
  if (atEnd > atStart) fraction = std::clamp((clear - atStart) / (atEnd - atStart), 0.0, 1.0);
  double step = firstStep;
  while (overlaps(fraction)) {
    if (fraction >= 1) return std::nullopt;
    fraction = std::min(1.0, fraction + step / length);
    step = std::min(2 * step, longestStep);
  }
  return fraction;
}

MoveResult VirtualMachine::retract(const AxisPositions& target, Feed feed) {
  if (cancelled_) return {MoveEnd::Cancelled, cancelledText};
  if (!feed.rapid && !(feed.perMinute > 0)) return {MoveEnd::Cancelled, "the feed is not above 0"};
  if (auto limit = beyondTravel(target)) return {MoveEnd::AxisLimit, *limit};
  const Motion motion = motionTo(target, feed);
  if (motion.profile.length() == 0) return {};
  SearchOptions options{positioningPrecision};
  // What a collision left touching may be pulled off.
  options.ignoreShafts = toolContact_ || shaftOverlap(tableFromSpindle(), shape_, surroundings_);
  toolContact_.reset();
  double begin = 0;
  if (deflection_) {
    const auto free = freeFrom(motion);
    if (!free || (*free == 1 && ballOverlap(motion.tableFromSpindleAt(1), shape_, surroundings_))) {
      // Pressing on instead of leaving: the stylus gives way as far as it can.
      const auto centre = [&](double f) {
        return Vector3(motion.tableFromSpindleAt(f) * shape_.balls[deflection_->ball].centre);
      };
      const double depth =
          (deflection_->point - centre(1)).dot(deflection_->normal) + shape_.balls[deflection_->ball].radius;
      if (depth > 2 * mostOvertravel * shape_.balls[deflection_->ball].radius) {
        return {MoveEnd::Collision, "the stylus would be deflected too far: " + describe(*deflection_)};
      }
      advance(motion, Stop{}, PathKind::Retract);
      return {};
    }
    deflection_.reset();
    begin = *free;
  }
  return finish(motion, firstTouch(motion, begin, 1, shape_, surroundings_, options), PathKind::Retract);
}

MoveResult VirtualMachine::settle() {
  const Pose pose = tableFromSpindle();
  deflection_ = ballOverlap(pose, shape_, surroundings_);
  if (auto touch = shaftOverlap(pose, shape_, surroundings_)) return {MoveEnd::Collision, describe(*touch)};
  if (deflection_) return {MoveEnd::ProbeSignal, describe(*deflection_)};
  return {};
}

MoveResult VirtualMachine::orientSpindle(double degrees) {
  if (cancelled_) return {MoveEnd::Cancelled, cancelledText};
  if (!truth_.machine.spindleOrients) return {MoveEnd::AxisLimit, "the spindle of this machine cannot be oriented"};
  if (!std::isfinite(degrees)) return {MoveEnd::AxisLimit, "the target angle of the spindle is not a number"};
  continuous_.stop();
  clock_ += orientationSeconds;
  spindleDegrees_ = degrees;
  shape_ = shapeOf(tool_, degrees);
  return settle();
}

std::optional<const TrueTool*> VirtualMachine::findTool(const machine::ToolOrder& order) const {
  const auto found = std::find_if(truth_.tools.begin(), truth_.tools.end(), [&](const TrueTool& tool) {
    return order.name.empty() ? tool.number == order.number : tool.name == order.name;
  });
  if (found != truth_.tools.end()) return &*found;
  if (order.number == 0 && order.name.empty()) return nullptr;
  return std::nullopt;
}

MoveResult VirtualMachine::load(const TrueTool* tool) {
  tool_ = tool;
  shape_ = shapeOf(tool_, spindleDegrees_);
  if (recording_) path_.add(pathPoint(tableFromSpindle(), PathKind::ToolChange, clock_));
  return settle();
}

MoveResult VirtualMachine::insertTool(const machine::ToolOrder& order) {
  const auto tool = findTool(order);
  return tool ? load(*tool) : MoveResult{MoveEnd::Collision, missingTool(order)};
}

MoveResult VirtualMachine::changeTool(const machine::ToolOrder& order) {
  if (cancelled_) return {MoveEnd::Cancelled, cancelledText};
  const auto tool = findTool(order);
  if (!tool) return {MoveEnd::Collision, missingTool(order)};
  if (*tool == tool_) return {};
  if (deflection_) return {MoveEnd::ProbeSignal, "the stylus is still deflected: " + describe(*deflection_)};

  AxisPositions target = reading_;
  const auto& chain = truth_.machine.spindleChain;
  const auto& axes = truth_.machine.axes;
  const auto nearest = std::find_if(chain.rbegin(), chain.rend(), [&](const machine::ChainElement& element) {
    return element.axis && axes[*element.axis].kind == AxisKind::Linear;
  });
  if (nearest != chain.rend()) {
    target[*nearest->axis] = truth_.machine.toolChange[*nearest->axis];
    advance(motionTo(target, Feed::rapidTraverse()), Stop{}, PathKind::ToolChange);
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].kind == AxisKind::Linear) target[i] = truth_.machine.toolChange[i];
  }
  advance(motionTo(target, Feed::rapidTraverse()), Stop{}, PathKind::ToolChange);
  continuous_.stop();
  clock_ += truth_.machine.toolChangeSeconds;
  return load(*tool);
}

void VirtualMachine::dwell(double seconds) {
  continuous_.stop();
  clock_ += std::max(seconds, 0.0);
}

}  // namespace probewright::simulation

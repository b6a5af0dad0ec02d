#include "simulation/virtual_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "geometry/place_text.hpp"
#include "simulation/clear_way.hpp"

namespace probewright::simulation {

using machine::AxisKind;
using machine::AxisPositions;
using machine::Feed;
using machine::MoveEnd;
using machine::MoveResult;
using machine::PathPiece;
using machine::PathResult;

namespace {

constexpr double positioningPrecision = 1e-4;  // mm

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

}  // namespace

std::uint64_t streamSeed(std::uint64_t seed, std::string_view name) {
  // FNV-1a over the name, started from the seed.
  std::uint64_t hash = 14695981039346656037ull ^ (seed * 0x9e3779b97f4a7c15ull);
  for (const char c : name)
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hash;
}

namespace {

bool isToolProbe(const PlacedSolid& solid) { return solid.role == SolidRole::ToolProbe; }
bool isNoToolProbe(const PlacedSolid& solid) { return !isToolProbe(solid); }
bool isAnything(const PlacedSolid&) { return true; }

}  // namespace

VirtualMachine::VirtualMachine(Truth truth)
    : truth_(std::move(truth)),
      kinematics_(truth_.machine, truth_.errors),
      surroundings_(truth_.solids, truth_.machine.mainSpindle ? isNoToolProbe : isAnything),
      withoutToolProbes_(truth_.solids, isNoToolProbe),
      toolProbesOnly_(truth_.solids, isToolProbe),
      reading_(truth_.start),
      slides_(truth_.start),
      noise_(streamSeed(truth_.seed, "probe")),
      path_(pathPoint(tableFromSpindle(), reading_, PathKind::Start, 0)) {
  if (!truth_.bodies.empty()) guard_ = std::make_unique<BodyGuard>(truth_);
  const auto solidOf = [&](const TrueToolProbe& probe) {
    const auto drawn = std::ranges::find_if(
        truth_.solids, [&](const PlacedSolid& solid) { return isToolProbe(solid) && solid.name == probe.name; });
    return static_cast<std::size_t>(drawn - truth_.solids.begin());
  };
  // One without a solid is not there.
  std::erase_if(truth_.toolProbes, [&](const TrueToolProbe& probe) { return solidOf(probe) == truth_.solids.size(); });
  for (const TrueToolProbe& probe : truth_.toolProbes)
    solidOfToolProbe_.push_back(solidOf(probe));
}

Pose VirtualMachine::tableFromSpindle() const { return kinematics_.tableFromSpindle(slides_, clock_); }

Motion VirtualMachine::onBed(const Motion& motion) const {
  Motion seen = motion;
  const std::size_t turns = *truth_.machine.mainSpindle;
  seen.from[turns] = seen.to[turns] = seen.slidesAtStart[turns] = 0;
  return seen;
}

Pose VirtualMachine::bedFromSpindle() const {
  AxisPositions slides = slides_;
  slides[*truth_.machine.mainSpindle] = 0;
  return kinematics_.tableFromSpindle(slides, clock_);
}

std::optional<Touch> VirtualMachine::firstTouchOf(const Motion& motion, double begin,
                                                  const SearchOptions& options) const {
  auto first = firstTouch(motion, begin, 1, shape_, surroundings_, options);
  if (!probesOnBed()) return first;
  auto onProbe = firstTouch(onBed(motion), begin, 1, shape_, toolProbesOnly_, options);
  return onProbe && (!first || onProbe->fraction < first->fraction) ? onProbe : first;
}

std::optional<Touch> VirtualMachine::ballTouchAt(const Motion& motion, double fraction) const {
  auto touch = ballOverlap(motion.tableFromSpindleAt(fraction), shape_, surroundings_);
  if (touch || !probesOnBed()) return touch;
  return ballOverlap(onBed(motion).tableFromSpindleAt(fraction), shape_, toolProbesOnly_);
}

std::optional<Touch> VirtualMachine::shaftTouch() const {
  auto touch = shaftOverlap(tableFromSpindle(), shape_, surroundings_);
  return touch || !probesOnBed() ? touch : shaftOverlap(bedFromSpindle(), shape_, toolProbesOnly_);
}

Vector3 VirtualMachine::tipOnTable() const { return tableFromSpindle() * shape_.tip; }

PathPoint VirtualMachine::pathPoint(const Pose& tableFromSpindle, const AxisPositions& axes, PathKind kind,
                                    double seconds) const {
  const int tool = tool_ != nullptr ? static_cast<int>(tool_ - truth_.tools.data()) : -1;
  return {tableFromSpindle * shape_.tip, tableFromSpindle.linear() * shape_.shank, kind, seconds, tool, axes};
}

namespace {

/// A position in a message; one of hundreds of digits says no more than its size.
std::string readable(double position) {
  return std::abs(position) < 1e9 ? formatFixed(position, 4) : fmt::format("{:.3g}", position);
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

const char* VirtualMachine::partOf(const Touch& touch) const {
  return *touch.shaft < shape_.shafts.size() ? shape_.shafts[*touch.shaft].part : cutterName;
}

std::string VirtualMachine::toolName() const {
  return tool_->name.empty() ? fmt::format("tool {}", tool_->number)
                             : fmt::format("tool {} \"{}\"", tool_->number, tool_->name);
}

std::string VirtualMachine::describe(const Touch& touch) const {
  if (!tellsTouches_) return touch.shaft ? ranIntoSomething : "the stylus has touched something";
  const PlacedSolid& solid = truth_.solids[touch.solid];
  const char* part = touch.shaft ? partOf(touch) : "stylus tip";
  const std::string tool = toolName();
  const std::string what = part == std::string_view("tool") ? tool : fmt::format("the {} of {}", part, tool);
  return fmt::format("{} touched {} \"{}\" at {} on the table", what, roleName(solid.role), solid.name,
                     placeText(touch.point));
}

void VirtualMachine::advance(const Motion& motion, const Stop& stop, PathKind kind) {
  reading_ = motion.readingAt(stop.end);
  slides_ = motion.slidesAt(stop.end);
  cameFrom_.reset();
  if (guard_) guard_->arrived(stop.end);
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
  const bool wanted = recording_ == Recording::Everything || (recording_ == Recording::Touches && stop.touch);
  if (!wanted || (motion.profile.length() == 0 && !stop.touch)) return;
  constexpr double turnPerPoint = 2;  // degrees
  double turn = 0;
  for (std::size_t i = 0; i < truth_.machine.axes.size(); ++i) {
    if (truth_.machine.axes[i].kind == AxisKind::Rotary) turn = std::max(turn, std::abs(reading_[i] - motion.from[i]));
  }
  const int pieces = std::clamp(static_cast<int>(std::ceil(turn / turnPerPoint)), 1, 360);
  for (int i = 1; i <= pieces; ++i) {
    const double fraction = stop.end * i / pieces;
    const double seconds = motion.startSeconds + pace * motion.profile.secondsAt(fraction * motion.profile.length());
    path_.add(pathPoint(motion.tableFromSpindleAt(fraction), motion.readingAt(fraction), kind,
                        i == pieces ? clock_ : seconds));
  }
  if (!stop.touch) return;
  PathTouch touch;
  touch.kind = kind;
  touch.solid = truth_.solids[stop.touch->solid].name;
  touch.part = stop.touch->shaft ? partOf(*stop.touch) : "ball";
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

std::optional<std::string> VirtualMachine::besideHirthGrid(const AxisPositions& target) const {
  constexpr double precision = 1e-6;  // degrees
  for (std::size_t i = 0; i < truth_.machine.axes.size(); ++i) {
    const double grid = truth_.hirthGrid[i];
    if (grid <= 0 || target[i] == reading_[i] || std::abs(std::remainder(target[i], grid)) <= precision) continue;
    return fmt::format("axis {} has a Hirth coupling: it stands at multiples of {} degrees, not at {}",
                       truth_.machine.axes[i].name, grid, readable(target[i]));
  }
  return std::nullopt;
}

std::optional<MoveResult> VirtualMachine::refusal(Feed feed, const AxisPositions& target) const {
  if (stop_.stop_requested()) return MoveResult{MoveEnd::Cancelled, stoppedText};
  if (!feed.rapid && !(feed.perMinute > 0)) return MoveResult{MoveEnd::Refused, "the feed is not above 0"};
  if (auto beside = besideHirthGrid(target)) return MoveResult{MoveEnd::Refused, *std::move(beside)};
  return std::nullopt;
}

std::string VirtualMachine::toolSignal() const {
  return tellsTouches_ ? describe(*toolContact_) : "the tool has touched the tool touch probe";
}

std::string VirtualMachine::stillDeflected() const {
  return "the stylus is still deflected: " + (deflection_ ? describe(*deflection_) : toolSignal());
}

void VirtualMachine::standAt(const Motion& motion, double fraction, PathKind kind) {
  advance(motion, Stop{std::nullopt, std::nullopt, fraction}, kind);
}

MoveResult VirtualMachine::move(const AxisPositions& target, Feed feed) {
  if (auto refused = refusal(feed, target)) return *std::move(refused);
  if (auto limit = beyondTravel(target)) return {MoveEnd::AxisLimit, *limit};
  if ((deflection_ || toolContact_) && !(target == reading_)) return {MoveEnd::ProbeSignal, stillDeflected()};
  const Motion motion = motionTo(target, feed);
  const PathKind kind = feed.rapid ? PathKind::Rapid : PathKind::Feed;
  try {
    const auto touch = firstTouchOf(motion, 0, searchOptions(positioningPrecision));
    if (const auto hit = bodyHit(motion, touch)) return {MoveEnd::Collision, stopAt(motion, *hit, kind)};
    return finish(motion, touch, kind);
  } catch (const SearchStopped& stopped) {
    standAt(motion, stopped.fraction, kind);
    return {MoveEnd::Cancelled, stoppedText};
  }
}

PathResult VirtualMachine::moveAlong(std::span<const PathPiece> path) {
  const auto moveClear = [&](const AxisPositions& target, Feed feed) -> MoveResult {
    if (auto refused = refusal(feed, target)) return *std::move(refused);
    if (auto limit = beyondTravel(target)) return {MoveEnd::AxisLimit, *limit};
    const Motion motion = motionTo(target, feed);
    const PathKind kind = feed.rapid ? PathKind::Rapid : PathKind::Feed;
    try {
      if (const auto hit = bodyHit(motion, std::nullopt)) return {MoveEnd::Collision, stopAt(motion, *hit, kind)};
    } catch (const SearchStopped& stopped) {
      standAt(motion, stopped.fraction, kind);
      return {MoveEnd::Cancelled, stoppedText};
    }
    return finish(motion, std::nullopt, kind);
  };
  constexpr std::size_t untilNextLook = 4;
  std::size_t clear = 0, look = 0;  // pieces that are clear come before `clear`; nobody looks for more before `look`
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i >= clear && i >= look && !deflection_ && !toolContact_ && !probesOnBed()) {
      clear = i + clearPieces(kinematics_, slides_, path.subspan(i), shape_, surroundings_);
      look = std::max(clear, i + untilNextLook);
    }
    MoveResult piece = i < clear ? moveClear(path[i].target, path[i].feed) : move(path[i].target, path[i].feed);
    if (piece.end != MoveEnd::Reached) return {piece.end, i, std::move(piece.detail)};
  }
  return {MoveEnd::Reached, path.size(), {}};
}

/// In the frame of what deflects the stylus.
Motion VirtualMachine::seenFromTouched(const Motion& motion) const {
  return probesOnBed() && isToolProbe(truth_.solids[deflection_->solid]) ? onBed(motion) : motion;
}

namespace {

/// Where a ball has left the plane through the point that it has touched: on a flat surface it is free there.
double leavesPlane(const Motion& seen, const Touch& touched, const Ball& ball) {
  constexpr double clear = 1e-6;  // mm off the surface
  const auto gap = [&](double fraction) {
    const Vector3 centre = seen.tableFromSpindleAt(fraction) * ball.centre;
    return (centre - touched.point).dot(touched.normal) - ball.radius;
  };
  const double atStart = gap(0), atEnd = gap(1);
  return atEnd > atStart ? std::clamp((clear - atStart) / (atEnd - atStart), 0.0, 1.0) : 0;
}

}  // namespace

std::optional<double> VirtualMachine::freeFrom(const Motion& motion) const {
  constexpr double firstStep = 0.002;   // mm
  constexpr double longestStep = 0.25;  // mm
  const double length = motion.profile.length();
  const auto overlaps = [&](double fraction) { return ballTouchAt(motion, fraction).has_value(); };
  double fraction = leavesPlane(seenFromTouched(motion), *deflection_, shape_.balls[deflection_->ball]);
  double step = firstStep;
  while (overlaps(fraction)) {
    if (fraction >= 1) return std::nullopt;
    fraction = std::min(1.0, fraction + step / length);
    step = std::min(2 * step, longestStep);
  }
  return fraction;
}

bool VirtualMachine::isWayBack(const Motion& motion) const {
  constexpr double same = 1e-9;  // mm, degrees
  if (!cameFrom_ || !deflection_ || toolContact_) return false;
  for (std::size_t i = 0; i < truth_.machine.axes.size(); ++i)
    if (std::abs(motion.to[i] - (*cameFrom_)[i]) > same) return false;
  return true;
}

MoveResult VirtualMachine::retract(const AxisPositions& target, Feed feed) {
  if (auto refused = refusal(feed, target)) return *std::move(refused);
  if (auto limit = beyondTravel(target)) return {MoveEnd::AxisLimit, *limit};
  const Motion motion = motionTo(target, feed);
  if (motion.profile.length() == 0) return {};
  SearchOptions options = searchOptions(positioningPrecision);
  options.ignoreShafts = toolContact_.has_value();
  toolContact_.reset();
  std::optional<Touch> touch;
  double begin = 0;
  bool searched = false;
  const auto search = [&] {
    touch = firstTouchOf(motion, begin, options);
    searched = true;
  };
  // Pressing on instead of leaving: the stylus gives way as far as it can.
  const auto pressOn = [&]() -> MoveResult {
    const Motion seen = seenFromTouched(motion);
    const Vector3 centre = seen.tableFromSpindleAt(1) * shape_.balls[deflection_->ball].centre;
    const double radius = shape_.balls[deflection_->ball].radius;
    const double depth = (deflection_->point - centre).dot(deflection_->normal) + radius;
    if (depth > 2 * mostOvertravel * radius)
      return {MoveEnd::Collision, "the stylus would be deflected too far: " + describe(*deflection_)};
    advance(motion, Stop{}, PathKind::Retract);
    return {};
  };
  try {
    if (isWayBack(motion)) {
      deflection_.reset();
      searched = true;
    }
    if (deflection_) {
      // Mostly the ball is free where it leaves the plane of contact: then it touches nothing there, but later at most.
      begin = leavesPlane(seenFromTouched(motion), *deflection_, shape_.balls[deflection_->ball]);
      if (begin < 1) search();
      if (touch && touch->fraction <= begin) searched = false;
    }
    if (deflection_ && !searched) {
      const auto free = freeFrom(motion);
      if (!free || (*free == 1 && ballTouchAt(motion, 1))) return pressOn();
      begin = *free;
    }
    deflection_.reset();
    if (!searched) search();
    // What a collision left touching may be pulled off.
    if (touch && touch->shaft && !options.ignoreShafts && shaftTouch()) {
      options.ignoreShafts = true;
      search();
    }
    if (const auto hit = bodyHit(motion, touch, BodyGuard::Touching::MayBePulledOff))
      return {MoveEnd::Collision, stopAt(motion, *hit, PathKind::Retract)};
    return finish(motion, touch, PathKind::Retract);
  } catch (const SearchStopped& stopped) {
    if (deflection_ && !ballTouchAt(motion, stopped.fraction)) deflection_.reset();
    standAt(motion, stopped.fraction, PathKind::Retract);
    return {MoveEnd::Cancelled, stoppedText};
  }
}

std::optional<Touch> VirtualMachine::overlap() {
  cameFrom_.reset();
  deflection_ = ballOverlap(tableFromSpindle(), shape_, surroundings_);
  if (!deflection_ && probesOnBed()) deflection_ = ballOverlap(bedFromSpindle(), shape_, toolProbesOnly_);
  auto touch = shaftTouch();
  return touch ? touch : deflection_;
}

}  // namespace probewright::simulation

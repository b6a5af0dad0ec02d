#include "execution/sinumerik/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "control/alarm.hpp"
#include "control/sinumerik/text.hpp"
#include "execution/motion/plane_curve.hpp"
#include "execution/sinumerik/spindle_speed.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;
using control::Feed;

namespace {

/// Feed types from here on count per revolution of the spindle.
constexpr int feedPerTurn = 95;
/// SD 42100 as delivered, mm/min.
constexpr double dryRunFeed = 5000;

double turnsTowards(double current, double angle) { return angle + 360 * std::round((current - angle) / 360); }

}  // namespace

PathMotion::PathMotion(Control& control, MotionState& state)
    : control_(control),
      state_(state),
      corners_(
          [this](const PathElement& element) { compensator_.active() ? compensator_.add(element) : run(element); }),
      compensator_([this](const PathElement& element) { run(element); }) {
  for (const machine::Axis& axis : control.channel.description().axes)
    axisCodes_.push_back(addressOf(upperCase(axis.name)));
}

std::optional<std::size_t> PathMotion::linearAxis(std::uint32_t address) {
  if (address >= 'X' && address <= 'Z') return address - 'X';
  return std::nullopt;
}

std::optional<std::size_t> PathMotion::machineAxis(std::uint32_t address) const {
  const auto found = std::find(axisCodes_.begin(), axisCodes_.end(), address);
  if (found == axisCodes_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - axisCodes_.begin());
}

double PathMotion::programAngle(std::size_t axis) const {
  return control_.channel.axes()[axis] - control_.channel.rotaryOffset[axis];
}

Vector3 PathMotion::start() const { return programmed_ ? *programmed_ : control_.channel.position().vector(); }

/// The program angle to go to. A modulo axis goes to positions within a turn; the others wherever they are told.
double PathMotion::rotaryTarget(std::size_t axis, WordMode mode, double value) const {
  const double current = programAngle(axis);
  const bool modulo = control_.channel.description().axes[axis].modulo;
  switch (mode) {
    case WordMode::Incremental:
      return current + value;
    case WordMode::DirectShortest:
      return turnsTowards(current, value);
    case WordMode::DirectPositive:
    case WordMode::DirectNegative: {
      const double near = turnsTowards(current, value);
      const bool positive = mode == WordMode::DirectPositive;
      if (std::abs(near - current) < 1e-9) return current;
      if (positive && near < current) return near + 360;
      if (!positive && near > current) return near - 360;
      return near;
    }
    case WordMode::Plain:
      if (state_.incremental) return current + value;
      [[fallthrough]];
    case WordMode::Absolute:
      break;
  }
  return modulo ? 360 * std::floor(current / 360 + 1e-12) + value : value;
}

void PathMotion::readAxis(std::uint32_t address, WordMode mode, double value, Words& words) {
  if (const auto linear = linearAxis(address)) {
    const bool asDiameter = *linear == 0 && control_.diameter;
    const bool incremental = mode == WordMode::Incremental || (mode == WordMode::Plain && state_.incremental);
    // DIAM90: diameters in absolute positions only.
    const bool halved = asDiameter && !(incremental && state_.gGroup[29] == 3);
    const double length = value * control_.unit / (halved ? 2 : 1);
    const double from = start()[static_cast<Eigen::Index>(*linear)], to = incremental ? from + length : length;
    if (!machineAxis(address)) {
      throw Alarm("12080", fmt::format("the machine has no axis {}", addressName(address)),
                  "the machine's description names its axes");
    }
    words.target.linear[*linear] = to;
    words.anyLinear = true;
    return;
  }
  const auto axis = machineAxis(address);
  if (!axis || control_.channel.description().axes[*axis].kind != machine::AxisKind::Rotary) {
    throw Alarm("12080", fmt::format("the machine has no axis {} that a program can move", addressName(address)),
                "the machine's description names its axes");
  }
  words.target.rotary[*axis] = rotaryTarget(*axis, mode, value);
  words.anyRotary = true;
}

bool PathMotion::readArcWord(std::uint32_t address, WordMode mode, double value, Words& words) {
  const double length = value * control_.unit;
  switch (address) {
    case addressOf("I"):
      words.centre[0] = {mode, length};
      return true;
    case addressOf("J"):
      words.centre[1] = {mode, length};
      return true;
    case addressOf("K"):
      words.centre[2] = {mode, length};
      return true;
    case addressOf("I1"):
    case addressOf("J1"):
    case addressOf("K1"): {
      const std::size_t axis = (address & 0xff) - 'I';
      const bool incremental = mode == WordMode::Incremental || (mode == WordMode::Plain && state_.incremental);
      words.middle[axis] = incremental ? start()[static_cast<Eigen::Index>(axis)] + length : length;
      return true;
    }
    case addressOf("CR"):
      words.radius = length;
      return true;
    case addressOf("AR"):
      words.opening = value;
      return true;
    case addressOf("TURN"):
      words.turns = static_cast<int>(std::clamp(std::floor(value + 0.5), 0.0, 999.0));
      return true;
    case addressOf("AP"):
      words.polarAngle = value;
      words.polarAngleIncremental = mode == WordMode::Incremental || (mode == WordMode::Plain && state_.incremental);
      return true;
    case addressOf("RP"):
      words.polarRadius = length;
      words.polarRadiusIncremental = mode == WordMode::Incremental;
      return true;
    case addressOf("ANG"):
      words.angle = value;
      return true;
    case addressOf("FP"):
      if (value != 1 && onIgnoredWord) onIgnoredWord(fmt::format("FP={}", value));
      return true;
    // Weights and lengths of splines, which are travelled straight.
    case addressOf("PL"):
    case addressOf("PW"):
    case addressOf("SD"):
    // Soft approach and the angle at which a thread begins: the lines around them are travelled without.
    case addressOf("DISR"):
    case addressOf("DISPR"):
    case addressOf("FAD"):
    case addressOf("SF"):
    // The angle of involutes, and what inputs switch to.
    case addressOf("PSI"):
    case addressOf("SR"):
    case addressOf("ST"):
      return true;
    case addressOf("ANG1"):
    case addressOf("ANG2"):
      throw Alarm("12080", fmt::format("contours with {} are not carried out", addressName(address)),
                  "write each straight line into a block of its own, with ANG or with its end point");
    default:
      return readOrientationWord(address, value, words) || readCornerWord(address, value, words);
  }
}

/// Roundings and chamfers: what the block says goes before RNDM.
bool PathMotion::readCornerWord(std::uint32_t address, double value, Words& words) {
  const auto corner = [&](Corner::Kind kind) { words.corner = Corner{kind, value * control_.unit, {}}; };
  if (!(value >= 0) && (address == addressOf("RND") || address == addressOf("RNDM") || address == addressOf("CHF") ||
                        address == addressOf("CHR")))
    throw Alarm("14020", fmt::format("{} cannot be negative", addressName(address)), "write its size without a sign");
  switch (address) {
    case addressOf("RND"):
      corner(Corner::Kind::Rounding);
      return true;
    case addressOf("CHF"):
      corner(Corner::Kind::ChamferLength);
      return true;
    case addressOf("CHR"):
      corner(Corner::Kind::ChamferWidth);
      return true;
    case addressOf("RNDM"):
      state_.modalRounding = value * control_.unit;
      return true;
    case addressOf("FRC"):
      words.cornerFeed = value;
      return true;
    case addressOf("FRCM"):
      state_.modalCornerFeed = value;
      return true;
    default:
      return false;
  }
}

std::optional<Corner> PathMotion::cornerOf(const Words& words, Feed own) const {
  std::optional<Corner> corner = words.corner;
  if (!corner && state_.modalRounding > 0) corner = Corner{Corner::Kind::Rounding, state_.modalRounding, {}};
  if (!corner) return corner;
  const double programmed = words.cornerFeed > 0 ? words.cornerFeed : state_.modalCornerFeed;
  // F of the block stands for the same kind of feed.
  if (programmed > 0 && !own.rapid && state_.feed > 0)
    corner->feed = Feed::at(own.perMinute * programmed / state_.feed);
  return corner;
}

/// ANG: the direction of a straight line and one coordinate of its end give the other one. A line with ANG alone ends
/// where the line of the next block begins, whose end and direction are known. False if this line waits for that.
bool PathMotion::resolveAngle(Words& words, MoveKind kind) {
  const control::WorkingPlane plane = control_.workingPlane();
  std::optional<double>& main = words.target.linear[static_cast<std::size_t>(plane.main)];
  std::optional<double>& minor = words.target.linear[static_cast<std::size_t>(plane.minor)];
  const auto refuse = [](const char* why) { throw Alarm("14090", why, "check ANG and the end point"); };
  const auto along = [&](double angle) {
    Vector3 direction = Vector3::Zero();
    direction[plane.main] = std::cos(radiansFromDegrees(angle));
    direction[plane.minor] = std::sin(radiansFromDegrees(angle));
    return direction;
  };
  const Vector3 from = start();
  if (openLine_) {
    Words first = *openLine_;
    openLine_.reset();
    if (!words.angle || !main || !minor) refuse("the line after one with ANG alone needs its end point and ANG");
    PathElement one, other;
    one.start = from;
    one.end = from + along(*first.angle);
    other.end = from;
    other.end[plane.main] = *main;
    other.end[plane.minor] = *minor;
    other.start = other.end - along(*words.angle);
    const std::vector<Vector3> crossing = intersections(one, other, plane);
    if (crossing.empty()) refuse("the two lines with ANG are parallel");
    first.target.linear[static_cast<std::size_t>(plane.main)] = crossing.front()[plane.main];
    first.target.linear[static_cast<std::size_t>(plane.minor)] = crossing.front()[plane.minor];
    moveStraight(first, kind);
    return true;
  }
  const Vector3 direction = along(*words.angle);
  if (main && !minor) {
    if (std::abs(direction[plane.main]) < 1e-9) refuse("a line square to the 1st axis of the plane cannot end there");
    minor = from[plane.minor] + (*main - from[plane.main]) * direction[plane.minor] / direction[plane.main];
  } else if (minor && !main) {
    if (std::abs(direction[plane.minor]) < 1e-9) refuse("a line along the 1st axis of the plane cannot end there");
    main = from[plane.main] + (*minor - from[plane.minor]) * direction[plane.main] / direction[plane.minor];
  } else if (!main) {
    openLine_ = words;
    openLine_->anyLinear = true;
    return false;
  }
  return true;
}

PathMotion::Words PathMotion::read(WordRange range, Evaluation& evaluation) {
  Words words;
  std::uint32_t computed = 0;
  for (const Word& word : evaluation.words(range)) {
    const std::uint32_t address = axisOf(word, computed, evaluation);
    if (address == 0) continue;
    const double value = evaluation.number(word.value);
    if (!readArcWord(address, word.mode, value, words)) readAxis(address, word.mode, value, words);
  }
  if (words.polarAngle || words.polarRadius) resolvePolar(words);
  resolveOrientation(words);
  return words;
}

/// The address that a word means, with AX[axis]= and IP[axis]= resolved; 0 for the words that name their axis.
std::uint32_t PathMotion::axisOf(const Word& word, std::uint32_t& computed, Evaluation& evaluation) const {
  if (word.address == addressOf("=AX") || word.address == addressOf("=IP")) return computed;
  const bool parameter = word.address == addressOf("IP[]");
  if (!parameter && word.address != addressOf("AX[]")) return word.address;
  const std::string axis = upperCase(evaluation.text(word.value));
  computed = addressOf(axis);
  if (parameter) {
    const auto linear = linearAxis(computed);
    if (!linear) throw Alarm("12080", fmt::format("IP[{}]: only X, Y and Z have a parameter of interpolation", axis));
    computed = 'I' + static_cast<std::uint32_t>(*linear);
  }
  return 0;
}

void PathMotion::resolvePolar(Words& words) const {
  const control::WorkingPlane plane = control_.workingPlane();
  const Vector3 from = start() - state_.pole;
  double angle = degreesFromRadians(std::atan2(from[plane.minor], from[plane.main]));
  double radius = std::hypot(from[plane.main], from[plane.minor]);
  if (words.polarAngle) angle = (words.polarAngleIncremental ? angle : 0) + *words.polarAngle;
  if (words.polarRadius) radius = (words.polarRadiusIncremental ? radius : 0) + *words.polarRadius;
  words.target.linear[static_cast<std::size_t>(plane.main)] =
      state_.pole[plane.main] + radius * std::cos(radiansFromDegrees(angle));
  words.target.linear[static_cast<std::size_t>(plane.minor)] =
      state_.pole[plane.minor] + radius * std::sin(radiansFromDegrees(angle));
  words.anyLinear = true;
}

void PathMotion::setPole(std::string_view function, WordRange range, Evaluation& evaluation) {
  const Vector3 from = function == "G112" ? state_.pole : function == "G110" ? start() : Vector3(Vector3::Zero());
  Words words;
  Vector3 pole = from;
  std::uint32_t computed = 0;
  for (const Word& word : evaluation.words(range)) {
    const std::uint32_t address = axisOf(word, computed, evaluation);
    if (address == 0) continue;
    const double value = evaluation.number(word.value);
    if (const auto axis = linearAxis(address)) {
      pole[static_cast<Eigen::Index>(*axis)] = from[static_cast<Eigen::Index>(*axis)] + value * control_.unit;
    } else {
      readArcWord(address, word.mode, value, words);
    }
  }
  if (words.polarAngle || words.polarRadius) {
    const control::WorkingPlane plane = control_.workingPlane();
    const double angle = radiansFromDegrees(words.polarAngle.value_or(0)), radius = words.polarRadius.value_or(0);
    pole[plane.main] = from[plane.main] + radius * std::cos(angle);
    pole[plane.minor] = from[plane.minor] + radius * std::sin(angle);
  }
  state_.pole = pole;
}

Vector3 PathMotion::endOf(const Words& words) const {
  Vector3 end = start();
  for (std::size_t i = 0; i < 3; ++i)
    if (words.target.linear[i]) end[static_cast<Eigen::Index>(i)] = *words.target.linear[i];
  return end;
}

Feed PathMotion::feed(MoveKind kind, const Vector3& from, const Vector3& to) const {
  if (kind == MoveKind::Rapid) return Feed::rapidTraverse();
  const double factor = state_.feedInInch ? control_.unit : 1;
  double perMinute = state_.feed * factor;
  // The speed in the middle of a line gives the time of the whole line.
  if (state_.feedType >= feedPerTurn) perMinute *= spindleSpeedAt(state_, ProgramPlace((from + to) / 2));
  if (state_.feedType == 93) perMinute = state_.feed * std::max((to - from).norm(), 1e-3);
  if (!(perMinute > 0)) {
    const bool perTurn = state_.feedType >= feedPerTurn && state_.feed > 0;
    throw Alarm("10860", perTurn ? "the feed per revolution needs a turning spindle" : "no feed is programmed",
                perTurn ? "program S, or G94 for a feed per minute" : "program F before the first G1, G2 or G3");
  }
  // SD 42101 as delivered: the faster of the two.
  if (control_.dryRun) perMinute = std::max(perMinute, control_.machineData("$SC_DRY_RUN_FEED", dryRunFeed));
  return Feed::at(perMinute);
}

void PathMotion::carryOut(const Move& move, Evaluation& evaluation) {
  if (move.kind != MoveKind::Modal) {
    state_.group1 = move.kind;
    state_.thread = 0;
  }
  // G34 and G35: F is how fast the pitch changes.
  const bool changesPitch = state_.thread == 34 || state_.thread == 35;
  if (move.feed.present() && !changesPitch) state_.feed = evaluation.number(move.feed);
  if (move.compensation != RadiusCompensation::Unchanged) setCompensation(move.compensation);
  if (move.machineCoordinates) {
    flush();
    return moveWithoutFrames(move, evaluation);
  }
  Words words = read(move.words, evaluation);
  const MoveKind kind = state_.group1;
  if ((words.angle || openLine_) && !resolveAngle(words, kind)) return;
  if (!words.anyMotion()) return;  // RNDM, FRCM
  if (kind == MoveKind::Rapid || kind == MoveKind::Linear || kind == MoveKind::Modal) return moveStraight(words, kind);
  PathElement element = arc(words, kind);
  element.feed = feed(kind, element.start, element.end);
  direction_ = element.endDirection();
  append(element, cornerOf(words, element.feed));
}

void PathMotion::moveStraight(const Words& words, MoveKind kind) {
  const Vector3 from = start(), to = endOf(words);
  const bool thread = state_.thread != 0 && kind != MoveKind::Rapid;
  const Feed speed = thread ? Feed::at(threadFeed(words, to - from))
                            : feed(kind == MoveKind::Rapid ? MoveKind::Rapid : MoveKind::Linear, from, to);
  if ((to - from).norm() > 1e-9) direction_ = (to - from).normalized();
  const std::optional<Corner> corner = cornerOf(words, speed);
  if (words.anyRotary || (!compensator_.active() && !corner && !corners_.holds())) {
    flush();
    travel(words.target, speed);
    return;
  }
  PathElement line;
  line.start = from;
  line.end = to;
  line.feed = speed;
  append(line, corner);
}

void PathMotion::append(const PathElement& element, const std::optional<Corner>& corner) {
  programmed_ = element.end;
  corners_.add(element, corner, control_.workingPlane());
  if (!compensator_.active() && !corners_.holds()) programmed_.reset();
}

/// After a measuring block the sensor is still deflected: it may leave what it touched.
bool PathMotion::leavesContact() const {
  return control_.channel.deflected(machine::Sensor::TouchProbe) ||
         control_.channel.deflected(machine::Sensor::ToolTouchProbe);
}

void PathMotion::travel(const control::Target& target, Feed feed) {
  control::Channel& channel = control_.channel;
  const bool turns = std::ranges::any_of(target.rotary, [](const auto& angle) { return angle.has_value(); });
  if (turns || !leavesContact()) return channel.moveTo(target, feed);
  ProgramPlace to = channel.position();
  for (std::size_t i = 0; i < 3; ++i)
    if (target.linear[i]) to[static_cast<Eigen::Index>(i)] = *target.linear[i];
  channel.retractTo(to, feed);
}

void PathMotion::run(const PathElement& element) {
  control::Channel& channel = control_.channel;
  std::vector<ProgramPlace> points;
  if (element.isArc) {
    const double radius = (element.start - element.centre).norm();
    const int pieces = motion::piecesOfArc(radius, element.sweep, channel.pathTolerance);
    points.reserve(static_cast<std::size_t>(pieces));
    for (int i = 1; i < pieces; ++i)
      points.emplace_back(element.at(static_cast<double>(i) / pieces));
  }
  points.emplace_back(element.end);
  state_.pieces += points.size() - 1;
  std::span<const ProgramPlace> left = points;
  for (; !left.empty() && leavesContact(); left = left.subspan(1))
    channel.retractTo(left.front(), element.feed);
  channel.moveAlong(left, element.feed);
}

void PathMotion::flush() {
  openLine_.reset();
  corners_.flush();
  compensator_.flush();
  if (programmed_ && !compensator_.active()) programmed_.reset();
}

void PathMotion::setCompensation(RadiusCompensation compensation) {
  const bool wanted = compensation != RadiusCompensation::Off;
  if (compensation == state_.compensation) return;
  const bool was = state_.compensation != RadiusCompensation::Off;
  corners_.flush();
  state_.compensation = compensation;
  control_.radiusCompensation = wanted;
  if (was) {
    if (!wanted) return compensator_.end();
    flush();
  }
  if (control_.tool.edge == 0)
    throw Alarm("61311", "tool radius compensation needs an active D number", "program T and D before G41 or G42");
  compensator_.begin(compensation == RadiusCompensation::Left ? 1 : -1, control_.tool.radius, control_.workingPlane(),
                     state_.cornerArc);
}

/// SUPA, G153: no frame at all; G53: base frames stay.
void PathMotion::moveWithoutFrames(const Move& move, Evaluation& evaluation) {
  control::Channel& channel = control_.channel;
  channel.rotaryOffset = {};
  channel.setFollowing(control::Following::LinearAxes, {});
  const bool baseStays = evaluation.at(move.variant) == "G53";
  channel.setFrame(baseStays ? control_.machineFromBase() : Eigen::Affine3d::Identity());
  try {
    const Words words = read(move.words, evaluation);
    const bool rapid = state_.group1 == MoveKind::Rapid;
    travel(words.target, feed(rapid ? MoveKind::Rapid : MoveKind::Linear, start(), endOf(words)));
  } catch (...) {
    control_.handOverFrames();
    throw;
  }
  control_.handOverFrames();
}

void PathMotion::position(const std::string& axis, WordMode mode, double value) {
  flush();
  Words words;
  readAxis(addressOf(axis), mode, value, words);
  const auto own = state_.axisFeed.find(axis);
  travel(words.target, own != state_.axisFeed.end() && own->second > 0 ? Feed::at(own->second) : Feed::rapidTraverse());
}

void PathMotion::approachFixedPoint(const Command& command, Evaluation& evaluation) {
  flush();
  control::Channel& channel = control_.channel;
  AxisPositions target = channel.axes();
  std::uint32_t computed = 0;
  for (const Word& word : evaluation.words(command.words)) {
    if (word.address == addressOf("F")) continue;
    const std::uint32_t address = axisOf(word, computed, evaluation);
    if (address == 0) continue;
    if (address == addressOf("FP")) {
      Words none;
      readArcWord(address, word.mode, evaluation.number(word.value), none);
      continue;
    }
    std::string name = addressName(address);
    auto axis = machineAxis(addressOf(name));
    if (!axis && name.size() > 1) axis = machineAxis(addressOf(name.substr(0, name.size() - 1)));  // X1 is X
    if (!axis) throw Alarm("12080", fmt::format("the machine has no axis {}", name));
    target[*axis] = channel.description().toolChange[*axis];
  }
  channel.moveAxes(target, Feed::rapidTraverse());
}

}  // namespace probewright::execution::sinumerik

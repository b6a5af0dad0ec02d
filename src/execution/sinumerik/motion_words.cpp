#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/alarm.hpp"
#include "control/sinumerik/text.hpp"
#include "execution/sinumerik/motion.hpp"

/// What the words of a motion block mean: axes, centres and radii of arcs, corners, angles, polar coordinates.
namespace probewright::execution::sinumerik {

using control::Alarm;
using control::Feed;

namespace {

/// AX[axis]= may name an axis that the block has already.
void refuseTwice(bool given, std::uint32_t address) {
  if (given)
    throw Alarm("12010", fmt::format("the axis {} appears twice in this block", addressName(address)),
                "write each axis once in a block");
}

double turnsTowards(double current, double angle) { return angle + 360 * std::round((current - angle) / 360); }

}  // namespace

/// The program angle to go to. A modulo axis counts from 0 again after a turn: it goes up to an angle greater than the
/// one it shows and down to a smaller one, less than a turn either way. The others go wherever they are told.
double PathMotion::rotaryTarget(std::size_t axis, WordMode mode, double value) const {
  const double current = programAngle(axis);
  const machine::Axis& description = control_.channel.description().axes[axis];
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
  if (!description.modulo) return value;
  const double target = current - machine::shownPosition(description, current) + value;
  const double turns = (target - current) / 360;
  const bool isThere = std::abs(std::remainder(target - current, 360.0)) < 1e-9;
  return target - 360 * (isThere ? std::round(turns) : std::trunc(turns));
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
    refuseTwice(words.target.linear[*linear].has_value(), address);
    words.target.linear[*linear] = to;
    words.anyLinear = true;
    return;
  }
  const auto axis = machineAxis(address);
  if (!axis || control_.channel.description().axes[*axis].kind != machine::AxisKind::Rotary) {
    throw Alarm("12080", fmt::format("the machine has no axis {} that a program can move", addressName(address)),
                "the machine's description names its axes");
  }
  refuseTwice(words.target.rotary[*axis].has_value(), address);
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
    // What inputs switch to.
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
  if (words.target.linear[static_cast<std::size_t>(plane.main)] ||
      words.target.linear[static_cast<std::size_t>(plane.minor)])
    throw Alarm("14280", "the end point is polar and Cartesian", "write AP and RP, or the axes of the plane");
  words.target.linear[static_cast<std::size_t>(plane.main)] =
      state_.pole[plane.main] + radius * std::cos(radiansFromDegrees(angle));
  words.target.linear[static_cast<std::size_t>(plane.minor)] =
      state_.pole[plane.minor] + radius * std::sin(radiansFromDegrees(angle));
  words.anyLinear = true;
}

void PathMotion::setPole(const Vector3& from, WordRange range, Evaluation& evaluation) {
  Words words;
  Vector3 pole = from;
  std::uint32_t computed = 0;
  for (const Word& word : evaluation.words(range)) {
    const std::uint32_t address = axisOf(word, computed, evaluation);
    if (address == 0) continue;
    const double value = evaluation.number(word.value);
    if (const auto axis = linearAxis(address)) {
      pole[static_cast<Eigen::Index>(*axis)] = from[static_cast<Eigen::Index>(*axis)] + value * control_.unit;
    } else if (!readArcWord(address, word.mode, value, words)) {
      throw Alarm("12080", fmt::format("a pole has no {}", addressName(address)),
                  "write the pole with X, Y and Z, or with AP and RP");
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

}  // namespace probewright::execution::sinumerik

#include "execution/sinumerik/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "control/alarm.hpp"
#include "control/scoped.hpp"
#include "control/sinumerik/text.hpp"
#include "execution/motion/plane_curve.hpp"
#include "execution/sinumerik/spindle_speed.hpp"
#include "language/sinumerik/block_words.hpp"

namespace probewright::execution::sinumerik {

using control::Alarm;
using control::Feed;

namespace {

/// Feed types from here on count per revolution of the spindle.
constexpr int feedPerTurn = 95;
/// SD 42100 as delivered, mm/min.
constexpr double dryRunFeed = 5000;

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
    state_.otherPath = false;
  }
  // G34 and G35: F is how fast the pitch changes.
  const bool changesPitch = state_.thread == 34 || state_.thread == 35;
  if (move.feed.present() && !changesPitch) state_.feed = evaluation.number(move.feed);
  if (move.compensation != RadiusCompensation::Unchanged) setCompensation(move.compensation);
  checkWords(move, evaluation);
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

/// Refuses words that do not belong to the motion in force.
void PathMotion::checkWords(const Move& move, Evaluation& evaluation) const {
  const auto words = evaluation.words(move.words);
  // Axes alone belong to every motion.
  if (std::ranges::all_of(words, [](const Word& word) { return word.address >= 'X' && word.address <= 'Z'; })) return;
  using language::sinumerik::Takes;
  Takes takes = Takes::Line;
  std::string name = state_.group1 == MoveKind::Rapid ? "G0" : "G1";
  switch (state_.group1) {
    case MoveKind::ArcClockwise:
    case MoveKind::ArcCounterclockwise:
      takes = Takes::Arc;
      name = state_.group1 == MoveKind::ArcClockwise ? "G2" : "G3";
      break;
    case MoveKind::ArcThroughPoint:
      takes = Takes::Points;
      name = "CIP";
      break;
    case MoveKind::ArcTangential:
      takes = Takes::Tangent;
      name = "CT";
      break;
    default:
      if (state_.thread != 0) {
        takes = Takes::Thread;
        name = fmt::format("G{}", state_.thread);
      } else if (state_.otherPath) {
        takes = Takes::Spline;
      }
  }
  const auto mistake = language::sinumerik::wordMistake(takes, name, evaluation.block(), move.words, control_.plane);
  if (mistake) throw Alarm(std::string(mistake->alarm), mistake->message, mistake->advice);
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
  if (openLine_) {
    openLine_.reset();
    throw Alarm("14090", "the line with ANG alone has no end",
                "write the line that it leads to into the next block, with its end point and ANG");
  }
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
  const control::AtEnd again([this] { control_.handOverFrames(); });
  channel.rotaryOffset = {};
  channel.setFollowing(control::Following::LinearAxes, {});
  const bool baseStays = evaluation.at(move.variant) == "G53";
  channel.setFrame(baseStays ? control_.machineFromBase() : Eigen::Affine3d::Identity());
  const Words words = read(move.words, evaluation);
  const bool arc =
      state_.group1 != MoveKind::Rapid && state_.group1 != MoveKind::Linear && state_.group1 != MoveKind::Modal;
  if (arc || words.angle || words.corner) {
    throw Alarm("12110",
                fmt::format("{} is travelled as a straight line to the end point only: no arc, ANG, RND, CHF or CHR",
                            evaluation.at(move.variant)),
                "write G0 or G1 and the end point");
  }
  const bool rapid = state_.group1 == MoveKind::Rapid;
  travel(words.target, feed(rapid ? MoveKind::Rapid : MoveKind::Linear, start(), endOf(words)));
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
    // The machine axes are called X1, Y1 ...; A2 to C7 would orient the tool.
    if (!axis && name.size() == 2 && name[1] == '1') axis = machineAxis(addressOf(name.substr(0, 1)));
    if (!axis) throw Alarm("12080", fmt::format("the machine has no axis {}", name));
    target[*axis] = channel.description().toolChange[*axis];
  }
  channel.moveAxes(target, Feed::rapidTraverse());
}

}  // namespace probewright::execution::sinumerik

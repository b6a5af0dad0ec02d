#include "cycles/heidenhain/object_probing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "base/number_text.hpp"
#include "control/alarm.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;

namespace {

constexpr int clearanceNever = -1, clearancePerCycle = 0, clearancePerPoint = 2;
constexpr double feedPerPoint = 2000;

probing::HeidenhainProber proberFor(Context& context) {
  probing::HeidenhainProbe probe = activeProbe(context.control());
  probe.prepositionAtMachineRapid = false;
  if (context.option(1125) == clearancePerPoint) probe.positioningFeed = feedPerPoint;
  orientToCalibration(context.channel(), probe);
  return {context.channel(), context.control().coordinates.plane, probe};
}

}  // namespace

ObjectProbing::ObjectProbing(Context& context, std::string_view called)
    : context_(context),
      called_(called),
      prober_(proberFor(context)),
      mode_(context.option(1125)),
      clearance_(context.q(260)),
      extra_(context.q(320)) {}

void ObjectProbing::enter(const BallCentre& ballCentre, Point point) {
  const bool firstOfObject = point == Point::FirstOfObject;
  const bool viaClearance = mode_ == clearancePerPoint || (firstOfObject && mode_ > clearancePerCycle) ||
                            (!entered_ && mode_ == clearancePerCycle);
  if (viaClearance) {
    prober_.approach(ballCentre, clearance_);
  } else if (firstOfObject) {
    // Never through the clearance height: up first only where the target lies above.
    prober_.approach(ballCentre, ballCentre[2] - prober_.poleDepth());
  } else {
    prober_.moveTo(ballCentre);
  }
  entered_ = true;
}

std::string ObjectProbing::question(int ordinal) const {
  const auto& cycles = context_.control().journal.cycles;
  const std::string& name = context_.record().name;
  const auto calls = std::ranges::count(cycles, name, &control::CycleRecord::name);
  return calls <= 1 ? fmt::format("{} {} {}", name, called_, ordinal)
                    : fmt::format("{} call {} {} {}", name, calls, called_, ordinal);
}

std::optional<std::string> ObjectProbing::answer(const std::string& what, Asked asked) {
  const auto& panel = context_.control().panel;
  if (!panel.answer) return std::nullopt;
  std::string wanted =
      "position of the probe's tip in main, minor and tool axis: 10 20 -5, or with waypoints 10 20 50; "
      "10 20 -5";
  if (asked == Asked::WayAndDirection) wanted += ", or with another probing direction 10 20 -5 Y-";
  wanted += " (an empty line leaves the probe where it is)";
  return panel.answer({what, wanted, [&](const std::string& text) { return wayOf(text, asked).has_value(); }});
}

int ObjectProbing::directionFrom(const std::string& word) const {
  for (const int direction : {1, 2, 3, -1, -2, -3}) {
    if (word == nameOf(direction)) return direction;
  }
  return 0;
}

std::string ObjectProbing::nameOf(int direction) const {
  const auto& plane = context_.control().coordinates.plane;
  const int axis = std::abs(direction) == 1 ? plane.main : std::abs(direction) == 2 ? plane.minor : plane.tool;
  return {"XYZ"[axis], direction < 0 ? '-' : '+'};
}

std::optional<ObjectProbing::Way> ObjectProbing::wayOf(const std::string& text, Asked asked) const {
  Way way;
  std::istringstream all(text);
  std::string one;
  while (std::getline(all, one, ';')) {
    std::ranges::replace(one, ',', ' ');
    std::istringstream words(one);
    PlanePlace tip;
    int count = 0;
    for (std::string word; words >> word; ++count) {
      if (way.direction != 0) return std::nullopt;
      if (count < 3) {
        const auto number = parseDecimal(word);
        if (!number) return std::nullopt;
        tip[count] = *number * context_.control().unit;
      } else {
        way.direction = asked == Asked::WayAndDirection ? directionFrom(word) : 0;
        if (way.direction == 0) return std::nullopt;
      }
    }
    if (count == 0) continue;
    if (count < 3) return std::nullopt;
    way.tips.push_back(tip);
  }
  return way;
}

void ObjectProbing::moveAlong(const std::string& what, const std::string& waypoints, int* direction) {
  const std::optional<Way> way = wayOf(waypoints, direction == nullptr ? Asked::Way : Asked::WayAndDirection);
  if (!way) {
    throw Alarm(
        "Position of the probe wrong", fmt::format("'{}' is not a position for {}", waypoints, what),
        "answer with the position of the probe's tip in main, minor and tool axis, with decimal points: 10 20.5 -5; "
        "semicolons separate waypoints: 10 20.5 50; 10 20.5 -5");
  }
  for (const PlanePlace& tip : way->tips)
    prober_.approach(prober_.positionWithTip(tip), tip.z());
  if (way->direction != 0) *direction = way->direction;
}

void ObjectProbing::askOperator(const std::string& what, const std::string& task, int* direction) {
  context_.stop(fmt::format("{}: {}, then NC start", what, task));
  const auto reply = answer(what, direction == nullptr ? Asked::Way : Asked::WayAndDirection);
  if (!reply) {
    throw Alarm("Semi-automatic probing without operator",
                fmt::format("No answer says where the probe is to be for {}", what),
                fmt::format("give the answer '{} = MAIN MINOR TOOL', the position of the probe's tip", what));
  }
  moveAlong(what, *reply, direction);
}

void ObjectProbing::retractByOperator(const std::string& what) {
  if (mode_ <= clearancePerCycle) return;
  context_.stop(
      fmt::format("{}: no automatic retraction to the clearance height; move the probe to a safe position, "
                  "then NC start",
                  what));
  const std::string away = what + " away";
  if (const auto reply = answer(away, Asked::Way)) moveAlong(away, *reply);
}

EvaluatedTouch ObjectProbing::touch(const NominalPosition& nominal, int& direction) {
  const auto along = [](int signedAxis) { return probing::axisDirection(std::abs(signedAxis) - 1, signedAxis); };
  byHand_ = nominal.semiAutomatic();
  if (byHand_) {
    const std::string what = question(nominal.ordinal);
    askOperator(what, fmt::format("move the probe in front of the point, probing direction {}", nameOf(direction)),
                &direction);
    requireNominal(nominal, static_cast<std::size_t>(std::abs(direction) - 1));
    entered_ = true;
    const EvaluatedTouch touch = prober_.stroke(along(direction));
    retractByOperator(what);
    return touch;
  }
  const PlannedTouch planned{nominal.place(), along(direction)};
  enter(prober_.prePosition(planned, extra_), entered_ ? Point::Further : Point::FirstOfObject);
  return prober_.touch(planned);
}

std::vector<EvaluatedTouch> ObjectProbing::touchCircle(const NominalPosition& nominal, const Vector2& diameterAndStart,
                                                       double step, int count, Side side) {
  const auto& probe = prober_.probe();
  const double diameter = diameterAndStart[0];
  const std::string what = question(nominal.ordinal);
  PartPoint middle = nominal.place();
  byHand_ = nominal.semiAutomatic();
  double above = 0;
  if (byHand_) {
    askOperator(what, side == Side::Inside ? "move the ball into the middle of the hole at the measuring height"
                                           : "move the ball above the middle of the stud");
    entered_ = true;
    middle = partAt(prober_.position());
    above = middle[2];
    // As far below the top of the stud as the ball stands above it.
    if (side == Side::Outside)
      middle[2] -= 2 * (prober_.inProgram(probe.setUp, PlaneWay::unit(2)) + extra_) + prober_.poleDepth();
  }
  double extra = extra_;
  const double setUp = prober_.inProgram(probe.setUp, PlaneWay::unit(0));
  const double room = diameter / 2 - prober_.inProgram(probe.reach(), PlaneWay::unit(0));
  const bool narrow = side == Side::Inside && room < setUp + extra - 1e-6;
  if (narrow) {
    if (!(room > 0)) {
      throw Alarm("Hole too small",
                  fmt::format("The ball, which reaches {:.4f} mm, does not fit into a hole of diameter {:.4f} mm",
                              probe.reach(), diameter),
                  "use a smaller stylus, or correct the diameter");
    }
    context_.stop(
        fmt::format("{}: the hole is too small for the set-up clearance\nNominal diameter {:.4f}\nBall radius "
                    "{:.4f}\nPossible set-up clearance {:.4f}\nNC start goes on with it",
                    what, diameter, probe.ballRadius, room));
    extra = room - setUp;
  }
  const auto plan = probing::planCircle(middle, diameter, diameterAndStart[1], step, count, side);
  std::vector<EvaluatedTouch> touches;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const BallCentre start = narrow ? ballAt(middle) : prober_.prePosition(plan[i], extra);
    if (i == 0 && byHand_) {
      prober_.moveInPlane(start);
      prober_.moveTo(start);
    } else if (i == 0 || (mode_ == clearancePerPoint && !byHand_)) {
      enter(start, i == 0 ? Point::FirstOfObject : Point::Further);
    } else if (!narrow) {
      prober_.moveOnArc(middle, step);
    }
    touches.push_back(prober_.touch(plan[i]));
  }
  if (byHand_) {
    if (side == Side::Outside) prober_.moveHeightTo(above);
    retractByOperator(what);
  }
  return touches;
}

void ObjectProbing::leaveObject() {
  if (mode_ > clearancePerCycle) leaveLastObject();
}

void ObjectProbing::leaveLastObject() {
  // After probing by hand only the clearance height before and after the cycle still counts: 1 and 2 are ignored.
  if (!entered_ || mode_ == clearanceNever || (byHand_ && mode_ > clearancePerCycle)) return;
  prober_.moveSouthPoleTo(clearance_);
}

}  // namespace probewright::cycles::heidenhain

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "control/sinumerik/measuring_data.hpp"
#include "control/sinumerik/tool_data.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/probe_calibration.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice tasks976[] = {{0, "length on a surface"},
                               {1, "radius in a ring about the start position"},
                               {2, "radius in a ring with unknown centre"},
                               {3, "radius and length on a ball"},
                               {4, "radius on an edge"}};
constexpr Choice directions976[] = {{0, "all directions"}, {1, "one direction"}, {2, "both directions of one axis"}};
constexpr Choice deviation976[] = {{0, "with positional deviation"}, {1, "without positional deviation"}};
constexpr Choice angle976[] = {{0, "along the axes"}, {1, "at an angle"}};
constexpr Choice toolLength976[] = {{0, "without tool length"}, {1, "with tool length"}};
constexpr CodeDigit variant976[] = {{1, 1, "task", tasks976},
                                    {4, 1, "directions", directions976},
                                    {5, 1, "positional deviation", deviation976},
                                    {6, 1, "angle", angle976},
                                    {7, 1, "tool length", toolLength976}};

constexpr Parameter parameters976[] = {
    parameters::variant(variant976, 1000),
    parameters::dataSet(1),
    parameters::length(2, "S_SETV", "set value: surface, diameter of ring or ball, distance of two edges"),
    parameters::length(3, "S_SETV0", "top of the ball in the 3rd axis (with tool length)"),
    parameters::count<3>(4, "S_MA", "measuring axis: 1, 2, 3", 1),
    parameters::count<1>(5, "S_MD", "measuring direction: 0 plus, 1 minus"),
    parameters::measuringPath(6),
    parameters::safeArea(7),
    parameters::feed(8, "S_VMS", "measuring feed; 0: as in the setting data"),
    parameters::angle(9, "S_STA1", "angle of the first direction from the 1st axis"),
    parameters::repetitions(10),
    parameters::reserved(11),
    parameters::plane(12),
    parameters::alternative(13),
};

constexpr auto results976 = joined(
    std::array<ResultDefinition, 2>{{{"_OVR[6]", "centre of ring or ball, 1st axis", result::actual(of::centre1)},
                                     {"_OVR[7]", "centre of ring or ball, 2nd axis", result::actual(of::centre2)}}},
    calibrationResults);

enum class Body { Surface = 0, RingAboutStart, Ring, Ball, Edge };

constexpr double reversal = 180;

constexpr const char* bentAdvice =
    "an L-shaped probe (713) touches in a ring in plus direction of the 1st axis only: S_MVAR = 1001, S_MA = 1, S_MD = "
    "0";

constexpr const char* edgeDirections = "thousands of S_MVAR: 1 one direction, 2 two directions";

/// The middle between opposite touches in two directions, and half their distances.
struct Crosswise {
  PlanePlace middle;  ///< of the tool centre points
  double half1 = 0, half2 = 0;
};

class Calibration976 {
public:
  explicit Calibration976(Context& context)
      : context_(context),
        calibration_(context),
        prober_(context.prober()),
        start_(prober_.position()),
        path_(context.real("S_FA")),
        radius_(calibration_.assumedRadius()),
        spindle_(context.channel().machine().spindle().angle) {
    const double angle = atAngle() ? context.real("S_STA1") : 0;
    first_ = probing::directionAt(angle);
    second_ = probing::directionAt(angle + 90);
  }

  void surface();
  enum class Centre { Known, Unknown };
  void ring(Centre ofRing);
  void ball();
  void edge();
  void store() {
    const bool inPlane = context_.digit("S_MVAR", 1) != static_cast<int>(Body::Surface);
    if (inPlane) context_.result(24, atAngle() ? context_.real("S_STA1") : 0);
    calibration_.store();
  }

private:
  /// In rings and on balls only.
  bool atAngle() const {
    const int units = context_.digit("S_MVAR", 1);
    return units >= 1 && units <= 3 && context_.digit("S_MVAR", 6) == 1;
  }
  bool wantsDeviation() const { return context_.digit("S_MVAR", 5) == 0; }
  ProbeCalibration::Deviation deviation() const {
    return wantsDeviation() ? ProbeCalibration::Deviation::Measured : ProbeCalibration::Deviation::Kept;
  }
  bool wantsLength() const { return context_.digit("S_MVAR", 7) == 1; }
  /// A probe that is turned into each direction has no deviation across; others show theirs when turned round.
  bool canReverse() const {
    return !prober_.probe().monodirectional && context_.channel().description().spindleOrients;
  }
  void turn(double degrees) { context_.positionSpindle(spindle_ + degrees); }

  PlanePlace touch(const PartPoint& setpoint, const PlaneWay& direction) {
    return calibration_.touch(setpoint, direction, path_, radius_);
  }
  double sign() {
    const int way = context_.integer("S_MD");
    if (way != 0 && way != 1) context_.alarm(61326, "S_MD is 0 (plus) or 1 (minus)");
    return way == 0 ? 1 : -1;
  }

  Crosswise acrossRing(const PlanePlace& from, double radius);
  Crosswise acrossBall(const PlanePlace& from, double height, double radius);
  double topOfBall(const PlanePlace& over, std::optional<double> expected);
  /// How far the balls of a star stand from its middle, by its tool data; 0 for other probes.
  double starArm() const;
  /// An L-shaped probe.
  bool isBent() const { return context_.control().tool.type == 713; }
  /// The radius of a ball of an L or star, as it is in the tool data for touches along the tool.
  double ballAlongTool() const;
  void finishAtEdge(const PartPoint& edge, const PlaneWay& direction);
  /// The length along the tool that acts as 1 mm along `axis`: more than 1 where the system leans against the tool.
  double lengthPer(int axis) const { return axis == 2 ? 1 / std::max(0.1, std::abs(prober_.toolAxis().z())) : 1; }
  void takeOver(const PlaneWay& deviation, double effective1, double effective2);

  Context& context_;
  ProbeCalibration calibration_;
  probing::SinumerikProber& prober_;
  PlanePlace start_;
  PlaneWay first_, second_;
  double path_, radius_, spindle_;
};

/// Trigger points along the axes of a ball off the spindle axis by `deviation`, with its effective radii along the two
/// directions, whatever angle they were found at.
void Calibration976::takeOver(const PlaneWay& deviation, double effective1, double effective2) {
  calibration_.setTrigger(0, 1, deviation.x() + effective1);
  calibration_.setTrigger(0, -1, deviation.x() - effective1);
  calibration_.setTrigger(1, 1, deviation.y() + effective2);
  calibration_.setTrigger(1, -1, deviation.y() - effective2);
  calibration_.setBallDiameter(effective1 + effective2);
  calibration_.setDeviation(0, deviation.x());
  calibration_.setDeviation(1, deviation.y());
}

void Calibration976::surface() {
  // Without a word on axis and direction: against the tool.
  const bool open = context_.digit("S_MVAR", 4) == 0 && !context_.given("S_MA");
  const int axis = open ? 2 : context_.measuringAxis(3);
  const double way = open ? -1 : sign(), set = context_.real("S_SETV");
  const bool toCentre = prober_.probe().lengthToCentre || axis != 2;
  // The ball of an L is not as large as its reach in the plane.
  const bool bent = axis == 2 && isBent();
  const double ball = ballAlongTool() > 0 ? ballAlongTool() : prober_.ballRadius();
  const double radius = bent ? ball : radius_, reference = toCentre ? radius : 0;
  if (toCentre && !(radius > 0)) context_.alarm(61351, "the radius of the ball must be known: calibrate it first");
  calibration_.list({axis}, ProbeCalibration::Listed::WithLength);
  PartPoint setpoint = partAt(start_);
  setpoint[axis] = set;
  const double tcp = calibration_.touch(setpoint, probing::axisDirection(axis, way), path_, reference)[axis];
  if (wantsLength()) {
    calibration_.correctLength(axis, (tcp - (set - way * reference)) * lengthPer(axis));
    calibration_.setTrigger(axis, way, way * reference);
  } else {
    calibration_.setTrigger(axis, way, set - tcp);
  }
}

double Calibration976::starArm() const {
  const control::sinumerik::ActiveTool& tool = context_.control().tool;
  return tool.type == 714 && ballAlongTool() > 0 ? std::max(0.0, radius_ - ballAlongTool()) : 0;
}

double Calibration976::ballAlongTool() const {
  const control::sinumerik::ActiveTool& tool = context_.control().tool;
  return context_.control().data.number("$TC_DP7", {tool.number, tool.edge});
}

/// Two opposite touches along each direction inside a ring, the second pair through the middle of the first.
Crosswise Calibration976::acrossRing(const PlanePlace& from, double radius) {
  const auto pair = [&](const PlanePlace& centre, const PlaneWay& along) {
    const double upper = along.dot(touch(partAt(centre, along * radius), along) - centre);
    const double lower = along.dot(touch(partAt(centre, -along * radius), -along) - centre);
    return std::pair((upper + lower) / 2, (upper - lower) / 2);
  };
  Crosswise result;
  const auto [middle1, half1] = pair(from, first_);
  result.middle = from + first_ * middle1;
  prober_.moveInPlane(result.middle);
  const auto [middle2, half2] = pair(result.middle, second_);
  result.middle += second_ * middle2;
  prober_.moveInPlane(result.middle);
  // The first pair lay beside the middle: its chord is shorter than the diameter.
  const double arm = starArm();
  result.half1 = std::hypot(half1 + arm, middle2) - arm;
  result.half2 = half2;
  return result;
}

void Calibration976::ring(Centre ofRing) {
  const bool centreKnown = ofRing == Centre::Known;
  const double radius = context_.real("S_SETV") / 2;
  if (!(radius > 0)) context_.alarm(61319, "S_SETV, the diameter of the ring, must be greater than 0");
  calibration_.list({0, 1}, ProbeCalibration::Listed::WithDeviations);
  const int directions = centreKnown ? context_.digit("S_MVAR", 4) : 0;
  if (isBent() && directions != 1) context_.alarm(61309, bentAdvice);
  if (directions == 1) {
    const int axis = context_.measuringAxis(2);
    const double way = sign();
    const PlaneWay along = (axis == 0 ? first_ : second_) * way;
    if (isBent() && along.x() < 1 - 1e-9) context_.alarm(61309, bentAdvice);
    const PlanePlace tcp = touch(partAt(start_, along * radius), along);
    calibration_.setTrigger(axis, way, way * (radius - along.dot(tcp - start_)));
    calibration_.completeAxis(axis, deviation());
    prober_.moveInPlane(start_);
    return;
  }
  if (directions == 2) {
    const int axis = context_.measuringAxis(2);
    const PlaneWay along = axis == 0 ? first_ : second_;
    const double upper = along.dot(touch(partAt(start_, along * radius), along) - start_);
    const double lower = along.dot(touch(partAt(start_, -along * radius), -along) - start_);
    calibration_.setTrigger(axis, 1, radius - upper);
    calibration_.setTrigger(axis, -1, -radius - lower);
    calibration_.completeAxis(axis, deviation());
    prober_.moveInPlane(start_);
    return;
  }
  const bool reverse = !centreKnown && wantsDeviation() && canReverse();
  if (reverse) turn(reversal);
  const Crosswise rough = acrossRing(start_, radius);
  if (reverse) turn(0);
  const Crosswise fine = acrossRing(rough.middle, radius);
  PlanePlace centre = fine.middle;
  if (centreKnown && wantsDeviation()) centre = start_;
  if (reverse) centre = PlanePlace((rough.middle.vector() + fine.middle.vector()) / 2);
  takeOver(centre - fine.middle, radius - fine.half1, radius - fine.half2);
  context_.result(6, centre.x());
  context_.result(7, centre.y());
  prober_.moveInPlane(centre);
}

/// Two opposite touches along each direction around a ball, tool centre point at `height`: over the ball, or round it.
Crosswise Calibration976::acrossBall(const PlanePlace& from, double height, double radius) {
  const auto side = [&](const PlanePlace& centre, const PlaneWay& outward) {
    PartPoint setpoint = partAt(centre, outward * radius);
    setpoint[2] = height;
    const PlanePlace begin = tipAt(setpoint, outward * (path_ + radius_));
    if (prober_.position().z() > height + 1e-6) {
      prober_.moveInPlane(begin);
      prober_.moveHeightTo(height);
    }
    const double found = outward.dot(touch(setpoint, -outward) - centre);
    if (!atAngle()) prober_.moveHeightTo(start_.z());
    return found;
  };
  const auto pair = [&](const PlanePlace& centre, const PlaneWay& along) {
    const double upper = side(centre, along);
    if (atAngle()) prober_.moveOnArc(partAt(centre), 180);
    const double lower = -side(centre, -along);
    return std::pair((upper + lower) / 2, (upper - lower) / 2);
  };
  Crosswise result;
  const auto [middle1, half1] = pair(from, first_);
  result.middle = from + first_ * middle1;
  if (atAngle()) prober_.moveOnArc(partAt(from), -90);
  const auto [middle2, half2] = pair(result.middle, second_);
  result.middle += second_ * middle2;
  result.half1 = std::hypot(half1, middle2);
  result.half2 = half2;
  prober_.moveHeightTo(start_.z());
  prober_.moveInPlane(result.middle);
  return result;
}

/// Height of the tool centre point on top of the ball.
double Calibration976::topOfBall(const PlanePlace& over, std::optional<double> expected) {
  const double reference = prober_.probe().lengthToCentre ? radius_ : 0;
  const PartPoint setpoint(over.x(), over.y(), expected.value_or(start_.z() - path_ - reference));
  const double height = calibration_.touch(setpoint, -PlaneWay::unit(2), path_, reference).z();
  prober_.moveHeightTo(start_.z());
  return height;
}

void Calibration976::ball() {
  const double radius = context_.real("S_SETV") / 2;
  if (!(radius > 0)) context_.alarm(61319, "S_SETV, the diameter of the ball, must be greater than 0");
  if (!(radius_ > 0)) context_.alarm(61351, "the radius of the probe's ball must be in its tool data");
  calibration_.list({0, 1, 2}, ProbeCalibration::Listed::WithDeviationsAndLength);
  const std::optional<double> set = wantsLength() ? std::optional(context_.real("S_SETV0")) : std::nullopt;
  const double down = radius + radius_;

  const double roughTop = topOfBall(start_, set);
  const Crosswise rough = acrossBall(start_, roughTop - down, radius);
  // Over the middle of the first pass the probe's own centre is over the ball's: now the height counts.
  const double top = topOfBall(rough.middle, roughTop + (prober_.probe().lengthToCentre ? -radius_ : 0));
  // The first pass has found the radius of the probe's ball, and with it the height of the equator.
  const double equator = top - (rough.half1 + rough.half2) / 2;
  const Crosswise fine = acrossBall(rough.middle, equator, radius);
  PlanePlace centre = fine.middle;
  if (wantsDeviation() && canReverse()) {
    turn(reversal);
    centre = PlanePlace((fine.middle.vector() + acrossBall(fine.middle, equator, radius).middle.vector()) / 2);
    turn(0);
  }
  takeOver(centre - fine.middle, fine.half1 - radius, fine.half2 - radius);
  if (set) {
    const double effective = (fine.half1 + fine.half2) / 2 - radius;
    const double reference = prober_.probe().lengthToCentre ? effective : 0;
    calibration_.correctLength(2, (top - (*set + reference)) * lengthPer(2));
    calibration_.setTrigger(2, -1, -reference);
  }
  context_.result(6, centre.x());
  context_.result(7, centre.y());
  prober_.moveInPlane(centre);
}

/// The ball's centre to DFA in front of the edge that was touched last; where that leaves less than its radius of room,
/// the ball stays where it is, its surface DFA away.
void Calibration976::finishAtEdge(const PartPoint& edge, const PlaneWay& direction) {
  if (path_ >= 2 * radius_) prober_.moveInPlane(tipAt(edge, -(direction * path_)) - prober_.uprightTcp(direction));
}

void Calibration976::edge() {
  const int directions = context_.digit("S_MVAR", 4);
  const int axis = context_.measuringAxis(2);
  const double set = context_.real("S_SETV");
  calibration_.list({0, 1}, ProbeCalibration::Listed::WithDeviations);
  if (directions == 1) {
    const double way = sign();
    PartPoint setpoint = partAt(start_);
    setpoint[axis] = set;
    calibration_.setTrigger(axis, way, set - touch(setpoint, probing::axisDirection(axis, way))[axis]);
    finishAtEdge(setpoint, probing::axisDirection(axis, way));
  } else if (directions == 2) {
    if (!(set > 0)) context_.alarm(61319, "S_SETV, the distance of the edges, must be greater than 0");
    const PlaneWay along = PlaneWay::unit(axis);
    const auto pair = [&] {
      const double upper = touch(partAt(start_, along * set / 2), along)[axis];
      const double lower = touch(partAt(start_, -along * set / 2), -along)[axis];
      return std::pair((upper + lower) / 2, (upper - lower) / 2);
    };
    double deviation = 0;
    std::optional<double> reversed;
    if (wantsDeviation() && canReverse()) {
      turn(reversal);
      reversed = pair().first;
      turn(0);
    }
    const auto [middle, half] = pair();
    if (reversed) deviation = (*reversed - middle) / 2;
    calibration_.setTrigger(axis, 1, deviation + set / 2 - half);
    calibration_.setTrigger(axis, -1, deviation - (set / 2 - half));
    finishAtEdge(partAt(start_, -along * set / 2), -along);
  } else {
    context_.alarm(61307, edgeDirections);
  }
  calibration_.completeAxis(axis, deviation());
}

constexpr bool alongOneAxis(int code) {
  return variant::digit(code, 1) == 4 || (variant::digit(code, 1) == 1 && variant::digit(code, 4) > 0);
}

constexpr bool hasSize(int code) {
  const bool twoEdges = variant::digit(code, 1) == 4 && variant::digit(code, 4) == 2;
  return twoEdges || (variant::digit(code, 1) >= 1 && variant::digit(code, 1) <= 3);
}

constexpr Requirement requirements[] = {
    {"S_SETV", Need::Positive, hasSize},
    {"S_MA", Need::NotZero, variant::units<0, 4>},
    {"S_MA", Need::Within, alongOneAxis, 1, 2},
};

void combinations(CallCombinations& call) {
  if (call.digit(1) == static_cast<int>(Body::Edge) && call.digit(4) == 0)
    call.refuse("S_MVAR", std::string("S_MVAR does not say how the edge is touched: ") + edgeDirections);
}

/// A surface, or a ring whose centre is known (1) or not (8).
int oldForm(OldCall& call) {
  const int task = call.variant() % 100;
  call.put("S_MD", call.whole("_MD"));
  if (call.digit(3) != 0) call.refuseVariant();
  if (task == 0) {
    call.nothingFrom(6);
    if (call.digit(4) != 0 || call.digit(5) > 1) call.refuseVariant();
    return 1000 + (call.digit(5) == 1 ? 1000000 : 0);
  }
  call.nothingFrom(7);
  if ((task != 1 && task != 8) || call.digit(5) != 0 || call.digit(6) > 1) call.refuseVariant();
  if (task == 8 && call.digit(4) != 0) call.refuseVariant();
  return (task == 1 ? 1 : 2) + call.digit(4) * 1000 + call.digit(6) * 100000;
}

constexpr CycleDefinition definition = {
    .number = 976,
    .name = "CYCLE976",
    .title = "Calibrate workpiece probe: length, ring, ball, edge",
    .family = CycleFamily::Calibration,
    .summary =
        "Calibrates a workpiece probe on a known surface, in a ring, on a ball or on an edge: trigger points, "
        "effective ball diameter, position deviation, and the tool length.",
    .parameters = parameters976,
    .results = results976,
    .controls = control::onSinumerik,
};

void run(Context& context, const Arguments&) {
  const int units = context.digit("S_MVAR", 1);
  if (units > 4 || context.digit("S_MVAR", 2) != 0 || context.digit("S_MVAR", 3) != 0 ||
      context.digit("S_MVAR", 4) > 2 || context.digit("S_MVAR", 5) > 1 || context.digit("S_MVAR", 6) > 1 ||
      context.digit("S_MVAR", 7) > 1) {
    context.alarm(61307);
  }
  const auto body = static_cast<Body>(units);
  switch (body) {
    case Body::Surface:
      context.requireProbe({710, 712, 713, 580});
      break;
    case Body::RingAboutStart:
    case Body::Ring:
      context.requireProbe({710, 712, 713, 714, 580});
      break;
    case Body::Ball:
      context.requireProbe({710, 712, 714, 580});
      break;
    case Body::Edge:
      context.requireProbe({710, 712, 580});
      break;
  }
  Calibration976 calibration(context);
  switch (body) {
    case Body::Surface:
      calibration.surface();
      break;
    case Body::RingAboutStart:
      calibration.ring(Calibration976::Centre::Known);
      break;
    case Body::Ring:
      calibration.ring(Calibration976::Centre::Unknown);
      break;
    case Body::Ball:
      calibration.ball();
      break;
    case Body::Edge:
      calibration.edge();
      break;
  }
  calibration.store();
}

}  // namespace

extern const Entry cycle976 = {.definition = definition,
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .run = run};

}  // namespace probewright::cycles::sinumerik

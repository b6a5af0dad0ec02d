#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "cycles/fit_records.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/measuring_method.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "metrology/elements.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice corners961[] = {{5, "right-angled inside corner"},
                                 {6, "right-angled outside corner"},
                                 {7, "inside corner of any angle"},
                                 {8, "outside corner of any angle"}};
constexpr Choice points961[] = {{0, "points by distances from a pole"}, {1, "points by coordinates"}};
constexpr Choice positions961[] = {
    {0, "corner by the angle of its edge"}, {1, "corner 1"}, {2, "corner 2"}, {3, "corner 3"}, {4, "corner 4"}};
constexpr CodeDigit variant961[] = {{1, 1, "feature", corners961},
                                    {2, 1, "points", points961},
                                    {3, 1, "task", parameters::measureOrShift},
                                    {4, 1, "protection zone", parameters::protectionZone},
                                    {5, 1, "position of the corner", positions961}};

constexpr Parameter parameters961[] = {
    parameters::variant(variant961, 6),
    parameters::turnedOffset(1),
    parameters::dataSet(2),
    parameters::length(3, "S_SETV0", "distance of point 1 from the pole along the 1st edge, or its 1st coordinate"),
    parameters::length(4, "S_SETV1",
                       "distance of point 2 from the pole along the 1st edge, or 2nd coordinate of point 1"),
    parameters::length(5, "S_SETV2",
                       "distance of point 3 from the pole along the 2nd edge, or 1st coordinate of point 2"),
    parameters::length(6, "S_SETV3",
                       "distance of point 4 from the pole along the 2nd edge, or 2nd coordinate of point 2"),
    parameters::length(7, "S_SETV4", "pole in the 1st axis, or 1st coordinate of point 3"),
    parameters::length(8, "S_SETV5", "pole in the 2nd axis, or 2nd coordinate of point 3"),
    parameters::length(9, "S_SETV6", "1st coordinate of point 4"),
    parameters::length(10, "S_SETV7", "2nd coordinate of point 4"),
    parameters::length(11, "S_SETV8", "set value of the corner in the 1st axis"),
    parameters::length(12, "S_SETV9", "set value of the corner in the 2nd axis"),
    parameters::angle(13, "S_STA1", "angle from the 1st axis to the 1st edge"),
    parameters::angle(14, "S_INCA", "angle from the 1st edge to the 2nd"),
    parameters::length(
        15, "S_ID", "distance down to the measuring height at each point (protection zone); its sign does not matter"),
    parameters::measuringPath(16),
    parameters::angle(17, "S_TSA", "safe area: a larger deviation of the 1st edge's angle stops the program"),
    parameters::repetitions(18),
    parameters::reserved(19),
    parameters::plane(20),
    parameters::alternative(21),
};

constexpr std::array results961 = joined(
    std::array{
        ResultDefinition{"_OVR[4]", "angle of the 1st edge to the 1st axis, workpiece coordinates",
                         result::actual(of::angle).main()},
        ResultDefinition{"_OVR[5]", "corner in the 1st axis, workpiece coordinates",
                         result::actual(of::corner1).main()},
        ResultDefinition{"_OVR[6]", "corner in the 2nd axis, workpiece coordinates",
                         result::actual(of::corner2).main()},
        ResultDefinition{"_OVR[20]", "angle of the 1st edge to the 1st axis, machine coordinates",
                         result::actual(of::angle.inMachine())},
        ResultDefinition{"_OVR[21]", "corner in the 1st axis, machine coordinates",
                         result::actual(of::corner1.inMachine())},
        ResultDefinition{"_OVR[22]", "corner in the 2nd axis, machine coordinates",
                         result::actual(of::corner2.inMachine())},
    },
    parameters::zeroOffsetCall, parameters::zeroOffsetOutcome);

/// The least measuring path round corners of any angle, mm.
constexpr double leastPath = 20;

double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The part of `v` at right angles to the unit vector `along`, unit length.
Vector2 squareTo(const Vector2& along, const Vector2& v) { return (v - along * along.dot(v)).normalized(); }

/// The direction in which a surface is touched that faces against `into`: along an axis of the plane, the one that is
/// most nearly at right angles to the surface.
Vector2 alongAxis(const Vector2& into) {
  Eigen::Index axis = 0;
  into.cwiseAbs().maxCoeff(&axis);
  return Vector2::Unit(axis) * (into[axis] < 0 ? -1 : 1);
}

/// Where the lines p + t*d and q + t*e meet; the directions must differ.
Vector2 intersection(const Vector2& p, const Vector2& d, const Vector2& q, const Vector2& e) {
  return p + d * (cross(q - p, e) / cross(d, e));
}

/// Where the touches begin and where the edges run, as the call describes them.
struct Plan {
  Vector2 point[4];  ///< start positions; the right-angled corner has three
  int points = 3;
  Vector2 pole;          ///< from where both edges can be reached
  Vector2 edge1, edge2;  ///< unit, from the corner along the edges
  double axisAngle = 0;  ///< the direction that becomes the 1st axis
};

/// Where the touches lie on the edges, from the pole: points 1 and 2 on the first, 3 and 4 on the second edge. A first
/// distance that is left out is half the second.
struct Distances {
  double along[4];

  Distances(const double (&given)[4], int corner, bool rightAngled) {
    const auto signedAs = [](double length, bool negative) { return negative ? -std::abs(length) : length; };
    for (int i = 0; i < 4; ++i)
      along[i] = signedAs(given[i], corner == 3 || corner == (i < 2 ? 2 : 4));
    if (along[0] == 0) along[0] = along[1] / 2;
    if (along[2] == 0 && rightAngled) along[2] = along[3] / 2;
  }

  /// The argument at which they are no edges, and why; an empty text where they are.
  std::pair<std::string_view, std::string> mistake(bool rightAngled) const {
    const auto [l1, l2, l3, l4] = along;
    if (l1 == l2 || l1 * l2 < 0) return {"S_SETV1", "points 1 and 2 (S_SETV0, S_SETV1) do not lie along one edge"};
    if (l3 == 0 || (!rightAngled && (l3 == l4 || l3 * l4 < 0)))
      return {"S_SETV3", "points 3 and 4 (S_SETV2, S_SETV3) do not lie along one edge"};
    return {};
  }
};

/// The edges as points by coordinates show them: two on the first, one or two on the second.
struct Coordinates {
  Vector2 first = Vector2::Zero(), second = Vector2::Zero();  ///< unit, along the edges
  Vector2 pole = Vector2::Zero();                             ///< where they meet
  Vector2 edge1 = Vector2::Zero(), edge2 = Vector2::Zero();   ///< from the pole to what is touched of each
  /// The argument at which they are no edges, and why; an empty text where they are.
  std::pair<std::string_view, std::string> mistake;

  Coordinates(const Vector2 (&point)[4], bool rightAngled) {
    constexpr double least = 1e-6;  // mm
    first = point[1] - point[0];
    if (first.norm() < least) {
      mistake = {"S_SETV3", "points 1 and 2 (S_SETV0 to S_SETV3) coincide"};
      return;
    }
    first.normalize();
    second = rightAngled ? Vector2(-first.y(), first.x()) : Vector2(point[3] - point[2]);
    if (second.norm() < least || std::abs(cross(first, second.normalized())) < 0.01) {
      mistake = {"S_SETV7", "the points of the two edges (S_SETV0 to S_SETV7) do not enclose an angle"};
      return;
    }
    second.normalize();
    pole = intersection(point[0], first, point[2], second);
    edge1 = first * ((point[0] + point[1]) / 2 - pole).dot(first);
    edge2 = second * (point[2] - pole).dot(second);
    if (edge1.norm() < least)
      mistake = {"S_SETV5", "the second edge runs midway between points 1 and 2: the corner lies to neither side"};
    if (edge2.norm() < least) mistake = {"S_SETV5", "point 3 (S_SETV4, S_SETV5) lies on the line of points 1 and 2"};
  }
};

/// The angle from edge to edge of a corner.
bool isOpening(double degrees) { return std::abs(std::sin(radiansFromDegrees(degrees))) >= 0.01; }

Plan planOf(Context& context) {
  Plan plan;
  const bool rightAngled = context.digit("S_MVAR", 1) <= 6;
  plan.points = rightAngled ? 3 : 4;
  const auto value = [&context](int i) { return context.real(fmt::format("S_SETV{}", i)); };
  if (context.digit("S_MVAR", 2) == 1) {
    for (int i = 0; i < plan.points; ++i)
      plan.point[i] = {value(2 * i), value(2 * i + 1)};
    const Coordinates edges(plan.point, rightAngled);
    if (!edges.mistake.second.empty()) context.alarm(61319, edges.mistake.second);
    plan.pole = edges.pole;
    plan.edge1 = edges.edge1;
    plan.edge2 = edges.edge2;
    plan.axisAngle = degreesFromRadians(std::atan2(edges.first.y(), edges.first.x()));
  } else {
    plan.pole = {value(4), value(5)};
    plan.axisAngle = context.real("S_STA1");
    if (std::abs(plan.axisAngle) > 270) context.alarm(61319, "S_STA1 is between -270 and 270 degrees");
    const double opening = rightAngled ? 90 : context.real("S_INCA");
    if (std::abs(opening) > 180) context.alarm(61319, "S_INCA is between -180 and 180 degrees");
    if (!isOpening(opening)) context.alarm(61319, "S_INCA is not a possible angle of a corner");
    const Vector2 first = probing::directionAt(plan.axisAngle).inPlane();
    const Vector2 second = probing::directionAt(plan.axisAngle + opening).inPlane();
    const Distances distances({value(0), value(1), value(2), value(3)}, context.digit("S_MVAR", 5), rightAngled);
    const auto [l1, l2, l3, l4] = distances.along;
    if (const auto [argument, text] = distances.mistake(rightAngled); !text.empty()) context.alarm(61319, text);
    plan.point[0] = plan.pole + first * l1;
    plan.point[1] = plan.pole + first * l2;
    plan.point[2] = plan.pole + second * l3;
    if (!rightAngled) plan.point[3] = plan.pole + second * l4;
    plan.edge1 = first * l1;
    plan.edge2 = second * l3;
  }
  plan.edge1.normalize();
  plan.edge2.normalize();
  return plan;
}

/// Points by distances from the pole.
constexpr bool byDistances(int code) { return variant::digit(code, 2) == 0; }
constexpr bool cornerOfAnyAngle(int code) { return variant::units<7, 8>(code) && byDistances(code); }

constexpr Requirement requirements[] = {
    {"S_SETV2", Need::NotZero, cornerOfAnyAngle},
    {"S_INCA", Need::NotZero, cornerOfAnyAngle},
    {"S_STA1", Need::Within, byDistances, -270, 270},
    {"S_INCA", Need::Within, cornerOfAnyAngle, -180, 180},
};

void checkDistances(CallCombinations& call) {
  const bool rightAngled = call.digit(1) <= 6;
  if (const auto opening = call.number("S_INCA"); !rightAngled && opening && !isOpening(*opening))
    call.refuse("S_INCA", "S_INCA is not a possible angle of a corner");
  double given[4];
  for (int i = 0; i < 4; ++i) {
    const auto distance = call.number(fmt::format("S_SETV{}", i));
    if (!distance) return;
    given[i] = *distance;
  }
  const Distances distances(given, call.digit(5), rightAngled);
  if (const auto [argument, text] = distances.mistake(rightAngled); !text.empty()) call.refuse(argument, text);
}

void combinations(CallCombinations& call) {
  if (call.digit(2) != 1) return checkDistances(call);
  const int points = call.digit(1) <= 6 ? 3 : 4;
  Vector2 point[4];
  for (int i = 0; i < points; ++i) {
    const auto first = call.number(fmt::format("S_SETV{}", 2 * i)),
               second = call.number(fmt::format("S_SETV{}", 2 * i + 1));
    if (!first || !second) return;
    point[i] = {*first, *second};
  }
  const Coordinates edges(point, points == 3);
  if (const auto& [argument, text] = edges.mistake; !text.empty()) call.refuse(argument, text);
}

/// 105 to 108 by distances from where the probe stands, 117 and 118 by coordinates of four points.
int oldCorner(OldCall& call) {
  const int units = call.digit(1);
  call.nothingFrom(4);
  if (units < 5 || units > 8) call.refuseVariant();
  call.put("S_ID", 0.0);
  if (call.digit(2) == 1) {
    if (units < 7) call.refuseVariant();
    call.setValues(8);
    return 10 + units;
  }
  if (call.digit(2) != 0) call.refuseVariant();
  if (call.whole("_SETV", 0) > 1 || call.element(4) > 1)
    call.refuse(
        "61319",
        fmt::format("_SETV[4] = {} lays the required corner beside the measured one, by _SETV[2] and _SETV[3]; the set "
                    "place of the measured corner is S_SETV8, S_SETV9 now",
                    call.element(4)));
  const PlanePlace pole = call.control().workingPlane().planeFromXyz(call.control().channel.position());
  const double unit = call.control().unit;
  call.put("S_SETV0", call.element(0) / 2);
  call.put("S_SETV1", call.element(0));
  call.put("S_SETV2", call.element(1) / 2);
  call.put("S_SETV3", call.element(1));
  call.put("S_SETV4", pole.x() / unit);
  call.put("S_SETV5", pole.y() / unit);
  const double height = call.number("_ID");
  call.put("S_ID", height);
  return units + (height != 0 ? 1000 : 0);
}

int oldForm(OldCall& call) { return oldCorner(call) + call.task(OldCall::Corrects::ZeroOffsetOnly); }

constexpr Example examples[] = {
    {"S_SETV0", 10}, {"S_SETV1", 40}, {"S_SETV2", 10}, {"S_SETV3", 40}, {"S_TSA", 5},  // degrees
};

constexpr CycleDefinition definition = {
    .number = 961,
    .name = "CYCLE961",
    .title = "Right-angled corner, any corner",
    .family = CycleFamily::Preset,
    .summary =
        "Measures a corner inside or outside by three points (right angle) or four, and shifts and turns the zero "
        "offset so that the corner has its set position and the first edge runs along the first axis.",
    .parameters = parameters961,
    .results = results961,
    .controls = control::onSinumerik,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  const int units = context.digit("S_MVAR", 1);
  if (units == 7 || units == 8) {
    context.requireProbe({710, 580});
  } else {
    context.requireProbe({710, 712, 580});
  }
  context.requireCalibration();
  if (units < 5 || units > 8 || context.digit("S_MVAR", 2) > 1 || context.digit("S_MVAR", 4) > 1 ||
      context.digit("S_MVAR", 5) > 4) {
    context.alarm(61307);
  }
  const auto target = taskOf(context) == Task::ZeroOffset ? frameTarget(context, GlobalBase::Refused) : std::nullopt;
  const bool inside = units == 5 || units == 7;
  const bool zone = context.digit("S_MVAR", 4) == 1;
  const Plan plan = planOf(context);
  const double asked = context.real("S_FA");
  const double path = asked > 0 && plan.points == 4 ? std::max(asked, leastPath) : asked;

  probing::SinumerikProber& prober = context.prober();
  const PlanePlace start = prober.position();
  Toucher toucher(context, Method::Standard);
  const double side = inside ? -1 : 1;
  const Vector2 into1 = alongAxis(side * squareTo(plan.edge1, plan.edge2));
  const Vector2 into2 = alongAxis(side * squareTo(plan.edge2, plan.edge1));
  Vector2 centre[4];
  std::size_t places[4];
  for (int i = 0; i < plan.points; ++i) {
    const Vector2& place = plan.point[i];
    // Without leave to pass over the corner, the way to the second edge leads round it.
    if (i == 2 && !zone) prober.moveInPlane({plan.pole.x(), plan.pole.y(), 0});
    prober.moveInPlane({place.x(), place.y(), 0});
    if (zone) prober.moveHeightTo(start.z() - std::abs(context.real("S_ID")));
    const Vector2 into = i < 2 ? into1 : into2;
    const PlaneWay direction(into.x(), into.y(), 0);
    const PartPoint setpoint = toucher.expectedFrom(prober.position(), direction, path);
    const MeasuredPoint point = toucher.measure(setpoint, direction, path);
    centre[i] = (point.surface - direction * prober.ballRadius()).inPlane();
    places[i] = point.record;
    if (zone) prober.moveHeightTo(start.z());
  }
  if (plan.points == 3) {
    if (!zone) prober.moveInPlane({plan.pole.x(), plan.pole.y(), 0});
    prober.moveInPlane(start);
  }

  for (int i = 0; i + 1 < plan.points; i += 2)
    noteLine(context.channel().journal(), std::span(centre).subspan(static_cast<std::size_t>(i), 2),
             {places[i], places[i + 1]});

  // The ball's centres run beside the edges, one radius away.
  const double radius = prober.ballRadius();
  Vector2 first = (centre[1] - centre[0]).normalized();
  if (first.dot(plan.edge1) < 0) first = -first;
  Vector2 second = plan.points == 4 ? Vector2((centre[3] - centre[2]).normalized()) : Vector2(-first.y(), first.x());
  if (second.dot(plan.edge2) < 0) second = -second;
  const Vector2 corner = intersection(centre[0] + side * squareTo(first, second) * radius, first,
                                      centre[2] + side * squareTo(second, first) * radius, second);
  const bool reversed = first.dot(probing::directionAt(plan.axisAngle).inPlane()) < 0;
  const Vector2 axis = reversed ? Vector2(-first) : first;
  const double angle = degreesFromRadians(std::atan2(axis.y(), axis.x()));

  const PartInMachine onMachine = machinePoint(context, {corner.x(), corner.y(), start.z()});
  const Vector3 inPlane = context.control().workingPlane().planeFromXyz(onMachine.vector());
  const Vector3 axisOnMachine = context.control().workingPlane().planeFromXyz(
      (machinePoint(context, {corner.x() + axis.x(), corner.y() + axis.y(), start.z()}) - onMachine).vector());
  context.result(4, angle, {.nominal = plan.axisAngle});
  context.result(5, corner.x());
  context.result(6, corner.y());
  context.result(20, degreesFromRadians(std::atan2(axisOnMachine.y(), axisOnMachine.x())));
  context.result(21, inPlane.x());
  context.result(22, inPlane.y());
  context.noteCall();
  context.checkSafeArea(normalizedDegrees(angle - plan.axisAngle));

  if (target) {
    correctRotation(context, *target, rotation(Vector3::UnitZ(), angle).linear());
    const PlaneWay directions[] = {PlaneWay::unit(0), PlaneWay::unit(1)};
    correctTranslation(context, *target, onMachine, {context.real("S_SETV8"), context.real("S_SETV9"), 0}, directions);
  }
}

}  // namespace

extern const Entry cycle961 = {.definition = definition,
                               .title = {.byFeature = true},
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .run = run};

}  // namespace probewright::cycles::sinumerik

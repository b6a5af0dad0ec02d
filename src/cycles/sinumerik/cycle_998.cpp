#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/truncated.hpp"
#include "cycles/fit_records.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/measuring_method.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice features998[] = {{5, "edge"}, {6, "plane"}};
constexpr Choice reversal998[] = {{0, "probe as calibrated"}, {1, "with spindle reversal"}};
constexpr Choice ways998[] = {{0, "positions along the expected angle"}, {1, "positions along the axes"}};
constexpr CodeDigit variant998[] = {{1, 1, "feature", features998},
                                    {3, 1, "task", parameters::measureOrShift},
                                    {4, 1, "protection zone", parameters::protectionZone},
                                    {5, 1, "method", reversal998},
                                    {6, 1, "way", ways998}};

constexpr Parameter parameters998[] = {
    parameters::variant(variant998, 5),
    parameters::turnedOffset(1),
    parameters::code(2, "S_RA", "0: correct the rotation; otherwise number of the rotary axis to correct"),
    parameters::dataSet(3),
    parameters::length(
        4, "S_SETV",
        "with protection zone: way along the measuring axis (S_MA), from the start position until S_FA in front of "
        "point 1; where S_MD leaves the measuring direction open, it is this sign, without protection zone the "
        "direction from the probe to this value"),
    parameters::angle(5, "S_STA1", "set angle of the edge, or of the plane about the 1st axis"),
    parameters::angle(6, "S_INCA", "set angle of the plane about the 2nd axis"),
    parameters::measuringPath(7),
    parameters::angle(8, "S_TSA", "safe area: a larger deviation of the angle stops the program"),
    parameters::code(9, "S_MA", "units: measuring axis, hundreds: offset axis", 201),
    parameters::count<2>(10, "S_MD", "measuring direction: 1 plus, 2 minus; 0: by S_SETV"),
    parameters::length(11, "S_ID", "edge: distance of the points in the offset axis"),
    parameters::length(12, "S_SETV0", "plane: distance from point 1 to point 2 in the 1st axis"),
    parameters::length(13, "S_SETV1", "not used"),
    parameters::length(14, "S_SETV2", "plane: distance from point 1 to point 3 in the 1st axis"),
    parameters::length(15, "S_SETV3", "plane: distance from point 1 to point 3 in the 2nd axis"),
    parameters::repetitions(16),
    parameters::code(17, "S_EVNUM", "number of the empirical value (degrees)"),
    parameters::plane(18),
    parameters::alternative(19),
};

/// The measuring variants by the units of S_MVAR.
constexpr std::uint16_t edge = 1 << 5, face = 1 << 6;

constexpr std::array results998 = joined(
    std::array{
        ResultDefinition{"_OVR[0]", {"set ", "angle of the edge"}, result::set(of::angle), edge},
        ResultDefinition{"_OVR[0]", {"set ", "angle of the plane about the 1st axis"}, result::set(of::angle1), face},
        ResultDefinition{"_OVR[1]", {"set ", "angle of the plane about the 2nd axis"}, result::set(of::angle2), face},
        ResultDefinition{"_OVR[4]", {"actual ", "angle of the edge"}, result::actual(of::angle).main(), edge},
        ResultDefinition{
            "_OVR[4]", {"actual ", "angle of the plane about the 1st axis"}, result::actual(of::angle1).main(), face},
        ResultDefinition{
            "_OVR[5]", {"actual ", "angle of the plane about the 2nd axis"}, result::actual(of::angle2).main(), face},
        ResultDefinition{"_OVR[16]", {"difference of the ", "angle of the edge"}, result::difference(of::angle), edge},
        ResultDefinition{"_OVR[16]",
                         {"difference of the ", "plane's angle about the 1st axis"},
                         result::difference(of::angle1),
                         face},
        ResultDefinition{"_OVR[17]",
                         {"difference of the ", "plane's angle about the 2nd axis"},
                         result::difference(of::angle2),
                         face},
        ResultDefinition{"_OVR[20]", "correction angle", result::correction(of::angle)},
        ResultDefinition{"_OVR[21]", "correction angle of the plane about the 1st axis", result::correction(of::angle1),
                         face},
        ResultDefinition{"_OVR[22]", "correction angle of the plane about the 2nd axis", result::correction(of::angle2),
                         face},
        ResultDefinition{"_OVR[23]", "correction angle of the plane about the 3rd axis", result::correction(of::angle),
                         face},
        ResultDefinition{"_OVR[28]", "safe area", result::setting(of::angle)},
        ResultDefinition{"_OVR[30]", "empirical value", result::statistic(of::angle)},
    },
    parameters::zeroOffsetCall,
    std::array{
        ResultDefinition{"_OVI[7]", "number of the empirical value", result::setting()},
    },
    parameters::zeroOffsetOutcome);

constexpr double greatestAngle = 45;

double tangent(double degrees) { return std::tan(radiansFromDegrees(degrees)); }

/// Touches points in one direction from the start height of the measuring axis.
class Steps {
public:
  Steps(Context& context, Toucher& toucher, const PlaneWay& direction)
      : context_(context),
        toucher_(toucher),
        direction_(direction),
        home_(context.prober().position()),
        path_(context.real("S_FA")),
        zone_(context.digit("S_MVAR", 4) == 1),
        infeed_(zone_ ? std::abs(context.real("S_SETV")) : 0) {}

  /// From where the cycle started.
  PartPoint first() { return touchFrom({}); }

  /// `offset` beside the first point, at the same height of the measuring axis.
  PartPoint beside(const PlaneWay& offset) { return touchFrom(offset); }

  /// `offset` beside `point`, where the surface is expected to be `rise` further along the positive measuring axis,
  /// with room for a deviation of `uncertain` degrees.
  PartPoint along(const PartPoint& point, const PlaneWay& offset, double rise, double uncertain) {
    const PlaneWay axis(direction_.vector().cwiseAbs());
    const PartPoint setpoint = point + offset + axis * rise;
    const double path = path_ + offset.norm() * tangent(std::min(std::abs(uncertain), greatestAngle));
    leave(offset);
    return noted(toucher_.measure(setpoint, direction_, path));
  }

  /// Back to the start position of the first point.
  void back() {
    leave({});
    context_.prober().moveTo(home_ + infeedVector());
  }

  /// To DFA in front of the surface at `point`, where the last touch was.
  void finishAt(const PartPoint& point) { context_.prober().moveTo(toucher_.startOf(point, direction_, path_)); }

  /// With a protection zone: above where the cycle started.
  void leave() { leave({}); }

  /// What was touched, each point with the place of its touch in the record.
  const std::vector<std::size_t>& places() const { return places_; }

private:
  PartPoint noted(const MeasuredPoint& point) {
    places_.push_back(point.record);
    return point.surface;
  }

  PlaneWay infeedVector() const { return direction_ * infeed_; }

  /// With a protection zone: back to the start height and over to the next place.
  void leave(const PlaneWay& offset) {
    if (!zone_) return;
    const PlanePlace here = context_.prober().position();
    const PlaneWay axis(direction_.vector().cwiseAbs());
    context_.prober().moveTo(here + axis * axis.dot(home_ - here));
    context_.prober().moveTo(home_ + offset);
  }

  PartPoint touchFrom(const PlaneWay& offset) {
    if (!offset.vector().isZero()) leave(offset);
    const PlanePlace place = home_ + infeedVector() + offset;
    return noted(toucher_.measure(toucher_.expectedFrom(place, direction_, path_), direction_, path_));
  }

  Context& context_;
  Toucher& toucher_;
  PlaneWay direction_;
  PlanePlace home_;
  double path_;
  bool zone_;
  double infeed_;
  std::vector<std::size_t> places_;
};

constexpr const char* reversedInPlane = "spindle reversal measures only in the plane";
constexpr const char* planeAlongTool = "a plane is measured along the tool by the standard method only";
constexpr const char* planeTurns = "a plane corrects rotations only: S_RA = 0";

void correctAngle(Context& context, const FrameTarget& target, const PlaneWay& about, double angle) {
  const int rotaryAxis = context.integer("S_RA");
  if (rotaryAxis == 0) {
    correctRotation(context, target, rotation(about.vector(), angle).linear());
  } else {
    correctRotaryAxis(context, target, static_cast<std::size_t>(rotaryAxis - 1), about, angle);
  }
}

void measureEdge(Context& context, const std::optional<FrameTarget>& target, Method method) {
  const int measuring = context.digit("S_MA", 1) - 1, offset = context.digit("S_MA", 3) - 1;
  if (measuring < 0 || measuring > 2 || offset < 0 || offset > 2 || measuring == offset ||
      context.digit("S_MA", 2) != 0) {
    context.alarm(61325, fmt::format("S_MA = {}", context.integer("S_MA")));
  }
  // With a protection zone S_SETV is a way that begins where the probe stands, else the place of the edge.
  const bool zone = context.digit("S_MVAR", 4) == 1;
  const double from = zone ? 0 : context.prober().position()[measuring];
  const double sign = measuringDirection(context, context.real("S_SETV") - from);
  const double distance = context.real("S_ID"), set = context.real("S_STA1");
  if (!(distance > 0)) context.alarm(61319, "S_ID, the distance of the points, must be greater than 0");
  if (std::abs(set) > greatestAngle) context.alarm(61319, "S_STA1 is between -45 and 45 degrees");
  if (method != Method::Standard && measuring == 2) {
    context.alarm(61307, reversedInPlane);
  }

  // The angle counts from the positive offset axis, counter-clockwise about the third axis.
  const PlaneWay along = PlaneWay::unit(offset), across = PlaneWay::unit(measuring),
                 about = PlaneWay::unit(3 - measuring - offset);
  const double sense = along.cross(across).dot(about);

  const double empirical = target ? empiricalValue(context) : 0;
  const int rotaryAxis = context.integer("S_RA");
  if (target && rotaryAxis != 0) requireRotaryAxis(context, static_cast<std::size_t>(rotaryAxis - 1), about);
  Toucher toucher(context, method);
  Steps steps(context, toucher, across * sign);
  const PartPoint first = steps.first();
  const PartPoint second =
      context.digit("S_MVAR", 6) == 1
          ? steps.beside(along * distance)
          : steps.along(first, along * distance, sense * distance * tangent(set), context.real("S_TSA"));
  if (measuring != 2 && offset != 2) {
    noteLine(context.channel().journal(), std::array<Vector2, 2>{first.inPlane(), second.inPlane()}, steps.places());
  }
  toucher.finish();
  steps.finishAt(second);
  context.setWayBack([&] { steps.leave(); });

  const double actual = degreesFromRadians(sense * std::atan2(across.dot(second - first), along.dot(second - first)));
  const double difference = actual - set - empirical;
  context.result(0, set);
  context.result(4, actual, {.nominal = set});
  context.result(16, difference);
  context.result(28, context.real("S_TSA"));
  context.result(30, empirical);
  context.noteCall();
  if (std::abs(actual) > greatestAngle) context.alarm(61331, fmt::format("{:.3f} degrees", actual));
  context.checkSafeArea(difference);
  if (target) {
    correctAngle(context, *target, about, difference);
    context.result(20, difference);
    context.resultInteger(7, context.integer("S_EVNUM") % 10000);
  }
}

/// The orientation of a plane: turned about the 2nd axis, then about the 1st.
Matrix3 planeOrientation(double aboutFirst, double aboutSecond) {
  return (rotation(Vector3::UnitY(), aboutSecond) * rotation(Vector3::UnitX(), aboutFirst)).linear();
}

void measurePlane(Context& context, const std::optional<FrameTarget>& target, Method method) {
  if (method != Method::Standard) context.alarm(61307, planeAlongTool);
  if (context.integer("S_RA") != 0) context.alarm(61329, planeTurns);
  const double setFirst = context.real("S_STA1"), setSecond = context.real("S_INCA");
  if (std::abs(setFirst) > 60) context.alarm(61319, "S_STA1 of a plane is between -60 and 60 degrees");
  if (std::abs(setSecond) > 30) context.alarm(61319, "S_INCA is between -30 and 30 degrees");
  const PlaneWay toSecond(context.real("S_SETV0"), 0, 0);
  const PlaneWay toThird(context.real("S_SETV2"), context.real("S_SETV3"), 0);
  if (!(toSecond.x() > 0) || !(toThird.y() > 0)) {
    context.alarm(61319, "the distances S_SETV0 and S_SETV3 of the points must be greater than 0");
  }

  const double empirical = target ? empiricalValue(context) : 0;
  Toucher toucher(context, method);
  Steps steps(context, toucher, -PlaneWay::unit(2));
  const PartPoint first = steps.first();
  PartPoint second, third;
  if (context.digit("S_MVAR", 6) == 1) {
    second = steps.beside(toSecond);
    steps.back();
    third = steps.beside(toThird);
  } else {
    const PlaneWay normal(planeOrientation(setFirst, setSecond).col(2));
    const auto riseOf = [&](const PlaneWay& way) { return -normal.dot(way) / normal.z(); };
    second = steps.along(first, toSecond, riseOf(toSecond), context.real("S_TSA"));
    steps.back();
    third = steps.along(first, toThird, riseOf(toThird), context.real("S_TSA"));
  }
  notePlane(context.channel().journal(), std::array{first.vector(), second.vector(), third.vector()}, steps.places());
  steps.finishAt(third);
  context.setWayBack([&] { steps.leave(); });

  const PlaneWay normal = (second - first).cross(third - first).normalized();
  const double actualFirst = degreesFromRadians(std::asin(-normal.y()));
  const double actualSecond = degreesFromRadians(std::atan2(normal.x(), normal.z()));
  const double differenceFirst = actualFirst - setFirst - empirical;
  const double differenceSecond = actualSecond - setSecond - empirical;
  context.result(0, setFirst);
  context.result(1, setSecond);
  context.result(4, actualFirst, {.nominal = setFirst});
  context.result(5, actualSecond, {.nominal = setSecond});
  context.result(16, differenceFirst);
  context.result(17, differenceSecond);
  context.result(28, context.real("S_TSA"));
  context.result(30, empirical);
  context.noteCall();
  if (std::abs(actualFirst) > greatestAngle || std::abs(actualSecond) > greatestAngle) {
    context.alarm(61331, fmt::format("{:.3f} and {:.3f} degrees", actualFirst, actualSecond));
  }
  context.checkSafeArea(differenceFirst);
  context.checkSafeArea(differenceSecond);
  if (target) {
    const Matrix3 turn = planeOrientation(setFirst + differenceFirst, setSecond + differenceSecond) *
                         planeOrientation(setFirst, setSecond).transpose();
    correctRotation(context, *target, turn);
    const Vector3 angles = control::sinumerik::rpyFromRotation(turn);
    context.result(20, degreesFromRadians(Eigen::AngleAxisd(turn).angle()));
    for (int axis = 0; axis < 3; ++axis)
      context.result(21 + axis, angles[axis]);
    context.resultInteger(7, context.integer("S_EVNUM") % 10000);
  }
}

constexpr Requirement requirements[] = {
    {"S_ID", Need::Positive, variant::units<5>},          {"S_SETV0", Need::Positive, variant::units<6>},
    {"S_SETV3", Need::Positive, variant::units<6>},       {"S_STA1", Need::Within, variant::units<5>, -45, 45},
    {"S_STA1", Need::Within, variant::units<6>, -60, 60}, {"S_INCA", Need::Within, variant::units<6>, -30, 30},
    {"S_MA", Need::TwoAxes, variant::units<5>},
};

int oldForm(OldCall& call) {
  call.nothingFrom(7);
  if (call.digit(2) != 0 || call.digit(4) > 1 || call.digit(5) != 0 || call.digit(6) > 1) call.refuseVariant();
  call.setValues(4);
  call.put("S_RA", call.whole("_RA"));
  if (call.digit(1) == 6) call.put("S_SETV", 0.0);
  return call.digit(1) + call.task(OldCall::Corrects::ZeroOffsetOnly) + call.digit(4) * 10000 + call.digit(6) * 100000;
}

constexpr Example examples[] = {
    {"S_TSA", 5},  // degrees
    {"S_ID", 30},
};

constexpr CycleDefinition definition = {
    .number = 998,
    .name = "CYCLE998",
    .title = "Align edge, align plane",
    .family = CycleFamily::Misalignment,
    .summary =
        "Measures the angle of an edge by two points, or of a plane by three, and turns the zero offset, or shifts "
        "a rotary axis, so that it has its set angle.",
    .parameters = parameters998,
    .results = results998,
    .controls = control::onSinumerik,
    .examples = examples,
};

void combinations(CallCombinations& call) {
  const bool plane = call.digit(1) == 6, standard = call.digit(5) == 0;
  const std::string variant = "S_MVAR does not fit together: ", with = " does not fit the measuring variant: ";
  const auto axes = call.number("S_MA"), rotary = call.number("S_RA");
  if (plane && !standard) call.refuse("S_MVAR", variant + planeAlongTool);
  if (plane && rotary && truncated(*rotary) != 0) call.refuse("S_RA", "S_RA" + with + planeTurns);
  if (!plane && !standard && axes && truncated(std::abs(*axes)) % 10 == 3)
    call.refuse("S_MA", "S_MA" + with + reversedInPlane);
}

void run(Context& context, const Arguments&) {
  context.requireProbe({710, 712, 580});
  const int units = context.digit("S_MVAR", 1);
  if ((units != 5 && units != 6) || context.digit("S_MVAR", 4) > 1 || context.digit("S_MVAR", 6) > 1) {
    context.alarm(61307);
  }
  const Method method = methodOf(context);
  if (method == Method::ProbeAligned) context.alarm(61307, "10^4 of S_MVAR");
  requireCalibrationFor(context, method);
  const auto target = taskOf(context) == Task::ZeroOffset ? frameTarget(context, GlobalBase::Refused) : std::nullopt;
  if (units == 5) {
    measureEdge(context, target, method);
  } else {
    measurePlane(context, target, method);
  }
}

}  // namespace

extern const Entry cycle998 = {.definition = definition,
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .run = run};

}  // namespace probewright::cycles::sinumerik

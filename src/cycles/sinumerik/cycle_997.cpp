#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "control/alarm.hpp"
#include "cycles/sinumerik/ball_measurement.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice features997[] = {{9, "ball"}};
constexpr Choice repeat997[] = {{0, "not repeated"}, {1, "repeated about the centre found"}};
constexpr Choice ways997[] = {{0, "along the axes"}, {1, "round the equator"}, {2, "round the equator, probe aligned"}};
constexpr Choice balls997[] = {{0, "one ball"}, {1, "three balls"}};
constexpr Choice points997[] = {{0, "three points"}, {1, "four points"}};
constexpr Choice diameter997[] = {{0, "diameter as set"}, {1, "finds the diameter of the ball"}};
constexpr CodeDigit variant997[] = {
    {1, 1, "feature", features997}, {2, 1, "repetition", repeat997}, {3, 1, "task", parameters::measureOrShift},
    {4, 1, "way", ways997},         {5, 1, "balls", balls997},       {6, 1, "points round the equator", points997},
    {7, 1, "diameter", diameter997}};

constexpr Parameter parameters997[] = {
    parameters::variant(variant997, 9),
    parameters::zeroOffset(1),
    parameters::dataSet(2),
    parameters::length(3, "S_SETV", "set value of the diameter of all balls"),
    parameters::measuringPath(4),
    parameters::safeArea(5),
    parameters::angle(6, "S_STA1", "angle of the first point, round the equator"),
    parameters::angle(7, "S_INCA", "angle from point to point, round the equator"),
    parameters::length(8, "S_SETV0", "set centre of ball 1, 1st axis"),
    parameters::length(9, "S_SETV1", "set centre of ball 1, 2nd axis"),
    parameters::length(10, "S_SETV2", "set centre of ball 1, 3rd axis"),
    parameters::length(11, "S_SETV3", "set centre of ball 2, 1st axis"),
    parameters::length(12, "S_SETV4", "set centre of ball 2, 2nd axis"),
    parameters::length(13, "S_SETV5", "set centre of ball 2, 3rd axis"),
    parameters::length(14, "S_SETV6", "set centre of ball 3, 1st axis"),
    parameters::length(15, "S_SETV7", "set centre of ball 3, 2nd axis"),
    parameters::length(16, "S_SETV8", "set centre of ball 3, 3rd axis"),
    parameters::length(17, "S_TNVL", "limit of the distortion of the triangle of three balls", 1.2),
    parameters::repetitions(18),
    parameters::reserved(19),
    parameters::plane(20),
    parameters::alternative(21),
};

constexpr std::array results997 = joined(
    std::array{
        ResultDefinition{"_OVR[0]", {"set value of the ", "diameter"}, result::set(of::diameter)},
        ResultDefinition{"_OVR[1]", {"set ", "centre of ball 1, 1st axis"}, result::set(of::centre1.number(1))},
        ResultDefinition{"_OVR[2]", {"set ", "centre of ball 1, 2nd axis"}, result::set(of::centre2.number(1))},
        ResultDefinition{"_OVR[3]", {"set ", "centre of ball 1, 3rd axis"}, result::set(of::centre3.number(1))},
        ResultDefinition{"_OVR[4]", "diameter of ball 1", result::actual(of::diameter.number(1)).main()},
        ResultDefinition{"_OVR[5]", "centre of ball 1, 1st axis", result::actual(of::centre1.number(1)).main()},
        ResultDefinition{"_OVR[6]", "centre of ball 1, 2nd axis", result::actual(of::centre2.number(1)).main()},
        ResultDefinition{"_OVR[7]", "centre of ball 1, 3rd axis", result::actual(of::centre3.number(1)).main()},
        ResultDefinition{
            "_OVR[8]", {"difference of the ", "diameter of ball 1"}, result::difference(of::diameter.number(1))},
        ResultDefinition{
            "_OVR[9]", {"difference of the ", "centre of ball 1, 1st axis"}, result::difference(of::centre1.number(1))},
        ResultDefinition{"_OVR[10]",
                         {"difference of the ", "centre of ball 1, 2nd axis"},
                         result::difference(of::centre2.number(1))},
        ResultDefinition{"_OVR[11]",
                         {"difference of the ", "centre of ball 1, 3rd axis"},
                         result::difference(of::centre3.number(1))},
        ResultDefinition{"_OVR[12]", "diameter of ball 2", result::actual(of::diameter.number(2)).main()},
        ResultDefinition{"_OVR[13]", "centre of ball 2, 1st axis", result::actual(of::centre1.number(2)).main()},
        ResultDefinition{"_OVR[14]", "centre of ball 2, 2nd axis", result::actual(of::centre2.number(2)).main()},
        ResultDefinition{"_OVR[15]", "centre of ball 2, 3rd axis", result::actual(of::centre3.number(2)).main()},
        ResultDefinition{
            "_OVR[16]", {"difference of the ", "diameter of ball 2"}, result::difference(of::diameter.number(2))},
        ResultDefinition{"_OVR[17]",
                         {"difference of the ", "centre of ball 2, 1st axis"},
                         result::difference(of::centre1.number(2))},
        ResultDefinition{"_OVR[18]",
                         {"difference of the ", "centre of ball 2, 2nd axis"},
                         result::difference(of::centre2.number(2))},
        ResultDefinition{"_OVR[19]",
                         {"difference of the ", "centre of ball 2, 3rd axis"},
                         result::difference(of::centre3.number(2))},
        ResultDefinition{"_OVR[20]", "diameter of ball 3", result::actual(of::diameter.number(3)).main()},
        ResultDefinition{"_OVR[21]", "centre of ball 3, 1st axis", result::actual(of::centre1.number(3)).main()},
        ResultDefinition{"_OVR[22]", "centre of ball 3, 2nd axis", result::actual(of::centre2.number(3)).main()},
        ResultDefinition{"_OVR[23]", "centre of ball 3, 3rd axis", result::actual(of::centre3.number(3)).main()},
        ResultDefinition{
            "_OVR[24]", {"difference of the ", "diameter of ball 3"}, result::difference(of::diameter.number(3))},
        ResultDefinition{"_OVR[25]",
                         {"difference of the ", "centre of ball 3, 1st axis"},
                         result::difference(of::centre1.number(3))},
        ResultDefinition{"_OVR[26]",
                         {"difference of the ", "centre of ball 3, 2nd axis"},
                         result::difference(of::centre2.number(3))},
        ResultDefinition{"_OVR[27]",
                         {"difference of the ", "centre of ball 3, 3rd axis"},
                         result::difference(of::centre3.number(3))},
        ResultDefinition{"_OVR[28]", "safe area", result::setting(of::distance)},
    },
    parameters::zeroOffsetCall, parameters::zeroOffsetOutcome,
    std::array{
        ResultDefinition{"_OVI[12]", "with an alarm: number of the ball that was being measured", result::status},
    });

PartPoint setCentre(const Context& context, int ball) {
  PartPoint centre;
  for (int axis = 0; axis < 3; ++axis)
    centre[axis] = context.real(fmt::format("S_SETV{}", 3 * ball + axis));
  return centre;
}

using Triangle = std::array<PartPoint, 3>;

/// How much the sides of the triangles differ, added up.
double distortion(const Triangle& a, const Triangle& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    sum += std::abs((a[i] - a[next]).norm() - (b[i] - b[next]).norm());
  }
  return sum;
}

Matrix3 columns(const Triangle& triangle) {
  Matrix3 matrix;
  matrix << triangle[0].vector(), triangle[1].vector(), triangle[2].vector();
  return matrix;
}

/// Turns and shifts the frame so that the three centres come closest to their set positions.
void correctByTriangle(Context& context, const FrameTarget& target, const Triangle& set, const Triangle& actual) {
  const auto middleOf = [](const Triangle& three) {
    return PartPoint((three[0].vector() + three[1].vector() + three[2].vector()) / 3);
  };
  const PartPoint setMiddle = middleOf(set), middle = middleOf(actual);
  const double distorted = distortion(set, actual), limit = context.real("S_TNVL");
  if (distorted > limit + 1e-9) {
    context.alarm(61414, fmt::format("{:.4f} mm, {:.4f} are allowed", distorted, limit));
  }
  const PartInMachine onMachine = machinePoint(context, middle);
  const Eigen::Matrix4d moved = Eigen::umeyama(columns(set), columns(actual), false);
  correctRotation(context, target, moved.topLeftCorner<3, 3>());
  const PlaneWay directions[] = {PlaneWay::unit(0), PlaneWay::unit(1), PlaneWay::unit(2)};
  correctTranslation(context, target, onMachine, setMiddle, directions);
}

constexpr bool roundTheEquator(int code) { return variant::digit(code, 4) > 0; }
constexpr bool threeRound(int code) { return roundTheEquator(code) && variant::digit(code, 6) == 0; }
constexpr bool fourRound(int code) { return roundTheEquator(code) && variant::digit(code, 6) == 1; }

constexpr Requirement requirements[] = {
    {"S_SETV", Need::Positive},
    {"S_INCA", Need::NotZero, roundTheEquator},
    {"S_STA1", Need::Within, roundTheEquator, -360, 360},
    {"S_INCA", Need::Within, threeRound, -120, 120},
    {"S_INCA", Need::Within, fourRound, -90, 90},
};

std::optional<Vector3> ball(const CallCombinations& call, int first) {
  Vector3 centre;
  for (int i = 0; i < 3; ++i) {
    const auto coordinate = call.number(fmt::format("S_SETV{}", first + i));
    if (!coordinate) return std::nullopt;
    centre[i] = *coordinate;
  }
  return centre;
}

void combinations(CallCombinations& call) {
  if (call.digit(5) != 1 || call.digit(3) != 1) return;
  const auto one = ball(call, 0), two = ball(call, 3), three = ball(call, 6);
  if (!one || !two || !three) return;
  if ((*two - *one).cross(*three - *one).norm() < 1e-6)
    call.refuse("S_SETV8", "the set centres of the three balls (S_SETV0 to S_SETV8) lie on one line");
}

int oldForm(OldCall& call) {
  call.nothingFrom(7);
  call.setValues(9);
  if (call.control().data.isSet(OldCall::DataKey("_TNVL", {}))) call.put("S_TNVL", call.number("_TNVL"));
  return call.variant() - call.digit(3) * 100 + call.task(OldCall::Corrects::ZeroOffsetOnly);
}

constexpr TitleSize titleSizes[] = {{"S_SETV"}};

constexpr AlarmText alarms[] = {
    {61414, "The triangle of the three balls is distorted more than allowed",
     "check the set centres of the balls, or enlarge S_TNVL"},
};

constexpr Example examples[] = {
    {"S_SETV", 25},
};

constexpr CycleDefinition definition = {
    .number = 997,
    .name = "CYCLE997",
    .title = "Ball, three balls",
    .family = CycleFamily::Preset,
    .summary =
        "Measures centre and diameter of a ball, or of three balls on one workpiece, and corrects the zero offset: "
        "its translation by one ball, translation and rotation by three.",
    .parameters = parameters997,
    .results = results997,
    .controls = control::onSinumerik,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  context.requireProbe({710, 580});
  context.requireCalibration();
  const auto digit = [&context](int place) { return context.digit("S_MVAR", place); };
  if (digit(1) != 9 || digit(2) > 1 || digit(4) > 2 || digit(5) > 1 || digit(6) > 1 || digit(7) > 1) {
    context.alarm(61307);
  }
  const std::size_t count = digit(5) == 1 ? 3 : 1;
  const auto target = taskOf(context) == Task::ZeroOffset
                          ? frameTarget(context, count == 3 ? GlobalBase::Refused : GlobalBase::Allowed)
                          : std::nullopt;
  BallPlan plan = {
      .diameter = context.real("S_SETV"),
      .points = digit(6) == 1 ? 4 : 3,
      .round = digit(4) > 0,
      .startAngle = context.real("S_STA1"),
      .step = context.real("S_INCA"),
      .alignProbe = digit(4) == 2,
      .repeat = digit(2) == 1,
      .findDiameter = digit(7) == 1,
      .safeHeight = context.prober().position().z(),
      .path = context.real("S_FA"),
  };
  if (!(plan.diameter > 0)) context.alarm(61319, "S_SETV, the diameter, must be greater than 0");
  if (plan.round && (plan.step == 0 || std::abs(plan.step) * plan.points > 360)) {
    context.alarm(61319, fmt::format("S_INCA: more than 0, at most {} degrees", 360 / plan.points));
  }

  if (plan.round && (std::abs(plan.startAngle) > 360 || plan.startAngle + (plan.points - 1) * plan.step > 360)) {
    context.alarm(61319, "S_STA1 is between -360 and 360 degrees, and with all steps of S_INCA at most 360");
  }

  Triangle set, actual;
  for (std::size_t ball = 0; ball < count; ++ball)
    set[ball] = setCentre(context, static_cast<int>(ball));
  if (target && count == 3 && (set[1] - set[0]).cross(set[2] - set[0]).norm() < 1e-6) {
    context.alarm(61319, "the set centres of the three balls lie on one line");
  }
  for (std::size_t ball = 0; ball < count; ++ball) {
    plan.centre = set[ball];
    context.prober().moveInPlane(tipAt(plan.centre));
    context.markFailing(static_cast<int>(ball) + 1);
    const MeasuredBall measured = measureBall(context, plan);
    actual[ball] = measured.centre;
    if (ball == 0) {
      context.result(0, plan.diameter);
      for (int axis = 0; axis < 3; ++axis)
        context.result(1 + axis, set[0][axis]);
    }
    const int first = 4 + 8 * static_cast<int>(ball);
    context.result(first, measured.diameter, {.nominal = plan.diameter});
    context.result(first + 4, measured.diameter - plan.diameter);
    for (int axis = 0; axis < 3; ++axis) {
      context.result(first + 1 + axis, measured.centre[axis], {.nominal = plan.centre[axis]});
      context.result(first + 5 + axis, measured.centre[axis] - plan.centre[axis]);
    }
    context.checkSafeArea(measured.diameter - plan.diameter);
    for (int axis = 0; axis < 3; ++axis)
      context.checkSafeArea(measured.centre[axis] - plan.centre[axis]);
  }
  context.markFailing(0);
  context.result(28, context.real("S_TSA"));
  context.noteCall();

  if (target && count == 3) correctByTriangle(context, *target, set, actual);
  if (target && count == 1) {
    const PlaneWay directions[] = {PlaneWay::unit(0), PlaneWay::unit(1), PlaneWay::unit(2)};
    correctTranslation(context, *target, machinePoint(context, actual[0]), set[0], directions);
  }
}

}  // namespace

extern const Entry cycle997 = {.definition = definition,
                               .title = {.byFeature = true, .sizes = titleSizes},
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .alarms = alarms,
                               .run = run};

}  // namespace probewright::cycles::sinumerik

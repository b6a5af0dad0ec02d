#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <string>

#include "base/truncated.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/kinematics_measurement.hpp"
#include "cycles/sinumerik/parameters.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice tasks996[] = {
    {0, "calculate the kinematics"}, {1, "1st measurement"}, {2, "2nd measurement"}, {3, "3rd measurement"}};
constexpr Choice ways996[] = {
    {0, "ball along the axes"}, {1, "round the ball's equator"}, {2, "round the equator, probe aligned"}};
constexpr Choice targets996[] = {{0, "swivel data set stays as it is"}, {1, "vectors go into the swivel data set"}};
constexpr Choice axes996[] = {
    {0, "closed chain of vectors"}, {1, "rotary axis 1"}, {2, "rotary axis 2"}, {3, "open chain of vectors"}};
constexpr Choice normalise1[] = {{0, "rotary axis 1 not normalised"},
                                 {1, "rotary axis 1 normalised along the 1st axis"},
                                 {2, "rotary axis 1 normalised along the 2nd axis"},
                                 {3, "rotary axis 1 normalised along the 3rd axis"}};
constexpr Choice normalise2[] = {{0, "rotary axis 2 not normalised"},
                                 {1, "rotary axis 2 normalised along the 1st axis"},
                                 {2, "rotary axis 2 normalised along the 2nd axis"},
                                 {3, "rotary axis 2 normalised along the 3rd axis"}};
constexpr Choice logs996[] = {{0, "no log"}, {1, "log"}};
constexpr CodeDigit variant996[] = {{1, 1, "task", tasks996},
                                    {3, 1, "way", ways996},
                                    {4, 1, "target", targets996},
                                    {5, 1, "axis", axes996},
                                    {6, 1, "rotary axis 1", normalise1},
                                    {7, 1, "rotary axis 2", normalise2},
                                    {8, 1, "log", logs996}};

constexpr Choice tolerance996[] = {{0, "no tolerance"}, {1, "S_SETV4 and S_SETV5 are tolerances"}};
constexpr Choice asked996[] = {{0, "the operator is asked"}, {1, "vectors are entered at once"}};
constexpr Choice shown996[] = {{0, "data set not shown"}, {1, "data set shown"}};
constexpr Choice edited996[] = {{0, "not editable"}, {1, "editable"}};
constexpr CodeDigit alternatives996[] = {{1, 1, "tolerance", tolerance996},
                                         {2, 1, "confirmation", asked996},
                                         {3, 1, "display", shown996},
                                         {4, 1, "editing", edited996}};

constexpr Parameter limitOfTriangle = [] {
  Parameter limit = parameters::angle(11, "S_TNVL", "least angle of the triangle of the three balls, 1 to 60");
  limit.standard = 20;
  return limit;
}();

constexpr Parameter parameters996[] = {
    parameters::variant(variant996, 1),
    parameters::code(1, "S_TC", "number of the swivel data set ($TC_CARR)"),
    parameters::dataSet(2),
    parameters::length(3, "S_SETV", "diameter of the calibration ball"),
    parameters::angle(4, "S_STA1", "angle of the first point, round the equator"),
    parameters::angle(5, "S_SETV0", "position of rotary axis 1 where it is turned by hand"),
    parameters::angle(6, "S_SETV1", "position of rotary axis 2 where it is turned by hand"),
    parameters::length(7, "S_SETV2", "coordinate that rotary axis 1 is normalised to"),
    parameters::length(8, "S_SETV3", "coordinate that rotary axis 2 is normalised to"),
    parameters::distance(9, "S_SETV4", "tolerance TLIN of the offset vectors I1 to I4"),
    parameters::angle(10, "S_SETV5", "tolerance TROT of the rotary axis vectors V1 and V2"),
    limitOfTriangle,
    parameters::measuringPath(12),
    parameters::safeArea(13),
    parameters::repetitions(14),
    parameters::reserved(15),
    parameters::plane(16),
    parameters::coded(17, "_AMODE", "alternative mode of the calculation", alternatives996),
};

constexpr std::uint16_t calculating = 1, measuring = 14, third = 8;
constexpr std::array alongs = {of::Along::X, of::Along::Y, of::Along::Z};

constexpr of::Characteristic vector(std::uint8_t n, std::size_t axis) {
  return {of::Quantity::Distance, alongs[axis], n};
}
/// Without a unit.
constexpr of::Characteristic direction(std::uint8_t n, std::size_t axis) {
  return {of::Quantity::None, alongs[axis], n};
}
constexpr of::Characteristic ball(std::uint8_t n, std::size_t axis) {
  return of::Characteristic{of::Quantity::Centre, alongs[axis], n}.inMachine();
}

constexpr ResultDefinition results996[] = {
    {.name = "_OVR[1]",
     .meaning = "offset vector I1, X",
     .kind = result::actual(vector(1, 0)).main(),
     .variants = calculating},
    {.name = "_OVR[2]",
     .meaning = "offset vector I1, Y",
     .kind = result::actual(vector(1, 1)).main(),
     .variants = calculating},
    {.name = "_OVR[3]",
     .meaning = "offset vector I1, Z",
     .kind = result::actual(vector(1, 2)).main(),
     .variants = calculating},
    {.name = "_OVR[4]",
     .meaning = "offset vector I2, X",
     .kind = result::actual(vector(2, 0)).main(),
     .variants = calculating},
    {.name = "_OVR[5]",
     .meaning = "offset vector I2, Y",
     .kind = result::actual(vector(2, 1)).main(),
     .variants = calculating},
    {.name = "_OVR[6]",
     .meaning = "offset vector I2, Z",
     .kind = result::actual(vector(2, 2)).main(),
     .variants = calculating},
    {.name = "_OVR[15]",
     .meaning = "offset vector I3, X",
     .kind = result::actual(vector(3, 0)).main(),
     .variants = calculating},
    {.name = "_OVR[16]",
     .meaning = "offset vector I3, Y",
     .kind = result::actual(vector(3, 1)).main(),
     .variants = calculating},
    {.name = "_OVR[17]",
     .meaning = "offset vector I3, Z",
     .kind = result::actual(vector(3, 2)).main(),
     .variants = calculating},
    {.name = "_OVR[18]",
     .meaning = "offset vector I4, X",
     .kind = result::actual(vector(4, 0)).main(),
     .variants = calculating},
    {.name = "_OVR[19]",
     .meaning = "offset vector I4, Y",
     .kind = result::actual(vector(4, 1)).main(),
     .variants = calculating},
    {.name = "_OVR[20]",
     .meaning = "offset vector I4, Z",
     .kind = result::actual(vector(4, 2)).main(),
     .variants = calculating},
    {.name = "_OVR[7]",
     .meaning = "rotary axis vector V1, X",
     .kind = result::actual(direction(1, 0)),
     .variants = calculating},
    {.name = "_OVR[8]",
     .meaning = "rotary axis vector V1, Y",
     .kind = result::actual(direction(1, 1)),
     .variants = calculating},
    {.name = "_OVR[9]",
     .meaning = "rotary axis vector V1, Z",
     .kind = result::actual(direction(1, 2)),
     .variants = calculating},
    {.name = "_OVR[10]",
     .meaning = "rotary axis vector V2, X",
     .kind = result::actual(direction(2, 0)),
     .variants = calculating},
    {.name = "_OVR[11]",
     .meaning = "rotary axis vector V2, Y",
     .kind = result::actual(direction(2, 1)),
     .variants = calculating},
    {.name = "_OVR[12]",
     .meaning = "rotary axis vector V2, Z",
     .kind = result::actual(direction(2, 2)),
     .variants = calculating},
    {.name = "_OVR[32]",
     .meaning = "vector to rotary axis 1, not normalised, X",
     .kind = result::actual(vector(5, 0)),
     .variants = calculating | third},
    {.name = "_OVR[33]",
     .meaning = "vector to rotary axis 1, not normalised, Y",
     .kind = result::actual(vector(5, 1)),
     .variants = calculating | third},
    {.name = "_OVR[34]",
     .meaning = "vector to rotary axis 1, not normalised, Z",
     .kind = result::actual(vector(5, 2)),
     .variants = calculating | third},
    {.name = "_OVR[35]",
     .meaning = "vector to rotary axis 2, not normalised, X",
     .kind = result::actual(vector(6, 0)),
     .variants = calculating | third},
    {.name = "_OVR[36]",
     .meaning = "vector to rotary axis 2, not normalised, Y",
     .kind = result::actual(vector(6, 1)),
     .variants = calculating | third},
    {.name = "_OVR[37]",
     .meaning = "vector to rotary axis 2, not normalised, Z",
     .kind = result::actual(vector(6, 2)),
     .variants = calculating | third},
    {.name = "_OVR[40]",
     .meaning = "measurements done: units of rotary axis 1, tens of rotary axis 2",
     .kind = result::status},
    {.name = "_OVR[41]",
     .meaning = "centre of the ball, measurement 1 of rotary axis 1, X, machine coordinates",
     .kind = result::actual(ball(1, 0)).main(),
     .variants = measuring},
    {.name = "_OVR[42]",
     .meaning = "centre of the ball, measurement 1 of rotary axis 1, Y, machine coordinates",
     .kind = result::actual(ball(1, 1)).main(),
     .variants = measuring},
    {.name = "_OVR[43]",
     .meaning = "centre of the ball, measurement 1 of rotary axis 1, Z, machine coordinates",
     .kind = result::actual(ball(1, 2)).main(),
     .variants = measuring},
    {.name = "_OVR[44]",
     .meaning = "centre of the ball, measurement 2 of rotary axis 1, X, machine coordinates",
     .kind = result::actual(ball(2, 0)).main(),
     .variants = measuring},
    {.name = "_OVR[45]",
     .meaning = "centre of the ball, measurement 2 of rotary axis 1, Y, machine coordinates",
     .kind = result::actual(ball(2, 1)).main(),
     .variants = measuring},
    {.name = "_OVR[46]",
     .meaning = "centre of the ball, measurement 2 of rotary axis 1, Z, machine coordinates",
     .kind = result::actual(ball(2, 2)).main(),
     .variants = measuring},
    {.name = "_OVR[47]",
     .meaning = "centre of the ball, measurement 3 of rotary axis 1, X, machine coordinates",
     .kind = result::actual(ball(3, 0)).main(),
     .variants = measuring},
    {.name = "_OVR[48]",
     .meaning = "centre of the ball, measurement 3 of rotary axis 1, Y, machine coordinates",
     .kind = result::actual(ball(3, 1)).main(),
     .variants = measuring},
    {.name = "_OVR[49]",
     .meaning = "centre of the ball, measurement 3 of rotary axis 1, Z, machine coordinates",
     .kind = result::actual(ball(3, 2)).main(),
     .variants = measuring},
    {.name = "_OVR[51]",
     .meaning = "centre of the ball, measurement 1 of rotary axis 2, X, machine coordinates",
     .kind = result::actual(ball(4, 0)).main(),
     .variants = measuring},
    {.name = "_OVR[52]",
     .meaning = "centre of the ball, measurement 1 of rotary axis 2, Y, machine coordinates",
     .kind = result::actual(ball(4, 1)).main(),
     .variants = measuring},
    {.name = "_OVR[53]",
     .meaning = "centre of the ball, measurement 1 of rotary axis 2, Z, machine coordinates",
     .kind = result::actual(ball(4, 2)).main(),
     .variants = measuring},
    {.name = "_OVR[54]",
     .meaning = "centre of the ball, measurement 2 of rotary axis 2, X, machine coordinates",
     .kind = result::actual(ball(5, 0)).main(),
     .variants = measuring},
    {.name = "_OVR[55]",
     .meaning = "centre of the ball, measurement 2 of rotary axis 2, Y, machine coordinates",
     .kind = result::actual(ball(5, 1)).main(),
     .variants = measuring},
    {.name = "_OVR[56]",
     .meaning = "centre of the ball, measurement 2 of rotary axis 2, Z, machine coordinates",
     .kind = result::actual(ball(5, 2)).main(),
     .variants = measuring},
    {.name = "_OVR[57]",
     .meaning = "centre of the ball, measurement 3 of rotary axis 2, X, machine coordinates",
     .kind = result::actual(ball(6, 0)).main(),
     .variants = measuring},
    {.name = "_OVR[58]",
     .meaning = "centre of the ball, measurement 3 of rotary axis 2, Y, machine coordinates",
     .kind = result::actual(ball(6, 1)).main(),
     .variants = measuring},
    {.name = "_OVR[59]",
     .meaning = "centre of the ball, measurement 3 of rotary axis 2, Z, machine coordinates",
     .kind = result::actual(ball(6, 2)).main(),
     .variants = measuring},
    {.name = "_OVR[60]",
     .meaning = "position of rotary axis 1 at measurement 1",
     .kind = result::setting(of::tableAngle.number(1)),
     .variants = measuring},
    {.name = "_OVR[61]",
     .meaning = "position of rotary axis 1 at measurement 2",
     .kind = result::setting(of::tableAngle.number(2)),
     .variants = measuring},
    {.name = "_OVR[62]",
     .meaning = "position of rotary axis 1 at measurement 3",
     .kind = result::setting(of::tableAngle.number(3)),
     .variants = measuring},
    {.name = "_OVR[63]",
     .meaning = "position of rotary axis 2 at measurement 1",
     .kind = result::setting(of::tableAngle.number(4)),
     .variants = measuring},
    {.name = "_OVR[64]",
     .meaning = "position of rotary axis 2 at measurement 2",
     .kind = result::setting(of::tableAngle.number(5)),
     .variants = measuring},
    {.name = "_OVR[65]",
     .meaning = "position of rotary axis 2 at measurement 3",
     .kind = result::setting(of::tableAngle.number(6)),
     .variants = measuring},
    {.name = "_OVR[66]",
     .meaning = "rotation of the zero offset about X",
     .kind = result::setting(of::angleX),
     .variants = measuring},
    {.name = "_OVR[67]",
     .meaning = "rotation of the zero offset about Y",
     .kind = result::setting(of::angleY),
     .variants = measuring},
    {.name = "_OVR[68]",
     .meaning = "rotation of the zero offset about Z",
     .kind = result::setting(of::angleZ),
     .variants = measuring},
    {.name = "_OVR[71]",
     .meaning = "diameter of the ball",
     .kind = result::actual(of::diameter),
     .variants = measuring},
    {.name = "_OVI[2]", .meaning = "number of the cycle", .kind = result::status},
    {.name = "_OVI[3]", .meaning = "measuring variant", .kind = result::setting()},
    {.name = "_OVI[8]", .meaning = "number of the swivel data set", .kind = result::setting()},
    {.name = "_OVI[9]", .meaning = "number of the alarm", .kind = result::status},
};

constexpr bool calculates(int code) { return variant::digit(code, 1) == 0; }
constexpr bool measures(int code) { return !calculates(code); }
constexpr bool roundTheEquator(int code) { return measures(code) && variant::digit(code, 3) > 0; }

constexpr Requirement requirements[] = {
    {"S_TC", Need::Positive},
    {"S_SETV", Need::Positive, measures},
    {"S_STA1", Need::Within, roundTheEquator, 0, 360},
    {"S_TNVL", Need::Within, calculates, 0, 60},
};

/// What is wrong with the digits together; empty if nothing is.
std::string wrongVariant(int code) {
  const int axis = variant::digit(code, 5);
  if (measures(code)) {
    if (axis != 1 && axis != 2) return "10^4 of S_MVAR is 1 or 2 in a measurement: the rotary axis";
    if (code / 100'000 != 0 || variant::digit(code, 4) != 0)
      return "the digits 10^3 and from 10^5 on of S_MVAR belong to the calculation";
    return {};
  }
  if (axis == 1 || axis == 2) return "10^4 of S_MVAR is 0 or 3 in the calculation: chain of vectors closed or open";
  if (variant::digit(code, 3) != 0) return "10^2 of S_MVAR belongs to the measurements";
  return {};
}

void combinations(CallCombinations& call) {
  int code = 0;
  for (int place = 8; place > 0; --place)
    code = 10 * code + call.digit(place);
  if (const std::string wrong = wrongVariant(code); !wrong.empty()) call.refuse("S_MVAR", wrong);
  if (measures(code)) return;
  const auto least = call.number("S_TNVL");
  if (least && *least > 0 && *least < 1) call.refuse("S_TNVL", "S_TNVL is between 1 and 60 degrees; 0 counts as 20");
  if (least && *least >= 1 && *least < 20)
    call.warn("S_TNVL", "below 20 degrees of S_TNVL micrometres of the probe make the vectors of the axes inaccurate");
  const auto mode = call.number("_AMODE");
  if (!mode) return;
  const int digits = truncated(*mode);
  if (variant::digit(digits, 2) == 1 && digits / 100 != 0)
    call.warn("_AMODE", "the operator is asked all the same: 10 in _AMODE acts with 0 in hundreds and thousands only");
  if (variant::digit(digits, 4) == 1 && variant::digit(digits, 3) == 0)
    call.warn("_AMODE", "a data set that is not shown cannot be edited: 1000 in _AMODE acts with 100 only");
}

constexpr AlarmText alarms[] = {
    {61430, "The vectors of the kinematics were not calculated", "measure each rotary axis three times, far apart"},
};

constexpr Example examples[] = {
    {"S_MVAR", 10001},  // 1st measurement of rotary axis 1
    {"S_TC", 1},
    {"S_SETV", 25},
};

constexpr CycleDefinition definition = {
    .number = 996,
    .name = "CYCLE996",
    .title = "Measure kinematics",
    .family = CycleFamily::Kinematics,
    .summary =
        "Measures a calibration ball at three positions of each rotary axis, a call each, and calculates the vectors "
        "of the swivel data set (orientable tool carrier) of it, which it compares, logs and enters.",
    .parameters = parameters996,
    .results = results996,
    .controls = control::onSinumerik,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  const int code = std::abs(context.integer("S_MVAR"));
  if (const std::string wrong = wrongVariant(code); !wrong.empty()) context.alarm(61307, wrong);
  if (calculates(code)) return calculateKinematics(context);
  measureKinematics(context);
}

}  // namespace

extern const Entry cycle996 = {.definition = definition,
                               .title = {.byFeature = true},
                               .requirements = requirements,
                               .combinations = combinations,
                               .alarms = alarms,
                               .computes = calculates,
                               .run = run};

}  // namespace probewright::cycles::sinumerik

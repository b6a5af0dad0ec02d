#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "control/alarm.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/context.hpp"
#include "cycles/sinumerik/corrections.hpp"
#include "cycles/sinumerik/lathe_measurement.hpp"
#include "cycles/sinumerik/lathe_tool.hpp"
#include "cycles/sinumerik/lathe_tool_touches.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/tool_probe_data.hpp"
#include "cycles/sinumerik/tool_results.hpp"

namespace probewright::cycles::sinumerik {

namespace {

constexpr Choice tasks982[] = {
    {0, "calibrate the tool touch probe"}, {1, "measure the tool along one axis"}, {2, "measure the tool completely"}};
constexpr Choice systems982[] = {{0, "in the machine's coordinates"}, {1, "in the workpiece's coordinates"}};
constexpr Choice reversal982[] = {{0, "mill without reversal"}, {1, "mill with reversal"}};
constexpr Choice quantities982[] = {{0, "length, or completely lengths and radius"},
                                    {1, "radius of a mill"},
                                    {2, "length and radius of a mill"},
                                    {3, "rear side, lengths and radius of a disc cutter"}};
constexpr Choice lies982[] = {{0, "axial: radius along the 2nd axis"}, {1, "radial: radius along the 1st axis"}};
constexpr Choice incremental982[] = {{0, "approaches the contact"}, {1, "incremental, from where the tool is"}};
constexpr Choice angle982[] = {{0, "spindle as it is"}, {1, "spindle to S_STA1"}};
constexpr CodeDigit variant982[] = {{1, 1, "task", tasks982},
                                    {2, 1, "system", systems982},
                                    {3, 1, "reversal", reversal982},
                                    {4, 1, "quantities", quantities982},
                                    {5, 1, "mill or drill lies", lies982},
                                    {6, 1, "way", incremental982},
                                    {7, 1, "start angle", angle982}};
constexpr Choice targets982[] = {{0, "geometry, the wear becomes 0"}, {1, "wear"}};
constexpr CodeDigit correction982[] = {{1, 1, "corrects", targets982}};
constexpr Choice tools982[] = {{0, "turning tool"}, {1, "mill"}, {2, "drill"}};
constexpr Choice approaches982[] = {{0, "from plus"}, {1, "from minus"}};
constexpr CodeDigit display982[] = {{.place = 1, .width = 1, .meaning = "plane", .most = 3},
                                    {.place = 2, .width = 1, .meaning = "cutting edge position", .most = 9},
                                    {3, 1, "tool", tools982},
                                    {4, 1, "complete measurement approaches across the tool", approaches982}};

constexpr Parameter parameters982[] = {
    parameters::variant(variant982),
    parameters::coded(1, "S_KNUM", "what of the tool is corrected", correction982),
    parameters::count<6>(2, "S_PRNUM", "data field of the tool touch probe, 1 to 6; 0 counts as 1", 1),
    parameters::count<2>(3, "S_MA", "measuring axis: 1st or 2nd axis of the plane"),
    parameters::count<2>(4, "S_MD", "measuring direction: 0 from where the tool stands, 1 plus, 2 minus"),
    parameters::length(5, "S_ID",
                       "how far the side of a mill or drill goes beyond the "
                       "middle of the contact"),
    parameters::measuringPath(6),
    parameters::safeArea(7),
    parameters::feed(8, "S_VMS", "measuring feed; 0: of calibration or, calibrating, of SD 55628"),
    parameters::angle(9, "S_STA1", "angle of the tool spindle for mills"),
    parameters::angle(10, "S_CORA", "correction angle of the reversal, added to half a turn"),
    parameters::zeroOffsetRange(11),
    parameters::dimensionalDifference(12),
    parameters::repetitions(13),
    parameters::count<20>(14, "S_EVNUM", "number of the empirical value, 1 to 20; 0: none"),
    parameters::reserved(15),
    parameters::coded(16, "_DMODE", "plane, and what the screen shows", display982),
    parameters::alternative(17),
};

constexpr std::uint16_t calibration = 1U << 0, measurement = 1U << 1 | 1U << 2;

constexpr ResultDefinition results982[] = {
    {"_OVR[8]", "trigger point, minus direction, 1st axis", result::touched(of::position1.number(1)).fallback(),
     calibration},
    {"_OVR[9]", "its difference", result::difference(of::position1.number(1)), calibration},
    {"_OVR[10]", "trigger point, plus direction, 1st axis", result::touched(of::position1.number(2)).fallback(),
     calibration},
    {"_OVR[11]", "its difference", result::difference(of::position1.number(2)), calibration},
    {"_OVR[12]", "trigger point, minus direction, 2nd axis", result::touched(of::position2.number(1)).fallback(),
     calibration},
    {"_OVR[13]", "its difference", result::difference(of::position2.number(1)), calibration},
    {"_OVR[14]", "trigger point, plus direction, 2nd axis", result::touched(of::position2.number(2)).fallback(),
     calibration},
    {"_OVR[15]", "its difference", result::difference(of::position2.number(2)), calibration},
    {"_OVR[8]", {"actual value, ", "length 1"}, result::actual(of::length1).main(), measurement},
    {"_OVR[9]", {"difference, ", "length 1"}, result::difference(of::length1), measurement},
    {"_OVR[10]", {"actual value, ", "length 2"}, result::actual(of::length2).main(), measurement},
    {"_OVR[11]", {"difference, ", "length 2"}, result::difference(of::length2), measurement},
    {"_OVR[12]", {"actual value, ", "radius"}, result::actual(of::radius).main(), measurement},
    {"_OVR[13]", {"difference, ", "radius"}, result::difference(of::radius), measurement},
    {"_OVR[27]", "zero offset range", result::setting(of::distance)},
    {"_OVR[28]", "safe area", result::setting(of::distance)},
    {"_OVR[29]", "dimensional difference", result::setting(of::distance), measurement},
    {"_OVR[30]", "empirical value", result::statistic(of::distance), measurement},
    {"_OVI[0]", "number of the edge (D)", result::setting(), measurement},
    {"_OVI[2]", "number of the cycle", result::status},
    {"_OVI[3]", "measuring variant", result::setting()},
    {"_OVI[5]", "data field of the tool touch probe", result::setting()},
    {"_OVI[7]", "number of the empirical value", result::setting(), measurement},
    {"_OVI[8]", "number of the tool", result::setting(), measurement},
    {"_OVI[9]", "number of the alarm or message", result::status},
    {"_OVS_TNAME", "name of the tool", result::setting(of::name), measurement},
};

constexpr Requirement requirements[] = {
    {"S_MA", Need::NotZero, variant::units<0, 1>},
};

constexpr AlarmText alarms[] = {
    {61037, "Wrong measuring variant", "measure the rear side of the tool in the basic position of its carrier"},
};

constexpr Example examples[] = {
    {"S_MVAR", 1},  // along one axis
    {"S_MA", 1},
};

constexpr CycleDefinition definition = {
    .number = 982,
    .name = "CYCLE982",
    .title = "Measure tools on a lathe",
    .family = CycleFamily::Tool,
    .summary =
        "Calibrates the tool touch probe of a lathe, or measures the "
        "lengths of a turning tool or a drill, or the "
        "lengths and the radius of a mill, and corrects the tool.",
    .parameters = parameters982,
    .results = results982,
    .controls = control::onSinumerik,
    .examples = examples,
};

/// What S_MVAR says that fits to no tool; null if it fits to one.
const char* contradiction(const LatheVariant& variant) {
  if (variant.task == LatheTask::Calibrate &&
      (variant.reversal || variant.quantities != LatheQuantities::Length || variant.positions || variant.radial))
    return "reversal, radius, start angle and where the tool lies do not belong to a calibration";
  if (variant.task == LatheTask::Complete && variant.quantities == LatheQuantities::Radius)
    return "the radius alone is measured along one axis";
  if (variant.task == LatheTask::AlongAxis && variant.quantities == LatheQuantities::RearSide)
    return "the rear side belongs to the complete measurement";
  if (variant.incremental && (variant.task == LatheTask::Complete || variant.quantities != LatheQuantities::Length))
    return "incremental, one face of the contact is touched";
  return nullptr;
}

LatheVariant variantOf(const std::function<int(int)>& digit) {
  return {.task = static_cast<LatheTask>(digit(1)),
          .quantities = static_cast<LatheQuantities>(digit(4)),
          .reversal = digit(3) == 1,
          .radial = digit(5) == 1,
          .incremental = digit(6) == 1,
          .positions = digit(7) == 1};
}

void combinations(CallCombinations& call) {
  const LatheVariant variant = variantOf([&](int place) { return call.digit(place); });
  if (const char* why = contradiction(variant))
    call.refuse("S_MVAR", std::string("S_MVAR does not fit together: ") + why);
  const auto unused = [&](const char* parameter, const char* why) {
    const auto value = call.number(parameter);
    if (value && *value != 0) call.warn(parameter, std::string(parameter) + why);
  };
  if (variant.task == LatheTask::Calibrate)
    for (const char* name : {"S_KNUM", "S_TZL", "S_TDIF", "S_EVNUM"})
      unused(name, " does nothing when the tool touch probe is calibrated");
  if (variant.task == LatheTask::Complete) unused("S_MA", " does nothing when all is measured");
  if (!variant.reversal) unused("S_CORA", " is of a mill with reversal");
  if (!variant.reversal && !variant.positions) unused("S_STA1", " acts with reversal, or with 1000000 in S_MVAR, only");
}

int oldForm(OldCall& call) {
  call.put("S_KNUM", call.control().data.number("_CHBIT", {3}) != 0 ? 1 : 0);
  call.put("S_CORA", call.number("_CORA"));
  call.put("S_TZL", call.number("_TZL"));
  call.put("S_TDIF", call.number("_TDIF"));
  return call.variant();
}

// ---- the call ----

/// Refuses digits that do not fit together, or not the tool: 61307; what is not
/// possible on a tool carrier: 61037.
void requireVariant(Context& context, const LatheVariant& variant, const LatheTool& tool) {
  const auto refuse = [&](const char* why) {
    context.alarm(61307, fmt::format("S_MVAR = {}: {}", context.integer("S_MVAR"), why));
  };
  const bool mill = tool.kind() == LatheToolKind::Mill && variant.task != LatheTask::Calibrate;
  if (!mill && (variant.reversal || variant.quantities != LatheQuantities::Length || variant.positions))
    refuse("reversal, radius and start angle belong to mills");
  if (tool.kind() != LatheToolKind::Drill && !mill && variant.radial) refuse("only mills and drills lie radially");
  if (tool.kind() == LatheToolKind::Drill && variant.task == LatheTask::Complete)
    refuse("of a drill one length is measured");
  if (const char* why = contradiction(variant)) refuse(why);
  if (variant.quantities == LatheQuantities::RearSide && tool.onCarrier()) {
    context.alarm(61037,
                  "the rear side of a tool on an orientable tool "
                  "carrier cannot be measured");
  }
}

// ---- turning tools, calibration ----

/// From the tip to the point of the nose that touches in this direction.
double noseReach(const LatheTool& tool, int axis, double direction) {
  return tool.nose()[axis] + direction * tool.radius();
}

/// A turning tool points into the directions in which it touches; a calibrating
/// tool touches everywhere.
void requireDirection(Context& context, const LatheTool& tool, int axis, double direction) {
  constexpr double least = 0.05;
  if (tool.calibrates() || direction * tool.pointing()[axis] > least) return;
  context.alarm(61332, fmt::format("a tool with cutting edge position {} does "
                                   "not touch in the {} direction of axis {} "
                                   "of the plane",
                                   tool.position(), direction > 0 ? "plus" : "minus", axis + 1));
}

/// Brings the nose in front of a face, its centre on the middle of the contact.
void approachWithNose(LatheToolTouches& touches, const LatheTool& tool, int axis, double direction) {
  const int other = 1 - axis;
  const double place = touches.trigger(axis, direction) - direction * touches.path() - noseReach(tool, axis, direction);
  const double beside = touches.middle(other) - tool.nose()[other];
  touches.requireWay(axis, touches.at() + tool.nose(), place + tool.nose()[axis], tool.radius());
  touches.go(axis, place);
  touches.go(other, beside);
}

/// The place of the touching point of the nose at the signal.
double touchWithNose(LatheToolTouches& touches, const LatheTool& tool, int axis, double direction) {
  return touches.touch(axis, direction) + noseReach(tool, axis, direction);
}

void calibrate(Context& context, const LatheVariant& variant, const LatheTool& tool, LatheToolTouches& touches,
               ProbeSystem system, int index, double feed) {
  const int axis = context.measuringAxis(2);
  const double direction = directionOf(context, touches, axis);
  requireDirection(context, tool, axis, direction);
  if (!variant.incremental) approachWithNose(touches, tool, axis, direction);
  const double found = touchWithNose(touches, tool, axis, direction);
  const double before = touches.trigger(axis, direction);
  const int result = 8 + 4 * axis + (direction < 0 ? 0 : 2);
  context.result(result, found, {.nominal = before});
  context.result(result + 1, found - before);
  context.result(27, 0);
  context.result(28, context.real("S_TSA"));
  context.noteCall();
  // Incremental calibration can do without an approximate value.
  if (before != 0 || !variant.incremental) context.checkSafeArea(found - before);
  Control& control = context.control();
  control.write({toolProbeTrigger(system, axis, direction), {index}}, found);
  control.write({toolProbeDatum(system, "FEED"), {index}}, feed);
}

LatheFindings measureTurningTool(Context& context, const LatheVariant& variant, const LatheTool& tool,
                                 LatheToolTouches& touches) {
  LatheFindings findings;
  const auto find = [&](int axis, double direction) {
    findings.tip[static_cast<std::size_t>(axis)] =
        touchWithNose(touches, tool, axis, direction) - touches.trigger(axis, direction);
  };
  if (variant.task == LatheTask::AlongAxis) {
    const int axis = context.measuringAxis(2);
    const double direction = directionOf(context, touches, axis);
    requireDirection(context, tool, axis, direction);
    if (!variant.incremental) approachWithNose(touches, tool, axis, direction);
    find(axis, direction);
    return findings;
  }
  constexpr double least = 0.05;
  std::array<double, 2> directions = {};
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(tool.pointing()[axis]) < least) continue;
    directions[static_cast<std::size_t>(axis)] = touches.towardsMiddle(axis);
    requireDirection(context, tool, axis, directions[static_cast<std::size_t>(axis)]);
  }
  const Vector2 start = touches.at();
  const bool first = directions[0] != 0, second = directions[1] != 0;
  if (first) {
    approachWithNose(touches, tool, 0, directions[0]);
    find(0, directions[0]);
  }
  const double inFront = touches.at().x();
  if (second) {
    approachWithNose(touches, tool, 1, directions[1]);
    find(1, directions[1]);
  }
  // Back to where the cycle started, round the contact as it came.
  if (first && second) touches.go(0, inFront);
  if (first) {
    touches.go(1, start.y());
    touches.go(0, start.x());
  } else {
    touches.go(0, start.x());
    touches.go(1, start.y());
  }
  return findings;
}

// ---- what becomes of the tool ----

/// Judges all that was found before anything is corrected; nothing is if one of
/// them is worn out.
void conclude(Context& context, const LatheTool& tool, const LatheFindings& findings) {
  struct Component {
    int number;  ///< 0, 1, 2: length 1, 2, 3; 3: radius
    const char* name;
    int result;
    double difference;
  };
  constexpr std::array names = {"length 1", "length 2", "length 3"};
  std::vector<Component> components;
  const auto lengths = tool.lengths(findings.tip);
  for (int i = 0; i < 3; ++i) {
    const auto place = static_cast<std::size_t>(i);
    if (lengths[place]) components.push_back({i, names[place], 8 + 2 * i, *lengths[place]});
  }
  if (findings.radius) components.push_back({3, "radius", 12, *findings.radius});
  const double empirical = empiricalValue(context);
  for (const Component& each : components) {
    if (each.number == 2) continue;  // lies across the plane unless the tool carrier is wrong
    const double believed = believedComponent(context, each.number);
    context.result(each.result, believed + each.difference, {.nominal = believed});
    context.result(each.result + 1, each.difference - empirical);
  }
  noteTool(context);
  context.noteCall();
  std::vector<double> differences;
  for (const Component& each : components)
    differences.push_back(each.difference);
  repeatIfBeyond(context, differences);
  bool worn = false;
  std::vector<Component> corrected;
  for (const Component& each : components) {
    const Judgement judgement = judgeTool(context, each.difference, each.name);
    worn = worn || judgement == Judgement::WornOut;
    if (judgement == Judgement::Corrects) corrected.push_back(each);
  }
  if (worn) return;
  for (const Component& each : corrected)
    correctEdge(context, each.number, each.difference);
}

/// Refuses a data field that does not say where the contact is: both trigger
/// points of both axes.
void requireField(Context& context, const ToolProbeField& field) {
  for (int axis = 0; axis < 2; ++axis) {
    if (field.trigger(axis, -1) > field.trigger(axis, 1)) continue;
    throw control::Alarm(
        "61341",
        fmt::format("{}: data field {} has no contact between the trigger points of "
                    "axis {} of the plane",
                    alarmText(61341), context.integer("S_PRNUM") == 0 ? 1 : context.integer("S_PRNUM"), axis + 1),
        "enter approximate trigger points (SD 54625 to 54628, of the workpiece "
        "54640 to 54643), then calibrate with "
        "CYCLE982");
  }
}

void run(Context& context, const Arguments&) {
  context.requireReady(Context::Mirrored::Allowed);
  const LatheVariant variant = variantOf([&](int place) { return context.digit("S_MVAR", place); });
  const ProbeSystem system = systemOf(context);
  const int index = toolProbeIndex(context);
  empiricalValue(context);  // refuses a number that there is not
  if (variant.task != LatheTask::Complete) context.measuringAxis(2);
  const ToolProbeField field = toolProbeField(context.control().data, system, index);
  const LatheTool tool(context, system);
  requireVariant(context, variant, tool);
  const bool calibrates = variant.task == LatheTask::Calibrate;
  if (calibrates && (tool.kind() != LatheToolKind::Turning || tool.position() > 4)) {
    if (tool.kind() != LatheToolKind::Turning)
      context.alarm(61314, "the probe is calibrated with a tool of type 580 or 5xy");
    context.alarm(61315, fmt::format("$TC_DP2 = {}, the probe is calibrated with 1 to 4", tool.position()));
  }
  // Incremental calibration needs no approximate values where the call tells
  // the direction.
  if (!calibrates || !variant.incremental || context.integer("S_MD") == 0) requireField(context, field);
  const double feed = touchingFeed(context, field, calibrates ? Touching::Calibrates : Touching::Measures);
  const double first = context.real("S_STA1");
  LatheToolTouches touches(context, tool, field, feed,
                           {.positions = variant.positions,
                            .reverses = variant.reversal,
                            .first = first,
                            .second = first + 180 + context.real("S_CORA")});
  context.setWayBack([&touches] { touches.back(); });
  if (calibrates) return calibrate(context, variant, tool, touches, system, index, feed);
  const LatheFindings findings =
      tool.kind() == LatheToolKind::Turning ? measureTurningTool(context, variant, tool, touches)
      : variant.task == LatheTask::Complete ? measureMillCompletely(context, variant, tool, touches)
                                            : measureRotatedToolAlongAxis(context, variant, tool, touches);
  conclude(context, tool, findings);
}

}  // namespace

extern const Entry cycle982 = {.definition = definition,
                               .title = {.byFeature = true},
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .alarms = alarms,
                               .run = run};

}  // namespace probewright::cycles::sinumerik

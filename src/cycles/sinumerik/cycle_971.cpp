#include "base/truncated.hpp"
#include "cycles/sinumerik/call_combinations.hpp"
#include "cycles/sinumerik/machine_coordinates.hpp"
#include "cycles/sinumerik/milled_tool.hpp"
#include "cycles/sinumerik/old_call.hpp"
#include "cycles/sinumerik/parameters.hpp"
#include "cycles/sinumerik/tool_probe_calibration.hpp"
#include "cycles/sinumerik/tool_results.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr Choice tasks971[] = {{0, "calibrate the tool touch probe"},
                               {1, "measure the tool, spindle standing"},
                               {2, "measure the tool, spindle turning"}};
constexpr Choice systems971[] = {{0, "machine coordinates"}, {1, "workpiece coordinates"}};
constexpr Choice edges971[] = {{0, "whole tool"}, {1, "single cutting edges"}};
constexpr Choice extents971[] = {{0, "one axis"}, {1, "complete calibration"}};
constexpr Choice reversal971[] = {{0, "without spindle reversal"}, {1, "with spindle reversal in the plane"}};
constexpr CodeDigit variant971[] = {{1, 1, "task", tasks971},
                                    {2, 1, "coordinates", systems971},
                                    {3, 1, "cutting edges", edges971},
                                    {6, 1, "calibration", extents971},
                                    {7, 1, "reversal", reversal971}};

constexpr Choice memories971[] = {{0, "geometry, the wear becomes 0"}, {1, "wear"}};
constexpr CodeDigit corrected971[] = {{1, 1, "memory", memories971}};

constexpr Choice axes971[] = {
    {0, "complete calibration"}, {1, "1st axis: radius"}, {2, "2nd axis: radius"}, {3, "3rd axis: length"}};
constexpr Choice offsets971[] = {{0, "no offset axis"}, {1, "offset in the 1st axis"}, {2, "offset in the 2nd axis"}};
constexpr CodeDigit measuring971[] = {{1, 1, "measuring axis", axes971}, {3, 1, "offset axis", offsets971}};

constexpr Choice directions971[] = {{0, "as the tool stands"}, {1, "plus"}, {2, "minus"}};
constexpr CodeDigit direction971[] = {{1, 1, "direction", directions971}};

constexpr Parameter speed(std::uint32_t address, std::string_view name, std::string_view meaning) {
  return {.name = name,
          .address = address,
          .meaning = meaning,
          .kind = ValueKind::Number,
          .minimum = 0,
          .standard = 0,
          .controls = control::onSinumerik};
}

constexpr Parameter parameters971[] = {
    parameters::variant(variant971),
    parameters::coded(1, "S_KNUM", "memory of the tool that is corrected", corrected971),
    parameters::count<6>(2, "S_PRNUM", "data field of the tool touch probe, 1 to 6; 0 counts as 1", 1),
    parameters::coded(3, "S_MA", "measuring axis and offset axis; 0 with a complete calibration", measuring971),
    parameters::coded(4, "S_MD", "measuring direction", direction971),
    parameters::distance(5, "S_ID",
                         "offset: of a length V, from the radius inwards to the highest point of the edge; of a radius "
                         "DZ, from the lower end upwards to it"),
    parameters::measuringPath(6),
    parameters::safeArea(7),
    parameters::feed(8, "S_VMS", "measuring feed with the spindle standing; 0: that of the data field, else SD 55628"),
    parameters::zeroOffsetRange(9),
    parameters::dimensionalDifference(10),
    parameters::repetitions(11),
    parameters::feed(12, "S_F1", "feed of the 1st touch with the spindle turning, if bit 5 of SD 54762 is set"),
    speed(13, "S_S1", "spindle speed of the 1st touch, rev/min"),
    parameters::feed(14, "S_F2", "feed of the 2nd touch"),
    speed(15, "S_S2", "spindle speed of the 2nd touch, rev/min; 0: one touch only"),
    parameters::feed(16, "S_F3", "feed of the 3rd touch"),
    speed(17, "S_S3", "spindle speed of the 3rd touch, rev/min; 0: two touches"),
    parameters::code(18, "S_EVNUM", "number of the empirical value, 0 to 20"),
    parameters::reserved(19),
    parameters::plane(20),
    parameters::alternative(21),
};

constexpr std::uint16_t calibrating = 0b001, measuring = 0b110;

constexpr of::Characteristic trigger(const of::Characteristic& axis, std::uint8_t direction) {
  return axis.number(direction);
}
constexpr std::uint8_t minus = 1, plus = 2;

/// Of single edges the item is the edge.
constexpr ResultDefinition results971[] = {
    {"_OVR[8]",
     {"actual value, ", "trigger point minus, 1st axis"},
     result::actual(trigger(of::position1, minus)).main(),
     calibrating},
    {"_OVR[9]",
     {"difference, ", "trigger point minus, 1st axis"},
     result::difference(trigger(of::position1, minus)),
     calibrating},
    {"_OVR[10]",
     {"actual value, ", "trigger point plus, 1st axis"},
     result::actual(trigger(of::position1, plus)).main(),
     calibrating},
    {"_OVR[11]",
     {"difference, ", "trigger point plus, 1st axis"},
     result::difference(trigger(of::position1, plus)),
     calibrating},
    {"_OVR[12]",
     {"actual value, ", "trigger point minus, 2nd axis"},
     result::actual(trigger(of::position2, minus)).main(),
     calibrating},
    {"_OVR[13]",
     {"difference, ", "trigger point minus, 2nd axis"},
     result::difference(trigger(of::position2, minus)),
     calibrating},
    {"_OVR[14]",
     {"actual value, ", "trigger point plus, 2nd axis"},
     result::actual(trigger(of::position2, plus)).main(),
     calibrating},
    {"_OVR[15]",
     {"difference, ", "trigger point plus, 2nd axis"},
     result::difference(trigger(of::position2, plus)),
     calibrating},
    {"_OVR[16]",
     {"actual value, ", "trigger point minus, 3rd axis"},
     result::actual(trigger(of::position3, minus)).main(),
     calibrating},
    {"_OVR[17]",
     {"difference, ", "trigger point minus, 3rd axis"},
     result::difference(trigger(of::position3, minus)),
     calibrating},
    {"_OVR[18]",
     {"actual value, ", "trigger point plus, 3rd axis"},
     result::actual(trigger(of::position3, plus)).main(),
     calibrating},
    {"_OVR[19]",
     {"difference, ", "trigger point plus, 3rd axis"},
     result::difference(trigger(of::position3, plus)),
     calibrating},
    {"_OVR[8]",
     {"actual value, ", "length 1, of single edges the longest"},
     result::actual(of::length1).main(),
     measuring},
    {"_OVR[9]", {"difference, ", "length 1, of single edges the longest"}, result::difference(of::length1), measuring},
    {"_OVR[10]",
     {"actual value, ", "radius, of single edges the largest"},
     result::actual(of::radius).main(),
     measuring},
    {"_OVR[11]", {"difference, ", "radius, of single edges the largest"}, result::difference(of::radius), measuring},
    {"_OVR[12]", "length of the shortest edge", result::statistic(of::length1), measuring},
    {"_OVR[13]", "deviation of the length of the shortest edge", result::statistic(of::distance1), measuring},
    {"_OVR[14]", "radius of the smallest edge", result::statistic(of::radius), measuring},
    {"_OVR[15]", "deviation of the radius of the smallest edge", result::statistic(of::distance), measuring},
    {"_OVR[27]", "zero offset range", result::setting(of::distance)},
    {"_OVR[28]", "safe area", result::setting(of::distance)},
    {"_OVR[29]", "dimensional difference", result::setting(of::distance), measuring},
    {"_OVR[30]", "empirical value", result::statistic(of::distance), measuring},
    {"_OVR[100..199]", {"actual value, ", "radius"}, result::actual(of::radius.number(1)), measuring},
    {"_OVR[200..299]", {"difference, ", "radius"}, result::difference(of::radius.number(1)), measuring},
    {"_OVR[300..399]", {"actual value, ", "length 1"}, result::actual(of::length1.number(1)), measuring},
    {"_OVR[400..499]", {"difference, ", "length 1"}, result::difference(of::length1.number(1)), measuring},
    {"_OVI[0]", "number of the edge (D)", result::setting(), measuring},
    {"_OVI[2]", "number of the cycle", result::status},
    {"_OVI[3]", "measuring variant", result::setting()},
    {"_OVI[5]", "data field of the tool touch probe", result::setting()},
    {"_OVI[7]", "number of the empirical value", result::setting(), measuring},
    {"_OVI[8]", "number of the tool", result::setting(), measuring},
    {"_OVI[9]", "number of the alarm or message", result::status},
    {"_OVS_TNAME", "name of the tool", result::setting(of::name), measuring},
};

constexpr bool isComplete(int code) { return variant::digit(code, 6) == 1; }
constexpr bool measuresAxis(int code) { return !isComplete(code); }

constexpr Requirement requirements[] = {
    {"S_MA", Need::NotZero, measuresAxis},
    {"S_EVNUM", Need::Within, nullptr, 0, 20},
};

/// What S_MVAR says that does not fit together; null if it does.
const char* contradiction(int task, bool edges, bool complete, bool reverses) {
  if (edges && task != 2) return "single cutting edges are measured with the spindle turning only";
  if (complete && task != 0) return "a complete measurement is a calibration";
  if (reverses && task != 0) return "the spindle is reversed to calibrate only";
  return nullptr;
}

/// Arguments that the variant does nothing with.
void warnOfUnused(CallCombinations& call, bool above) {
  const auto unused = [&](std::string_view parameter, const char* why) {
    const auto value = call.number(parameter);
    if (value && *value != 0) call.warn(parameter, std::string(parameter) + why);
  };
  const int task = call.digit(1);
  if (task == 0) {
    if (!above) unused("S_ID", " acts on a calibration of the 3rd axis only");
    for (const char* name : {"S_KNUM", "S_TZL", "S_TDIF", "S_EVNUM"})
      unused(name, " does nothing when the tool touch probe is calibrated");
  }
  if (task == 0 && call.digit(6) == 1) unused("S_MA", " does nothing with a complete calibration");
  if (task == 2 && call.digit(3) == 0) unused("S_VMS", " is the feed of a tool that stands");
  for (const char* name : {"S_F1", "S_S1", "S_F2", "S_S2", "S_F3", "S_S3"})
    if (task != 2) unused(name, " is of a tool that turns");
}

void combinations(CallCombinations& call) {
  if (const char* why = contradiction(call.digit(1), call.digit(3) == 1, call.digit(6) == 1, call.digit(7) == 1))
    call.refuse("S_MVAR", std::string("S_MVAR does not fit together: ") + why);
  const auto axes = call.number("S_MA"), way = call.number("S_MD");
  const bool above = axes && truncated(std::abs(*axes)) % 10 == 3 && call.digit(6) != 1;
  if (axes && *axes != 0 && truncated(*axes) % 10 == 0 && call.digit(6) != 1)
    call.refuse("S_MA", "S_MA names no measuring axis in its units");
  if (axes && truncated(*axes) % 10 == truncated(*axes) / 100 && *axes != 0)
    call.refuse("S_MA", "the offset axis cannot be the measuring axis");
  if (above && way && *way == 1) call.refuse("S_MD", "the 3rd axis is touched from above: minus, 2, or 0");
  if (above && call.digit(7) == 1) call.refuse("S_MVAR", "the spindle is reversed for the axes of the plane only");
  warnOfUnused(call, above);
}

int oldForm(OldCall& call) {
  call.nothingFrom(7);
  if (call.digit(1) > 2 || call.digit(2) > 1 || call.digit(3) != 0 || call.digit(4) != 0 || call.digit(5) != 0 ||
      call.digit(6) > 1)
    call.refuseVariant();
  call.put("S_KNUM", call.control().data.number("_CHBIT", {3}) != 0 ? 1 : 0);
  call.put("S_TZL", call.number("_TZL"));
  call.put("S_TDIF", call.number("_TDIF"));
  return call.variant();
}

constexpr AlarmText alarms[] = {
    {61350, "Feed or speed of the turning spindle is 0", "enter SD 54670 to SD 54677, or S_F1 and S_S1"},
};

constexpr Example examples[] = {
    {"S_MVAR", 1},  // a tool, the spindle standing
    {"S_MA", 3},    // its length
};

constexpr CycleDefinition definition = {
    .number = 971,
    .name = "CYCLE971",
    .title = "Measure tools on a mill",
    .family = CycleFamily::Tool,
    .summary =
        "Calibrates a tool touch probe with a tool of known size, or measures length or radius of a mill or drill, "
        "standing or turning, whole or edge by edge, and corrects the tool.",
    .parameters = parameters971,
    .results = results971,
    .controls = control::onSinumerik,
    .examples = examples,
};

void run(Context& context, const Arguments&) {
  context.requireReady(Context::Mirrored::Refused);
  const auto digit = [&](int place) { return context.digit("S_MVAR", place); };
  if (const char* why = contradiction(digit(1), digit(3) == 1, digit(6) == 1, digit(7) == 1)) context.alarm(61307, why);
  toolProbeIndex(context);
  context.noteCall();
  std::optional<MachineCoordinates> machine;
  if (systemOf(context) == ProbeSystem::Machine)
    machine.emplace(context.control(), MachineCoordinates::Transformation::Off);
  digit(1) == 0 ? calibrateToolProbe(context) : measureMilledTool(context);
}

}  // namespace

extern const Entry cycle971 = {.definition = definition,
                               .requirements = requirements,
                               .combinations = combinations,
                               .oldForm = oldForm,
                               .alarms = alarms,
                               .run = run};

}  // namespace probewright::cycles::sinumerik

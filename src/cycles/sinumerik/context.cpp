#include "cycles/sinumerik/context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "control/alarm.hpp"
#include "control/missing_axis.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "cycles/sinumerik/call_requirements.hpp"
#include "cycles/sinumerik/measuring_log.hpp"

namespace probewright::cycles::sinumerik {

using control::Alarm;
using control::EventKind;
using control::sinumerik::FramePart;

namespace {

const Parameter* parameterNamed(const CycleDefinition& definition, std::string_view name) {
  const auto found = std::ranges::find(definition.parameters, name, &Parameter::name);
  return found == definition.parameters.end() ? nullptr : &*found;
}

const Parameter& required(const Arguments& arguments, std::string_view name) {
  const Parameter* parameter = parameterNamed(arguments.definition(), name);
  if (parameter == nullptr) {
    throw std::logic_error(fmt::format("{} has no parameter {}", arguments.definition().name, name));
  }
  return *parameter;
}

/// The measurement is to be made again: bit 0 of SD 54740.
struct RepeatMeasurement {};

/// The manual gives no number.
constexpr int mostRepetitions = 4;

/// What is measured, where S_MVAR tells it, with its set size as the call has it: "Hole 40", "Hole 1.5748 inch". Else
/// the cycle's title. `unit`: mm in the unit of the program.
std::string titleOf(const Entry& entry, const Arguments& arguments, double unit) {
  const CycleDefinition& definition = arguments.definition();
  if (!entry.title.byFeature) return std::string(definition.title);
  const Parameter& variant = definition.parameters.front();
  const CodeDigit& feature = variant.digits.front();
  const int units = std::abs(arguments.integer(variant.address)) % 10;
  const auto choice = std::ranges::find(feature.choices, units, &Choice::value);
  if (choice == feature.choices.end()) return std::string(definition.title);
  std::string title(choice->meaning);
  title.front() = upper(title.front());
  const double places = unit == 1 ? 1e4 : 1e5;
  const char* between = " ";
  bool sized = false;
  for (const TitleSize& size : entry.title.sizes) {
    if (size.variants != 0 && (size.variants >> units & 1) == 0) continue;
    const double value = arguments.number(required(arguments, size.parameter).address);
    if (value > 0) {
      title += between + formatShortest(std::round(value * places) / places);
      sized = true;
    }
    between = " x ";
  }
  if (sized && unit != 1) title += " inch";
  return title;
}

bool scales(ValueKind kind) { return kind == ValueKind::Length || kind == ValueKind::Feed; }

}  // namespace

Context::Context(Control& control, const Entry& entry, const Arguments& arguments, SourcePlace place,
                 const std::function<void()>& spindlePositioned)
    : control_(control), arguments_(arguments), planeBefore_(control.plane) {
  if (maskBit(control.data, "$SCS_MEA_FUNCTION_MASK", 6)) spindlePositioned_ = spindlePositioned;
  const CycleDefinition& definition = arguments.definition();
  control::CycleRecord record;
  record.name = definition.name;
  record.title = titleOf(entry, arguments, control.unit);
  record.place = std::move(place);
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    const Argument& value = arguments.values()[i];
    const Parameter& parameter = definition.parameters[i];
    std::string meaning(parameter.meaning);
    if (const std::string code = codeText(parameter, value.number); value.given && !code.empty()) {
      meaning += fmt::format(": {}", code);
    }
    record.parameters.push_back(
        {std::string(parameter.name), value.isText ? value.text : formatShortest(value.number), std::move(meaning),
         !value.given,
         value.isText ? std::nullopt : std::optional(inMillimetres(parameter, value, control.unit, control.unit))});
  }
  record.startSeconds = control.channel.seconds();
  record_ = control.journal.cycles.size();
  control.journal.begin(std::move(record));
  start_ = control.channel.position();
  repetitionsLeft_ = habit(0) ? mostRepetitions : 0;
  clearResults();
  const int plane = has("_DMODE") ? digit("_DMODE", 1) : 0;
  if (plane >= 1 && plane <= 3 && control.plane != 16 + plane) {
    control.plane = 16 + plane;
    control.handOverFrames();
  }
  this->record().plane = control.workingPlane();
  resultInteger(2, definition.number);
}

Measures Context::measures() const {
  return arguments_.definition().family == CycleFamily::Tool ? Measures::Tools : Measures::Workpieces;
}

bool Context::habit(int bit) const {
  return maskBit(control_.data, "$SNS_MEA_FUNCTION_MASK", bit + (measures() == Measures::Tools ? 16 : 0));
}

void Context::clearResults() {
  std::fill_n(control_.ovr.begin(), Control::firstKept, 0.0);
  std::fill(control_.ovr.begin() + Control::afterKept, control_.ovr.end(), 0.0);
  control_.ovi.fill(0);
  correctedTool({});
  record().results.clear();
  record().fits.clear();
  record().verdict = Verdict::None;
}

Context::~Context() {
  record().endSeconds = control_.channel.seconds();
  control_.journal.cycleOpen = false;
  if (control_.plane != planeBefore_) {
    control_.plane = planeBefore_;
    control_.handOverFrames();
  }
}

double Context::real(std::string_view name) const {
  const Parameter& parameter = required(arguments_, name);
  return inMillimetres(parameter, arguments_.at(parameter.address), control_.unit, control_.unit);
}

int Context::integer(std::string_view name) const { return arguments_.integer(required(arguments_, name).address); }

const std::string& Context::text(std::string_view name) const {
  return arguments_.text(required(arguments_, name).address);
}

bool Context::given(std::string_view name) const { return arguments_.given(required(arguments_, name).address); }

bool Context::has(std::string_view name) const { return parameterNamed(arguments_.definition(), name) != nullptr; }

int Context::digit(std::string_view name, int place) const {
  long value = std::abs(static_cast<long>(integer(name)));
  for (int i = 1; i < place; ++i)
    value /= 10;
  return static_cast<int>(value % 10);
}

int Context::dataSet() const {
  const int number = integer("S_PRNUM") == 0 ? 1 : integer("S_PRNUM");
  if (number < 1 || number > 12) throw Alarm("61313", std::string(alarmText(61313)), std::string(alarmAdvice(61313)));
  return number - 1;
}

namespace {

[[noreturn]] void refuse(int number) {
  throw Alarm(std::to_string(number), std::string(alarmText(number)), std::string(alarmAdvice(number)));
}

}  // namespace

void Context::requireProbe(std::initializer_list<int> types) const {
  if (control_.level > 5) refuse(61300);
  if (control_.tool.edge == 0) refuse(61311);
  if (std::ranges::find(types, control_.tool.type) == types.end()) refuse(61309);
  const bool mayMirror = control_.tool.type == 580 || control_.channel.description().mainSpindle;
  requireReady(mayMirror ? Mirrored::Allowed : Mirrored::Refused);
}

void Context::requireReady(Mirrored mirrored) const {
  if (control_.level > 5) refuse(61300);
  if (control_.tool.edge == 0) refuse(61311);
  for (const auto* frame : {&control_.frames.base, &control_.frames.settableFrame, &control_.frames.programmed}) {
    for (const auto& axis : frame->geometry) {
      if (axis.scale != 1) refuse(61310);
      if (axis.mirror && mirrored == Mirrored::Refused) {
        throw Alarm("61310", "Mirroring is active: it is allowed for counter-spindles of lathes only",
                    "cancel MIRROR, or the mirroring of the zero offset, before the measuring cycle");
      }
    }
  }
  if (control_.radiusCompensation) {
    throw Alarm("61300", "Tool radius compensation is active", "program G40 before the measuring cycle");
  }
  const probing::SinumerikHabits habits = habitsOf(control_, measures());
  if (habits.monitorCollisions && (habits.planeFeed <= 0 || habits.infeedFeed <= 0)) refuse(61338);
}

void Context::requireCalibration() const {
  if (!maskBit(control_.data, "$MNS_MEA_FUNCTION_MASK", 0)) return;
  if (control_.data.number("$SNS_MEA_WP_BALL_DIAM", {dataSet()}) > 0) return;
  throw Alarm("61341", fmt::format("{}: data set {} is empty", alarmText(61341), dataSet() + 1),
              std::string(alarmAdvice(61341)));
}

int Context::measuringAxis(int count) {
  const int axis = integer("S_MA");
  if (axis < 1 || axis > count) alarm(61325, fmt::format("S_MA = {}, 1 to {} are possible", axis, count));
  return axis - 1;
}

void Context::noteCall() {
  resultInteger(3, integer("S_MVAR"));
  resultInteger(5, dataSet() + 1);
}

probing::SinumerikProber& Context::prober() {
  if (!prober_) {
    probing::SinumerikHabits habits = habitsOf(control_, measures());
    habits.spindlePositioned = spindlePositioned_;
    prober_.emplace(control_.channel, control_.workingPlane(), probeOfDataSet(control_, dataSet()), std::move(habits));
  }
  return *prober_;
}

void Context::positionSpindle(double degrees) {
  control_.channel.orientSpindle(degrees);
  if (spindlePositioned_) spindlePositioned_();
}

int Context::repetitions() const { return std::clamp(integer("S_NMSP"), 1, 9); }

void Context::result(int index, double value, const Compared& compared) {
  const std::string name = fmt::format("_OVR[{}]", index);
  const ResultDefinition* definition = arguments_.definition().result(name, digit("S_MVAR", 1));
  const ValueKind kind = definition == nullptr ? ValueKind::Length : definition->valueKind();
  control_.ovr[static_cast<std::size_t>(index)] = scales(kind) ? value / control_.unit : value;
  record().results.push_back(resultRecord(name, definition, kind, value, compared));
}

void Context::resultInteger(int index, int value) {
  control_.ovi[static_cast<std::size_t>(index)] = value;
  control::ResultRecord record;
  record.name = fmt::format("_OVI[{}]", index);
  const ResultDefinition* definition = arguments_.definition().result(record.name, digit("S_MVAR", 1));
  if (definition != nullptr) describe(record, *definition);
  record.value = value;
  this->record().results.push_back(std::move(record));
}

void Context::correctedTool(const std::string& name) {
  // A result, not a datum to be kept: programs read it, files do not hold it.
  const control::sinumerik::DataKey key("_OVS_TNAME", {});
  if (control_.data.isSet(key)) return control_.data.set(key, name);
  control_.data.setDefault("_OVS_TNAME", name);
}

void Context::checkSafeArea(double difference, double factor) {
  const double limit = factor * real("S_TSA");
  if (std::abs(difference) > limit + 1e-9) {
    const std::string_view unit = unitOf(required(arguments_, "S_TSA").kind);
    const std::string detail =
        fmt::format("difference {:.4f} {}, safe area TSA {:.4f} {}", difference, unit, limit, unit);
    repeatIfAsked(61303, detail);
    alarm(61303, detail);
  }
}

void Context::repeatIfAsked(int number, const std::string& detail) {
  if (repetitionsLeft_ == 0) return;
  --repetitionsLeft_;
  const std::string text = fmt::format("{}: {}; the measurement is repeated", alarmText(number), detail);
  const bool stops = habit(1);
  control_.panel.message(EventKind::Warning, text, control_.channel.seconds(), stops ? std::to_string(number) : "");
  if (stops) control_.panel.stop(text, control_.channel.seconds());
  if (wayBack_) wayBack_();
  wayBack_ = nullptr;
  throw RepeatMeasurement();
}

void Context::beginAgain() {
  prober().moveTo(control_.workingPlane().planeFromXyz(start_));
  clearResults();
  resultInteger(2, arguments_.definition().number);
}

namespace {

/// The text of an alarm with what is the matter this time. Cycles raise alarms of the list only.
std::string messageOf(int number, const std::string& detail) {
  const std::string_view text = alarmText(number);
  if (text.empty()) throw std::logic_error(fmt::format("alarm {} is not listed", number));
  return detail.empty() ? std::string(text) : fmt::format("{}: {}", text, detail);
}

}  // namespace

void Context::alarm(int number, const std::string& detail) {
  throw Alarm(std::to_string(number), messageOf(number, detail), std::string(alarmAdvice(number)));
}

void Context::warn(int number, const std::string& detail) {
  resultInteger(9, number);
  control_.panel.message(EventKind::Warning, messageOf(number, detail), control_.channel.seconds(),
                         std::to_string(number));
}

void Context::stopOutOfTolerance(const std::string& text) {
  if (habit(2)) control_.panel.stop(text, control_.channel.seconds());
}

namespace {

/// Turns the spindle with the workpiece coordinate system about the infeed axis, where setting data ask for it, so that
/// the probe touches as it was calibrated; the arm of an L always goes to plus of the 1st axis. A probe with one
/// direction is turned into every touch anyway. Bit 2 is for spindles that count their angle clockwise.
void followRotation(Context& context) {
  const Control& control = context.control();
  if (!control.tool.isProbe() || !control.channel.description().spindleOrients) return;
  const bool bent = control.tool.type == 713;
  if (control.tool.type == 712 || (!bent && !maskBit(control.data, "$SCS_MEA_FUNCTION_MASK", 1))) return;
  const double angle = probing::angleFromSpindle(control.channel, control.workingPlane(), PlaneWay::unit(0));
  if (bent) return context.positionSpindle(probeOfDataSet(control, context.dataSet()).correctionAngle + angle);
  context.positionSpindle(maskBit(control.data, "$SCS_MEA_FUNCTION_MASK", 2) ? -angle : angle);
}

/// Refuses before anything moves what no variant can do with: no measuring path (61308), and digits that no list of the
/// manual has, where only the run knows them (S_MVAR = R1): 61307 in S_MVAR, 61319 in S_NMSP, _DMODE and _AMODE. What
/// selects axes, data sets and targets is asked for where it is used.
void requireArguments(Context& context, bool computes) {
  const auto& parameters = context.arguments().definition().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string_view name = parameters[i].name;
    const bool variant = name == "S_MVAR";
    if (!variant && name != "S_NMSP" && name != "_DMODE" && name != "_AMODE") continue;
    const Argument& argument = context.arguments().values()[i];
    if (!argument.given) continue;
    const std::string complaint = codeComplaint(parameters[i], argument);
    if (!complaint.empty())
      context.alarm(variant ? 61307 : 61319, complaint + std::string(versionNote(parameters[i], argument.number)));
  }
  if (!computes && context.has("S_FA") && !(context.real("S_FA") > 0)) context.alarm(61308);
}

/// An alarm of a move within a cycle, by the name that the cycles give it.
Alarm asCycleAlarm(const Alarm& alarm) {
  if (dynamic_cast<const control::MissingAxis*>(&alarm) != nullptr)
    return {"61336", fmt::format("{}: {}", alarmText(61336), alarm.text()), alarm.advice()};
  const auto number = parseInteger(alarm.code());
  const std::string_view text = number ? alarmText(static_cast<int>(*number)) : std::string_view();
  if (text.empty() || number != 61302 || alarm.text().starts_with(text)) return alarm;
  return {alarm.code(), fmt::format("{}: {}", text, alarm.text()), alarm.advice()};
}

}  // namespace

void runCycle(Control& control, const Entry& entry, const Arguments& arguments, const SourcePlace& place,
              const std::function<void()>& spindlePositioned) {
  if (control.dryRun || control.programTest || control.blockSearch) {
    control.panel.message(EventKind::Skipped,
                          fmt::format("{} is skipped in {}", entry.definition.name,
                                      control.dryRun        ? "dry run"
                                      : control.programTest ? "program test"
                                                            : "block search"),
                          control.channel.seconds());
    return;
  }
  const Diagnostics mistakes = check(arguments, control::ControlKind::Sinumerik840Dsl);
  if (!mistakes.empty()) throw Alarm("12150", mistakes.front().message, mistakes.front().advice);
  if (entry.set != nullptr) return entry.set(control, arguments);
  Context context(control, entry, arguments, place, spindlePositioned);
  const auto output = [&] {
    context.record().endSeconds = control.channel.seconds();
    outputResults(control, context.record(), control.ovi[9]);
  };
  try {
    const bool computes = entry.computes != nullptr && entry.computes(context.integer("S_MVAR"));
    requireArguments(context, computes);
    if (!computes) followRotation(context);
    for (bool done = false; !done;) {
      try {
        entry.run(context, arguments);
        done = true;
      } catch (const RepeatMeasurement&) {
        context.beginAgain();
      }
    }
  } catch (const Alarm& alarm) {
    const Alarm shown = asCycleAlarm(alarm);
    if (const auto number = parseInteger(shown.code())) context.resultInteger(9, static_cast<int>(*number));
    if (context.failingPart() != 0) context.resultInteger(12, context.failingPart());
    context.record().alarm = shown.code().empty() ? shown.text() : shown.code() + ": " + shown.text();
    output();
    throw shown;
  }
  output();
}

probing::SinumerikProbe probeOfDataSet(const Control& control, int index) {
  const auto datum = [&](const char* name) { return control.data.number(name, {index}); };
  probing::SinumerikProbe probe;
  probe.ballDiameter = datum("$SNS_MEA_WP_BALL_DIAM");
  const bool oneBall = control.tool.type == 710 || control.tool.type == 712 || control.tool.type == 580;
  if (probe.ballDiameter == 0 && oneBall) probe.ballDiameter = 2 * control.tool.radius;
  probe.triggerMinus = {datum("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1"), datum("$SNS_MEA_WP_TRIG_MINUS_DIR_AX2"),
                        datum("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3")};
  probe.triggerPlus = {datum("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1"), datum("$SNS_MEA_WP_TRIG_PLUS_DIR_AX2"),
                       datum("$SNS_MEA_WP_TRIG_PLUS_DIR_AX3")};
  probe.positionDeviation = {datum("$SNS_MEA_WP_POS_DEV_AX1"), datum("$SNS_MEA_WP_POS_DEV_AX2")};
  const double feed = datum("$SNS_MEA_WP_FEED");
  probe.feed = feed > 0 ? feed : control.data.number("$SCS_MEA_FEED_MEASURE", {}, 300);
  probe.monodirectional = control.tool.type == 712;
  probe.calibrationWatched = maskBit(control.data, "$MNS_MEA_FUNCTION_MASK", 0);
  probe.correctionAngle = maskBit(control.data, "$MNS_MEA_FUNCTION_MASK", 3) ? control.tool.correctionAngle : 0;
  const int type = control.tool.type;
  probe.lengthToCentre =
      !maskBit(control.data, "$MNS_MEA_FUNCTION_MASK", 1) || type == 580 || type == 713 || type == 714;
  if (type == 714) probe.starBallRadius = control.data.number("$TC_DP7", {control.tool.number, control.tool.edge});
  return probe;
}

probing::SinumerikHabits habitsOf(const Control& control, Measures what) {
  probing::SinumerikHabits habits;
  habits.planeFeed = control.machineData("$SCS_MEA_FEED_PLANE_VALUE", habits.planeFeed);
  habits.infeedFeed = control.machineData("$SCS_MEA_FEED_FEEDAX_VALUE", habits.infeedFeed);
  const double circleFeed = control.machineData("$SCS_MEA_FEED_CIRCLE");
  habits.circleFeed = circleFeed > 0 ? circleFeed : habits.planeFeed;
  habits.fastFeed = control.machineData("$SCS_MEA_FEED_FAST_MEASURE", habits.fastFeed);
  habits.rapidPercent = control.machineData("$SCS_MEA_FEED_RAPID_IN_PERCENT", habits.rapidPercent);
  const auto bit = [&](int workpieces, int tools) {
    return maskBit(control.data, "$SCS_MEA_FUNCTION_MASK", what == Measures::Tools ? tools : workpieces);
  };
  habits.monitorCollisions = bit(0, 16);
  habits.oneAttempt = bit(3, 17);
  habits.fastApproach = bit(4, 18);
  habits.rapidRetract = bit(5, 19);
  return habits;
}

}  // namespace probewright::cycles::sinumerik

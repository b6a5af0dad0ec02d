#include "cycles/sinumerik/kinematics_measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <vector>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/sinumerik/measuring_data.hpp"
#include "control/sinumerik/text.hpp"
#include "cycles/sinumerik/ball_measurement.hpp"
#include "cycles/sinumerik/kinematics_evaluation.hpp"
#include "cycles/sinumerik/kinematics_log.hpp"

namespace probewright::cycles::sinumerik {
namespace {

constexpr int counter = 40, zeroOffsetRotation = 66, ballDiameter = 71;
constexpr int ballAt(int axis, int measurement) { return 41 + 10 * axis + 3 * measurement; }
constexpr int positionAt(int axis, int measurement) { return 60 + 3 * axis + measurement; }
constexpr int linearVectorAt(int axis) { return 32 + 3 * axis; }

ToolCarrier carrierOfCall(Context& context) {
  const Control& control = context.control();
  const int number = context.integer("S_TC");
  constexpr int mostOfControl = 65;
  const int most = truncated(control.data.number("$MN_MM_NUM_TOOL_CARRIER", {}, mostOfControl));
  if (number < 1 || number > most)
    context.alarm(61319, fmt::format("S_TC = {}: the swivel data sets are 1 to {} (MD 18088)", number, most));
  const auto carrier = control::sinumerik::toolCarrier(control.data, number);
  if (!carrier)
    context.alarm(61319,
                  fmt::format("S_TC = {0}: $TC_CARR23[{0}], the kind of the kinematics, is not T, P or M", number));
  return *carrier;
}

/// Rotary axes that are to be measured: those with a vector, or with a name where a new data set has no vectors yet.
int axesOf(const ToolCarrier& carrier) { return carrier.axis[1].isZero() && carrier.axisName[1].empty() ? 1 : 2; }

/// Where rotary axis 0 or 1 stands, from the basic setting. An axis that the machine does not have is turned by hand:
/// the call tells.
double angleOf(const Context& context, const ToolCarrier& carrier, int axis) {
  const auto which = static_cast<std::size_t>(axis);
  const control::Channel& channel = context.control().channel;
  const auto& axes = channel.description().axes;
  const auto found = std::ranges::find_if(axes, [&](const machine::Axis& each) {
    return control::sinumerik::upperCase(each.name) == carrier.axisName[which];
  });
  const double position =
      found != axes.end()
          ? machine::shownPosition(*found, channel.axes()[static_cast<std::size_t>(found - axes.begin())])
          : context.real(axis == 0 ? "S_SETV0" : "S_SETV1");
  return position - carrier.basicSetting[which];
}

int digitOf(double count, int axis) {
  const long number = std::lround(std::abs(count));
  return static_cast<int>(axis == 0 ? number % 10 : number / 10 % 10);
}

void setCount(Context& context, int axis, int measurement) {
  const double before = context.control().ovr[counter];
  context.result(counter, axis == 0 ? 10 * digitOf(before, 1) + measurement : 10 * measurement + digitOf(before, 0));
}

double lengthAt(const Control& control, int index) {
  return control.ovr[static_cast<std::size_t>(index)] * control.unit;
}

/// Coordinates in the directions of the tool as it stands, its tip where the control believes it, whatever frames and
/// transformations are active; until it goes.
class ToolCoordinates {
public:
  ToolCoordinates(Control& control, const machine::MachineDescription& believed)
      : control_(control), before_(control.channel.description()) {
    control::Channel& channel = control.channel;
    const control::AxisPositions axes = channel.axes();
    channel.setDescription(believed);
    channel.setFollowing(control::Following::Kinematics, axes);
    channel.holdTip = false;
    Eigen::Affine3d frame = Eigen::Affine3d::Identity();
    frame.linear() = machine::baseFromSpindle(believed, axes).linear();
    channel.setFrame(frame);
  }
  ~ToolCoordinates() {
    control_.channel.setDescription(before_);
    control_.handOverFrames();
  }
  ToolCoordinates(const ToolCoordinates&) = delete;
  ToolCoordinates& operator=(const ToolCoordinates&) = delete;

private:
  Control& control_;
  machine::MachineDescription before_;
};

/// The ball's centre as the linear axes show it with the probe's ball in its place, less `tool`.
struct BallPlace {
  Vector3 centre, tool;
  double diameter = 0;
};

BallPlace measurePlace(Context& context, bool findDiameter) {
  Control& control = context.control();
  probing::SinumerikProber& prober = context.prober();
  if (maskBit(control.data, "$SCS_MEA_FUNCTION_MASK", 1) && control.channel.description().spindleOrients)
    context.positionSpindle(0);  // the directions are the spindle's own
  const int way = context.digit("S_MVAR", 3);
  if (way == 2 && !control.channel.description().spindleOrients) context.alarm(61372);
  const double probeRadius = prober.ballRadius(), path = context.real("S_FA");
  const bool toCentre = prober.probe().lengthToCentre;
  BallPlan plan = {
      .diameter = context.real("S_SETV"),
      .points = 4,
      .round = way > 0,
      .startAngle = context.real("S_STA1"),
      .alignProbe = way == 2,
      .findDiameter = findDiameter,
      .safeHeight = prober.position().z(),
      .path = path,
  };
  // The probe stands the measuring path above the pole.
  plan.centre = partAt(prober.position());
  plan.centre[2] -= path + plan.diameter / 2 + (toCentre ? probeRadius : 0);
  MeasuredBall ball = measureBall(context, plan);
  // The diameter of the ball is certified; the one found shows that it is the right ball.
  ball.centre[2] -= (plan.diameter - ball.diameter) / 2;
  prober.moveHeightTo(ball.centre.z() + plan.diameter / 2 + path + (toCentre ? probeRadius : 0));
  context.checkSafeArea(ball.diameter - plan.diameter);
  for (int axis = 0; axis < 3; ++axis)
    context.checkSafeArea(ball.centre[axis] - plan.centre[axis]);

  const control::Channel& channel = control.channel;
  const PlanePlace tip = tipAt(ball.centre, -((toCentre ? 0 : probeRadius) * prober.toolAxis()));
  const control::AxisPositions axes = channel.axesFromProgram(control.workingPlane().xyzFromPlane(tip), channel.axes());
  BallPlace place{.centre = Vector3::Zero(), .tool = channel.toolVector, .diameter = ball.diameter};
  if (!toCentre) place.tool -= probeRadius * place.tool.normalized();
  constexpr std::array names = {"X", "Y", "Z"};
  for (std::size_t i = 0; i < 3; ++i)
    if (const auto axis = channel.description().axisIndex(names[i]))
      place.centre[static_cast<Eigen::Index>(i)] = axes[*axis];
  place.centre -= place.tool;
  return place;
}

RotaryAxisMeasurement measurementOf(const Control& control, int axis) {
  RotaryAxisMeasurement measured;
  const control::sinumerik::MeasuredRotaryAxis& kept = control.measuredAxes[static_cast<std::size_t>(axis)];
  measured.tool = kept.tool.value_or(control.channel.toolVector);
  measured.otherAngle = kept.otherAngle;
  for (int k = 0; k < 3; ++k) {
    const auto place = static_cast<std::size_t>(k);
    for (int i = 0; i < 3; ++i)
      measured.ball[place][i] = lengthAt(control, ballAt(axis, k) + i);
    measured.angle[place] = control.ovr[static_cast<std::size_t>(positionAt(axis, k))];
  }
  return measured;
}

/// Alarm 61430 if the three places do not tell the axis.
RotaryLine lineOf(Context& context, const RotaryAxisMeasurement& measured, int axis) {
  const auto line = rotaryLine(measured);
  if (!line)
    context.alarm(61430,
                  fmt::format("the three places of the ball about rotary axis {} lie on one line: the positions of the "
                              "axis were {}, {} and {} degrees",
                              axis + 1, formatShortest(measured.angle[0]), formatShortest(measured.angle[1]),
                              formatShortest(measured.angle[2])));
  return *line;
}

void putVector(Context& context, int first, const Vector3& vector) {
  for (int i = 0; i < 3; ++i)
    context.result(first + i, vector[i]);
}

}  // namespace

void measureKinematics(Context& context) {
  Control& control = context.control();
  context.requireProbe({710, 580});
  context.requireCalibration();
  if (!(context.real("S_SETV") > 0)) context.alarm(61319, "S_SETV, the diameter, must be greater than 0");
  if (const double start = context.real("S_STA1"); context.digit("S_MVAR", 3) > 0 && !(start >= 0 && start <= 360))
    context.alarm(61319, "S_STA1 is between 0 and 360 degrees");
  const ToolCarrier carrier = carrierOfCall(context);
  const int axis = context.digit("S_MVAR", 5) - 1, measurement = context.digit("S_MVAR", 1) - 1;
  const auto which = static_cast<std::size_t>(axis);
  if (axis >= axesOf(carrier))
    context.alarm(61307, fmt::format("swivel data set {} has no rotary axis 2", context.integer("S_TC")));
  if (measurement == 0) {
    for (int index = ballAt(axis, 0); index < ballAt(axis, 3); ++index)
      control.ovr[static_cast<std::size_t>(index)] = 0;
    setCount(context, axis, 0);
  } else if (digitOf(control.ovr[counter], axis) < measurement) {
    context.alarm(61430, fmt::format("measurement {} of rotary axis {} is missing", measurement, axis + 1));
  }

  // A data set without vectors is about to be measured for the first time.
  const auto described = control::sinumerik::withCarrier(control.told(), carrier);
  const machine::MachineDescription believed = described ? *described : control.told();
  const bool first = axis == 0 && measurement == 0;
  const BallPlace place = [&] {
    const ToolCoordinates coordinates(control, believed);
    return measurePlace(context, first);
  }();

  control.measuredAxes[which] = {place.tool, angleOf(context, carrier, 1 - axis)};
  putVector(context, ballAt(axis, measurement), place.centre);
  context.result(positionAt(axis, measurement), angleOf(context, carrier, axis));
  if (first) {
    const auto& geometry = control.frames.settableFrame.geometry;
    for (std::size_t i = 0; i < 3; ++i)
      context.result(zeroOffsetRotation + static_cast<int>(i), geometry[i].rotation);
    context.result(ballDiameter, place.diameter, {.nominal = context.real("S_SETV")});
  }
  setCount(context, axis, measurement + 1);
  context.resultInteger(3, context.integer("S_MVAR"));
  context.resultInteger(8, context.integer("S_TC"));
  if (measurement < 2) return;
  const RotaryAxisMeasurement measured = measurementOf(control, axis);
  putVector(context, linearVectorAt(axis),
            linearVector(lineOf(context, measured, axis), measured, carrier.inHead(axis)));
}

namespace {

/// How far the new vectors may be from those of the data set: S_SETV4 and S_SETV5. What exceeds it, in words; empty if
/// nothing does.
std::string beyondTolerance(const Context& context, const ToolCarrier& before, const ToolCarrier& now) {
  std::string text;
  const auto add = [&](const std::string& name, double difference, double limit, const char* unit) {
    if (difference > limit + 1e-9)
      text += fmt::format("{}{} differs by {:.6f} {}, {} are allowed", text.empty() ? "" : "; ", name, difference, unit,
                          formatShortest(limit));
  };
  for (std::size_t i = 0; i < 4; ++i)
    add(fmt::format("I{}", i + 1), (now.offset[i] - before.offset[i]).norm(), context.real("S_SETV4"), "mm");
  for (std::size_t i = 0; i < 2; ++i)
    add(fmt::format("V{}", i + 1),
        degreesFromRadians(std::atan2(before.axis[i].cross(now.axis[i]).norm(), before.axis[i].dot(now.axis[i]))),
        context.real("S_SETV5"), "deg");
  return text;
}

/// What the operator changes of the data set shown: V1 and V2 by name, which only so go into the data set, and single
/// data as $TC_CARR4=25.013.
struct Edits {
  std::array<bool, 2> axis{};
  std::vector<std::pair<int, double>> data;
};

std::optional<Edits> editsFrom(const std::string& text) {
  Edits edits;
  std::istringstream words(control::sinumerik::upperCase(text));
  constexpr std::string_view stem = "$TC_CARR";
  for (std::string word; words >> word;) {
    if (word == "V1" || word == "V2") {
      edits.axis[word == "V1" ? 0 : 1] = true;
      continue;
    }
    const std::size_t equals = word.find('=');
    if (!word.starts_with(stem) || equals == std::string::npos) return std::nullopt;
    const auto datum = parseInteger(word.substr(stem.size(), equals - stem.size()));
    const auto value = parseDecimal(word.substr(equals + 1));
    const bool offsetOrAxis = datum && ((*datum >= 1 && *datum <= 12) || (*datum >= 15 && *datum <= 20));
    if (!offsetOrAxis || !value) return std::nullopt;
    edits.data.emplace_back(static_cast<int>(*datum), *value);
  }
  return edits;
}

/// The first free name of NAME_M1 to NAME_M99; after that the last is written anew.
std::string logName(const Control& control, const ToolCarrier& carrier, int number) {
  std::string name = carrier.name.empty() ? fmt::format("TCARR{}", number) : carrier.name;
  std::ranges::replace_if(
      name, [](char c) { return !isLetter(c) && !isDigit(c) && c != '_' && static_cast<unsigned char>(c) < 128; }, '_');
  for (int i = 1; i < 99; ++i)
    if (std::string file = fmt::format("{}_M{}.SPF", name, i); !control.panel.files().contains(file)) return file;
  return name + "_M99.SPF";
}

void enter(Context& context, int number, const ToolCarrier& before, const KinematicsEvaluation& found) {
  Control& control = context.control();
  const bool shown = context.digit("_AMODE", 3) == 1, edited = shown && context.digit("_AMODE", 4) == 1;
  const bool atOnce = context.digit("_AMODE", 2) == 1 && !shown && context.digit("_AMODE", 4) == 0;
  std::vector<DatumValue> data = offsetData(control.data, number, found.carrier);
  if (edited && control.panel.answer) {
    const control::Question question{
        "996 swivel data set",
        "V1 and V2 where the measured vector is to be entered, and data as $TC_CARR4=25.013; nothing: as calculated",
        [](const std::string& text) { return editsFrom(text).has_value(); }};
    const auto answer = control.panel.answer(question);
    const auto edits = answer ? editsFrom(*answer) : std::optional<Edits>(Edits{});
    if (!edits)
      context.alarm(61319,
                    fmt::format("the answer \"{}\" to \"{}\": give {}", *answer, question.name, question.wanted));
    for (std::size_t i = 0; i < 2; ++i) {
      if (!edits->axis[i]) continue;
      for (int k = 0; k < 3; ++k)
        data.push_back(
            {control::sinumerik::carrierDatum(control::sinumerik::firstDatumOfAxis(static_cast<int>(i)) + k, number),
             found.carrier.axis[i][k]});
    }
    for (const auto& [datum, value] : edits->data)
      data.push_back({control::sinumerik::carrierDatum(datum, number), value});
  }
  if (!atOnce)
    control.panel.stop(fmt::format("The vectors go into swivel data set {} {}: NC start enters them, RESET does not",
                                   number, before.name),
                       control.channel.seconds());
  for (const DatumValue& datum : data)
    control.write(datum.key, datum.value);
}

}  // namespace

void calculateKinematics(Context& context) {
  Control& control = context.control();
  const ToolCarrier before = carrierOfCall(context);
  const int number = context.integer("S_TC"), count = axesOf(before);
  double limit = context.real("S_TNVL");
  if (limit == 0) limit = 20;
  if (limit < 1 || limit > 60) context.alarm(61319, "S_TNVL is between 1 and 60 degrees");

  std::array<std::optional<RotaryLine>, 2> lines;
  std::array<RotaryAxisMeasurement, 2> measured;
  std::array<Normalisation, 2> normalisation;
  for (int axis = 0; axis < count; ++axis) {
    const auto which = static_cast<std::size_t>(axis);
    if (const int done = digitOf(control.ovr[counter], axis); done != 3)
      context.alarm(61430, fmt::format("{} of the three measurements of rotary axis {} {} there", done, axis + 1,
                                       done == 1 ? "is" : "are"));
    measured[which] = measurementOf(control, axis);
    lines[which] = lineOf(context, measured[which], axis);
    if (lines[which]->leastAngle < limit - 1e-9)
      context.alarm(61430, fmt::format("the triangle of the balls about rotary axis {} has an angle of {:.3f} degrees, "
                                       "S_TNVL asks for {}",
                                       axis + 1, lines[which]->leastAngle, formatShortest(limit)));
    const int along = context.digit("S_MVAR", 6 + axis);
    if (along > 0) {
      const Vector3 direction = control.workingPlane().xyzFromPlane(PlaneWay::unit(along - 1)).vector();
      Eigen::Index place = 0;
      direction.cwiseAbs().maxCoeff(&place);
      normalisation[which] = {static_cast<int>(place), context.real(axis == 0 ? "S_SETV2" : "S_SETV3")};
    }
  }
  const auto found = evaluateKinematics(before, lines, measured, normalisation,
                                        context.digit("S_MVAR", 5) == 3 ? Chain::Open : Chain::Closed);
  if (!found)
    context.alarm(61430,
                  "a rotary axis cannot be normalised in a direction at right angles to it: see 10^5 and 10^6 of "
                  "S_MVAR");

  const ToolCarrier& now = found->carrier;
  for (int vector = 0; vector < 4; ++vector)
    putVector(context, control::sinumerik::firstDatumOfOffset(vector), now.offset[static_cast<std::size_t>(vector)]);
  for (int axis = 0; axis < 2; ++axis) {
    putVector(context, control::sinumerik::firstDatumOfAxis(axis), now.axis[static_cast<std::size_t>(axis)]);
    putVector(context, linearVectorAt(axis), found->linear[static_cast<std::size_t>(axis)]);
  }
  context.result(counter, control.ovr[counter]);
  context.resultInteger(3, context.integer("S_MVAR"));
  context.resultInteger(8, number);

  if (context.digit("S_MVAR", 8) == 1) {
    const std::string file = logName(control, before, number);
    control.panel.file(file, kinematicsProgram(control.data, number, before, now));
    context.record().logFiles.push_back(file);
  }
  if (context.digit("_AMODE", 3) == 1) context.record().screens.push_back(kinematicsScreen(number, before, now));
  if (context.digit("_AMODE", 1) == 1) {
    const std::string exceeded = beyondTolerance(context, before, now);
    if (!exceeded.empty()) context.alarm(61430, exceeded);
  }
  if (context.digit("S_MVAR", 4) == 1) enter(context, number, before, *found);
}

}  // namespace probewright::cycles::sinumerik

#include "cycles/heidenhain/tool_measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "cycles/heidenhain/probe_words.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::MachineParameters;
using control::heidenhain::NumberColumn;
using machine::Rotation;

ToolProbingSpeeds toolProbingSpeeds(const MachineParameters& parameters, double radius) {
  // 0.0063: 2 pi / 1000 as the manuals print it.
  const double wanted = radius > 0 ? parameters.maxPeriphSpeedMeas / (radius * 0.0063) : parameters.maxSpeed;
  constexpr int lowestSpeedBit = 1 << 4;
  const bool lowest = parameters.minimumSpindleSpeed || (parameters.mp6500 & lowestSpeedBit) != 0;
  const double spindle = lowest ? parameters.lowestSpindleSpeed : std::min(wanted, parameters.maxSpeed);
  double wider = 1;  // than measureTolerance1 and 2
  switch (parameters.probingFeedCalc) {
    case 1:  // in steps of 30 mm; beyond 120 mm it grows no more
      wider = std::clamp(std::ceil(radius / 30), 1.0, 4.0);
      break;
    case 2:
      wider = radius / 5;
      break;
    default:
      break;
  }
  return {spindle, parameters.measureTolerance1 * wider * spindle, parameters.measureTolerance2 * wider * spindle};
}

probing::ToolTouchProbe toolTouchProbe(const Control& control, Contact contact) {
  const MachineParameters& parameters = control.parameters;
  const bool calibrated = contact == Contact::Calibrated;
  const PartInMachine place = calibrated ? PartInMachine(parameters.contactX, parameters.contactY, parameters.contactZ)
                                         : PartInMachine(parameters.mp6580x, parameters.mp6580y, parameters.mp6580z);
  if (!calibrated && place.vector().isZero(0)) {
    throw Alarm("Tool touch probe not defined",
                control.isTNC640() ? "centerPos does not say where the tool touch probe is"
                                   : "MP6580.0 to MP6580.2 do not say where the tool touch probe is",
                "enter its position in [parameters], or [tool_probe] in the setup");
  }
  if (calibrated && !(parameters.contactRadius1 > 0 && parameters.contactRadius2 > 0)) {
    throw Alarm("Tool touch probe not calibrated", "The tool touch probe has never been calibrated",
                "calibrate it with cycle 480 and an exact tool");
  }
  probing::ToolTouchProbe probe{.place = place,
                                .size = parameters.mp6531,
                                .size2 = parameters.mp6531,
                                .depth = parameters.mp6530,
                                .clearance = parameters.mp6540,
                                .feed = parameters.mp6520,
                                .rapid = parameters.mp6550};
  if (calibrated) {
    probe.size = 2 * parameters.contactRadius1;
    probe.size2 = 2 * parameters.contactRadius2;
  }
  // So much wrong may tool and place be believed.
  constexpr double search = 15;  // mm
  probe.reach = probe.clearance + search;
  return probe;
}

ProbingSide probingSide(const MachineParameters& parameters) {
  return {parameters.probingDirRadial % 2, parameters.probingDirRadial < 2 ? 1 : -1};
}

namespace {

constexpr const char* noComparison = "The iTNC 530 measures (0) or checks (1) tools; it does not only compare (2)";
constexpr const char* otherModes = "enter 0 or 1";

ToolRequest permitted(Context& context, ToolRequest request) {
  if (request.mode == 2 && !context.control().isTNC640())
    throw Alarm("Cycle parameter wrong", noComparison, otherModes);
  return request;
}

}  // namespace

ToolRequest newRequest(Context& context) {
  return permitted(context, {context.option(340), context.q(260), context.option(341) == 1, 199});
}

void toolRules(CallRules& call) {
  const std::uint32_t mode = call.has(340) ? 340 : probe_word::check;
  if (call.kind() == ControlKind::iTNC530 && call.number(mode) == 2) call.add(mode, noComparison, otherModes);
}

int toolStatus(double deviation, double wear, double breakage) {
  if (breakage > 0 && std::abs(deviation) > breakage) return 2;
  return wear > 0 && std::abs(deviation) > wear ? 1 : 0;
}

const char* statusMark(int status) { return status == 2 ? " B" : status == 1 ? " *" : ""; }

ToolRequest oldRequest(Context& context) {
  ToolRequest request{context.option(probe_word::check), context.q(probe_word::height),
                      context.option(probe_word::teeth) == 1, std::nullopt};
  if (context.given(probe_word::result)) request.status = context.option(probe_word::result);
  return permitted(context, request);
}

namespace {

constexpr std::string_view turningTool = "turning tool";

/// What the active tool is, if it is one that these cycles do not measure.
std::string_view notMeasured(const Control& control) {
  if (!control.tool.probeRow.empty()) return "touch probe";
  if (!control.isTNC640()) return {};
  constexpr std::pair<std::string_view, std::string_view> kinds[] = {
      {"TURN", turningTool}, {"TCHP", "touch probe"}, {"GRIND", "grinding tool"}, {"DRESS", "dressing tool"}};
  const std::string type = control.tables.tools.text(control.tool.row, "TYP");
  const auto* found = std::ranges::find(kinds, type, &std::pair<std::string_view, std::string_view>::first);
  return found == std::end(kinds) ? std::string_view() : found->second;
}

}  // namespace

void requireMeasurable(Context& context) {
  Control& control = context.control();
  requireEnabled(control);
  const auto& tools = control.tables.tools;
  const std::string& row = control.tool.row;
  if (row == "0" || !tools.hasRow(row)) {
    throw Alarm("Tool not defined", "The tool to be measured has no row in TOOL.T",
                "program TOOL CALL with the tool before the cycle");
  }
  if (control.tool.axis != 'Z')
    throw Alarm("Tool axis not permitted", "The contact of the tool touch probe faces the tool axis Z",
                "program TOOL CALL with axis Z");
  const std::string_view kind = notMeasured(control);
  if (!kind.empty()) {
    throw Alarm("Tool type not permitted",
                fmt::format("Tool {} is a {}; the cycle measures mills and drills", row, kind),
                kind == turningTool ? "measure turning tools with cycle 485" : "call the tool that is to be measured");
  }
}

double ToolDimension::value() const {
  if (teeth.empty()) return *whole;
  return *std::ranges::max_element(teeth);
}

ToolMeasurement::ToolMeasurement(Context& context, const ToolRequest& request)
    : context_(context),
      request_(request),
      channel_(context.channel()),
      settings_(toolMeasuringSettings(context.control())),
      probe_(toolTouchProbe(context.control(), Contact::Calibrated)),
      prober_(channel_, context.control().coordinates.plane, probe_,
              [&] {
                const auto& plane = context.control().coordinates.plane;
                ProgramPlace clearance = context.channel().position();
                clearance[plane.tool] = request.clearanceHeight;
                return context.channel().machineFromProgram(clearance)[plane.tool];
              }()),
      radius_(channel_.toolRadius),
      speeds_(toolProbingSpeeds(context.control().parameters, radius_)) {
  const ProbingSide probed = probingSide(context.control().parameters);
  axis_ = probed.axis;
  sense_ = probed.sense;
  const auto& tools = context.control().tables.tools;
  const std::string& row = context.control().tool.row;
  teeth_ = truncated(tools.numberOr(row, "CUT", 0));
  const int most = context.control().isTNC640() ? 20 : 99;
  if (request.teeth && !settings_.teeth) {
    throw Alarm("Function not enabled",
                fmt::format("The machine does not measure single teeth ({})",
                            context.control().isTNC640() ? "probingCapability" : "MP6500"),
                "measure the whole tool");
  }
  if (request.teeth && (teeth_ < 1 || teeth_ > most)) {
    throw Alarm(
        "Number of teeth not permitted",
        fmt::format("Tool {} has {} teeth (CUT); single teeth are measured of tools with 1 to {}", row, teeth_, most),
        "enter the number of teeth in TOOL.T, or measure the whole tool");
  }
}

double ToolMeasurement::column(NumberColumn name) const {
  const Control& control = context_.control();
  return control.tables.tools.numberOr(control.tool.row, name, 0);
}

/// Against its cutting direction, so that the edges do not cut into the contact.
void ToolMeasurement::turn() {
  const Control& control = context_.control();
  const bool cutsLeft = control.tables.tools.text(control.tool.row, "DIRECT") == "+";
  channel_.turnSpindle(cutsLeft ? Rotation::Clockwise : Rotation::CounterClockwise, speeds_.spindle);
  turns_ = true;
}

void ToolMeasurement::stand() {
  if (channel_.spindleRotation() != Rotation::None) channel_.turnSpindle(Rotation::None, 0);
  turns_ = false;
}

double ToolMeasurement::lengthAt(const probing::ToolTouch& touch) const {
  const int axis = context_.control().coordinates.plane.tool;
  return touch.tip[axis] + channel_.toolVector.norm() - probe_.place[axis];
}

double ToolMeasurement::radiusAt(const probing::ToolTouch& touch) const {
  const auto& plane = context_.control().coordinates.plane;
  const int axis = axis_ == 0 ? plane.main : plane.minor;
  const double half = (axis_ == 0 ? probe_.size : probe_.size2) / 2;
  // Along the axis a turned face is farther than at right angles to it.
  const double turned = radiansFromDegrees(context_.control().parameters.contactAngle);
  return std::abs(touch.tip[axis] - probe_.place[axis]) * std::cos(turned) - half;
}

template <class Touch>
probing::ToolTouch ToolMeasurement::touched(const Touch& touch) {
  prober_.setFeed(turns_ ? speeds_.feed : probe_.feed);
  const probing::ToolTouch first = touch();
  if (!turns_ || !(speeds_.fineFeed > 0)) return first;
  prober_.setFeed(speeds_.fineFeed);
  return touch();
}

probing::ToolTouch ToolMeasurement::side() {
  return touched([&] { return prober_.touchSide(axis_, sense_, radius_, probe_.depth + column("L-OFFS")); });
}

probing::ToolTouch ToolMeasurement::above(double offset) {
  Vector2 place = Vector2::Zero();
  place[axis_] = -sense_ * offset;
  return touched([&] { return prober_.touchTop(place); });
}

/// The tooth that has touched points to the contact at the angle of the spindle then.
void ToolMeasurement::findTeeth(const probing::ToolTouch& touch) {
  if (!touch.spindleAngle) {
    throw Alarm("Spindle orientation not possible", "The machine does not say how its spindle stands at the touch",
                "measure the whole tool instead of its teeth");
  }
  firstTooth_ = touch.spindleAngle;
}

void ToolMeasurement::orientTo(double tooth) {
  stand();
  channel_.orientSpindle(std::remainder(*firstTooth_ + 360 * tooth / teeth_, 360));
}

/// How far the tool's axis is from the middle of the contact while a tooth is measured: the lowest part of that tooth,
/// which ends where its corner begins, is above it, and that of no other tooth.
double ToolMeasurement::toothLengthOffset() const {
  const Control& control = context_.control();
  if (const auto entered = control.tables.tools.number(control.tool.row, "R-OFFS")) return *entered;
  const double pitch = std::min(2 * std::numbers::pi / teeth_, std::numbers::pi / 2);
  const double half = (axis_ == 0 ? probe_.size : probe_.size2) / 2;
  const double flat = std::clamp(radius_ - column("R2"), 0.0, radius_);
  return half + flat * (1 + std::cos(pitch)) / 2;
}

void ToolMeasurement::measureLength() {
  const Control& control = context_.control();
  ToolDimension measured;
  if (request_.teeth) {
    if (!firstTooth_) {
      turn();
      findTeeth(side());
    }
    const double offset = toothLengthOffset();
    for (int tooth = 0; tooth < teeth_; ++tooth) {
      prober_.rise();
      orientTo(tooth);
      measured.teeth.push_back(lengthAt(above(offset)));
    }
  } else {
    const double offset = control.tables.tools.number(control.tool.row, "R-OFFS").value_or(radius_);
    if (offset == 0 && !settings_.standingLength) {
      throw Alarm("Function not enabled",
                  fmt::format("R-OFFS of tool {} is 0, but no length is measured with a stationary spindle (MP6500)",
                              control.tool.row),
                  "enter R-OFFS, or measure the tool by hand");
    }
    const bool stands = offset == 0 || !settings_.rotating;
    stands ? stand() : turn();
    measured.whole = lengthAt(above(offset));
  }
  prober_.rise();
  length_ = std::move(measured);
}

void ToolMeasurement::measureRadius() {
  const Control& control = context_.control();
  // CUT = 0: round, as with a diamond surface.
  const bool round = control.tables.tools.number(control.tool.row, "CUT") == 0.0;
  if (!settings_.rotating && !(round && settings_.standingRadius)) {
    throw Alarm("Function not enabled",
                fmt::format("The machine measures with a stationary spindle only ({})",
                            control.isTNC640() ? "probingCapability" : "MP6500"),
                "measure the length with cycle 481");
  }
  if (!(radius_ > 0)) {
    throw Alarm("Tool radius not defined", fmt::format("Tool {} has no radius in TOOL.T", control.tool.row),
                "enter the approximate radius in TOOL.T");
  }
  ToolDimension measured;
  round ? stand() : turn();
  const probing::ToolTouch touch = side();
  measured.whole = radiusAt(touch);
  if (request_.teeth) {
    findTeeth(touch);
    for (int tooth = 0; tooth < teeth_; ++tooth) {
      orientTo(tooth);
      measured.teeth.push_back(radiusAt(side()));
    }
  }
  measuredRadius_ = std::move(measured);
}

namespace {

/// Columns and result of a length or a radius.
struct Entries {
  NumberColumn nominal, delta, wear, breakage;
  int result;
  const char* title;
};

constexpr Entries lengthEntries{"L", "DL", "LTOL", "LBREAK", 115, "LENGTH"};
constexpr Entries radiusEntries{"R", "DR", "RTOL", "RBREAK", 116, "RADIUS"};

}  // namespace

/// Writes what the mode asks for; returns the status.
int ToolMeasurement::enter(const ToolDimension& dimension, Of of) {
  Control& control = context_.control();
  auto& tools = control.tables.tools;
  const std::string& row = control.tool.row;
  const Entries& entries = of == Of::Length ? lengthEntries : radiusEntries;
  const double value = dimension.value(), nominal = column(entries.nominal);
  const double wear = column(entries.wear), breakage = column(entries.breakage);
  show(dimension, of);
  int status = toolStatus(value - nominal, wear, breakage);
  for (const double tooth : dimension.teeth)
    status = std::max(status, toolStatus(tooth - nominal, wear, breakage));
  if (request_.mode == 0) {
    if (!settings_.entersMeasured) return status;
    control.writeNumbers({{tools, row, entries.nominal, value}, {tools, row, entries.delta, 0}});
  } else {
    context_.result(entries.result, value - nominal, {.nominal = 0.0});
    if (request_.mode == 1 && settings_.entersChecked) control.writeNumber(tools, row, entries.delta, value - nominal);
  }
  return status;
}

void ToolMeasurement::stopIfBroken(int status) const {
  if (status != 2) return;
  const std::string& row = context_.control().tool.row;
  if (request_.mode == 1 && settings_.stopsOnCheck) {
    throw Alarm("Tool breakage",
                fmt::format("Tool {} is beyond its breakage tolerance (LBREAK, RBREAK); it is locked", row),
                "change the tool, then release it in TOOL.T (column TL)");
  }
  if (request_.mode == 0 && settings_.stopsOnMeasurement) {
    throw Alarm(
        "Tool breakage",
        fmt::format("Tool {} differs from what TOOL.T said by more than its breakage tolerance (LBREAK, RBREAK)", row),
        "check the tool and its entries in TOOL.T");
  }
}

/// The display of tool measurement. That of the iTNC 530 has room for 24 teeth.
void ToolMeasurement::show(const ToolDimension& dimension, Of of) {
  const Entries& entries = of == Of::Length ? lengthEntries : radiusEntries;
  const double nominal = column(entries.nominal);
  const auto mark = [&](double value) {
    if (request_.mode == 0) return "";
    return statusMark(toolStatus(value - nominal, column(entries.wear), column(entries.breakage)));
  };
  screen_ += fmt::format("{}\n", entries.title);
  if (dimension.whole) screen_ += fmt::format("  {}{}\n", formatSigned(*dimension.whole, 4), mark(*dimension.whole));
  if (dimension.teeth.empty()) return;
  const auto [least, most] = std::ranges::minmax(dimension.teeth);
  screen_ += fmt::format("  MIN {}  MAX {}\n", formatSigned(least, 4), formatSigned(most, 4));
  const std::size_t room = context_.control().isTNC640() ? dimension.teeth.size() : 24;
  for (std::size_t i = 0; i < std::min(room, dimension.teeth.size()); ++i)
    screen_ += fmt::format("  {:2} {}{}\n", i + 1, formatSigned(dimension.teeth[i], 4), mark(dimension.teeth[i]));
}

void ToolMeasurement::finish() {
  prober_.rise();
  stand();
  Control& control = context_.control();
  const std::string row = control.tool.row;
  screen_ = fmt::format("TOOL {}{}{}\n", row, control.tool.name.empty() ? "" : " ", control.tool.name);
  int status = 0;
  if (length_) status = std::max(status, enter(*length_, Of::Length));
  if (measuredRadius_) status = std::max(status, enter(*measuredRadius_, Of::Radius));
  context_.record().screens.push_back(screen_);
  const int told = request_.mode == 0 ? 0 : status;
  if (request_.status == 199) {
    context_.result(199, told);
  } else if (request_.status) {
    context_.set(*request_.status, told);
  }
  const bool locks = request_.mode == 1 && status > 0;
  if (locks) control.writeText(control.tables.tools, row, "TL", "L");
  control.refreshTool();
  stopIfBroken(status);
}

void measureTool(Context& context, const ToolRequest& request, ToolDimensions dimensions) {
  requireMeasurable(context);
  ToolMeasurement measurement(context, request);
  const bool length = dimensions != ToolDimensions::Radius, radius = dimensions != ToolDimensions::Length;
  const bool radiusFirst = radius && (request.teeth || !context.control().isTNC640());
  if (radiusFirst) measurement.measureRadius();
  if (length) measurement.measureLength();
  if (radius && !radiusFirst) measurement.measureRadius();
  measurement.finish();
}

}  // namespace probewright::cycles::heidenhain

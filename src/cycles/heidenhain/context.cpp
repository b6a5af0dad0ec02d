#include "cycles/heidenhain/context.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/number_text.hpp"
#include "control/alarm.hpp"
#include "control/heidenhain/deflection_table.hpp"
#include "control/heidenhain/probe_table.hpp"
#include "cycles/heidenhain/call_rules.hpp"

namespace probewright::cycles::heidenhain {

using control::Alarm;
using control::heidenhain::Transformations;

namespace {

const Parameter& parameterOf(const Arguments& arguments, int number) {
  return *arguments.definition().parameter(static_cast<std::uint32_t>(number));
}

std::string textOf(const Argument& argument) {
  return argument.isText ? argument.text : formatShortest(argument.number);
}

/// Refuses parameters that the iTNC 530 got with a later software.
void requireSoftware(const Arguments& arguments, int version) {
  const CycleDefinition& definition = arguments.definition();
  for (const Parameter& parameter : definition.parameters) {
    if (parameter.iTNC530Software <= version || !arguments.given(parameter.address)) continue;
    throw Alarm(
        "Cycle parameter wrong",
        fmt::format("{} ({}) of cycle {} came with the NC software 340 49x-{:02}; this control has 340 49x-{:02}",
                    parameter.name, parameter.meaning, definition.name, parameter.iTNC530Software, version),
        "take the parameter out of the cycle, or set softwareVersion in [parameters]");
  }
}

bool forbids(const ForbiddenTransformations& forbidden, Transformations active) {
  if (!forbidden.shift) active.shift.setZero();
  if (!forbidden.rotation) active.rotation = 0;
  return forbidden.other && active.active();
}

}  // namespace

bool rotaryAxesMatchTilt(const Control& control) {
  const control::Channel& channel = control.channel;
  const machine::MachineDescription& description = channel.description();
  const machine::AxisPositions now = channel.axes();
  Vector3 toolAxis = Vector3::Zero();
  toolAxis[control.coordinates.plane.tool] = 1;
  const Vector3 onTable = machine::baseFromTable(description, control.coordinates.preset.rotaryOffset).linear() *
                          machine::baseFromTable(description, now).linear().transpose() *
                          machine::baseFromSpindle(description, now).linear() * toolAxis;
  const ProgramWay inProgram = channel.programFromMachine(MachineWay(onTable)).normalized();
  return inProgram.cross(ProgramWay(toolAxis)).norm() < radiansFromDegrees(0.01);
}

Context::Context(Control& control, const Entry& entry, const Arguments& arguments, SourcePlace place)
    : control_(control), entry_(entry), arguments_(arguments) {
  const CycleDefinition& definition = arguments.definition();
  control::CycleRecord record;
  record.name = definition.name;
  record.title = definition.title;
  record.place = std::move(place);
  record.plane = control.coordinates.plane;
  for (std::size_t i = 0; i < definition.parameters.size(); ++i) {
    const Argument& value = arguments.values()[i];
    const Parameter& parameter = definition.parameters[i];
    if (!parameter.controls.contains(control.kind())) continue;
    record.parameters.push_back(
        {std::string(parameter.name), textOf(value), std::string(parameter.meaning), !value.given,
         value.isText ? std::nullopt
                      : std::optional(inMillimetres(parameter, value, control.unit, control.feedUnit()))});
  }
  record.startSeconds = control.channel.seconds();
  record_ = control.journal.cycles.size();
  control.journal.begin(std::move(record));
}

Context::~Context() {
  control_.setProbing(false);
  record().endSeconds = control_.channel.seconds();
  control_.journal.cycleOpen = false;
}

double Context::q(int number) const {
  const Parameter& parameter = parameterOf(arguments_, number);
  return inMillimetres(parameter, arguments_.at(parameter.address), control_.unit, control_.feedUnit());
}

void Context::requireConditions() {
  const Conditions& conditions = entry_.conditions;
  const int level = control_.parameters.featureLevel;
  if (!control_.isTNC640() && level < conditions.featureLevel) {
    throw Alarm("Function not enabled",
                fmt::format("The cycle belongs to feature content level {}; this control has level {} (FCL)",
                            conditions.featureLevel, level),
                "enable the feature content level, or measure with another cycle");
  }
  if (control_.grindingMode) {
    throw Alarm("Function not permitted", "The cycle does not run in grinding mode or while a tool is dressed",
                "program FUNCTION MODE MILL before it, and FUNCTION DRESS END after dressing");
  }
  if (control_.turningMode && !conditions.turningMode) {
    throw Alarm("Function not permitted", "The cycle runs in milling mode only",
                "program FUNCTION MODE MILL before it");
  }
  const bool probes = conditions.uses != Uses::Nothing;
  if (!control_.tool.called && probes) {
    throw Alarm("Touch probe axis not defined", "No tool has been called before the cycle",
                "program TOOL CALL with the touch probe and its axis");
  }
  const ForbiddenTransformations forbidden = forbiddenTransformations(conditions);
  const bool transformed =
      forbids(forbidden, control_.coordinates.workpiece) || forbids(forbidden, control_.coordinates.workingPlane);
  if (transformed && control_.isTNC640() && control_.parameters.refuseTransformations) {
    throw Alarm("Coordinate transformation not permitted", fmt::format("A {}", transformationsText(forbidden)),
                "reset the transformation before the cycle");
  }
  const bool mayDiffer = conditions.mismatchWithTcpm && control_.channel.holdTip;
  if (control_.parameters.checkTiltingAxes && probes && !mayDiffer && !rotaryAxesMatchTilt(control_)) {
    throw Alarm("Rotary axes and tilt do not match",
                "The positions of the rotary axes do not agree with the tilt of the working plane (chkTiltingAxes)",
                "move the rotary axes to the tilt, or correct PLANE");
  }
  if (control_.coordinates.tilt && !conditions.tilted.contains(control_.kind())) {
    throw Alarm("Tilted working plane not permitted", "The cycle does not run in a tilted working plane",
                "reset PLANE or cycle 19 before the cycle");
  }
  if (conditions.uses == Uses::TouchProbe) control_.setProbing(true);
}

probing::HeidenhainProber& Context::prober() {
  if (!prober_) {
    const probing::HeidenhainProbe probe = activeProbe(control_);
    orientToCalibration(control_.channel, probe);
    prober_.emplace(control_.channel, control_.coordinates.plane, probe);
  }
  return *prober_;
}

probing::Between betweenOf(const Context& context) {
  return context.option(301) == 1 ? probing::Between::AtClearanceHeight : probing::Between::AtMeasuringHeight;
}

void orientToCalibration(control::Channel& channel, const probing::HeidenhainProbe& probe) {
  const machine::MachineDescription& machine = channel.description();
  if (!machine.spindleOrients || machine.mainSpindle || probe.track) return;
  if (std::abs(std::remainder(channel.spindleAngle() - probe.calibrationAngle, 360.0)) > 1e-9) {
    channel.orientSpindle(probe.calibrationAngle);
  }
}

Eigen::Affine3d Context::machineFromProgram() {
  const control::Channel& channel = control_.channel;
  if (channel.following() != control::Following::Kinematics) return channel.frame();
  const machine::MachineDescription& machine = channel.description();
  // Linear axes count alike whether they move the table or the tool.
  machine::AxisPositions turned = channel.axes();
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    if (machine.axes[i].kind != machine::AxisKind::Rotary) turned[i] = 0;
  }
  return machine::baseFromTable(machine, turned) * machine::baseFromTable(machine, channel.reference()).inverse() *
         channel.frame();
}

void Context::result(int number, double value, const Compared& compared) {
  value += 0.0;  // no -0
  const std::string name = fmt::format("Q{}", number);
  const ResultDefinition* definition = arguments_.definition().result(name);
  const ValueKind kind = definition == nullptr ? ValueKind::Number : definition->valueKind();
  control_.q.setQ(number, kind == ValueKind::Length ? value / control_.mainUnit : value);
  record().results.push_back(resultRecord(name, definition, kind, value, compared));
}

void Context::stop(const std::string& text) {
  record().screens.push_back(text);
  control_.panel.stop(text, control_.channel.seconds());
}

void Context::log(const std::string& name, const std::string& text) {
  control_.panel.file(name, text);
  if (std::ranges::find(record().logFiles, name) == record().logFiles.end()) record().logFiles.push_back(name);
}

namespace {

/// Throws what the rules of the cycle refuse.
void requireSoundCall(const Arguments& arguments, ControlKind kind) {
  const KnownValue known = [&](std::uint32_t address) { return std::optional(arguments.at(address)); };
  for (const CallMistake& mistake : callMistakes(arguments.definition(), kind, known)) {
    if (!mistake.alarm.empty()) throw Alarm(mistake.alarm, mistake.message, mistake.advice);
  }
}

}  // namespace

void runCycle(Control& control, const Entry& entry, const Arguments& arguments, const SourcePlace& place) {
  const Diagnostics mistakes = check(arguments, control.kind());
  if (!mistakes.empty()) throw Alarm("Cycle parameter wrong", mistakes.front().message, mistakes.front().advice);
  if (!control.isTNC640()) requireSoftware(arguments, control.parameters.softwareVersion);
  Context context(control, entry, arguments, place);
  try {
    context.requireConditions();
    requireSoundCall(arguments, control.kind());
    entry.run(context, arguments);
  } catch (const Alarm& alarm) {
    context.record().alarm = alarm.code().empty() ? alarm.text() : alarm.code() + ": " + alarm.text();
    throw;
  }
}

namespace {

void applyOverrides(probing::HeidenhainProbe& probe, const control::heidenhain::ProbingOverrides& overrides) {
  probe.positioningFeed = overrides.positioningFeed.value_or(probe.positioningFeed);
  probe.prepositionAtMachineRapid = overrides.machineRapid.value_or(probe.prepositionAtMachineRapid);
  probe.track = overrides.track.value_or(probe.track);
}

/// Feeds and ways with which a probe can be moved: what the editor of the control takes for them.
void requireSound(const control::heidenhain::TouchProbe& probe, const std::string& row) {
  const auto refuse = [&row](const char* column, double value) {
    throw Alarm("Touch probe not defined",
                fmt::format("{} of touch probe {} cannot be {}", column, row, formatShortest(value)),
                "correct the row in TCHPROBE.TP");
  };
  if (!(probe.feed > 0)) refuse("F", probe.feed);
  if (!(probe.rapid > 0)) refuse("FMAX", probe.rapid);
  if (!(probe.maximumTravel > 0)) refuse("DIST", probe.maximumTravel);
  if (!(probe.setUpClearance >= 0)) refuse("SET_UP", probe.setUpClearance);
}

/// What the table named in DR2TABLE says, if there is an entry.
probing::DirectionalRadius directionsOf(const Control& control) {
  const std::string entry = control.tables.tools.text(control.tool.row, "DR2TABLE");
  if (entry.empty() || !control.parameters.option92) return {};
  const auto table = control.tables.deflections.find(control::heidenhain::deflectionTableName(entry));
  if (table == control.tables.deflections.end()) {
    throw Alarm("Calibration data missing",
                fmt::format("There is no table {}, which DR2TABLE of tool {} names", entry, control.tool.row),
                "calibrate the probe with cycle 460, or clear the entry");
  }
  const auto rows = control::heidenhain::deflectionsOf(table->second);
  std::vector<probing::DirectionalRadius::Ring> rings;
  for (auto row = rows.begin(); row != rows.end();) {
    const auto end = std::find_if(row, rows.end(), [&](const auto& other) { return other.polar != row->polar; });
    probing::DirectionalRadius::Ring ring{row->polar, row->azimuth, {}};
    const double step = 360.0 / static_cast<double>(end - row);
    for (; row != end; ++row) {
      const double expected = ring.azimuth + step * static_cast<double>(ring.deviations.size());
      if (std::abs(row->azimuth - expected) > 0.01) {
        throw Alarm("Calibration data wrong",
                    fmt::format("Table {}: the directions at {} degrees are not evenly spread", entry, ring.polar),
                    "calibrate the probe with cycle 460");
      }
      ring.deviations.push_back(row->deviation);
    }
    rings.push_back(std::move(ring));
  }
  return probing::DirectionalRadius(std::move(rings));
}

}  // namespace

probing::HeidenhainProbe activeProbe(const Control& control, Calibrated calibrated) {
  probing::HeidenhainProbe probe;
  const auto& tool = control.tool;
  if (control.isTNC640() && tool.number == 0) {
    throw Alarm("Touch probe not defined", "There is no tool in the spindle: TOOL CALL 0 has emptied it",
                "call the touch probe, by its number in TOOL.T, with TOOL CALL");
  }
  probe.ballRadius = tool.radius;
  if (!(tool.radius > 0) && calibrated == Calibrated::Required) {
    throw Alarm("Touch probe not calibrated",
                control.keepsCalibrationInTable()
                    ? fmt::format("Tool {} has no effective ball radius in column R of TOOL.T", tool.row)
                    : "The calibration data have no effective ball radius (MP7411 = 0)",
                "calibrate the touch probe or enter its radius");
  }
  const auto& parameters = control.parameters;
  if (!control.isTNC640()) {
    probe.setUp = parameters.mp6140;
    probe.distance = parameters.mp6130;
    probe.probingFeed = parameters.mp6120;
    probe.positioningFeed = parameters.mp6150;
    probe.prepositionAtMachineRapid = parameters.mp6151;
    probe.track = parameters.mp6165;
    probe.repetitions = parameters.mp6170;
    probe.confidence = parameters.mp6171;
    probe.distanceName = "MP6130";
    const auto& tools = control.tables.tools;
    if (control.keepsCalibrationInTable()) {
      probe.tipOffset = {tools.numberOr(tool.row, "CAL-OF1", 0), tools.numberOr(tool.row, "CAL-OF2", 0)};
      probe.calibrationAngle = tools.numberOr(tool.row, "CAL-ANG", 0);
    } else {
      probe.tipOffset = {parameters.calibratedOffset1, parameters.calibratedOffset2};
      probe.calibrationAngle = parameters.calibratedAngle;
    }
    applyOverrides(probe, control.overrides);
    return probe;
  }
  if (tool.probeRow.empty()) {
    throw Alarm(
        "Touch probe not defined",
        fmt::format("Tool {} is not a touch probe: column TP_NO of TOOL.T names no row of TCHPROBE.TP", tool.row),
        "call the touch probe with TOOL CALL, or enter TP_NO");
  }
  const auto number = parseInteger(tool.probeRow);
  const auto row = number ? findProbe(control.tables.probes, static_cast<int>(*number)) : std::nullopt;
  if (!row) {
    throw Alarm("Touch probe not defined",
                fmt::format("TCHPROBE.TP has no row {}, which TP_NO of tool {} names", tool.probeRow, tool.row),
                "add the row or correct TP_NO");
  }
  requireSound(*row, tool.probeRow);
  probe.tipOffset = {row->centreOffset1, row->centreOffset2};
  probe.calibrationAngle = row->calibrationAngle;
  probe.probingFeed = std::min(row->feed, parameters.maxTouchFeed);
  probe.positioningFeed = row->rapid;
  probe.distance = row->maximumTravel;
  probe.setUp = row->setUpClearance;
  probe.prepositionAtMachineRapid = row->prepositionAtMachineRapid;
  probe.track = row->track;
  applyOverrides(probe, control.overrides);
  probe.aside = row->stylus == "L-TYPE";
  if (probe.aside && !(probe.track && control.channel.description().spindleOrients)) {
    throw Alarm(
        "Spindle orientation required",
        "The ball of an L-shaped stylus is beside the spindle axis; only the spindle can turn it to the surface",
        "set TRACK = ON in TCHPROBE.TP, or STYLUS to SIMPLE");
  }
  if (probe.aside && !(probe.tipOffset.norm() > 0)) {
    throw Alarm("Touch probe not calibrated",
                fmt::format("CAL_OF1 and CAL_OF2 of touch probe {} do not say where the ball of its L-shaped stylus is",
                            tool.probeRow),
                "enter how far the ball is from the spindle axis at CAL_ANG; calibrating finds it exactly");
  }
  if (calibrated == Calibrated::Required) probe.directions = directionsOf(control);
  return probe;
}

}  // namespace probewright::cycles::heidenhain

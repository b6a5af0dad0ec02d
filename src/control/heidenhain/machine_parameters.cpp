#include "control/heidenhain/machine_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.hpp"
#include "base/text.hpp"

namespace probewright::control::heidenhain {
namespace {

constexpr std::array entries = {
    MachineParameterEntry{"maxTouchFeed", "122602", onTNC640, 1, 100000, "mm/min",
                          "upper limit of the probing feed rate F and of Q396 of cycle 441",
                          &MachineParameters::maxTouchFeed},
    MachineParameterEntry{
        "overrideForMeasure", "122604", onTNC640, 0, 1, "",
        "1: the feed potentiometer acts in touch probe cycles; no effect here: it is always at 100 percent",
        &MachineParameters::overrideForMeasure},
    MachineParameterEntry{"chkTiltingAxes", "204601, 204600", onTNC640, 0, 1, "",
                          "1: before probing, the rotary axes must be where the tilted plane needs them",
                          &MachineParameters::checkTiltingAxes},
    MachineParameterEntry{"option92", "", onTNC640, 0, 1, "",
                          "1: software option 92, 3D-ToolComp, is enabled: 3-D calibration data of touch probes",
                          &MachineParameters::option92},
    MachineParameterEntry{"MP6120", "", onITNC530, 1, 3000, "mm/min", "probing feed rate", &MachineParameters::mp6120,
                          "probing_feed"},
    MachineParameterEntry{"MP6130", "", onITNC530, 0.001, 99999.9999, "mm", "longest stroke to the touch point",
                          &MachineParameters::mp6130, "maximum_travel"},
    MachineParameterEntry{"MP6140", "", onITNC530, 0.001, 99999.9999, "mm",
                          "safety clearance in front of the touch point", &MachineParameters::mp6140,
                          "set_up_clearance"},
    MachineParameterEntry{"MP6150", "", onITNC530, 1, 300000, "mm/min", "positioning feed rate between touches",
                          &MachineParameters::mp6150, "probing_rapid"},
    MachineParameterEntry{"MP6151", "", onITNC530, 0, 1, "", "1: pre-position at machine rapid traverse",
                          &MachineParameters::mp6151},
    MachineParameterEntry{"MP6160", "", onITNC530, -1, 999, "",
                          "how calibrating turns the probe by 180 degrees: -1 by the control, 1 to 999 by this M "
                          "function, 0 not at all, so that no centre offset is found",
                          &MachineParameters::mp6160},
    MachineParameterEntry{"MP6165", "", onITNC530, 0, 1, "",
                          "1: turn the probe to the probing direction before each touch", &MachineParameters::mp6165,
                          "orient"},
    MachineParameterEntry{"MP6166", "", onITNC530, 0, 1, "",
                          "1: probing in manual operation takes the basic rotation into account; no effect on cycles",
                          &MachineParameters::mp6166},
    MachineParameterEntry{"MP6170", "", onITNC530, 1, 3, "", "measurements of one point", &MachineParameters::mp6170},
    MachineParameterEntry{"MP6171", "", onITNC530, 0.002, 0.999, "mm", "confidence range of repeated measurements",
                          &MachineParameters::mp6171},
    MachineParameterEntry{"MP6180.0", "", onITNC530, -99999.9999, 99999.9999, "mm",
                          "centre of the calibration ring or pin in X, machine coordinates",
                          &MachineParameters::mp6180x},
    MachineParameterEntry{"MP6180.1", "", onITNC530, -99999.9999, 99999.9999, "mm", "the same in Y",
                          &MachineParameters::mp6180y},
    MachineParameterEntry{"MP6180.2", "", onITNC530, -99999.9999, 99999.9999, "mm",
                          "upper edge of the calibration ring or pin in Z, machine coordinates",
                          &MachineParameters::mp6180z},
    MachineParameterEntry{
        "MP6181.0", "", onITNC530, -99999.9999, 99999.9999, "mm",
        "centre of the calibration ring or pin of the second traverse range in X, machine coordinates",
        &MachineParameters::mp6181x},
    MachineParameterEntry{"MP6181.1", "", onITNC530, -99999.9999, 99999.9999, "mm", "the same in Y",
                          &MachineParameters::mp6181y},
    MachineParameterEntry{"MP6181.2", "", onITNC530, -99999.9999, 99999.9999, "mm",
                          "its upper edge in Z, machine coordinates", &MachineParameters::mp6181z},
    MachineParameterEntry{"MP6182.0", "", onITNC530, -99999.9999, 99999.9999, "mm",
                          "centre of the calibration ring or pin of the third traverse range in X, machine coordinates",
                          &MachineParameters::mp6182x},
    MachineParameterEntry{"MP6182.1", "", onITNC530, -99999.9999, 99999.9999, "mm", "the same in Y",
                          &MachineParameters::mp6182y},
    MachineParameterEntry{"MP6182.2", "", onITNC530, -99999.9999, 99999.9999, "mm",
                          "its upper edge in Z, machine coordinates", &MachineParameters::mp6182z},
    MachineParameterEntry{"MP6185.0", "", onITNC530, 0.1, 99.9999, "mm",
                          "depth of the touches below the upper edge of the calibration ring or pin",
                          &MachineParameters::mp6185},
    MachineParameterEntry{"MP6185.1", "", onITNC530, 0.1, 99.9999, "mm", "the same in the second traverse range",
                          &MachineParameters::mp6185second},
    MachineParameterEntry{"MP6185.2", "", onITNC530, 0.1, 99.9999, "mm", "the same in the third traverse range",
                          &MachineParameters::mp6185third},
    MachineParameterEntry{"traverseRange", "", onITNC530, 1, 3, "", "traverse range that the PLC has selected",
                          &MachineParameters::traverseRange},
    MachineParameterEntry{
        "MP6360", "", onITNC530, 1, 3000, "mm/min",
        "probing feed rate of a measuring (scanning) touch probe; no effect on triggering ones, which "
        "take MP6120",
        &MachineParameters::mp6360},
    MachineParameterEntry{"MP6361", "", onITNC530, 1, 300000, "mm/min",
                          "positioning feed rate of a measuring (scanning) touch probe; no effect on triggering ones, "
                          "which take MP6150",
                          &MachineParameters::mp6361},
    MachineParameterEntry{"MP6520", "", onITNC530, 1, 3000, "mm/min",
                          "feed of a stationary tool towards the tool touch probe", &MachineParameters::mp6520},
    MachineParameterEntry{"MP6530", "", onITNC530, 0.001, 99.9999, "mm",
                          "depth of the tool's lower end below the upper edge of the contact in radial probing",
                          &MachineParameters::mp6530},
    MachineParameterEntry{"MP6531", "", onITNC530, 0.001, 99.9999, "mm",
                          "diameter or longer edge of the contact of the tool touch probe", &MachineParameters::mp6531},
    MachineParameterEntry{"MP6540", "", onITNC530, 0.001, 30000, "mm", "safety zone about the contact",
                          &MachineParameters::mp6540},
    MachineParameterEntry{"MP6550", "", onITNC530, 10, 10000, "mm/min", "rapid traverse near the tool touch probe",
                          &MachineParameters::mp6550},
    MachineParameterEntry{"MP6580.0", "", onITNC530, -99999.9999, 99999.9999, "mm",
                          "centre of the tool touch probe in X, machine coordinates; without an entry that of "
                          "`[tool_probe]` of the setup",
                          &MachineParameters::mp6580x},
    MachineParameterEntry{"MP6580.1", "", onITNC530, -99999.9999, 99999.9999, "mm", "the same in Y",
                          &MachineParameters::mp6580y},
    MachineParameterEntry{"MP6580.2", "", onITNC530, -99999.9999, 99999.9999, "mm",
                          "upper edge of its contact in Z, machine coordinates", &MachineParameters::mp6580z},
    MachineParameterEntry{"offsetToolAxis", "122707", onTNC640, 0.001, 99.9999, "mm",
                          "depth of the tool's lower end below the upper edge of the contact in radial probing",
                          &MachineParameters::mp6530},
    MachineParameterEntry{"rapidFeed", "122708", onTNC640, 10, 300000, "mm/min",
                          "rapid traverse near the tool touch probe", &MachineParameters::mp6550},
    MachineParameterEntry{"probingFeed", "122709", onTNC640, 1, 3000, "mm/min",
                          "feed of a stationary tool towards the tool touch probe", &MachineParameters::mp6520},
    MachineParameterEntry{"probingDirRadial", "122706", onTNC640, 0, 3, "",
                          "direction of radial probing: 0 main axis +, 1 minor axis +, 2 main axis -, 3 minor axis -",
                          &MachineParameters::probingDirRadial},
    MachineParameterEntry{"MP6505", "", onITNC530, 0, 3, "", "the same", &MachineParameters::probingDirRadial},
    MachineParameterEntry{"probingFeedCalc", "122710", onTNC640, 0, 2, "",
                          "feed of a rotating tool: 0 ConstantTolerance, 1 VariableTolerance, 2 ConstantFeed",
                          &MachineParameters::probingFeedCalc},
    MachineParameterEntry{"MP6507", "", onITNC530, 0, 2, "", "the same", &MachineParameters::probingFeedCalc},
    MachineParameterEntry{"measureTolerance1", "122715", onTNC640, 0.001, 0.999, "mm",
                          "permissible measuring error with a rotating tool", &MachineParameters::measureTolerance1},
    MachineParameterEntry{"MP6510", "", onITNC530, 0.001, 0.999, "mm", "the same",
                          &MachineParameters::measureTolerance1},
    MachineParameterEntry{"maxPeriphSpeedMeas", "122712", onTNC640, 1, 129, "m/min",
                          "permissible speed of the circumference of a tool that is measured rotating",
                          &MachineParameters::maxPeriphSpeedMeas},
    MachineParameterEntry{"MP6570", "", onITNC530, 1, 120, "m/min", "the same", &MachineParameters::maxPeriphSpeedMeas},
    MachineParameterEntry{"maxSpeed", "122714", onTNC640, 1, 1000, "rpm",
                          "highest spindle speed when a tool is measured", &MachineParameters::maxSpeed},
    MachineParameterEntry{"MP6572", "", onITNC530, 1, 1000, "rpm", "the same", &MachineParameters::maxSpeed},
    MachineParameterEntry{"stopOnCheck", "122717", onTNC640, 0, 1, "",
                          "1: the program stops where a check finds a broken tool", &MachineParameters::stopOnCheck},
    MachineParameterEntry{"probingCapability", "122723", onTNC640, 0, 1, "",
                          "1: only lengths are measured, with a stationary spindle; 0: everything",
                          &MachineParameters::probingCapability},
    MachineParameterEntry{"measureTolerance2", "122716", onTNC640, 0, 0.999, "mm",
                          "permissible measuring error of a second touch of a rotating tool, which then counts; 0: "
                          "there is no second touch",
                          &MachineParameters::measureTolerance2},
    MachineParameterEntry{"spindleSpeedCalc", "122711", onTNC640, 0, 1, "",
                          "speed of a rotating tool: 0 Automatic, from maxPeriphSpeedMeas; 1 MinSpindleSpeed, always "
                          "lowestSpindleSpeed",
                          &MachineParameters::minimumSpindleSpeed},
    MachineParameterEntry{"lowestSpindleSpeed", "", onBothTNC, 1, 10000, "rpm",
                          "lowest speed of the machine's spindle, where spindleSpeedCalc or MP6500 ask for it",
                          &MachineParameters::lowestSpindleSpeed},
    MachineParameterEntry{"probingRoutine", "122705", onTNC640, 0, 1, "",
                          "calibrating the tool touch probe: 0 MultiDirections, 1 SingleDirection, only from the side "
                          "that probingDirRadial says",
                          &MachineParameters::singleDirection},
    MachineParameterEntry{"stopOnMeasurement", "122718", onTNC640, 0, 1, "",
                          "1: the program stops where a measurement (mode 0) differs from the table by more than the "
                          "breakage tolerance",
                          &MachineParameters::stopOnMeasurement},
    MachineParameterEntry{"adaptToolTable", "122719", onTNC640, 0, 2, "",
                          "what lengths and radii are entered in the tool table: 0 AdaptOnMeasure, measured ones only; "
                          "1 AdaptOnBoth, deviations that a check finds too; 2 AdaptNever",
                          &MachineParameters::adaptToolTable},
    MachineParameterEntry{
        "MP6500",
        "",
        onITNC530,
        0,
        16383,
        "",
        "tool measurement, the sum of bits: 1 cycles 480 to 484 and 30 to 33 are enabled; 2 nothing is measured with a "
        "rotating tool, nor single teeth; 4 no length with a stationary spindle where R-OFFS is 0; 8 no single teeth; "
        "16 always the lowest spindle speed; 32 no stop where a check finds a broken tool; 64 no stop where a "
        "measurement differs by more than the breakage tolerance; 256 calibrating touches one side only (MP6505); 512 "
        "calibrating determines how a cuboid is turned; 2048 a check leaves the tool table; 8192 not in a tilted plane",
        &MachineParameters::mp6500,
        {},
        1 | 2 | 4 | 8 | 16 | 32 | 64 | 256 | 512 | 2048 | 8192},
    MachineParameterEntry{"detectStylusRot", "114315", onTNC640, 0, 1, "",
                          "1: calibrating determines how a cuboid is turned about the tool axis, and tool measurement "
                          "takes it into account",
                          &MachineParameters::detectStylusRot},
    MachineParameterEntry{"tippingTolerance", "114319", onTNC640, 0, 5, "degrees",
                          "calibrating determines how a cuboid is tipped, and warns beyond this angle; 0: it does not",
                          &MachineParameters::tippingTolerance},
    MachineParameterEntry{"safetyDistToolAx", "114203", onTNC640, 0.001, 99999.9999, "mm",
                          "safety zone about the contact of the tool touch probe", &MachineParameters::mp6540},
    MachineParameterEntry{"centerPos.0", "114201.0", onTNC640, -99999.9999, 99999.9999, "mm",
                          "centre of the tool touch probe in X, machine coordinates; without an entry that of "
                          "`[tool_probe]` of the setup",
                          &MachineParameters::mp6580x},
    MachineParameterEntry{"centerPos.1", "114201.1", onTNC640, -99999.9999, 99999.9999, "mm", "the same in Y",
                          &MachineParameters::mp6580y},
    MachineParameterEntry{"centerPos.2", "114201.2", onTNC640, -99999.9999, 99999.9999, "mm",
                          "upper edge of its contact in Z, machine coordinates", &MachineParameters::mp6580z},
    MachineParameterEntry{"contactSize", "", onTNC640, 0.001, 99.9999, "mm",
                          "diameter or longer edge of the contact of the tool touch probe", &MachineParameters::mp6531},
    MachineParameterEntry{
        "rectStylus", "114300", onTNC640, 0, 1, "",
        "1: the contact of the tool touch probe is a cuboid (CfgTTRectStylus), which cycle 485 needs; "
        "without an entry as `[tool_probe]` of the setup is",
        &MachineParameters::rectangularContact},
    MachineParameterEntry{"calibratedContactX", "", onBothTNC, -99999.9999, 99999.9999, "mm",
                          "calibration of the tool touch probe: middle of its contact in X, machine coordinates; "
                          "without an entry this and the following are those of `[tool_probe]` of the setup",
                          &MachineParameters::contactX},
    MachineParameterEntry{"calibratedContactY", "", onBothTNC, -99999.9999, 99999.9999, "mm", "the same in Y",
                          &MachineParameters::contactY},
    MachineParameterEntry{"calibratedContactZ", "", onBothTNC, -99999.9999, 99999.9999, "mm",
                          "upper edge of its contact in Z, machine coordinates", &MachineParameters::contactZ},
    MachineParameterEntry{"calibratedContactRadius1", "", onBothTNC, 0, 99.9999, "mm",
                          "half the effective width of its contact along the main axis; 0: not calibrated",
                          &MachineParameters::contactRadius1},
    MachineParameterEntry{"calibratedContactRadius2", "", onBothTNC, 0, 99.9999, "mm", "the same along the minor axis",
                          &MachineParameters::contactRadius2},
    MachineParameterEntry{"calibratedContactAngle", "", onBothTNC, -45, 45, "degrees",
                          "how its contact, a cuboid, is turned about the tool axis", &MachineParameters::contactAngle},
    MachineParameterEntry{"MP7411", "", onITNC530, 0, 1, "",
                          "length, radius and centre offset with which touch probe cycles measure, and where "
                          "calibrating writes them: 1 the row of the active tool in TOOL.T (several sets), 0 the one "
                          "set of calibration data below, whatever TOOL CALL said",
                          &MachineParameters::mp7411},
    MachineParameterEntry{"calibratedLength", "", onITNC530, -9999.9999, 9999.9999, "mm",
                          "calibration data with MP7411 = 0: effective length; without an entry this and the following "
                          "are those of the first probe of the setup",
                          &MachineParameters::calibratedLength},
    MachineParameterEntry{"calibratedRadius", "", onITNC530, 0, 99.9999, "mm", "effective ball radius",
                          &MachineParameters::calibratedRadius},
    MachineParameterEntry{"calibratedOffset1", "", onITNC530, -99.9999, 99.9999, "mm",
                          "centre offset of the ball in the main axis", &MachineParameters::calibratedOffset1},
    MachineParameterEntry{"calibratedOffset2", "", onITNC530, -99.9999, 99.9999, "mm", "the same in the minor axis",
                          &MachineParameters::calibratedOffset2},
    MachineParameterEntry{"calibratedAngle", "", onITNC530, -360, 360, "degrees", "spindle angle of the calibration",
                          &MachineParameters::calibratedAngle},
    MachineParameterEntry{"FCL", "", onITNC530, 0, 3, "",
                          "feature content level that is enabled: cycles 4, 408 and 409 need 3, cycle 441 needs 2",
                          &MachineParameters::featureLevel},
    MachineParameterEntry{"softwareVersion", "", onITNC530, 1, 8, "",
                          "xx of the NC software 340 49x-xx; 606 42x counts as 8. From 5 on there are Q423 and Q365 in "
                          "cycles 412, 413, 421 and 422, Q320 in 416, and Q320 and Q301 in 425",
                          &MachineParameters::softwareVersion},
    MachineParameterEntry{"maxModification", "204801", onTNC640, 0.001, 1, "mm",
                          "change of the kinematics beyond which cycles 451 and 452 ask for NC start",
                          &MachineParameters::maxModification},
    MachineParameterEntry{"MP6600", "", onITNC530, 0.001, 1, "mm", "the same", &MachineParameters::maxModification},
    MachineParameterEntry{"maxDevCalBall", "204802", onTNC640, 0.001, 0.1, "mm",
                          "how far the measured radius of the calibration sphere may be from Q407",
                          &MachineParameters::maxDevCalBall},
    MachineParameterEntry{"MP6601", "", onITNC530, 0.001, 0.1, "mm", "the same", &MachineParameters::maxDevCalBall},
    MachineParameterEntry{"mStrobeRotAxPos", "204803", onTNC640, -1, 999, "",
                          "M function of the builder that positions the rotary axes in cycles 451 to 453, which give "
                          "it the angles in Q120 to Q122; -1: the cycles position them",
                          &MachineParameters::strobeRotaryAxes},
    MachineParameterEntry{"MP6602", "", onITNC530, -1, 999, "", "the same in cycles 451 and 452",
                          &MachineParameters::strobeRotaryAxes},
    MachineParameterEntry{"codeNumber", "", onITNC530, 0, 999999, "",
                          "code number that was last entered under MOD, which cycle 450 saves with the kinematics and "
                          "asks for before it overwrites them; 0: none",
                          &MachineParameters::codeNumber},
    MachineParameterEntry{"option48", "", onBothTNC, 0, 1, "",
                          "1: software option 48, KinematicsOpt, is enabled: cycles 450 to 453",
                          &MachineParameters::option48},
    MachineParameterEntry{"option52", "", onBothTNC, 0, 1, "",
                          "1: software option 52, KinematicsComp, is enabled: Q406 = 2 and 3 of cycle 451, cycle 453",
                          &MachineParameters::option52},
    MachineParameterEntry{
        "toolCentreOption", "", onBothTNC, 0, 1, "",
        "1: the software option with TCPM is enabled (M128), which Q408 = 0 of cycles 451 to 453 needs",
        &MachineParameters::toolCentreOption},
    MachineParameterEntry{
        "refuseTransformations", "", onTNC640, 0, 1, "",
        "1: cycles 400 to 499 refuse to run while cycle 7, 8, 10, 11 or 26 is active, which the manual "
        "forbids as a danger of collision; 0: they run",
        &MachineParameters::refuseTransformations},
};

bool sameName(std::string_view a, std::string_view b) { return std::ranges::equal(a, b, {}, lower, lower); }

bool isNumberOf(const MachineParameterEntry& entry, std::string_view text) {
  std::string_view rest = entry.number;
  while (!rest.empty()) {
    const std::size_t end = rest.find(", ");
    if (rest.substr(0, end) == text) return true;
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 2);
  }
  return false;
}

double defaultOf(const MachineParameterEntry& entry) {
  const MachineParameters parameters;
  return std::visit([&](auto member) { return static_cast<double>(parameters.*member); }, entry.member);
}

}  // namespace

std::span<const MachineParameterEntry> machineParameterEntries() { return entries; }

Result<void> setMachineParameter(MachineParameters& parameters, ControlKind kind, std::string_view name, double value) {
  const auto entry = std::ranges::find_if(entries, [&](const MachineParameterEntry& candidate) {
    return sameName(candidate.name, name) || isNumberOf(candidate, name);
  });
  if (entry == entries.end() || !entry->controls.contains(kind)) {
    return fail(fmt::format("the {} has no machine parameter {} here", control::name(kind), name),
                "docs/machine-parameters.md lists those that can be set");
  }
  if (!(value >= entry->minimum && value <= entry->maximum)) {
    return fail(fmt::format("{} cannot be {}; its range is {} to {}{}{}", entry->name, formatShortest(value),
                            formatShortest(entry->minimum), formatShortest(entry->maximum),
                            entry->unit.empty() ? "" : " ", entry->unit));
  }
  const bool whole = !std::holds_alternative<double MachineParameters::*>(entry->member);
  if (whole && value != std::floor(value)) {
    return fail(fmt::format("{} takes a whole number, not {}", entry->name, formatShortest(value)));
  }
  if (entry->bits != 0 && (static_cast<int>(value) & ~entry->bits) != 0) {
    std::string without;
    for (int bit = 1; bit <= static_cast<int>(entry->maximum); bit *= 2)
      if ((static_cast<int>(value) & bit & ~entry->bits) != 0)
        without += fmt::format("{}{}", without.empty() ? "" : ", ", bit);
    return fail(fmt::format("{} of {} has no meaning here", without, entry->name),
                "docs/machine-parameters.md lists the bits that have one");
  }
  std::visit([&]<class Value>(Value MachineParameters::*member) { parameters.*member = static_cast<Value>(value); },
             entry->member);
  return {};
}

std::string machineParametersPage() {
  std::string page =
      "# Machine parameters\n\nThe parameters of HEIDENHAIN controls that touch probe functions read here. A setup "
      "sets "
      "them in its table\n`[parameters]`, by name or number; `MP6180.0 = 100` may stand with quotes around the name "
      "or without. This page is made from the table\nthat drives the reading.\n\n"
      "| parameter | number | control | unit | range | default | meaning |\n|---|---|---|---|---|---|---|\n";
  for (const MachineParameterEntry& entry : entries) {
    std::string controls;
    for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
      if (entry.controls.contains(kind)) controls += fmt::format("{}{}", controls.empty() ? "" : ", ", name(kind));
    }
    page += fmt::format("| `{}` | {} | {} | {} | {} to {} | {} | {} |\n", entry.name, entry.number, controls,
                        entry.unit, formatShortest(entry.minimum), formatShortest(entry.maximum),
                        entry.toolKey.empty() ? formatShortest(defaultOf(entry))
                                              : fmt::format("`{}` of the first probe", entry.toolKey),
                        entry.meaning);
  }
  return page;
}

}  // namespace probewright::control::heidenhain

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.hpp"
#include "base/truncated.hpp"
#include "control/alarm.hpp"
#include "control/scoped.hpp"
#include "cycles/heidenhain/tool_measurement.hpp"
#include "cycles/heidenhain/tool_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;
using control::Alarm;
using control::heidenhain::NumberColumn;
using control::heidenhain::TypedTable;

constexpr Choice modes485[] = {{0, "measure: write ZL and XL, clear DZL and DXL"},
                               {1, "check: write the deviations as DZL and DXL, lock the tool beyond its tolerances"},
                               {2, "compare with the delta values too, lock the tool beyond its tolerances"}};

constexpr Parameter parameters485[] = {
    option(340, "Q340", "what becomes of the measured values", modes485),
    clearanceHeight,
};

constexpr ResultDefinition results485[] = {
    {"Q115", "deviation of the length from ZL of TOOLTURN.TRN", result::difference(of::length3).main()},
    {"Q116", "deviation of the length from XL of TOOLTURN.TRN", result::difference(of::length1).main()},
    {"Q199", "0: within the tolerances, 1: outside LTOL or RTOL, 2: outside LBREAK or RBREAK", result::status},
};

/// What can be measured of a tool, by where its tip points: 8 is along the tool, away from the holder, and the numbers
/// go round by way of -X (2), the holder (4) and +X (6).
struct Measurable {
  bool z = false, x = false;
};

Measurable measurable(const std::string& type, int orientation) {
  const bool narrow = type == "RECESS" || type == "RECTURN" || type == "THREAD";
  switch (orientation) {
    case 1:
    case 7:
      return {true, true};
    case 2:
      return {narrow, true};
    case 3:
    case 5:
      return {false, true};
    case 6:
      return {false, !narrow};
    case 8:
      return {true, narrow};
    default:
      return {};
  }
}

struct TurningTool {
  double z = 0, x = 0, y = 0, nose = 0;  ///< with their delta values
  int orientation = 1;
  double spindleAngle = 0;
  Measurable measurable;
};

TurningTool turningTool(Context& context) {
  const Control& control = context.control();
  const std::string& row = control.tool.row;
  const auto& table = control.tables.turningTools;
  const auto refuse = [&](const std::string& code, const std::string& text, const char* advice) {
    throw Alarm(code, text, advice);
  };
  if (control.tables.tools.text(row, "TYP") != "TURN" || !table || !table->hasRow(row)) {
    refuse("Tool type not permitted", fmt::format("Tool {} is not a turning tool of TOOLTURN.TRN", row),
           "call a turning tool, or measure mills and drills with cycles 481 to 483");
  }
  const auto number = [&](NumberColumn column) { return table->numberOr(row, column, 0); };
  if (number("SPB-INSERT") != 0) {
    refuse("Tool angle not permitted",
           fmt::format("SPB-INSERT of tool {} is {} degrees; cycle 485 measures straight tools", row,
                       number("SPB-INSERT")),
           "measure the tool by hand");
  }
  TurningTool tool{number("ZL") + number("DZL"),
                   number("XL") + number("DXL"),
                   number("YL") + number("DYL"),
                   number("RS") + number("DRS"),
                   truncated(number("TO")),
                   number("ORI"),
                   {}};
  const std::string type = table->text(row, "TYPE");
  tool.measurable = measurable(type, tool.orientation);
  if (!tool.measurable.z && !tool.measurable.x) {
    refuse("Tool orientation not permitted",
           fmt::format("A tool of TYPE {} with TO = {} cannot be measured", type, tool.orientation),
           "measure the tool by hand");
  }
  constexpr double reach = 5;  // mm
  if (std::abs(tool.y) > reach) {
    refuse(
        "Touch point inaccessible",
        fmt::format("YL + DYL of tool {} is {:.4f} mm; beyond 5 mm the tool does not reach the contact", row, tool.y),
        "correct YL, or measure the tool by hand");
  }
  return tool;
}

struct Measured {
  std::optional<double> z, x;
};

Measured measure(Context& context, const TurningTool& tool, double clearanceHeight) {
  Control& control = context.control();
  control::Channel& channel = context.channel();
  const probing::ToolTouchProbe probe = toolTouchProbe(control, Contact::Calibrated);
  channel.orientSpindle(tool.spindleAngle);
  // While it is measured the controlled point is its tip.
  const control::Scoped tip(channel.toolVector, Vector3(-tool.x, -tool.y, tool.z));
  probing::ToolProber prober(channel, control.coordinates.plane, probe, clearanceHeight);
  Measured measured;
  if (tool.measurable.z) {
    measured.z = prober.touchTop({0, 0}).tip.z() + tool.z - probe.place.z();
    // The tip that points to -X is in the middle of its nose, whose lower side touches.
    if (tool.orientation == 2) *measured.z -= tool.nose;
    prober.rise();
  }
  if (tool.measurable.x) {
    // Tips that point to -X meet the side of the contact at +X.
    const int sense = tool.orientation >= 5 && tool.orientation <= 7 ? 1 : -1;
    const double tipAt = prober.touchSide(0, sense, 0, probe.depth).tip.x();
    // Along the axis a turned face is farther than at right angles to it.
    const double half = probe.size / 2 / std::cos(radiansFromDegrees(control.parameters.contactAngle));
    measured.x = tool.x + probe.place.x() - sense * half - tipAt;
    if (tool.orientation == 8) *measured.x += tool.nose;  // in the middle as well, and its -X side touches
  }
  prober.rise();
  return measured;
}

constexpr CycleDefinition definition = {
    .number = 485,
    .name = "485",
    .title = "MEASURE TURNING TOOL",
    .family = CycleFamily::Tool,
    .summary =
        "Measures the lengths ZL and XL of a turning tool with a tool touch probe whose contact is a cuboid, as far as "
        "the orientation TO of the tool lets it.",
    .parameters = parameters485,
    .results = results485,
    .controls = control::onTNC640,
};

void run(Context& context, const Arguments&) {
  Control& control = context.control();
  if (control.tool.axis != 'Z') {
    throw Alarm("Tool axis not permitted", "Cycle 485 measures with tool axis Z", "program TOOL CALL with axis Z");
  }
  if (!control.parameters.rectangularContact) {
    throw Alarm("Tool touch probe not suitable",
                "Cycle 485 needs a tool touch probe whose contact is a cuboid (CfgTTRectStylus)",
                "fit one, or measure the tool by hand");
  }
  const TurningTool tool = turningTool(context);
  ProgramPlace clearance = context.channel().position();
  clearance[2] = context.q(260);
  const Measured measured = measure(context, tool, context.channel().machineFromProgram(clearance).z());

  const std::string row = control.tool.row;
  TypedTable& table = *control.tables.turningTools;
  const auto& tools = control.tables.tools;
  const int mode = context.option(340);
  const ToolMeasuringSettings settings = toolMeasuringSettings(control);
  int status = 0;
  std::string screen = fmt::format("TOOL {}{}{}\n", row, control.tool.name.empty() ? "" : " ", control.tool.name);
  const auto enter = [&](std::optional<double> value, NumberColumn nominal, NumberColumn delta, NumberColumn wear,
                         NumberColumn breakage, int result) {
    if (!value) return;
    const double before = table.numberOr(row, nominal, 0) + (mode == 2 ? table.numberOr(row, delta, 0) : 0);
    const double deviation = *value - before;
    const int found = toolStatus(deviation, tools.numberOr(row, wear, 0), tools.numberOr(row, breakage, 0));
    status = std::max(status, found);
    screen += fmt::format("{}\n  {}{}\n", nominal.name(), formatSigned(*value, 4), statusMark(mode == 0 ? 0 : found));
    if (mode == 0 && settings.entersMeasured) {
      control.writeNumbers({{table, row, nominal, *value}, {table, row, delta, 0}});
    } else if (mode == 1) {
      if (settings.entersChecked) control.writeNumber(table, row, delta, deviation);
      context.result(result, deviation, {.nominal = 0.0});
    }
  };
  enter(measured.z, "ZL", "DZL", "LTOL", "LBREAK", 115);
  enter(measured.x, "XL", "DXL", "RTOL", "RBREAK", 116);
  context.result(199, status);
  context.record().screens.push_back(screen);
  if (mode != 0 && status > 0) {
    control.writeText(table, row, "TL", "L");
    control.writeText(control.tables.tools, row, "TL", "L");
  }
  if (mode != 0 && status == 2 && settings.stopsOnCheck) {
    throw Alarm("Tool breakage",
                fmt::format("Tool {} is beyond its breakage tolerance (LBREAK, RBREAK); it is locked", row),
                "change the tool, then release it (column TL)");
  }
  if (mode == 0 && status == 2 && settings.stopsOnMeasurement) {
    throw Alarm("Tool breakage",
                fmt::format("Tool {} differs from what TOOLTURN.TRN said by more than its breakage tolerance", row),
                "check the tool and its entries in TOOLTURN.TRN");
  }
}

}  // namespace

extern const Entry cycle485 = {.definition = definition, .conditions = toolConditions, .run = run};

}  // namespace probewright::cycles::heidenhain

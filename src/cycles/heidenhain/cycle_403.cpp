#include <fmt/format.h>

#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/edge_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/rotary_alignment.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using control::Alarm;
using namespace parameters;

constexpr Choice axisChoices[] = {{0, "first axis of the table from the workpiece (TNC 640)", control::onTNC640},
                                  {4, "A axis"},
                                  {5, "B axis"},
                                  {6, "C axis"}};

constexpr Choice tableChoices[] = {{0, "into the active datum table"}, {1, "into the preset table"}};

constexpr Parameter parameters403[] = {
    coordinate(263, "Q263", "first touch, main axis"),
    coordinate(264, "Q264", "first touch, minor axis"),
    coordinate(265, "Q265", "second touch, main axis"),
    coordinate(266, "Q266", "second touch, minor axis"),
    measuringAxis3,
    probingDirection,
    measuringHeight,
    setUpClearance,
    clearanceHeight,
    moveToClearance,
    option(312, "Q312", "axis of the compensating movement", axisChoices),
    setToZero,
    standard(tableRow, 0),
    standard(option(303, "Q303", "where the zero of the axis goes", tableChoices), 1),
    standard(angle(380, "Q380", "angle that the edge is aligned to", 0, 360), 0),
};

constexpr ResultDefinition results403[] = {{"Q150", {"measured ", "angle"}, result::actual(of::angle).main()}};

/// The axis of machine coordinates that the compensating axis turns about: 0, 1, 2 for A, B, C.
int compensationAxis(Context& context) {
  const auto& plane = context.control().coordinates.plane;
  const bool inPlane = context.option(272) != 3;
  const int wanted = context.option(312);
  if (wanted == 0 && !context.control().isTNC640()) {
    throw Alarm("Cycle parameter wrong", "The iTNC 530 does not find the rotary axis itself (Q312 = 0)",
                "name the axis: Q312 = 4 (A), 5 (B) or 6 (C)");
  }
  const int axis = wanted == 0 ? firstTableTurn(context) : wanted - 4;
  const bool possible = inPlane ? axis == plane.tool : axis != plane.tool;
  if (!possible) {
    throw Alarm("Rotary axis not permitted",
                fmt::format("Axis {} cannot compensate what is measured along axis {} (Q272)", "ABC"[axis],
                            context.option(272)),
                "choose the measuring axis or the compensation axis (Q312) that fits");
  }
  return axis;
}

/// The machine axes X, Y, Z as 0, 1, 2 of main, minor and touch probe axis (1, 2, 3 of Q272).
int machineAxis(Context& context, int programAxis) {
  const auto& plane = context.control().coordinates.plane;
  return programAxis == 1 ? plane.main : programAxis == 2 ? plane.minor : plane.tool;
}

/// The angle of a line about machine axis `axis`, counted from machine axis `from`.
double angleAbout(int axis, int from, const ProgramWay& along) {
  const double cosine = along[(axis + 1) % 3], sine = along[(axis + 2) % 3];
  if (std::hypot(cosine, sine) < 0.1 * along.norm()) {
    throw Alarm(
        "Angle not determined",
        fmt::format("The touches lie along the axis that {} turns about and say nothing about its angle", "ABC"[axis]),
        "choose the other rotary axis (Q312), or other points");
  }
  const double angle = degreesFromRadians(std::atan2(sine, cosine));
  return from == (axis + 1) % 3 ? angle : normalizedDegrees(angle - 90);
}

constexpr Example examples[] = {
    {"Q266", 30}, {"Q312", 6},  // the C axis
};

constexpr CycleDefinition definition = {
    .number = 403,
    .name = "403",
    .title = "ROT IN ROTARY AXIS",
    .family = CycleFamily::Misalignment,
    .summary = "Measures the misalignment of an edge by two touches and turns a rotary axis until it is aligned.",
    .parameters = parameters403,
    .results = results403,
    .examples = examples,
};

void rules(CallRules& call) {
  edgeRules(call);
  if (call.kind() != ControlKind::iTNC530 || call.number(312) != 0) return;
  call.add(312, "the iTNC 530 does not find the rotary axis itself (Q312 = 0)",
           "name the axis: Q312 = 4 (A), 5 (B) or 6 (C)");
}

void run(Context& context, const Arguments&) {
  const int axis = compensationAxis(context);
  requireTable(context, axis);
  const bool directed = context.option(312) == 0;
  // A named axis is entered in the active preset; the older control knows Q305 for it too.
  const PresetRow row = directed || !context.control().isTNC640() ? PresetRow::OfQ305 : PresetRow::Active;
  if (context.option(337) == 1 && context.option(303) == 0) {
    requireDatumTable(context, "Q337 = 1 with Q303 = 0 enters", "enter it into the preset table with Q303 = 1");
  } else if (context.option(337) == 1) {
    context.control().requireWritablePreset(row == PresetRow::OfQ305 ? context.option(305)
                                                                     : context.control().coordinates.preset.row);
  }
  const MeasuredEdge edge = measureEdge(context);
  const auto& plane = context.control().coordinates.plane;
  // Angles count from the main axis; where that is the axis of rotation, from the minor axis.
  const int zero = plane.main == axis ? plane.minor : plane.main;
  double measured = angleAbout(axis, zero, plane.xyzFromPlane(edge.along));
  if (!directed) measured = undirected(measured);
  // Q380 acts for C and the axis that the cycle finds. A and B align the edge to the axis that it runs along.
  const int runsAlong = 3 - axis - machineAxis(context, context.option(272));
  double target = runsAlong == zero ? 0 : 90;
  if (directed || context.option(312) == 6) target = context.q(380);
  context.result(150, measured, {.nominal = target});
  const double turn = directed ? normalizedDegrees(target - measured) : undirected(target - measured);
  const std::size_t rotary = turnWorkpiece(context, axis, turn);
  if (context.option(337) == 1) zeroRotaryAxis(context, rotary, row);
}

}  // namespace

extern const Entry cycle403 = {.definition = definition, .conditions = {.tilted = {}}, .rules = rules, .run = run};

}  // namespace probewright::cycles::heidenhain

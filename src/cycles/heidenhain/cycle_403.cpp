#include <fmt/format.h>

#include <cmath>

#include "control/alarm.hpp"
#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/edge_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/rotary_alignment.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice axisChoices[] = {
    {0, "the axis that fits, found by the cycle"}, {4, "A axis"}, {5, "B axis"}, {6, "C axis"}};

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
    standard(transfer, 1),
    standard(angle(380, "Q380", "angle that the edge is aligned to", 0, 360), 0),
};

constexpr ResultDefinition results403[] = {{"Q150", "measured angle", ValueKind::Angle}};

/// The axis of machine coordinates that the compensating axis turns about: 0, 1, 2 for A, B, C.
int compensationAxis(Context& context, const MeasuredEdge& edge) {
  const auto& plane = context.control().coordinates.plane;
  const bool inPlane = context.option(272) != 3;
  const int wanted = context.option(312);
  int fitting = plane.tool;
  if (!inPlane) fitting = std::abs(edge.along.x()) > std::abs(edge.along.y()) ? plane.minor : plane.main;
  if (wanted == 0) return fitting;
  const int axis = wanted - 4;
  const bool possible = inPlane ? axis == plane.tool : axis != plane.tool;
  if (!possible) {
    throw control::Alarm("Rotary axis not permitted",
                         fmt::format("Axis {} cannot compensate what is measured along axis {} (Q272)", "ABC"[axis],
                                     context.option(272)),
                         "choose the measuring axis or the compensation axis (Q312) that fits");
  }
  return axis;
}

}  // namespace

const CycleDefinition cycle403Definition = {
    .number = 403,
    .name = "403",
    .title = "ROT IN ROTARY AXIS",
    .family = CycleFamily::Misalignment,
    .summary = "Measures the misalignment of an edge by two touches and turns a rotary axis until it is aligned.",
    .parameters = parameters403,
    .results = results403,
};

void cycle403(Context& context, const Arguments&) {
  context.require({.tiltAllowed = false});
  const MeasuredEdge edge = measureEdge(context);
  const int axis = compensationAxis(context, edge);
  const auto& plane = context.control().coordinates.plane;

  // The angle in the plane square to the axis, counted about it from the next axis in turn: C from X, A from Y, B from
  // Z.
  const Vector3 along = plane.xyzFromPlane(edge.along);
  double measured = degreesFromRadians(std::atan2(along[(axis + 2) % 3], along[(axis + 1) % 3]));
  const bool directed = context.option(312) == 0;
  const double target = context.option(312) == 0 || context.option(312) == 6 ? context.q(380) : 0;
  if (!directed) measured = undirected(measured);
  context.result(150, measured, {.nominal = target});
  // B counts from Z: an edge along X lies at 90 degrees there.
  const double reference = axis == 1 && context.option(312) != 0 ? target + 90 : target;
  const double turn = directed ? normalizedDegrees(reference - measured) : undirected(reference - measured);
  const std::size_t rotary = turnWorkpiece(context, axis, turn);
  if (context.option(337) == 1) zeroRotaryAxis(context, rotary, context.option(312) == 0);
}

}  // namespace probewright::cycles::heidenhain

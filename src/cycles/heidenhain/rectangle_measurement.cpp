#include "cycles/heidenhain/rectangle_measurement.hpp"

#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"
#include "cycles/heidenhain/transfer.hpp"
#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {
namespace {

probing::Heights heightsOf(const Context& context, probing::Between between) {
  return {.measuring = context.q(261),
          .clearance = context.q(260),
          .extraClearance = context.given(320) ? context.q(320) : 0,
          .between = between};
}

}  // namespace

MeasuredRectangle measureRectangle(Context& context, const RectangleParameters& numbers, Side side) {
  probing::RectangleTask task;
  task.centre = {context.q(numbers.centre1), context.q(numbers.centre2)};
  task.length1 = context.q(numbers.length1);
  task.length2 = context.q(numbers.length2);
  task.side = side;
  const auto touches = probing::probeRectangle(context.prober(), task, heightsOf(context, betweenOf(context)));

  const PartPoint& plus1 = touches[0].surface;
  const PartPoint& plus2 = touches[1].surface;
  const PartPoint& minus1 = touches[2].surface;
  const PartPoint& minus2 = touches[3].surface;
  MeasuredRectangle rectangle;
  rectangle.centre = {(plus1[0] + minus1[0]) / 2, (plus2[1] + minus2[1]) / 2, context.q(261)};
  rectangle.length1 = plus1[0] - minus1[0];
  rectangle.length2 = plus2[1] - minus2[1];
  return rectangle;
}

MeasuredWidth measureWidth(Context& context, const Vector2& centre, double width, int axis, Side side,
                           probing::Between between) {
  const probing::WidthTask task{.centre = centre, .width = width, .axis = axis, .side = side};
  const auto touches = probing::probeWidth(context.prober(), task, heightsOf(context, between));
  const double plus = touches[0].surface[axis];
  const double minus = touches[1].surface[axis];
  return {(plus + minus) / 2, plus - minus, context.q(261)};
}

void presetRectangle(Context& context, Side side) {
  requireTransferTarget(context);
  const MeasuredRectangle rectangle = measureRectangle(context, {321, 322, 323, 324}, side);
  context.result(151, rectangle.centre.x(), {.nominal = context.q(321)});
  context.result(152, rectangle.centre.y(), {.nominal = context.q(322)});
  context.result(154, rectangle.length1, {.nominal = context.q(323)});
  context.result(155, rectangle.length2, {.nominal = context.q(324)});
  finishPreset(context, {.measured = rectangle.centre, .wish = {context.q(331), context.q(332)}, .rotation = {}});
}

void inspectRectangle(Context& context, Side side, const std::string& title) {
  requireMonitoredTool(context);
  const MeasuredRectangle rectangle = measureRectangle(context, {273, 274, 282, 283}, side);
  Inspection inspection{
      .title = title,
      .items = {inspectedPosition(151, 161, "Center in reference axis", context.q(273), rectangle.centre.x(),
                                  context.q(279)),
                inspectedPosition(152, 162, "Center in minor axis", context.q(274), rectangle.centre.y(),
                                  context.q(280)),
                inspectedDimension(154, 164, "Side length in reference axis", "side length in reference axis",
                                   context.q(282), rectangle.length1, context.q(284), context.q(285), side),
                inspectedDimension(155, 165, "Side length in minor axis", "side length in minor axis", context.q(283),
                                   rectangle.length2, context.q(286), context.q(287), side)},
      .measured = {},
      .further = {{"Measuring height", context.q(261)}}};
  // The control judges the tool by the first side alone.
  const double deviation = rectangle.length1 - context.q(282);
  finishInspection(context, inspection, {.monitored = deviation, .excess = -probing::outwards(side) * deviation / 2});
}

void presetWidth(Context& context, Side side) {
  requireTransferTarget(context);
  const int axis = context.option(272) - 1;
  const Vector2 centre(context.q(321), context.q(322));
  const probing::Between between = side == Side::Outside ? probing::Between::AtClearanceHeight : betweenOf(context);
  const MeasuredWidth measured = measureWidth(context, centre, context.q(311), axis, side, between);
  context.result(166, measured.width, {.nominal = context.q(311)});
  context.result(157, measured.centre, {.nominal = centre[axis]});
  NewPreset preset;
  preset.measured = {centre.x(), centre.y(), measured.height};
  preset.measured[axis] = measured.centre;
  preset.wish[static_cast<std::size_t>(axis)] = context.q(405);
  finishPreset(context, preset);
}

}  // namespace probewright::cycles::heidenhain

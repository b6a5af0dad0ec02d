#include "cycles/heidenhain/rectangle_measurement.hpp"

#include "probing/heidenhain_strategies.hpp"

namespace probewright::cycles::heidenhain {
namespace {

probing::Heights heightsOf(const Context& context, bool betweenAtClearance) {
  return {.measuring = context.q(261),
          .clearance = context.q(260),
          .extraClearance = context.given(320) ? context.q(320) : 0,
          .between = betweenAtClearance ? probing::Between::AtClearanceHeight : probing::Between::AtMeasuringHeight};
}

}  // namespace

MeasuredRectangle measureRectangle(Context& context, const RectangleParameters& numbers, Side side) {
  probing::RectangleTask task;
  task.centre = {context.q(numbers.centre1), context.q(numbers.centre2)};
  task.length1 = context.q(numbers.length1);
  task.length2 = context.q(numbers.length2);
  task.side = side;
  const auto touches = probing::probeRectangle(context.prober(), task, heightsOf(context, context.option(301) == 1));

  const Vector3& plus1 = touches[0].surface;
  const Vector3& plus2 = touches[1].surface;
  const Vector3& minus1 = touches[2].surface;
  const Vector3& minus2 = touches[3].surface;
  MeasuredRectangle rectangle;
  rectangle.centre = {(plus1[0] + minus1[0]) / 2, (plus2[1] + minus2[1]) / 2, context.q(261)};
  rectangle.length1 = plus1[0] - minus1[0];
  rectangle.length2 = plus2[1] - minus2[1];
  return rectangle;
}

MeasuredWidth measureWidth(Context& context, const Vector2& centre, double width, int axis, Side side,
                           bool betweenAtClearance) {
  const probing::WidthTask task{.centre = centre, .width = width, .axis = axis, .side = side};
  const auto touches = probing::probeWidth(context.prober(), task, heightsOf(context, betweenAtClearance));
  const double plus = touches[0].surface[axis];
  const double minus = touches[1].surface[axis];
  return {(plus + minus) / 2, plus - minus, context.q(261)};
}

}  // namespace probewright::cycles::heidenhain

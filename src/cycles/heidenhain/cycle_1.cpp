#include <cmath>
#include <span>

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/old_form_parameters.hpp"
#include "cycles/heidenhain/single_touch.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters1[] = {
    probingAxis("1.1 axis"), probingAngle("1.1 angle"), prePosition("1.2 X", 0), prePosition("1.2 Y", 1),
    prePosition("1.2 Z", 2), prePosition("1.2 A", 3),   prePosition("1.2 B", 4), prePosition("1.2 C", 5),
};

constexpr CycleDefinition definition = {
    .number = 1,
    .name = "1",
    .title = "POLAR DATUM PLANE",
    .family = CycleFamily::Inspection,
    .summary = "Measures one position in any direction of a plane: X in X/Y, Y in Y/Z, Z in Z/X.",
    .parameters = parameters1,
    .results = std::span(singleTouchResults).subspan(1),
};

void run(Context& context, const Arguments& arguments) {
  moveToProgrammedPosition(context);

  // The angle turns from the probing axis to the next one in the order X, Y, Z, X.
  const int axis = arguments.integer(probe_word::axis);
  const double angle = radiansFromDegrees(arguments.number(probe_word::angle));
  ProgramWay direction;
  direction[axis] = std::cos(angle);
  direction[(axis + 1) % 3] = std::sin(angle);
  auto& prober = context.prober();
  const EvaluatedTouch touch = prober.stroke(context.control().coordinates.plane.planeFromXyz(direction));
  storeTouchPosition(context, touch);
}

}  // namespace

extern const Entry cycle1 = {.definition = definition, .conditions = {.under = Transformed::Any}, .run = run};

}  // namespace probewright::cycles::heidenhain

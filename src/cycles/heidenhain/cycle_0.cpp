#include <fmt/format.h>

#include <array>

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/old_form_parameters.hpp"
#include "cycles/heidenhain/single_touch.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters0[] = {
    resultParameter("0.0 Q"),
    probingAxis("0.0 axis"),
    option(probe_word::direction, "0.0 direction", "probing direction", directionChoices),
    prePosition("0.1 X", 0),
    prePosition("0.1 Y", 1),
    prePosition("0.1 Z", 2),
    prePosition("0.1 A", 3),
    prePosition("0.1 B", 4),
    prePosition("0.1 C", 5),
};

constexpr CycleDefinition definition = {
    .number = 0,
    .name = "0",
    .title = "REF. PLANE",
    .family = CycleFamily::Inspection,
    .summary = "Measures one position in an axis direction and stores its coordinate in a Q parameter.",
    .parameters = parameters0,
    .results = singleTouchResults,
};

void run(Context& context, const Arguments& arguments) {
  moveToProgrammedPosition(context);

  const int axis = arguments.integer(probe_word::axis);
  ProgramWay direction;
  direction[axis] = arguments.number(probe_word::direction);
  const control::WorkingPlane& plane = context.control().coordinates.plane;
  auto& prober = context.prober();
  const EvaluatedTouch touch = prober.stroke(plane.planeFromXyz(direction));

  const double coordinate = plane.xyzFromPlane(touch.surface)[axis];
  const int number = arguments.integer(probe_word::result);
  context.set(number, coordinate / context.control().mainUnit);
  control::ResultRecord result;
  result.name = fmt::format("Q{}", number);
  result.meaning = fmt::format("measured coordinate, {}", "XYZ"[axis]);
  result.label = fmt::format("coordinate, {}", "XYZ"[axis]);
  constexpr std::array along = {of::positionX, of::positionY, of::positionZ};
  result.kind = result::actual(along[static_cast<std::size_t>(axis)]).main();
  result.value = coordinate + 0.0;  // no -0
  result.unit = "mm";
  context.record().results.push_back(std::move(result));
  storeTouchPosition(context, touch);
}

}  // namespace

extern const Entry cycle0 = {.definition = definition, .conditions = {.under = Transformed::Any}, .run = run};

}  // namespace probewright::cycles::heidenhain

#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters422 =
    joined(joined(
               std::array{
                   coordinate(273, "Q273", "nominal centre in the main axis"),
                   coordinate(274, "Q274", "nominal centre in the minor axis"),
                   length(262, "Q262", "nominal diameter of the stud"),
                   angle(325, "Q325", "angle of the first touch from the main axis"),
                   angle(247, "Q247", "angle from touch to touch, negative: clockwise; at least 5 degrees", -120, 120),
               },
               heightsAndTravel),
           std::array{
               limit(277, "Q277", "largest permissible diameter; 0 together with the smallest: not monitored"),
               limit(278, "Q278", "smallest permissible diameter"),
               centreTolerance1,
               centreTolerance2,
               measuringLog,
               toleranceStop,
               monitoredTool,
               pointCount,
               traverse,
               reverseTool,
               inclination,
           });

constexpr ResultDefinition results422[] = {
    {"Q151", "actual centre, main axis"},
    {"Q152", "actual centre, minor axis"},
    {"Q153", "actual diameter"},
    {"Q161", "deviation of the centre, main axis"},
    {"Q162", "deviation of the centre, minor axis"},
    {"Q163", "deviation of the diameter"},
    {"Q180", "1: within tolerance", ValueKind::Integer},
    {"Q181", "1: rework", ValueKind::Integer},
    {"Q182", "1: scrap", ValueKind::Integer},
};

}  // namespace

const CycleDefinition cycle422Definition = {
    .number = 422,
    .name = "422",
    .title = "MEAS. CIRCLE OUTSIDE",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures centre and diameter of a circular stud by three or four touches and compares them with tolerances; "
        "can correct the tool that made it.",
    .parameters = parameters422,
    .results = results422,
};

void cycle422(Context& context, const Arguments&) {
  context.require({});
  const MeasuredCircle circle = measureCircle(context, {273, 274, 262}, Side::Outside);

  Inspection inspection{.title = "Circular Stud Measuring",
                        .items = {},
                        .measured = {},
                        .further = {{"Measuring height", context.q(261)}}};
  inspection.items = {
      inspectedPosition(151, 161, "Center in reference axis", context.q(273), circle.centre.x(), context.q(279)),
      inspectedPosition(152, 162, "Center in minor axis", context.q(274), circle.centre.y(), context.q(280)),
      inspectedDimension(153, 163, "Diameter", "stud", context.q(262), circle.diameter, context.q(277), context.q(278),
                         Side::Outside)};
  const double deviation = circle.diameter - context.q(262);
  finishInspection(context, inspection, {.monitored = deviation, .excess = deviation / 2});
}

}  // namespace probewright::cycles::heidenhain

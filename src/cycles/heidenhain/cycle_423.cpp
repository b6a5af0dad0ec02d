#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters423 =
    joined(joined(
               std::array{
                   coordinate(273, "Q273", "nominal centre in the main axis"),
                   coordinate(274, "Q274", "nominal centre in the minor axis"),
                   length(282, "Q282", "nominal length of the pocket along the main axis"),
                   length(283, "Q283", "nominal length of the pocket along the minor axis"),
               },
               heightsAndTravel),
           std::array{
               limit(284, "Q284", "largest permissible length along the main axis; 0 with Q285 = 0: not monitored"),
               limit(285, "Q285", "smallest permissible length along the main axis"),
               limit(286, "Q286", "largest permissible length along the minor axis; 0 with Q287 = 0: not monitored"),
               limit(287, "Q287", "smallest permissible length along the minor axis"),
               centreTolerance1,
               centreTolerance2,
               measuringLog,
               toleranceStop,
               monitoredTool,
           });

constexpr ResultDefinition results423[] = {
    {"Q151", "actual centre, main axis"},
    {"Q152", "actual centre, minor axis"},
    {"Q154", "actual length along the main axis"},
    {"Q155", "actual length along the minor axis"},
    {"Q161", "deviation of the centre, main axis"},
    {"Q162", "deviation of the centre, minor axis"},
    {"Q164", "deviation of the length along the main axis"},
    {"Q165", "deviation of the length along the minor axis"},
    {"Q180", "1: within tolerance", ValueKind::Integer},
    {"Q181", "1: rework", ValueKind::Integer},
    {"Q182", "1: scrap", ValueKind::Integer},
};

}  // namespace

const CycleDefinition cycle423Definition = {
    .number = 423,
    .name = "423",
    .title = "MEAS. RECTAN. INSIDE",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures centre and side lengths of a rectangular pocket and compares them with tolerances; can correct the "
        "tool that made it.",
    .parameters = parameters423,
    .results = results423,
};

void cycle423(Context& context, const Arguments&) {
  context.require({});
  const MeasuredRectangle rectangle = measureRectangle(context, {273, 274, 282, 283}, Side::Inside);

  Inspection inspection{.title = "Rectangular Pocket Measuring",
                        .items = {},
                        .measured = {},
                        .further = {{"Measuring height", context.q(261)}}};
  inspection.items = {
      inspectedPosition(151, 161, "Center in reference axis", context.q(273), rectangle.centre.x(), context.q(279)),
      inspectedPosition(152, 162, "Center in minor axis", context.q(274), rectangle.centre.y(), context.q(280)),
      inspectedDimension(154, 164, "Side length in reference axis", "side length in reference axis", context.q(282),
                         rectangle.length1, context.q(284), context.q(285), Side::Inside),
      inspectedDimension(155, 165, "Side length in minor axis", "side length in minor axis", context.q(283),
                         rectangle.length2, context.q(286), context.q(287), Side::Inside)};
  const double deviation = rectangle.length1 - context.q(282);
  finishInspection(context, inspection, {.monitored = deviation, .excess = -deviation / 2});
}

}  // namespace probewright::cycles::heidenhain

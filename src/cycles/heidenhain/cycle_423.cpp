#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr std::array parameters423 =
    parameters::rectangleInspectionWith(parameters::upTo(parameters::monitoredTool, 32767.9));

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
    .results = parameters::rectangleInspectionResults,
};

void cycle423(Context& context, const Arguments&) {
  inspectRectangle(context, Side::Inside, "Rectangular Pocket Measuring");
}

}  // namespace probewright::cycles::heidenhain

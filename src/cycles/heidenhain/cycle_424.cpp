#include "cycles/heidenhain/cycles.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr std::array parameters424 = parameters::rectangleInspectionWith(parameters::monitoredTool);

}  // namespace

const CycleDefinition cycle424Definition = {
    .number = 424,
    .name = "424",
    .title = "MEAS. RECTAN. OUTS.",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures centre and side lengths of a rectangular stud and compares them with tolerances; can correct the "
        "tool that made it.",
    .parameters = parameters424,
    .results = parameters::rectangleInspectionResults,
};

void cycle424(Context& context, const Arguments&) {
  inspectRectangle(context, Side::Outside, "Rectangular Stud Measuring");
}

}  // namespace probewright::cycles::heidenhain

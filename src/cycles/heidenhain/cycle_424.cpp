#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr std::array parameters424 = parameters::rectangleInspectionWith(parameters::monitoredTool);

constexpr LogTerm logTerms[] = {
    {"Rectangular Stud Measuring", "Измерение прямоугольника снаружи", "Mätning utvändig rektangel"},
};

constexpr CycleDefinition definition = {
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

void run(Context& context, const Arguments&) { inspectRectangle(context, Side::Outside, "Rectangular Stud Measuring"); }

}  // namespace

extern const Entry cycle424 = {.definition = definition, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain

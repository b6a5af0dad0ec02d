#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/context.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr std::array parameters422 = parameters::circleInspection(
    parameters::limit(277, "Q277", "largest permissible diameter; 0 with Q278 = 0: not monitored"),
    parameters::limit(278, "Q278", "smallest permissible diameter"),
    parameters::upTo(parameters::monitoredTool, 32767.9));

constexpr LogTerm logTerms[] = {
    {"Circular Stud Measuring", "Измерение окружности снаружи", "Mätning utvändig cirkel"},
};

constexpr CycleDefinition definition = {
    .number = 422,
    .name = "422",
    .title = "MEAS. CIRCLE OUTSIDE",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures centre and diameter of a circular stud by three or four touches and compares them with tolerances; "
        "can correct the tool that made it.",
    .parameters = parameters422,
    .results = parameters::circleInspectionResults,
};

void run(Context& context, const Arguments&) {
  inspectCircle(context, Side::Outside, "Circular Stud Measuring", "stud", 277, 278);
}

}  // namespace

extern const Entry cycle422 = {.definition = definition, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain

#include "cycles/heidenhain/circle_measurement.hpp"
#include "cycles/heidenhain/context.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr std::array parameters421 = parameters::circleInspection(
    parameters::limit(275, "Q275", "largest permissible diameter; 0 with Q276 = 0: not monitored"),
    parameters::limit(276, "Q276", "smallest permissible diameter"));

constexpr LogTerm logTerms[] = {
    {"Hole Measuring", "Измерение отверстия", "Mätning av hål"},
};

constexpr CycleDefinition definition = {
    .number = 421,
    .name = "421",
    .title = "MEASURE HOLE",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures centre and diameter of a hole by three or four touches and compares them with tolerances; can "
        "correct the tool that made the hole.",
    .parameters = parameters421,
    .results = parameters::circleInspectionResults,
};

void run(Context& context, const Arguments&) {
  inspectCircle(context, Side::Inside, "Hole Measuring", "hole", 275, 276);
}

}  // namespace

extern const Entry cycle421 = {.definition = definition, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain

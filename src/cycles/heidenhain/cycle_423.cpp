#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/rectangle_measurement.hpp"

namespace probewright::cycles::heidenhain {
namespace {

constexpr std::array parameters423 =
    parameters::rectangleInspectionWith(parameters::upTo(parameters::monitoredTool, 32767.9));

constexpr LogTerm logTerms[] = {
    {"Rectangular Pocket Measuring", "Измерение прямоугольника внутри", "Mätning invändig rektangel"},
};

/// As the manual of the iTNC 530 prints them.
constexpr CapitalTerm capitalTerms[] = {
    {"Center in reference axis", "CENTER IN REF. AXIS"},
    {"Maximum limit for center in reference axis", "MAX. FOR CENTER IN REF. AXIS"},
    {"Minimum limit for center in reference axis", "MIN. FOR CENTER IN REF. AXIS"},
    {"Maximum limit for center in minor axis", "MAX. FOR CENTER IN MINOR AXIS"},
    {"Minimum limit for center in minor axis", "MIN. FOR CENTER IN MINOR AXIS"},
    {"Side length in reference axis", "SIDE LENGTH IN REF. AXIS"},
    {"Maximum dimension for side length in reference axis", "MAX. IN REFERENCE AXIS"},
    {"Minimum dimension for side length in reference axis", "MINIMUM DIMENSION IN REFERENCE AXIS"},
    {"Maximum dimension for side length in minor axis", "MAXIMUM SIDE LENGTH IN MINOR AXIS"},
    {"Minimum dimension for side length in minor axis", "MINIMUM SIDE LENGTH IN MINOR AXIS"},
};

constexpr CycleDefinition definition = {
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

void run(Context& context, const Arguments&) {
  inspectRectangle(context, Side::Inside, "Rectangular Pocket Measuring");
}

}  // namespace

extern const Entry cycle423 = {
    .definition = definition, .logTerms = logTerms, .capitalTerms = capitalTerms, .run = run};

}  // namespace probewright::cycles::heidenhain

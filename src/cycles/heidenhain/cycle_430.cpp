#include "cycles/heidenhain/bolt_circle_measurement.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters430 =
    joined(boltCircleParameters, std::array{
                                     limit(288, "Q288", "largest permissible diameter; 0 with Q289 = 0: not monitored"),
                                     limit(289, "Q289", "smallest permissible diameter"),
                                     centreTolerance1,
                                     centreTolerance2,
                                     measuringLog,
                                     toleranceStop,
                                     monitoredTool,
                                 });

constexpr ResultDefinition results430[] = {
    {"Q151", {"actual ", "centre, main axis"}, result::actual(of::centre1).main()},
    {"Q152", {"actual ", "centre, minor axis"}, result::actual(of::centre2).main()},
    {"Q153", {"actual ", "diameter of the bolt hole circle"}, result::actual(of::diameter).main()},
    {"Q161", {"deviation of the ", "centre, main axis"}, result::difference(of::centre1)},
    {"Q162", {"deviation of the ", "centre, minor axis"}, result::difference(of::centre2)},
    {"Q163", {"deviation of the ", "diameter"}, result::difference(of::diameter)},
    {"Q180", "1: within tolerance", result::status},
    {"Q181", "1: rework", result::status},
    {"Q182", "1: scrap", result::status},
};

constexpr LogTerm logTerms[] = {
    {"Bolt Hole Circle Measuring", "Измерение образующей окружности", "Mätning hålcirkel"},
    {"Maximum dimension for bolt hole circle", "Максимальный размер образующей окружности", "Största mått hålcirkel"},
    {"Minimum dimension for bolt hole circle", "Наименьший размер образующей окружности", "Minsta mått hålcirkel"},
};

constexpr CycleDefinition definition = {
    .number = 430,
    .name = "430",
    .title = "MEAS. BOLT HOLE CIRC",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures three holes of a bolt hole circle, and compares centre and diameter of the circle with tolerances.",
    .parameters = parameters430,
    .results = results430,
};

void run(Context& context, const Arguments&) {
  requireMonitoredTool(context);
  const MeasuredCircle circle = measureBoltCircle(context);
  Inspection inspection{.title = "Bolt Hole Circle Measuring",
                        .items = {},
                        .measured = {},
                        .further = {{"Measuring height", context.q(261)}}};
  inspection.items = {
      inspectedPosition(151, 161, "Center in reference axis", context.q(273), circle.centre.x(), context.q(279)),
      inspectedPosition(152, 162, "Center in minor axis", context.q(274), circle.centre.y(), context.q(280)),
      inspectedDimension(153, 163, "Diameter", "bolt hole circle", context.q(262), circle.diameter, context.q(288),
                         context.q(289), Side::Inside)};
  // No tool can put a bolt hole circle right: both sides of the limits are scrap.
  for (Inspected& item : inspection.items) {
    if (item.verdict == Verdict::Rework) item.verdict = Verdict::Scrap;
  }
  finishInspection(context, inspection, {.monitored = circle.diameter - context.q(262), .correct = false});
}

}  // namespace

extern const Entry cycle430 = {.definition = definition, .logTerms = logTerms, .run = run};

}  // namespace probewright::cycles::heidenhain

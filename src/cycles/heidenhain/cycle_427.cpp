#include "cycles/heidenhain/call_rules.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/inspection.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Parameter parameters427[] = {
    coordinate(263, "Q263", "touch, main axis"),
    coordinate(264, "Q264", "touch, minor axis"),
    measuringHeight,
    setUpClearance,
    measuringAxis3,
    probingDirection,
    clearanceHeight,
    measuringLog,
    coordinate(288, "Q288", "largest permissible value; 0 with Q289 = 0: not monitored"),
    coordinate(289, "Q289", "smallest permissible value"),
    toleranceStop,
    monitoredTool,
    reverseTool,
    inclination,
};

constexpr ResultDefinition results427[] = {
    {"Q160", {"measured ", "coordinate"}, result::actual(of::coordinate).main()},
    {"Q180", "1: within tolerance", result::status},
    {"Q181", "1: rework", result::status},
    {"Q182", "1: scrap", result::status},
};

constexpr LogTerm logTerms[] = {
    {"Coordinate Measuring", "Измерить координату", "Mätning koordinater"},
    {"Measured coordinate", "Измеренная координата", "Uppmätt koordinat"},
    {"Maximum dimension for coordinate", "Максимальный размер координаты", "Största mått koordinat"},
    {"Minimum dimension for coordinate", "Наименьший размер координаты", "Minsta mått koordinat"},
};

constexpr CycleDefinition definition = {
    .number = 427,
    .name = "427",
    .title = "MEASURE COORDINATE",
    .family = CycleFamily::Inspection,
    .summary =
        "Measures one coordinate in any axis and compares it with limits; can correct the tool that made the "
        "surface.",
    .parameters = parameters427,
    .results = results427,
};

void rules(CallRules& call) {
  // Exchanged limits are those of a recess.
  call.allowCrossedLimits();
}

void run(Context& context, const Arguments&) {
  requireMonitoredTool(context);
  const int axis = context.option(272) - 1;
  const double sense = context.option(267);
  const PlannedTouch planned{{context.q(263), context.q(264), context.q(261)}, probing::axisDirection(axis, sense)};
  auto& prober = context.prober();
  prober.approach(prober.prePosition(planned, context.q(320)), context.q(260));
  const EvaluatedTouch touch = prober.touch(planned);
  prober.moveSouthPoleTo(context.q(260));

  // The control takes the surface for that of a stud; exchanged limits make it that of a recess.
  double maximum = context.q(288);
  double minimum = context.q(289);
  const Side side = maximum < minimum ? Side::Inside : Side::Outside;
  if (side == Side::Inside) std::swap(maximum, minimum);
  const double actual = touch.surface[axis];
  const double nominal = planned.surface[axis];
  Inspection inspection{
      .title = "Coordinate Measuring", .items = {}, .measured = {}, .further = {{"Measuring height", context.q(261)}}};
  inspection.items = {
      inspectedCoordinate(160, "Measured coordinate", "coordinate", nominal, actual, maximum, minimum, side)};
  const double deviation = actual - nominal;
  // The turning axis is that of the tool axis, through the origin: parts grow away from it on either side.
  const bool beyond = axis != 2 && (nominal < 0 || (nominal == 0 && sense > 0));
  finishInspection(context, inspection,
                   {.monitored = deviation,
                    .excess = -sense * deviation,
                    .length = axis == 2,
                    .turned = beyond ? -deviation : deviation});
}

}  // namespace

extern const Entry cycle427 = {.definition = definition, .logTerms = logTerms, .rules = rules, .run = run};

}  // namespace probewright::cycles::heidenhain

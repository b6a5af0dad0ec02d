#include "cycles/heidenhain/width_inspection.hpp"
#include "cycles/heidenhain/tool_monitoring.hpp"

namespace probewright::cycles::heidenhain {

void finishWidthInspection(Context& context, double plus, double minus, Side side, const std::string& title) {
  const double width = plus - minus;
  const double nominal = context.q(311);
  Inspection inspection{
      .title = title,
      .items = {inspectedDimension(156, 166, "Length", "length", nominal, width, context.q(288), context.q(289), side)},
      .measured = {{"Position of center line", (plus + minus) / 2}},
      .further = {{"Measuring height", context.q(261)}}};
  context.result(157, (plus + minus) / 2);
  const double deviation = width - nominal;
  finishInspection(context, inspection, {.monitored = deviation, .excess = -probing::outwards(side) * deviation / 2});
}

}  // namespace probewright::cycles::heidenhain

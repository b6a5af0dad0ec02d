#include <fmt/format.h>

#include "control/alarm.hpp"
#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/hole_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"
#include "metrology/elements.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr std::array parameters418 = joined(
    std::array{
        coordinate(268, "Q268", "centre of the first hole, main axis"),
        coordinate(269, "Q269", "centre of the first hole, minor axis"),
        coordinate(270, "Q270", "centre of the second hole, main axis"),
        coordinate(271, "Q271", "centre of the second hole, minor axis"),
        coordinate(316, "Q316", "centre of the third hole, main axis"),
        coordinate(317, "Q317", "centre of the third hole, minor axis"),
        coordinate(318, "Q318", "centre of the fourth hole, main axis"),
        coordinate(319, "Q319", "centre of the fourth hole, minor axis"),
        measuringHeight,
        clearanceHeight,
    },
    centreTransfer);

constexpr ResultDefinition results418[] = {
    {"Q151", {"actual ", "intersection, main axis"}, result::actual(of::corner1).main()},
    {"Q152", {"actual ", "intersection, minor axis"}, result::actual(of::corner2).main()},
};

constexpr CycleDefinition definition = {
    .number = 418,
    .name = "418",
    .title = "PRESET FROM 4 HOLES",
    .family = CycleFamily::Preset,
    .summary = "Measures four holes and sets the preset to the point where the lines through opposite centres cross.",
    .parameters = parameters418,
    .results = results418,
};

void run(Context& context, const Arguments&) {
  requireTransferTarget(context);
  for (const auto& [one, other] : {std::pair{268, 316}, {270, 318}}) {
    const Vector2 along(context.q(other) - context.q(one), context.q(other + 1) - context.q(one + 1));
    if (along.norm() >= 1e-6) continue;
    throw control::Alarm("Intersection not determined",
                         fmt::format("Holes {} lie at the same place", one == 268 ? "1 and 3" : "2 and 4"),
                         "give four different holes");
  }
  std::vector<Vector2> centres;
  for (const auto& [main, minor] : {std::pair{268, 269}, {270, 271}, {316, 317}, {318, 319}}) {
    centres.push_back(measureHoleCentre(context, {context.q(main), context.q(minor)}, context.q(261)).inPlane());
  }
  const auto crossing = metrology::intersection(metrology::Line2{centres[0], centres[2] - centres[0]},
                                                metrology::Line2{centres[1], centres[3] - centres[1]});
  if (!crossing) {
    throw control::Alarm("Intersection not determined",
                         "The lines through holes 1 and 3 and through holes 2 and 4 are parallel",
                         "give the holes in their order around the intersection");
  }
  context.result(151, crossing->x());
  context.result(152, crossing->y());
  finishPreset(context, {.measured = {crossing->x(), crossing->y(), context.q(261)},
                         .wish = {context.q(331), context.q(332)},
                         .rotation = {}});
}

}  // namespace

extern const Entry cycle418 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain

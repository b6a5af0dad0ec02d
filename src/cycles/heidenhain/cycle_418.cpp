#include <fmt/format.h>

#include "control/alarm.hpp"
#include "cycles/heidenhain/call_rules.hpp"
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

constexpr Example examples[] = {{"Q270", 60}, {"Q316", 60}, {"Q317", 40}, {"Q319", 40}};

constexpr CycleDefinition definition = {
    .number = 418,
    .name = "418",
    .title = "PRESET FROM 4 HOLES",
    .family = CycleFamily::Preset,
    .summary = "Measures four holes and sets the preset to the point where the lines through opposite centres cross.",
    .parameters = parameters418,
    .results = results418,
    .examples = examples,
};

using metrology::Line2;

std::optional<Vector2> crossingOf(const Vector2& first, const Vector2& second, const Vector2& third,
                                  const Vector2& fourth) {
  const auto crossing = metrology::intersection(Line2{first, third - first}, Line2{second, fourth - second});
  return crossing ? std::optional<Vector2>(*crossing) : std::nullopt;
}

void rules(CallRules& call) {
  const auto first = call.numbers({268, 269}), second = call.numbers({270, 271}), third = call.numbers({316, 317}),
             fourth = call.numbers({318, 319});
  if (!first || !second || !third || !fourth) return;
  if (first == third || second == fourth) {
    call.refuse("Intersection not determined", first == third ? 317 : 319,
                fmt::format("Holes {} lie at the same place", first == third ? "1 and 3" : "2 and 4"),
                "give four different holes");
  } else if (!crossingOf(*first, *second, *third, *fourth)) {
    call.refuse("Intersection not determined", 319,
                "The lines through holes 1 and 3 and through holes 2 and 4 are parallel",
                "give the holes in their order around the intersection");
  }
}

void run(Context& context, const Arguments&) {
  requireTransferTarget(context);
  std::vector<Vector2> centres;
  for (const auto& [main, minor] : {std::pair{268, 269}, {270, 271}, {316, 317}, {318, 319}}) {
    centres.push_back(measureHoleCentre(context, {context.q(main), context.q(minor)}, context.q(261)).inPlane());
  }
  const auto crossing = crossingOf(centres[0], centres[1], centres[2], centres[3]);
  if (!crossing)
    throw control::Alarm("Intersection not determined",
                         "The lines through holes 1 and 3 and through holes 2 and 4 are parallel",
                         "give the holes in their order around the intersection");
  context.result(151, crossing->x());
  context.result(152, crossing->y());
  finishPreset(context, {.measured = {crossing->x(), crossing->y(), context.q(261)},
                         .wish = {context.q(331), context.q(332)},
                         .rotation = {}});
}

}  // namespace

extern const Entry cycle418 = {
    .definition = definition, .conditions = {.under = Transformed::ByRotation}, .rules = rules, .run = run};

}  // namespace probewright::cycles::heidenhain

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/corner_measurement.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "cycles/heidenhain/transfer.hpp"

namespace probewright::cycles::heidenhain {
namespace {

using namespace parameters;

constexpr Choice cornerChoices[] = {
    {1, "main -, minor -"}, {2, "main +, minor -"}, {3, "main +, minor +"}, {4, "main -, minor +"}};

constexpr std::array parameters415 =
    joined(joined(
               std::array{
                   coordinate(263, "Q263", "corner, main axis"),
                   coordinate(264, "Q264", "corner, minor axis"),
                   length(326, "Q326", "distance from the corner to the second touch in the main axis"),
                   length(327, "Q327", "distance from the corner to the fourth touch in the minor axis"),
                   option(308, "Q308", "which corner", cornerChoices),
               },
               heightsAndTravel),
           joined(std::array{basicRotation}, centreTransfer));

constexpr ResultDefinition results415[] = {
    {"Q151", {"actual ", "corner, main axis"}, result::actual(of::corner1).main()},
    {"Q152", {"actual ", "corner, minor axis"}, result::actual(of::corner2).main()},
};

constexpr CycleDefinition definition = {
    .number = 415,
    .name = "415",
    .title = "PRESET INSIDE CORNER",
    .family = CycleFamily::Preset,
    .summary =
        "Measures two sides of an inside corner by two touches each and sets the preset to their intersection; can set "
        "a basic rotation from the first side.",
    .parameters = parameters415,
    .results = results415,
};

void run(Context& context, const Arguments&) {
  requireTransferTarget(context);
  const int corner = context.option(308);
  // Away from the corner into the pocket.
  const double inwards1 = corner == 1 || corner == 4 ? 1 : -1;
  const double inwards2 = corner == 1 || corner == 2 ? 1 : -1;
  const double height = context.q(261);
  auto& prober = context.prober();
  const double standOff =
      prober.inProgram(prober.probe().ballRadius + prober.probe().setUp, PlaneWay::unit(0)) + context.q(320);
  const PartPoint at(context.q(263), context.q(264), height);
  const PlaneWay direction1 = probing::axisDirection(1, -inwards2);
  const PlaneWay direction2 = probing::axisDirection(0, -inwards1);
  const CornerTouches touches = {
      PlannedTouch{at + PlaneWay(inwards1 * standOff, 0, 0), direction1},
      PlannedTouch{at + PlaneWay(inwards1 * context.q(326), 0, 0), direction1},
      PlannedTouch{at + PlaneWay(0, inwards2 * standOff, 0), direction2},
      PlannedTouch{at + PlaneWay(0, inwards2 * context.q(327), 0), direction2},
  };
  presetCorner(context, measureCorner(context, touches, Side::Inside));
}

}  // namespace

extern const Entry cycle415 = {.definition = definition, .conditions = {.under = Transformed::ByRotation}, .run = run};

}  // namespace probewright::cycles::heidenhain

#pragma once

#include <span>

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"
#include "probing/heidenhain_strategies.hpp"

/// What cycles 412, 413, 421 and 422 have in common: a circle measured from their parameters.
namespace probewright::cycles::heidenhain {

namespace parameters {

inline constexpr std::array circlePreset =
    joined(joined(
               std::array{
                   coordinate(321, "Q321", "nominal centre in the main axis"),
                   coordinate(322, "Q322", "nominal centre in the minor axis"),
                   length(262, "Q262", "nominal diameter"),
                   angle(325, "Q325", "angle of the first touch from the main axis"),
                   angle(247, "Q247", "angle from touch to touch, negative: clockwise; at least 5 degrees", -120, 120),
               },
               heightsAndTravel),
           joined(centreTransfer, std::array{pointCount, traverse}));

inline constexpr std::array circlePresetResults = {
    ResultDefinition{"Q151", {"actual ", "centre, main axis"}, result::actual(of::centre1).main()},
    ResultDefinition{"Q152", {"actual ", "centre, minor axis"}, result::actual(of::centre2).main()},
    ResultDefinition{"Q153", {"actual ", "diameter"}, result::actual(of::diameter).main()},
};

/// The limits of the diameter have numbers of their own for holes and for studs.
constexpr auto circleInspection(const Parameter& largestDiameter, const Parameter& smallestDiameter,
                                const Parameter& tool = monitoredTool) {
  return joined(
      joined(
          std::array{
              coordinate(273, "Q273", "nominal centre in the main axis"),
              coordinate(274, "Q274", "nominal centre in the minor axis"),
              length(262, "Q262", "nominal diameter"),
              angle(325, "Q325", "angle of the first touch from the main axis"),
              angle(247, "Q247", "angle from touch to touch, negative: clockwise; at least 5 degrees", -120, 120),
          },
          heightsAndTravel),
      std::array{largestDiameter, smallestDiameter, centreTolerance1, centreTolerance2, measuringLog, toleranceStop,
                 tool, pointCount, traverse, reverseTool, inclination});
}

inline constexpr std::array circleInspectionResults = {
    ResultDefinition{"Q151", {"actual ", "centre, main axis"}, result::actual(of::centre1).main()},
    ResultDefinition{"Q152", {"actual ", "centre, minor axis"}, result::actual(of::centre2).main()},
    ResultDefinition{"Q153", {"actual ", "diameter"}, result::actual(of::diameter).main()},
    ResultDefinition{"Q161", {"deviation of the ", "centre, main axis"}, result::difference(of::centre1)},
    ResultDefinition{"Q162", {"deviation of the ", "centre, minor axis"}, result::difference(of::centre2)},
    ResultDefinition{"Q163", {"deviation of the ", "diameter"}, result::difference(of::diameter)},
    ResultDefinition{"Q180", "1: within tolerance", result::status},
    ResultDefinition{"Q181", "1: rework", result::status},
    ResultDefinition{"Q182", "1: scrap", result::status},
};

}  // namespace parameters

struct MeasuredCircle {
  PartPoint centre;  ///< in the measuring plane; the third coordinate is the measuring height
  double diameter = 0;
};

/// The ball radius in program coordinates. Where cycle 26 scales the axes differently, a circle is an ellipse there:
/// its diameter and the ball radius are means.
double meanBallRadius(std::span<const EvaluatedTouch> touches);

/// Which Q parameters hold the nominal circle.
struct CircleParameters {
  int centre1 = 0, centre2 = 0, diameter = 0;
};

/// Touches the circle as Q325, Q247, Q261, Q320, Q260, Q301, Q423 and Q365 say and fits it: three touches exactly, four
/// by least squares; four where the cycle has no Q423. Throws Alarm for a stepping angle below 5 degrees.
MeasuredCircle measureCircle(Context& context, const CircleParameters& numbers, Side side,
                             probing::Ending ending = probing::Ending::AtClearanceHeight);

/// Cycles 412 and 413: measures, leaves the results and sets the preset to the centre.
void presetCircle(Context& context, Side side);

/// Cycles 421 and 422: measures and inspects. `title` heads the log, `feature` names it there; `maximum` and `minimum`
/// are the Q numbers of the limits.
void inspectCircle(Context& context, Side side, const std::string& title, const std::string& feature, int maximum,
                   int minimum);

}  // namespace probewright::cycles::heidenhain

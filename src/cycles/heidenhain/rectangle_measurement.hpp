#pragma once

#include "cycles/heidenhain/context.hpp"
#include "cycles/heidenhain/preset_parameters.hpp"

/// What cycles 408 to 411, 423 and 424 have in common: a rectangle or a width measured from their parameters.
namespace probewright::cycles::heidenhain {

namespace parameters {

inline constexpr std::array rectanglePreset =
    joined(joined(
               std::array{
                   coordinate(321, "Q321", "nominal centre in the main axis"),
                   coordinate(322, "Q322", "nominal centre in the minor axis"),
                   length(323, "Q323", "length along the main axis"),
                   length(324, "Q324", "length along the minor axis"),
               },
               heightsAndTravel),
           centreTransfer);

inline constexpr std::array rectanglePresetResults = {
    ResultDefinition{"Q151", {"actual ", "centre, main axis"}, result::actual(of::centre1).main()},
    ResultDefinition{"Q152", {"actual ", "centre, minor axis"}, result::actual(of::centre2).main()},
    ResultDefinition{"Q154", {"actual ", "length along the main axis"}, result::actual(of::length1).main()},
    ResultDefinition{"Q155", {"actual ", "length along the minor axis"}, result::actual(of::length2).main()},
};

constexpr auto rectangleInspectionWith(const Parameter& tool) {
  return joined(
      joined(
          std::array{
              coordinate(273, "Q273", "nominal centre in the main axis"),
              coordinate(274, "Q274", "nominal centre in the minor axis"),
              length(282, "Q282", "nominal length along the main axis"),
              length(283, "Q283", "nominal length along the minor axis"),
          },
          heightsAndTravel),
      std::array{
          limit(284, "Q284", "largest permissible length along the main axis; 0 with Q285 = 0: not monitored"),
          limit(285, "Q285", "smallest permissible length along the main axis"),
          limit(286, "Q286", "largest permissible length along the minor axis; 0 with Q287 = 0: not monitored"),
          limit(287, "Q287", "smallest permissible length along the minor axis"),
          centreTolerance1,
          centreTolerance2,
          measuringLog,
          toleranceStop,
          tool,
      });
}

inline constexpr std::array rectangleInspectionResults = {
    ResultDefinition{"Q151", {"actual ", "centre, main axis"}, result::actual(of::centre1).main()},
    ResultDefinition{"Q152", {"actual ", "centre, minor axis"}, result::actual(of::centre2).main()},
    ResultDefinition{"Q154", {"actual ", "length along the main axis"}, result::actual(of::length1).main()},
    ResultDefinition{"Q155", {"actual ", "length along the minor axis"}, result::actual(of::length2).main()},
    ResultDefinition{"Q161", {"deviation of the ", "centre, main axis"}, result::difference(of::centre1)},
    ResultDefinition{"Q162", {"deviation of the ", "centre, minor axis"}, result::difference(of::centre2)},
    ResultDefinition{"Q164", {"deviation of the ", "length along the main axis"}, result::difference(of::length1)},
    ResultDefinition{"Q165", {"deviation of the ", "length along the minor axis"}, result::difference(of::length2)},
    ResultDefinition{"Q180", "1: within tolerance", result::status},
    ResultDefinition{"Q181", "1: rework", result::status},
    ResultDefinition{"Q182", "1: scrap", result::status},
};

/// Cycles 408 and 409; only inside a slot does the probe have a choice of heights between the walls.
inline constexpr std::array widthCentre = {
    coordinate(321, "Q321", "nominal centre in the main axis"),
    coordinate(322, "Q322", "nominal centre in the minor axis"),
    length(311, "Q311", "width"),
    measuringAxis2,
};
inline constexpr std::array widthTransfer = joined(
    std::array{presetTableRow,
               standard(coordinate(405, "Q405", "coordinate that the centre line gets in the measured axis"), 0)},
    joined(std::array{chosenTransfer}, toolAxisPreset));

inline constexpr std::array widthResults = {
    ResultDefinition{"Q166", {"actual ", "width"}, result::actual(of::width).main()},
    ResultDefinition{"Q157", {"actual ", "position of the centre line"}, result::actual(of::coordinate).main()},
};

}  // namespace parameters

struct MeasuredRectangle {
  PartPoint centre;
  double length1 = 0, length2 = 0;  ///< along main and minor axis
};

/// Which Q parameters hold the nominal rectangle.
struct RectangleParameters {
  int centre1 = 0, centre2 = 0, length1 = 0, length2 = 0;
};

/// Touches the middle of the four sides as Q261, Q320, Q260 and Q301 say. The centre lies half way between opposite
/// touches; on a rectangle skewed by a small angle the lengths are too large by the factor 1/cos(angle), as on the
/// control.
MeasuredRectangle measureRectangle(Context& context, const RectangleParameters& numbers, Side side);

/// The same for the two walls of a slot or ridge across axis 0 (main) or 1 (minor).
struct MeasuredWidth {
  double centre = 0;  ///< coordinate of the centre line in the measured axis
  double width = 0;
  double height = 0;  ///< measuring height
};
MeasuredWidth measureWidth(Context& context, const Vector2& centre, double width, int axis, Side side,
                           probing::Between between);

/// Cycles 410 and 411: measures, leaves the results and sets the preset to the centre.
void presetRectangle(Context& context, Side side);

/// Cycles 423 and 424: measures and inspects. `title` heads the log.
void inspectRectangle(Context& context, Side side, const std::string& title);

/// Cycles 408 and 409: measures, leaves the results and sets the preset to the centre line.
void presetWidth(Context& context, Side side);

}  // namespace probewright::cycles::heidenhain

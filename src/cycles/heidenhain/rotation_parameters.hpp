#pragma once

#include <array>

#include "cycles/heidenhain/preset_parameters.hpp"

/// The parameters that cycles 1410, 1411 and 1420 share.
namespace probewright::cycles::heidenhain::parameters {

/// A nominal position or diameter: a number, or a text with "?", a tolerance or an actual position.
constexpr Parameter nominalText(std::uint32_t number, std::string_view name, std::string_view meaning,
                                double minimum = -largest, double maximum = largest) {
  return {.name = name,
          .address = number,
          .meaning = meaning,
          .kind = ValueKind::NumberOrText,
          .minimum = minimum,
          .maximum = maximum};
}

inline constexpr std::array position1 = {
    nominalText(1100, "Q1100", "first nominal position, main axis; as text also \"?30\", \"10+0.02\", \"10@10.01\""),
    nominalText(1101, "Q1101", "first nominal position, minor axis"),
    nominalText(1102, "Q1102", "first nominal position, tool axis"),
};
inline constexpr std::array position2 = {
    nominalText(1103, "Q1103", "second nominal position, main axis"),
    nominalText(1104, "Q1104", "second nominal position, minor axis"),
    nominalText(1105, "Q1105", "second nominal position, tool axis"),
};
inline constexpr std::array position3 = {
    nominalText(1106, "Q1106", "third nominal position, main axis"),
    nominalText(1107, "Q1107", "third nominal position, minor axis"),
    nominalText(1108, "Q1108", "third nominal position, tool axis"),
};

inline constexpr Choice directionChoices3[] = {{-3, "tool axis, negative"}, {-2, "minor axis, negative"},
                                               {-1, "main axis, negative"}, {1, "main axis, positive"},
                                               {2, "minor axis, positive"}, {3, "tool axis, positive"}};
inline constexpr Parameter signedDirection = option(372, "Q372", "axis and direction of probing", directionChoices3);

inline constexpr Choice clearanceModeChoices[] = {{-1, "never to the clearance height"},
                                                  {0, "before and after the cycle"},
                                                  {1, "before and after each object"},
                                                  {2, "before and after each touch, pre-positioning at 2000 mm/min"}};
inline constexpr Choice reactionChoices[] = {{0, "none"}, {1, "stop at rework and scrap"}, {2, "stop at scrap only"}};
inline constexpr Choice alignChoices[] = {{0, "leave the rotary axes where they are"},
                                          {1, "position them, the tip stays on the workpiece (MOVE)"},
                                          {2, "position them alone (TURN)"}};

/// Q320, Q260, Q1125, Q309, Q1126.
inline constexpr std::array travelAndReaction = {
    setUpClearance,
    clearanceHeight,
    option(1125, "Q1125", "when the probe moves to the clearance height", clearanceModeChoices),
    option(309, "Q309", "reaction when a tolerance is exceeded", reactionChoices),
    option(1126, "Q1126", "positioning of the rotary axes", alignChoices),
};

inline constexpr Choice transferOf2Choices[] = {
    {0, "no correction"}, {1, "first position"}, {2, "second position"}, {3, "mean of both positions"}};
inline constexpr Choice rotationOf2Choices[] = {
    {0, "no"}, {1, "as basic rotation"}, {2, "as offset of the rotary table"}};
/// Q1120 and Q1121 of cycles with two positions.
inline constexpr std::array transferOf2 = {
    option(1120, "Q1120", "position that corrects the active preset", transferOf2Choices),
    option(1121, "Q1121", "take over the rotation", rotationOf2Choices),
};

/// What 1410 and 1420 leave of the first two positions.
inline constexpr std::array firstTwoPositions = {
    ResultDefinition{"Q950", "first measured position, main axis", result::actual(of::position1.number(1))},
    ResultDefinition{"Q951", "first measured position, minor axis", result::actual(of::position2.number(1))},
    ResultDefinition{"Q952", "first measured position, tool axis", result::actual(of::position3.number(1))},
    ResultDefinition{"Q953", "second measured position, main axis", result::actual(of::position1.number(2))},
    ResultDefinition{"Q954", "second measured position, minor axis", result::actual(of::position2.number(2))},
    ResultDefinition{"Q955", "second measured position, tool axis", result::actual(of::position3.number(2))},
};
inline constexpr std::array deviationsOfFirstTwo = {
    ResultDefinition{
        "Q980", {"deviation of the ", "first position, main axis"}, result::difference(of::position1.number(1))},
    ResultDefinition{
        "Q981", {"deviation of the ", "first position, minor axis"}, result::difference(of::position2.number(1))},
    ResultDefinition{
        "Q982", {"deviation of the ", "first position, tool axis"}, result::difference(of::position3.number(1))},
    ResultDefinition{
        "Q983", {"deviation of the ", "second position, main axis"}, result::difference(of::position1.number(2))},
    ResultDefinition{
        "Q984", {"deviation of the ", "second position, minor axis"}, result::difference(of::position2.number(2))},
    ResultDefinition{
        "Q985", {"deviation of the ", "second position, tool axis"}, result::difference(of::position3.number(2))},
};
inline constexpr std::array verdictOfRotation = {
    ResultDefinition{"Q183", "workpiece: -1 not monitored, 0 good, 1 rework, 2 scrap", result::status},
};

}  // namespace probewright::cycles::heidenhain::parameters

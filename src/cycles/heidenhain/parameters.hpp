#pragma once

#include "cycles/catalogue.hpp"

/// Parameters that many HEIDENHAIN cycles share: the same number always means the same.
namespace probewright::cycles::heidenhain::parameters {

inline constexpr double largest = 99999.9999;

/// An absolute coordinate.
constexpr Parameter coordinate(std::uint32_t number, std::string_view name, std::string_view meaning) {
  return {.name = name, .address = number, .meaning = meaning, .kind = ValueKind::Length};
}

/// A length, width or distance that cannot be negative.
constexpr Parameter length(std::uint32_t number, std::string_view name, std::string_view meaning) {
  return {.name = name, .address = number, .meaning = meaning, .kind = ValueKind::Length, .minimum = 0};
}

/// A limit of a dimension; 0 together with its counterpart: not monitored.
constexpr Parameter limit(std::uint32_t number, std::string_view name, std::string_view meaning) {
  return length(number, name, meaning);
}

constexpr Parameter angle(std::uint32_t number, std::string_view name, std::string_view meaning, double minimum = -360,
                          double maximum = 360) {
  return {.name = name,
          .address = number,
          .meaning = meaning,
          .kind = ValueKind::Angle,
          .minimum = minimum,
          .maximum = maximum};
}

constexpr Parameter option(std::uint32_t number, std::string_view name, std::string_view meaning,
                           std::span<const Choice> choices) {
  return {.name = name, .address = number, .meaning = meaning, .kind = ValueKind::Option, .choices = choices};
}

/// The same parameter, used with `value` where it is left out.
constexpr Parameter standard(Parameter parameter, double value) {
  parameter.standard = value;
  return parameter;
}

/// The same parameter for one control only.
constexpr Parameter only(Parameter parameter, ControlSet controls) {
  parameter.controls = controls;
  return parameter;
}

/// The same parameter, whose largest value on some controls is less.
constexpr Parameter upToOn(Parameter parameter, ControlSet controls, double maximum) {
  parameter.narrower = {.controls = controls, .maximum = maximum};
  return parameter;
}

/// The same parameter, which came to the iTNC 530 with the NC software 340 49x-`software`.
constexpr Parameter later(Parameter parameter, int software) {
  parameter.iTNC530Software = software;
  return parameter;
}

inline constexpr Parameter measuringHeight =
    coordinate(261, "Q261", "measuring height: coordinate of the ball centre in the touch probe axis");

inline constexpr Parameter setUpClearance = {.name = "Q320",
                                             .address = 320,
                                             .meaning =
                                                 "set-up clearance, added to SET_UP of the touch probe table "
                                                 "(iTNC 530: MP6140, with tools MP6540)",
                                             .kind = ValueKind::Length,
                                             .minimum = 0,
                                             .predefinable = true};

inline constexpr Parameter clearanceHeight = {
    .name = "Q260",
    .address = 260,
    .meaning = "clearance height: coordinate in the touch probe axis where nothing can be hit",
    .kind = ValueKind::Length,
    .predefinable = true};

inline constexpr Choice moveToClearanceChoices[] = {{0, "between points at measuring height"},
                                                    {1, "between points at clearance height"}};
inline constexpr Parameter moveToClearance = {.name = "Q301",
                                              .address = 301,
                                              .meaning = "move to clearance height between the points",
                                              .kind = ValueKind::Option,
                                              .choices = moveToClearanceChoices,
                                              .predefinable = true};

inline constexpr Choice pointCountChoices[] = {{4, "four touches"}, {3, "three touches"}};
inline constexpr Parameter pointCount =
    later(standard(option(423, "Q423", "number of touches on the circle", pointCountChoices), 4), 5);

inline constexpr Choice traverseChoices[] = {{0, "straight"}, {1, "on the pitch circle"}};
inline constexpr Parameter traverse =
    later(standard(option(365, "Q365", "path between the points at clearance height", traverseChoices), 1), 5);

inline constexpr Choice axis2Choices[] = {{1, "main axis"}, {2, "minor axis"}};
inline constexpr Choice axis3Choices[] = {{1, "main axis"}, {2, "minor axis"}, {3, "touch probe axis"}};
inline constexpr Parameter measuringAxis2 = option(272, "Q272", "measuring axis", axis2Choices);
inline constexpr Parameter measuringAxis3 = option(272, "Q272", "measuring axis", axis3Choices);
inline constexpr Choice directionChoices[] = {{-1, "negative"}, {1, "positive"}};
inline constexpr Parameter probingDirection =
    option(267, "Q267", "direction in which the probe approaches the workpiece", directionChoices);

// ---- misalignment ----

inline constexpr Parameter referenceAngle =
    angle(307, "Q307", "angle of the line that the misalignment is measured from");
inline constexpr Choice compensationChoices[] = {{0, "basic rotation"}, {1, "turn the rotary table"}};
inline constexpr Parameter compensation =
    standard(option(402, "Q402", "how the misalignment is compensated", compensationChoices), 0);
inline constexpr Choice zeroChoices[] = {{0, "no"}, {1, "yes"}};
inline constexpr Parameter setToZero =
    standard(option(337, "Q337", "set the angle of the aligned rotary axis to zero", zeroChoices), 0);

// ---- inspection ----

inline constexpr Choice measuringLogChoices[] = {
    {0, "no log"}, {1, "log file beside the program"}, {2, "show the log and wait for NC start"}};
inline constexpr Parameter measuringLog = option(281, "Q281", "measuring log", measuringLogChoices);

inline constexpr Choice toleranceStopChoices[] = {{0, "go on"}, {1, "stop with an error message"}};
inline constexpr Parameter toleranceStop =
    option(309, "Q309", "program stop if a tolerance is exceeded", toleranceStopChoices);

inline constexpr Parameter monitoredTool = {.name = "Q330",
                                            .address = 330,
                                            .meaning = "tool to monitor and correct, by number or name; 0: none",
                                            .kind = ValueKind::NumberOrText,
                                            .minimum = 0,
                                            .maximum = 999999.9};

/// Some cycles print a smaller range.
constexpr Parameter upTo(Parameter parameter, double maximum) {
  parameter.maximum = maximum;
  return parameter;
}

inline constexpr Choice reverseToolChoices[] = {{0, "as in the turning tool table"}, {1, "turned by 180 degrees"}};
inline constexpr Parameter reverseTool =
    only(standard(option(498, "Q498", "turning tool in Q330: reversed", reverseToolChoices), 0), control::onTNC640);
inline constexpr Parameter inclination =
    only(standard(angle(531, "Q531", "turning tool in Q330: angle of incidence", -180, 180), 0), control::onTNC640);

inline constexpr Parameter centreTolerance1 =
    length(279, "Q279", "permissible deviation of the centre in the main axis; 0: not monitored");
inline constexpr Parameter centreTolerance2 =
    length(280, "Q280", "permissible deviation of the centre in the minor axis; 0: not monitored");

// ---- presetting ----

inline constexpr Parameter tableRow = {.name = "Q305",
                                       .address = 305,
                                       .meaning = "row of the preset or datum table",
                                       .kind = ValueKind::Integer,
                                       .minimum = 0,
                                       .maximum = 99999};

/// The rows that the presetting cycles know.
constexpr Parameter upTo9999(Parameter parameter) {
  parameter.maximum = 9999;
  return parameter;
}
inline constexpr Parameter presetTableRow = upTo9999(tableRow);

inline constexpr Parameter newPreset1 =
    standard(coordinate(331, "Q331", "coordinate that the feature gets in the main axis"), 0);
inline constexpr Parameter newPreset2 =
    standard(coordinate(332, "Q332", "coordinate that the feature gets in the minor axis"), 0);
inline constexpr Parameter newPreset3 =
    standard(coordinate(333, "Q333", "coordinate that the surface gets in the touch probe axis"), 0);

inline constexpr Choice transferChoices[] = {
    {-1, "not defined: refused"}, {0, "into the active datum table"}, {1, "into the preset table"}};
inline constexpr Parameter transfer = option(303, "Q303", "where the measured values go", transferChoices);
/// The same of cycles that older controls do not have.
inline constexpr Parameter chosenTransfer =
    option(303, "Q303", "where the measured values go", std::span(transferChoices).subspan(1));

inline constexpr Choice probeToolAxisChoices[] = {{0, "no"}, {1, "yes"}};
inline constexpr Parameter probeToolAxis =
    option(381, "Q381", "also set the preset in the touch probe axis", probeToolAxisChoices);
inline constexpr Parameter toolAxisPoint1 =
    coordinate(382, "Q382", "main axis coordinate of the touch in the touch probe axis");
inline constexpr Parameter toolAxisPoint2 =
    coordinate(383, "Q383", "minor axis coordinate of the touch in the touch probe axis");
inline constexpr Parameter toolAxisPoint3 =
    coordinate(384, "Q384", "touch probe axis coordinate of the touch in the touch probe axis");

}  // namespace probewright::cycles::heidenhain::parameters

#pragma once

#include "cycles/heidenhain/old_form_parameters.hpp"

/// Parameters and results of the cycles that measure tools, in both forms.
namespace probewright::cycles::heidenhain::parameters {

inline constexpr Choice measuringModes[] = {
    {0, "measure: write the value into TOOL.T, clear the delta value"},
    {1, "check: write the deviation as delta value, lock the tool beyond its tolerances"},
    {2, "compare only (TNC 640)", control::onTNC640}};
inline constexpr Choice teethChoices[] = {{0, "the whole tool"}, {1, "each tooth"}};

inline constexpr Parameter newToolForm[] = {
    option(340, "Q340", "what becomes of the measured value", measuringModes),
    clearanceHeight,
    option(341, "Q341", "individual teeth", teethChoices),
};

inline constexpr Parameter oldToolForm[] = {
    option(probe_word::check, "CHECK", "what becomes of the measured value", measuringModes),
    standard(resultParameter("Qn"), 0),
    coordinate(probe_word::height, "HEIGHT", "clearance height: coordinate in the tool axis where nothing can be hit"),
    option(probe_word::teeth, "PROBING THE TEETH", "individual teeth", teethChoices),
};

inline constexpr ResultDefinition lengthDeviation = {"Q115", "deviation of the length from L of TOOL.T",
                                                     result::difference(of::length3).main()};
inline constexpr ResultDefinition radiusDeviation = {"Q116", "deviation of the radius from R of TOOL.T",
                                                     result::difference(of::radius).main()};
inline constexpr ResultDefinition newStatus = {"Q199", "0: within the tolerances, 1: worn, 2: broken", result::status};
inline constexpr ResultDefinition oldStatus = {"Qn", "0: within the tolerances, 1: worn, 2: broken", result::status};

inline constexpr std::string_view lengthSummary =
    "Measures the length of the tool with the tool touch probe: with a rotating tool, with a stationary one (R-OFFS = "
    "0), or tooth by tooth.";
inline constexpr std::string_view radiusSummary =
    "Measures the radius of the tool with the tool touch probe: with a rotating tool, and each tooth after that if "
    "asked for; a tool with CUT = 0 stands.";
inline constexpr std::string_view bothSummary =
    "Measures length and radius of the tool with the tool touch probe: with a rotating tool, or tooth by tooth. A TNC "
    "640 begins with the length of a rotating tool; otherwise the radius comes first.";
inline constexpr std::string_view calibrationSummary =
    "Calibrates the tool touch probe with an exact cylindrical tool: the place of its contact, the effective width and "
    "the run-out of the tool.";

}  // namespace probewright::cycles::heidenhain::parameters

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "control/dialog_language.hpp"
#include "records/truth.hpp"

/// What the virtual machine knows, in lines for a terminal.
namespace probewright::reports {

/// "  true 40.0120, error -0.0008": after a result of that value, all in the result's unit. `decimals` after the point.
std::string besideResult(const records::TrueValue& truth, double measured, int decimals,
                         control::DialogLanguage language);

/// How texts of the run are written.
struct TruthStyle {
  control::DialogLanguage language = control::DialogLanguage::English;
  std::function<std::string(const std::string&)> line;         ///< makes a text fit for a terminal
  std::function<std::string(const SourcePlace& place)> place;  ///< of a place in the program
};

/// What was written into tables against the truth, a line for each entry: "preset 1: 0.4 um and 0.0003 deg from the
/// truth".
std::string entriesText(const records::Truth& truth, const TruthStyle& style);

/// Why motions were interrupted: "  truth  the face of "part" is 5.700 mm further in +Y...", a line for each sentence.
std::string diagnosesText(const records::Truth& truth, const TruthStyle& style);

/// How near the tool came to things: each block that came nearer than the limit as a warning, or the nearest one where
/// there is no limit.
std::string clearanceText(const records::Clearance& clearance, const TruthStyle& style);

/// Each block that brought an axis nearer to an end of its travel than the limit, as a warning.
std::string nearEndsText(const std::vector<records::TravelMargin>& nearEnds, const TruthStyle& style);

}  // namespace probewright::reports

#pragma once

#include <functional>
#include <string>

#include "records/truth.hpp"

/// What the virtual machine knows, in lines for a terminal.
namespace probewright::reports {

/// "  true 40.0120, error -0.0008": behind a result of that value, all in the result's unit. `decimals` after the
/// point.
std::string besideResult(const records::TrueValue& truth, double measured, int decimals);

/// What was written into tables against the truth, a line for each entry: "preset 1: 0.4 um and 0.0003 deg from the
/// truth". `line` makes text of the run fit for a terminal.
std::string entriesText(const records::Truth& truth, const std::function<std::string(const std::string&)>& line);

}  // namespace probewright::reports

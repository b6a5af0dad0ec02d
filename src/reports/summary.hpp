#pragma once

#include <string>

#include "control/journal.hpp"
#include "records/run_info.hpp"

namespace probewright::reports {

enum class Colour { Off, On };

/// The run in a few lines for a terminal: each cycle with its line, its main results (cycles::mainResults), what it
/// wrote and its verdict; at the end the state of the whole, path, time and alarms. With Colour::On verdicts carry ANSI
/// colours.
std::string summaryText(const control::Journal& journal, const records::RunInfo& run, Colour colour = Colour::Off);

}  // namespace probewright::reports

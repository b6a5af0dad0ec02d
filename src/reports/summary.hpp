#pragma once

#include <string>

#include "control/dialog_language.hpp"
#include "control/journal.hpp"
#include "records/run_info.hpp"

namespace probewright::reports {

enum class Colour { Off, On };

/// Whether what stopped the run is said at the end, or was told elsewhere already.
enum class Cause { Shown, Told };

/// The run in a few lines for a terminal: each cycle with its line, its main results (cycles::mainResults), what it
/// wrote and its verdict, and the true values where they are known; at the end the state of the whole, path, time and
/// alarms. With Colour::On verdicts carry ANSI colours. Names that the program gives, file names and entries of tables
/// are the same in every language.
std::string summaryText(const control::Journal& journal, const records::RunInfo& run, Colour colour = Colour::Off,
                        Cause cause = Cause::Shown,
                        control::DialogLanguage language = control::DialogLanguage::English);

}  // namespace probewright::reports

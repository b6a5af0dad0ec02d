#pragma once

#include <cstddef>
#include <string>

#include "control/dialog_language.hpp"
#include "control/journal.hpp"

/// The screens of cycles in the reader's language. The record of a run is in English.
namespace probewright::reports {

/// A line of a screen of `cycle`: each text between two blanks or more for itself. What stood in columns,
/// right-aligned, still does as far as the words leave room.
std::string screenLine(const std::string& line, const control::CycleRecord& cycle, control::DialogLanguage language);

}  // namespace probewright::reports

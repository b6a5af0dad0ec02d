#pragma once

#include <string>

#include "control/control_kind.hpp"
#include "control/dialog_language.hpp"
#include "cycles/catalogue.hpp"

namespace probewright::app {

/// A call of the cycle for `kind`, ready to paste and fill in: Klartext with the text of the control in its
/// conversational language after each parameter, SINUMERIK with a comment line for each argument. Values are the
/// defaults; where there are none the number nearest to 0 that may stand there, or the first choice.
std::string cycleTemplate(const cycles::CycleDefinition& cycle, control::ControlKind kind,
                          control::DialogLanguage language);

}  // namespace probewright::app

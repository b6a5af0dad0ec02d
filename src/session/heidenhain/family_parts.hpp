#pragma once

#include "session/heidenhain/family.hpp"

/// The parts of the family's entry that are more than a line.
namespace probewright::session::heidenhain {

Diagnostics checkHeidenhain(const CheckRequest& request);
/// Klartext, with the text of the control after each parameter.
std::string klartextTemplate(const cycles::CycleDefinition& cycle, control::ControlKind control,
                             control::DialogLanguage language);
RunOn prepareHeidenhain(const RunRequest& request, Diagnostics& diagnostics);

}  // namespace probewright::session::heidenhain

#pragma once

#include "session/sinumerik/family.hpp"

namespace probewright::execution::sinumerik {
class GlobalUserData;
}

/// The parts of the family's entry that are more than a line.
namespace probewright::session::sinumerik {

/// `globalData`: what definition files declare.
Diagnostics checkSinumerik(const CheckRequest& request, const execution::sinumerik::GlobalUserData& globalData);
/// With a comment line for each argument.
std::string sinumerikTemplate(const cycles::CycleDefinition& cycle, control::ControlKind control,
                              control::DialogLanguage language);
RunOn prepareSinumerik(const RunRequest& request, Diagnostics& diagnostics);

/// Tells a SINUMERIK program the macros of definition files.
void useMacros(language::Program& program, const execution::sinumerik::GlobalUserData& globalData);

}  // namespace probewright::session::sinumerik

#pragma once

#include "conversion/convert.hpp"
#include "language/program.hpp"
#include "session/source.hpp"

namespace probewright::control {
struct Beliefs;
}

namespace probewright::session {

/// The mistakes of a program that is to be converted, as checkProgram finds them; a HEIDENHAIN program may be one for
/// either control. `path`: where the program lies; `beliefs`: of its control, null if none is known.
Diagnostics mistakesOf(language::Program& program, const std::filesystem::path& path, ProgramLanguage language,
                       const control::Beliefs* beliefs = nullptr);

/// The global user data of the control that a SINUMERIK program `path` is for: what definition files beside it declare
/// and, with a setup, those in its folder of tables, with the values that initialization texts there have for them.
conversion::GlobalData globalDataFor(const std::filesystem::path& path, const control::Beliefs* beliefs,
                                     Diagnostics& diagnostics);

}  // namespace probewright::session

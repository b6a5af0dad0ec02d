#pragma once

#include "conversion/convert.hpp"
#include "language/program.hpp"
#include "session/source.hpp"

namespace probewright::control {
struct Beliefs;
}

namespace probewright::session {

/// The mistakes of a program that is to be converted, as checkProgram finds them; it may be one for any control of its
/// family. `path`: where the program lies; `beliefs`: of its control, null if none is known.
Diagnostics mistakesOf(language::Program& program, const std::filesystem::path& path, ProgramLanguage language,
                       const control::Beliefs* beliefs = nullptr);

/// How to convert the program in that file as far as its control tells. Of a SINUMERIK program: the global user data
/// that definition files beside it declare and, with a setup, those in its folder of tables, with the values that
/// initialization texts there have for them.
conversion::ConvertOptions convertOptions(const std::filesystem::path& path, ProgramLanguage language,
                                          const control::Beliefs* beliefs, Diagnostics& diagnostics);

}  // namespace probewright::session

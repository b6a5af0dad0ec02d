#pragma once

#include "conversion/conversion.hpp"
#include "language/program.hpp"
#include "session/source.hpp"

namespace probewright::control {
struct Beliefs;
}

namespace probewright::session {

using conversion::Conversion;

/// True if programs can be converted from one of the languages into the other.
bool convertible(ProgramLanguage from, ProgramLanguage to);

struct ConvertOptions {
  /// What a SINUMERIK program may use without defining it; null if nothing is known of its control.
  const conversion::GlobalData* globalData = nullptr;
  /// The HEIDENHAIN control to write for.
  control::ControlKind control = control::ControlKind::TNC640;
  /// The programs that call each other with this one (session::jobOf); null if none are known.
  const conversion::Job* job = nullptr;
  /// SET_UP and DIST of the HEIDENHAIN control.
  conversion::TouchProbe probe = {};
};

/// The program, which is one of the language `from`, in the language `to`. What the blocks do is kept, and their
/// comments; layout and block numbers are those of the other language. Between the two languages of a HEIDENHAIN
/// control a DIN/ISO block after a label or a call that relies on G90, G91 or a path function before it is listed
/// too.
Conversion convert(language::Program& program, ProgramLanguage from, ProgramLanguage to,
                   const ConvertOptions& options = {});

/// The mistakes of a program that is to be converted, as checkProgram finds them; a HEIDENHAIN program may be one for
/// either control. `path`: where the program lies; `beliefs`: of its control, null if none is known.
Diagnostics mistakesOf(language::Program& program, const std::filesystem::path& path, ProgramLanguage language,
                       const control::Beliefs* beliefs = nullptr);

/// The global user data of the control that a SINUMERIK program `path` is for: what definition files beside it declare
/// and, with a setup, those in its folder of tables, with the values that initialization texts there have for them.
conversion::GlobalData globalDataFor(const std::filesystem::path& path, const control::Beliefs* beliefs,
                                     Diagnostics& diagnostics);

}  // namespace probewright::session

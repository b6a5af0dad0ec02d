#pragma once

#include "conversion/conversion.hpp"
#include "language/program.hpp"
#include "session/source.hpp"

namespace probewright::session {

using conversion::Conversion;

/// True if programs can be converted from one of the languages into the other.
bool convertible(ProgramLanguage from, ProgramLanguage to);

/// The program, which is one of the language `from`, in the language `to`. What the blocks do is kept, and their
/// comments; layout and block numbers are those of the other language. Between the two languages of a HEIDENHAIN
/// control a DIN/ISO block behind a label or a call that relies on G90, G91 or a path function in front of it is listed
/// too.
Conversion convert(language::Program& program, ProgramLanguage from, ProgramLanguage to);

}  // namespace probewright::session

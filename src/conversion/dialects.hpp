#pragma once

#include "conversion/conversion.hpp"
#include "conversion/tool_cycle_forms.hpp"
#include "language/program_language.hpp"

namespace probewright::conversion {

/// A program of a HEIDENHAIN control in the other of its two languages, or anew in its own. A DIN/ISO block after a
/// label or a call that relies on G90, G91 or a path function before it is listed.
Conversion betweenDialects(language::klartext::HeidenhainProgram& program, language::ProgramLanguage from,
                           language::ProgramLanguage to, ToolCycles toolCycles = ToolCycles::AsWritten);

}  // namespace probewright::conversion

#pragma once

#include <memory>

#include "conversion/conversion.hpp"
#include "conversion/tool_cycle_forms.hpp"
#include "language/program_language.hpp"

namespace probewright::conversion {

/// True if programs can be converted from one of the languages into the other, be it over a third one.
bool convertible(language::ProgramLanguage from, language::ProgramLanguage to);

/// True if ConvertOptions::toolCycles says something to programs that are written in the language.
bool hasToolCycleForms(language::ProgramLanguage language);

struct ConvertOptions {
  /// What a SINUMERIK program may use without defining it; null if nothing is known of its control.
  std::shared_ptr<const GlobalData> globalData = {};
  /// The HEIDENHAIN control to write for.
  control::ControlKind control = control::ControlKind::TNC640;
  /// The programs that call each other with this one (session::jobOf); null if none are known.
  const Job* job = nullptr;
  /// SET_UP and DIST of the HEIDENHAIN control.
  TouchProbe probe = {};
  /// The form of touch probe cycles 30 to 33 and 480 to 483 in Klartext.
  ToolCycles toolCycles = ToolCycles::AsWritten;
};

/// The program, which is one of the language `from`, in the language `to`. What the blocks do is kept, and their
/// comments; layout and block numbers are those of the other language. Between the two languages of a HEIDENHAIN
/// control a DIN/ISO block after a label or a call that relies on G90, G91 or a path function before it is listed
/// too.
Conversion convert(language::Program& program, language::ProgramLanguage from, language::ProgramLanguage to,
                   const ConvertOptions& options = {});

}  // namespace probewright::conversion

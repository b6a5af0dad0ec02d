#pragma once

#include <string>

#include "base/diagnostic.hpp"
#include "language/program.hpp"
#include "session/source.hpp"

namespace probewright::session {

/// A program written in another language.
struct Conversion {
  std::string text;
  /// Blocks that cannot be read. With any of them `text` is no program.
  Diagnostics mistakes;
  /// What the other language cannot say; it stands as a comment in `text`. And blocks that mean what the translation
  /// says only if they are reached in the order they stand in: DIN/ISO blocks behind a label or a call that rely on
  /// G90, G91 or a path function in front of it.
  Diagnostics notCarriedOver;
};

/// True if programs can be converted from one of the languages into the other.
bool convertible(ProgramLanguage from, ProgramLanguage to);

/// The program, which is one of the language `from`, in the language `to`. What the blocks do is kept, and their
/// comments; layout and block numbers are those of the other language.
Conversion convert(language::Program& program, ProgramLanguage from, ProgramLanguage to);

}  // namespace probewright::session

#include "session/convert.hpp"

#include <set>
#include <utility>

#include "control/beliefs.hpp"
#include "session/check.hpp"
#include "session/sinumerik/beliefs.hpp"
#include "session/sinumerik/family_parts.hpp"
#include "session/sinumerik/global_data.hpp"

namespace probewright::session {

Diagnostics mistakesOf(language::Program& program, const std::filesystem::path& path, ProgramLanguage language,
                       const control::Beliefs* beliefs) {
  using control::ControlKind;
  if (language != ProgramLanguage::Sinumerik) {
    Diagnostics mistakes = checkProgram(program, ControlKind::TNC640);
    const bool elder = hasErrors(mistakes) && !hasErrors(checkProgram(program, ControlKind::iTNC530));
    return elder ? Diagnostics() : mistakes;
  }
  Diagnostics ignored;  // globalDataFor names them
  const auto declared = globalUserData(path, beliefs == nullptr ? std::filesystem::path() : beliefs->tables, ignored);
  return checkSinumerik({.program = program, .control = ControlKind::Sinumerik840Dsl, .path = path, .beliefs = beliefs},
                        declared);
}

conversion::GlobalData globalDataFor(const std::filesystem::path& path, const control::Beliefs* beliefs,
                                     Diagnostics& diagnostics) {
  const auto declared =
      globalUserData(path, beliefs == nullptr ? std::filesystem::path() : beliefs->tables, diagnostics);
  if (beliefs == nullptr) return declared.variables({}, diagnostics);
  return declared.variables(sinumerikData(*beliefs, diagnostics).store, diagnostics);
}

}  // namespace probewright::session

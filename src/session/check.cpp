#include "session/check.hpp"

#include "base/file.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/program.hpp"
#include "session/source.hpp"

namespace probewright::session {

Diagnostics checkProgram(const std::filesystem::path& path, std::optional<control::ControlKind> control) {
  const Result<std::string> text = readFile(path);
  if (!text) return {text.error()};
  const Result<control::ControlKind> kind = controlFor(path, *text, control, std::nullopt);
  if (!kind) return {kind.error()};
  const ProgramLanguage language = languageOf(*kind);
  const auto library = programLibrary(language);
  if (language == ProgramLanguage::Sinumerik) {
    const auto program = sinumerik::SinumerikProgram::open(path);
    if (!program) return {program.error()};
    return sinumerik::check(**program, {.library = library.get(), .globalVariables = {}});
  }
  return {};
}

}  // namespace probewright::session

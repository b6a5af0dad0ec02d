#include "session/convert.hpp"

#include <utility>

namespace probewright::session {

Diagnostics mistakesOf(language::Program& program, const std::filesystem::path& path, ProgramLanguage language,
                       const control::Beliefs* beliefs) {
  const ControlFamily& family = knownFamilies().of(language);
  Diagnostics ofFirst;
  for (const ControlModel& model : family.controls) {
    Diagnostics found = family.check({.program = program, .control = model.kind, .path = path, .beliefs = beliefs});
    const bool first = &model == &family.controls.front();
    if (!hasErrors(found)) return first ? found : Diagnostics();
    if (first) ofFirst = std::move(found);
  }
  return ofFirst;
}

conversion::ConvertOptions convertOptions(const std::filesystem::path& path, ProgramLanguage language,
                                          const control::Beliefs* beliefs, Diagnostics& diagnostics) {
  conversion::ConvertOptions options;
  const ControlFamily& family = knownFamilies().of(language);
  if (family.tellConversion != nullptr) family.tellConversion(path, beliefs, options, diagnostics);
  return options;
}

}  // namespace probewright::session

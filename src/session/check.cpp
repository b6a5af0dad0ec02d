#include "session/check.hpp"

#include <utility>

#include "base/file.hpp"
#include "language/klartext/check.hpp"
#include "language/sinumerik/check.hpp"
#include "session/global_data.hpp"
#include "session/source.hpp"

namespace probewright::session {

Diagnostics checkProgram(const std::filesystem::path& path, std::optional<control::ControlKind> control,
                         std::bitset<10> skipLevels) {
  const Result<std::string> text = readFile(path);
  if (!text) return {text.error()};
  const Result<control::ControlKind> kind = controlFor(path, *text, control, std::nullopt);
  if (!kind) return {kind.error()};
  const Result<std::shared_ptr<language::Program>> program = openProgram(path, languageFor(*kind, path, *text));
  if (!program) return {program.error()};
  if (control::isHeidenhain(*kind)) return checkProgram(**program, *kind, {}, nullptr, skipLevels);
  Diagnostics found;
  const sinumerik::GlobalUserData globalData = globalUserData(path, {}, found);
  useMacros(**program, globalData);
  const Diagnostics more = checkProgram(**program, *kind, {}, &globalData, skipLevels);
  found.insert(found.end(), more.begin(), more.end());
  return found;
}

Diagnostics checkProgram(language::Program& program, control::ControlKind kind, std::set<std::string> globalVariables,
                         const sinumerik::GlobalUserData* globalData, std::bitset<10> skipLevels) {
  const auto library = programLibrary(kind, {}, globalData);
  if (control::isHeidenhain(kind)) {
    return language::klartext::checkProgram(static_cast<language::klartext::HeidenhainProgram&>(program), kind,
                                            library.get(), skipLevels[0]);
  }
  return sinumerik::check(static_cast<sinumerik::SinumerikProgram&>(program),
                          {.library = library.get(),
                           .globalVariables = std::move(globalVariables),
                           .skipLevels = skipLevels,
                           .globalData = globalData});
}

}  // namespace probewright::session

#include "session/check.hpp"

#include <algorithm>
#include <utility>

#include "base/file.hpp"
#include "language/klartext/check.hpp"
#include "language/sinumerik/check.hpp"
#include "session/beliefs.hpp"
#include "session/global_data.hpp"
#include "session/setup_check.hpp"
#include "session/source.hpp"

namespace probewright::session {

Diagnostics checkProgram(const std::filesystem::path& path, std::optional<control::ControlKind> control,
                         std::bitset<10> skipLevels, std::string* read, const simulation::Setup* setup) {
  const Result<std::string> text = readFile(path);
  if (!text) return {text.error()};
  if (read != nullptr) *read = *text;
  const Result<control::ControlKind> kind =
      controlFor(path, *text, control, setup != nullptr ? setup->control : std::nullopt);
  if (!kind) return {kind.error()};
  const Result<std::shared_ptr<language::Program>> program = openProgram(path, *text, languageFor(*kind, path, *text));
  if (!program) return {program.error()};
  const auto withNote = [&](Diagnostics found) {
    if (setup != nullptr) {
      const Diagnostics more = checkAgainstSetup(**program, *kind, *setup, skipLevels);
      found.insert(found.end(), more.begin(), more.end());
      std::ranges::stable_sort(
          found, {}, [&](const Diagnostic& each) { return each.place.file == path.string() ? each.place.line : 0; });
    }
    if (const auto note = otherLanguage(path, *text); note && hasErrors(found)) found.push_back(*note);
    return found;
  };
  if (control::isHeidenhain(*kind)) return withNote(checkProgram(**program, *kind, {}, nullptr, skipLevels));
  Diagnostics found;
  const sinumerik::GlobalUserData globalData =
      globalUserData(path, setup != nullptr ? setup->tables : std::filesystem::path(), found);
  useMacros(**program, globalData);
  const Diagnostics more =
      checkProgram(**program, *kind, setup != nullptr ? namesOfData(*setup, *kind) : std::set<std::string>(),
                   &globalData, skipLevels);
  found.insert(found.end(), more.begin(), more.end());
  return withNote(std::move(found));
}

Diagnostics checkProgram(language::Program& program, control::ControlKind kind, std::set<std::string> globalVariables,
                         const sinumerik::GlobalUserData* globalData, std::bitset<10> skipLevels, bool foresees) {
  const auto library = programLibrary(kind, {}, globalData);
  if (control::isHeidenhain(kind)) {
    return language::klartext::checkProgram(static_cast<language::klartext::HeidenhainProgram&>(program), kind,
                                            library.get(), skipLevels[0], foresees);
  }
  return sinumerik::check(
      static_cast<sinumerik::SinumerikProgram&>(program),
      {.library = library.get(),
       .globalVariables = std::move(globalVariables),
       .skipLevels = skipLevels,
       .globalData = globalData != nullptr ? globalData->declarations() : std::vector<sinumerik::DeclaredDatum>(),
       .foresees = foresees});
}

}  // namespace probewright::session

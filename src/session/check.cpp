#include "session/check.hpp"

#include <algorithm>
#include <utility>

#include "base/file.hpp"
#include "session/host_files.hpp"
#include "session/setup_check.hpp"
#include "session/source.hpp"

namespace probewright::session {

Diagnostics checkProgram(const std::filesystem::path& path, std::optional<control::ControlKind> control,
                         std::bitset<10> skipLevels, std::string* read, const control::Beliefs* beliefs,
                         const ControlFamilies& families, const machine::MachineDescription* machine) {
  const Result<std::string> text = readFile(path);
  if (!text) return {text.error()};
  if (read != nullptr) *read = *text;
  const Result<control::ControlKind> kind =
      controlFor(path, *text, control, beliefs != nullptr ? beliefs->control : std::nullopt, families);
  if (!kind) return {kind.error()};
  const Result<std::shared_ptr<language::Program>> program =
      openProgram(path, *text, languageFor(*kind, path, *text, families), families);
  if (!program) return {program.error()};
  const ControlFamily& family = families.of(*kind);
  Diagnostics found = family.check({.program = **program,
                                    .control = *kind,
                                    .path = path,
                                    .beliefs = beliefs,
                                    .skipLevels = skipLevels,
                                    .machine = machine});
  if (beliefs != nullptr && family.inventory != nullptr) {
    Inventory inventory = family.inventory(*beliefs, *kind, found);
    HostFiles files(path, *beliefs);
    inventory.hasFile = [&files](const std::string& name) { return files.read(name).has_value(); };
    const Diagnostics more = checkAgainstSetup(**program, inventory, skipLevels, machine);
    found.insert(found.end(), more.begin(), more.end());
    std::ranges::stable_sort(
        found, {}, [&](const Diagnostic& each) { return each.place.file == path.string() ? each.place.line : 0; });
  }
  if (const auto note = otherLanguage(path, *text, families); note && hasErrors(found)) found.push_back(*note);
  return found;
}

Diagnostics checkProgram(language::Program& program, control::ControlKind kind, const ControlFamilies& families) {
  return families.of(kind).check({.program = program, .control = kind});
}

}  // namespace probewright::session

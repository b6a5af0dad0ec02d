#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "language/directory_library.hpp"
#include "language/program.hpp"
#include "session/control_family.hpp"

/// Program files, whatever their language.
namespace probewright::session {

/// The language of a program by its ending (.H; .I; .MPF, .SPF, .ARC), otherwise by its text; nothing if neither tells.
std::optional<ProgramLanguage> languageOf(const std::filesystem::path& path, std::string_view text,
                                          const ControlFamilies& families = knownFamilies());

/// A note for a program with mistakes whose text looks like another language than the one of its ending.
std::optional<Diagnostic> otherLanguage(const std::filesystem::path& path, std::string_view text,
                                        const ControlFamilies& families = knownFamilies());

/// The language to read a program in that is for `kind`: the one it tells, otherwise the first one of the family.
ProgramLanguage languageFor(control::ControlKind kind, const std::filesystem::path& path, std::string_view text,
                            const ControlFamilies& families = knownFamilies());

/// The control that a program is for: `wanted`, else `believed`, as long as it speaks the program's language; else the
/// first one of the language's family (TNC640, 840Dsl). Fails if they contradict each other or nothing tells.
Result<control::ControlKind> controlFor(const std::filesystem::path& path, std::string_view text,
                                        std::optional<control::ControlKind> wanted,
                                        std::optional<control::ControlKind> believed,
                                        const ControlFamilies& families = knownFamilies());

/// ".H, .I or .MPF": an ending for each language.
std::string endingsOf(const ControlFamilies& families = knownFamilies());
/// ".H for Klartext, .I for DIN/ISO or .MPF for a SINUMERIK".
std::string endingsWithLanguages(const ControlFamilies& families = knownFamilies());

/// The program in the file at `path`, whose whole text is `text`.
Result<std::shared_ptr<language::Program>> openProgram(const std::filesystem::path& path, std::string_view text,
                                                       ProgramLanguage language,
                                                       const ControlFamilies& families = knownFamilies());

/// A program in memory; `name` names it in messages.
std::shared_ptr<language::Program> programOf(std::string name, std::string text, ProgramLanguage language,
                                             const ControlFamilies& families = knownFamilies());

/// Told each file that a program calls; `program` is null if it cannot be read.
using OnOpen = std::function<void(language::Program* program, const std::filesystem::path& path)>;

/// Where programs of a control look for others: in the caller's folder. `family` must outlive the library. With `found`
/// each name is looked up once, see DirectoryLibrary::remember.
std::unique_ptr<language::ProgramLibrary> programLibrary(
    const ControlFamily& family, OnOpen onOpen = {},
    std::shared_ptr<language::DirectoryLibrary::Found> found = nullptr);

}  // namespace probewright::session

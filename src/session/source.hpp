#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "language/program.hpp"

namespace probewright::sinumerik {
class GlobalUserData;
}

/// Program files, whatever their language.
namespace probewright::session {

enum class ProgramLanguage { Klartext, DinIso, Sinumerik };

/// The language of a program by its ending (.H; .I; .MPF, .SPF, .ARC), otherwise by its text; nothing if neither tells.
std::optional<ProgramLanguage> languageOf(const std::filesystem::path& path, std::string_view text);

/// A note for a program with mistakes whose text looks like another language than the one of its ending.
std::optional<Diagnostic> otherLanguage(const std::filesystem::path& path, std::string_view text);

/// True if the control runs programs of that language; a HEIDENHAIN control runs two.
constexpr bool speaks(control::ControlKind kind, ProgramLanguage language) {
  return control::isHeidenhain(kind) == (language != ProgramLanguage::Sinumerik);
}

/// The language to read a program in that is for `kind`: the one it tells, otherwise the control's first one.
ProgramLanguage languageFor(control::ControlKind kind, const std::filesystem::path& path, std::string_view text);

std::string_view nameOf(ProgramLanguage language);

/// The control that a program is for: `wanted`, else `setup`, as long as it speaks the program's language; else the
/// language's own (TNC640, 840Dsl). Fails if they contradict each other or nothing tells.
Result<control::ControlKind> controlFor(const std::filesystem::path& path, std::string_view text,
                                        std::optional<control::ControlKind> wanted,
                                        std::optional<control::ControlKind> setup);

/// The program in the file at `path`, whose whole text is `text`.
Result<std::shared_ptr<language::Program>> openProgram(const std::filesystem::path& path, std::string_view text,
                                                       ProgramLanguage language);

/// A program in memory; `name` names it in messages.
std::shared_ptr<language::Program> programOf(std::string name, std::string text, ProgramLanguage language);

/// Tells a SINUMERIK program the macros of definition files; nothing for other programs.
void useMacros(language::Program& program, const sinumerik::GlobalUserData& globalData);

/// Where programs of that control look for others: the caller's folder, then `folders`. SINUMERIK programs know the
/// macros of `globalData`, which must outlive the library. `onOpen` is told each file.
std::unique_ptr<language::ProgramLibrary> programLibrary(control::ControlKind kind,
                                                         std::vector<std::filesystem::path> folders = {},
                                                         const sinumerik::GlobalUserData* globalData = nullptr,
                                                         std::function<void(const std::filesystem::path&)> onOpen = {});

}  // namespace probewright::session

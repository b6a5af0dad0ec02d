#include "session/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <regex>

#include "language/directory_library.hpp"
#include "language/klartext/program.hpp"
#include "language/sinumerik/program.hpp"

namespace probewright::session {

using control::ControlKind;

std::optional<ProgramLanguage> languageOf(const std::filesystem::path& path, std::string_view text) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".h") return ProgramLanguage::Klartext;
  if (ending == ".mpf" || ending == ".spf" || ending == ".arc") return ProgramLanguage::Sinumerik;
  const std::string head(text.substr(0, 20000));
  static const std::regex klartext(
      R"((^|\n)\s*(\d+\s+)?(BEGIN PGM|TCH PROBE|TOOL CALL|CYCL DEF|L [XYZ][+-]|FN ?\d+ ?:))");
  static const std::regex sinumerik(
      R"((^|\n)\s*(%_N_|(N\d+\s+)?(CYCLE\d+\s*\(|G\d+\s|PROC\s|DEF\s|R\d+\s*=|M30|M17|T="|;\$PATH)))",
      std::regex::icase);
  if (std::regex_search(head, klartext)) return ProgramLanguage::Klartext;
  if (std::regex_search(head, sinumerik)) return ProgramLanguage::Sinumerik;
  return std::nullopt;
}

std::string_view nameOf(ProgramLanguage language) {
  return language == ProgramLanguage::Klartext ? "Klartext" : "SINUMERIK";
}

Result<ControlKind> controlFor(const std::filesystem::path& path, std::string_view text,
                               std::optional<ControlKind> wanted, std::optional<ControlKind> setup) {
  if (wanted) return *wanted;
  const std::optional<ProgramLanguage> language = languageOf(path, text);
  if (!language) {
    if (setup) return *setup;
    return fail({path.string(), 0, 0}, "neither the ending nor the text tells which control this program is for",
                "name it with --control TNC640, iTNC530 or 840Dsl");
  }
  if (setup) {
    if (languageOf(*setup) == *language) return *setup;
    return fail({path.string(), 0, 0},
                fmt::format("this is a {} program, but the setup describes a {}", nameOf(*language), name(*setup)),
                "use a setup with a control of that language, or name the control with --control");
  }
  return *language == ProgramLanguage::Klartext ? ControlKind::TNC640 : ControlKind::Sinumerik840Dsl;
}

Result<std::shared_ptr<language::Program>> openProgram(const std::filesystem::path& path, ProgramLanguage language) {
  if (language == ProgramLanguage::Klartext) {
    auto program = language::klartext::KlartextProgram::open(path);
    if (!program) return tl::unexpected(program.error());
    return std::shared_ptr<language::Program>(std::move(*program));
  }
  auto program = sinumerik::SinumerikProgram::open(path);
  if (!program) return tl::unexpected(program.error());
  return std::shared_ptr<language::Program>(std::move(*program));
}

std::unique_ptr<language::ProgramLibrary> programLibrary(ProgramLanguage language,
                                                         std::vector<std::filesystem::path> folders) {
  const bool klartext = language == ProgramLanguage::Klartext;
  std::vector<std::string> endings =
      klartext ? std::vector<std::string>{".H"} : std::vector<std::string>{".SPF", ".MPF"};
  return std::make_unique<language::DirectoryLibrary>(
      std::move(endings), [language](const std::filesystem::path& path) { return openProgram(path, language); },
      std::move(folders));
}

}  // namespace probewright::session

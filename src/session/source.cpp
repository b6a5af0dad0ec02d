#include "session/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <regex>

#include "base/file.hpp"
#include "execution/sinumerik/global_data.hpp"
#include "language/din_iso/program.hpp"
#include "language/directory_library.hpp"
#include "language/klartext/program.hpp"
#include "language/sinumerik/program.hpp"

namespace probewright::session {

using control::ControlKind;

std::optional<ProgramLanguage> languageOf(const std::filesystem::path& path, std::string_view text) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".h") return ProgramLanguage::Klartext;
  if (ending == ".i") return ProgramLanguage::DinIso;
  if (ending == ".mpf" || ending == ".spf" || ending == ".arc") return ProgramLanguage::Sinumerik;
  const std::string head(text.substr(0, 20000));
  static const std::regex klartext(
      R"((^|\n)\s*(\d+\s+)?(BEGIN PGM|TCH PROBE|TOOL CALL|CYCL DEF|L [XYZ][+-]|FN ?\d+ ?:))");
  // Blocks that end with '*', and words that SINUMERIK has not.
  static const std::regex dinIso(
      R"((^|\n)\s*(%\S[^\n]* G7[01]\s*\*|(N\d+\s+)?(G98 ?L|D(0\d|1\d) ?Q|G[^\n;]*\*\s*(\n|$))))", std::regex::icase);
  static const std::regex sinumerik(
      R"((^|\n)\s*(%_N_|(N\d+\s+)?(CYCLE\d+\s*\(|G\d+\s|PROC\s|DEF\s|R\d+\s*=|M30|M17|T="|;\$PATH)))",
      std::regex::icase);
  if (std::regex_search(head, klartext)) return ProgramLanguage::Klartext;
  if (std::regex_search(head, dinIso)) return ProgramLanguage::DinIso;
  if (std::regex_search(head, sinumerik)) return ProgramLanguage::Sinumerik;
  return std::nullopt;
}

/// What a text is that no control here reads, in the words of a message; empty if nothing tells.
std::string_view foreignLanguage(const std::filesystem::path& path, std::string_view text) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string head(text.substr(0, 20000));
  // Probing by G38.x, numbered parameters, O words and Fanuc program numbers, comments in parentheses, G21.
  static const std::regex rs274(
      R"((^|\n)\s*/?\s*((N\d+\s+)?(G\d+(\.\d)?\s*)*G38\.[2-9]|(N\d+\s+)?#(\d+|<[^>\n]+>)\s*=|O\s*(\d+|<[^>\n]+>)\s*(SUB|CALL|IF|WHILE|REPEAT|\(|\r?\n)|\([^\n)]*\)\s*\r?(\n|$)|[^;*"\n]*\bG21\b[^;*"\n]*(\n|$)))",
      std::regex::icase);
  const bool own = languageOf(path, {}).has_value();
  if (own) return {};
  if (ending == ".ngc" || std::regex_search(head, rs274)) return "an RS-274 program (LinuxCNC, Fanuc and others)";
  return {};
}

std::string_view nameOf(ProgramLanguage language) {
  switch (language) {
    case ProgramLanguage::Klartext:
      return "Klartext";
    case ProgramLanguage::DinIso:
      return "DIN/ISO";
    default:
      return "SINUMERIK";
  }
}

std::optional<Diagnostic> otherLanguage(const std::filesystem::path& path, std::string_view text) {
  const std::optional<ProgramLanguage> readAs = languageOf(path, text), looksLike = languageOf("program", text);
  if (!readAs || !looksLike || *readAs == *looksLike) return std::nullopt;
  return Diagnostic{
      Severity::Note,
      {path.string(), 0, 0},
      fmt::format("it was read as {} because of its file extension, but looks like {}", nameOf(*readAs),
                  nameOf(*looksLike)),
      {},
      "give it the extension of its language: .H for Klartext, .I for DIN/ISO, .MPF or .SPF for a SINUMERIK",
      {}};
}

ProgramLanguage languageFor(ControlKind kind, const std::filesystem::path& path, std::string_view text) {
  const std::optional<ProgramLanguage> told = languageOf(path, text);
  if (told && speaks(kind, *told)) return *told;
  return control::isHeidenhain(kind) ? ProgramLanguage::Klartext : ProgramLanguage::Sinumerik;
}

Result<ControlKind> controlFor(const std::filesystem::path& path, std::string_view text,
                               std::optional<ControlKind> wanted, std::optional<ControlKind> setup) {
  if (text.find_first_not_of(" \t\r\n\x1a\xEF\xBB\xBF") == std::string_view::npos) {
    return fail({path.string(), 0, 0}, "the program is empty", "check that the file was saved and copied whole");
  }
  if (const std::string_view foreign = foreignLanguage(path, text); !foreign.empty()) {
    return fail({path.string(), 0, 0}, fmt::format("this looks like {}, which Probewright does not read", foreign),
                "Probewright reads programs of HEIDENHAIN (.H, .I) and SINUMERIK (.MPF, .SPF) controls; if this is one "
                "of them, give it the extension of its language");
  }
  const std::optional<ProgramLanguage> language = languageOf(path, text);
  if (wanted) {
    if (!language || speaks(*wanted, *language)) return *wanted;
    return fail({path.string(), 0, 0},
                fmt::format("this is a {} program, which the {} does not read", nameOf(*language), name(*wanted)),
                "name a control of that language with --control, or leave it out");
  }
  if (!language) {
    if (setup) return *setup;
    return fail({path.string(), 0, 0},
                "neither the file extension nor the text shows which control this program is for",
                "name it with --control TNC640, iTNC530 or 840Dsl");
  }
  if (setup) {
    if (speaks(*setup, *language)) return *setup;
    return fail({path.string(), 0, 0},
                fmt::format("this is a {} program, but the setup's control is {}", nameOf(*language), name(*setup)),
                *language == ProgramLanguage::Sinumerik
                    ? "name a setup whose [control] type is 840Dsl or 828D, or has none"
                    : "name a setup whose [control] type is TNC640 or iTNC530, or has none");
  }
  return *language == ProgramLanguage::Sinumerik ? ControlKind::Sinumerik840Dsl : ControlKind::TNC640;
}

namespace {

/// Why this cannot be the text of a program, from its beginning; nothing if it can.
std::optional<Diagnostic> whyNoText(const std::filesystem::path& path, std::string_view text,
                                    ProgramLanguage language) {
  std::string head(text.substr(0, 4096));
  const auto because = [&](std::string message, std::string advice) {
    return Diagnostic{Severity::Error, {path.string(), 0, 0}, std::move(message), {}, std::move(advice), {}};
  };
  using namespace std::string_view_literals;
  const bool utf32 = head.starts_with("\xFF\xFE\0\0"sv) || head.starts_with("\0\0\xFE\xFF"sv);
  if (utf32 || head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF")) {
    return because(fmt::format("this file is {}, which no control can read", utf32 ? "UTF-32" : "UTF-16"),
                   "save it as UTF-8 or in the code page of the control");
  }
  // Zeros after the text are what some transfers fill the last block with.
  head.erase(head.find_last_not_of('\0') + 1);
  const auto isBinary = [](unsigned char c) {
    return (c < 0x20 && c != '\t' && c != '\n' && c != '\f' && c != '\r' && c != 0x1A) || c == 0x7F;
  };
  if (language != ProgramLanguage::Sinumerik && std::ranges::any_of(head, isBinary)) {
    return because("this is not a text file: it contains control characters",
                   "give the program as plain text, as an editor shows it");
  }
  if (head.find('\n') == std::string::npos && std::ranges::count(head, '\r') > 1) {
    return because("the lines of this file end with CR alone, which no control can read",
                   "save it with LF or CR LF at the end of each line");
  }
  return std::nullopt;
}

}  // namespace

Result<std::shared_ptr<language::Program>> openProgram(const std::filesystem::path& path, std::string_view text,
                                                       ProgramLanguage language) {
  if (const auto why = whyNoText(path, text, language)) return tl::unexpected(*why);
  // A pipe gives its text only once.
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return programOf(path.string(), std::string(text), language);
  if (language == ProgramLanguage::Klartext) {
    auto program = language::klartext::KlartextProgram::open(path);
    if (!program) return tl::unexpected(program.error());
    return std::shared_ptr<language::Program>(std::move(*program));
  }
  if (language == ProgramLanguage::DinIso) {
    auto program = language::din_iso::DinIsoProgram::open(path);
    if (!program) return tl::unexpected(program.error());
    return std::shared_ptr<language::Program>(std::move(*program));
  }
  auto program = sinumerik::SinumerikProgram::open(path);
  if (!program) return tl::unexpected(program.error());
  return std::shared_ptr<language::Program>(std::move(*program));
}

std::shared_ptr<language::Program> programOf(std::string name, std::string text, ProgramLanguage language) {
  switch (language) {
    case ProgramLanguage::Klartext:
      return std::make_shared<language::klartext::KlartextProgram>(std::move(name), std::move(text));
    case ProgramLanguage::DinIso:
      return std::make_shared<language::din_iso::DinIsoProgram>(std::move(name), std::move(text));
    default:
      return sinumerik::SinumerikProgram::fromText(std::move(name), std::move(text));
  }
}

void useMacros(language::Program& program, const sinumerik::GlobalUserData& globalData) {
  if (auto* own = dynamic_cast<sinumerik::SinumerikProgram*>(&program)) own->useMacros(globalData.macros());
}

std::unique_ptr<language::ProgramLibrary> programLibrary(ControlKind kind, std::vector<std::filesystem::path> folders,
                                                         const sinumerik::GlobalUserData* globalData,
                                                         std::function<void(const std::filesystem::path&)> onOpen) {
  const bool heidenhain = control::isHeidenhain(kind);
  std::vector<std::string> endings =
      heidenhain ? std::vector<std::string>{".H", ".I"} : std::vector<std::string>{".SPF", ".MPF", ".CPF", ".CYC"};
  const auto open = [kind, globalData, onOpen = std::move(onOpen)](
                        const std::filesystem::path& path) -> Result<std::shared_ptr<language::Program>> {
    const Result<std::string> text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    auto program = openProgram(path, *text, languageFor(kind, path, {}));
    if (program && globalData != nullptr) useMacros(**program, *globalData);
    if (onOpen) onOpen(path);
    return program;
  };
  return std::make_unique<language::DirectoryLibrary>(std::move(endings), open, std::move(folders));
}

}  // namespace probewright::session

#include "session/source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>
#include <utility>

#include "base/file.hpp"
#include "base/text.hpp"
#include "language/directory_library.hpp"
#include "session/table_files.hpp"

namespace probewright::session {

using control::ControlKind;

namespace {

/// "TNC640, iTNC530 or 840Dsl".
template <class Names>
std::string anyOf(const Names& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += fmt::format("{}{}", i == 0 ? "" : i + 1 < names.size() ? ", " : " or ", names[i]);
  return list;
}

bool has(const std::vector<std::string_view>& endings, std::string_view ending) {
  return std::ranges::find(endings, ending) != endings.end();
}

/// Calls `use` for each language, those of a family together.
template <class Use>
void forEachLanguage(const ControlFamilies& families, Use use) {
  for (const ControlFamily& family : families.all()) {
    for (const LanguageEntry& entry : family.languages)
      use(entry);
  }
}

/// "HEIDENHAIN (.H, .I) and SINUMERIK (.MPF, .SPF)".
std::string familiesAndEndings(const ControlFamilies& families) {
  std::string list;
  for (const ControlFamily& family : families.all()) {
    std::vector<std::string_view> endings;
    for (const LanguageEntry& entry : family.languages)
      endings.insert(endings.end(), entry.endings.begin(), entry.endings.end());
    const bool last = &family == &families.all().back();
    list += fmt::format("{}{} ({})", list.empty() ? "" : last ? " and " : ", ", family.name, fmt::join(endings, ", "));
  }
  return list;
}

}  // namespace

std::optional<ProgramLanguage> languageOf(const std::filesystem::path& path, std::string_view text,
                                          const ControlFamilies& families) {
  const std::string ending = upperCase(path.extension().string());
  const std::string head(text.substr(0, 20000));
  std::optional<ProgramLanguage> byEnding, byText;
  forEachLanguage(families, [&](const LanguageEntry& entry) {
    if (!byEnding && (has(entry.endings, ending) || has(entry.archiveEndings, ending))) byEnding = entry.language;
  });
  if (byEnding) return byEnding;
  forEachLanguage(families, [&](const LanguageEntry& entry) {
    if (!byText && entry.looksLike(head)) byText = entry.language;
  });
  return byText;
}

/// What a text is that no control here reads, in the words of a message; empty if nothing tells.
std::string_view foreignLanguage(const std::filesystem::path& path, std::string_view text,
                                 const ControlFamilies& families) {
  const std::string head(text.substr(0, 20000));
  // Probing by G38.x, numbered parameters, O words and Fanuc program numbers, comments in parentheses, G21.
  static const std::regex rs274(
      R"((^|\n)\s*/?\s*((N\d+\s+)?(G\d+(\.\d)?\s*)*G38\.[2-9]|(N\d+\s+)?#(\d+|<[^>\n]+>)\s*=|O\s*(\d+|<[^>\n]+>)\s*(SUB|CALL|IF|WHILE|REPEAT|\(|\r?\n)|\([^\n)]*\)\s*\r?(\n|$)|[^;*"\n]*\bG21\b[^;*"\n]*(\n|$)))",
      std::regex::icase);
  const bool own = languageOf(path, {}, families).has_value();
  if (own) return {};
  if (upperCase(path.extension().string()) == ".NGC" || std::regex_search(head, rs274))
    return "an RS-274 program (LinuxCNC, Fanuc and others)";
  return {};
}

std::optional<Diagnostic> otherLanguage(const std::filesystem::path& path, std::string_view text,
                                        const ControlFamilies& families) {
  const std::optional<ProgramLanguage> readAs = languageOf(path, text, families);
  const std::optional<ProgramLanguage> looksLike = languageOf("program", text, families);
  if (!readAs || !looksLike || *readAs == *looksLike) return std::nullopt;
  std::vector<std::string> endings;
  forEachLanguage(families, [&](const LanguageEntry& entry) {
    endings.push_back(fmt::format("{} for {}", anyOf(entry.endings), entry.whose));
  });
  return Diagnostic{Severity::Note,
                    {path.string(), 0, 0},
                    fmt::format("it was read as {} because of its file extension, but looks like {}",
                                families.entry(*readAs).name, families.entry(*looksLike).name),
                    {},
                    fmt::format("give it the extension of its language: {}", fmt::join(endings, ", ")),
                    {}};
}

std::string endingsOf(const ControlFamilies& families) {
  std::vector<std::string_view> endings;
  forEachLanguage(families, [&](const LanguageEntry& entry) { endings.push_back(entry.endings.front()); });
  return anyOf(endings);
}

std::string endingsWithLanguages(const ControlFamilies& families) {
  std::vector<std::string> endings;
  forEachLanguage(families, [&](const LanguageEntry& entry) {
    endings.push_back(fmt::format("{} for {}", entry.endings.front(), entry.whose));
  });
  return anyOf(endings);
}

ProgramLanguage languageFor(ControlKind kind, const std::filesystem::path& path, std::string_view text,
                            const ControlFamilies& families) {
  const std::optional<ProgramLanguage> told = languageOf(path, text, families);
  return told && families.speaks(kind, *told) ? *told : families.of(kind).languages.front().language;
}

Result<ControlKind> controlFor(const std::filesystem::path& path, std::string_view text,
                               std::optional<ControlKind> wanted, std::optional<ControlKind> believed,
                               const ControlFamilies& families) {
  if (text.find_first_not_of(" \t\r\n\x1a\xEF\xBB\xBF") == std::string_view::npos) {
    return fail({path.string(), 0, 0}, "the program is empty", "check that the file was saved and copied whole");
  }
  if (const std::string_view foreign = foreignLanguage(path, text, families); !foreign.empty()) {
    return fail({path.string(), 0, 0}, fmt::format("this looks like {}, which Probewright does not read", foreign),
                fmt::format("Probewright reads programs of {} controls; if this is one of them, give it the extension "
                            "of its language",
                            familiesAndEndings(families)));
  }
  const std::optional<ProgramLanguage> language = languageOf(path, text, families);
  if (wanted) {
    if (!language || families.speaks(*wanted, *language)) return *wanted;
    return fail({path.string(), 0, 0},
                fmt::format("this is a {} program, which the {} does not read", families.entry(*language).name,
                            families.model(*wanted).name),
                "name a control of that language with --control, or leave it out");
  }
  if (!language) {
    if (believed) return *believed;
    std::vector<std::string_view> names;
    for (const ControlFamily& family : families.all()) {
      for (const ControlModel& model : family.controls)
        names.push_back(model.name);
    }
    return fail({path.string(), 0, 0},
                "neither the file extension nor the text shows which control this program is for",
                fmt::format("name it with --control {}", anyOf(names)));
  }
  if (believed) {
    if (families.speaks(*believed, *language)) return *believed;
    std::vector<std::string_view> names;
    for (const ControlModel& model : families.of(*language).controls) {
      names.push_back(model.name);
      names.insert(names.end(), model.alsoCalled.begin(), model.alsoCalled.end());
    }
    return fail({path.string(), 0, 0},
                fmt::format("this is a {} program, but the setup's control is {}", families.entry(*language).name,
                            families.model(*believed).name),
                fmt::format("name a setup whose [control] type is {}, or has none", anyOf(names)));
  }
  return families.of(*language).controls.front().kind;
}

namespace {

/// Why this cannot be the text of a program, from its beginning; nothing if it can.
std::optional<Diagnostic> whyNoText(const std::filesystem::path& path, std::string_view text,
                                    const LanguageEntry& language) {
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
  if (!language.holdsControlCharacters && std::ranges::any_of(head, isBinary)) {
    return because("this is not a text file: it contains control characters",
                   "give the program as plain text, as an editor shows it");
  }
  if (head.find('\n') == std::string::npos && std::ranges::count(head, '\r') > 1) {
    return because("the lines of this file end with CR alone, which no control can read",
                   "save it with LF or CR LF at the end of each line");
  }
  return std::nullopt;
}

Result<std::shared_ptr<language::Program>> openAs(const LanguageEntry& entry, const std::filesystem::path& path,
                                                  std::string_view text) {
  if (const auto why = whyNoText(path, text, entry)) return tl::unexpected(*why);
  // A pipe gives its text only once.
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return entry.fromText(path.string(), std::string(text));
  return entry.open(path);
}

}  // namespace

Result<std::shared_ptr<language::Program>> openProgram(const std::filesystem::path& path, std::string_view text,
                                                       ProgramLanguage language, const ControlFamilies& families) {
  return openAs(families.entry(language), path, text);
}

std::shared_ptr<language::Program> programOf(std::string name, std::string text, ProgramLanguage language,
                                             const ControlFamilies& families) {
  return families.entry(language).fromText(std::move(name), std::move(text));
}

std::unique_ptr<language::ProgramLibrary> programLibrary(const ControlFamily& family, OnOpen onOpen,
                                                         std::shared_ptr<language::DirectoryLibrary::Found> found) {
  const auto open = [&family, onOpen = std::move(onOpen)](
                        const std::filesystem::path& path) -> Result<std::shared_ptr<language::Program>> {
    const Result<std::string> text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    const std::string ending = upperCase(path.extension().string());
    const LanguageEntry* entry = &family.languages.front();
    for (const LanguageEntry& each : family.languages) {
      if (has(each.endings, ending) || has(each.archiveEndings, ending)) entry = &each;
    }
    auto program = openAs(*entry, path, *text);
    if (onOpen) onOpen(program ? program->get() : nullptr, path);
    return program;
  };
  auto library = std::make_unique<language::DirectoryLibrary>(family.calledEndings, open);
  library->remember(std::move(found));
  return library;
}

}  // namespace probewright::session

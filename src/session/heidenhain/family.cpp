#include "session/heidenhain/family.hpp"

#include <memory>
#include <regex>
#include <utility>

#include "base/number_text.hpp"
#include "control/heidenhain/tool_table.hpp"
#include "language/din_iso/program.hpp"
#include "language/klartext/check.hpp"
#include "language/klartext/program.hpp"
#include "session/heidenhain/beliefs.hpp"
#include "session/heidenhain/family_parts.hpp"
#include "session/setup_check.hpp"
#include "session/source.hpp"

namespace probewright::session::heidenhain {

using control::ControlKind;
using language::Program;

Diagnostics checkHeidenhain(const CheckRequest& request) {
  const ControlFamily family = heidenhainFamily();
  const auto library = programLibrary(family);
  return language::klartext::checkProgram(static_cast<language::klartext::HeidenhainProgram&>(request.program),
                                          request.control, library.get(), request.skipLevels[0], request.foresees);
}

namespace {

bool looksLikeKlartext(const std::string& head) {
  static const std::regex pattern(
      R"((^|\n)\s*(\d+\s+)?(BEGIN PGM|TCH PROBE|TOOL CALL|CYCL DEF|L [XYZ][+-]|FN ?\d+ ?:))");
  return std::regex_search(head, pattern);
}

/// Blocks that end with '*', and words that SINUMERIK has not.
bool looksLikeDinIso(const std::string& head) {
  static const std::regex pattern(
      R"((^|\n)\s*(%\S[^\n]* G7[01]\s*\*|(N\d+\s+)?(G98 ?L|D(0\d|1\d) ?Q|G[^\n;]*\*\s*(\n|$))))", std::regex::icase);
  return std::regex_search(head, pattern);
}

template <class Own>
Result<std::shared_ptr<Program>> openAs(const std::filesystem::path& path) {
  auto program = Own::open(path);
  if (!program) return tl::unexpected(program.error());
  return std::shared_ptr<Program>(std::move(*program));
}

template <class Own>
std::shared_ptr<Program> fromText(std::string name, std::string text) {
  return std::make_shared<Own>(std::move(name), std::move(text));
}

Inventory inventoryOf(const control::Beliefs& beliefs, ControlKind kind, Diagnostics& diagnostics) {
  const auto tables = std::make_shared<const control::heidenhain::Tables>(heidenhainTables(beliefs, kind, diagnostics));
  Listing tools, presets;
  for (const std::string& row : tables->tools.table().keys()) {
    if (row != "0") tools.add(row, tables->tools.text(row, "NAME"));
  }
  const auto documented = [tables](const std::string& row) {
    return tables->presets.hasColumn("DOC") ? tables->presets.text(row, "DOC") : std::string();
  };
  for (const std::string& row : tables->presets.table().keys())
    presets.add(row, documented(row));
  Inventory inventory;
  inventory.tools = tools.text();
  inventory.presets = presets.text();
  inventory.hasTool = [tables](const NamedItem& tool) {
    if (!tool.name.empty()) return control::heidenhain::findToolNamed(tables->tools, tool.name).has_value();
    return tool.number == 0 || tables->tools.hasRow(formatShortest(tool.number));
  };
  inventory.holdsTool = [tables, owned = beliefs.tools](const NamedItem& tool) {
    const auto row = tool.name.empty() ? formatShortest(tool.number)
                                       : control::heidenhain::findToolNamed(tables->tools, tool.name).value_or("");
    const auto number = static_cast<int>(parseDecimal(row).value_or(0));
    return owned.empty() || number == 0 || holdsTool(owned, number, tables->tools.text(row, "NAME"));
  };
  inventory.hasPreset = [tables, documented](const NamedItem& row) {
    if (row.name.empty()) return tables->presets.hasRow(formatShortest(row.number));
    for (const std::string& key : tables->presets.table().keys()) {
      if (documented(key) == row.name) return true;
    }
    return false;
  };
  inventory.toolSteps = true;
  inventory.monitoredTool = 330;  // Q330 of the inspection cycles
  inventory.cycleWord = "TCH PROBE";
  return inventory;
}

}  // namespace

ControlFamily heidenhainFamily() {
  using language::din_iso::DinIsoProgram;
  using language::klartext::KlartextProgram;
  ControlFamily family;
  family.name = "HEIDENHAIN";
  family.controls = {
      {.kind = ControlKind::TNC640, .name = name(ControlKind::TNC640), .alsoCalled = {}, .alsoUnderstood = {}},
      {.kind = ControlKind::iTNC530, .name = name(ControlKind::iTNC530), .alsoCalled = {}, .alsoUnderstood = {}}};
  family.languages = {{.language = ProgramLanguage::Klartext,
                       .name = "Klartext",
                       .whose = "Klartext",
                       .endings = {".H"},
                       .archiveEndings = {},
                       .looksLike = looksLikeKlartext,
                       .open = openAs<KlartextProgram>,
                       .fromText = fromText<KlartextProgram>},
                      {.language = ProgramLanguage::DinIso,
                       .name = "DIN/ISO",
                       .whose = "DIN/ISO",
                       .endings = {".I"},
                       .archiveEndings = {},
                       .looksLike = looksLikeDinIso,
                       .open = openAs<DinIsoProgram>,
                       .fromText = fromText<DinIsoProgram>}};
  family.calledEndings = {".H", ".I"};
  family.dialogLanguages = {control::allDialogLanguages.begin(), control::allDialogLanguages.end()};
  family.hasPresets = true;
  family.startsAtLines = true;
  family.cycles = cycles::cyclesOf;
  family.check = checkHeidenhain;
  family.inventory = inventoryOf;
  family.cycleTemplate = klartextTemplate;
  family.prepare = prepareHeidenhain;
  return family;
}

}  // namespace probewright::session::heidenhain

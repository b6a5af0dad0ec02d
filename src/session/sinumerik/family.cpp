#include "session/sinumerik/family.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <regex>
#include <set>
#include <utility>

#include "control/sinumerik/tool_data.hpp"
#include "conversion/convert.hpp"
#include "cycles/sinumerik/circle_through_points.hpp"
#include "cycles/sinumerik/registry.hpp"
#include "cycles/sinumerik/rotation_offset.hpp"
#include "execution/sinumerik/global_data.hpp"
#include "language/sinumerik/check.hpp"
#include "language/sinumerik/program.hpp"
#include "session/setup_check.hpp"
#include "session/sinumerik/beliefs.hpp"
#include "session/sinumerik/family_parts.hpp"
#include "session/sinumerik/global_data.hpp"
#include "session/source.hpp"

namespace probewright::session::sinumerik {

using control::ControlKind;
using language::Program;

void useMacros(Program& program, const execution::sinumerik::GlobalUserData& globalData) {
  if (auto* own = dynamic_cast<language::sinumerik::SinumerikProgram*>(&program)) own->useMacros(globalData.macros());
}

Diagnostics checkSinumerik(const CheckRequest& request, const execution::sinumerik::GlobalUserData& globalData) {
  useMacros(request.program, globalData);
  const ControlFamily family = sinumerikFamily();
  const auto library = programLibrary(family, [&](Program* opened, const std::filesystem::path&) {
    if (opened != nullptr) useMacros(*opened, globalData);
  });
  return language::sinumerik::check(
      static_cast<language::sinumerik::SinumerikProgram&>(request.program),
      {.library = library.get(),
       .globalVariables = request.beliefs != nullptr ? namesOfData(*request.beliefs) : std::set<std::string>(),
       .skipLevels = request.skipLevels,
       .globalData = globalData.declarations(),
       .onMill = request.machine != nullptr && !request.machine->mainSpindle,
       .foresees = request.foresees});
}

namespace {

bool looksLikeSinumerik(const std::string& head) {
  static const std::regex pattern(
      R"((^|\n)\s*(%_N_|(N\d+\s+)?(CYCLE\d+\s*\(|G\d+\s|PROC\s|DEF\s|R\d+\s*=|M30|M17|T="|;\$PATH)))",
      std::regex::icase);
  return std::regex_search(head, pattern);
}

Result<std::shared_ptr<Program>> open(const std::filesystem::path& path) {
  auto program = language::sinumerik::SinumerikProgram::open(path);
  if (!program) return tl::unexpected(program.error());
  return std::shared_ptr<Program>(std::move(*program));
}

std::shared_ptr<Program> fromText(std::string name, std::string text) {
  return language::sinumerik::SinumerikProgram::fromText(std::move(name), std::move(text));
}

Diagnostics check(const CheckRequest& request) {
  if (request.path.empty()) return checkSinumerik(request, {});
  Diagnostics found;
  const execution::sinumerik::GlobalUserData globalData = globalUserData(
      request.path, request.beliefs != nullptr ? request.beliefs->tables : std::filesystem::path(), found);
  const Diagnostics more = checkSinumerik(request, globalData);
  found.insert(found.end(), more.begin(), more.end());
  return found;
}

/// The measuring cycles, and the one that computes with their results.
std::vector<const cycles::CycleDefinition*> cyclesOf(ControlKind kind) {
  std::vector<const cycles::CycleDefinition*> all = cycles::cyclesOf(kind);
  all.insert(all.begin(), &cycles::sinumerik::cycle116Definition);
  return all;
}

Inventory inventoryOf(const control::Beliefs& beliefs, ControlKind, Diagnostics& diagnostics) {
  const auto data = std::make_shared<const SinumerikData>(sinumerikData(beliefs, diagnostics));
  Listing tools;
  for (const control::BelievedTool& tool : beliefs.tools)
    tools.add(std::to_string(tool.number), tool.name);
  Inventory inventory;
  inventory.tools = tools.text();
  inventory.hasTool = [data](const NamedItem& tool) {
    using namespace control::sinumerik;
    if (!tool.name.empty()) return tool.name == "0" || toolNamed(data->store, tool.name).has_value();
    return tool.number == 0 || toolEdge(data->store, static_cast<int>(std::lround(tool.number)), 1).has_value();
  };
  inventory.holdsTool = [data, owned = beliefs.tools](const NamedItem& tool) {
    using namespace control::sinumerik;
    const int number =
        tool.name.empty() ? static_cast<int>(std::lround(tool.number)) : toolNamed(data->store, tool.name).value_or(0);
    return owned.empty() || number == 0 || holdsTool(owned, number, toolName(data->store, number));
  };
  inventory.hasPreset = [](const NamedItem&) { return true; };
  inventory.correctedTool = [](std::string_view name, const auto& number) -> std::optional<std::uint32_t> {
    const cycles::sinumerik::Entry* entry = cycles::sinumerik::findEntry(name);
    if (entry == nullptr) return std::nullopt;
    const auto place = [&](std::string_view parameter) -> std::optional<std::uint32_t> {
      const auto found = std::ranges::find(entry->definition.parameters, parameter, &cycles::Parameter::name);
      if (found == entry->definition.parameters.end()) return std::nullopt;
      return found->address;
    };
    const auto tool = place("S_TNAME"), edge = place("S_KNUM1"), kind = place("S_MVAR");
    if (!tool || !edge || !kind) return std::nullopt;
    const auto variant = number(*kind), target = number(*edge);
    // The hundreds of S_MVAR ask for a correction of a tool, S_KNUM1 says which of its data.
    const bool corrects = variant && target && *target != 0 && static_cast<long>(std::abs(*variant)) / 100 % 10 == 2;
    return corrects ? tool : std::nullopt;
  };
  for (const control::sinumerik::DataKey& key : data->store.keys("$TC_CARR34")) {
    const auto value = data->store.get(key);
    const auto* name = value ? std::get_if<std::string>(&*value) : nullptr;
    control::sinumerik::DataKey kind = key;
    kind.name = "$TC_CARR23";
    const bool whole = data->store.isSet(kind);  // else that of the machine takes its place
    if (whole && name != nullptr && !name->empty()) inventory.swivelData.push_back(*name);
  }
  constexpr const char* offset = "$SNS_MEA_T_PROBE_OFFSET";
  if (const std::string wrong = cycles::sinumerik::rotationOffsetComplaint(data->store.number(offset, {}));
      !wrong.empty()) {
    const auto set = beliefs.parameters.find(offset);
    const SourcePlace place = set == beliefs.parameters.end() ? SourcePlace{beliefs.file} : set->second.place;
    diagnostics.push_back(
        {Severity::Warning, place, wrong, {}, std::string(cycles::sinumerik::rotationOffsetAdvice), {}});
  }
  return inventory;
}

void tellConversion(const std::filesystem::path& path, const control::Beliefs* beliefs,
                    conversion::ConvertOptions& options, Diagnostics& diagnostics) {
  const auto declared =
      globalUserData(path, beliefs == nullptr ? std::filesystem::path() : beliefs->tables, diagnostics);
  options.globalData = std::make_shared<const conversion::GlobalData>(
      beliefs == nullptr ? declared.variables({}, diagnostics)
                         : declared.variables(sinumerikData(*beliefs, diagnostics).store, diagnostics));
}

}  // namespace

ControlFamily sinumerikFamily() {
  ControlFamily family;
  family.name = "SINUMERIK";
  family.controls = {{.kind = ControlKind::Sinumerik840Dsl,
                      .name = name(ControlKind::Sinumerik840Dsl),
                      .alsoCalled = {"828D"},  // measures as the 840D sl does
                      .alsoUnderstood = {"840d", "sinumerik"}}};
  family.languages = {{.language = ProgramLanguage::Sinumerik,
                       .name = "SINUMERIK",
                       .whose = "a SINUMERIK",
                       .endings = {".MPF", ".SPF"},
                       .archiveEndings = {".ARC"},
                       .looksLike = looksLikeSinumerik,
                       .holdsControlCharacters = true,
                       .open = open,
                       .fromText = fromText}};
  family.calledEndings = {".SPF", ".MPF", ".CPF", ".CYC"};
  family.dialogLanguages = {control::allDialogLanguages.begin(), control::allDialogLanguages.end()};
  family.hasZeroOffsets = true;
  family.hasProgramModes = true;
  family.startsAtLines = true;
  family.cycles = cyclesOf;
  family.check = check;
  family.inventory = inventoryOf;
  family.cycleTemplate = sinumerikTemplate;
  family.tellConversion = tellConversion;
  family.prepare = prepareSinumerik;
  return family;
}

}  // namespace probewright::session::sinumerik

#include "cycles/main_results.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include "base/number_text.hpp"
#include "cycles/catalogue.hpp"

namespace probewright::cycles {

namespace {

using control::CycleRecord;
using control::ResultRecord;
using Names = std::span<const std::string_view>;

constexpr std::size_t mostOfUnknownCycle = 6;

constexpr std::string_view touchPosition[] = {"Q115", "Q116", "Q117"};
constexpr std::string_view angle[] = {"Q150"};
constexpr std::string_view circle[] = {"Q151", "Q152", "Q153"};
constexpr std::string_view rectangle[] = {"Q151", "Q152", "Q154", "Q155"};
constexpr std::string_view corner[] = {"Q151", "Q152"};
constexpr std::string_view presetWidth[] = {"Q166", "Q157"};
constexpr std::string_view width[] = {"Q156", "Q157"};
constexpr std::string_view coordinate[] = {"Q160"};
constexpr std::string_view plane[] = {"Q158", "Q159", "Q170", "Q171", "Q172"};
constexpr std::string_view axisShift[] = {"Q185", "Q186", "Q187"};
constexpr std::string_view point[] = {"Q151", "Q152", "Q153", "Q164"};
constexpr std::string_view edgeRotation[] = {"Q964", "Q994"};
constexpr std::string_view circlesRotation[] = {"Q964", "Q994", "Q966", "Q967"};
constexpr std::string_view planeRotation[] = {"Q961", "Q962", "Q963"};
constexpr std::string_view rightCorner[] = {"_OVR[4]", "_OVR[5]", "_OVR[6]"};
constexpr std::string_view ballAndPosition[] = {"_OVR[4]", "_OVR[20]", "_OVR[21]", "_OVR[22]"};
constexpr std::string_view triggerPoints[] = {"_OVR[8]", "_OVR[10]", "_OVR[12]", "_OVR[14]", "_OVR[16]", "_OVR[18]"};
constexpr std::string_view measuringAxis[] = {"_OVR[4]"};
constexpr std::string_view sizeAndCentre[] = {"_OVR[4]", "_OVR[5]", "_OVR[6]", "_OVR[7]"};
constexpr std::string_view spindle[] = {"_OVR[2]", "_OVR[3]", "_OVR[7]", "_OVR[8]"};
constexpr std::string_view balls[] = {"_OVR[4]",  "_OVR[5]",  "_OVR[6]",  "_OVR[7]",  "_OVR[12]", "_OVR[13]",
                                      "_OVR[14]", "_OVR[15]", "_OVR[20]", "_OVR[21]", "_OVR[22]", "_OVR[23]"};
constexpr std::string_view angles[] = {"_OVR[4]", "_OVR[5]"};

struct Entry {
  std::string_view cycle;
  Names first;
  Names otherwise = {};  ///< where none of the first is left
};

constexpr Entry entries[] = {
    {"1", touchPosition},
    {"403", angle},
    {"405", angle},
    {"408", presetWidth},
    {"409", presetWidth},
    {"410", rectangle},
    {"411", rectangle},
    {"412", circle},
    {"413", circle},
    {"414", corner},
    {"415", corner},
    {"416", circle},
    {"417", coordinate},
    {"418", corner},
    {"420", angle},
    {"421", circle},
    {"422", circle},
    {"423", rectangle},
    {"424", rectangle},
    {"425", width},
    {"426", width},
    {"427", coordinate},
    {"430", circle},
    {"431", plane},
    {"440", axisShift},
    {"444", point},
    {"1410", edgeRotation},
    {"1411", circlesRotation},
    {"1420", planeRotation},
    {"CYCLE961", rightCorner},
    {"CYCLE973", ballAndPosition, triggerPoints},
    {"CYCLE974", measuringAxis},
    {"CYCLE976", ballAndPosition, triggerPoints},
    {"CYCLE977", sizeAndCentre},
    {"CYCLE978", measuringAxis},
    {"CYCLE979", sizeAndCentre},
    {"CYCLE994", measuringAxis},
    {"CYCLE995", spindle},
    {"CYCLE997", balls},
    {"CYCLE998", angles},
};

bool holds(Names names, std::string_view name) { return std::ranges::find(names, name) != names.end(); }

const CycleDefinition* definitionOf(std::string_view name) {
  if (const auto number = parseInteger(name)) return heidenhainCycle(static_cast<int>(*number));
  return sinumerikCycle(name);
}

}  // namespace

std::vector<bool> mainResults(const CycleRecord& cycle) {
  std::vector<bool> isMain(cycle.results.size(), false);
  const CycleDefinition* definition = definitionOf(cycle.name);
  const auto entry = std::ranges::find(entries, cycle.name, &Entry::cycle);
  const auto mark = [&](Names names) {
    bool any = false;
    for (std::size_t i = 0; i < isMain.size(); ++i) {
      if (!holds(names, cycle.results[i].name)) continue;
      isMain[i] = true;
      any = true;
    }
    return any;
  };
  if (entry != std::end(entries) && !mark(entry->first)) mark(entry->otherwise);
  for (std::size_t i = 0; i < isMain.size(); ++i) {
    const ResultRecord& result = cycle.results[i];
    const bool ofTheControl = result.name.starts_with("_OV");
    const bool listed =
        definition != nullptr &&
        std::ranges::find(definition->results, result.name, &ResultDefinition::name) != definition->results.end();
    const bool chosen = definition != nullptr ? !listed && !ofTheControl : i < mostOfUnknownCycle;
    if (chosen || result.verdict != control::Verdict::None) isMain[i] = true;
  }
  return isMain;
}

}  // namespace probewright::cycles

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "cycle_search.hpp"
#include "cycles/catalogue.hpp"
#include "records/results.hpp"
#include "session/control_family.hpp"
#include "terminal.hpp"
#include "words/cycle_words.hpp"
#include "words/words.hpp"

namespace probewright::app {
namespace {

using control::ControlKind;
using control::DialogLanguage;
using cycles::CycleDefinition;
using cycles::Parameter;
using cycles::ValueKind;

std::string controlsText(control::ControlSet controls) {
  std::string text;
  for (const ControlKind kind : control::allControlKinds) {
    if (!controls.contains(kind)) continue;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", control::name(kind));
  }
  return text;
}

/// Whether the decimal digits have meanings of their own.
bool isCode(const Parameter& parameter) {
  return !parameter.digits.empty() && !parameter.digits.front().meaning.empty();
}

std::string rangeText(const Parameter& parameter, DialogLanguage language) {
  switch (parameter.kind) {
    case ValueKind::Text:
      return words::ofCatalogue(language, "text");
    case ValueKind::Option:
      return words::ofCatalogue(language, "option");
    default:
      break;
  }
  if (!parameter.digits.empty()) {
    const cycles::CodeDigit& first = parameter.digits.front();
    return isCode(parameter) ? words::ofCatalogue(language, "coded")
                             : words::ofCatalogue(language, "{0} to {1}", {"0", std::to_string(first.most)});
  }
  std::string text = words::ofCatalogue(language, "{0} to {1}",
                                        {formatShortest(parameter.minimum), formatShortest(parameter.maximum)});
  const std::string_view unit = cycles::unitOf(parameter.kind);
  if (!unit.empty()) text += fmt::format(" {}", unit);
  const control::ControlSet worded = {static_cast<std::uint8_t>(parameter.feedWords.bits & parameter.controls.bits)};
  if (worded.bits != 0) text += " " + words::ofCatalogue(language, "or FMAX, FAUTO");
  if (const auto without = parameter.controls.bits & control::onBothTNC.bits & ~worded.bits;
      worded.bits != 0 && without)
    text += fmt::format(" ({})", words::ofCatalogue(language, "{0} only", {controlsText(worded)}));
  if (parameter.kind == ValueKind::NumberOrText) text += " " + words::ofCatalogue(language, "or a text");
  return text;
}

/// Which measuring variants leave a result: " (S_MVAR ...5, ...6)"; nothing if all do.
std::string variantsText(const cycles::ResultDefinition& result) {
  std::string text;
  for (int units = 0; result.variants != 0 && units < 10; ++units) {
    if (result.belongsTo(units)) text += fmt::format("{}...{}", text.empty() ? " (S_MVAR " : ", ", units);
  }
  return text.empty() ? text : text + ")";
}

template <class... Values>
void say(fmt::format_string<Values...> layout, Values&&... values) {
  put(fmt::format(layout, std::forward<Values>(values)...), stdout);
}

/// The NC software of the iTNC 530 that brought a parameter.
std::string softwareText(const Parameter& parameter) { return fmt::format("340 49x-{:02}", parameter.iTNC530Software); }

/// What controls take that take less than the others: "; iTNC530: 3 to 4".
std::string narrowerText(const Parameter& parameter, DialogLanguage language) {
  std::string text;
  for (const ControlKind kind : control::allControlKinds)
    if (parameter.narrower.controls.contains(kind))
      text += fmt::format("; {}: {}", control::name(kind), rangeText(parameter.on(kind), language));
  return text;
}

/// With `control`, what that one has, and in its ranges.
void show(const CycleDefinition& cycle, DialogLanguage language, std::optional<ControlKind> control) {
  std::size_t width = 8;
  for (const Parameter& parameter : cycle.parameters)
    width = std::max(width, parameter.name.size());
  for (const auto& result : cycle.results)
    width = std::max(width, result.name.size());
  say("{}  {}\n", cycle.name, words::phrase(language, cycle.title));
  const auto says = [&](std::string_view english) { return words::ofCatalogue(language, english); };
  say("{} | {}\n\n{}\n\n{}\n", says(cycles::nameOf(cycle.family)), controlsText(cycle.controls), says(cycle.summary),
      says("Parameters"));
  for (const Parameter& each : cycle.parameters) {
    if (control && !each.controls.contains(*control)) continue;
    const Parameter parameter = control ? each.on(*control) : each;
    say("  {:<{}} {}\n", parameter.name, width, says(parameter.meaning));
    std::string line = rangeText(parameter, language);
    if (!control) line += narrowerText(parameter, language);
    if (parameter.standard) {
      line += "; " + words::ofCatalogue(language, "default {0}", {formatShortest(*parameter.standard)});
    }
    if (parameter.predefinable) line += "; PREDEF";
    control::ControlSet here = parameter.controls;
    here.bits = static_cast<std::uint8_t>(here.bits & cycle.controls.bits);
    if (!control && here.bits != cycle.controls.bits)
      line += "; " + words::ofCatalogue(language, "{0} only", {controlsText(here)});
    if (parameter.iTNC530Software > 0)
      line += "; " + words::ofCatalogue(language, "iTNC530 from {0} on", {softwareText(parameter)});
    say("  {:<{}} {}\n", "", width, line);
    for (const cycles::Choice& choice : parameter.choices) {
      if (!control || choice.controls.contains(*control))
        say("  {:<{}}   {:>3}  {}\n", "", width, choice.value, says(choice.meaning));
    }
    for (const cycles::CodeDigit& digit : isCode(parameter) ? parameter.digits : std::span<const cycles::CodeDigit>()) {
      const std::string last = says(cycles::placeName(digit.place));
      const std::string place =
          digit.width == 1 ? last
                           : words::ofCatalogue(language, "{0} to {1}",
                                                {last, says(cycles::placeName(digit.place + digit.width - 1))});
      say("  {:<{}}   {}: {}\n", "", width, place, says(digit.meaning));
      for (const cycles::Choice& choice : digit.choices)
        say("  {:<{}}   {:>3}  {}\n", "", width, choice.value, says(choice.meaning));
    }
  }
  if (cycle.results.empty()) return;
  say("\n{}\n", says("Results"));
  for (const auto& result : cycle.results) {
    const std::string_view unit = cycles::unitOf(result.valueKind());
    say("  {:<{}} {}{}{}\n", result.name, width, words::meaning(language, result.kind, result.meaning.whole()),
        unit.empty() ? "" : fmt::format(", {}", unit), variantsText(result));
  }
}

nlohmann::ordered_json namesOf(control::ControlSet controls) {
  auto names = nlohmann::ordered_json::array();
  for (const ControlKind kind : control::allControlKinds) {
    if (controls.contains(kind)) names.push_back(control::name(kind));
  }
  return names;
}

/// Of a cycle that these controls have. A choice that only some of them know names these.
nlohmann::ordered_json toJson(std::span<const cycles::Choice> choices, control::ControlSet controls) {
  auto list = nlohmann::ordered_json::array();
  for (const cycles::Choice& choice : choices) {
    const control::ControlSet here = {static_cast<std::uint8_t>(choice.controls.bits & controls.bits)};
    if (here.bits == 0) continue;
    list.push_back({{"value", choice.value}, {"meaning", choice.meaning}});
    if (here.bits != controls.bits) list.back()["controls"] = namesOf(here);
  }
  return list;
}

/// The decimal digits of a coded number: the place of the last one from the right, from 1, and how many there are.
nlohmann::ordered_json toJson(std::span<const cycles::CodeDigit> digits, control::ControlSet controls) {
  auto list = nlohmann::ordered_json::array();
  for (const cycles::CodeDigit& digit : digits) {
    nlohmann::ordered_json entry = {{"place", digit.place}, {"width", digit.width}, {"meaning", digit.meaning}};
    if (!digit.choices.empty()) entry["choices"] = toJson(digit.choices, controls);
    list.push_back(std::move(entry));
  }
  return list;
}

/// What a value can be, by the kind of the parameter.
void putRange(const Parameter& parameter, control::ControlSet controls, nlohmann::ordered_json& entry) {
  if (parameter.kind == ValueKind::Option) {
    entry["choices"] = toJson(parameter.choices, controls);
  } else if (isCode(parameter)) {
    entry["digits"] = toJson(parameter.digits, controls);
  } else if (!parameter.digits.empty()) {
    entry["minimum"] = 0;
    entry["maximum"] = parameter.digits.front().most;
  } else if (parameter.kind != ValueKind::Text) {
    entry["minimum"] = parameter.minimum;
    entry["maximum"] = parameter.maximum;
  }
  entry["text"] = parameter.kind == ValueKind::Text || parameter.kind == ValueKind::NumberOrText;
}

/// With `control`, what that one has, and in its ranges.
nlohmann::ordered_json toJson(const CycleDefinition& cycle, std::optional<ControlKind> control) {
  const control::ControlSet controls = control ? control::ControlSet::of(*control) : cycle.controls;
  nlohmann::ordered_json object = {{"name", cycle.name},
                                   {"number", cycle.number},
                                   {"title", cycle.title},
                                   {"family", cycles::nameOf(cycle.family)},
                                   {"controls", namesOf(cycle.controls)},
                                   {"summary", cycle.summary},
                                   {"parameters", nlohmann::ordered_json::array()},
                                   {"results", nlohmann::ordered_json::array()}};
  for (const Parameter& each : cycle.parameters) {
    if (control && !each.controls.contains(*control)) continue;
    const Parameter parameter = control ? each.on(*control) : each;
    nlohmann::ordered_json entry = {
        {"name", parameter.name},
        {"meaning", parameter.meaning},
        {"unit", cycles::unitOf(parameter.kind)},
        {"required", parameter.required()},
        {"controls", namesOf({static_cast<std::uint8_t>(each.controls.bits & cycle.controls.bits)})}};
    putRange(parameter, controls, entry);
    for (const ControlKind kind : control::allControlKinds) {
      if (control || !parameter.narrower.controls.contains(kind)) continue;
      putRange(parameter.on(kind), controls, entry["on"][std::string(control::name(kind))]);
    }
    for (const ControlKind kind : control::allControlKinds)
      if (parameter.feedWords.contains(kind) && controls.contains(kind))
        entry["feed_words"].push_back(control::name(kind));
    if (parameter.predefinable) entry["predef"] = true;
    if (parameter.standard) entry["default"] = *parameter.standard;
    if (parameter.iTNC530Software > 0) entry["iTNC530_from"] = softwareText(parameter);
    object["parameters"].push_back(std::move(entry));
  }
  for (const auto& result : cycle.results) {
    nlohmann::ordered_json entry = {
        {"name", result.name},
        {"meaning", result.meaning.whole()},
        {"unit", cycles::unitOf(result.valueKind())},
        {"role", control::nameOf(result.kind.role)},
        {"characteristic", records::characteristicJson(result.kind.of, std::string(result.meaning.label))},
        {"main", result.kind.rank == control::Rank::Main}};
    for (int units = 0; result.variants != 0 && units < 10; ++units)
      if (result.belongsTo(units)) entry["variants"].push_back(units);
    object["results"].push_back(std::move(entry));
  }
  return object;
}

/// "CYCLE 977", "cycle977", "Cycle_977" all ask for CYCLE977; "TCH PROBE 421" and "CYCL DEF 421" for 421.
std::string plainName(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (isLetter(c) || isDigit(c)) plain += upper(c);
  }
  for (const std::string_view words : {"TCHPROBE", "TCH", "CYCLDEF"}) {
    if (plain.starts_with(words)) plain.erase(0, words.size());
  }
  return plain;
}

/// One row of the list of all cycles.
std::string row(const CycleDefinition& cycle, DialogLanguage language) {
  return fmt::format("{:<11}{:<64}{:<24}{}\n", cycle.name, words::phrase(language, cycle.title),
                     words::ofCatalogue(language, cycles::nameOf(cycle.family)), controlsText(cycle.controls));
}

}  // namespace

int cycles(const CyclesArguments& arguments) {
  if (arguments.asTemplate && arguments.name.empty()) {
    std::fputs("probewright: --template needs the name of a cycle, such as `probewright cycles 421 --template`\n",
               stderr);
    return 2;
  }
  std::vector<ControlKind> kinds(control::allControlKinds.begin(), control::allControlKinds.end());
  if (arguments.control) kinds = {*arguments.control};
  std::vector<const CycleDefinition*> known, found;
  std::vector<ControlKind> controls;  // of each of `known`, the first that has it
  for (const ControlKind kind : kinds) {
    for (const CycleDefinition* cycle : session::knownFamilies().of(kind).cycles(kind)) {
      if (std::ranges::find(known, cycle) != known.end()) continue;
      known.push_back(cycle);
      controls.push_back(kind);
    }
  }
  const std::string name = plainName(arguments.name);
  for (const CycleDefinition* cycle : known)
    if (arguments.name.empty() || name == cycle->name || name == std::to_string(cycle->number)) found.push_back(cycle);
  const bool named = !arguments.name.empty() && !found.empty();
  if (found.empty() && !arguments.asTemplate) found = cyclesAbout(arguments.name, known);
  if (found.empty()) {
    std::fputs(fmt::format("probewright: there is no cycle {}, and none has it in its title, summary or parameters; "
                           "`probewright cycles` lists them all\n",
                           printable(arguments.name))
                   .c_str(),
               stderr);
    return 2;
  }
  const DialogLanguage language = control::dialogLanguageOf(arguments.language).value_or(DialogLanguage::English);
  auto list = nlohmann::ordered_json::array();
  for (const CycleDefinition* cycle : found) {
    if (arguments.asJson) {
      list.push_back(toJson(*cycle, arguments.control));
    } else if (!named) {
      say("{}", row(*cycle, language));
    } else if (arguments.asTemplate) {
      const ControlKind kind = controls[static_cast<std::size_t>(std::ranges::find(known, cycle) - known.begin())];
      say("{}", session::knownFamilies().of(kind).cycleTemplate(*cycle, kind, language));
    } else {
      show(*cycle, language, arguments.control);
    }
  }
  if (arguments.asJson) put(list.dump(2) + "\n", stdout);
  return 0;
}

}  // namespace probewright::app

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/number_text.hpp"
#include "commands.hpp"
#include "cycles/catalogue.hpp"

namespace probewright::app {
namespace {

using control::ControlKind;
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

std::string rangeText(const Parameter& parameter) {
  switch (parameter.kind) {
    case ValueKind::Text:
      return "text";
    case ValueKind::Option: {
      return "option";
    }
    default:
      break;
  }
  std::string text = fmt::format("{} to {}", formatShortest(parameter.minimum), formatShortest(parameter.maximum));
  const std::string_view unit = cycles::unitOf(parameter.kind);
  if (!unit.empty()) text += fmt::format(" {}", unit);
  if (parameter.kind == ValueKind::NumberOrText) text += " or a text";
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

void show(const CycleDefinition& cycle) {
  fmt::print("{}  {}\n", cycle.name, cycle.title);
  fmt::print("{} | {}\n\n{}\n\nParameters\n", cycles::nameOf(cycle.family), controlsText(cycle.controls),
             cycle.summary);
  for (const Parameter& parameter : cycle.parameters) {
    fmt::print("  {:<9}{}\n", parameter.name, parameter.meaning);
    std::string line = rangeText(parameter);
    if (parameter.standard) line += fmt::format("; default {}", formatShortest(*parameter.standard));
    if (parameter.predefinable) line += "; PREDEF";
    control::ControlSet here = parameter.controls;
    here.bits = static_cast<std::uint8_t>(here.bits & cycle.controls.bits);
    if (here.bits != cycle.controls.bits) line += fmt::format("; {} only", controlsText(here));
    fmt::print("           {}\n", line);
    for (const cycles::Choice& choice : parameter.choices) {
      fmt::print("             {:>3}  {}\n", choice.value, choice.meaning);
    }
  }
  if (cycle.results.empty()) return;
  fmt::print("\nResults\n");
  for (const auto& result : cycle.results) {
    const std::string_view unit = cycles::unitOf(result.kind);
    fmt::print("  {:<9}{}{}{}\n", result.name, result.meaning, unit.empty() ? "" : fmt::format(", {}", unit),
               variantsText(result));
  }
}

nlohmann::ordered_json namesOf(control::ControlSet controls) {
  auto names = nlohmann::ordered_json::array();
  for (const ControlKind kind : control::allControlKinds) {
    if (controls.contains(kind)) names.push_back(control::name(kind));
  }
  return names;
}

nlohmann::ordered_json toJson(const CycleDefinition& cycle) {
  nlohmann::ordered_json object = {{"name", cycle.name},
                                   {"number", cycle.number},
                                   {"title", cycle.title},
                                   {"family", cycles::nameOf(cycle.family)},
                                   {"controls", namesOf(cycle.controls)},
                                   {"summary", cycle.summary},
                                   {"parameters", nlohmann::ordered_json::array()},
                                   {"results", nlohmann::ordered_json::array()}};
  for (const Parameter& parameter : cycle.parameters) {
    nlohmann::ordered_json entry = {
        {"name", parameter.name},
        {"meaning", parameter.meaning},
        {"unit", cycles::unitOf(parameter.kind)},
        {"required", parameter.required()},
        {"controls", namesOf({static_cast<std::uint8_t>(parameter.controls.bits & cycle.controls.bits)})}};
    if (parameter.kind == ValueKind::Option) {
      entry["choices"] = nlohmann::ordered_json::array();
      for (const cycles::Choice& choice : parameter.choices)
        entry["choices"].push_back({{"value", choice.value}, {"meaning", choice.meaning}});
    } else if (parameter.kind != ValueKind::Text) {
      entry["minimum"] = parameter.minimum;
      entry["maximum"] = parameter.maximum;
    }
    if (parameter.standard) entry["default"] = *parameter.standard;
    object["parameters"].push_back(std::move(entry));
  }
  for (const auto& result : cycle.results) {
    object["results"].push_back(
        {{"name", result.name}, {"meaning", result.meaning}, {"unit", cycles::unitOf(result.kind)}});
  }
  return object;
}

bool sameName(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

int cycles(const CyclesArguments& arguments) {
  std::vector<ControlKind> kinds(control::allControlKinds.begin(), control::allControlKinds.end());
  if (arguments.control) kinds = {*arguments.control};
  bool found = false;
  auto list = nlohmann::ordered_json::array();
  std::vector<const CycleDefinition*> seen;
  for (const ControlKind kind : kinds) {
    for (const CycleDefinition* cycle : cycles::cyclesOf(kind)) {
      if (std::ranges::find(seen, cycle) != seen.end()) continue;
      seen.push_back(cycle);
      const bool wanted = arguments.name.empty() || sameName(arguments.name, cycle->name) ||
                          sameName(arguments.name, std::to_string(cycle->number));
      if (!wanted) continue;
      found = true;
      if (arguments.asJson) {
        list.push_back(toJson(*cycle));
      } else if (arguments.name.empty()) {
        fmt::print("{:<11}{:<64}{:<24}{}\n", cycle->name, cycle->title, cycles::nameOf(cycle->family),
                   controlsText(cycle->controls));
      } else {
        show(*cycle);
      }
    }
  }
  if (found && arguments.asJson) fmt::print("{}\n", list.dump(2));
  if (found) return 0;
  std::fputs(
      fmt::format("probewright: there is no cycle {}; `probewright cycles` lists them all\n", arguments.name).c_str(),
      stderr);
  return 2;
}

}  // namespace probewright::app

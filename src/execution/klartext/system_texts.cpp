#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "base/utc.hpp"
#include "control/alarm.hpp"
#include "execution/klartext/protocol_mask.hpp"
#include "execution/klartext/system_texts.hpp"
#include "language/klartext/lexer.hpp"

/// SYSSTR and CFGREAD: data of the control as texts.
namespace probewright::execution::klartext {

using control::Alarm;

namespace {

/// SYSSTR ID10321: the formats that the control numbers from 0; in strftime's words, with %-d and the like for numbers
/// without a leading zero.
constexpr std::array<const char*, 21> dateFormats = {"%d.%m.%Y %H:%M:%S",
                                                     "%-d.%m.%Y %-H:%M:%S",
                                                     "%-d.%m.%Y %-H:%M",
                                                     "%-d.%m.%y %-H:%M",
                                                     "%Y-%m-%d %H:%M:%S",
                                                     "%Y-%m-%d %H:%M",
                                                     "%Y-%m-%d %-H:%M",
                                                     "%y-%m-%d %-H:%M",
                                                     "%d.%m.%Y",
                                                     "%-d.%m.%Y",
                                                     "%-d.%m.%y",
                                                     "%Y-%m-%d",
                                                     "%y-%m-%d",
                                                     "%H:%M:%S",
                                                     "%-H:%M:%S",
                                                     "%-H:%M",
                                                     "%d.%m.%Y %H:%M",
                                                     nullptr,
                                                     nullptr,
                                                     nullptr,
                                                     "%V"};

std::optional<std::string> dateText(int format, double seconds) {
  if (format < 0 || format >= static_cast<int>(dateFormats.size())) return std::nullopt;
  const char* pattern = dateFormats[static_cast<std::size_t>(format)];
  if (pattern == nullptr) return std::nullopt;
  const std::tm parts = utcTime(0, std::floor(seconds));
  std::array<char, 64> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), pattern, &parts);
  return std::string(text.data(), length);
}

bool sameWord(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return upper(x) == upper(y); });
}

}  // namespace

Value systemText(const RunContext& run, int id, int number, int index) {
  const control::heidenhain::Control& control = run.control;
  const auto& tables = control.tables;
  switch (id) {
    case 10010:
      if (number == 1) return control.programPath;
      if (number == 2 && !run.levels.empty()) return run.levels.back().file;
      if (number == 3) return run.cycleProgram;
      if (number == 10) return run.selectedProgram;
      break;
    case 10060:
      if (number == 1) return control.tool.name;
      break;
    case 10290:
      if (number == 10) return control.channel.description().name;
      break;
    case 10321:
      if (const auto text = dateText(number, run.machineSeconds())) return *text;
      break;
    case 10350: {
      const std::string& row = control.tool.probeRow;
      if (number == 50) return row.empty() ? std::string() : tables.probes.text(row, "TYPE");
      break;
    }
    case 10630:
      if (number == 10) return std::string(control::name(control.kind()));
      break;
    case 10950: {
      const std::string row = index > 0 ? std::to_string(index) : control.tool.row;
      if (number == 1) return tables.tools.text(row, "NAME");
      if (number == 2) return tables.tools.text(row, "DOC");
      break;
    }
    default:
      break;
  }
  throw Alarm("System datum not available", fmt::format("SYSSTR cannot read ID{} NR{} on this control", id, number),
              "assign a fixed text to the parameter");
}

Value configuration(const RunContext& run, const std::string& object, const std::string& attribute, int index) {
  const control::heidenhain::Control& control = run.control;
  if (sameWord(attribute, "ncLanguage")) return std::string(languageWord(control.panel.language).substr(2));
  if (sameWord(attribute, "unitOfMeasure")) return std::string("metric");
  if (sameWord(attribute, "axisDisplayOrder")) {
    const auto& axes = control.channel.description().axes;
    if (index < 0) return static_cast<double>(axes.size());
    if (index < static_cast<int>(axes.size())) return axes[static_cast<std::size_t>(index)].name;
  }
  for (const auto& entry : control::heidenhain::machineParameterEntries()) {
    if (!entry.controls.contains(control.kind()) || !sameWord(attribute, entry.name)) continue;
    return std::visit(
        [&](auto member) -> Value {
          using Type = std::remove_cvref_t<decltype(control.parameters.*member)>;
          const auto value = control.parameters.*member;
          if constexpr (std::is_same_v<Type, bool>) return std::string(value ? "TRUE" : "FALSE");
          return static_cast<double>(value);
        },
        entry.member);
  }
  throw Alarm("System datum not available",
              fmt::format("CFGREAD cannot read {} of {} on this control", attribute, object),
              "assign a fixed value to the parameter");
}

}  // namespace probewright::execution::klartext

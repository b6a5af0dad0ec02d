#include "study/observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "base/number_text.hpp"
#include "base/text.hpp"
#include "cycles/main_results.hpp"
#include "study/first_order.hpp"

namespace probewright::study {

namespace {

bool isAnswer(control::Role role) {
  switch (role) {
    case control::Role::Actual:
    case control::Role::Difference:
    case control::Role::Correction:
    case control::Role::Statistic:
      return true;
    case control::Role::Status:
    case control::Role::Setting:
    case control::Role::Touch:
    case control::Role::Set:
    case control::Role::LowerLimit:
    case control::Role::UpperLimit:
    case control::Role::Excess:
      return false;
  }
  return false;
}

using CycleTruths = std::vector<std::optional<double>>;  ///< a true value for each result, where it is known

/// The true value of a deviation: as far from the measured one as that of the measured value it was computed from.
std::optional<double> trueDeviation(const control::CycleRecord& cycle, const control::ResultRecord& deviation,
                                    const CycleTruths& truths) {
  constexpr double rounding = 1e-9;
  if (deviation.kind.role != control::Role::Difference) return std::nullopt;
  for (std::size_t i = 0; i < cycle.results.size(); ++i) {
    const control::ResultRecord& actual = cycle.results[i];
    if (actual.kind.role != control::Role::Actual || !(actual.kind.of == deviation.kind.of) || !actual.nominal ||
        !truths[i])
      continue;
    const double measured = actual.value - *actual.nominal, error = actual.value - *truths[i];
    if (std::abs(deviation.value - measured) <= rounding) return deviation.value - error;
    if (std::abs(deviation.value + measured) <= rounding) return deviation.value + error;
  }
  return std::nullopt;
}

std::string placeName(const SourcePlace& place, const std::string& mainProgram) {
  if (place.file == mainProgram || place.file.empty()) return std::to_string(place.line);
  return fmt::format("{}:{}", std::filesystem::path(place.file).filename().string(), place.line);
}

}  // namespace

std::vector<Observation> observationsOf(const control::Journal& journal, const Observed& observed) {
  const std::string &mainProgram = observed.mainProgram, &prefix = observed.prefix;
  std::vector<Observation> observations;
  std::set<std::string> keys;
  std::map<std::string, int> passes;
  std::map<std::string, const control::WriteRecord*> writes;
  const auto write = [&](const control::WriteRecord& record) { writes[record.table + " " + record.entry] = &record; };
  for (std::size_t c = 0; c < journal.cycles.size(); ++c) {
    const control::CycleRecord& cycle = journal.cycles[c];
    std::string call = fmt::format("{}{}@{}", prefix, cycle.name, placeName(cycle.place, mainProgram));
    if (const int pass = ++passes[call]; pass > 1) call += fmt::format("#{}", pass);
    const std::vector<bool> isMain = cycles::mainResults(cycle);
    CycleTruths truths(cycle.results.size());
    for (std::size_t i = 0;
         c < observed.truths.size() && i < std::min(truths.size(), observed.truths[c].results.size()); ++i)
      if (observed.truths[c].results[i]) truths[i] = observed.truths[c].results[i]->value;
    for (std::size_t i = 0; i < cycle.results.size(); ++i) {
      const control::ResultRecord& result = cycle.results[i];
      if (!isAnswer(result.kind.role) || !std::isfinite(result.value)) continue;
      std::string key = call + " " + result.name;
      if (!keys.insert(key).second) continue;
      std::optional<double> firstOrder;
      const std::optional<double> truth = truths[i] ? truths[i] : trueDeviation(cycle, result, truths);
      if (observed.scatter > 0) {
        const auto sensitivity = sensitivityToTouches(cycle, result);
        if (sensitivity) firstOrder = *sensitivity * observed.scatter;
      }
      observations.push_back({{.key = std::move(key),
                               .label = result.meaning,
                               .unit = result.unit,
                               .main = isMain[i],
                               .table = false,
                               .nominal = result.nominal,
                               .lower = result.lowerLimit,
                               .upper = result.upperLimit,
                               .firstOrder = firstOrder},
                              result.value,
                              truth});
    }
    for (const control::WriteRecord& record : cycle.writes)
      write(record);
  }
  for (const control::WriteRecord& record : journal.writes)
    write(record);
  for (const auto& [name, record] : writes) {
    const auto value = parseDecimal(trimmed(record->after));
    if (!value) continue;
    observations.push_back({{.key = fmt::format("{}{}", prefix, name),
                             .label = "entry of a table",
                             .unit = "",
                             .main = false,
                             .table = true,
                             .nominal = std::nullopt,
                             .lower = std::nullopt,
                             .upper = std::nullopt,
                             .firstOrder = std::nullopt},
                            *value,
                            std::nullopt});
  }
  return observations;
}

std::string withoutNumbers(std::string_view message) {
  std::string text;
  for (std::size_t i = 0; i < message.size();) {
    std::size_t end = i;
    while (end < message.size() && isDigit(message[end]))
      ++end;
    if (end > i && end + 1 < message.size() && message[end] == '.' && isDigit(message[end + 1])) {
      while (end < message.size() && (isDigit(message[end]) || message[end] == '.'))
        ++end;
      if (!text.empty() && (text.back() == '-' || text.back() == '+')) text.pop_back();
      text += "...";
    } else {
      end = std::max(end, i + 1);
      text += message.substr(i, end - i);
    }
    i = end;
  }
  return text;
}

}  // namespace probewright::study

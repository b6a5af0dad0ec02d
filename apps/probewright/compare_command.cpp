#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "base/file.hpp"
#include "base/number_text.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "records/comparison.hpp"
#include "terminal.hpp"

namespace probewright::app {

namespace {

using records::ComparedCycle;
using records::ComparedEntry;
using records::ComparedValue;
using records::Comparison;

Result<nlohmann::json> resultsOf(const std::filesystem::path& run) {
  std::error_code unknown;
  const auto file = std::filesystem::is_directory(run, unknown) ? run / "results.json" : run;
  Result<std::string> text = readFile(file);
  if (!text) {
    if (file != run) text.error().advice = "give the folder that `probewright run --out` has filled";
    return tl::unexpected(std::move(text.error()));
  }
  nlohmann::json document = nlohmann::json::parse(*text, nullptr, false);
  if (document.is_discarded()) return fail({file.string()}, "this is not JSON", "give results.json of a run");
  return document;
}

std::string number(const std::optional<double>& value, const std::string& unit) {
  if (!value) return "-";
  return unit.empty() ? formatShortest(*value) : formatFixed(*value, 4) + " " + unit;
}

std::string signedNumber(const std::optional<double>& value, const std::string& unit) {
  if (!value) return "";
  return unit.empty() ? (*value > 0 ? "+" : "") + formatShortest(*value) : formatSigned(*value, 4) + " " + unit;
}

std::string line(const ComparedValue& value) {
  std::string verdicts;
  if (value.firstVerdict != value.secondVerdict && !value.firstVerdict.empty() && !value.secondVerdict.empty())
    verdicts = fmt::format("  {} -> {}", value.firstVerdict, value.secondVerdict);
  return fmt::format("      {:<9} {:<44} {:>16} {:>16} {:>14}{}\n", value.name, value.meaning,
                     number(value.first, value.unit), number(value.second, value.unit),
                     signedNumber(value.difference(), value.unit), verdicts);
}

/// A cycle with the values that are to be shown; nothing if there are none.
std::string paragraph(const ComparedCycle& cycle, std::size_t count, bool all) {
  std::string rows;
  for (const ComparedValue& value : cycle.values)
    if (cycle.inBoth() && (all || (value.main && value.differs))) rows += line(value);
  if (!all && rows.empty() && !cycle.differs()) return {};
  std::string place = cycle.firstPlace == cycle.secondPlace ? cycle.firstPlace
                      : cycle.inBoth()                      ? cycle.firstPlace + " and " + cycle.secondPlace
                      : cycle.secondPlace.empty()           ? cycle.firstPlace + ", in the first run only"
                                                            : cycle.secondPlace + ", in the second run only";
  std::string text = fmt::format("{:>3}  {} {}  ({})\n", count, cycle.name, cycle.title, place);
  if (cycle.firstAlarm != cycle.secondAlarm) {
    const auto alarm = [](const std::string& what) { return what.empty() ? std::string("none") : what; };
    if (cycle.inBoth())
      text += fmt::format("      alarm in the first run: {}\n      alarm in the second run: {}\n",
                          alarm(cycle.firstAlarm), alarm(cycle.secondAlarm));
  }
  return text + rows;
}

std::string textOf(const Comparison& comparison, const CompareArguments& arguments) {
  std::string text =
      fmt::format("first   {}\nsecond  {}\n", arguments.first.generic_string(), arguments.second.generic_string());
  for (const records::ComparedFact& fact : comparison.facts)
    text += fmt::format("{}: {} -> {}\n", fact.name, fact.first.empty() ? "none" : fact.first,
                        fact.second.empty() ? "none" : fact.second);
  std::string cycles;
  std::size_t count = 0;
  for (const ComparedCycle& cycle : comparison.cycles)
    cycles += paragraph(cycle, ++count, arguments.all);
  if (!cycles.empty())
    text += fmt::format("\n{:60} {:>16} {:>16} {:>14}\n{}", "", "first", "second", "difference", cycles);
  std::string entries;
  for (const ComparedEntry& entry : comparison.entries) {
    if (!arguments.all && !entry.differs) continue;
    const auto content = [](const std::string& what) { return what.empty() ? std::string("not written") : what; };
    entries +=
        fmt::format("      {} {}: {} -> {}\n", entry.table, entry.entry, content(entry.first), content(entry.second));
  }
  if (!entries.empty()) text += "\nWritten into tables\n" + entries;
  text += fmt::format("\n{} of {} values differ by more than {} mm or degrees", comparison.differing, comparison.values,
                      formatShortest(arguments.tolerance));
  if (comparison.differing > 0) text += fmt::format("; the largest difference is {:.4f}", comparison.largest);
  return text + "\n";
}

}  // namespace

int compare(const CompareArguments& arguments) {
  const auto first = resultsOf(arguments.first), second = resultsOf(arguments.second);
  Diagnostics mistakes;
  for (const auto* read : {&first, &second})
    if (!*read) mistakes.push_back(read->error());
  if (!mistakes.empty()) {
    print(mistakes);
    return 2;
  }
  const auto comparison = records::compare(*first, *second, arguments.tolerance);
  if (!comparison) {
    print({comparison.error()});
    return 2;
  }
  if (arguments.asJson) {
    put(records::comparisonJson(*comparison).dump(2) + "\n", stdout);
  } else {
    put(printable(textOf(*comparison, arguments)), stdout);
  }
  return comparison->alike() ? 0 : 1;
}

}  // namespace probewright::app

#include "exchange/inspection.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <regex>
#include <string_view>

#include "cycles/catalogue.hpp"
#include "cycles/main_results.hpp"
#include "records/feature_names.hpp"
#include "records/readable_text.hpp"
#include "records/results.hpp"

namespace probewright::exchange {

namespace {

std::string fileName(const std::string& path) { return path.substr(path.find_last_of("/\\") + 1); }

std::optional<double> finite(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// Without line ends and other characters that have no place in a field: U+FFFE and U+FFFF are no characters, and no
/// XML reader takes them.
std::string inOneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  for (const std::string_view none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = text.find(none); at != std::string::npos; at = text.find(none, at))
      text.replace(at, none.size(), " ");
  }
  return text;
}

/// True for a value that stands for "not measured": the cycle leaves a status where its definition names a measurement.
bool isMissing(const control::CycleRecord& cycle, const control::ResultRecord& result) {
  const cycles::CycleDefinition* definition = cycles::cycleNamed(cycle.name);
  const cycles::ResultDefinition* known = definition != nullptr ? definition->result(result.name) : nullptr;
  return known != nullptr && known->kind.role != control::Role::Status && result.kind.role == control::Role::Status;
}

}  // namespace

Inspection inspectionOf(const control::Journal& journal, const records::RunInfo& run) {
  const records::ReadableText readable(run);
  const auto text = [&](const std::string& bytes) { return inOneLine(readable(bytes)); };
  const records::FeatureNames features(run, readable);
  Inspection inspection;
  inspection.run = run;
  for (records::ProgramSource& program : inspection.run.programs)
    program = {text(program.path), {}};
  for (std::string* field : {&inspection.run.machine, &inspection.run.partName, &inspection.run.partPath,
                             &inspection.run.setupPath, &inspection.run.exitText})
    *field = text(*field);
  for (const records::JobField& field : records::jobFields)
    inspection.run.job.*field.value = text(run.job.*field.value);
  inspection.verdict = records::worstVerdict(journal);
  std::size_t number = 0;
  for (const control::CycleRecord& cycle : journal.cycles) {
    ++number;
    const std::string feature = inOneLine(features.at(cycle.place));
    const std::string program = text(fileName(cycle.place.file));
    if (!cycle.alarm.empty()) {
      inspection.failures.push_back(
          {number, text(cycle.name), text(cycle.title), program, feature, text(cycle.alarm), cycle.place.line});
    }
    const std::vector<bool> isMain = cycles::mainResults(cycle);
    for (std::size_t i = 0; i < isMain.size(); ++i) {
      const control::ResultRecord& result = cycle.results[i];
      if (!isMain[i] || !std::isfinite(result.value) || isMissing(cycle, result)) continue;
      Row row;
      row.cycle = number;
      row.cycleName = text(cycle.name);
      row.title = text(cycle.title);
      row.program = program;
      row.line = cycle.place.line;
      row.feature = feature;
      row.result = text(result.name);
      row.characteristic = text(result.label.empty() ? result.meaning : result.label);
      row.of = result.kind.of;
      row.unit = result.unit;
      row.actual = result.value;
      row.nominal = finite(result.nominal);
      row.lowerLimit = finite(result.lowerLimit);
      row.upperLimit = finite(result.upperLimit);
      row.deviation = finite(result.deviation);
      row.verdict = result.verdict;
      row.seconds = cycle.endSeconds;
      inspection.rows.push_back(std::move(row));
    }
  }
  return inspection;
}

std::string nameOf(const Row& row) {
  return fmt::format("{} {}{}: {} ({})", row.cycle, row.cycleName, row.feature.empty() ? "" : " " + row.feature,
                     row.characteristic, row.result);
}

std::string timeOf(const Row& row, const records::RunInfo& run) {
  static const std::regex shape(R"((\d{4})-(\d\d)-(\d\d)T(\d\d):(\d\d):(\d\d)(Z|([+-])(\d\d):?(\d\d)))");
  std::smatch match;
  if (!std::regex_match(run.startedAt, match, shape)) return {};
  const auto number = [&](std::size_t group) { return std::stoi(match[group]); };
  std::tm start{};
  start.tm_year = number(1) - 1900;
  start.tm_mon = number(2) - 1;
  start.tm_mday = number(3);
  start.tm_hour = number(4);
  start.tm_min = number(5);
  start.tm_sec = number(6);
  std::time_t time = timegm(&start);
  if (match[8].matched) time -= (match[8] == "-" ? -1 : 1) * (number(9) * 3600 + number(10) * 60);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(time + std::llround(row.seconds)));
}

}  // namespace probewright::exchange

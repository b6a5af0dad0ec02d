#include <fmt/format.h>

#include "base/number_text.hpp"
#include "exchange/formats.hpp"
#include "records/results.hpp"

namespace probewright::exchange {

namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text)
    result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

/// Without the sign of a zero, which would make two texts of one number.
std::string number(const std::optional<double>& value) { return value ? formatShortest(*value + 0.0) : std::string(); }

constexpr std::string_view columns =
    "cycle,name,title,program,line,feature,characteristic,result,unit,nominal,lower limit,upper limit,actual,"
    "deviation,verdict,time\r\n";

std::string recordHead() { return "started,setup,part,seed," + std::string(columns); }

std::string lineOf(const Row& row, const records::RunInfo& run) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", row.cycle, quoted(row.cycleName),
                     quoted(row.title), quoted(row.program), row.line, quoted(row.feature), quoted(row.characteristic),
                     quoted(row.result), row.unit, number(row.nominal), number(row.lowerLimit), number(row.upperLimit),
                     number(row.actual), number(row.deviation), records::verdictName(row.verdict), timeOf(row, run));
}

}  // namespace

std::string csvText(const Inspection& inspection) {
  std::string text(columns);
  for (const Row& row : inspection.rows)
    text += lineOf(row, inspection.run);
  return text;
}

bool isRecord(std::string_view text) { return text.starts_with(recordHead()); }

Result<std::string> recordWith(std::string record, const Inspection& inspection) {
  if (record.empty()) record = recordHead();
  if (!isRecord(record)) {
    return fail("the first line is not that of a record of runs",
                "give the name of a new file, or of one that --append has made");
  }
  if (!record.ends_with("\r\n")) {
    return fail("the last line has no end: something has been lost, or another program has changed the file",
                "look at its end, and end it with a line feed after a carriage return");
  }
  const records::RunInfo& run = inspection.run;
  const std::string seed = run.seed ? std::to_string(*run.seed) : std::string();
  for (const Row& row : inspection.rows)
    record += fmt::format("{},{},{},{},{}", run.startedAt, quoted(run.setupPath), quoted(run.partName), seed,
                          lineOf(row, run));
  return record;
}

}  // namespace probewright::exchange

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

std::string number(const std::optional<double>& value) { return value ? formatShortest(*value) : std::string(); }

}  // namespace

std::string csvText(const Inspection& inspection) {
  std::string text =
      "cycle,name,title,program,line,feature,characteristic,result,unit,nominal,lower limit,upper limit,actual,"
      "deviation,verdict,time\r\n";
  for (const Row& row : inspection.rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", row.cycle, quoted(row.cycleName),
                        quoted(row.title), quoted(row.program), row.line, quoted(row.feature),
                        quoted(row.characteristic), quoted(row.result), row.unit, number(row.nominal),
                        number(row.lowerLimit), number(row.upperLimit), formatShortest(row.actual),
                        number(row.deviation), records::verdictName(row.verdict), timeOf(row, inspection.run));
  }
  return text;
}

}  // namespace probewright::exchange

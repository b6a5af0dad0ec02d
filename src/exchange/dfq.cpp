#include <fmt/format.h>

#include <algorithm>

#include "base/number_text.hpp"
#include "exchange/formats.hpp"

namespace probewright::exchange {

namespace {

/// One key with its value. Empty ones are left out, as the format asks.
class Keys {
public:
  void put(const char* key, const std::string& value) {
    if (!value.empty()) text_ += fmt::format("{} {}\r\n", key, value);
  }
  void put(const char* key, std::size_t number, const std::string& value) {
    if (!value.empty()) text_ += fmt::format("{}/{} {}\r\n", key, number, value);
  }
  std::string text() && {
    const bool ascii = std::ranges::all_of(text_, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    return ascii ? std::move(text_) : "\xEF\xBB\xBF" + text_;
  }

private:
  std::string text_;
};

/// "2026-07-07T18:42:10" as 07.07.2026/18:42:10.
std::string germanTime(const std::string& iso) {
  if (iso.size() != 19) return {};
  return fmt::format("{}.{}.{}/{}", iso.substr(8, 2), iso.substr(5, 2), iso.substr(0, 4), iso.substr(11));
}

std::string number(const std::optional<double>& value) { return value ? formatFixed(*value, 7) : std::string(); }

}  // namespace

std::string dfqText(const Inspection& inspection) {
  constexpr int kDecimals = 4;
  const records::RunInfo& run = inspection.run;
  Keys keys;
  keys.put("K0100", std::to_string(inspection.rows.size()));
  const std::string name = run.partName.empty() ? "part" : run.partName;
  keys.put("K1001", run.job.part.empty() ? name : run.job.part);
  keys.put("K1002", run.job.part.empty() ? run.partPath : name);
  keys.put("K1041", run.job.drawing);
  keys.put("K1082", run.machine);
  keys.put("K1900", run.programs.empty() ? "" : run.programs.front().path);
  std::size_t place = 0;
  for (const Row& row : inspection.rows) {
    ++place;
    keys.put("K2001", place, std::to_string(place));
    keys.put("K2002", place, nameOf(row));
    keys.put("K2004", place, "0");  // a variable
    keys.put("K2022", place, std::to_string(kDecimals));
    keys.put("K2101", place, number(row.nominal));
    keys.put("K2110", place, number(row.lowerLimit));
    keys.put("K2111", place, number(row.upperLimit));
    keys.put("K2142", place, row.unit);
  }
  place = 0;
  for (const Row& row : inspection.rows) {
    ++place;
    keys.put("K0001", place, formatFixed(row.actual, 7));
    keys.put("K0002", place, "0");  // a valid value
    keys.put("K0004", place, germanTime(timeOf(row, run)));
    keys.put("K0014", place, run.job.serial);
    keys.put("K0053", place, run.job.order);
  }
  return std::move(keys).text();
}

}  // namespace probewright::exchange

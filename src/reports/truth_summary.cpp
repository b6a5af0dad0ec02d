#include "reports/truth_summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/number_text.hpp"

namespace probewright::reports {

using records::EntryTruth;

namespace {

/// "0.4 um" below a hundredth of a millimetre, then "0.512 mm".
std::string lengthText(double mm) {
  return std::abs(mm) < 0.01 ? fmt::format("{:.1f} um", 1000 * mm) : fmt::format("{:.3f} mm", mm);
}

std::string valuesText(const EntryTruth& entry) {
  std::string text;
  for (const records::EntryValue& value : entry.values) {
    text += fmt::format("{}{} {}, truly {}", text.empty() ? "" : "; ", value.name, formatFixed(value.value, 4),
                        formatFixed(value.truth, 4));
  }
  return text;
}

}  // namespace

std::string besideResult(const records::TrueValue& truth, double measured, int decimals) {
  return fmt::format("  true {}, error {}", formatFixed(truth.value, decimals),
                     formatSigned(measured - truth.value, decimals));
}

std::string entriesText(const records::Truth& truth, const std::function<std::string(const std::string&)>& line) {
  std::string text;
  for (const EntryTruth& entry : truth.entries) {
    std::string apart;
    if (entry.distance) apart = lengthText(*entry.distance);
    if (entry.angle) apart += fmt::format("{}{:.4f} deg", apart.empty() ? "" : " and ", *entry.angle);
    if (apart.empty()) continue;
    text += fmt::format("  {}: {} from the truth ({})\n", line(entry.name), apart, line(valuesText(entry)));
  }
  return text;
}

}  // namespace probewright::reports

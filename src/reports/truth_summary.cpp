#include "reports/truth_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

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

std::string diagnosesText(const records::Truth& truth, const std::function<std::string(const std::string&)>& line) {
  std::string text;
  for (const records::Diagnosis& known : truth.diagnoses)
    for (const std::string& sentence : known.texts)
      text += "  truth  " + line(sentence) + "\n";
  return text;
}

namespace {

std::string spanText(const records::ClearanceSpan& span, const std::function<std::string(const std::string&)>& line,
                     const std::function<std::string(const SourcePlace&)>& place) {
  const std::string where = span.place ? place(*span.place) : fmt::format("at {:.1f} s", span.from);
  return fmt::format("the {} came within {:.1f} mm of \"{}\"  ({})\n", line(span.part), span.distance, line(span.solid),
                     where);
}

}  // namespace

std::string clearanceText(const records::Clearance& clearance,
                          const std::function<std::string(const std::string&)>& line,
                          const std::function<std::string(const SourcePlace&)>& place) {
  const auto nearer = [](const records::ClearanceSpan& a, const records::ClearanceSpan& b) {
    return a.distance < b.distance;
  };
  if (!(clearance.limit > 0)) {
    const auto least = std::ranges::min_element(clearance.spans, nearer);
    if (least == clearance.spans.end() || least->orMore) return {};
    return "  clearance  " + spanText(*least, line, place);
  }
  // Of the moves of one block the nearest.
  std::vector<records::ClearanceSpan> blocks;
  for (const records::ClearanceSpan& span : clearance.spans) {
    if (span.orMore || span.distance >= clearance.limit) continue;
    const bool same = !blocks.empty() && blocks.back().place && span.place &&
                      blocks.back().place->file == span.place->file && blocks.back().place->line == span.place->line;
    if (!same) {
      blocks.push_back(span);
    } else if (nearer(span, blocks.back())) {
      blocks.back() = span;
    }
  }
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, blocks.size()); ++i)
    text += "  warning  clearance: " + spanText(blocks[i], line, place);
  if (blocks.size() > most) text += fmt::format("  warning  clearance: {} more blocks\n", blocks.size() - most);
  return text;
}

}  // namespace probewright::reports

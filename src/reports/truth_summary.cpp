#include "reports/truth_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/number_text.hpp"
#include "words/words.hpp"

namespace probewright::reports {

using records::EntryTruth;

namespace {

/// Lines of one kind.
constexpr std::size_t most = 20;

/// "0.4 um" below a hundredth of a millimetre, then "0.512 mm".
std::string lengthText(double mm) {
  return std::abs(mm) < 0.01 ? fmt::format("{:.1f} um", 1000 * mm) : fmt::format("{:.3f} mm", mm);
}

/// Numbers of a table with many rows.
constexpr std::size_t mostNumbers = 8;

std::string valuesText(const EntryTruth& entry, const TruthStyle& style) {
  std::string text;
  std::vector<records::EntryValue> values = entry.values;
  if (values.size() > mostNumbers) {  // the ones that are wrong most
    std::ranges::stable_sort(values, std::ranges::greater(),
                             [](const records::EntryValue& value) { return std::abs(value.value - value.truth); });
    values.resize(mostNumbers);
  }
  for (const records::EntryValue& value : values) {
    text += text.empty() ? "" : "; ";
    text += words::text(style.language, "sumTruly",
                        {{"name", words::phrase(style.language, style.line(value.name))},
                         {"value", formatFixed(value.value, 4)},
                         {"truth", formatFixed(value.truth, 4)}});
  }
  return entry.values.size() > mostNumbers ? text + "; ..." : text;
}

}  // namespace

std::string besideResult(const records::TrueValue& truth, double measured, int decimals,
                         control::DialogLanguage language) {
  return "  " + words::text(language, "sumTrue",
                            {{"value", formatFixed(truth.value, decimals)},
                             {"error", formatSigned(measured - truth.value, decimals)}});
}

std::string entriesText(const records::Truth& truth, const TruthStyle& style) {
  std::string text;
  for (const EntryTruth& entry : truth.entries) {
    std::string apart;
    if (entry.distance) apart = lengthText(*entry.distance);
    if (entry.angle) {
      const std::string angle = fmt::format("{:.4f} deg", *entry.angle);
      apart = apart.empty() ? angle : words::text(style.language, "sumAnd", {{"length", apart}, {"angle", angle}});
    }
    if (apart.empty()) continue;
    text += "  " +
            words::text(style.language, "sumFromTruth",
                        {{"name", words::phrase(style.language, style.line(entry.name))},
                         {"distance", apart},
                         {"values", valuesText(entry, style)}}) +
            "\n";
  }
  return text;
}

std::string diagnosesText(const records::Truth& truth, const TruthStyle& style) {
  std::string text;
  for (const records::Diagnosis& known : truth.diagnoses)
    for (const std::string& sentence : known.texts)
      text += "  " + words::text(style.language, "sumTruth") + "  " +
              words::translated(style.language, style.line(sentence)) + "\n";
  return text;
}

namespace {

std::string spanText(const records::ClearanceSpan& span, const TruthStyle& style) {
  const std::string where = span.place
                                ? style.place(*span.place)
                                : words::text(style.language, "sumAtTime", {{"s", fmt::format("{:.1f}", span.from)}});
  return fmt::format("{}  ({})\n",
                     words::text(style.language, "sumNear",
                                 {{"part", words::phrase(style.language, style.line(span.part))},
                                  {"distance", fmt::format("{:.1f}", span.distance)},
                                  {"solid", style.line(span.solid)}}),
                     where);
}

}  // namespace

std::string clearanceText(const records::Clearance& clearance, const TruthStyle& style) {
  const std::string head = words::text(style.language, "sumClearance");
  const std::string warning = fmt::format("  {}  {}: ", words::text(style.language, "sumWarning"), head);
  const auto nearer = [](const records::ClearanceSpan& a, const records::ClearanceSpan& b) {
    return a.distance < b.distance;
  };
  if (!(clearance.limit > 0)) {
    const auto least = std::ranges::min_element(clearance.spans, nearer);
    if (least == clearance.spans.end() || least->orMore) return {};
    return fmt::format("  {}  ", head) + spanText(*least, style);
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
  std::string text;
  for (std::size_t i = 0; i < std::min(most, blocks.size()); ++i)
    text += warning + spanText(blocks[i], style);
  if (blocks.size() > most)
    text +=
        warning + words::text(style.language, "sumMoreBlocks", {{"n", std::to_string(blocks.size() - most)}}) + "\n";
  return text;
}

std::string nearEndsText(const std::vector<records::TravelMargin>& nearEnds, const TruthStyle& style) {
  const std::string head =
      fmt::format("  {}  {}: ", words::text(style.language, "sumWarning"), words::text(style.language, "sumTravel"));
  std::string text;
  for (std::size_t i = 0; i < std::min(most, nearEnds.size()); ++i) {
    const records::TravelMargin& near = nearEnds[i];
    const std::string where =
        near.place ? style.place(*near.place)
                   : words::text(style.language, "sumAtTime", {{"s", fmt::format("{:.1f}", near.seconds)}});
    text += fmt::format("{}{}  ({})\n", head,
                        words::text(style.language, "sumNearEnd",
                                    {{"axis", style.line(near.axis)},
                                     {"margin", fmt::format("{:.1f} {}", near.margin, near.unit)},
                                     {"position", formatSigned(near.position, 1)}}),
                        where);
  }
  if (nearEnds.size() > most)
    text += head + words::text(style.language, "sumMoreBlocks", {{"n", std::to_string(nearEnds.size() - most)}}) + "\n";
  return text;
}

}  // namespace probewright::reports

#include "study/study_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "study/adaptive.hpp"

namespace probewright::study {

namespace {

/// Decimals that show a value to a tenth of its standard uncertainty's first digit; six where it is certain.
int decimalsFor(double uncertainty) {
  if (!(uncertainty > 0)) return 6;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(uncertainty))), 0, 9);
}

std::string value(const std::optional<double>& number, int decimals) {
  return number ? formatFixed(*number, decimals) : "-";
}

std::string range(const std::optional<Interval>& interval, int decimals) {
  return interval ? fmt::format("{} .. {}", formatFixed(interval->low, decimals), formatFixed(interval->high, decimals))
                  : "-";
}

/// A standard deviation; one value has none.
std::string deviation(double value) { return std::isnan(value) ? "-" : fmt::format("{:.2g}", value); }

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

/// Columns as wide as their widest cell; the first to the left, the others to the right.
std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    text += "  ";
    for (std::size_t i = 0; i < row.size(); ++i)
      text += i == 0 ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    while (text.ends_with(' '))
      text.pop_back();
    text += "\n";
  }
  return text;
}

std::string heading(const StudyResult& result) {
  std::string text = fmt::format("{} trials, {} came to the end of the program", result.trials, result.finished);
  switch (result.end) {
    case StudyEnd::Stable:
      return text + fmt::format("; {} significant digits of u are stable (JCGM 101, 7.9)", result.study.digits);
    case StudyEnd::AllTrials:
      return text;
    case StudyEnd::MostTrials:
      return text + "; the digits are NOT stable yet: allow more trials";
    case StudyEnd::NoResult:
      return text + "; no trial came to its end" + (result.answers.empty() ? ": nothing was measured" : "");
    case StudyEnd::Interrupted:
      return text + "; INTERRUPTED";
  }
  return text;
}

bool isShown(const Answer& answer) { return answer.of.main || answer.error || answer.type1 || answer.gauge; }

std::string covered(const StudyResult& result) {
  return fmt::format("{:.3g} % symmetric", 100 * result.study.coverage);
}

/// What a measured value is worth.
std::string resultsTable(const StudyResult& result, const std::vector<const Answer*>& shown) {
  std::vector<std::vector<std::string>> rows = {
      {"result", "unit", "estimate", "u", covered(result), "shortest", "bias", "count"}};
  bool blind = false;
  for (const Answer* answer : shown) {
    const int decimals = decimalsFor(answer->standardUncertainty);
    blind = blind || !answer->error;
    rows.push_back(
        {answer->of.key + (answer->error ? "" : " *"), answer->of.unit, value(answer->estimate, decimals),
         deviation(answer->standardUncertainty), range(answer->symmetric, decimals), range(answer->shortest, decimals),
         answer->error ? formatSigned(answer->error->mean, decimals) : "-", std::to_string(answer->values.count)});
  }
  std::string text =
      "What a measured value is worth: the true value behind the estimate lies in the interval\n" + table(rows);
  if (blind) text += "  * of the measured values: no true value is known that they could be compared with\n";
  return text;
}

/// How measured values spread where the true ones vary, too.
std::string spreadTable(const StudyResult& result, const std::vector<const Answer*>& shown) {
  std::vector<std::vector<std::string>> rows = {
      {"result", "unit", "mean", "standard deviation", covered(result), "true values"}};
  for (const Answer* answer : shown) {
    if (!answer->truths || !answer->truths->vary()) continue;
    const int decimals = decimalsFor(answer->values.deviation);
    rows.push_back({answer->of.key, answer->of.unit, value(answer->values.mean, decimals),
                    fmt::format("{:.2g}", answer->values.deviation), range(answer->values.symmetric, decimals),
                    range(Interval{answer->truths->least, answer->truths->greatest}, decimals)});
  }
  if (rows.size() == 1) return {};
  return "\nSpread of the measured values over the trials: the true values vary, too\n" + table(rows);
}

/// An uncertainty budget: what each source does alone, and how much of the variance that is.
std::string budgetTable(const StudyResult& result, const Answer& answer) {
  const bool sobol = std::ranges::any_of(answer.indices, [](const auto& i) { return i.has_value(); });
  std::vector<std::vector<std::string>> rows = {{"source", "distribution", "u(x)", "c", "u(y)", "share"}};
  if (sobol) rows.front().insert(rows.front().end(), {"Sobol first", "total"});
  double squares = 0;
  for (const Contribution& contribution : answer.contributions)
    squares += std::pow(contribution.uncertainty.value_or(0), 2);
  for (std::size_t i = 0; i < result.units.size(); ++i) {
    const Sampler::Unit& unit = result.units[i];
    const Contribution contribution = i < answer.contributions.size() ? answer.contributions[i] : Contribution{};
    std::vector<std::string> row = {unit.name, unit.sources.size() > 1 ? "correlated" : "-", "-", "-", "-", "-"};
    if (unit.sources.size() == 1) {
      const Source& source = result.study.sources[unit.sources.front()];
      row[1] = source.distribution.name();
      row[2] = fmt::format("{:.2g}", source.distribution.standardDeviation());
      if (contribution.sensitivity) row[3] = fmt::format("{:.3g}", *contribution.sensitivity);
    }
    if (contribution.uncertainty) {
      row[4] = fmt::format("{:.2g}", *contribution.uncertainty);
      if (squares > 0) row[5] = fmt::format("{:.1f} %", 100 * std::pow(*contribution.uncertainty, 2) / squares);
    }
    if (sobol && answer.indices[i]) {
      row.push_back(fmt::format("{:.3f}", answer.indices[i]->first));
      row.push_back(fmt::format("{:.3f}", answer.indices[i]->total));
    }
    rows.push_back(std::move(row));
  }
  std::string text = fmt::format("\nUncertainty budget of {} ({})\n", answer.of.key, answer.of.label) + table(rows);
  if (answer.of.firstOrder && answer.firstOrder && *answer.firstOrder != FirstOrderVerdict::Holds) {
    text += fmt::format("  `run --uncertainty` would say {:.2g} {} for the random effects: {}\n", *answer.of.firstOrder,
                        answer.of.unit,
                        *answer.firstOrder == FirstOrderVerdict::Differs
                            ? "by more than 5 % another value"
                            : "whether that is another value by more than 5 %, more sensitivity_trials tell");
  }
  return text + fmt::format("  together {:.2g} {}; in the trials, with all of them at once, {}\n", std::sqrt(squares),
                            answer.of.unit, deviation(answer.standardUncertainty));
}

std::string limitsOf(const Tolerance& tolerance) {
  if (tolerance.lower && tolerance.upper) return fmt::format("{} to {}", *tolerance.lower, *tolerance.upper);
  return tolerance.lower ? fmt::format("at least {}", *tolerance.lower) : fmt::format("at most {}", *tolerance.upper);
}

std::string conformityText(const StudyResult& result, const Answer& answer) {
  const int decimals = decimalsFor(answer.standardUncertainty);
  std::string text =
      fmt::format("\nConformity of {}: {} {}\n", answer.of.key, limitsOf(*answer.tolerance), answer.of.unit);
  if (answer.estimate && answer.corrected && answer.conformance && answer.decision) {
    const std::string corrected =
        answer.error ? fmt::format(", less the bias {}", formatFixed(*answer.corrected, decimals)) : "";
    text += fmt::format(
        "  measured as {}{}: {} (ISO 14253-1, guard band {:.3g} u = {:.2g}); "
        "conformance probability {}\n",
        formatFixed(*answer.estimate, decimals), corrected, nameOf(*answer.decision), result.study.guardFactor,
        answer.guardBand, percent(*answer.conformance));
  }
  const auto risks = [&](const char* rule, const Risks& r) {
    return fmt::format("  {}: consumer's risk {} ({} to {}), producer's risk {} ({} to {})\n", rule,
                       percent(r.consumer), percent(r.consumerInterval.low), percent(r.consumerInterval.high),
                       percent(r.producer), percent(r.producerInterval.low), percent(r.producerInterval.high));
  };
  if (answer.risks) text += risks("accepted within the limits", *answer.risks);
  if (answer.guardedRisks) text += risks("accepted within the guard bands", *answer.guardedRisks);
  return text;
}

std::string capabilityText(const Answer& answer) {
  std::string text;
  if (answer.type1) {
    const Type1& type1 = *answer.type1;
    text += fmt::format(
        "\nType-1 study of {}: {} repeats, s = {:.2g}, bias = {:+.2g}\n  Cg = {:.2f}, Cgk = {:.2f} "
        "({} at a limit of 1.33)\n",
        answer.of.key, type1.count, type1.deviation, type1.bias, type1.cg, type1.cgk,
        type1.cg >= 1.33 && type1.cgk >= 1.33 ? "capable" : "not capable");
  }
  if (!answer.gauge) return text;
  const GaugeRR& gauge = *answer.gauge;
  text += fmt::format("\nGauge R&R of {}: {} parts, {} appraisers, {} repeats{}\n", answer.of.key, gauge.parts,
                      gauge.appraisers, gauge.repeats,
                      gauge.pooled ? "; the interaction is not significant and counts as repeatability" : "");
  const auto row = [&](const char* name, double deviation) {
    const double share = gauge.totalVariation > 0 ? deviation / gauge.totalVariation : 0;
    return std::vector<std::string>{name, fmt::format("{:.3g}", deviation), fmt::format("{:.1f} %", 100 * share)};
  };
  text += table({{"", "standard deviation", "of the total"},
                 row("repeatability (EV)", gauge.repeatability),
                 row("reproducibility (AV)", gauge.reproducibility),
                 row("gauge R&R (GRR)", gauge.gauge),
                 row("parts (PV)", gauge.partVariation),
                 row("total (TV)", gauge.totalVariation)});
  if (gauge.ofTolerance) text += fmt::format("  6 GRR is {} of the tolerance", percent(*gauge.ofTolerance));
  return text + fmt::format("{} distinct categories: {}\n", gauge.ofTolerance ? ";" : " ", gauge.distinctCategories);
}

/// How many of the trials in each tenth were stopped, in per cent. 0 and 100 mean none and all; "-": no trial lies
/// there.
std::string stoppedShares(const Tenths& tenths) {
  std::string text;
  for (std::size_t i = 0; i < tenths.trials.size(); ++i) {
    const std::uint64_t stopped = tenths.stopped[i], of = tenths.trials[i];
    if (i > 0) text += " ";
    if (of == 0) {
      text += "-";
    } else if (stopped == 0 || stopped == of) {
      text += stopped == 0 ? "0" : "100";
    } else {
      const double share = 100 * static_cast<double>(stopped) / static_cast<double>(of);
      text += share < 1 ? "<1" : share > 99 ? ">99" : fmt::format("{:.0f}", share);
    }
  }
  return text;
}

std::string stopsText(const StudyResult& result) {
  std::string text;
  for (const Stop& stop : result.stops) {
    text += fmt::format("\nStopped {} of {} trials ({} to {}): {}\n", stop.count, result.trials,
                        percent(stop.probability.low), percent(stop.probability.high), stop.why);
    std::vector<std::vector<std::string>> rows = {
        {"source", "from", "to", "mean", "stopped in tenths of its range, %"}};
    for (std::size_t i = 0; i < stop.sources.size(); ++i) {
      const Summary& source = stop.sources[i];
      rows.push_back({result.study.sources[i].name, fmt::format("{:.6g}", source.minimum),
                      fmt::format("{:.6g}", source.maximum), fmt::format("{:.6g}", source.mean),
                      stoppedShares(stop.tenths[i])});
    }
    text += table(rows);
  }
  return text;
}

}  // namespace

std::string studyText(const StudyResult& result, std::size_t most) {
  std::vector<const Answer*> shown;
  for (const Answer& answer : result.answers)
    if (isShown(answer)) shown.push_back(&answer);
  std::string text = heading(result) + "\n\n";
  if (!shown.empty()) text += resultsTable(result, shown) + spreadTable(result, shown);
  std::size_t count = 0;
  for (const Answer* answer : shown) {
    if (++count > most) break;
    if (!answer->contributions.empty()) text += budgetTable(result, *answer);
    if (answer->tolerance) text += conformityText(result, *answer);
    text += capabilityText(*answer);
  }
  if (shown.size() > most)
    text += fmt::format("\nbudgets and conformity of {} more results are in study.json\n", shown.size() - most);
  return text + stopsText(result);
}

}  // namespace probewright::study

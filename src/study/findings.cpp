#include "study/findings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace probewright::study {

namespace {

Moments momentsOf(const TrialSummary::Sums& sums, std::uint64_t count, const Grid::Scale& scale) {
  Moments moments;
  if (count == 0) return moments;
  const auto n = static_cast<long double>(count), sum = static_cast<long double>(sums.sum);
  moments.count = static_cast<double>(count);
  moments.mean = scale.reference + static_cast<double>(scale.step * (sum / n));
  const long double squares = static_cast<long double>(sums.squares) - sum * (sum / n);
  moments.squares = static_cast<double>(scale.step * (scale.step * std::max(squares, 0.0L)));
  return moments;
}

/// The middles of cells, none of them beyond the least and the greatest value.
void addPoints(Counted& points, const ValueCells& cells, const TrialSummary::Sums& sums, double reference) {
  for (const auto& [distance, count] : cells.points())
    points.emplace_back(std::clamp(reference + distance, sums.minimum, sums.maximum), count);
}

/// Those of counted trials and those that are kept, in ascending order. The least and the greatest value are known
/// exactly.
Counted withKept(Counted points, const TrialSummary::Sums& sums, const std::vector<double>& kept) {
  for (const double value : kept)
    points.emplace_back(value, 1);
  std::ranges::sort(points);
  if (points.empty()) return points;
  points.front().first = std::min(points.front().first, sums.minimum);
  points.back().first = std::max(points.back().first, sums.maximum);
  return points;
}

double quantileErrorOf(const Summary& summary, double reference) {
  double farthest = std::abs(summary.median - reference);
  for (const auto& interval : {summary.symmetric, summary.shortest})
    if (interval)
      farthest = std::max({farthest, std::abs(interval->low - reference), std::abs(interval->high - reference)});
  return farthest * ValueCells::relativeError;
}

/// Moments of pairs.
struct Pairs {
  Moments a, b;
  double products = 0;  ///< of deviations from the means

  void add(const Pairs& other) {
    const double count = a.count, more = other.a.count;
    if (more == 0) return;
    if (count > 0) products += (other.a.mean - a.mean) * (other.b.mean - b.mean) * count * more / (count + more);
    products += other.products;
    a.add(other.a);
    b.add(other.b);
  }
};

/// Of counted trials, whose points these are, and of the first ones, whose values are kept.
Summary summaryOf(Counted points, const TrialSummary::Sums& sums, std::uint64_t count, const Grid::Scale& scale,
                  const std::vector<double>& kept, double coverage) {
  points = withKept(std::move(points), sums, kept);
  Moments moments = momentsOf(sums, count, scale);
  moments.add(study::momentsOf(kept));
  Summary summary = summarize(points, moments, coverage);
  summary.quantileError = quantileErrorOf(summary, scale.reference);
  return summary;
}

}  // namespace

Findings::Findings(const TrialSummary& trials, const Sampler& sampler) : trials_(trials), table_(sampler.size()) {
  std::vector<const TrialSummary::Row*> rows;
  for (const TrialSummary::Row& row : trials.rows())
    rows.push_back(&row);
  std::ranges::sort(rows, {}, [](const TrialSummary::Row* row) { return row->first; });
  // Columns are those of the grid, where there is one, then others as they come.
  if (trials.grid()) {
    for (const Grid::Column& column : trials.grid()->columns)
      table_.expect(column.of);
  }
  for (const TrialSummary::Row* row : rows)
    table_.add(sampler.draw(row->first), row->second);
}

std::size_t Findings::finished() const {
  return static_cast<std::size_t>(trials_.regular()) +
         static_cast<std::size_t>(std::ranges::count(table_.ends(), TrialEnd::Finished));
}

/// Null if no trial that is counted has such a result.
const TrialSummary::Column* Findings::column(std::size_t i) const {
  return trials_.regular() > 0 && i < trials_.columns().size() ? &trials_.columns()[i] : nullptr;
}

std::uint64_t Findings::count(std::size_t i) const {
  return (column(i) != nullptr ? trials_.regular() : 0) + present(table_.values(i)).size();
}

Summary Findings::values(std::size_t i, double coverage) const {
  const std::vector<double> kept = present(table_.values(i));
  const TrialSummary::Column* counted = column(i);
  if (counted == nullptr) return summarize(kept, coverage);
  const Grid::Scale& scale = trials_.grid()->columns[i].values;
  Counted points;
  addPoints(points, counted->within, counted->values, scale.reference);
  addPoints(points, counted->beyond, counted->values, scale.reference);
  return summaryOf(std::move(points), counted->values, trials_.regular(), scale, kept, coverage);
}

Histogram Findings::histogram(std::size_t i) const {
  const TrialSummary::Column* counted = column(i);
  if (counted == nullptr) return histogramOf(table_.values(i));
  Counted points;
  const double reference = trials_.grid()->columns[i].values.reference;
  addPoints(points, counted->within, counted->values, reference);
  addPoints(points, counted->beyond, counted->values, reference);
  return histogramOf(withKept(std::move(points), counted->values, present(table_.values(i))));
}

Histogram Findings::errorHistogram(std::size_t i) const {
  const TrialSummary::Column* counted = column(i);
  if (counted == nullptr) return histogramOf(keptErrors(i));
  Counted points;
  addPoints(points, counted->errorCells, counted->errors, trials_.grid()->columns[i].errors.reference);
  return histogramOf(withKept(std::move(points), counted->errors, keptErrors(i)));
}

bool Findings::truthIsKnown(std::size_t i) const {
  if (column(i) != nullptr && !trials_.grid()->columns[i].hasTruth) return false;
  const std::vector<double>&values = table_.values(i), &truths = table_.truths(i);
  bool any = column(i) != nullptr;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isnan(values[k])) continue;
    if (truths.empty() || std::isnan(truths[k])) return false;
    any = true;
  }
  return any;
}

std::vector<double> Findings::keptErrors(std::size_t i) const {
  std::vector<double> errors;
  for (std::size_t k = 0; k < table_.size(); ++k)
    if (!std::isnan(table_.values(i)[k])) errors.push_back(table_.values(i)[k] - table_.truths(i)[k]);
  return errors;
}

std::optional<Summary> Findings::errors(std::size_t i, double coverage) const {
  if (!truthIsKnown(i)) return std::nullopt;
  const std::vector<double> kept = keptErrors(i);
  const TrialSummary::Column* counted = column(i);
  if (counted == nullptr) return summarize(kept, coverage);
  const Grid::Scale& scale = trials_.grid()->columns[i].errors;
  Counted points;
  addPoints(points, counted->errorCells, counted->errors, scale.reference);
  return summaryOf(std::move(points), counted->errors, trials_.regular(), scale, kept, coverage);
}

std::vector<double> Findings::keptTruths(std::size_t i) const {
  std::vector<double> truths;
  for (std::size_t k = 0; k < table_.size(); ++k)
    if (!std::isnan(table_.values(i)[k])) truths.push_back(table_.truths(i)[k]);
  return truths;
}

Findings::Truths Findings::truths(std::size_t i) const {
  const std::vector<double> kept = keptTruths(i);
  Truths truths{0, INFINITY, -INFINITY};
  Moments moments;
  if (const TrialSummary::Column* counted = column(i)) {
    const Grid::Column& column = trials_.grid()->columns[i];
    const Moments values = momentsOf(counted->values, trials_.regular(), column.values),
                  errors = momentsOf(counted->errors, trials_.regular(), column.errors);
    truths.least = counted->leastTruth;
    truths.greatest = counted->greatestTruth;
    // One that is the same in all trials is told as it is.
    moments = {values.count, truths.vary() ? values.mean - errors.mean : truths.least, 0};
  }
  for (const double truth : kept) {
    truths.least = std::min(truths.least, truth);
    truths.greatest = std::max(truths.greatest, truth);
  }
  moments.add(study::momentsOf(kept));
  truths.mean = moments.mean;
  return truths;
}

Risks Findings::risks(std::size_t i, const Tolerance& tolerance) const {
  Risks risks = risksOf(table_.values(i), table_.truths(i), tolerance, tolerance);
  if (const TrialSummary::Column* counted = column(i)) {
    Risks more;
    more.count = static_cast<std::size_t>(trials_.regular());
    more.trulyWithin = counted->trulyWithin;
    more.accepted = counted->accepted;
    more.falselyAccepted = counted->falselyAccepted;
    more.falselyRejected = counted->falselyRejected;
    risks.add(more);
  }
  return risks;
}

Risks Findings::guardedRisks(std::size_t i, const Tolerance& tolerance, const Tolerance& acceptance) const {
  Risks risks = risksOf(table_.values(i), table_.truths(i), tolerance, acceptance);
  if (const TrialSummary::Column* counted = column(i)) {
    const auto acceptedOf = [&](const ValueCells& cells) {
      Counted points;
      addPoints(points, cells, counted->values, trials_.grid()->columns[i].values.reference);
      std::uint64_t accepted = 0;
      for (const auto& [value, count] : points)
        accepted += acceptance.contains(value) ? count : 0;
      return accepted;
    };
    const std::uint64_t rightly = acceptedOf(counted->within);
    Risks more;
    more.count = static_cast<std::size_t>(trials_.regular());
    more.trulyWithin = counted->trulyWithin;
    more.falselyAccepted = acceptedOf(counted->beyond);
    more.accepted = rightly + more.falselyAccepted;
    more.falselyRejected = counted->trulyWithin - rightly;
    risks.add(more);
  }
  return risks;
}

std::optional<double> Findings::correlation(std::size_t a, std::size_t b) const {
  if (a > b) std::swap(a, b);
  std::vector<double> x, y;
  for (std::size_t k = 0; k < table_.size(); ++k) {
    if (std::isnan(table_.values(a)[k]) || std::isnan(table_.values(b)[k])) continue;
    x.push_back(table_.values(a)[k]);
    y.push_back(table_.values(b)[k]);
  }
  Pairs kept{study::momentsOf(x), study::momentsOf(y), 0};
  for (std::size_t k = 0; k < x.size(); ++k)
    kept.products += (x[k] - kept.a.mean) * (y[k] - kept.b.mean);
  Pairs pairs;
  if (column(a) != nullptr && column(b) != nullptr && b < trials_.grid()->correlated()) {
    const Grid::Scale &of = trials_.grid()->columns[a].values, &with = trials_.grid()->columns[b].values;
    pairs.a = momentsOf(column(a)->values, trials_.regular(), of);
    pairs.b = momentsOf(column(b)->values, trials_.regular(), with);
    const auto n = static_cast<long double>(trials_.regular());
    const long double products =
        static_cast<long double>(trials_.product(a, b)) -
        static_cast<long double>(column(a)->values.sum) * (static_cast<long double>(column(b)->values.sum) / n);
    pairs.products = static_cast<double>(of.step * (with.step * products));
  }
  pairs.add(kept);
  if (pairs.a.count < 2 || !(pairs.a.squares > 0) || !(pairs.b.squares > 0)) return std::nullopt;
  return std::clamp(pairs.products / std::sqrt(pairs.a.squares * pairs.b.squares), -1.0, 1.0);
}

}  // namespace probewright::study

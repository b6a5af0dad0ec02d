#include "study/trial_summary.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "study/crew.hpp"
#include "study/message.hpp"

namespace probewright::study {

namespace {

__extension__ using Unsigned = unsigned __int128;

constexpr double mostSteps = 70'368'744'177'664.0;  // 2^46: sums of squares of 2^34 trials fit 127 bits

Grid::Scale scaleOf(const std::vector<double>& values) {
  const Moments moments = momentsOf(values);
  Grid::Scale scale;
  if (!std::isfinite(moments.mean)) return scale;
  scale.reference = moments.mean;
  double spread = moments.deviation();
  // Results that stood still in the first trials, or varied in their last digits, may still vary later.
  const double least = std::max(std::abs(moments.mean), 1e-6) * 0x1p-40;
  if (!(spread > least) || !std::isfinite(spread)) spread = least;
  scale.step = std::exp2(std::floor(std::log2(spread)) - 30);
  return scale;
}

std::optional<std::int64_t> stepsOf(double value, const Grid::Scale& scale) {
  const double steps = (value - scale.reference) / scale.step;
  if (!(std::abs(steps) < mostSteps)) return std::nullopt;
  return std::llround(steps);
}

void addTo(TrialSummary::Sums& sums, std::int64_t steps, double value, bool first) {
  sums.sum += steps;
  sums.squares += static_cast<TrialSummary::Wide>(steps) * steps;
  sums.minimum = first ? value : std::min(sums.minimum, value);
  sums.maximum = first ? value : std::max(sums.maximum, value);
}

void mergeInto(TrialSummary::Sums& sums, const TrialSummary::Sums& other, bool first) {
  sums.sum += other.sum;
  sums.squares += other.squares;
  sums.minimum = first ? other.minimum : std::min(sums.minimum, other.minimum);
  sums.maximum = first ? other.maximum : std::max(sums.maximum, other.maximum);
}

/// Sums of a few thousand trials take few of their 16 bytes.
void putWide(std::string& message, TrialSummary::Wide value) {
  const bool negative = value < 0;
  auto rest = static_cast<Unsigned>(negative ? -value : value);
  std::string bytes;
  for (; rest != 0; rest >>= 8U)
    bytes += static_cast<char>(static_cast<unsigned char>(rest & 0xFFU));
  message += static_cast<char>(bytes.size() | (negative ? 0x80U : 0U));
  message += bytes;
}

TrialSummary::Wide getWide(MessageReading& reading) {
  const auto head = reading.get<std::uint8_t>();
  Unsigned value = 0;
  for (unsigned i = 0; i < (head & 0x1FU); ++i)
    value |= static_cast<Unsigned>(reading.get<std::uint8_t>()) << (8 * i);
  const auto wide = static_cast<TrialSummary::Wide>(value);
  return (head & 0x80U) != 0 ? -wide : wide;
}

void putSums(std::string& message, const TrialSummary::Sums& sums) {
  putWide(message, sums.sum);
  putWide(message, sums.squares);
  put(message, sums.minimum);
  put(message, sums.maximum);
}

TrialSummary::Sums getSums(MessageReading& reading) {
  TrialSummary::Sums sums;
  sums.sum = getWide(reading);
  sums.squares = getWide(reading);
  sums.minimum = reading.get<double>();
  sums.maximum = reading.get<double>();
  return sums;
}

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

std::shared_ptr<const Grid> gridOf(const TrialTable& first, const LimitsOf& limitsOf) {
  auto grid = std::make_shared<Grid>();
  for (std::size_t i = 0; i < first.characteristics().size(); ++i) {
    Grid::Column column;
    column.of = first.characteristics()[i];
    const std::vector<double>&values = first.values(i), &truths = first.truths(i);
    column.values = scaleOf(present(values));
    column.hasTruth = !truths.empty();
    std::vector<double> errors;
    for (std::size_t k = 0; k < values.size() && column.hasTruth; ++k) {
      if (std::isnan(values[k])) continue;
      column.hasTruth = !std::isnan(truths[k]);
      errors.push_back(values[k] - truths[k]);
    }
    if (column.hasTruth) column.errors = scaleOf(errors);
    column.tolerance = limitsOf(column.of);
    grid->columns.push_back(std::move(column));
  }
  return grid;
}

TrialSummary::TrialSummary(std::shared_ptr<const Grid> grid) : grid_(std::move(grid)) {
  if (!grid_) return;
  columns_.resize(grid_->columns.size());
  products_.resize(grid_->correlated() * grid_->correlated());
}

/// Counts a trial that fits the grid.
bool TrialSummary::count(const Outcome& outcome) {
  if (!grid_ || outcome.end != TrialEnd::Finished || outcome.observations.size() != columns_.size()) return false;
  steps_.clear();
  counted_.clear();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Grid::Column& column = grid_->columns[i];
    // Most trials answer in the order of those before.
    std::size_t place = i;
    while (place < columns_.size() && outcome.observations[place].of.key != column.of.key)
      ++place;
    if (place == columns_.size()) place = 0;
    while (place < i && outcome.observations[place].of.key != column.of.key)
      ++place;
    const Observation& observation = outcome.observations[place];
    if (observation.of.key != column.of.key || observation.truth.has_value() != column.hasTruth) return false;
    counted_.push_back(&observation);
    const auto value = stepsOf(observation.value, column.values);
    const auto error = column.hasTruth ? stepsOf(observation.value - *observation.truth, column.errors)
                                       : std::optional<std::int64_t>(0);
    if (!value || !error) return false;
    steps_.push_back(*value);
    steps_.push_back(*error);
  }
  const bool first = regular_ == 0;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Observation& observation = *counted_[i];
    const Grid::Column& column = grid_->columns[i];
    Column& sums = columns_[i];
    addTo(sums.values, steps_[2 * i], observation.value, first);
    bool within = true;
    if (column.hasTruth) {
      const double error = observation.value - *observation.truth;
      addTo(sums.errors, steps_[2 * i + 1], error, first);
      sums.errorCells.add(error - column.errors.reference);
      const double truth = *observation.truth;
      sums.leastTruth = first ? truth : std::min(sums.leastTruth, truth);
      sums.greatestTruth = first ? truth : std::max(sums.greatestTruth, truth);
      if (column.tolerance) {
        within = column.tolerance->contains(*observation.truth);
        const bool accepted = column.tolerance->contains(observation.value);
        sums.trulyWithin += within ? 1 : 0;
        sums.accepted += accepted ? 1 : 0;
        sums.falselyAccepted += accepted && !within ? 1 : 0;
        sums.falselyRejected += !accepted && within ? 1 : 0;
      }
    }
    (within ? sums.within : sums.beyond).add(observation.value - column.values.reference);
  }
  const std::size_t correlated = grid_->correlated();
  for (std::size_t a = 0; a < correlated; ++a)
    for (std::size_t b = a; b < correlated; ++b)
      products_[a * correlated + b] += static_cast<Wide>(steps_[2 * a]) * steps_[2 * b];
  ++regular_;
  return true;
}

void TrialSummary::add(std::uint64_t trial, Outcome outcome) {
  if (!count(outcome)) rows_.emplace_back(trial, std::move(outcome));
}

void TrialSummary::merge(const TrialSummary& other) {
  rows_.insert(rows_.end(), other.rows_.begin(), other.rows_.end());
  if (other.regular_ == 0) return;
  if (!grid_) {
    std::vector<Row> rows = std::move(rows_);
    *this = TrialSummary(other.grid_);
    rows_ = std::move(rows);
  }
  const bool first = regular_ == 0;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Column& mine = columns_[i];
    const Column& more = other.columns_[i];
    mergeInto(mine.values, more.values, first);
    mergeInto(mine.errors, more.errors, first);
    mine.within.merge(more.within);
    mine.beyond.merge(more.beyond);
    mine.errorCells.merge(more.errorCells);
    mine.leastTruth = first ? more.leastTruth : std::min(mine.leastTruth, more.leastTruth);
    mine.greatestTruth = first ? more.greatestTruth : std::max(mine.greatestTruth, more.greatestTruth);
    mine.trulyWithin += more.trulyWithin;
    mine.accepted += more.accepted;
    mine.falselyAccepted += more.falselyAccepted;
    mine.falselyRejected += more.falselyRejected;
  }
  for (std::size_t i = 0; i < products_.size(); ++i)
    products_[i] += other.products_[i];
  regular_ += other.regular_;
}

std::string TrialSummary::message() const {
  std::string message;
  std::vector<Outcome> outcomes;
  putCount(message, rows_.size());
  for (const auto& [trial, outcome] : rows_) {
    putCount(message, trial);
    outcomes.push_back(outcome);
  }
  put(message, OutcomeWriter().write(outcomes));
  putCount(message, regular_);
  if (regular_ == 0) return message;
  putCount(message, columns_.size());
  for (const Column& column : columns_) {
    putSums(message, column.values);
    putSums(message, column.errors);
    for (const ValueCells* cells : {&column.within, &column.beyond, &column.errorCells})
      cells->put(message);
    put(message, column.leastTruth);
    put(message, column.greatestTruth);
    for (const std::uint64_t count :
         {column.trulyWithin, column.accepted, column.falselyAccepted, column.falselyRejected})
      putCount(message, count);
  }
  const std::size_t correlated = grid_->correlated();
  for (std::size_t a = 0; a < correlated; ++a)
    for (std::size_t b = a; b < correlated; ++b)
      putWide(message, products_[a * correlated + b]);
  return message;
}

TrialSummary TrialSummary::read(const std::string& message, std::shared_ptr<const Grid> grid) {
  MessageReading reading(message);
  TrialSummary read(std::move(grid));
  std::vector<std::uint64_t> trials(reading.count());
  for (std::uint64_t& trial : trials)
    trial = reading.count();
  std::vector<Outcome> outcomes = OutcomeReader().read(reading.text());
  if (outcomes.size() != trials.size()) throw std::runtime_error("a message between ranks is not whole");
  for (std::size_t i = 0; i < trials.size(); ++i)
    read.rows_.emplace_back(trials[i], std::move(outcomes[i]));
  read.regular_ = reading.count();
  if (read.regular_ == 0) return read;
  if (reading.count() != read.columns_.size()) throw std::runtime_error("ranks disagree on the results of a study");
  for (Column& column : read.columns_) {
    column.values = getSums(reading);
    column.errors = getSums(reading);
    for (ValueCells* cells : {&column.within, &column.beyond, &column.errorCells})
      *cells = ValueCells::get(reading);
    column.leastTruth = reading.get<double>();
    column.greatestTruth = reading.get<double>();
    for (std::uint64_t* count :
         {&column.trulyWithin, &column.accepted, &column.falselyAccepted, &column.falselyRejected})
      *count = reading.count();
  }
  const std::size_t correlated = read.grid_->correlated();
  for (std::size_t a = 0; a < correlated; ++a)
    for (std::size_t b = a; b < correlated; ++b)
      read.products_[a * correlated + b] = getWide(reading);
  return read;
}

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

Risks Findings::risks(std::size_t i, const Tolerance& tolerance, const Tolerance& acceptance, bool exactly) const {
  Risks risks = risksOf(table_.values(i), table_.truths(i), tolerance, acceptance);
  if (const TrialSummary::Column* counted = column(i)) {
    Risks more;
    more.count = static_cast<std::size_t>(trials_.regular());
    more.trulyWithin = counted->trulyWithin;
    more.accepted = counted->accepted;
    more.falselyAccepted = counted->falselyAccepted;
    more.falselyRejected = counted->falselyRejected;
    if (!exactly) {
      const auto acceptedOf = [&](const ValueCells& cells) {
        Counted points;
        addPoints(points, cells, counted->values, trials_.grid()->columns[i].values.reference);
        std::uint64_t accepted = 0;
        for (const auto& [value, count] : points)
          accepted += acceptance.contains(value) ? count : 0;
        return accepted;
      };
      const std::uint64_t rightly = acceptedOf(counted->within);
      more.falselyAccepted = acceptedOf(counted->beyond);
      more.accepted = rightly + more.falselyAccepted;
      more.falselyRejected = counted->trulyWithin - rightly;
    }
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

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

}  // namespace probewright::study

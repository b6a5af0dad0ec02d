#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/conformity.hpp"
#include "study/trial.hpp"
#include "study/value_cells.hpp"

/// What trials say together, in few bytes and in whole numbers: parts of the trials may be added up in any order, on
/// any thread or rank, and give the same bits.
namespace probewright::study {

/// What the first trials tell of those to come: which results there are, where they lie and how far they vary.
struct Grid {
  /// Moments are counted in steps of 2^-30 of the power of two below the standard deviation of the first trials.
  struct Scale {
    double reference = 0, step = 1;
  };
  struct Column {
    Characteristic of;
    Scale values, errors;
    bool hasTruth = false;  ///< each of the first trials knows the true value
    std::optional<Tolerance> tolerance;
  };
  std::vector<Column> columns;

  /// Correlations are of the first so many results.
  static constexpr std::size_t mostCorrelated = 200;
  std::size_t correlated() const { return std::min(columns.size(), mostCorrelated); }
};
using LimitsOf = std::function<std::optional<Tolerance>(const Characteristic&)>;
std::shared_ptr<const Grid> gridOf(const TrialTable& first, const LimitsOf& limitsOf);

/// The sum of trials. A trial that does not fit the grid (an alarm, results that come or go, a value farther than
/// 65,536 standard deviations away) is kept whole.
class TrialSummary {
public:
  using Row = std::pair<std::uint64_t, Outcome>;  ///< the number of the trial, what it answered
  __extension__ using Wide = __int128;

  TrialSummary() = default;
  explicit TrialSummary(std::shared_ptr<const Grid> grid);

  void add(std::uint64_t trial, Outcome outcome);
  /// Of the same grid, or of none.
  void merge(const TrialSummary& other);

  std::uint64_t size() const { return regular_ + rows_.size(); }
  /// Trials that are counted and not kept.
  std::uint64_t regular() const { return regular_; }
  /// Those that are kept whole, in no order.
  const std::vector<Row>& rows() const { return rows_; }
  const std::shared_ptr<const Grid>& grid() const { return grid_; }

  std::string message() const;
  /// Throws what is not a message, or not of this grid.
  static TrialSummary read(const std::string& message, std::shared_ptr<const Grid> grid);

  /// One of values or errors of a result in the trials that are counted.
  struct Sums {
    Wide sum = 0, squares = 0;  ///< of distances from the reference, in steps
    double minimum = 0, maximum = 0;
  };
  struct Column {
    Sums values, errors;
    ValueCells within, beyond;  ///< values; beyond: of items whose true value is beyond the tolerance
    ValueCells errorCells;
    double leastTruth = 0, greatestTruth = 0;
    /// Against the tolerance itself.
    std::uint64_t trulyWithin = 0, accepted = 0, falselyAccepted = 0, falselyRejected = 0;
  };
  const std::vector<Column>& columns() const { return columns_; }
  /// The sum of products of two of the correlated results, a <= b, in steps of both.
  Wide product(std::size_t a, std::size_t b) const { return products_[a * grid_->correlated() + b]; }

private:
  bool count(const Outcome& outcome);

  std::shared_ptr<const Grid> grid_;
  std::uint64_t regular_ = 0;
  std::vector<Column> columns_;
  std::vector<Wide> products_;
  std::vector<Row> rows_;
  // Of the trial that is being added, by columns.
  std::vector<std::int64_t> steps_;
  std::vector<const Observation*> counted_;
};

}  // namespace probewright::study

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "study/trial_summary.hpp"

namespace probewright::study {

/// What a sum of trials says of each result.
class Findings {
public:
  Findings(const TrialSummary& trials, const Sampler& sampler);

  std::size_t size() const { return static_cast<std::size_t>(trials_.size()); }
  const std::vector<Characteristic>& characteristics() const { return table_.characteristics(); }
  /// Trials that are kept whole, in their order: all that were stopped are among them.
  const TrialTable& kept() const { return table_; }
  std::size_t finished() const;

  /// Trials that came to the result.
  std::uint64_t count(std::size_t i) const;
  Summary values(std::size_t i, double coverage) const;
  Histogram histogram(std::size_t i) const;
  /// True if the true value is known wherever there is a measured one.
  bool truthIsKnown(std::size_t i) const;
  /// Of measured less true value; nothing unless the true value is known wherever there is a measured one.
  std::optional<Summary> errors(std::size_t i, double coverage) const;
  /// Where errors() are known.
  Histogram errorHistogram(std::size_t i) const;
  /// Mean of the true values where errors() are known, the least and the greatest of them.
  struct Truths {
    double mean = 0, least = 0, greatest = 0;
    bool vary() const { return least < greatest; }
  };
  Truths truths(std::size_t i) const;
  /// Of accepting what lies within the tolerance: exact counts.
  Risks risks(std::size_t i, const Tolerance& tolerance) const;
  /// Of accepting what lies in `acceptance`, a part of the tolerance; counts of a summary as exact as its cells.
  Risks guardedRisks(std::size_t i, const Tolerance& tolerance, const Tolerance& acceptance) const;
  /// Of trials that came to both; nothing where one of them does not vary.
  std::optional<double> correlation(std::size_t a, std::size_t b) const;

private:
  const TrialSummary::Column* column(std::size_t i) const;
  std::vector<double> keptErrors(std::size_t i) const;
  std::vector<double> keptTruths(std::size_t i) const;

  const TrialSummary& trials_;
  TrialTable table_;
};

}  // namespace probewright::study

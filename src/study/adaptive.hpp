#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "study/statistics.hpp"

namespace probewright::study {

/// The tolerance of a standard uncertainty that is to be stated with `digits` significant digits: half a unit of the
/// last one (JCGM 101:2008, 7.9.2).
double numericalTolerance(double standardUncertainty, int digits);

/// Whether blocks of trials agree well enough for the digits that are asked for (JCGM 101:2008, 7.9.4).
class Stability {
public:
  Stability(int digits, double coverage) : digits_(digits), coverage_(coverage) {}

  /// The values of the next block of trials.
  void add(std::span<const double> block);
  void add(const Summary& block);

  /// Of the blocks so far.
  const std::vector<Summary>& blocks() const { return blocks_; }

  /// Twice the standard deviation of the averages of mean, standard uncertainty and both ends of the coverage interval
  /// is at most the tolerance. False before the second block. What stands still, or
  /// differs by 1e-12 (of values above 1: of the value), is stable.
  bool stable() const;

  /// How far from stable: the largest of these deviations, over the tolerance. 1 or less is stable; infinity before the
  /// second block.
  double excess() const;

private:
  int digits_;
  double coverage_;
  std::vector<Summary> blocks_;
};

}  // namespace probewright::study

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/journal.hpp"
#include "records/truth.hpp"
#include "truth/touched_points.hpp"

/// The features that a cycle has touched, measured twice: from the points as the control believes them, and as they
/// truly are.
namespace probewright::truth {

/// One way to come from touches to a value. A result is explained by it where the believed value is the result; its
/// true value is then the one that the same way gives on the true feature.
struct Explanation {
  double believed = 0;
  double truth = 0;
  records::TruthBasis basis = records::TruthBasis::Face;
  std::string shape;
};

class Features;

/// The features of one cycle, for several questions: what was found of them is kept. Cycle and fits outlive it.
class CycleFeatures {
public:
  CycleFeatures(const TouchedCycle& cycle, const std::vector<control::FitRecord>& fits);
  ~CycleFeatures();

  /// All ways that could lead from the touches to a value of this characteristic.
  std::vector<Explanation> explanations(const control::Characteristic& of) const;

private:
  std::unique_ptr<const Features> features_;
};

/// The same for a single question.
std::vector<Explanation> explanations(const control::Characteristic& of, const TouchedCycle& cycle,
                                      const std::vector<control::FitRecord>& fits);

}  // namespace probewright::truth

#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/capability.hpp"
#include "study/conformity.hpp"
#include "study/crew.hpp"
#include "study/first_order_trials.hpp"
#include "study/sensitivity.hpp"
#include "study/statistics.hpp"
#include "study/study.hpp"
#include "study/trial.hpp"
#include "study/trial_course.hpp"

/// A whole study: trials until the digits are stable, and what they say.
namespace probewright::study {

/// What the study says of one result: what a measured value is worth, and how measured values spread over the trials.
/// Both are the same where no true value is known, or always the same one.
struct Answer {
  Characteristic of;
  std::optional<double> estimate;  ///< of the trial in which every source is at its estimate, without random effects
  bool stable = false;             ///< to the digits that were asked for

  // How measured values spread: what the true ones vary by is in it.
  Summary values;
  Histogram histogram;

  // Where the true value is known.
  std::optional<Findings::Truths> truths;
  std::optional<Summary> error;  ///< of measured less true value: its mean is the bias
  std::optional<Histogram> errorHistogram;

  // What a measured value is worth. Where the truth is known that of the errors, else of the values; NaN of one trial.
  double standardUncertainty = 0;
  /// The true value that is likely behind the estimate lies in there: of the estimate less the errors, so the bias is
  /// corrected; where no truth is known, of the values.
  std::optional<Interval> symmetric, shortest;
  /// The estimate less the bias.
  std::optional<double> corrected;

  // Where the result has limits.
  std::optional<Tolerance> tolerance;
  double guardBand = 0;
  std::optional<double> conformance;  ///< probability that the item behind the estimate is within (JCGM 106)
  std::optional<Decision> decision;   ///< on the corrected estimate, by ISO 14253-1
  std::optional<Risks> risks;         ///< of accepting whatever is measured within the tolerance
  std::optional<Risks> guardedRisks;  ///< of accepting what is measured within the tolerance less the guard bands

  std::vector<Contribution> contributions;           ///< of each unit of the sampler; empty if not asked for
  std::vector<std::optional<SobolIndices>> indices;  ///< likewise
  std::optional<FirstOrderVerdict> firstOrder;       ///< where the scatter of the probe is known to first order
  std::optional<Type1> type1;
  std::optional<GaugeRR> gauge;
};

/// The range that a source was drawn from in all trials, in ten parts of the same width: how many trials lie in each.
struct Tenths {
  double low = 0, high = 0;
  std::array<std::uint64_t, 10> stopped{}, trials{};

  std::size_t placeOf(double value) const;
};

/// An alarm, and where the sources stood when it came.
struct Stop {
  std::string why;
  std::size_t count = 0;
  Interval probability;              ///< Clopper and Pearson, 95 %
  std::vector<Summary> sources;      ///< of each source, in the trials that it has stopped
  std::vector<Tenths> tenths;        ///< likewise
  std::vector<std::uint64_t> first;  ///< the first trials, at most ten
};

struct StudyResult {
  Study study;
  std::vector<Sampler::Unit> units;
  StudyEnd end = StudyEnd::AllTrials;
  std::size_t trials = 0, finished = 0;
  std::vector<Answer> answers;
  std::vector<std::size_t> correlated;  ///< answers that vary, whose correlations are below
  std::vector<std::vector<std::optional<double>>> correlation;
  std::vector<Stop> stops;
  Diagnostics diagnostics;  ///< what a reader should know: measurands that no result fits...
};

struct StudyRun : CourseRun {
  Crew crew = {};                            ///< none: the threads of all cores, until `stop`
  std::optional<std::uint64_t> repeat = {};  ///< type-1 study with so many repeats of the estimates
};

StudyResult runStudy(const Study& study, const toml::table& setup, const Model& model, const StudyRun& run);

}  // namespace probewright::study

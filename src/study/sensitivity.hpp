#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/crew.hpp"
#include "study/trial.hpp"

/// How much of the uncertainty of a result each source brings.
namespace probewright::study {

/// What one source, or a group of them, does to one result while all others stand at their estimates.
struct Contribution {
  std::optional<double> sensitivity;  ///< dy/dx, the slope of the best straight line; of single sources only
  std::optional<double> uncertainty;  ///< standard deviation of the result; nothing if it had no two values
};

/// Sobol's indices of one source or group on one result (Saltelli and others 2010), with the half-widths of their 95 %
/// intervals by the central limit theorem.
struct SobolIndices {
  double first = 0, firstHalfWidth = 0;  ///< the share of the variance that goes if the source alone were known
  double total = 0, totalHalfWidth = 0;  ///< the share that remains if all others were known
};

/// Told of how many trials there are and how many are done.
using Progress = std::function<void(std::uint64_t done, std::uint64_t of)>;

struct RunSettings {
  Crew crew;
  Progress progress;
};

/// One-at-a-time: [characteristic][unit of the sampler]. `characteristics` by key; nothing if the study was stopped.
std::optional<std::vector<std::vector<Contribution>>> oneAtATime(const Model& model, const Sampler& sampler,
                                                                 const std::vector<Characteristic>& characteristics,
                                                                 std::uint64_t trials, const RunSettings& settings);

/// First-order and total indices: [characteristic][unit]; nothing for results whose variance is 0 or of which fewer
/// than 10 sets of trials are complete. Takes trials * (units + 2) runs. Nothing at all if the study was stopped.
std::optional<std::vector<std::vector<std::optional<SobolIndices>>>> sobolIndices(
    const Model& model, const Sampler& sampler, const std::vector<Characteristic>& characteristics,
    std::uint64_t trials, const RunSettings& settings);

}  // namespace probewright::study

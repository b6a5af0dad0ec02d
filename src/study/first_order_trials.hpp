#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "study/sensitivity.hpp"

/// Trials against the law of propagation of uncertainty: is what it says of the scatter of the probe alone true?
namespace probewright::study {

/// Whether trials agree to 5 % with the uncertainty that the scatter of the probe has to first order. Both answers are
/// sure to three standard deviations of what so many trials tell.
enum class FirstOrderVerdict {
  Holds,
  Differs,
  Unclear,  ///< nearer to 5 % than the trials can tell
};

/// Of the values of one result: how a standard uncertainty compares with their standard deviation s, which n values
/// tell to s * root((k - 1) / 4n), where k is their kurtosis (3 of a normal distribution: s / root(2n)).
FirstOrderVerdict compareWithFirstOrder(const std::vector<double>& values, double firstOrder);

/// Trials in which nothing varies but the random effects of the machine, `batch` after `batch` until the verdict on
/// each result is clear, ten of them at most. Nothing of results whose uncertainty is not known to first order, or that
/// came in fewer than two trials; nothing at all if stopped.
std::optional<std::vector<std::optional<FirstOrderVerdict>>> compareWithFirstOrder(
    const Model& model, const Sampler& sampler, const std::vector<Characteristic>& characteristics, std::uint64_t batch,
    const RunSettings& settings);

}  // namespace probewright::study

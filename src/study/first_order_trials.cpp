#include "study/first_order_trials.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "study/statistics.hpp"

namespace probewright::study {

namespace {

constexpr double tolerated = 0.05;
constexpr double sure = 3;  // standard deviations
constexpr std::uint64_t mostBatches = 10;

}  // namespace

FirstOrderVerdict compareWithFirstOrder(const std::vector<double>& values, double firstOrder) {
  const Moments moments = momentsOf(values);
  const double count = moments.count, deviation = moments.deviation();
  if (!(deviation > 0)) return firstOrder > 0 ? FirstOrderVerdict::Differs : FirstOrderVerdict::Holds;
  double kurtosis = 0;
  for (const double value : values)
    kurtosis += std::pow((value - moments.mean) / deviation, 4) / count;
  const double unsure = sure * std::sqrt(std::max(kurtosis - 1, 0.0) / (4 * count));
  const double apart = std::abs(firstOrder / deviation - 1);
  if (apart + unsure <= tolerated) return FirstOrderVerdict::Holds;
  return apart - unsure > tolerated ? FirstOrderVerdict::Differs : FirstOrderVerdict::Unclear;
}

std::optional<std::vector<std::optional<FirstOrderVerdict>>> compareWithFirstOrder(
    const Model& model, const Sampler& sampler, const std::vector<Characteristic>& characteristics, std::uint64_t batch,
    const RunSettings& settings) {
  std::vector<std::optional<FirstOrderVerdict>> verdicts(characteristics.size());
  std::map<std::string, std::vector<double>> values;
  for (const Characteristic& each : characteristics)
    if (each.firstOrder) values[each.key];
  constexpr std::size_t stretch = 256;
  std::vector<Draw> draws;
  for (std::uint64_t count = 0; count < mostBatches * batch && !values.empty(); count += batch) {
    for (std::uint64_t begin = count; begin < count + batch; begin += stretch) {
      draws.clear();
      for (std::uint64_t i = begin; i < std::min(begin + stretch, count + batch); ++i) {
        draws.push_back(sampler.estimate());
        draws.back().trial = i;
        draws.back().noise = sampler.draw(i, Purpose::OneAtATime).noise;
      }
      const std::vector<Outcome> outcomes = settings.crew(model, draws);
      if (outcomes.size() < draws.size()) return std::nullopt;
      for (const Outcome& outcome : outcomes)
        for (const Observation& observation : outcome.observations)
          if (const auto found = values.find(observation.of.key);
              found != values.end() && !std::isnan(observation.value))
            found->second.push_back(observation.value);
      if (settings.progress) settings.progress(begin + draws.size(), mostBatches * batch);
    }
    bool clear = true;
    for (std::size_t i = 0; i < characteristics.size(); ++i) {
      if (!characteristics[i].firstOrder) continue;
      const std::vector<double>& came = values[characteristics[i].key];
      if (came.size() < 2) continue;
      verdicts[i] = compareWithFirstOrder(came, *characteristics[i].firstOrder);
      clear = clear && verdicts[i] != FirstOrderVerdict::Unclear;
    }
    if (clear) break;
  }
  return verdicts;
}

}  // namespace probewright::study

#include "study/measurands.hpp"

#include <algorithm>

namespace probewright::study {

bool means(const std::string& result, const std::string& key) {
  return key == result ||
         (key.size() > result.size() && key.ends_with(result) && key[key.size() - result.size() - 1] == ' ');
}

const Measurand* Measurands::of(const std::string& key) const {
  const auto exact = std::ranges::find(study_.measurands, key, &Measurand::result);
  if (exact != study_.measurands.end()) return &*exact;
  for (const Measurand& measurand : study_.measurands)
    if (means(measurand.result, key)) return &measurand;
  return nullptr;
}

std::optional<double> Measurands::truthAt(const Measurand& measurand, const std::vector<double>& inputs) const {
  if (!measurand.truth) return std::nullopt;
  std::optional<double> number;
  for (std::size_t i = 0; i < study_.sources.size() && !number; ++i)
    if (study_.sources[i].quantity.text() == measurand.truth->text()) number = inputs[i];
  if (!number) number = measurand.truth->numberIn(setup_);
  return number ? std::optional(measurand.factor * *number + measurand.offset) : std::nullopt;
}

std::optional<double> Measurands::truthAt(const std::string& key, const std::vector<double>& inputs) const {
  const Measurand* measurand = of(key);
  return measurand == nullptr ? std::nullopt : truthAt(*measurand, inputs);
}

Characteristic Measurands::limited(Characteristic characteristic) const {
  if (const Measurand* measurand = of(characteristic.key)) {
    if (measurand->lower) characteristic.lower = measurand->lower;
    if (measurand->upper) characteristic.upper = measurand->upper;
  }
  return characteristic;
}

Outcome Measurands::withTruths(Outcome outcome, const std::vector<double>& inputs) const {
  if (study_.measurands.empty()) return outcome;
  for (Observation& observation : outcome.observations)
    if (const auto truth = truthAt(observation.of.key, inputs)) observation.truth = truth;
  return outcome;
}

std::optional<Tolerance> toleranceOf(const Characteristic& characteristic) {
  if (!characteristic.lower && !characteristic.upper) return std::nullopt;
  return Tolerance{characteristic.lower, characteristic.upper};
}

}  // namespace probewright::study

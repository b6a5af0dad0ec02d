#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/conformity.hpp"
#include "study/trial.hpp"

namespace probewright::study {

/// True if a study file that says `result` means the result with this key: the key itself, or its end after a blank,
/// "Q153" of "421@23 Q153".
bool means(const std::string& result, const std::string& key);

/// What a study says of results: their true values and their limits.
class Measurands {
public:
  Measurands(const Study& study, const toml::table& setup) : study_(study), setup_(setup) {}

  /// Null if the study says nothing of it.
  const Measurand* of(const std::string& key) const;

  /// Nothing if the study does not name the true value.
  std::optional<double> truthAt(const Measurand& measurand, const std::vector<double>& inputs) const;
  std::optional<double> truthAt(const std::string& key, const std::vector<double>& inputs) const;

  /// The characteristic with the limits of the study in place of those of the program.
  Characteristic limited(Characteristic characteristic) const;

  /// The outcome with the true values of the study in place of those that the virtual machine knows.
  Outcome withTruths(Outcome outcome, const std::vector<double>& inputs) const;

private:
  const Study& study_;
  const toml::table& setup_;
};

/// Nothing if it has no limits.
std::optional<Tolerance> toleranceOf(const Characteristic& characteristic);

}  // namespace probewright::study

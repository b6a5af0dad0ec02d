#pragma once

#include "execution/klartext/run_context.hpp"

namespace probewright::execution::klartext {

/// Q, QL, QR and QS parameters of the program under way. Throws Alarm for numbers that do not exist, and for values of
/// the wrong kind.
class Parameters {
public:
  explicit Parameters(RunContext& run) : run_(run), control_(run.control) {}

  Value read(const VariableRef& variable) const;
  void write(const VariableRef& variable, const Value& value);
  bool isDefined(const VariableRef& variable) const;
  /// FN 0: Q5 SET UNDEFINED.
  void setUndefined(const VariableRef& variable);

  /// The parameter that a text names: "Q5", "QL3", "QS1", with or without a plus.
  Value readNamed(std::string_view name) const;
  double numberNamed(std::string_view name) const;

private:
  std::optional<double>& local(const VariableRef& variable) const;

  RunContext& run_;
  control::heidenhain::Control& control_;
};

}  // namespace probewright::execution::klartext

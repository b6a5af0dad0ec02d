#pragma once

#include <Eigen/Core>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cycles/heidenhain/registry.hpp"

/// What does not go together in one call, as far as its values are known before the program runs.
namespace probewright::cycles::heidenhain {

/// The value of a parameter, its default where it is left out; nothing if the program computes it.
using KnownValue = std::function<std::optional<Argument>(std::uint32_t address)>;

struct CallMistake {
  std::uint32_t parameter = 0;  ///< the one to look at
  Severity severity = Severity::Error;
  std::string message, advice;
  /// Of zeros, as manuals print a block that is not filled in yet: the run refuses it, a reader need not be told.
  bool isBlank = false;
  std::string alarm;  ///< with which the run refuses the call as it begins; empty: the cycle has words of its own
};

/// What a cycle's own rules look at and complain to (Entry::rules).
class CallRules {
public:
  CallRules(const CycleDefinition& cycle, ControlKind kind, const KnownValue& known)
      : cycle_(cycle), kind_(kind), known_(known) {}

  ControlKind kind() const { return kind_; }
  bool has(std::uint32_t address) const { return cycle_.parameter(address) != nullptr; }
  std::optional<Argument> value(std::uint32_t address) const;
  /// Its number, where it is known and one.
  std::optional<double> number(std::uint32_t address) const;
  /// The numbers of several parameters in this order, where all of them are known.
  std::optional<Eigen::VectorXd> numbers(std::initializer_list<std::uint32_t> addresses) const;

  void add(std::uint32_t parameter, std::string message, std::string advice, Severity severity = Severity::Error);
  /// An error that is the alarm of the run, too.
  void refuse(std::string alarm, std::uint32_t parameter, std::string message, std::string advice);
  /// The same about several parameters, the last of them to be looked at; blank where all are 0.
  void refuseUnlessBlank(std::string alarm, std::initializer_list<std::uint32_t> parameters, std::string message,
                         std::string advice);
  /// A lower limit above the upper one means something in this cycle.
  void allowCrossedLimits() { crossedLimits_ = true; }

  bool crossedLimitsAllowed() const { return crossedLimits_; }
  std::vector<CallMistake> take() { return std::move(mistakes_); }

private:
  const CycleDefinition& cycle_;
  ControlKind kind_;
  const KnownValue& known_;
  bool crossedLimits_ = false;
  std::vector<CallMistake> mistakes_;
};

/// Errors are what a run refuses before it touches anything; limits that nothing can keep are warnings.
std::vector<CallMistake> callMistakes(const CycleDefinition& cycle, ControlKind kind, const KnownValue& known);

/// Coordinate transformations that a cycle of the TNC 640 does not run under.
struct ForbiddenTransformations {
  bool shift = false;     ///< cycle 7, TRANS DATUM
  bool rotation = false;  ///< cycle 10
  bool other = false;     ///< cycles 8, 11 and 26
};
ForbiddenTransformations forbiddenTransformations(const Conditions& conditions);

/// "datum shift, mirror image or scaling is active (cycle 7, 8, 11 or 26)".
std::string transformationsText(const ForbiddenTransformations& forbidden);

}  // namespace probewright::cycles::heidenhain

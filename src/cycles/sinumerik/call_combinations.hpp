#pragma once

#include <cstdlib>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "cycles/sinumerik/call_requirements.hpp"

/// What a call says with several arguments together: limits that are crossed, points that lie on one line.
namespace probewright::cycles::sinumerik {

/// An argument as far as it is known before the run.
struct KnownArgument {
  bool given = false;
  std::optional<double> number;  ///< left out: its standard value
  std::optional<std::string> text;
};

struct CombinationComplaint {
  std::string_view parameter;  ///< where to point to
  CallComplaint complaint;
};

/// A call as the cycle's own combinations look at it (Entry::combinations).
class CallCombinations {
public:
  CallCombinations(const CycleDefinition& cycle, int code,
                   const std::function<KnownArgument(std::string_view)>& argument)
      : cycle_(cycle), code_(code), argument_(argument) {}

  /// A digit of S_MVAR, from the right from 1.
  int digit(int place) const { return variant::digit(std::abs(code_), place); }
  bool has(std::string_view name) const;
  KnownArgument argument(std::string_view name) const { return argument_(name); }
  std::optional<double> number(std::string_view name) const { return argument_(name).number; }
  /// The units of _AMODE are 1: upper and lower limit of the tolerance count for themselves.
  bool asymmetric() const;

  void refuse(std::string_view parameter, std::string text);
  void warn(std::string_view parameter, std::string text);

  std::vector<CombinationComplaint> take() { return std::move(found_); }

private:
  const CycleDefinition& cycle_;
  int code_;
  const std::function<KnownArgument(std::string_view)>& argument_;
  std::vector<CombinationComplaint> found_;
};

/// What the cycle refuses before it moves, or does hardly as meant. `argument` tells what is known of a parameter.
/// Whatever is not known passes.
std::vector<CombinationComplaint> combinationComplaints(const CycleDefinition& cycle, int variant,
                                                        const std::function<KnownArgument(std::string_view)>& argument);

}  // namespace probewright::cycles::sinumerik

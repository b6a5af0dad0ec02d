#pragma once

#include <functional>
#include <optional>
#include <string_view>
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

/// What the cycle refuses before it moves, or does hardly as meant. `argument` tells what is known of a parameter.
/// Whatever is not known passes.
std::vector<CombinationComplaint> combinationComplaints(const CycleDefinition& cycle, int variant,
                                                        const std::function<KnownArgument(std::string_view)>& argument);

}  // namespace probewright::cycles::sinumerik

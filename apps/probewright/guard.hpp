#pragma once

#include <functional>

namespace probewright::app {

/// Runs a subcommand and returns its exit code. What the subcommand throws is an error inside Probewright: it is named
/// on standard error, and the exit code is 4.
int guarded(const std::function<int()>& command);

}  // namespace probewright::app

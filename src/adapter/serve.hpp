#pragma once

#include <string>

#include "adapter/line_stream.hpp"
#include "machine/machine.hpp"

namespace probewright::adapter {

/// The adapter's side of the protocol for any machine: answers the engine at the other end until it hangs up, or does
/// not keep to the protocol. Says that it is alive while the machine works, and hands stops over to it.
void serve(machine::Machine& machine, const std::string& adapterName, LineStream stream);

}  // namespace probewright::adapter

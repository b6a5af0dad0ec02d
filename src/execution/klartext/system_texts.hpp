#pragma once

#include <string>

#include "execution/klartext/run_context.hpp"

namespace probewright::execution::klartext {

/// SYSSTR: data of the control as texts. Throws Alarm for what the control does not have; docs/klartext.md lists what
/// it has.
Value systemText(const RunContext& run, int id, int number, int index);

/// CFGREAD: language and unit of the control, the axes it shows, and the parameters of docs/machine-parameters.md by
/// their names.
Value configuration(const RunContext& run, const std::string& object, const std::string& attribute, int index);

}  // namespace probewright::execution::klartext

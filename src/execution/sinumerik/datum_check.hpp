#pragma once

#include <span>
#include <string_view>

#include "control/sinumerik/data_store.hpp"
#include "execution/names.hpp"
#include "language/value.hpp"

namespace probewright::execution::sinumerik {

/// Refuses indices that the control has no datum for, and values of the wrong kind: of tool data, frames of data
/// management and data of the measuring cycles. `value`: what is to be written; null if the datum is read. Throws Alarm
/// 12400 (indices are missing), 17020, 17030 (out of range) or 12150 (text in place of a number).
void requireDatum(std::string_view name, std::span<const language::Value> indices, const language::Value* value,
                  const control::sinumerik::DataStore& data);

}  // namespace probewright::execution::sinumerik

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/toml_table.hpp"
#include "machine/description.hpp"

namespace probewright::setup {

/// The axis of `machine` that the value of `key` names; of the given kind if one is asked for. Reports what it does not
/// have, unless there is no machine: that is reported already.
std::optional<std::size_t> axisNamed(TomlReader& reader, std::string_view key, const std::string& name,
                                     const machine::MachineDescription& machine,
                                     std::optional<machine::AxisKind> kind = std::nullopt);

}  // namespace probewright::setup

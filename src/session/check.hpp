#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "language/program.hpp"

namespace probewright::session {

/// Every mistake of a program that can be seen without running it, in the order of its lines; programs that it calls
/// are looked for beside it, and with SINUMERIK checked too.
Diagnostics checkProgram(const std::filesystem::path& path, std::optional<control::ControlKind> control);

/// The same for a program that is open; it must be one of the language of `kind`. `globalVariables`: global user data
/// of the control, upper case.
Diagnostics checkProgram(language::Program& program, control::ControlKind kind,
                         std::set<std::string> globalVariables = {});

}  // namespace probewright::session

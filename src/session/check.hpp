#pragma once

#include <filesystem>
#include <optional>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "language/program.hpp"

namespace probewright::session {

/// Every mistake of a program that can be seen without running it, in the order of its lines; programs that it calls
/// are looked for beside it but not checked themselves.
Diagnostics checkProgram(const std::filesystem::path& path, std::optional<control::ControlKind> control);

/// The same for a program that is open; it must be one of the language of `kind`.
Diagnostics checkProgram(language::Program& program, control::ControlKind kind);

}  // namespace probewright::session

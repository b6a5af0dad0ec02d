#pragma once

#include <bitset>
#include <filesystem>
#include <optional>
#include <string>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "language/program.hpp"
#include "machine/machine.hpp"
#include "session/control_family.hpp"

namespace probewright::session {

/// Every mistake of a program that can be seen without running it, in the order of its lines; programs that it calls
/// are looked for beside it, and with SINUMERIK checked too; there also definition files of global user data.
/// `skipLevels`: levels of block skip that are on; such blocks are left out. `read`, if it is not null, gets the text
/// that was read: a pipe gives it only once. `beliefs`, if it is not null: also what the program names and the control
/// does not have; without `control` the control of the beliefs is meant, and its folder of tables counts too. Mistakes
/// in these tables are told. `machine`, if it is not null: also axes that it lacks.
Diagnostics checkProgram(const std::filesystem::path& path, std::optional<control::ControlKind> control,
                         std::bitset<10> skipLevels = {}, std::string* read = nullptr,
                         const control::Beliefs* beliefs = nullptr, const ControlFamilies& families = knownFamilies(),
                         const machine::MachineDescription* machine = nullptr);

/// The same for a program that is open, without files beside it; it must be one of the language of `kind`.
Diagnostics checkProgram(language::Program& program, control::ControlKind kind,
                         const ControlFamilies& families = knownFamilies());

}  // namespace probewright::session

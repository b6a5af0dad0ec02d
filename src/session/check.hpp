#pragma once

#include <bitset>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "base/diagnostic.hpp"
#include "control/control_kind.hpp"
#include "language/program.hpp"

namespace probewright::simulation {
struct Setup;
}
namespace probewright::sinumerik {
class GlobalUserData;
}

namespace probewright::session {

/// Every mistake of a program that can be seen without running it, in the order of its lines; programs that it calls
/// are looked for beside it, and with SINUMERIK checked too; there also definition files of global user data.
/// `skipLevels`: levels of block skip that are on; such blocks are left out. `read`, if it is not null, gets the text
/// that was read: a pipe gives it only once. `setup`, if it is not null: also what the program names and the setup does
/// not have; without `control` its control is meant, and its folder of tables has global user data too.
Diagnostics checkProgram(const std::filesystem::path& path, std::optional<control::ControlKind> control,
                         std::bitset<10> skipLevels = {}, std::string* read = nullptr,
                         const simulation::Setup* setup = nullptr);

/// The same for a program that is open; it must be one of the language of `kind`. `globalVariables`: names of
/// data that the control has values for, upper case; `globalData`: what its definition files declare, null if nothing.
/// `foresees`: also what a run would refuse when it gets there.
Diagnostics checkProgram(language::Program& program, control::ControlKind kind,
                         std::set<std::string> globalVariables = {},
                         const sinumerik::GlobalUserData* globalData = nullptr, std::bitset<10> skipLevels = {},
                         bool foresees = true);

}  // namespace probewright::session

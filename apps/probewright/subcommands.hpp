#pragma once

#include "options.hpp"

/// The subcommands on the command line: each adds itself with its options.
namespace probewright::app {

Subcommand addRun(CLI::App& app);
Subcommand addCheck(CLI::App& app);
Subcommand addCycles(CLI::App& app);
Subcommand addCompare(CLI::App& app);
Subcommand addProject(CLI::App& app);
Subcommand addCamera(CLI::App& app);
Subcommand addConvert(CLI::App& app);
Subcommand addMachine(CLI::App& app);
Subcommand addStudy(CLI::App& app);
Subcommand addSurvive(CLI::App& app);
Subcommand addFeel(CLI::App& app);

}  // namespace probewright::app

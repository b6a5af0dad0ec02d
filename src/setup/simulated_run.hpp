#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "session/run.hpp"
#include "setup/setup.hpp"
#include "simulation/import_options.hpp"
#include "simulation/virtual_machine.hpp"

/// A run on the virtual machine of a setup: what the command line does, and what tests of cycles go through.
namespace probewright::setup {

/// How the machine is built.
struct MachineOptions {
  bool recordPath = true;
  bool blind = false;      ///< what the machine knows and the control does not is not told
  bool clearance = false;  ///< how near the tool comes to things is told, also without a limit of the setup
  simulation::ImportOptions import = {};  ///< of parts; the run's stop token stops it, too
};

/// What the control leaves behind, and the machine that it ran on.
struct SimulatedRun {
  session::RunOutcome outcome;
  std::unique_ptr<simulation::VirtualMachine> machine;  ///< as it is at the end; null if it could not be built
};

/// Reads the program, builds the machine of the setup's world, runs with the setup's beliefs. Everything that can go
/// wrong is in the outcome; info.exit says what kind of end it was.
SimulatedRun runProgram(const std::filesystem::path& program, const Setup& setup, const session::RunOptions& options,
                        const MachineOptions& machine = {});

/// The same with a program in memory; see session::prepareText.
SimulatedRun runText(const std::string& name, std::string text, const Setup& setup, const session::RunOptions& options,
                     const MachineOptions& machine = {});

}  // namespace probewright::setup

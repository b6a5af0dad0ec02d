#pragma once

#include <filesystem>
#include <string>

#include "base/diagnostic.hpp"
#include "reports/scene.hpp"
#include "session/run.hpp"
#include "setup/setup.hpp"

namespace probewright::app {

/// What a run on some machine leaves: of the program and its control, and for the picture in the report.
struct MachineRun {
  session::RunOutcome outcome;
  reports::Scene scene;
};

/// Runs the program with the setup's beliefs on the machine that an adapter plays (adapter::connect says what `machine`
/// may be). The picture shows what was touched: nobody knows the true part. A mistake is one before the program began.
/// An adapter that only draws is shown the program on the setup's virtual machine, if there is something to touch.
Result<MachineRun> runOnMachine(const std::string& machine, const std::filesystem::path& program,
                                const setup::Setup& setup, const session::RunOptions& options,
                                const simulation::ImportOptions& import = {});

}  // namespace probewright::app

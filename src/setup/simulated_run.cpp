#include "setup/simulated_run.hpp"

#include <algorithm>
#include <utility>

#include "camera/virtual_camera.hpp"
#include "setup/calibrated_beliefs.hpp"
#include "setup/solid_warnings.hpp"
#include "truth/run_truth.hpp"

namespace probewright::setup {

namespace {

/// What the control would believe if everything had just been measured without an error.
control::Beliefs calibratedBeliefs(const Setup& setup) {
  control::Beliefs beliefs = setup.beliefs;
  beliefs.tables.clear();
  // Calibration data that the setup tells.
  std::erase_if(beliefs.parameters,
                [](const auto& parameter) { return parameter.first.find("SNS_MEA_") != std::string::npos; });
  beliefs.toolProbes = believedToolProbes(setup.world);
  for (control::BelievedTool& tool : beliefs.tools) {
    const auto& tools = setup.world.truth.tools;
    const auto real = std::ranges::find(tools, tool.number, &simulation::TrueTool::number);
    if (real == tools.end()) continue;
    believeAsCalibrated(tool, *real);
    if (real->kind == simulation::ToolKind::Probe) believeShape(tool, real->probe);
  }
  return beliefs;
}

SimulatedRun runPrepared(session::PreparedProgram prepared, const Setup& setup, const MachineOptions& options) {
  SimulatedRun run;
  if (!hasErrors(prepared.diagnostics)) {
    simulation::ImportOptions import = options.import;
    import.stop = prepared.options->stop;
    auto machine = simulation::buildMachine(setup.world, import, !options.blind);
    if (machine) {
      run.machine = std::move(*machine);
      run.machine->record(options.recordPath ? simulation::Recording::Everything : simulation::Recording::Nothing);
      if (setup.camera) run.machine->fit(std::make_unique<camera::VirtualCamera>(*run.machine, *setup.camera));
      warnOfSolids(run.machine->truth(), setup.world.file, prepared.diagnostics);
      warnOfBodies(*run.machine, setup.world.file, prepared.diagnostics);
    } else {
      prepared.diagnostics.push_back(machine.error());
    }
  }
  run.outcome = run.machine ? session::run(std::move(prepared), *run.machine) : session::notRun(std::move(prepared));
  records::RunInfo& info = run.outcome.info;
  info.setupPath = setup.world.file;
  info.seed = setup.world.truth.seed;
  for (const simulation::WorldSolid& solid : setup.world.solids) {
    if (solid.role != simulation::SolidRole::Part) continue;
    info.partName = solid.name;
    info.partPath = solid.source.file.string();
  }
  if (run.machine && options.recordPath && !options.blind) {
    const control::Beliefs calibrated = calibratedBeliefs(setup);
    info.truth = truth::truthOf(
        run.outcome, *run.machine,
        {setup.beliefs, calibrated, options.clearance || setup.world.clearance > 0, setup.world.clearance});
  }
  return run;
}

}  // namespace

SimulatedRun runProgram(const std::filesystem::path& program, const Setup& setup, const session::RunOptions& options,
                        const MachineOptions& machine) {
  return runPrepared(session::prepareProgram(program, setup.beliefs, options), setup, machine);
}

SimulatedRun runText(const std::string& name, std::string text, const Setup& setup, const session::RunOptions& options,
                     const MachineOptions& machine) {
  return runPrepared(session::prepareText(name, std::move(text), setup.beliefs, options), setup, machine);
}

}  // namespace probewright::setup

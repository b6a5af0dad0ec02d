#include "machine_run.hpp"

#include <utility>

#include "adapter/remote_machine.hpp"

namespace probewright::app {
namespace {

/// The believed length of the touch probe that was in the spindle, or nothing.
std::optional<double> probeLength(const control::Beliefs& beliefs) {
  for (const control::BelievedTool& tool : beliefs.tools) {
    if (tool.kind == "probe") return tool.length;
  }
  return std::nullopt;
}

/// The touches where the control believes that they were. Only probes that stand upright in the spindle are drawn.
reports::Scene touchedScene(const session::RunOutcome& outcome, const machine::MachineDescription& machine,
                            const control::Beliefs& beliefs) {
  reports::Scene scene;
  const std::optional<double> length = probeLength(beliefs);
  if (!length) return scene;
  scene.ballRadius = outcome.ballRadius;
  scene.sceneFromWorkpiece = outcome.machineFromWorkpiece;
  for (std::uint32_t cycle = 0; cycle < outcome.journal.cycles.size(); ++cycle) {
    const auto& touches = outcome.journal.cycles[cycle].touches;
    for (std::uint32_t touch = 0; touch < touches.size(); ++touch) {
      const control::TouchRecord& record = touches[touch];
      if (record.outcome != "touched") continue;
      const Pose tableFromSpindle =
          machine::baseFromTable(machine, record.latched).inverse() * machine::baseFromSpindle(machine, record.latched);
      const Vector3 tip = tableFromSpindle * Vector3(0, 0, -*length);
      const Vector3 centre = tip + tableFromSpindle.linear() * Vector3(0, 0, outcome.ballRadius);
      // The way from the ball's centre to the surface, as the control has it, turned into the scene.
      Vector3 towards = record.surface - record.ballCentre;
      if (outcome.machineFromWorkpiece) towards = outcome.machineFromWorkpiece->linear() * towards;
      scene.touches.push_back({cycle, touch, centre.cast<float>(), (centre + towards).cast<float>()});
    }
  }
  return scene;
}

}  // namespace

Result<MachineRun> runOnMachine(const std::string& machine, const std::filesystem::path& program,
                                const setup::Setup& setup, const session::RunOptions& options) {
  // A program with mistakes bothers no machine.
  session::PreparedProgram prepared = session::prepareProgram(program, setup.beliefs, options);
  if (hasErrors(prepared.diagnostics)) return MachineRun{session::notRun(std::move(prepared)), {}};
  auto connection = adapter::connect(machine);
  if (!connection) return tl::unexpected(connection.error());
  auto remote = adapter::RemoteMachine::greet(std::move(*connection));
  if (!remote) return tl::unexpected(remote.error());
  MachineRun run{session::run(std::move(prepared), **remote), {}};
  records::RunInfo& info = run.outcome.info;
  info.setupPath = setup.world.file;
  if (const auto& failure = (*remote)->failure(); failure && info.exit < records::ExitState::Stopped) {
    // It came after the last order that would have raised an alarm.
    info.exit = records::ExitState::Stopped;
    info.exitText = *failure;
    run.outcome.result.diagnostics.push_back({Severity::Error, {}, *failure, {}, "see what the machine lacks", {}});
  }
  run.scene = touchedScene(run.outcome, (*remote)->description(), setup.beliefs);
  return run;
}

}  // namespace probewright::app

#include "machine_run.hpp"

#include <algorithm>
#include <utility>

#include "adapter/remote_machine.hpp"
#include "control/alarm.hpp"
#include "drawn_machine.hpp"
#include "machine/linuxcnc_machine.hpp"
#include "simulation/virtual_machine.hpp"

namespace probewright::app {
namespace {

/// The touches where the control believed that they were, with the tool that it believed to have then.
reports::Scene touchedScene(const session::RunOutcome& outcome, const adapter::RemoteMachine& remote) {
  const machine::MachineDescription& machine = remote.description();
  reports::Scene scene;
  scene.ballRadius = outcome.ballRadius;
  scene.sceneFromWorkpiece = outcome.machineFromWorkpiece;
  auto felt = remote.felt().begin();
  for (std::uint32_t cycle = 0; cycle < outcome.journal.cycles.size(); ++cycle) {
    const auto& touches = outcome.journal.cycles[cycle].touches;
    for (std::uint32_t touch = 0; touch < touches.size(); ++touch) {
      const control::TouchRecord& record = touches[touch];
      if (record.outcome != "touched") continue;
      // Both lists are in the order of time; a measuring block without a cycle is in one only.
      const auto found =
          std::find_if(felt, remote.felt().end(), [&](const auto& each) { return each.latched == record.latched; });
      if (found == remote.felt().end()) continue;
      felt = found;
      const Pose tableFromSpindle =
          machine::baseFromTable(machine, record.latched).inverse() * machine::baseFromSpindle(machine, record.latched);
      const Vector3 tip = tableFromSpindle * Vector3(-found->toolVector);
      const Vector3 centre = tip + tableFromSpindle.linear() * Vector3(0, 0, found->toolRadius);
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
                                const setup::Setup& setup, const session::RunOptions& options,
                                const simulation::ImportOptions& import) {
  std::unique_ptr<adapter::RemoteMachine> remote;
  session::RunOptions own = options;
  own.ask = [&](const std::string& text) {
    return remote && remote->asks() ? remote->ask(text) : options.ask && options.ask(text);
  };
  own.answer = [&](const control::Question& question) -> std::optional<std::string> {
    if (!remote || !remote->answers()) return options.answer ? options.answer(question) : std::nullopt;
    std::string wanted = question.wanted;
    while (auto reply = remote->answer(question.name, wanted)) {
      if (reply->cancelled) throw control::Cancelled();
      if (question.understood(reply->text)) return std::move(reply->text);
      wanted = "\"" + reply->text.substr(0, 80) + "\" cannot be read as an answer: " + question.wanted;
    }
    return std::nullopt;
  };
  // A program with mistakes bothers no machine.
  session::PreparedProgram prepared = session::prepareProgram(program, setup.beliefs, own);
  if (hasErrors(prepared.diagnostics)) return MachineRun{session::notRun(std::move(prepared)), {}};
  auto connection = adapter::connect(machine);
  if (!connection) return tl::unexpected(connection.error());
  auto greeted = adapter::RemoteMachine::greet(std::move(*connection));
  if (!greeted) return tl::unexpected(greeted.error());
  remote = std::move(*greeted);
  // How rotary axes turn tool and table is known where the setup's machine is this one, or LinuxCNC's configuration
  // lies on this computer and says it.
  if (!remote->adoptChains(setup.world.truth.machine) && !remote->configuration().empty()) {
    Diagnostics unsaid;
    if (const auto linuxcnc = machine::readLinuxCncMachine(remote->configuration(), unsaid))
      remote->adoptChains(linuxcnc->description);
  }
  if (remote->draws() && !setup.world.solids.empty()) {
    auto virtualMachine = simulation::buildMachine(setup.world, import);
    if (!virtualMachine) return tl::unexpected(virtualMachine.error());
    DrawnMachine drawn(**virtualMachine, *remote);
    return MachineRun{session::run(std::move(prepared), drawn), {}};
  }
  // An adapter that looks ahead says what went wrong on the last moves when the axes stand.
  MachineRun run{session::run(std::move(prepared), *remote), {}};
  static_cast<void>(remote->deflected(machine::Sensor::TouchProbe));
  records::RunInfo& info = run.outcome.info;
  info.setupPath = setup.world.file;
  if (const auto& failure = remote->failure(); failure && info.exit < records::ExitState::Stopped) {
    // It came after the last order that would have raised an alarm.
    info.exit = records::ExitState::Stopped;
    info.exitText = *failure;
    run.outcome.result.diagnostics.push_back({Severity::Error, {}, *failure, {}, "see what the machine lacks", {}});
  }
  run.scene = touchedScene(run.outcome, *remote);
  return run;
}

}  // namespace probewright::app

#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "execution/host.hpp"
#include "execution/klartext/coordinate_changes.hpp"
#include "execution/klartext/cycles.hpp"
#include "execution/klartext/machine_functions.hpp"
#include "execution/klartext/motion.hpp"
#include "execution/klartext/protocol.hpp"
#include "execution/klartext/system_data.hpp"
#include "execution/klartext/tables.hpp"
#include "execution/klartext/tilting.hpp"
#include "execution/klartext/tools.hpp"

namespace probewright::execution::klartext {

/// Carries out Klartext on a HEIDENHAIN control: hands each instruction to the part that it is for. Program coordinates
/// and feeds are in the unit of the program.
class KlartextHost : public Host {
public:
  explicit KlartextHost(control::heidenhain::Control& control, HostOptions options = {});
  // The parts know each other by reference.
  KlartextHost(const KlartextHost&) = delete;
  KlartextHost& operator=(const KlartextHost&) = delete;

  Value read(const VariableRef& variable, Evaluation&) override { return parameters_.read(variable); }
  void write(const VariableRef& variable, const Value& value, Evaluation&) override {
    parameters_.write(variable, value);
  }
  bool isDefined(const VariableRef& variable, Evaluation&) override { return parameters_.isDefined(variable); }
  Value call(std::string_view name, std::span<const Value> arguments) override;
  void execute(const Instruction& instruction, Evaluation& evaluation) override;
  std::string requestedProgram() override { return cycles_.takeRequestedProgram(); }
  bool beginBlock(const Program& program, const Block& block) override;
  std::string code(Refusal refusal) const override;
  std::uint64_t takeWork() override { return std::exchange(run_.work, 0); }
  void enter(const Program& program, const CallProgram* call, Evaluation* caller) override;
  void leave(const Program& program) override;
  /// The block at HostOptions::startLine has not been reached.
  bool scans() const { return run_.scans; }

private:
  void refuseWhatIsLacked(const Instruction& instruction, Evaluation& evaluation) const;
  void carryOut(const Move& move, Evaluation& evaluation);
  void carryOut(const ToolCall& call, Evaluation& evaluation);
  void carryOut(const Modal& modal, Evaluation& evaluation);
  void carryOut(const MachineFunction& function, Evaluation& evaluation);
  void carryOut(const Transform& transform, Evaluation& evaluation);
  void carryOut(const CycleCall& call, Evaluation& evaluation);
  void carryOut(const Command& command, Evaluation& evaluation);
  void carryOut(const Stop& stop, Evaluation& evaluation);

  // host_commands.cpp
  void circleThroughPoints(const Command& command, int points, Evaluation& evaluation);
  void defineGlobally(const Command& command, Evaluation& evaluation);
  void functionBlock(std::string_view text);
  void dwell(double seconds);
  void warnOfEarlyEnd(const Block& block);
  void endScanAt(const Block& block);

  control::heidenhain::Control& control_;
  RunContext run_;
  Parameters parameters_;
  Spindle spindle_;
  ToolGuidance guidance_;
  Tools tools_;
  Motion motion_;
  Tilting tilting_;
  CoordinateChanges coordinateChanges_;
  Cycles cycles_;
  MachineFunctions machineFunctions_;
  SystemData systemData_;
  Protocol protocol_;
  Tables tables_;
};

}  // namespace probewright::execution::klartext

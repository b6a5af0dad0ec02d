#pragma once

#include "execution/host.hpp"
#include "execution/names.hpp"
#include "language/din_iso/modal_state.hpp"

namespace probewright::execution::din_iso {

/// Carries out DIN/ISO programs, and the Klartext programs they call or are called by, on the host of Klartext: blocks
/// are completed by the modal functions in force and handed on.
///
/// The main program begins with G90, G1 and without a tool axis. A called program inherits what is in force and hands
/// it back; Klartext programs leave it alone.
class DinIsoHost : public Host {
public:
  /// `klartext` carries out what the blocks say; it must outlive this host.
  explicit DinIsoHost(Host& klartext) : klartext_(klartext) {}

  Value read(const VariableRef& variable, Evaluation& evaluation) override;
  void write(const VariableRef& variable, const Value& value, Evaluation& evaluation) override;
  bool isDefined(const VariableRef& variable, Evaluation& evaluation) override;
  Value call(std::string_view name, std::span<const Value> arguments) override;
  void execute(const Instruction& instruction, Evaluation& evaluation) override;
  std::string requestedProgram() override;
  bool beginBlock(const Program& program, const Block& block) override;
  std::string code(Refusal refusal) const override;
  std::uint64_t takeWork() override { return klartext_.takeWork(); }
  double relativeEquality() const override { return klartext_.relativeEquality(); }
  void enter(const Program& program, const CallProgram* call, Evaluation* caller) override;
  void leave(const Program& program) override;

private:
  Host& klartext_;
  ModalState state_;
  Block resolved_;
  const Program* program_ = nullptr;  ///< of `resolved_`; null: it holds no block
  int depth_ = 0;
};

}  // namespace probewright::execution::din_iso

#include "execution/din_iso/host.hpp"

#include "control/alarm.hpp"
#include "execution/evaluation.hpp"
#include "language/din_iso/program.hpp"

namespace probewright::execution::din_iso {

Value DinIsoHost::read(const VariableRef& variable, Evaluation& evaluation) {
  return klartext_.read(variable, evaluation);
}

void DinIsoHost::write(const VariableRef& variable, const Value& value, Evaluation& evaluation) {
  klartext_.write(variable, value, evaluation);
}

bool DinIsoHost::isDefined(const VariableRef& variable, Evaluation& evaluation) {
  return klartext_.isDefined(variable, evaluation);
}

Value DinIsoHost::call(std::string_view name, std::span<const Value> arguments) {
  return klartext_.call(name, arguments);
}

std::string DinIsoHost::code(Refusal refusal) const { return klartext_.code(refusal); }

std::string DinIsoHost::requestedProgram() { return klartext_.requestedProgram(); }

bool DinIsoHost::beginBlock(const Program& program, const Block& block) {
  program_ = nullptr;
  if (dynamic_cast<const DinIsoProgram*>(&program) != nullptr) {
    state_.resolve(block, resolved_);
    program_ = &program;
  }
  return klartext_.beginBlock(program, block);
}

void DinIsoHost::execute(const Instruction& instruction, Evaluation& evaluation) {
  const Block& block = evaluation.block();
  const bool isResolved = program_ == &evaluation.program() && resolved_.position.offset == block.position.offset;
  if (!isResolved) {
    klartext_.execute(instruction, evaluation);
    return;
  }
  const auto index = static_cast<std::size_t>(&instruction - block.instructions.data());
  const Instruction& complete = resolved_.instructions[index];
  if (const auto* modal = std::get_if<Modal>(&complete); modal != nullptr && isModalFunction(resolved_, *modal)) return;
  if (state_.mistake && std::holds_alternative<Move>(complete))
    throw control::Alarm("Block format incorrect", state_.mistake->message, state_.mistake->advice);
  Evaluation completed(evaluation.program(), resolved_, *this);
  klartext_.execute(complete, completed);
}

void DinIsoHost::enter(const Program& program, const CallProgram* call, Evaluation* caller) {
  if (depth_++ == 0) state_ = {};
  klartext_.enter(program, call, caller);
}

void DinIsoHost::leave(const Program& program) {
  if (depth_ > 0) --depth_;
  program_ = nullptr;
  klartext_.leave(program);
}

}  // namespace probewright::execution::din_iso

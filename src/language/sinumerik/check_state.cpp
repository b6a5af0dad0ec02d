#include <fmt/format.h>

#include "language/sinumerik/checker.hpp"

/// Measuring cycles that what blocks before them have switched on makes the control refuse.
namespace probewright::language::sinumerik {

namespace {

/// SCALE and ASCALE: a factor is written that is not 1.
bool scales(const Block& block, const Transform& change) {
  for (std::uint32_t i = 0; i < change.words.count; ++i) {
    const Operand& factor = block.words[change.words.first + i].value;
    if (factor.isLiteral() && factor.number != 1) return true;
  }
  return false;
}

}  // namespace

/// Follows the program as far as it is straight: not past a label, a block that may be skipped, a call, a jump, or the
/// begin or end of a structure.
void Checker::followState(const Instruction& instruction) {
  if (std::holds_alternative<Structured>(instruction) || std::holds_alternative<RepeatSection>(instruction) ||
      std::holds_alternative<CallLabel>(instruction) || std::holds_alternative<Jump>(instruction)) {
    state_ = {};
  } else if (const auto* modal = std::get_if<Modal>(&instruction)) {
    const std::string_view name = block_.at(modal->name);
    if (name == "G40") state_.correction.clear();
    if (name == "G41" || name == "G42") state_.correction = name;
  } else if (const auto* move = std::get_if<Move>(&instruction)) {
    if (move->compensation == RadiusCompensation::Off) state_.correction.clear();
    if (move->compensation == RadiusCompensation::Left) state_.correction = "G41";
    if (move->compensation == RadiusCompensation::Right) state_.correction = "G42";
  } else if (const auto* change = std::get_if<Transform>(&instruction)) {
    const std::string_view name = block_.at(change->name);
    const bool more = name.starts_with('A');
    // Scaled or mirrored twice: only the run knows what is left of it.
    const bool scale = name == "SCALE" || name == "ASCALE", mirrors = name == "MIRROR" || name == "AMIRROR";
    state_.scaled = scale ? scales(block_, *change) && !(more && state_.scaled) : more && state_.scaled;
    state_.mirrored = mirrors ? change->words.count > 0 && !(more && state_.mirrored) : more && state_.mirrored;
  } else if (const auto* command = std::get_if<Command>(&instruction)) {
    if (block_.at(command->name) == "G") state_ = {};  // G[7]=1
  } else if (const auto* assign = std::get_if<Assign>(&instruction)) {
    if (block_.at(block_.variables[assign->variable].name).starts_with("$P_")) state_.scaled = state_.mirrored = false;
  } else if (const auto* call = std::get_if<CallProgram>(&instruction)) {
    if (!callsCycle(*call)) state_ = {};
  }
}

/// Said once of a cause.
void Checker::checkState(std::string_view cycle) {
  if (!options_.foresees || cycle == "CYCLE150") return;  // CYCLE150 touches nothing
  if (!state_.correction.empty()) {
    report(columnOf(cycle),
           fmt::format("{} is active: the control refuses {} with alarm 61300", state_.correction, cycle),
           "Program G40 before the measuring cycle.");
  } else if (state_.scaled) {
    report(columnOf(cycle), fmt::format("a scale factor is active: the control refuses {} with alarm 61310", cycle),
           "Cancel it by SCALE without axes before the measuring cycle.");
  } else if (state_.mirrored && options_.onMill) {
    report(
        columnOf(cycle),
        fmt::format("mirroring is active: the control refuses {} with alarm 61310, except with a turning probe", cycle),
        "Cancel it by MIRROR without axes before the measuring cycle.", Severity::Warning);
  }
  state_ = {};
}

}  // namespace probewright::language::sinumerik

#include "language/klartext/control_blocks.hpp"

#include <algorithm>
#include <span>

#include "language/klartext/commands.hpp"

namespace probewright::language::klartext {

namespace {

constexpr std::string_view takeOut = "take the block out";

std::optional<LackedBlock> lackedCommand(CommandKind kind) {
  constexpr std::string_view tables = "read and write tables with FN 18, FN 17, FN 26 to FN 28";
  constexpr std::string_view presets = "activate a preset with CYCL DEF 247";
  switch (kind) {
    case CommandKind::TabdataRead:
      return LackedBlock{"TABDATA READ", tables};
    case CommandKind::TabdataWrite:
      return LackedBlock{"TABDATA WRITE", tables};
    case CommandKind::TabdataAdd:
      return LackedBlock{"TABDATA ADD", tables};
    case CommandKind::OpenFile:
      return LackedBlock{"OPEN FILE", takeOut};
    case CommandKind::Monitoring:
      return LackedBlock{"MONITORING", takeOut};
    case CommandKind::PresetSelect:
      return LackedBlock{"PRESET SELECT", presets};
    case CommandKind::PresetCopy:
      return LackedBlock{"PRESET COPY", presets};
    case CommandKind::PresetCorrection:
      return LackedBlock{"PRESET CORR", "shift the datum with CYCL DEF 7"};
    case CommandKind::SelectCorrectionTable:
    case CommandKind::SelectToolCorrectionTable:
    case CommandKind::SelectWorkpieceCorrectionTable:
      return LackedBlock{"SEL CORR-TABLE", "correct the tool in TOOL CALL with DL, DR and DR2"};
    default:
      return std::nullopt;
  }
}

std::optional<LackedBlock> lackedTransform(TransformKind kind, bool hasSym) {
  switch (kind) {
    case TransformKind::TransMirror:
    case TransformKind::TransMirrorReset:
      return LackedBlock{"TRANS MIRROR", "write CYCL DEF 8"};
    case TransformKind::TransRotation:
    case TransformKind::TransRotationReset:
      return LackedBlock{"TRANS ROTATION", "write CYCL DEF 10"};
    case TransformKind::TransScale:
    case TransformKind::TransScaleReset:
      return LackedBlock{"TRANS SCALE", "write CYCL DEF 11"};
    default:
      if (isPlane(kind) && hasSym) return LackedBlock{"SYM", "write SEQ+ or SEQ-"};
      return std::nullopt;
  }
}

}  // namespace

std::optional<LackedBlock> lackedBlock(control::ControlKind control, const Block& block,
                                       const Instruction& instruction) {
  if (control != control::ControlKind::iTNC530) return std::nullopt;
  const auto has = [&](WordRange range, std::string_view address) {
    const auto words = std::span<const Word>(block.words).subspan(range.first, range.count);
    return std::ranges::find(words, addressOf(address), &Word::address) != words.end();
  };
  if (const auto* command = std::get_if<Command>(&instruction)) return lackedCommand(kindOf(block, *command));
  if (const auto* transform = std::get_if<Transform>(&instruction))
    return lackedTransform(kindOf(block, *transform), has(transform->words, "SYM"));
  if (const auto* modal = std::get_if<Modal>(&instruction);
      modal != nullptr && block.at(modal->name) == "FUNCTION TCPM") {
    if (has(modal->words, "REFP"))
      return LackedBlock{"REFPNT of FUNCTION TCPM", "take it away: the tip is what is guided"};
    if (has(modal->words, "FLIM")) return LackedBlock{"the feed limit of FUNCTION TCPM", "take it away"};
  }
  return std::nullopt;
}

}  // namespace probewright::language::klartext

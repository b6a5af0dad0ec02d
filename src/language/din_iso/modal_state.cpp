#include "language/din_iso/modal_state.hpp"

#include <charconv>

#include "language/klartext/commands.hpp"

namespace probewright::language::din_iso {

namespace {

bool isPolar(int path) { return path >= 10; }

MoveKind kindOf(int path) {
  switch (path) {
    case 2:
    case 12:
      return MoveKind::ArcClockwise;
    case 3:
    case 13:
      return MoveKind::ArcCounterclockwise;
    case 5:
    case 15:
      return MoveKind::Modal;
    case 6:
    case 16:
      return MoveKind::ArcTangential;
    default:
      return MoveKind::Linear;
  }
}

void resolveMode(Word& word, bool incremental) {
  if (word.mode == WordMode::Absolute) {
    word.mode = WordMode::Plain;
  } else if (word.mode == WordMode::Plain && incremental) {
    word.mode = WordMode::Incremental;
  }
}

void resolvePath(Move& move, int path, bool incremental, Block& block) {
  move.variant = {};
  move.polar = isPolar(path);
  // The new words stand together after all others: an arc has its direction as a word.
  const std::size_t first = block.words.size();
  bool travels = false;
  for (std::uint32_t i = 0; i < move.words.count; ++i) {
    Word word = block.words[move.words.first + i];
    const bool radius = word.address == addressOf("R");
    if (radius && word.mode == WordMode::DirectShortest) {  // G43, G44
      block.words.push_back(word);
      continue;
    }
    resolveMode(word, incremental);
    if (radius && move.polar) word.address = addressOf("PR");
    if (radius && !move.polar) word.mode = WordMode::Plain;
    if (word.address == addressOf("H")) word.address = addressOf("PA");
    if (word.address == addressOf("FU") || word.address == addressOf("FZ")) {
      word.mode = WordMode::Plain;
    } else {
      travels = true;
    }
    block.words.push_back(word);
  }
  // A feed or a radius compensation alone belongs to no path.
  move.kind = travels ? kindOf(path) : MoveKind::Linear;
  move.polar = move.polar && travels;
  if (travels && (path == 0 || path == 10)) move.rapid = true;
  if (move.kind == MoveKind::ArcClockwise || move.kind == MoveKind::ArcCounterclockwise) {
    Word& direction = block.words.emplace_back();
    direction.address = addressOf("DR");
    direction.value = Operand::of(move.kind == MoveKind::ArcCounterclockwise ? 1 : -1);
  }
  move.words = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(block.words.size() - first)};
}

}  // namespace

bool isModalFunction(const Block& block, const Modal& modal) {
  const std::string_view name = block.at(modal.name);
  return name.size() >= 2 && name[0] == 'G' && name[1] >= '0' && name[1] <= '9';
}

void ModalState::resolve(const Block& block, Block& resolved) {
  resolved = block;
  // Words without a mode of their own stand before the block's first G90 or G91: for them the one before it holds.
  const bool before = incremental;
  mistake.reset();
  for (Instruction& instruction : resolved.instructions) {
    if (auto* modal = std::get_if<Modal>(&instruction)) {
      if (!isModalFunction(resolved, *modal)) continue;
      const std::string_view digits = resolved.at(modal->name).substr(1);
      int number = 0;
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (number == 90 || number == 91) {
        incremental = number == 91;
      } else if (number >= 17 && number <= 19) {
        const char axis = number == 17 ? 'Z' : number == 18 ? 'Y' : 'X';
        const bool changes = toolCalled && axis != toolAxis;
        toolAxis = axis;
        if (changes) {
          ToolCall call;
          call.axis = axis;
          instruction = call;
        }
      } else {
        path = number;
      }
    } else if (auto* call = std::get_if<ToolCall>(&instruction)) {
      const bool tool = call->number.present() || call->name.present();
      if (call->axis != 0) toolAxis = call->axis;
      if (tool) call->axis = toolAxis;
      toolCalled = toolCalled || tool;
    } else if (auto* move = std::get_if<Move>(&instruction)) {
      if (move->kind == MoveKind::Modal && resolved.at(move->variant) == "G") {
        mistake = pathMistake(path, resolved, *move);
        resolvePath(*move, path, before, resolved);
      } else if (move->kind == MoveKind::SetCentre) {
        for (std::uint32_t i = 0; i < move->words.count; ++i)
          resolveMode(resolved.words[move->words.first + i], before);
      }
    } else if (const auto* transform = std::get_if<Transform>(&instruction)) {
      const klartext::TransformKind kind = klartext::kindOf(resolved, *transform);
      if (kind != klartext::TransformKind::DatumShift && kind != klartext::TransformKind::Rotation) continue;
      for (std::uint32_t i = 0; i < transform->words.count; ++i) {
        Word& word = resolved.words[transform->words.first + i];
        if (word.address != addressOf("#")) resolveMode(word, before);
      }
    }
  }
}

}  // namespace probewright::language::din_iso

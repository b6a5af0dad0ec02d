#include <fmt/format.h>

#include "language/sinumerik/block_words.hpp"
#include "language/sinumerik/checker.hpp"
#include "language/sinumerik/keywords.hpp"

/// Words that do not belong to the motion or the plane that blocks before theirs have chosen.
namespace probewright::language::sinumerik {

namespace {

struct Motion {
  Takes takes;
  std::string name;
};

/// The motion that a G function, or the kind of a Move, chooses; nothing if it is about something else.
std::optional<Motion> motionOf(std::string_view name) {
  if (name == "G0" || name == "G1") return Motion{Takes::Line, std::string(name)};
  if (name == "G2" || name == "G3") return Motion{Takes::Arc, std::string(name)};
  if (name == "CIP") return Motion{Takes::Points, "CIP"};
  if (name == "CT") return Motion{Takes::Tangent, "CT"};
  if (name == "G33" || name == "G34" || name == "G35" || name == "G331" || name == "G332" || name == "G335" ||
      name == "G336" || name == "G63")
    return Motion{Takes::Thread, std::string(name)};
  if (keywordOf(name) == Keyword::Motion) return Motion{Takes::Spline, std::string(name)};
  return std::nullopt;
}

std::string_view nameOf(MoveKind kind) {
  switch (kind) {
    case MoveKind::Rapid:
      return "G0";
    case MoveKind::Linear:
      return "G1";
    case MoveKind::ArcClockwise:
      return "G2";
    case MoveKind::ArcCounterclockwise:
      return "G3";
    case MoveKind::ArcThroughPoint:
      return "CIP";
    case MoveKind::ArcTangential:
      return "CT";
    default:
      return {};
  }
}

bool axesOnly(const Block& block, WordRange range) {
  for (std::uint32_t i = 0; i < range.count; ++i) {
    const std::uint32_t address = block.words[range.first + i].address;
    if (address < 'X' || address > 'Z') return false;
  }
  return true;
}

}  // namespace

/// What the pass over all blocks collects for checkModalWords.
void Checker::noteForModalWords(const Instruction& instruction) {
  if (const auto* jump = std::get_if<Jump>(&instruction)) {
    if (jump->label.length > 0) targets_.emplace(block_.at(jump->label));
    jumpsAnywhere_ = jumpsAnywhere_ || jump->labelValue.present();
  } else if (const auto* section = std::get_if<RepeatSection>(&instruction)) {
    targets_.emplace(block_.at(section->from));
    if (section->to.length > 0) targets_.emplace(block_.at(section->to));
  } else if (const auto* move = std::get_if<Move>(&instruction)) {
    modalWords_ = modalWords_ || !axesOnly(block_, move->words);
  }
}

/// Follows motion and plane through the program as far as they are known without a run: not after a label that is
/// jumped to, a call, or where a structure begins or ends.
void Checker::checkModalWords() {
  if (!modalWords_) return;
  std::optional<Motion> motion;
  std::optional<int> plane;
  const auto forget = [&] {
    motion.reset();
    plane.reset();
  };
  Diagnostics known;
  for (BlockPosition at = program_.begin(); program_.parse(at, block_, known); at = block_.next) {
    if (block_.skippable && options_.skipLevels[block_.skipLevel]) continue;
    if (block_.label.length > 0 && (jumpsAnywhere_ || targets_.contains(block_.at(block_.label)))) forget();
    for (const Instruction& instruction : block_.instructions) {
      if (std::holds_alternative<Structured>(instruction) || std::holds_alternative<CallProgram>(instruction) ||
          std::holds_alternative<RepeatSection>(instruction)) {
        forget();
      } else if (const auto* modal = std::get_if<Modal>(&instruction)) {
        const std::string_view name = block_.at(modal->name);
        if (name == "G17" || name == "G18" || name == "G19") plane = name[2] - '0' + 10;
        if (const auto chosen = motionOf(name)) motion = chosen;
      } else if (const auto* move = std::get_if<Move>(&instruction)) {
        if (const auto chosen = motionOf(nameOf(move->kind))) motion = chosen;
        if (!motion) continue;
        const auto mistake = wordMistake(motion->takes, motion->name, block_, move->words, plane);
        if (mistake) {
          report(mistake->column, mistake->message,
                 fmt::format("{} The control refuses the block with alarm {}.", mistake->advice, mistake->alarm));
        }
      } else if (const auto* command = std::get_if<Command>(&instruction);
                 command != nullptr && block_.at(command->name) == "G") {
        forget();  // G[1]=2
      }
    }
    if (block_.skippable) forget();
  }
}

}  // namespace probewright::language::sinumerik

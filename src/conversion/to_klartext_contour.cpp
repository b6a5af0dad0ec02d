#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "conversion/sinumerik_formulas.hpp"
#include "conversion/to_klartext.hpp"

/// Radius compensation, roundings and chamfers of SINUMERIK programs in Klartext.
namespace probewright::conversion {

using namespace language;

namespace {

const Word* find(std::span<const Word> words, std::string_view address) {
  const auto found = std::ranges::find(words, addressOf(address), &Word::address);
  return found == words.end() ? nullptr : &*found;
}

/// What follows in the text may not be what runs next.
bool leadsElsewhere(const Instruction& instruction) {
  return std::holds_alternative<Jump>(instruction) || std::holds_alternative<RepeatSection>(instruction) ||
         std::holds_alternative<CallProgram>(instruction) || std::holds_alternative<Structured>(instruction) ||
         std::holds_alternative<Return>(instruction) || std::holds_alternative<EndProgram>(instruction);
}

/// A HEIDENHAIN control ends radius compensation there, or a SINUMERIK looks no further ahead.
bool interruptsContour(const Block& block, const Instruction& instruction) {
  constexpr int toolChange = 6;
  if (const auto* function = std::get_if<MachineFunction>(&instruction)) return function->number == toolChange;
  if (const auto* move = std::get_if<Move>(&instruction)) return move->variant.length != 0;
  if (const auto* command = std::get_if<Command>(&instruction)) {
    const std::string_view name = block.at(command->name);
    return name == "STOPRE" || name == "MEAS";
  }
  if (const auto* modal = std::get_if<Modal>(&instruction)) {
    static constexpr std::array<std::string_view, 10> words = {"S",   "F",   "D",   "G17",    "G18",
                                                               "G19", "G94", "G95", "TRAORI", "TRAFOOF"};
    const std::string_view name = block.at(modal->name);
    return settableOf(name) || std::ranges::find(words, name) != words.end();
  }
  return std::holds_alternative<ToolCall>(instruction) || std::holds_alternative<Transform>(instruction) ||
         std::holds_alternative<CallProgram>(instruction);
}

}  // namespace

void ToKlartext::listCompensation(const Block& block) {
  if (compensation_ == "R0" && !compensationDoubtful_) return;
  const auto ends = [&](const Instruction& each) {
    const auto* modal = std::get_if<Modal>(&each);
    const auto* move = std::get_if<Move>(&each);
    return (modal != nullptr && block.at(modal->name) == "G40") ||
           (move != nullptr && move->compensation == RadiusCompensation::Off);
  };
  const auto changesSide = [&](const Instruction& each) {
    const auto* modal = std::get_if<Modal>(&each);
    const auto* move = std::get_if<Move>(&each);
    const std::string_view name = modal == nullptr ? std::string_view() : block.at(modal->name);
    const RadiusCompensation side = move == nullptr ? RadiusCompensation::Unchanged : move->compensation;
    return (compensation_ == "RL" && (name == "G42" || side == RadiusCompensation::Right)) ||
           (compensation_ == "RR" && (name == "G41" || side == RadiusCompensation::Left));
  };
  if (std::ranges::any_of(block.instructions, changesSide)) {
    out_.list(block, "the side of radius compensation changes, which the two controls do in another way",
              "end it with G40 in a path before this block");
  }
  const auto interrupts = [&](const Instruction& each) { return interruptsContour(block, each); };
  if (std::ranges::any_of(block.instructions, ends) || std::ranges::none_of(block.instructions, interrupts)) return;
  out_.list(
      block,
      "radius compensation is in effect at this block, which ends or interrupts it in another way on a HEIDENHAIN "
      "control",
      "end it with G40 in a path before this block");
}

void ToKlartext::listFeedOfOtherKind(const Block& block, const Move& move) {
  const bool given = move.feed.present() || std::ranges::any_of(block.instructions, [&](const Instruction& each) {
                       const auto* modal = std::get_if<Modal>(&each);
                       return modal != nullptr && block.at(modal->name) == "F";
                     });
  if (given) feedOfOtherKind_ = false;
  if (motion_ == MoveKind::Rapid || !std::exchange(feedOfOtherKind_, false)) return;
  out_.list(block, "after G94 and G95 a SINUMERIK stops where no new feed (F) follows, a HEIDENHAIN control goes on",
            "program F in this block");
}

void ToKlartext::listCompensatedPath(const Block& block, std::span<const Word> words) {
  const std::string before = std::exchange(travelled_, compensation_);
  const bool rapid = motion_ == MoveKind::Rapid, changes = std::exchange(travelledAtRapid_, rapid) != rapid;
  const bool begins = before == "R0" && compensation_ != "R0", ends = before != "R0" && compensation_ == "R0";
  if (before != "R0" && !ends && changes) {
    out_.list(block,
              "between a path at rapid traverse and one at a feed the tool goes round the corner at another speed on a "
              "HEIDENHAIN control",
              "give all paths with radius compensation a feed");
  }
  if (!begins && !ends) return;
  const bool inPlane = find(words, axis(0)) != nullptr || find(words, axis(1)) != nullptr;
  if (motion_ != MoveKind::Rapid && motion_ != MoveKind::Linear) {
    out_.list(block, "radius compensation begins or ends with an arc, which a SINUMERIK refuses",
              "let it begin and end in straight lines");
  } else if (!inPlane) {
    out_.list(block,
              "radius compensation begins or ends in a path without coordinates of the plane: a SINUMERIK waits for "
              "the next path",
              "let it begin and end in straight lines in the plane");
  } else if (begins && withoutLength_ != std::optional(false)) {
    out_.list(block, "with D0 a SINUMERIK knows no radius to compensate", "program D1 before this block");
  }
}

void ToKlartext::listTooLarge(const Block& block, Corner corner, const Quantity& size, const PlanePoint& from,
                              const PlanePoint& to) {
  switch (room_.fitOf(corner, size, from, {position_[0], position_[1]}, to)) {
    case CornerRoom::Fit::Fits:
      return;
    case CornerRoom::Fit::TooLarge:
      return out_.list(block, tooLargeCorner, "make it smaller");
    case CornerRoom::Fit::Unknown:
      return out_.list(block, cornerOfUnknownRoom, "see that it fits", Severity::Note);
  }
}

void ToKlartext::corner(const Block& block, std::span<const Word> words, const PlanePoint& from) {
  const Word* cornerFeed = find(words, "FRC");
  const std::string slow = cornerFeed == nullptr ? "" : feedWord(block, cornerFeed->value);
  const Word* round = find(words, "RND");
  const Word* chamfer = find(words, "CHR");
  if (round == nullptr && chamfer == nullptr) {
    room_.pathWithoutCorner();
    if (cornerFeed != nullptr) out_.lose(block, "FRC without RND or CHR in its block");
    return;
  }
  const std::optional<NextPath> next = nextPath(block);
  const MoveKind kind = next ? next->kind.value_or(motion_) : motion_;
  const auto isArc = [](MoveKind each) { return each != MoveKind::Rapid && each != MoveKind::Linear; };
  if (!next || next->compensates) {
    out_.list(
        block,
        "this corner is followed by a label, a jump or a call, or by the begin or end of radius compensation: the "
        "two controls round and chamfer differently there",
        "let a path follow it directly");
  } else if (chamfer != nullptr && (isArc(motion_) || isArc(kind))) {
    out_.list(block, "a HEIDENHAIN control chamfers between straight lines only", "write the chamfer as a line");
  }
  listTooLarge(block, round != nullptr ? Corner::Rounding : Corner::Chamfer,
               quantity(block, (round != nullptr ? round : chamfer)->value), isArc(motion_) ? PlanePoint() : from,
               next && !isArc(kind) ? next->to : PlanePoint());
  if (motion_ == MoveKind::Rapid || kind == MoveKind::Rapid) {
    out_.list(block, "a corner between paths at rapid traverse is travelled at another speed on a HEIDENHAIN control",
              "give the paths before and after the corner a feed");
  } else if (cornerFeed == nullptr && next && next->hasFeed) {
    out_.list(block,
              "this corner is travelled at the feed of the path after it, on a HEIDENHAIN control at that of the path "
              "before it",
              "write the feed of the corner (FRC) in this block");
  }
  if (round != nullptr) {
    line(fmt::format("RND R{}{}", formulas_.unsignedValue(quantity(block, round->value)), slow));
  }
  if (chamfer != nullptr) {
    line(fmt::format("CHF {}{}", formulas_.unsignedValue(quantity(block, chamfer->value)), slow));
  }
}

std::optional<ToKlartext::NextPath> ToKlartext::nextPath(const Block& block) {
  Block next;
  Diagnostics ignored;
  NextPath path;
  bool incremental = incremental_;
  for (BlockPosition at = block.next; program_.parse(at, next, ignored); at = next.next) {
    if (next.label.length != 0) return std::nullopt;
    for (const Instruction& instruction : next.instructions) {
      if (leadsElsewhere(instruction)) return std::nullopt;
      const auto* modal = std::get_if<Modal>(&instruction);
      const std::string_view name = modal == nullptr ? std::string_view() : next.at(modal->name);
      if (name == "F") path.hasFeed = true;
      if (name == "G40" || name == "G41" || name == "G42") path.compensates = true;
      if (name == "G90" || name == "G91") incremental = name == "G91";
      if (name == "G0") path.kind = MoveKind::Rapid;
      if (name == "G1") path.kind = MoveKind::Linear;
      if (name == "G2") path.kind = MoveKind::ArcClockwise;
      if (name == "G3") path.kind = MoveKind::ArcCounterclockwise;
      const auto* move = std::get_if<Move>(&instruction);
      if (move == nullptr) continue;
      if (move->kind != MoveKind::Modal) path.kind = move->kind;
      path.hasFeed = path.hasFeed || move->feed.present();
      path.compensates = path.compensates || move->compensation != RadiusCompensation::Unchanged;
      const auto words = std::span<const Word>(next.words).subspan(move->words.first, move->words.count);
      for (std::size_t i = 0; i < 2; ++i) {
        const Word* word = find(words, axis(i));
        if (word == nullptr) {
          path.to[i] = position_[i];
        } else if (word->value.isLiteral()) {
          const bool adds = word->mode == WordMode::Incremental || (word->mode == WordMode::Plain && incremental);
          if (!adds) path.to[i] = word->value.number;
          if (adds && position_[i]) path.to[i] = *position_[i] + word->value.number;
        }
      }
      return path;
    }
  }
  return std::nullopt;
}

}  // namespace probewright::conversion

#include <fmt/format.h>

#include <algorithm>

#include "conversion/modes.hpp"
#include "conversion/to_sinumerik.hpp"

/// Radius compensation, roundings and chamfers of HEIDENHAIN programs in the language of a SINUMERIK.
namespace probewright::conversion {

using namespace language;

namespace {

bool isCorner(const Move& move) { return move.kind == MoveKind::Rounding || move.kind == MoveKind::Chamfer; }

bool isArc(const Move& move) {
  return move.kind == MoveKind::ArcClockwise || move.kind == MoveKind::ArcCounterclockwise ||
         move.kind == MoveKind::ArcTangential || move.kind == MoveKind::Modal;
}

bool isOn(const std::optional<RadiusCompensation>& compensation) { return compensation != RadiusCompensation::Off; }

}  // namespace

void ToSinumerik::followCompensation(const Instruction& instruction, std::optional<RadiusCompensation>& compensation) {
  const auto* move = std::get_if<Move>(&instruction);
  const bool ends = std::holds_alternative<ToolCall>(instruction) || std::holds_alternative<Transform>(instruction) ||
                    std::holds_alternative<CycleCall>(instruction) ||
                    (move != nullptr && (move->machineCoordinates || move->machineReference2));
  if (ends) compensation = RadiusCompensation::Off;
  if (move != nullptr && move->compensation != RadiusCompensation::Unchanged) compensation = move->compensation;
}

void ToSinumerik::listCompensation(const Block& block, const Instruction& instruction) {
  if (!compensates_) return;
  const std::optional<RadiusCompensation> before = compensation_;
  followCompensation(instruction, compensation_);
  const auto* move = std::get_if<Move>(&instruction);
  const bool onPath = move != nullptr && !move->machineCoordinates && !move->machineReference2 && !isCorner(*move) &&
                      move->kind != MoveKind::SetCentre;
  const bool elsewhere = std::holds_alternative<ToolCall>(instruction) ||
                         std::holds_alternative<Transform>(instruction) ||
                         std::holds_alternative<CycleCall>(instruction) ||
                         (move != nullptr && (move->machineCoordinates || move->machineReference2));
  if (elsewhere && isOn(before)) {
    out_.list(block, "radius compensation is in effect before this block, which ends it on a HEIDENHAIN control only",
              "end it with R0 in a straight line before this block");
  } else if (onPath && isOn(compensation_) && !isOn(before) && isArc(*move)) {
    out_.list(block, "radius compensation begins with an arc, which a SINUMERIK refuses",
              "begin it in a straight line before the arc");
  } else if (onPath && (isOn(before) || isOn(compensation_)) &&
             (move->words.count == 0 || (before != compensation_ && !movesInPlane(block, *move)))) {
    out_.list(block,
              "a block without coordinates of the plane moves the tool of a HEIDENHAIN control where radius "
              "compensation begins, ends or goes on; a SINUMERIK waits for the next path",
              "write coordinates of the plane in this block");
  } else if (onPath && isOn(before) && isOn(compensation_) && move->rapid != lastPath_.rapid) {
    out_.list(block,
              "between a path at rapid traverse and one at a feed the tool goes round the corner at another speed on a "
              "SINUMERIK",
              "give all paths with radius compensation a feed");
  } else if (onPath && isOn(before) && isOn(compensation_) && before != compensation_) {
    out_.list(block, "the side of radius compensation changes, which the two controls do in another way",
              "end it with R0 in a straight line before this block");
  }
}

bool ToSinumerik::movesInPlane(const Block& block, const Move& move) const {
  const auto words = std::span<const Word>(block.words).subspan(move.words.first, move.words.count);
  return move.polar || std::ranges::any_of(words, [&](const Word& word) {
           const auto index = planeIndex(word.address);
           return index && *index < 2;
         });
}

std::string ToSinumerik::cornerWord(const Block& block, const Move& move, const Quantity& size) {
  const std::string cornerFeed =
      move.feed.present() ? fmt::format(" FRC={}", sinumerikText(feed(block, move.feed))) : std::string();
  return fmt::format(" {}={}{}", move.kind == MoveKind::Rounding ? "RND" : "CHR", sinumerikText(size), cornerFeed);
}

PlanePoint ToSinumerik::endOf(const Block& block, const Move& move) const {
  PlanePoint end = {position_[0], position_[1]};
  for (const Word& word : std::span<const Word>(block.words).subspan(move.words.first, move.words.count)) {
    const auto index = planeIndex(word.address);
    if (!index || *index > 1) continue;
    const auto value = literalOf(block, word.value);
    auto& coordinate = end[*index];
    const bool known = value && (word.mode != WordMode::Incremental || coordinate);
    coordinate = !known                               ? std::optional<Quantity>()
                 : word.mode == WordMode::Incremental ? *coordinate + *value
                                                      : Quantity(*value);
  }
  return move.polar ? PlanePoint() : end;
}

std::optional<ToSinumerik::NextPath> ToSinumerik::nextPath(const Block& block) {
  Block next;
  Diagnostics ignored;
  for (BlockPosition at = block.next; program_.parse(at, next, ignored); at = next.next) {
    if (next.instructions.empty()) continue;
    const auto found = std::ranges::find_if(next.instructions,
                                            [](const Instruction& each) { return std::holds_alternative<Move>(each); });
    if (found == next.instructions.end()) return std::nullopt;
    const Move& move = std::get<Move>(*found);
    if (isCorner(move)) return std::nullopt;
    if (move.kind == MoveKind::SetCentre) continue;
    return NextPath{.rapid = move.rapid,
                    .arc = isArc(move),
                    .hasFeed = move.feed.present(),
                    .compensates = compensates_ && move.compensation != RadiusCompensation::Unchanged &&
                                   compensation_ != move.compensation,
                    .to = endOf(next, move)};
  }
  return std::nullopt;
}

void ToSinumerik::corner(const Block& block, const Move& move) {
  // A HEIDENHAIN control rounds and chamfers only where the corner comes directly after its path.
  const bool follows = lastMove_ != 0 && program_.cornerFollows(lastPath_.next);
  if (!follows || block.skippable != lastPath_.skippable) {
    throw NotCarriedOver("there is no path directly before this corner",
                         "write it in the block after the path that it ends");
  }
  const std::optional<NextPath> next = nextPath(block);
  if (!next || next->compensates) {
    out_.list(block,
              "this corner is not followed by a path, or by the begin or end of radius compensation: the two controls "
              "round and chamfer differently there",
              "let a path follow it directly");
  } else if (move.kind == MoveKind::Chamfer && (lastPath_.arc || next->arc)) {
    out_.list(block, "a HEIDENHAIN control chamfers between straight lines only and stops here; a SINUMERIK goes on",
              "write the chamfer as a line");
  } else if (lastPath_.rapid || next->rapid) {
    out_.list(block, "a corner between paths at rapid traverse is travelled at another speed on a SINUMERIK",
              "give the paths before and after the corner a feed");
  } else if (!move.feed.present() && next->hasFeed) {
    out_.list(block,
              "this corner is travelled at the feed of the path before it, on a SINUMERIK at that of the path after it",
              "write the feed in the block of the corner");
  }
  const auto words = std::span<const Word>(block.words).subspan(move.words.first, move.words.count);
  const auto given = std::ranges::find(words, addressOf("R"), &Word::address);
  const Quantity size = given == words.end() ? Quantity() : quantity(block, given->value);
  switch (room_.fitOf(move.kind == MoveKind::Rounding ? Corner::Rounding : Corner::Chamfer, size,
                      lastPath_.arc ? PlanePoint() : lastPath_.from, {position_[0], position_[1]},
                      next && !next->arc ? next->to : PlanePoint())) {
    case CornerRoom::Fit::Fits:
      break;
    case CornerRoom::Fit::TooLarge:
      out_.list(block, tooLargeCorner, "make it smaller");
      break;
    case CornerRoom::Fit::Unknown:
      out_.list(block, cornerOfUnknownRoom, "see that it fits", Severity::Note);
      break;
  }
  std::string& path = out_.at(lastMove_ - 1);
  path.insert(std::min(path.find(" ;"), path.size()), cornerWord(block, move, size));
  lastMove_ = 0;  // it has its corner
}

void ToSinumerik::listFeedOfOtherKind(const Block& block, const Move& move) {
  if (move.feed.present()) feedOfOtherKind_ = false;
  if (!feedOfOtherKind_ || move.rapid || move.words.count == 0) return;
  feedOfOtherKind_ = false;
  out_.list(block, "after M136 and M137 a SINUMERIK needs a new feed (F)", "program F in this block");
}

}  // namespace probewright::conversion

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "conversion/sinumerik_formulas.hpp"
#include "conversion/to_klartext.hpp"

/// Motion of SINUMERIK programs in Klartext.
namespace probewright::conversion {

using namespace language;

namespace {

bool isAxis(std::uint32_t address) {
  return address < 128 && std::string_view("XYZABCUVW").find(static_cast<char>(address)) != std::string_view::npos;
}

const Word* find(std::span<const Word> words, std::string_view address) {
  const auto found = std::ranges::find(words, addressOf(address), &Word::address);
  return found == words.end() ? nullptr : &*found;
}

/// DC of rotary axes, which M126 and M127 say for all of them. Throws NotCarriedOver for ways that they do not tell.
bool goesShortestWay(std::span<const Word> words) {
  const auto isRotary = [](const Word& word) { return word.address >= 'A' && word.address <= 'C'; };
  const auto goes = [&](WordMode mode) {
    return std::ranges::any_of(words, [&](const Word& word) { return isRotary(word) && word.mode == mode; });
  };
  if (goes(WordMode::DirectPositive) || goes(WordMode::DirectNegative)) {
    throw NotCarriedOver("ACP and ACN say which way a rotary axis turns, which has no twin in Klartext",
                         "write DC for the shortest way, or IC with the angle to turn by");
  }
  if (!goes(WordMode::DirectShortest)) return false;
  const bool other = std::ranges::any_of(
      words, [&](const Word& word) { return isRotary(word) && word.mode != WordMode::DirectShortest; });
  if (other) {
    throw NotCarriedOver("M126 is for all rotary axes of a block, DC for one of them",
                         "move the rotary axes in blocks of their own");
  }
  return true;
}

}  // namespace

std::string ToKlartext::coordinate(const Block& block, const Word& word) {
  const Quantity value = quantity(block, word.value);
  rely(block, incrementalDoubtful_ && word.mode == WordMode::Plain, "G90 or G91");
  const bool incremental = word.mode == WordMode::Incremental || (word.mode == WordMode::Plain && incremental_);
  if (word.address >= 'A' && word.address <= 'C' && isBeyondATurn(value)) out_.list(block, beyondATurn, withinATurn);
  if (std::exchange(besideMeasured_, besideMeasured_ && incremental) && incremental) {
    out_.list(block, "this counts from where the probe was touched, but the stylus has been retracted",
              "give the coordinate as an absolute one");
  }
  if (const auto index = planeIndex(word.address)) {
    auto& now = position_[*index];
    if (incremental && beside_[*index]) {
      out_.list(block, "this counts from where the measuring cycle has left the probe, which is elsewhere here",
                "give the coordinate as an absolute one");
    }
    if (!incremental) {
      beside_[*index] = false;
      now = value;
    } else if (now) {
      now = *now + value;
    }
  }
  return fmt::format(" {}{}{}", incremental ? "I" : "", addressName(word.address), formulas_.value(value));
}

bool ToKlartext::callsEdge(const Block& block) {
  return std::ranges::any_of(block.instructions, [&](const Instruction& instruction) {
    const auto* modal = std::get_if<Modal>(&instruction);
    return modal != nullptr && block.at(modal->name) == "D" &&
           !(quantity(block, block.words[modal->words.first].value) == 0);
  });
}

void ToKlartext::move(const Block& block, const Move& move) {
  const PlanePoint from = {position_[0], position_[1]};
  const auto words = std::span<const Word>(block.words).subspan(move.words.first, move.words.count);
  if (move.compensation != RadiusCompensation::Unchanged) {
    compensation_ = move.compensation == RadiusCompensation::Off    ? "R0"
                    : move.compensation == RadiusCompensation::Left ? "RL"
                                                                    : "RR";
  }
  if (move.compensation != RadiusCompensation::Unchanged) compensationDoubtful_ = false;
  if (move.kind != MoveKind::Modal) {
    motion_ = move.kind;
    motionDoubtful_ = false;
  }
  rely(block, motionDoubtful_ && !words.empty(), "the path function (G0, G1, G2, G3)");
  rely(block, compensationDoubtful_ && !words.empty(), "the radius compensation (G40, G41, G42)");
  const std::string_view variant = block.at(move.variant);
  const bool onMachine = variant == "SUPA" || variant == "G53" || variant == "G153";
  if (!onMachine && !variant.empty()) throw NotCarriedOver(fmt::format("{} has no twin in Klartext", variant));
  for (const Word& word : words) {
    const std::string address = addressName(word.address);
    static constexpr std::array<std::string_view, 7> known = {"I", "J", "K", "CR", "RND", "CHR", "FRC"};
    if (!isAxis(word.address) && std::ranges::find(known, address) == known.end()) {
      throw NotCarriedOver(fmt::format("{} in a motion block has no twin in Klartext", address));
    }
  }
  const bool ofCorner = !words.empty() && std::ranges::all_of(words, [](const Word& word) {
    const std::string address = addressName(word.address);
    return address == "RND" || address == "CHR" || address == "FRC";
  });
  if (ofCorner)
    throw NotCarriedOver("RND, CHR and FRC without a path in their block have no twin in Klartext",
                         "write them in the block of the path that the corner ends");
  const bool shortest = goesShortestWay(words);
  const auto given = [&](std::size_t index) { return find(words, axis(index)) != nullptr; };
  if (!onMachine && given(2) && withoutLength_ != std::optional(false) && !callsEdge(block)) {
    out_.list(block, "with D0 heights count without the length of the tool, on a HEIDENHAIN control always with it",
              "program D1 before this block");
  }
  if (!words.empty()) listFeedOfOtherKind(block, move);
  if (!words.empty() && !onMachine) listCompensatedPath(block, words);
  const bool path = motion_ != MoveKind::Rapid && motion_ != MoveKind::Linear;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!beside_[i] || (given(i) && !path) || (!given(1 - i) && !path) || words.empty()) continue;
    out_.list(
        block,
        "this block moves in the plane from where the measuring cycle has left the probe, which is elsewhere here",
        "give both coordinates");
    break;
  }
  std::string ending;
  if (move.feed.present()) ending = feedWord(block, move.feed);
  if (shortest) line("M126");
  switch (motion_) {
    case MoveKind::Rapid:
    case MoveKind::Linear: {
      std::string text = "L";
      for (const Word& word : words)
        if (isAxis(word.address)) text += coordinate(block, word);
      const bool rapid = motion_ == MoveKind::Rapid;
      if (onMachine) {
        const bool suppressed = std::ranges::any_of(block.instructions, [&](const Instruction& instruction) {
          const auto* modal = std::get_if<Modal>(&instruction);
          return modal != nullptr && block.at(modal->name) == "D" &&
                 quantity(block, block.words[modal->words.first].value) == 0;
        });
        if (!suppressed) out_.list(block, "M91 counts without the length of the tool", "write D0 in this block");
        forgetPosition();
      }
      if (rapid && !ending.empty()) line(fmt::format("L {}{}", compensation_, ending));  // for the next path
      line(fmt::format("{} {}{}{}", text, compensation_, rapid ? " FMAX" : ending, onMachine ? " M91" : ""));
      break;
    }
    case MoveKind::ArcClockwise:
    case MoveKind::ArcCounterclockwise:
      arc(block, move, motion_ == MoveKind::ArcClockwise);
      break;
    case MoveKind::ArcTangential: {
      std::string text = "CT";
      for (const Word& word : words)
        if (isAxis(word.address)) text += coordinate(block, word);
      line(text + ending);
      break;
    }
    default:
      throw NotCarriedOver("this path function has no twin in Klartext", "write lines and arcs");
  }
  corner(block, words, from);
  if (shortest) line("M127");
}

void ToKlartext::arc(const Block& block, const Move& move, bool clockwise) {
  const auto words = std::span<const Word>(block.words).subspan(move.words.first, move.words.count);
  const std::string direction = clockwise ? " DR-" : " DR+";
  std::string ending;
  if (move.feed.present()) ending = feedWord(block, move.feed);
  const Word* radius = find(words, "CR");
  std::string centre = "CC";
  if (radius == nullptr) {
    static constexpr std::array<const char*, 3> letters = {"I", "J", "K"};
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string name = axis(i);
      const Word* word = find(words, letters[static_cast<std::size_t>(name[0] - 'X')]);
      const bool absolute = word != nullptr && word->mode == WordMode::Absolute;
      const Quantity value = word == nullptr ? Quantity() : quantity(block, word->value);
      centre += fmt::format(" {}{}{}", absolute ? "" : "I", name, formulas_.value(value));
    }
    line(centre);
  }
  std::string ends;
  bool inPlane = false;
  for (const Word& word : words) {
    if (!isAxis(word.address)) continue;
    const auto index = planeIndex(word.address);
    inPlane = inPlane || (index && *index < 2);
    ends += coordinate(block, word);
  }
  if (radius != nullptr) {
    line(fmt::format("CR{} R{}{} {}{}", ends, formulas_.value(quantity(block, radius->value)), direction, compensation_,
                     ending));
  } else if (!inPlane) {
    line(fmt::format("CP IPA{}360{}{} {}{}", clockwise ? '-' : '+', ends, direction, compensation_, ending));
  } else {
    line(fmt::format("C{}{} {}{}", ends, direction, compensation_, ending));
  }
}

}  // namespace probewright::conversion

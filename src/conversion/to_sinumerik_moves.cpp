#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conversion/to_sinumerik.hpp"

/// Motion of HEIDENHAIN programs in the language of a SINUMERIK.
namespace probewright::conversion {

using namespace language;

namespace {

std::span<const Word> wordsOf(const Block& block, WordRange range) {
  return std::span<const Word>(block.words).subspan(range.first, range.count);
}

const Word* find(std::span<const Word> words, std::string_view address) {
  const auto found = std::ranges::find(words, addressOf(address), &Word::address);
  return found == words.end() ? nullptr : &*found;
}

bool isAxis(std::uint32_t address) {
  return address < 128 && std::string_view("XYZABCUVW").find(static_cast<char>(address)) != std::string_view::npos;
}

/// `radius` times a function ("COS") of `degrees`.
Quantity projected(const Quantity& radius, const char* function, const Quantity& degrees) {
  if (degrees.isNumber()) {
    const double angle = degrees.number() * std::numbers::pi / 180;
    return radius * (std::string_view(function) == "COS" ? std::cos(angle) : std::sin(angle));
  }
  return Quantity::of(fmt::format("{}*{}({})", factorText(sinumerikText(radius)), function, sinumerikText(degrees)));
}

}  // namespace

std::string ToSinumerik::feedWord(const Block& block, const Move& move) {
  if (!move.feed.present()) return {};
  return fmt::format(" {}", addressWord("F", feed(block, move.feed)));
}

void ToSinumerik::loseWords(const Block& block, const Move& move) {
  if (move.autoFeed) out_.lose(block, "FAUTO: the feed that the tool was called with");
  for (const Word& word : wordsOf(block, move.words)) {
    const std::string name = addressName(word.address);
    if (name == "FU" || name == "FZ" || name == "FT") {
      out_.lose(block, fmt::format("{}: a feed per revolution, per tooth or as a time", name));
    } else if (name.size() == 2 && (name[0] == 'N' || name[0] == 'T') && isAxis(static_cast<std::uint32_t>(name[1]))) {
      out_.lose(block, fmt::format("{}: a vector of the surface or the tool", name));
    } else if (name == "R" && word.mode == WordMode::DirectShortest) {
      out_.lose(block, "R+, R-: radius compensation along the axes");
    }
  }
}

std::string ToSinumerik::axisWords(const Block& block, const Move& move) {
  std::string text;
  for (const Word& word : wordsOf(block, move.words)) {
    if (!isAxis(word.address)) continue;
    const Quantity value = quantity(block, word.value);
    const std::string name = addressName(word.address);
    const auto index = planeIndex(word.address);
    const bool incremental = word.mode == WordMode::Incremental;
    if (word.address >= 'A' && word.address <= 'C' && isBeyondATurn(value)) out_.list(block, beyondATurn, withinATurn);
    if (incremental && index && !position_[*index] && besidePath_ && *index < 2) {
      out_.list(block, fmt::format("I{} counts from where the measuring cycle has left the probe", name),
                "give the coordinate as an absolute one");
    }
    text += incremental ? fmt::format(" {}=IC({})", name, sinumerikText(value))
                        : fmt::format(" {}", addressWord(name, value));
    if (!index) continue;
    auto& coordinate = position_[*index];
    if (!incremental) {
      coordinate = value;
    } else if (coordinate) {
      coordinate = *coordinate + value;
    }
  }
  return text;
}

void ToSinumerik::wherePolar(const Block& block, const Move& move, Place& target) {
  if (!centre_[0] || !centre_[1]) throw NotCarriedOver("the pole (CC) is not known here", "program CC before it");
  const auto words = wordsOf(block, move.words);
  const Word* radius = find(words, "PR");
  const Word* angle = find(words, "PA");
  const bool absolute = radius != nullptr && angle != nullptr && radius->mode != WordMode::Incremental &&
                        angle->mode != WordMode::Incremental;
  if (!absolute) {
    throw NotCarriedOver("polar coordinates that continue from the last position are not converted",
                         "give radius PR and angle PA in the block");
  }
  const Quantity distance = quantity(block, radius->value), direction = quantity(block, angle->value);
  target[0] = *centre_[0] + projected(distance, "COS", direction);
  target[1] = *centre_[1] + projected(distance, "SIN", direction);
}

void ToSinumerik::setCentre(const Block& block, const Move& move) {
  const auto words = wordsOf(block, move.words);
  if (words.empty()) centre_ = {position_[0], position_[1]};
  for (const Word& word : words) {
    const auto index = planeIndex(word.address);
    if (!index || *index > 1) throw NotCarriedOver("CC has two coordinates of the working plane");
    const Quantity value = quantity(block, word.value);
    if (word.mode != WordMode::Incremental) {
      centre_[*index] = value;
    } else {
      centre_[*index] = position_[*index] ? std::optional(*position_[*index] + value) : std::nullopt;
    }
  }
}

std::string ToSinumerik::centreWords() const {
  if (!centre_[0] || !centre_[1]) {
    throw NotCarriedOver("the circle centre (CC) is not known here", "program CC with both coordinates before it");
  }
  static constexpr const char* letters[] = {"I", "J", "K"};
  std::string text;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = axis(i);
    text += fmt::format(" {}=AC({})", letters[name[0] - 'X'], sinumerikText(*centre_[i]));
  }
  return text;
}

void ToSinumerik::moveOnMachine(const Block& block, const Move& move) {
  if (move.machineReference2) throw NotCarriedOver("M92 counts from a point that only the machine builder knows");
  std::string text;
  for (const Word& word : wordsOf(block, move.words)) {
    if (word.mode == WordMode::Incremental) throw NotCarriedOver("incremental positions with M91 are not converted");
    text += fmt::format(" {}", addressWord(addressName(word.address), quantity(block, word.value)));
  }
  out_.line(fmt::format("SUPA {}{} D0{}", move.rapid ? "G0" : "G1", text, feedWord(block, move)));
  callEdgeAgain();
  forgetPosition();
}

void ToSinumerik::callEdgeAgain() {
  if (spindle_ == Spindle::Empty) return;
  if (spindle_) return out_.line("D1");
  out_.line("IF $P_TOOLNO<>0");
  out_.line("  D1");
  out_.line("ENDIF");
}

void ToSinumerik::move(const Block& block, const Move& move) {
  if (move.kind == MoveKind::SetCentre) return setCentre(block, move);
  loseWords(block, move);
  if (move.machineCoordinates || move.machineReference2) return moveOnMachine(block, move);
  if (move.kind == MoveKind::Rounding || move.kind == MoveKind::Chamfer) {
    return corner(block, move);
  }
  listFeedOfOtherKind(block, move);
  const PlanePoint from = {position_[0], position_[1]};
  std::string compensation;
  if (compensates_ && move.compensation == RadiusCompensation::Off) compensation = "G40 ";
  if (move.compensation == RadiusCompensation::Left) compensation = "G41 ";
  if (move.compensation == RadiusCompensation::Right) compensation = "G42 ";

  std::string words;
  if (move.polar && move.kind == MoveKind::Linear) {
    Place target;
    wherePolar(block, move, target);
    for (std::size_t i = 0; i < 2; ++i) {
      words += fmt::format(" {}", addressWord(axis(i), target[i]));
      position_[i] = target[i];
    }
  } else if (move.polar) {
    throw NotCarriedOver("arcs in polar coordinates are not converted", "write them with C or CR");
  }
  words += axisWords(block, move);
  const auto given = wordsOf(block, move.words);
  std::string path;
  switch (move.kind) {
    case MoveKind::Linear:
    case MoveKind::Rapid:
      path = move.rapid ? "G0" : "G1";
      break;
    case MoveKind::ArcTangential:
      if (move.rapid) out_.lose(block, "FMAX: a SINUMERIK travels arcs at a feed");
      if (!lastPath_.inPlane) {
        out_.list(block, "this arc continues a path in the plane, and none comes directly before it: a SINUMERIK stops",
                  "write a path in the plane before it, or the arc with CC and C");
      }
      path = "CT";
      break;
    case MoveKind::ArcClockwise:
    case MoveKind::ArcCounterclockwise:
    case MoveKind::Modal: {
      if (move.kind == MoveKind::ArcClockwise) arcDirection_ = -1;
      if (move.kind == MoveKind::ArcCounterclockwise) arcDirection_ = 1;
      if (move.rapid) out_.lose(block, "FMAX: a SINUMERIK travels arcs at a feed");
      if (arcDirection_ == 0) throw NotCarriedOver("the direction of this arc is not known", "program DR+ or DR-");
      path = arcDirection_ < 0 ? "G2" : "G3";
      const Word* radius = find(given, "R");
      words += radius != nullptr ? fmt::format(" CR={}", sinumerikText(quantity(block, radius->value))) : centreWords();
      break;
    }
    default:
      throw NotCarriedOver("APPR and DEP have no twin on a SINUMERIK", "write the approach as straight lines and arcs");
  }
  const std::string ending = feedWord(block, move);
  if (words.empty()) {  // a change of compensation or feed alone
    const std::string rest = compensation + (ending.empty() ? "" : ending.substr(1));
    if (!rest.empty()) out_.line(std::string(trimmed(rest, lineBlanks)));
    return;
  }
  if (besidePath_) {
    const bool both = find(given, axis(0)) != nullptr && find(given, axis(1)) != nullptr;
    const bool neither = find(given, axis(0)) == nullptr && find(given, axis(1)) == nullptr;
    if (!both && !neither && !move.polar) {
      out_.list(block, "this block moves one axis of the plane from where the measuring cycle has left the other",
                "give both coordinates");
    }
    if (!neither) besidePath_ = false;
  }
  out_.line(compensation + path + words + ending);
  if (!program_.cornerFollows(block.next)) room_.pathWithoutCorner();
  lastMove_ = out_.size();
  lastPath_ = {.next = block.next,
               .rapid = move.rapid,
               .arc = move.kind != MoveKind::Linear && move.kind != MoveKind::Rapid,
               .inPlane = movesInPlane(block, move),
               .skippable = block.skippable,
               .from = from};
}

}  // namespace probewright::conversion

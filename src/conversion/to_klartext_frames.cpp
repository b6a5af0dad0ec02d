#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conversion/sinumerik_formulas.hpp"
#include "conversion/to_klartext.hpp"

/// Frames of SINUMERIK programs in Klartext, and what they do to the coordinates of touch probe cycles.
namespace probewright::conversion {

using namespace language;

namespace {

/// The coordinates of a place, turned by the angle about the tool axis.
void turn(Place& place, double degrees) {
  const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
  const Quantity main = place[0], minor = place[1];
  place[0] = main * c - minor * s;
  place[1] = main * s + minor * c;
}

}  // namespace

std::optional<int> ToKlartext::selectedOffset(const Block& block) {
  std::optional<int> offset;
  for (const Instruction& instruction : block.instructions) {
    const auto* modal = std::get_if<Modal>(&instruction);
    if (const auto selected = modal == nullptr ? std::nullopt : settableOf(block.at(modal->name))) offset = selected;
  }
  return offset;
}

void ToKlartext::listLackingRow(const Block& block, const Quantity& row, Lacking lacking) {
  constexpr int last = 98;  // the one after it is row 0, which is always there
  for (const auto& [number, where] : lackingRows_.writtenBy(block, row, selectedRows_, last)) {
    const std::string code = settableCode(number);
    const std::string does = lacking == Lacking::Stops
                                 ? fmt::format("stops here, the SINUMERIK writes {}", code)
                                 : fmt::format(
                                       "takes what nobody sets there from the preset in effect, the SINUMERIK "
                                       "keeps what {} holds",
                                       code);
    out_.list(block,
              fmt::format("PRESET.PR may lack row {}, which this block writes and {} selects: the HEIDENHAIN control "
                          "then {}",
                          number, where, does),
              fmt::format("make sure that PRESET.PR has row {}, with what {} is to hold, before the program runs",
                          number, code));
  }
}

void ToKlartext::writeShift(const std::array<Quantity, 3>& shift) {
  std::vector<std::string> parts = {"CYCL DEF 7.0 DATUM SHIFT"};
  for (std::size_t i = 0; i < 3; ++i)
    if (shiftsEver_[static_cast<std::size_t>(axis(i)[0] - 'X')])
      parts.push_back(fmt::format("CYCL DEF 7.{} {}{}", parts.size(), axis(i), formulas_.value(shift[i])));
  if (parts.size() > 1) writeWhole(std::move(parts));
}

void ToKlartext::writeRotation(const Quantity& angle) {
  writeWhole({"CYCL DEF 10.0 ROTATION", fmt::format("CYCL DEF 10.1 ROT{}", formulas_.value(angle))});
}

/// A quantity that keeps its value when variables change.
Quantity ToKlartext::frozen(const Quantity& quantity, const std::string& name) {
  if (quantity.isNumber()) return quantity;
  const std::string own = formulas_.define(name);
  line(fmt::format("{} = {}", own, spacedExpressionText(quantity)));
  return Quantity::of(own);
}

void ToKlartext::transform(const Block& block, const Transform& transform) {
  const std::string_view name = block.at(transform.name);
  const auto words = std::span<const Word>(block.words).subspan(transform.words.first, transform.words.count);
  const bool adds = name == "ATRANS" || name == "AROT";
  const bool shifts = name == "TRANS" || name == "ATRANS", turns = name == "ROT" || name == "AROT";
  if (!shifts && !turns) throw NotCarriedOver(fmt::format("{} has no twin in Klartext", name), "write it by hand");
  if (adds && (!frame_.known || !frame_.rotation)) {
    throw NotCarriedOver("which frame this one is added to is known only when the program runs",
                         "write it as TRANS or ROT, or put both into one part of the program");
  }
  const bool turned = !frame_.rotation || !(*frame_.rotation == 0);
  std::array<Quantity, 3> shift = adds ? frame_.shift : std::array<Quantity, 3>{};
  Quantity angle = adds ? *frame_.rotation : Quantity();
  if (shifts) {
    if (adds && turned) throw NotCarriedOver("a shift along turned axes has no twin in Klartext");
    for (const Word& word : words) {
      const auto index = planeIndex(word.address);
      if (!index) throw NotCarriedOver("shifts of rotary axes are not converted");
      shift[*index] = shift[*index] + quantity(block, word.value);
    }
  } else {
    const bool plain =
        words.size() == 1 && (words[0].address == addressOf(axis(2)) || words[0].address == addressOf("RPL"));
    if (!plain && !words.empty()) throw NotCarriedOver("rotations out of the working plane are not converted");
    if (!words.empty()) angle = frozen(angle + quantity(block, words[0].value), "rotation of the frame");
  }
  const bool moved = !frame_.known || !(shift == frame_.shift);
  for (std::size_t i = 0; moved && i < 3; ++i)
    if (!(frame_.known && shift[i] == frame_.shift[i])) shift[i] = frozen(shift[i], fmt::format("shift {}", axis(i)));
  // TRANS and ROT take back what the other has set.
  if (turned && !turns) writeRotation(0);
  if (moved) writeShift(shift);
  if (turns) writeRotation(angle);
  frame_ = {.known = true, .shift = shift, .rotation = angle};
  forgetPosition();
}

void ToKlartext::readFrame() {
  if (frame_.known) return;
  for (std::size_t i = 0; i < 3; ++i) {
    frame_.shift[i] = Quantity();
    if (!shiftsEver_[static_cast<std::size_t>(axis(i)[0] - 'X')]) continue;
    const std::string own = formulas_.define(fmt::format("shift {}", axis(i)));
    line(fmt::format("FN 18: SYSREAD {} = ID220 NR2 IDX{}", own, axis(i)[0] - 'X' + 1));
    if (millimetre_ != 1) line(fmt::format("{0} = {0} / 25.4", own));
    frame_.shift[i] = Quantity::of(own);
  }
  frame_.known = true;
}

void ToKlartext::requireFrame() {
  if (!frame_.rotation) {
    throw NotCarriedOver("whether the coordinate system is turned here is known only when the program runs",
                         "touch probe cycles permit no rotation: cancel it with ROT before the cycle");
  }
  readFrame();
}

void ToKlartext::cancelFrame() {
  requireFrame();
  if (!(*frame_.rotation == 0)) writeRotation(0);
  if (isShifted()) writeShift({});
}

void ToKlartext::restoreFrame() {
  if (isShifted()) writeShift(frame_.shift);
  if (!(*frame_.rotation == 0)) writeRotation(*frame_.rotation);
}

bool ToKlartext::isShifted() const {
  return std::ranges::any_of(frame_.shift, [](const Quantity& each) { return !(each == 0); });
}

bool ToKlartext::frameIsNone() const {
  return frame_.known && !isShifted() && frame_.rotation && *frame_.rotation == 0;
}

bool ToKlartext::leaveFrame(MeasuringTask& task) {
  requireFrame();
  const bool turned = !(*frame_.rotation == 0);
  if (!isShifted() && !turned) return false;
  const bool calibrates = task.feature == Feature::ProbeInRing || task.feature == Feature::ProbeOnBall ||
                          task.feature == Feature::ProbeLength;
  if (turned && (!isRound(task.feature) || !frame_.rotation->isNumber() || task.correction != Correction::None)) {
    throw NotCarriedOver("touch probe cycles permit no rotation by the program, and this feature lies along its axes",
                         "cancel the rotation with ROT, and turn the zero offset instead");
  }
  if (calibrates && turned) throw NotCarriedOver("touch probe cycles permit no rotation by the program");
  const double degrees = frame_.rotation->number();
  const auto leave = [&](Place& place) {
    if (turned) turn(place, degrees);
    for (std::size_t i = 0; i < 3; ++i)
      place[i] = place[i] + frame_.shift[i];
  };
  leave(task.place);
  for (Place& place : task.further)
    leave(place);
  if (task.feature == Feature::Surface) {
    task.size[0] = task.size[0] + frame_.shift[static_cast<std::size_t>(task.axis)];
  }
  task.clearance = task.clearance + frame_.shift[2];
  for (std::size_t i = 0; i < 3; ++i)
    if (task.wish[i]) *task.wish[i] = *task.wish[i] + frame_.shift[i];
  if (isRound(task.feature)) task.angle = task.angle + degrees;
  cancelFrame();
  return true;
}

void ToKlartext::comeBackToFrame(const MeasuringTask& task, Results& results) {
  restoreFrame();
  const auto found = [&](Meaning meaning) -> std::optional<Quantity> {
    const auto result = results.find(meaning);
    return result == results.end() ? std::nullopt : std::optional(Quantity::of(result->second));
  };
  const auto put = [&](Meaning meaning, const Quantity& value) {
    results[meaning] = fmt::format("({})", spacedExpressionText(value));
  };
  if (const auto coordinate = found(Meaning::Coordinate)) {
    put(Meaning::Coordinate, *coordinate - frame_.shift[static_cast<std::size_t>(task.axis)]);
  }
  const auto main = found(Meaning::Centre1), minor = found(Meaning::Centre2);
  if (!main || !minor) return;
  Place centre = {*main - frame_.shift[0], *minor - frame_.shift[1], {}};
  turn(centre, -frame_.rotation->number());
  put(Meaning::Centre1, centre[0]);
  put(Meaning::Centre2, centre[1]);
  // Deviations count along the axes, too.
  results.erase(Meaning::Centre1Deviation);
  results.erase(Meaning::Centre2Deviation);
}

}  // namespace probewright::conversion

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "conversion/modes.hpp"
#include "conversion/to_sinumerik.hpp"
#include "language/klartext/commands.hpp"

/// Frames of HEIDENHAIN programs in the language of a SINUMERIK, on every way through the program.
namespace probewright::conversion {

using namespace language;
using klartext::TransformKind;

namespace {

/// X, Y or Z is given. The height alone leads nowhere else in the plane, but which axis that is may differ.
bool leadsToPlace(const Block& block, const Move& move) {
  if (move.kind == MoveKind::SetCentre) return false;
  const auto words = std::span<const Word>(block.words).subspan(move.words.first, move.words.count);
  const auto given = [&](char letter) {
    return std::ranges::any_of(words, [&](const Word& word) { return word.address == static_cast<unsigned>(letter); });
  };
  return static_cast<int>(given('X')) + static_cast<int>(given('Y')) + static_cast<int>(given('Z')) > 1;
}

bool isShift(TransformKind kind) { return kind == TransformKind::DatumShift || kind == TransformKind::TransDatumAxis; }
bool isRotation(TransformKind kind) {
  return kind == TransformKind::Rotation || kind == TransformKind::TransRotation ||
         kind == TransformKind::TransRotationReset;
}

std::optional<std::size_t> letterOf(std::uint32_t address) {
  return address >= 'X' && address <= 'Z' ? std::optional<std::size_t>(address - 'X') : std::nullopt;
}

}  // namespace

bool ToSinumerik::Frame::isNone() const {
  return known && rotation && *rotation == 0 &&
         std::ranges::all_of(shift, [](const Quantity& each) { return each == 0; });
}

void ToSinumerik::writeFrame(const Frame& frame) {
  // The frames of both act together: shift, then rotation.
  std::string words;
  for (std::size_t i = 0; i < 3; ++i)
    if (!(frame.shift[i] == 0)) words += fmt::format(" {}", addressWord(axis(i), frame.shift[i]));
  out_.line(fmt::format("TRANS{}", words));
  if (!(*frame.rotation == 0)) out_.line(fmt::format("AROT {}", addressWord(axis(2), *frame.rotation)));
}

std::optional<int> ToSinumerik::selectedRow(const Block& block) {
  for (const Instruction& instruction : block.instructions) {
    const auto* change = std::get_if<Transform>(&instruction);
    if (change == nullptr || klartext::kindOf(block, *change) != TransformKind::PresetByCycle) continue;
    if (change->words.count == 0) continue;
    if (const auto row = literalOf(block, block.words[change->words.first].value)) return static_cast<int>(*row);
  }
  return std::nullopt;
}

void ToSinumerik::listLackingRow(const Block& block, const Quantity& row) {
  for (const auto& [number, where] : lackingRows_.writtenBy(block, row, selectedRows_, 99)) {
    out_.list(block,
              fmt::format("PRESET.PR may lack row {0}, which this cycle writes and {1} selects: the HEIDENHAIN control "
                          "then takes what no cycle sets there from the preset in effect, the SINUMERIK keeps what {2} "
                          "holds",
                          number, where, settableCode(number)),
              fmt::format("make sure that {} holds what row {} is to hold before the program runs",
                          settableCode(number), number));
  }
}

void ToSinumerik::transform(const Block& block, const Transform& transform) {
  const TransformKind kind = klartext::kindOf(block, transform);
  const auto words = std::span<const Word>(block.words).subspan(transform.words.first, transform.words.count);
  if (kind == TransformKind::PresetByCycle) {
    const Quantity row = words.empty() ? Quantity() : quantity(block, words.front().value);
    if (!row.isNumber()) throw NotCarriedOver("the row of the preset table is known only when the program runs");
    const int number = static_cast<int>(row.number());
    if (number < 0 || number > 99) throw NotCarriedOver("settable zero offsets go from 1 (G54) to 99 (G599)");
    out_.line(settableCode(number));
    // Cycle 247 takes the frames of the program back.
    if (!frame_.isNone()) out_.line("TRANS");
    frame_ = {};
    activeRow_ = number == 0 ? 99 : number;
    selectedRows_.insert(number);
    forgetPosition();
    return;
  }
  requireAxis();
  if (isPlane(kind)) return plane(block, transform);
  Frame frame = frame_;
  const auto frozen = [&](const Quantity& value, const std::string& what) {
    if (value.isNumber()) return value;
    const std::string own = formulas_.declare(fmt::format("_FRAME_{}", what));
    out_.line(fmt::format("{}={}", own, sinumerikText(value)));
    return Quantity::of(own);
  };
  if (isShift(kind)) {
    std::array<bool, 3> given{};
    for (const Word& word : words) {
      const auto index = planeIndex(word.address);
      if (!index) throw NotCarriedOver("datum tables and shifts of rotary axes have no twin on a SINUMERIK");
      const bool incremental = word.mode == WordMode::Incremental;
      given[*index] = !incremental;
      const Quantity value = quantity(block, word.value);
      frame.shift[*index] = frozen(incremental ? frame.shift[*index] + value : value, axis(*index));
    }
    if (words.empty()) throw NotCarriedOver("datum tables have no twin on a SINUMERIK");
    frame.known = frame.known || std::ranges::all_of(given, [](bool each) { return each; });
  } else if (kind == TransformKind::TransDatumReset) {
    frame.known = true;
    frame.shift = {};
  } else if (isRotation(kind)) {
    if (words.empty()) {
      frame.rotation = 0;
    } else {
      const Quantity angle = quantity(block, words.front().value);
      const bool incremental = words.front().mode == WordMode::Incremental;
      if (!incremental) {
        frame.rotation = frozen(angle, "ANGLE");
      } else if (frame.rotation) {
        frame.rotation = frozen(*frame.rotation + angle, "ANGLE");
      }
    }
  } else {
    throw NotCarriedOver(fmt::format("{} has no twin on a SINUMERIK", nameOf(kind)), "write frames by hand");
  }
  if (!frame.known || !frame.rotation) {
    throw NotCarriedOver("which shift and rotation are in effect here is known only when the program runs",
                         "reset both before this block, or give shifts for X, Y and Z");
  }
  writeFrame(frame);
  frame_ = frame;
  forgetPosition();
}

std::optional<ToSinumerik::Spindle> ToSinumerik::calledBy(const Block& block, const ToolCall& call) {
  if (call.name.present()) return Spindle::Tool;
  const auto number = literalOf(block, call.number);
  if (!number) return std::nullopt;
  return *number == 0 ? Spindle::Empty : Spindle::Tool;
}

void ToSinumerik::follow(const Block& block, Modes& modes) {
  for (const Instruction& instruction : block.instructions) {
    followCompensation(instruction, modes.compensation);
    if (const auto* tool = std::get_if<ToolCall>(&instruction)) {
      if (tool->axis != 0) modes.toolAxis = tool->axis;
      if (tool->name.present() || tool->number.present()) modes.spindle = calledBy(block, *tool);
    }
    if (const auto* cycle = std::get_if<CycleCall>(&instruction)) {
      constexpr std::uint32_t numberInTable = 305;
      for (std::uint32_t i = 0; i < cycle->parameters.count; ++i) {
        const Word& word = block.words[cycle->parameters.first + i];
        const auto row = literalOf(block, word.value);
        if (word.address == numberInTable && !(row && *row != 0)) {
          modes.row = row ? std::optional(99) : std::nullopt;  // row 0 is in effect then
        }
      }
    }
    const auto* transform = std::get_if<Transform>(&instruction);
    if (transform == nullptr) continue;
    const TransformKind kind = klartext::kindOf(block, *transform);
    const auto words = std::span<const Word>(block.words).subspan(transform->words.first, transform->words.count);
    const auto first = words.empty() ? std::optional<double>() : literalOf(block, words.front().value);
    if (isPlane(kind)) {
      modes.plane = planeAfter(block, *transform);
    } else if (kind == TransformKind::PresetByCycle) {
      modes.shift = std::array<double, 3>{};
      modes.rotation = 0;
      modes.row = first ? std::optional(*first == 0 ? 99 : static_cast<int>(*first)) : std::nullopt;
      if (first) modes.selected.insert(static_cast<int>(*first));
    } else if (isShift(kind)) {
      std::array<bool, 3> given{};
      std::array<double, 3> absolute{};
      for (const Word& word : words) {
        const auto letter = letterOf(word.address);
        const auto value = literalOf(block, word.value);
        const bool incremental = word.mode == WordMode::Incremental;
        if (!letter || !value) {
          modes.shift.reset();
          return;
        }
        if (modes.shift) (*modes.shift)[*letter] = incremental ? (*modes.shift)[*letter] + *value : *value;
        given[*letter] = !incremental;
        absolute[*letter] = *value;
      }
      if (std::ranges::all_of(given, [](bool each) { return each; })) modes.shift = absolute;
    } else if (kind == TransformKind::TransDatumReset) {
      modes.shift = std::array<double, 3>{};
    } else if (isRotation(kind)) {
      const bool incremental = !words.empty() && words.front().mode == WordMode::Incremental;
      if (words.empty()) {
        modes.rotation = 0;
      } else if (!first || (incremental && !modes.rotation)) {
        modes.rotation.reset();
      } else {
        modes.rotation = incremental ? *modes.rotation + *first : *first;
      }
    }
  }
}

bool ToSinumerik::agree(Modes& with, const Modes& other) {
  const Modes before = with;
  const auto meet = [](auto& one, const auto& two) {
    if (one != two) one.reset();
  };
  meet(with.toolAxis, other.toolAxis);
  meet(with.spindle, other.spindle);
  meet(with.shift, other.shift);
  meet(with.rotation, other.rotation);
  meet(with.plane, other.plane);
  meet(with.compensation, other.compensation);
  meet(with.row, other.row);
  std::erase_if(with.selected, [&](int row) { return !other.selected.contains(row); });
  return !(with == before);
}

void ToSinumerik::surveyPlaces() {
  if (!graph_.branches() && job_.others.empty()) return;
  const auto follow = [](const Block& each, bool& beside) {
    for (const Instruction& instruction : each.instructions) {
      constexpr int basicRotation = 404;  // nothing moves
      if (const auto* cycle = std::get_if<CycleCall>(&instruction)) {
        beside = beside || (each.at(cycle->name) == "TCH PROBE" && cycle->number != basicRotation);
      } else if (const auto* travel = std::get_if<Move>(&instruction)) {
        beside = beside && !leadsToPlace(each, *travel);
      }
    }
  };
  const auto either = [](bool& with, const bool& other) { return !std::exchange(with, with || other) && with; };
  const std::size_t count = graph_.blocks().size();
  std::vector<bool> neutral(count), calls(count), told(count);
  Block block;
  Diagnostics ignored;
  for (std::size_t i = 0; i < count; ++i) {
    program_.parse(graph_.blocks()[i].position, block, ignored);
    bool no = false, yes = true;
    follow(block, no);
    follow(block, yes);
    calls[i] = !job_.others.empty() && callsProgram(block);
    neutral[i] = !no && yes && !calls[i];
    if (calls[i] && i + 1 < count) told[i + 1] = true;
  }
  bool first = false;
  if (job_.called && count > 0) {
    meetOthers(job_, first, follow, either);
    told[0] = true;
  }
  const auto followBlock = [&](std::size_t place, bool& beside) {
    if (neutral[place]) return;
    program_.parse(graph_.blocks()[place].position, block, ignored);
    follow(block, beside);
    if (calls[place]) meetOthers(job_, beside, follow, either);
  };
  besides_ = modesWhereWaysMeet<bool>(graph_, followers(graph_, neutral), followBlock, either, first, told);
}

void ToSinumerik::surveyModes() {
  if (!graph_.branches() && job_.others.empty()) return;
  Block block;
  Diagnostics ignored;
  std::vector<bool> neutral(graph_.blocks().size()), calls(neutral.size()), doubtful(neutral.size());
  for (std::size_t i = 0; i < neutral.size(); ++i) {
    program_.parse(graph_.blocks()[i].position, block, ignored);
    Modes modes;
    modes.toolAxis = 'U';  // values that no block sets
    modes.spindle = Spindle::Unset;
    modes.shift = std::array<double, 3>{0.0123456789, 0.0123456789, 0.0123456789};
    modes.rotation = 0.0123456789;
    modes.plane = Plane{.isTilted = true, .angles = {0.0123456789, 0.0123456789, 0.0123456789}};
    modes.compensation = RadiusCompensation::Unchanged;
    modes.row = -1;
    const Modes before = modes;
    follow(block, modes);
    calls[i] = !job_.others.empty() && callsProgram(block);
    neutral[i] = modes == before && !calls[i];
    if (calls[i] && i + 1 < doubtful.size()) doubtful[i + 1] = true;
  }
  const auto followBlock = [&](std::size_t place, Modes& modes) {
    if (neutral[place]) return;
    program_.parse(graph_.blocks()[place].position, block, ignored);
    follow(block, modes);
    if (calls[place]) meetOthers(job_, modes, follow, agree);
  };
  Modes first;
  if (job_.called && !doubtful.empty()) {
    meetOthers(job_, first, follow, agree);
    first.row.reset();
    doubtful[0] = true;
  }
  entries_ = modesWhereWaysMeet<Modes>(graph_, followers(graph_, neutral), followBlock, agree, first, doubtful);
}

void ToSinumerik::adopt(const Block& block) {
  if (fromBeyondATurn_.contains(block.position.offset))
    out_.listOnce(block, fromBeyondATurn, withinATurn, Severity::Note);
  if (const auto beside = besides_.find(block.position.offset); beside != besides_.end()) besidePath_ = beside->second;
  const auto found = entries_.find(block.position.offset);
  if (found == entries_.end()) return;
  const Modes& modes = found->second;
  axisDoubtful_ = !modes.toolAxis;
  spindle_ = modes.spindle;
  compensation_ = modes.compensation;
  if (modes.toolAxis && (*modes.toolAxis == 'X' || *modes.toolAxis == 'Y' || *modes.toolAxis == 'Z')) {
    toolAxis_ = *modes.toolAxis;
  }
  frame_.known = modes.shift.has_value();
  frame_.rotation = modes.rotation ? std::optional(Quantity(*modes.rotation)) : std::nullopt;
  for (std::size_t i = 0; i < 3; ++i)
    frame_.shift[i] = modes.shift ? (*modes.shift)[static_cast<std::size_t>(axis(i)[0] - 'X')] : 0;
  plane_ = modes.plane;
  activeRow_ = modes.row;
  selectedRows_ = modes.selected;
  arcDirection_ = 0;
}

void ToSinumerik::requireAxis() const {
  if (axisDoubtful_) {
    throw NotCarriedOver("the tool axis depends on the path that leads to this block",
                         "call the tool with its axis before it");
  }
}

}  // namespace probewright::conversion

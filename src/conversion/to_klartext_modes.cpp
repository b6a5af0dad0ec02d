#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "conversion/modes.hpp"
#include "conversion/sinumerik_formulas.hpp"
#include "conversion/to_klartext.hpp"
#include "cycles/catalogue.hpp"
#include "language/sinumerik/keywords.hpp"

/// What SINUMERIK programs leave in effect from block to block, on every way through the program.
namespace probewright::conversion {

using namespace language;

namespace {

std::optional<std::size_t> letterOf(std::uint32_t address) {
  const std::size_t place =
      address < 128 ? std::string_view("XYZ").find(static_cast<char>(address)) : std::string_view::npos;
  return place == std::string_view::npos ? std::nullopt : std::optional(place);
}

/// The touch probe cycle of this call may leave the probe elsewhere than the original one, and not bring it back: after
/// a correction, and after features whose places it does not tell.
bool mayLeaveElsewhere(const Block& block, const CallProgram& call) {
  const cycles::CycleDefinition* cycle = cycles::sinumerikCycle(block.at(call.name));
  if (cycle == nullptr || cycle->number == 150 || cycle->number == 971) return false;
  if (cycle->number != 977 && cycle->number != 978) return true;
  for (const Word& word : std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count)) {
    if (word.address != 0) continue;  // S_MVAR
    const auto variant = literalOf(block, word.value);
    return !variant || static_cast<int>(*variant) / 100 % 10 == 1;
  }
  return true;
}

/// Of a list of words, separated by blanks.
bool isAmong(std::string_view names, std::string_view name) {
  return fmt::format(" {} ", names).find(fmt::format(" {} ", name)) != std::string::npos;
}

}  // namespace

bool ToKlartext::leavesOut(const Block& block, std::string_view name) {
  if (isAmong("G60 G64 G9 G601 DIAMOF CFC CFTCP", name)) return true;
  using language::sinumerik::Keyword;
  const language::sinumerik::KeywordEntry* word = language::sinumerik::keywordEntry(name);
  const bool ofDynamics =
      word != nullptr && word->effect == language::sinumerik::Effect::Harmless &&
      (word->keyword == Keyword::Modal || word->keyword == Keyword::Setting || word->keyword == Keyword::Axial);
  if (!ofDynamics &&
      !isAmong("G62 G602 G603 G641 G642 G643 G644 G645 BRISKA SOFTA DRIVEA JERKA FGROUP DISPLON DISPLOF SBLON SBLOF "
               "ACTBLOCNO CYCLE832 CYCLE_HSC GROUP_BEGIN GROUP_END GROUP_ADDEND",
               name)) {
    return false;
  }
  out_.leaveOut(block, name, "HEIDENHAIN");
  return true;
}

std::optional<MeasuringTask::Log> ToKlartext::logOf(const Block& block, const CallProgram& call) {
  std::array<int, 2> codes{};  // S_PICT, S_PROT
  for (const Word& word : std::span<const Word>(block.words).subspan(call.arguments.first, call.arguments.count)) {
    if (word.address > 1 || !word.value.present()) continue;
    const auto value = literalOf(block, word.value);
    if (!value) return std::nullopt;
    codes.at(word.address) = static_cast<int>(*value);
  }
  return codes[1] % 10 == 1                              ? MeasuringTask::Log::File
         : codes[0] % 10 == 1 && codes[0] / 10 % 10 == 3 ? MeasuringTask::Log::Screen
                                                         : MeasuringTask::Log::None;
}

void ToKlartext::followTransform(const Block& block, const Transform& transform, Modes& modes) const {
  const std::string_view name = block.at(transform.name);
  const auto words = std::span<const Word>(block.words).subspan(transform.words.first, transform.words.count);
  const bool adds = name == "ATRANS" || name == "AROT";
  if (name == "TRANS" || name == "ATRANS") {
    if (!adds) {
      modes.shift = std::array<double, 3>{};
      modes.rotation = 0;
    }
    for (const Word& word : words) {
      const auto letter = letterOf(word.address);
      const auto value = literalOf(block, word.value);
      if (!letter || !value) {
        modes.shift.reset();
      } else if (modes.shift) {
        (*modes.shift)[*letter] += *value;
      }
    }
  } else if (name == "ROT" || name == "AROT") {
    if (!adds) {
      modes.shift = std::array<double, 3>{};
      modes.rotation = 0;
    }
    const auto angle = words.size() == 1 ? literalOf(block, words[0].value) : std::optional<double>();
    if (!words.empty())
      modes.rotation = angle && modes.rotation ? std::optional(*modes.rotation + *angle) : std::nullopt;
  }
}

bool ToKlartext::isTool(const Block& block, const ToolCall& call) {
  return call.name.present() || literalOf(block, call.number) != std::optional(0.0);
}

void ToKlartext::follow(const Block& block, Modes& modes) const {
  for (const Instruction& instruction : block.instructions) {
    if (const auto* modal = std::get_if<Modal>(&instruction)) {
      const std::string_view name = block.at(modal->name);
      if (name == "G90" || name == "G91") modes.incremental = name == "G91";
      if (name == "G17" || name == "G18" || name == "G19") {
        modes.toolAxis = name == "G17" ? 'Z' : name == "G18" ? 'Y' : 'X';
      }
      if (name == "G0") modes.motion = MoveKind::Rapid;
      if (name == "G1") modes.motion = MoveKind::Linear;
      if (name == "G2") modes.motion = MoveKind::ArcClockwise;
      if (name == "G3") modes.motion = MoveKind::ArcCounterclockwise;
      if (name == "G40" || name == "G41" || name == "G42") {
        modes.compensation = name == "G40" ? "R0" : name == "G41" ? "RL" : "RR";
      }
      if (const auto row = settableOf(name)) {
        modes.row = *row;
        modes.selected.insert(*row);
      }
      if (name == "D" && modal->words.count == 1) {
        const auto edge = literalOf(block, block.words[modal->words.first].value);
        modes.withoutLength = edge ? std::optional(*edge == 0) : std::nullopt;
      }
    } else if (const auto* tool = std::get_if<ToolCall>(&instruction)) {
      modes.hasTool = isTool(block, *tool);
    } else if (const auto* move = std::get_if<Move>(&instruction)) {
      if (move->kind != MoveKind::Modal) modes.motion = move->kind;
      if (move->compensation != RadiusCompensation::Unchanged) {
        modes.compensation = move->compensation == RadiusCompensation::Off    ? "R0"
                             : move->compensation == RadiusCompensation::Left ? "RL"
                                                                              : "RR";
      }
    } else if (const auto* function = std::get_if<MachineFunction>(&instruction)) {
      if (function->number == 6) modes.withoutLength = false;
    } else if (const auto* transform = std::get_if<Transform>(&instruction)) {
      followTransform(block, *transform, modes);
    } else if (const auto* call = std::get_if<CallProgram>(&instruction)) {
      const std::string_view name = block.at(call->name);
      if (name == "CYCLE800") modes.tilted = tiltsPlane(block, *call);
      if (name == "CYCLE800" && !deselectsPlane(block, *call)) {
        modes.shift = std::array<double, 3>{};
        modes.rotation = 0;
      }
      if (name == "CYCLE150") modes.log = logOf(block, *call);
    }
  }
}

bool ToKlartext::agree(Modes& with, const Modes& other) {
  const Modes before = with;
  const auto meet = [](auto& one, const auto& two) {
    if (one != two) one.reset();
  };
  meet(with.toolAxis, other.toolAxis);
  meet(with.incremental, other.incremental);
  meet(with.motion, other.motion);
  meet(with.compensation, other.compensation);
  meet(with.shift, other.shift);
  meet(with.rotation, other.rotation);
  meet(with.row, other.row);
  std::erase_if(with.selected, [&](int row) { return !other.selected.contains(row); });
  meet(with.log, other.log);
  meet(with.withoutLength, other.withoutLength);
  meet(with.tilted, other.tilted);
  meet(with.hasTool, other.hasTool);
  return !(with == before);
}

void ToKlartext::surveyPlaces() {
  const std::size_t count = graph_.blocks().size();
  Block block;
  Diagnostics ignored;
  bool countsFurther = false;  // G91: a plain word may be no place
  const auto isG91 = [&](const Instruction& instruction) {
    const auto* modal = std::get_if<Modal>(&instruction);
    return modal != nullptr && block.at(modal->name) == "G91";
  };
  const auto survey = [&](Program& program) {
    for (BlockPosition at = program.begin(); program.parse(at, block, ignored); at = block.next)
      countsFurther = countsFurther || std::ranges::any_of(block.instructions, isG91);
  };
  survey(program_);
  for (const auto& other : job_.others)
    survey(*other);
  const auto follow = [countsFurther](const Block& each, Beside& beside) {
    for (const Instruction& instruction : each.instructions) {
      if (const auto* call = std::get_if<CallProgram>(&instruction)) {
        if (mayLeaveElsewhere(each, *call)) beside.cycle.fill(true);
      } else if (const auto* command = std::get_if<Command>(&instruction)) {
        if (each.at(command->name) == "MEAS") beside.measured = true;
      } else if (const auto* move = std::get_if<Move>(&instruction)) {
        for (const Word& word : std::span<const Word>(each.words).subspan(move->words.first, move->words.count)) {
          const auto letter = letterOf(word.address);
          const bool absolute = word.mode == WordMode::Absolute || (word.mode == WordMode::Plain && !countsFurther);
          if (!letter || !absolute) continue;
          beside.cycle.at(*letter) = false;
          beside.measured = false;
        }
      }
    }
  };
  const auto either = [](Beside& with, const Beside& other) {
    const Beside before = with;
    for (std::size_t i = 0; i < with.cycle.size(); ++i)
      with.cycle[i] = with.cycle[i] || other.cycle[i];
    with.measured = with.measured || other.measured;
    return !(with == before);
  };
  std::vector<bool> neutral(count), calls(count), told(count);
  for (std::size_t i = 0; i < count; ++i) {
    program_.parse(graph_.blocks()[i].position, block, ignored);
    const Beside all{.cycle = {true, true, true}, .measured = true};
    Beside none, left = all;
    follow(block, none);
    follow(block, left);
    calls[i] = !job_.others.empty() && callsProgram(block);
    neutral[i] = none == Beside() && left == all && !calls[i];
    if (calls[i] && i + 1 < count) told[i + 1] = true;
  }
  Beside first;
  if (job_.called && count > 0) {
    meetOthers(job_, first, follow, either);
    told[0] = true;
  }
  const auto followBlock = [&](std::size_t place, Beside& beside) {
    if (neutral[place]) return;
    program_.parse(graph_.blocks()[place].position, block, ignored);
    follow(block, beside);
    if (calls[place]) meetOthers(job_, beside, follow, either);
  };
  besides_ = modesWhereWaysMeet<Beside>(graph_, followers(graph_, neutral), followBlock, either, first, told);
}

void ToKlartext::surveyModes() {
  Block block;
  Diagnostics ignored;
  const std::size_t count = graph_.blocks().size();
  std::vector<bool> neutral(count), measures(count), calls(count), doubtful(count);
  std::map<std::size_t, std::set<int>> read;
  for (std::size_t i = 0; i < count; ++i) {
    program_.parse(graph_.blocks()[i].position, block, ignored);
    calls[i] = !job_.others.empty() && callsProgram(block);
    neutral[i] = isNeutral(block) && !calls[i];
    if (calls[i] && i + 1 < count) doubtful[i + 1] = true;
    measures[i] = std::ranges::any_of(block.instructions, [&](const Instruction& instruction) {
      const auto* call = std::get_if<CallProgram>(&instruction);
      const auto* cycle = call == nullptr ? nullptr : cycles::sinumerikCycle(block.at(call->name));
      return cycle != nullptr && cycle->number != 150;
    });
    for (const VariableRef& variable : block.variables) {
      const bool result = variable.space == VariableSpace::User && block.at(variable.name) == "_OVR";
      if (result && variable.index[0].isLiteral()) read[i].insert(static_cast<int>(variable.index[0].number));
    }
  }
  const auto next = followers(graph_, neutral);
  surveyResults(next, measures, read);
  const auto meet = [&](Modes& modes) {
    meetOthers(
        job_, modes, [this](const Block& each, Modes& left) { follow(each, left); }, agree);
  };
  const auto followBlock = [&](std::size_t place, Modes& modes) {
    if (neutral[place]) return;
    program_.parse(graph_.blocks()[place].position, block, ignored);
    follow(block, modes);
    if (calls[place]) meet(modes);
  };
  Modes first;
  if (job_.called && count > 0) {
    meet(first);
    first.row.reset();
    first.hasTool = true;  // of the caller
    doubtful[0] = true;
  }
  entries_ = modesWhereWaysMeet<Modes>(graph_, next, followBlock, agree, first, doubtful);
}

bool ToKlartext::isNeutral(const Block& block) const {
  Modes modes;
  modes.toolAxis = 'U';  // values that no block sets
  modes.motion = MoveKind::Depart;
  modes.compensation = "none";
  modes.shift = std::array<double, 3>{0.0123456789, 0.0123456789, 0.0123456789};
  modes.rotation = 0.0123456789;
  modes.row = -1;
  for (const bool incremental : {false, true}) {
    modes.incremental = modes.withoutLength = modes.hasTool = modes.tilted = incremental;
    Modes left = modes;
    follow(block, left);
    if (!(left == modes)) return false;
  }
  return !logs(block);
}

bool ToKlartext::logs(const Block& block) {
  return std::ranges::any_of(block.instructions, [&](const Instruction& instruction) {
    const auto* call = std::get_if<CallProgram>(&instruction);
    return call != nullptr && block.at(call->name) == "CYCLE150";
  });
}

void ToKlartext::surveyResults(const std::vector<std::vector<std::size_t>>& next, const std::vector<bool>& measures,
                               const std::map<std::size_t, std::set<int>>& read) {
  for (std::size_t i = 0; i < next.size() && !read.empty(); ++i) {
    if (!measures[i]) continue;
    std::set<int>& wanted = wantedAfter_[graph_.blocks()[i].position.offset];
    std::set<std::size_t> seen;
    std::vector<std::size_t> open = next[i];
    while (!open.empty()) {
      const std::size_t place = open.back();
      open.pop_back();
      if (!seen.insert(place).second) continue;
      if (const auto found = read.find(place); found != read.end()) {
        wanted.insert(found->second.begin(), found->second.end());
      }
      if (!measures[place]) open.insert(open.end(), next[place].begin(), next[place].end());
    }
  }
}

std::set<int> ToKlartext::wantedAfter(const Block& block) const {
  const auto found = wantedAfter_.find(block.position.offset);
  return found == wantedAfter_.end() ? std::set<int>() : found->second;
}

void ToKlartext::adopt(const Block& block) {
  if (fromBeyondATurn_.contains(block.position.offset))
    out_.listOnce(block, fromBeyondATurn, withinATurn, Severity::Note);
  relied_ = false;
  if (const auto beside = besides_.find(block.position.offset); beside != besides_.end()) {
    for (std::size_t i = 0; i < 3; ++i)
      beside_[i] = beside->second.cycle.at(static_cast<std::size_t>(axis(i)[0] - 'X'));
    besideMeasured_ = beside->second.measured;
  }
  const auto found = entries_.find(block.position.offset);
  if (found == entries_.end()) return;
  const Modes& modes = found->second;
  const auto take = [](auto& member, bool& doubtful, const auto& known) {
    doubtful = !known.has_value();
    if (known) member = *known;
  };
  take(toolAxis_, axisDoubtful_, modes.toolAxis);
  take(incremental_, incrementalDoubtful_, modes.incremental);
  take(motion_, motionDoubtful_, modes.motion);
  take(compensation_, compensationDoubtful_, modes.compensation);
  take(log_, logDoubtful_, modes.log);
  activeRow_ = modes.row;
  selectedRows_ = modes.selected;
  withoutLength_ = modes.withoutLength;
  tilted_ = modes.tilted;
  hasTool_ = modes.hasTool;
  frame_ = {.known = modes.shift.has_value(),
            .shift = {},
            .rotation = modes.rotation ? std::optional(Quantity(*modes.rotation)) : std::nullopt};
  for (std::size_t i = 0; modes.shift && i < 3; ++i)
    frame_.shift[i] = (*modes.shift)[static_cast<std::size_t>(axis(i)[0] - 'X')];
  forgetPosition();
}

void ToKlartext::rely(const Block& block, bool doubtful, const char* on) {
  if (!doubtful || std::exchange(relied_, true)) return;
  out_.list(block, fmt::format("{} depends here on the path that leads to this block", on),
            "program it in this block, or on every path that leads here");
}

}  // namespace probewright::conversion

#include "conversion/rotary_turns.hpp"

#include "conversion/modes.hpp"

namespace probewright::conversion {

using namespace language;

namespace {

/// Rotary axes that may stand below 0 or beyond 360 degrees.
struct Beyond {
  std::set<std::uint32_t> axes;
  bool countsFurther = false;  ///< G91 may be in effect
  bool operator==(const Beyond&) const = default;
};

bool agree(Beyond& with, const Beyond& other) {
  const Beyond before = with;
  with.axes.insert(other.axes.begin(), other.axes.end());
  with.countsFurther = with.countsFurther || other.countsFurther;
  return !(with == before);
}

/// Returns true if an absolute position is given to an axis that may stand beyond.
bool follow(const Block& block, Beyond& beyond) {
  constexpr std::uint32_t first = 'A', last = 'C';
  constexpr double turn = 360;
  bool comesFromBeyond = false;
  for (const Instruction& instruction : block.instructions) {
    if (const auto* modal = std::get_if<Modal>(&instruction)) {
      const std::string_view name = block.at(modal->name);
      if (name == "G90" || name == "G91") beyond.countsFurther = name == "G91";
    } else if (const auto* cycle = std::get_if<CycleCall>(&instruction)) {
      constexpr int rotaryAlignment = 403;
      if (cycle->number == rotaryAlignment) beyond.axes = {first, first + 1, last};
    }
    const auto* move = std::get_if<Move>(&instruction);
    if (move == nullptr) continue;
    for (const Word& word : std::span<const Word>(block.words).subspan(move->words.first, move->words.count)) {
      if (word.address < first || word.address > last) continue;
      const bool absolute = word.mode == WordMode::Absolute || (word.mode == WordMode::Plain && !beyond.countsFurther);
      comesFromBeyond = comesFromBeyond || (absolute && beyond.axes.contains(word.address));
      const auto position = literalOf(block, word.value);
      const bool within = absolute && position && *position >= 0 && *position < turn;
      if (within) beyond.axes.erase(word.address);
      if (!within) beyond.axes.insert(word.address);
    }
  }
  return comesFromBeyond;
}

}  // namespace

std::set<std::uint64_t> positionsFromBeyondATurn(Program& program, const FlowGraph& graph, const Job& job) {
  Block block;
  Diagnostics ignored;
  const std::size_t count = graph.blocks().size();
  std::vector<bool> neutral(count), calls(count), positions(count);
  for (std::size_t i = 0; i < count; ++i) {
    program.parse(graph.blocks()[i].position, block, ignored);
    Beyond everywhere{.axes = {'A', 'B', 'C'}};
    positions[i] = follow(block, everywhere);
    calls[i] = !job.others.empty() && callsProgram(block);
    Beyond nowhere, further{.axes = {'A', 'B', 'C'}, .countsFurther = true};
    follow(block, nowhere);
    follow(block, further);
    neutral[i] = nowhere == Beyond() && further.countsFurther && further.axes.size() == 3 && !positions[i] && !calls[i];
  }
  const auto meet = [&](Beyond& beyond) { meetOthers(job, beyond, follow, agree); };
  Beyond start;
  if (job.called) meet(start);
  const auto followBlock = [&](std::size_t place, Beyond& beyond) {
    if (neutral[place]) return;
    program.parse(graph.blocks()[place].position, block, ignored);
    follow(block, beyond);
    if (calls[place]) meet(beyond);
  };
  std::set<std::uint64_t> found;
  for (auto& [offset, beyond] :
       modesWhereWaysMeet<Beyond>(graph, followers(graph, neutral), followBlock, agree, start, positions)) {
    const auto place =
        std::ranges::find(graph.blocks(), offset, [](const FlowBlock& each) { return each.position.offset; });
    program.parse(place->position, block, ignored);
    if (follow(block, beyond)) found.insert(offset);
  }
  return found;
}

}  // namespace probewright::conversion

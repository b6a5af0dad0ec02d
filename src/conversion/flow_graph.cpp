#include "conversion/flow_graph.hpp"

#include <algorithm>
#include <string_view>

namespace probewright::conversion {

using namespace language;

namespace {

bool isOneOf(const std::vector<std::size_t>& places, std::size_t place) {
  return std::ranges::find(places, place) != places.end();
}

/// Adds what the instructions of a block do to its flow.
class Reader {
public:
  Reader(const FlowGraph& graph, Program& program, const Block& block, std::size_t own, FlowBlock& into)
      : graph_(graph), program_(program), block_(block), own_(own), into_(into) {}

  void operator()(const Jump& jump) {
    if (jump.direction == JumpDirection::ProgramStart) {
      into_.jumps.push_back(0);
    } else if (jump.label.length != 0) {
      add(into_.jumps, program_.findLabel(block_.at(jump.label), block_.position, jump.direction));
    }
    const bool always =
        !jump.condition.present() && !jump.ignoreMissing && !block_.skippable && into_.jumps.size() == 1;
    into_.passes = into_.passes && !always;
  }
  void operator()(const LabelMark& mark) { into_.returns = mark.end; }
  void operator()(const CallLabel& call) {
    if (call.label.length == 0) return;
    add(call.repeats.present() ? into_.parts : into_.called,
        program_.findLabel(block_.at(call.label), block_.position, JumpDirection::Any));
  }
  void operator()(const RepeatSection& repeat) {
    const auto find = [&](std::string_view label, BlockPosition from, JumpDirection direction) {
      const auto found = program_.findLabel(label, from, direction);
      return found ? graph_.at(*found) : std::nullopt;
    };
    const std::string_view name = block_.at(repeat.from);
    auto first = find(name, block_.position, JumpDirection::Backward);
    if (!first) first = find(name, block_.position, JumpDirection::Forward);
    if (!first) return;
    const bool behind = *first > own_;
    const std::string_view end = repeat.to.length > 0 ? block_.at(repeat.to) : "ENDLABEL";
    std::optional<std::size_t> last;
    if (repeat.onlyBlock || end == name) {
      last = first;
    } else {
      last = find(end, graph_.blocks()[*first].position, JumpDirection::Forward);
      if (!behind && (!last || *last > own_)) last = own_;
    }
    if (last) into_.section = {*first, *last};
  }
  void operator()(const Structured& statement) {
    const auto other = program_.counterpart(block_.position);
    const auto found = other ? graph_.at(*other) : std::nullopt;
    if (!found) return;
    switch (statement.kind) {
      case Structure::EndIf:
      case Structure::Loop:
      case Structure::Repeat:
        return;
      case Structure::If:
      case Structure::While:
      case Structure::For:
        if (*found + 1 < graph_.blocks().size()) into_.jumps.push_back(*found + 1);
        return;
      case Structure::Until:
        into_.jumps.push_back(*found);
        return;
      case Structure::EndFor:
        if (*found + 1 < graph_.blocks().size()) into_.jumps.push_back(*found + 1);
        return;
      case Structure::Else:
      case Structure::EndWhile:
      case Structure::EndLoop:
        into_.jumps.push_back(*found);
        into_.passes = false;
        return;
    }
  }
  void operator()(const EndProgram&) { into_.passes = into_.passes && block_.skippable; }
  void operator()(const Return&) { into_.passes = into_.passes && block_.skippable; }
  template <class Other>
  void operator()(const Other&) {}

private:
  void add(std::vector<std::size_t>& list, std::optional<BlockPosition> position) {
    const auto found = position ? graph_.at(*position) : std::nullopt;
    if (found) list.push_back(*found);
  }

  const FlowGraph& graph_;
  Program& program_;
  const Block& block_;
  std::size_t own_;
  FlowBlock& into_;
};

}  // namespace

FlowGraph::FlowGraph(Program& program) {
  Block block;
  Diagnostics ignored;
  for (BlockPosition at = program.begin(); program.parse(at, block, ignored); at = block.next)
    blocks_.emplace_back().position = at;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    program.parse(blocks_[i].position, block, ignored);
    blocks_[i].conditional = block.skippable;
    Reader reader(*this, program, block, i, blocks_[i]);
    for (const Instruction& each : block.instructions)
      std::visit(reader, each);
  }
}

std::optional<std::size_t> FlowGraph::at(BlockPosition position) const {
  const auto found = std::ranges::lower_bound(blocks_, position.offset, {},
                                              [](const FlowBlock& each) { return each.position.offset; });
  if (found == blocks_.end() || found->position.offset != position.offset) return std::nullopt;
  return static_cast<std::size_t>(found - blocks_.begin());
}

std::optional<std::size_t> FlowGraph::endOf(std::size_t first) const {
  for (std::size_t i = first; i < blocks_.size(); ++i)
    if (blocks_[i].returns) return i;
  return std::nullopt;
}

bool FlowGraph::branches() const {
  return std::ranges::any_of(blocks_, [](const FlowBlock& each) {
    return !each.jumps.empty() || !each.called.empty() || !each.parts.empty() || each.section;
  });
}

bool FlowGraph::isClosed(std::size_t first, std::size_t last) const {
  const auto inside = [&](std::size_t place) { return place >= first && place <= last; };
  for (std::size_t i = first; i <= last; ++i) {
    if (!std::ranges::all_of(blocks_[i].jumps, inside) || !std::ranges::all_of(blocks_[i].parts, inside)) return false;
  }
  return true;
}

std::vector<std::size_t> FlowGraph::reachedFrom(std::size_t first) const {
  std::vector<bool> seen(blocks_.size());
  std::vector<std::size_t> reached, open = {first};
  while (!open.empty()) {
    const std::size_t place = open.back();
    open.pop_back();
    if (place >= blocks_.size() || seen[place]) continue;
    seen[place] = true;
    reached.push_back(place);
    const FlowBlock& block = blocks_[place];
    for (const auto* list : {&block.jumps, &block.parts, &block.called})
      open.insert(open.end(), list->begin(), list->end());
    if (block.section) open.push_back(block.section->first);
    if (block.passes && !block.returns) open.push_back(place + 1);
  }
  return reached;
}

bool FlowGraph::subprogramsAreStretches() const {
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    for (const std::size_t first : blocks_[i].called) {
      const auto last = endOf(first);
      if (!last || !isClosed(first, *last)) return false;
      // A section that repeats itself is not a subprogram that calls itself.
      if (isOneOf(reachedFrom(first), i)) return false;
    }
    for (const std::size_t first : blocks_[i].parts)
      if (first > i || !isClosed(first, i)) return false;
  }
  return true;
}

}  // namespace probewright::conversion

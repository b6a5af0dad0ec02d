#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "conversion/flow_graph.hpp"
#include "conversion/job.hpp"

/// What blocks leave in effect, on every way through a program.
namespace probewright::conversion {

/// The number that an operand is, if it is one.
std::optional<double> literalOf(const language::Block& block, const language::Operand& operand);

/// Each block with the blocks that may follow it. `neutral`: blocks that leave all modes as they are.
std::vector<std::vector<std::size_t>> followers(const FlowGraph& graph, const std::vector<bool>& neutral);

/// What all ways to a block agree on, by the offsets of the blocks that more than the block above leads to.
/// `follow(place, modes)`: changes the modes as the block at that place does. `agree(one, other)`: keeps in `one` what
/// is the same in both, and tells whether it has changed. `first`: at the begin of the program. `doubtful`: further
/// blocks whose modes are to be told.
template <class Modes, class Follow, class Agree>
std::map<std::uint64_t, Modes> modesWhereWaysMeet(const FlowGraph& graph,
                                                  const std::vector<std::vector<std::size_t>>& next,
                                                  const Follow& follow, const Agree& agree, const Modes& first = {},
                                                  const std::vector<bool>& doubtful = {}) {
  std::map<std::uint64_t, Modes> meeting;
  const bool told = std::ranges::find(doubtful, true) != doubtful.end();
  if (next.empty() || (!graph.branches() && !told)) return meeting;
  std::vector<std::optional<Modes>> entry(next.size());
  std::vector<bool> meets = doubtful;
  meets.resize(next.size());
  for (std::size_t from = 0; from < next.size(); ++from)
    for (const std::size_t to : next[from])
      if (to != from + 1) meets[to] = true;
  entry[0] = first;
  std::deque<std::size_t> open = {0};
  while (!open.empty()) {
    const std::size_t place = open.front();
    open.pop_front();
    Modes left = *entry[place];
    follow(place, left);
    if (graph.blocks()[place].conditional) agree(left, *entry[place]);
    for (const std::size_t to : next[place]) {
      if (!entry[to]) {
        entry[to] = left;
      } else if (!agree(*entry[to], left)) {
        continue;
      }
      open.push_back(to);
    }
  }
  for (std::size_t i = told ? 0 : 1; i < next.size(); ++i)
    if (entry[i] && meets[i]) meeting.emplace(graph.blocks()[i].position.offset, *entry[i]);
  return meeting;
}

/// True if the block calls another program, which may leave other modes behind.
bool callsProgram(const language::Block& block);

/// What stays in effect whatever the other programs of a job have done. `follow`, `agree`: as above.
template <class Modes, class Follow, class Agree>
void meetOthers(const Job& job, Modes& modes, const Follow& follow, const Agree& agree) {
  language::Block block;
  Diagnostics ignored;
  for (const auto& other : job.others) {
    for (language::BlockPosition at = other->begin(); other->parse(at, block, ignored); at = block.next) {
      Modes left = modes;
      follow(block, left);
      agree(modes, left);
    }
  }
}

}  // namespace probewright::conversion

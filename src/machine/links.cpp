#include "machine/links.hpp"

#include <algorithm>

namespace probewright::machine {

namespace {

using Elements = std::vector<ChainElement>;

Elements stretch(const Elements& chain, std::size_t from, std::size_t to) {
  const auto at = [&](std::size_t place) {
    return chain.begin() + static_cast<std::ptrdiff_t>(std::min(place, chain.size()));
  };
  return from < to ? Elements(at(from), at(to)) : Elements();
}

}  // namespace

const Elements& chainOf(const MachineDescription& machine, const Link& link) {
  return link.chain == Link::Chain::Table ? machine.tableChain : machine.spindleChain;
}

Link tableLink(const MachineDescription& machine) { return {Link::Chain::Table, machine.tableChain.size()}; }
Link headLink(const MachineDescription& machine) { return {Link::Chain::Spindle, machine.spindleChain.size()}; }

std::optional<Link> linkNamed(const MachineDescription& machine, std::string_view name) {
  if (name == "bed") return Link{};
  if (name == "table") return tableLink(machine);
  if (name == "head") return headLink(machine);
  for (const Link& end : {tableLink(machine), headLink(machine)}) {
    const Elements& chain = chainOf(machine, end);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (chain[i].axis && machine.axes[*chain[i].axis].name == name) return Link{end.chain, i + 1};
    }
  }
  return std::nullopt;
}

std::string nameOf(const MachineDescription& machine, const Link& link) {
  if (link.isBed()) return "bed";
  const ChainElement& element = chainOf(machine, link)[link.elements - 1];
  return element.axis ? machine.axes[*element.axis].name : "bed";
}

bool areNeighbours(const Link& one, const Link& other) {
  const bool sameChain = one.chain == other.chain || one.isBed() || other.isBed();
  return sameChain && std::max(one.elements, other.elements) == std::min(one.elements, other.elements) + 1;
}

Pose baseFromLink(const MachineDescription& machine, const AxisPositions& q, const Link& link) {
  MachineDescription carried;
  carried.axes = machine.axes;
  carried.tableChain = stretch(chainOf(machine, link), 0, link.elements);
  return baseFromTable(carried, q);
}

Between between(const MachineDescription& machine, const Link& first, const Link& second) {
  const bool sameChain = first.chain == second.chain;
  const std::size_t common = sameChain ? std::min(first.elements, second.elements) : 0;
  return {stretch(chainOf(machine, first), common, first.elements),
          stretch(chainOf(machine, second), common, second.elements)};
}

}  // namespace probewright::machine

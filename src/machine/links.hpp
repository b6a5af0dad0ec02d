#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/description.hpp"

/// The links of a machine: the rigid things that its axes move against each other.
namespace probewright::machine {

/// What is carried by the first `elements` of a chain. With none it is the bed, which both chains begin at; with all of
/// them the table or the head. A link's frame coincides with the base frame where all axes read 0.
struct Link {
  enum class Chain { Table, Spindle };
  Chain chain = Chain::Table;
  std::size_t elements = 0;
  bool isBed() const { return elements == 0; }
  bool operator==(const Link& other) const { return elements == other.elements && (isBed() || chain == other.chain); }
};

const std::vector<ChainElement>& chainOf(const MachineDescription& machine, const Link& link);
/// What carries the workpiece and what carries the tool.
Link tableLink(const MachineDescription& machine);
Link headLink(const MachineDescription& machine);

/// "bed", "table", "head", or what the axis of that name moves; nothing if there is no such axis.
std::optional<Link> linkNamed(const MachineDescription& machine, std::string_view name);
/// "bed" or the name of the axis that moves it.
std::string nameOf(const MachineDescription& machine, const Link& link);

/// True if one of them carries the other with one axis between.
bool areNeighbours(const Link& one, const Link& other);

/// Base from link at the axis positions `q`. Exact to rounding.
Pose baseFromLink(const MachineDescription& machine, const AxisPositions& q, const Link& link);

/// The elements that lie between two links: `first` carries one of them, `second` the other, both from the link or the
/// bed that they have in common outwards.
struct Between {
  std::vector<ChainElement> first, second;
};
Between between(const MachineDescription& machine, const Link& first, const Link& second);

}  // namespace probewright::machine

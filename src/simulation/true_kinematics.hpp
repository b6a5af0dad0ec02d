#pragma once

#include "machine/description.hpp"
#include "simulation/truth.hpp"

/// Where the spindle truly is, given what the axes read.
namespace probewright::simulation {

class TrueKinematics {
public:
  TrueKinematics(const machine::MachineDescription& nominal, const MachineErrors& errors);

  std::size_t axisCount() const { return machine_.axes.size(); }

  /// Table from spindle (at spindle angle 0), `seconds` after the machine's start.
  Pose tableFromSpindle(const machine::AxisPositions& slides, double seconds) const;

  /// Where the slide of `axis` stands after it was at `slide` and the reading has become `reading` without reversal.
  double follow(std::size_t axis, double slide, double reading) const;
  double backlash(std::size_t axis) const { return errors_.axes[axis].backlash; }

  /// True if the spindle frame only shifts in proportion to the axes between these positions.
  bool isStraight(const machine::AxisPositions& from, const machine::AxisPositions& to) const;
  /// The same, and the slides of all axes that move follow at once.
  bool isStraightWithoutPlay(const machine::AxisPositions& from, const machine::AxisPositions& to) const;

  /// Into how many pieces a move must be cut so that halving them finds every bend.
  int piecesFor(const machine::AxisPositions& from, const machine::AxisPositions& to) const;

private:
  Pose chainPose(const std::vector<machine::ChainElement>& chain, double sign,
                 const machine::AxisPositions& slides) const;

  machine::MachineDescription machine_;
  MachineErrors errors_;
  Pose spindleTilt_ = Pose::Identity();
};

}  // namespace probewright::simulation

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "machine/description.hpp"

namespace probewright::records {

/// Where the program stood and what the control showed, block after block: what a replay follows.
struct RunTrace {
  /// What changes seldom.
  struct State {
    std::string tool;                                                ///< "5 PROBE", "T2 D1"; empty: none
    std::string preset;                                              ///< "1", "G54"
    Eigen::Affine3d programFromTable = Eigen::Affine3d::Identity();  ///< positions from places in the scene
    bool operator==(const State& other) const {
      return tool == other.tool && preset == other.preset &&
             programFromTable.matrix() == other.programFromTable.matrix();
    }
  };
  /// A block begins.
  struct Block {
    double seconds = 0;                  ///< machine clock
    std::uint32_t file = 0;              ///< index into `files`
    std::uint32_t line = 0;              ///< from 1
    std::uint32_t state = 0;             ///< index into `states`
    Vector3 position = Vector3::Zero();  ///< of the tool tip as the control believes it, program coordinates, mm
    machine::AxisPositions axes;
  };
  std::vector<std::string> files;
  std::vector<State> states;
  std::vector<Block> blocks;  ///< in the order of time; of a long run not every one that took no time
};

}  // namespace probewright::records

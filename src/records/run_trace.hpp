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
    std::string tool;    ///< "5 PROBE", "T2 D1"; empty: none
    std::string preset;  ///< "1", "G54"
    /// What positions of the program follow: where the tip is on the table, or the readings of the linear axes alone
    /// (control::Following). A lathe's do not turn with its main spindle.
    enum class Follows : std::uint8_t { Table, LinearAxes } follows = Follows::Table;
    /// Positions of the program from places in the scene, or from the readings of X, Y and Z (0: no such axis).
    Eigen::Affine3d programFrom = Eigen::Affine3d::Identity();
    bool diameter = false;  ///< the control shows positions in X as diameters
    bool operator==(const State& other) const {
      return tool == other.tool && preset == other.preset && follows == other.follows && diameter == other.diameter &&
             programFrom.matrix() == other.programFrom.matrix();
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

#pragma once

#include <optional>

#include "machine/description.hpp"
#include "simulation/motion_profile.hpp"

namespace probewright::simulation {

/// The time that feed moves in a row save because the axes do not stop between them. A corner is passed at the speed of
/// the arc that leaves it by at most 0.01 mm; the control looks one move ahead, so that it can always stop at the end
/// of the next one. The path itself stays that of the program.
class ContinuousPath {
public:
  /// A feed move over `way` (mm, degrees) follows. Returns what it adds to the clock, in seconds: its time from corner
  /// to standstill, less what the move before it saves by not stopping. Never negative.
  double join(const machine::AxisPositions& way, const MotionProfile& profile);

  /// The axes stand; the next move starts from there.
  void stop() { last_.reset(); }

private:
  struct Move {
    machine::AxisPositions way;
    MotionProfile profile;
    double entry = 0;    ///< speed at its beginning
    double seconds = 0;  ///< from there to standstill
  };

  std::optional<Move> last_;
  double debt_ = 0;  ///< seconds saved that no move has passed on yet
};

}  // namespace probewright::simulation

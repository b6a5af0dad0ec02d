#pragma once

#include <optional>
#include <vector>

#include "control/sinumerik/control.hpp"

/// What a swivel data set says of where its rotary axes may stand, beside the travels of the machine: $TC_CARR30 to 33
/// (limits) and $TC_CARR26 to 29 (Hirth coupling).
namespace probewright::execution::sinumerik {

class SwivelTravel {
public:
  /// Of the data set that `control` swivels with.
  explicit SwivelTravel(const control::sinumerik::Control& control);

  /// `posture` with each rotary axis of the data set within its limits, a whole turn off where they ask for that, and
  /// at the nearest position of its Hirth coupling within them. Nothing where an axis cannot stand there.
  std::optional<control::AxisPositions> reached(control::AxisPositions posture) const;

private:
  struct Axis {
    std::size_t axis = 0;
    bool limited = false;
    double lowest = 0, highest = 0;       ///< degrees
    double gridStart = 0, gridWidth = 0;  ///< degrees; width 0: it stands anywhere
    bool modulo = false;
    double travelFrom = 0, travelTo = 0;  ///< of the machine, if not modulo

    std::optional<double> reached(double degrees) const;
    bool allows(double degrees) const;
  };
  std::vector<Axis> axes_;
};

}  // namespace probewright::execution::sinumerik

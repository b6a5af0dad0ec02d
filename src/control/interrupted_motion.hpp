#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "geometry/primitives.hpp"
#include "machine/description.hpp"

/// A motion that did not end as the control meant it to.
namespace probewright::control {

enum class Interruption : std::uint8_t {
  NoContact,  ///< a measuring move came to its end without a touch
  Deflected,  ///< the probe was deflected where it should not be: before a measuring move, or while positioning
  Collision,  ///< something else than the ball touched
  Limit,      ///< the target lies beyond the travel of an axis; nothing moved
};

struct InterruptedMotion {
  Interruption why = Interruption::NoContact;
  bool measuring = false;
  std::optional<std::size_t> cycle;  ///< that ran: its place in Journal::cycles
  machine::AxisPositions from, to;   ///< where the motion began, and where it should have ended
  machine::AxisPositions end;        ///< where the axes stand
  /// Program coordinates from those of the table, as the control believes, with the axes at `end`.
  Eigen::Affine3d programFromTable = Eigen::Affine3d::Identity();
  double programUnit = 1;  ///< mm in the unit that the program counts in
  double seconds = 0;      ///< machine clock at the end
};

}  // namespace probewright::control

#pragma once

#include "control/heidenhain/control.hpp"

/// How the builder of a machine lets tools be measured: CfgTT of the TNC 640, MP6500 of the iTNC 530.
namespace probewright::cycles::heidenhain {

struct ToolMeasuringSettings {
  bool enabled = true;         ///< the cycles run at all
  bool rotating = true;        ///< radii, single teeth, and lengths with a rotating tool
  bool standingRadius = true;  ///< radii of round tools (CUT = 0) although nothing is measured rotating
  bool standingLength = true;  ///< lengths with a stationary tool where R-OFFS is 0
  bool teeth = true;
  bool tilted = true;              ///< in a tilted working plane
  bool stopsOnCheck = true;        ///< the program stops where a check finds a broken tool
  bool stopsOnMeasurement = true;  ///< where a measured value differs by more than the breakage tolerance
  bool entersMeasured = true;      ///< lengths and radii that were measured, in the tool table
  bool entersChecked = true;       ///< deviations that a check found
  bool oneDirection = false;       ///< calibrating touches the side of the contact that tools are measured at only
  bool findsRotation = false;      ///< calibrating determines how a cuboid is turned
  double tippingTolerance = 0;     ///< degrees; 0: calibrating does not determine how a cuboid is tipped
};

ToolMeasuringSettings toolMeasuringSettings(const control::heidenhain::Control& control);

/// Refuses cycles that the settings have switched off. Throws Alarm.
void requireEnabled(const control::heidenhain::Control& control);

}  // namespace probewright::cycles::heidenhain

#pragma once

#include <vector>

#include "control/sinumerik/data_store.hpp"

/// How fast a turning tool is measured (CYCLE971).
namespace probewright::cycles::sinumerik {

/// One of the touches that follow one another: the last one counts.
struct TurningTouch {
  double speed = 0;  ///< revolutions/min
  double feed = 0;   ///< mm/min
};

/// The touches by SD 54670 to SD 54677 for a tool of `radius` (mm, above 0):
///
///     n = S / (2 pi r 0.001), at most SD 54671, with S the permissible peripheral speed, SD 54670 (m/min);
///     F = n * delta, with delta the accuracy, SD 54677 (mm), from SD 54673 to SD 54672.
///
/// Feed factor 1 (SD 54675) 0: one touch with F. Otherwise one with F times this factor goes before it, and if feed
/// factor 2 (SD 54676) is not 0, another one with F times that. The last of several touches is made at half the speed,
/// or faster where the smallest feed needs it, with the feed that keeps delta, unless bit 19 of SD 54740 is set.
/// Empty if the data leave a speed or a feed of 0.
std::vector<TurningTouch> turningTouches(const control::sinumerik::DataStore& data, double radius);

}  // namespace probewright::cycles::sinumerik

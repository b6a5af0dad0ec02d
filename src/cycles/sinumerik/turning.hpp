#pragma once

#include <optional>

#include "cycles/sinumerik/corrections.hpp"

/// What the measuring cycles for lathes share: 973, 974, 994.
namespace probewright::cycles::sinumerik {

/// Refuses what requireProbe() refuses, every probe but one of type 580 (61309), and one whose cutting edge position is
/// not one of 5 to 8 (61315).
void requireTurningProbe(Context& context);

/// Refuses to measure in a workpiece system that is turned against the axes: alarm 61330.
void requireUnturned(Context& context);

/// Whether bit 1 of MD 52740 must let a cycle use the 3rd axis of the plane.
enum class ThirdAxis { Released, AsItIs };

/// Axis `code` (1, 2, 3) as an index. Alarm 61325 for another number; 61336 for the 3rd axis of the plane unless the
/// machine has it and may use it.
int turningAxis(Context& context, int code, ThirdAxis third = ThirdAxis::Released);

/// Refuses to measure in a direction in which data set S_PRNUM has no trigger point (61341), unless the machine data
/// say not to watch it.
void requireTrigger(Context& context, int axis, double sign);

/// What a programmed value along `axis` counts: 2 for diameters (DIAMON, X; the 3rd axis follows X), 1 for the rest.
double countOf(const Context& context, int axis);

/// Refuses a machine that cannot turn the workpiece to an angle (61372): that has neither a main spindle for it nor a
/// rotary axis below the table.
void requireWorkpieceSpindle(Context& context);
void turnWorkpiece(Context& context, double degrees);

/// The shape that is measured, the units of S_MVAR.
enum class TurnedFeature { Face, Inside, Outside };

/// A measured dimension, in the count of the program: a diameter with DIAMON.
struct TurnedDimension {
  int axis = 0;       ///< measuring axis
  double count = 1;   ///< program value per mm of the axis
  double set = 0;     ///< with the middle of the tolerance
  double actual = 0;  ///< measured
};

/// Writes set value, actual value and difference into _OVR, checks the safe area, and, if the task is that, corrects
/// the tool: the length that acts in the measuring axis (in X for the 3rd axis) by the difference on the radius.
/// `direction`: sign of the touch.
void concludeTurned(Context& context, Task task, TurnedFeature feature, const TurnedDimension& dimension,
                    double direction);

}  // namespace probewright::cycles::sinumerik

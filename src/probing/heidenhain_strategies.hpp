#pragma once

#include <optional>
#include <vector>

#include "probing/heidenhain_prober.hpp"

/// Features touched the HEIDENHAIN way: which points in which order, and how the probe travels between them.
/// Coordinates (main, minor, tool axis) of the active program coordinate system; mm and degrees.
namespace probewright::probing {

/// How the probe gets from one touch to the next (Q301, Q365).
enum class Between {
  AtMeasuringHeight,
  AtClearanceHeight,
};
enum class Traverse { Straight, Arc };
/// Where the probe is after the last touch of a circle.
enum class Ending { AtClearanceHeight, AtMeasuringHeight };

/// What all strategies need to know of heights and clearances.
struct Heights {
  double measuring = 0;       ///< Q261: of the ball centre
  double clearance = 0;       ///< Q260: of the south pole
  double extraClearance = 0;  ///< Q320: added to SET_UP
  Between between = Between::AtMeasuringHeight;
  Ending ending = Ending::AtClearanceHeight;  ///< of circles
};

struct CircleTask {
  Vector2 centre = Vector2::Zero();
  double diameter = 0;
  double startAngle = 0;
  double stepAngle = 90;
  int count = 4;
  Side side = Side::Inside;
  Traverse traverse = Traverse::Arc;  ///< between points at clearance height; at measuring height always an arc
};

/// Ends at the clearance height above the last point. A hole too narrow for the pre-positions is probed from its centre
/// without leaving the measuring height.
std::vector<EvaluatedTouch> probeCircle(HeidenhainProber& prober, const CircleTask& task, const Heights& heights);

struct RectangleTask {
  Vector2 centre = Vector2::Zero();
  double length1 = 0, length2 = 0;  ///< along main and minor axis
  Side side = Side::Inside;
};

/// Touches in the order: main axis +, minor axis +, main axis -, minor axis -. Between them at
/// the measuring height it travels parallel to the axes, outside around the corners, inside through the middle. A
/// pocket too narrow for the pre-positions is probed from its centre at the measuring height.
std::vector<EvaluatedTouch> probeRectangle(HeidenhainProber& prober, const RectangleTask& task, const Heights& heights);

struct WidthTask {
  Vector2 centre = Vector2::Zero();
  double width = 0;
  int axis = 0;  ///< 0: main, 1: minor axis
  Side side = Side::Inside;
};

/// Two opposite walls of a slot or ridge, the one in the positive direction first. Between the walls of a ridge the
/// probe rises to the clearance height.
std::vector<EvaluatedTouch> probeWidth(HeidenhainProber& prober, const WidthTask& task, const Heights& heights);

/// A touch, and the point in the plane through which the path to it leads along the measuring height.
struct RoutedTouch {
  PlannedTouch touch;
  std::optional<Vector2> via = std::nullopt;
};

/// Single points in the order given, each with the positioning logic of the cycles; between them as `heights` say.
std::vector<EvaluatedTouch> probePoints(HeidenhainProber& prober, const std::vector<RoutedTouch>& plan,
                                        const Heights& heights);

}  // namespace probewright::probing

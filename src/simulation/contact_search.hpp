#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "simulation/motion_profile.hpp"
#include "simulation/tool_shape.hpp"
#include "simulation/true_kinematics.hpp"

/// Where on a straight move in axis space the tool first touches something, whatever path that is on the table.
namespace probewright::simulation {

/// One straight move: readings, slides and time as functions of the fraction of the way.
struct Motion {
  const TrueKinematics& kinematics;
  machine::AxisPositions from, to;
  machine::AxisPositions slidesAtStart;
  double startSeconds = 0;
  MotionProfile profile{0, 1, 1};

  machine::AxisPositions readingAt(double fraction) const;
  machine::AxisPositions slidesAt(double fraction) const;
  Pose tableFromSpindleAt(double fraction) const;
};

/// The solids on the table, made ready for queries.
class Surroundings {
public:
  explicit Surroundings(const std::vector<PlacedSolid>& solids);
  /// With the same numbers, but nothing touches those that `wanted` says no to.
  Surroundings(const std::vector<PlacedSolid>& solids, bool (*wanted)(const PlacedSolid&));

  struct Item {
    const Solid* solid;
    Pose solidFromTable;
    Pose tableFromSolid;
    Bounds bounds;
  };
  const std::vector<Item>& items() const { return items_; }

private:
  std::vector<Item> items_;
};

/// What touched where. `shaft` counts in ToolShape::shafts; nothing for a ball. Table frame.
struct Touch {
  double fraction = 0;
  std::size_t solid = 0;
  std::optional<std::size_t> shaft;
  std::size_t ball = 0;                  ///< counts in ToolShape::balls
  Vector3 ballCentre = Vector3::Zero();  ///< ball only
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
};

struct SearchOptions {
  double precision = 1e-7;    ///< how far the ball's true path may be from the one searched, mm
  bool ignoreShafts = false;  ///< search the ball only
  bool ignoreBall = false;
  const std::stop_token* stop = nullptr;  ///< ends the search of a way that bends; null: nothing does
};

/// Thrown by a search that was stopped: up to this fraction of the way nothing touches.
struct SearchStopped {
  double fraction = 0;
};

/// The first touch between the fractions `begin` and `end` of the motion. Throws SearchStopped.
std::optional<Touch> firstTouch(const Motion& motion, double begin, double end, const ToolShape& shape,
                                const Surroundings& surroundings, const SearchOptions& options);

/// The solid that a ball overlaps with the spindle at `tableFromSpindle`, by more than 1e-9 mm.
std::optional<Touch> ballOverlap(const Pose& tableFromSpindle, const ToolShape& shape,
                                 const Surroundings& surroundings);

/// The same for everything but the balls.
std::optional<Touch> shaftOverlap(const Pose& tableFromSpindle, const ToolShape& shape,
                                  const Surroundings& surroundings);

}  // namespace probewright::simulation

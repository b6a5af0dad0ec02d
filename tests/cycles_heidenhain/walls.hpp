#pragma once

#include "cycles_heidenhain/worlds.hpp"
#include "geometry/decompositions.hpp"

/// A single plane to touch, wherever it looks.
namespace probewright::testing_support {

/// A plane somewhere, and a probe with a known tip offset in front of it.
struct Wall {
  Bench bench;
  Pose machineFromPreset = Pose::Identity();
  Vector3 point = Vector3::Zero();    ///< of the plane, in the preset
  Vector3 normal = Vector3::UnitZ();  ///< outward
  double ball = 0;
  Vector3 tip = Vector3::Zero();  ///< offset of the ball in the preset's axes
};

/// A block whose face lies in the plane, 25 mm to all sides.
inline void layWall(Wall& world, const Vector3& normal) {
  world.normal = normal;
  Pose presetFromBlock = Pose::Identity();
  presetFromBlock.translation() = world.point;
  presetFromBlock.linear() = shortestTurn(Vector3::UnitZ(), normal).toRotationMatrix();
  world.bench.setup.world.truth.solids.clear();
  world.bench.part(simulation::Box({-25, -25, -20}, {25, 25, 0}), world.machineFromPreset * presetFromBlock);
}

inline Wall wall(Dice& dice, ControlKind control, const Vector3& normal) {
  Wall world{Bench(control)};
  world.ball = written(dice.between(1, 3), 4);
  world.bench.probeOf(written(dice.between(80, 140), 4), world.ball);
  const Vector2 tip(written(dice.between(-0.2, 0.2), 4), written(dice.between(-0.2, 0.2), 4));
  world.bench.trueProbe().tipOffset = tip;
  world.bench.believedProbe().tipOffset = tip;
  world.bench.believedProbe().maximumTravel = 40;
  const Vector3 origin(written(dice.between(-80, 80), 4), written(dice.between(-60, 60), 4),
                       written(dice.between(-420, -380), 4));
  const double rotation = dice.coin() ? 0 : written(dice.between(-170, 170));
  world.bench.preset(1, origin, rotation);
  world.machineFromPreset = pose(origin, {0, 0, rotation});
  world.tip = world.machineFromPreset.linear().transpose() * Vector3(tip.x(), tip.y(), 0);
  world.point = dice.within(10);
  layWall(world, normal.normalized());
  return world;
}

/// A direction that a stylus can touch a wall in: sideways or from above.
inline Vector3 anyNormal(Dice& dice) {
  Vector3 normal(dice.between(-1, 1), dice.between(-1, 1), dice.between(0.05, 1));
  return normal.norm() < 0.2 ? Vector3(Vector3::UnitX()) : Vector3(normal.normalized());
}

}  // namespace probewright::testing_support

#pragma once

#include "support/heidenhain_bench.hpp"

/// Parts planted at random, and what the cycles must make of them in closed form.
namespace probewright::testing_support {

/// A part lying on the table; its features are centred on its origin, its top face is z = 0. The control has an active
/// preset, row 1, and the programmer a nominal position of the part in it, both a little wrong.
struct PlantedPart {
  Bench bench;
  Pose machineFromPart = Pose::Identity();
  Pose machineFromPreset = Pose::Identity();
  double skew = 0;                    ///< degrees, of the part's X axis from that of the preset
  Vector3 nominal = Vector3::Zero();  ///< of the part's origin, in the preset
  int row = 1;

  Vector3 truth() const { return machineFromPreset.inverse() * machineFromPart.translation(); }
};

/// The part lies within `misplaced` mm and `skewed` degrees of where the programmer thinks.
inline PlantedPart plant(Dice& dice, ControlKind control, double misplaced, double skewed,
                         const std::string& machine = "mill3") {
  PlantedPart part{Bench(control, machine)};
  const double rotation = dice.coin() ? 0 : written(dice.between(-40, 40));
  const Vector3 origin(written(dice.between(-120, 120), 4), written(dice.between(-80, 80), 4),
                       written(dice.between(-420, -380), 4));
  part.machineFromPreset = pose(origin, {0, 0, rotation});
  part.bench.preset(part.row, origin, rotation);
  part.bench.believedProbe().maximumTravel = 70;
  part.bench.probeOf(written(dice.between(80, 140)), written(dice.between(1, 3), 4));
  part.nominal = {written(dice.between(-60, 60)), written(dice.between(-60, 60)), written(dice.between(-20, 20))};
  part.skew = dice.between(-skewed, skewed);
  part.machineFromPart = part.machineFromPreset * pose(part.nominal + dice.within(misplaced), {0, 0, part.skew});
  return part;
}

/// A rectangular pocket around the part's origin: four walls, 40 mm deep and thick.
inline void layPocket(PlantedPart& part, const Vector2& length) {
  const double x = length.x() / 2, y = length.y() / 2, t = 40;
  part.bench.part(simulation::Box({x, -y - t, -40}, {x + t, y + t, 0}), part.machineFromPart);
  part.bench.part(simulation::Box({-x - t, -y - t, -40}, {-x, y + t, 0}), part.machineFromPart);
  part.bench.part(simulation::Box({-x, y, -40}, {x, y + t, 0}), part.machineFromPart);
  part.bench.part(simulation::Box({-x, -y - t, -40}, {x, -y, 0}), part.machineFromPart);
}

/// What four touches at the middle of the nominal sides find on a rectangle skewed by `skew` degrees whose centre lies
/// at `centre`: sides are straight lines, so the ball (radius `ball`) meets them where a line at the distance of the
/// ball radius is met, and the control then takes the sides for parallel to the axes.
struct FoundRectangle {
  Vector2 centre;
  Vector2 length;
};
inline FoundRectangle foundRectangle(const Vector2& centre, const Vector2& length, double skew, double ball,
                                     const Vector2& nominal, double outwards) {
  const double c = std::cos(radians(skew)), t = std::tan(radians(skew));
  // Side 1 lies at distance L/2 from the centre: x cos + y sin = L/2, met at height y = nominal.
  FoundRectangle found;
  found.centre = {centre.x() - (nominal.y() - centre.y()) * t, centre.y() + (nominal.x() - centre.x()) * t};
  found.length = length / c + Vector2::Constant(outwards * 2 * ball * (1 / c - 1));
  return found;
}

/// Where a presetting cycle is told to leave its result.
struct Transfer {
  Words words;
  std::string after;  ///< what activates it
};
inline Transfer transferInto(int row) {
  Transfer transfer{{{305, row}, {303, 1}}, {}};
  if (row > 1) transfer.after = fmt::format("CYCL DEF 247 PRESET ~\n  Q339={} ;NUMBER\n", row);
  return transfer;
}

}  // namespace probewright::testing_support

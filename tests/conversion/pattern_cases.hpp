#pragma once

#include "conversion/heidenhain_cases.hpp"

/// Touch probe cycles that measure several holes or spigots, in random worlds.
namespace probewright::testing_support::heidenhain {

/// Rings around these places of the part; bores of a size that nobody is told.
inline void layHoles(Dice& dice, PlantedPart& part, const std::vector<Vector2>& places) {
  for (const Vector2& place : places) {
    const double radius = dice.between(9, 14);
    part.bench.part(simulation::Ring(radius, radius + 3, -40), part.machineFromPart * pose({place.x(), place.y(), 0}));
  }
}

/// Origins are shifted as long as it is known which is in effect.
inline const std::string selectPreset = "CYCL DEF 247 PRESETTING ~\n  Q339=+1 ;NUMBER\n";

/// 401 or 402.
inline std::string pairCycle(Dice& dice, PlantedPart& part, int cycle) {
  // The points count from the unturned axes.
  part.machineFromPreset = pose(part.machineFromPreset.translation());
  part.machineFromPart = part.machineFromPreset * pose(part.nominal + dice.within(0.6), {0, 0, part.skew});
  const double angle = radians(dice.between(-180, 180)), half = dice.between(25, 40);
  const Vector2 away = half * Vector2(std::cos(angle), std::sin(angle));
  const Vector3& n = part.nominal;
  Words words = {{268, written(n.x() - away.x())},
                 {269, written(n.y() - away.y())},
                 {270, written(n.x() + away.x())},
                 {271, written(n.y() + away.y())},
                 {261, n.z() - 8},
                 {260, n.z() + 20},
                 {307, dice.coin() ? 0 : written(degrees(angle))},
                 {305, dice.whole(0, 1)},
                 {402, 0},
                 {337, 0}};
  if (cycle == 401) {
    layHoles(dice, part, {-away, away});
    return probe(401, words);
  }
  std::array<double, 2> diameters{};
  for (std::size_t i = 0; i < 2; ++i) {
    diameters[i] = dice.between(12, 25);
    const double side = i == 0 ? -1 : 1;
    part.bench.part(simulation::RoundBar(diameters[i] / 2, -40, 0),
                    part.machineFromPart * pose({side * away.x(), side * away.y(), 0}));
  }
  return probe(402, with(words, {{313, written(diameters[0] + 0.3)},
                                 {314, written(diameters[1] + 0.3)},
                                 {315, n.z() - 10},
                                 {320, 1},
                                 {301, dice.whole(0, 1)}}));
}

/// 416 or 430.
inline std::string boltCircle(Dice& dice, PlantedPart& part, int cycle) {
  const double nominal = written(dice.between(70, 100)), diameter = nominal + dice.between(-0.5, 0.5);
  const double first = written(dice.between(0, 75));
  const std::array<double, 3> angles = {first, first + written(dice.between(80, 130)),
                                        first + written(dice.between(200, 280))};
  std::vector<Vector2> places;
  for (const double angle : angles)
    places.emplace_back(diameter / 2 * std::cos(radians(angle)), diameter / 2 * std::sin(radians(angle)));
  layHoles(dice, part, places);
  const Vector3& n = part.nominal;
  Words words = {{273, n.x()},     {274, n.y()},     {262, nominal},   {291, angles[0]},
                 {292, angles[1]}, {293, angles[2]}, {261, n.z() - 8}, {260, n.z() + 20}};
  if (cycle == 416) {
    return selectPreset + probe(416, with(with(words, target(dice)), {{331, wish(dice, n.x())},
                                                                      {332, wish(dice, n.y())},
                                                                      {381, 0},
                                                                      {382, 0},
                                                                      {383, 0},
                                                                      {384, 0},
                                                                      {333, 0},
                                                                      {320, 0}}));
  }
  return probe(430, with(with(words, limits(dice, 288, nominal)),
                         {{279, dice.coin() ? 0 : 0.4}, {280, 0}, {281, 0}, {309, 0}, {330, 0}}));
}

inline std::string diagonals(Dice& dice, PlantedPart& part) {
  std::vector<Vector2> places;
  for (const Vector2& quarter : {Vector2(-1, -1), Vector2(1, -1), Vector2(1, 1), Vector2(-1, 1)})
    places.emplace_back(written(quarter.x() * dice.between(25, 40)), written(quarter.y() * dice.between(25, 40)));
  layHoles(dice, part, places);
  const Vector3& n = part.nominal;
  Words words = {{261, n.z() - 8}, {260, n.z() + 20}};
  const int numbers[] = {268, 270, 316, 318};
  for (std::size_t i = 0; i < 4; ++i)
    words = with(words, {{numbers[i], n.x() + places[i].x()}, {numbers[i] + 1, n.y() + places[i].y()}});
  return selectPreset + probe(418, with(with(words, target(dice)), {{331, wish(dice, n.x())},
                                                                    {332, wish(dice, n.y())},
                                                                    {381, 0},
                                                                    {382, 0},
                                                                    {383, 0},
                                                                    {384, 0},
                                                                    {333, 0}}));
}

inline std::vector<Case> patternCases() {
  std::vector<Case> all;
  for (const int cycle : {401, 402})
    all.push_back({fmt::format("Cycle{}", cycle),
                   [=](Dice& dice, PlantedPart& part) { return pairCycle(dice, part, cycle); },
                   {},
                   {},
                   0.6,
                   1.5,
                   false});
  for (const int cycle : {416, 430})
    all.push_back({fmt::format("Cycle{}", cycle),
                   [=](Dice& dice, PlantedPart& part) { return boltCircle(dice, part, cycle); },
                   {},
                   {"Q151", "Q152", "Q153"},
                   0.6,
                   1,
                   cycle == 430});
  all.push_back({"Cycle418", diagonals, {}, {"Q151", "Q152"}, 0.6, 1, false});
  return all;
}

}  // namespace probewright::testing_support::heidenhain

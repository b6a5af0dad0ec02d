#pragma once

#include <functional>

#include "conversion/twins.hpp"

/// SINUMERIK programs with measuring cycles as people write them, in random worlds.
namespace probewright::testing_support::sinumerik_programs {

/// A measuring cycle in a world: lays the part and gives what stands between the tool call and the end.
struct Case {
  std::string name;
  std::function<std::string(Dice&, PlantedPart&)> blocks;
  std::vector<Counterpart> results;
  std::vector<int> reads;  ///< n of _OVR[n] that the program drives to, so that they must be carried over
  double misplaced = 1;
  double skewed = 0;
};

inline void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

/// Over a place.
inline std::string above(const Vector3& place, double height) {
  return fmt::format("G0 Z{:.6f}\nG0 X{:.6f} Y{:.6f}\n", height, place.x(), place.y());
}
inline std::string down(double height) { return fmt::format("G1 Z{:.6f} F1000\n", height); }

/// Drives to what was measured: X and Y to the first two values, Z above the part by the third.
inline std::string driveTo(const std::vector<int>& results) {
  std::string text;
  for (std::size_t i = 0; i < results.size(); ++i)
    text += fmt::format("R{}=_OVR[{}]\n", i + 1, results[i]);
  text += "G0 Z=120\n";
  if (results.size() > 2) text += "G0 Z=120+R3\n";
  if (!results.empty()) text += results.size() > 1 ? "G0 X=R1 Y=R2\n" : "G0 X=R1 Y0\n";
  return text;
}

/// Measured only, or corrected: a zero offset, the active one, the active one by its number, another one; or a tool,
/// always or by limits, with a tolerance or without.
struct Task {
  bool corrects = false;
  bool correctsTool = false;
  Named words;
  int variant() const { return corrects ? 100 : correctsTool ? 200 : 0; }
};
inline Task anyTask(Dice& dice) {
  Task task;
  task.corrects = dice.coin();
  task.correctsTool = !task.corrects && dice.coin();
  if (task.correctsTool) {
    task.words = {{"S_KNUM1", 1}, {"S_TNAME", dice.coin() ? 5 : 0}};
    if (dice.coin()) task.words.insert(task.words.end(), {{"S_TZL", 0.3}, {"S_TDIF", 0.9}});
    if (dice.coin())
      task.words.insert(
          task.words.end(),
          {{"S_TUL", written(dice.between(0.1, 0.5))}, {"S_TLL", -written(dice.between(0.1, 0.5))}, {"_AMODE", 1}});
  }
  constexpr std::array<double, 3> frames = {19000, 10001, 2};
  if (task.corrects) task.words = {{"S_KNUM", frames[static_cast<std::size_t>(dice.whole(0, 2))]}};
  return task;
}

inline Named with(Named first, const Named& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

inline const Named always = {{"S_PRNUM", 1}, {"S_NMSP", 1}};
inline const std::vector<Counterpart> circleResults = {{"Q151", "_OVR[5]"}, {"Q152", "_OVR[6]"}, {"Q153", "_OVR[4]"}};

inline double ballOf(const PlantedPart& part) { return part.bench.setup.beliefs.tools.front().radius; }

inline void layRound(PlantedPart& part, bool hole, double diameter) {
  if (hole) {
    part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), part.machineFromPart);
  } else {
    part.bench.part(simulation::RoundBar(diameter / 2, -40, 0), part.machineFromPart);
  }
}

/// A call of CYCLE977 from over the feature, which goes down by itself, or in it.
inline std::string cycle977(Dice& dice, const PlantedPart& part, bool inside, int feature, const Named& words) {
  const Task task = anyTask(dice);
  const bool zone = inside && dice.coin();
  const double clear = part.nominal.z() + 15;
  std::string text = above(part.nominal, clear);
  if (inside && !zone) text += down(part.nominal.z() - 8);
  Named all = with(with(always, task.words), words);
  all = with(all, {{"S_MVAR", feature + (zone ? 1000 : 0) + task.variant()}, {"S_FA", 5}, {"S_TSA", 8}});
  if (!inside || zone) all = with(all, {{"S_ID", -25}});
  return text + sinumerikCall("CYCLE977", all);
}

inline std::string round977(Dice& dice, PlantedPart& part, bool hole) {
  const double diameter = dice.between(20, 80);
  layRound(part, hole, diameter);
  return cycle977(dice, part, hole, hole ? 1 : 2,
                  {{"S_SETV", written(diameter + dice.between(-1, 1))}, {"S_STA1", written(dice.between(-90, 90))}});
}

inline std::string width977(Dice& dice, PlantedPart& part, bool groove, int axis) {
  const double size = dice.between(20, 80);
  Vector3 low(-60, -60, -40), high(60, 60, 0);
  if (groove) {
    high[axis] = -size / 2;
    part.bench.part(simulation::Box(low, high), part.machineFromPart);
    low[axis] = size / 2;
    high[axis] = 60;
  } else {
    low[axis] = -size / 2;
    high[axis] = size / 2;
  }
  part.bench.part(simulation::Box(low, high), part.machineFromPart);
  return cycle977(dice, part, groove, groove ? 3 : 4,
                  {{"S_SETV", written(size + dice.between(-1, 1))}, {"S_MA", axis + 1}});
}

inline std::string rectangle977(Dice& dice, PlantedPart& part, bool pocket) {
  const Vector2 length(dice.between(25, 90), dice.between(25, 90));
  if (pocket) {
    layPocket(part, length);
  } else {
    part.bench.part(simulation::Box({-length.x() / 2, -length.y() / 2, -40}, {length.x() / 2, length.y() / 2, 0}),
                    part.machineFromPart);
  }
  return cycle977(
      dice, part, pocket, pocket ? 5 : 6,
      {{"S_SETV0", written(length.x() + dice.between(-1, 1))}, {"S_SETV1", written(length.y() + dice.between(-1, 1))}});
}

inline std::string segment979(Dice& dice, PlantedPart& part, bool hole) {
  const double diameter = dice.between(30, 80);
  layRound(part, hole, diameter);
  const Task task = anyTask(dice);
  const int points = dice.whole(3, 4);
  const double start = written(dice.between(-180, 180)), step = written(dice.between(30, 360.0 / points));
  const double radius = diameter / 2 + (hole ? -1 : 1) * (8 + ballOf(part));
  const Vector3 first = part.nominal + radius * Vector3(std::cos(radians(start)), std::sin(radians(start)), 0);
  return above(first, part.nominal.z() + 15) + down(part.nominal.z() - 8) +
         sinumerikCall("CYCLE979", with(with(always, task.words),
                                        {{"S_MVAR", (hole ? 1 : 2) + (points == 4 ? 1000 : 0) + task.variant()},
                                         {"S_SETV", written(diameter + dice.between(-1, 1))},
                                         {"S_CPA", part.nominal.x()},
                                         {"S_CPO", part.nominal.y()},
                                         {"S_STA1", start},
                                         {"S_INCA", dice.coin() ? step : -step},
                                         {"S_FA", 8},
                                         {"S_TSA", 8}})) +
         (hole ? "" : fmt::format("G0 Z{:.6f}\n", part.nominal.z() + 15));
}

inline void layBlock(PlantedPart& part) {
  part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), part.machineFromPart);
}

inline std::string surface978(Dice& dice, PlantedPart& part, int axis) {
  layBlock(part);
  const int sign = axis == 2 || dice.coin() ? -1 : 1;
  Vector3 place = part.nominal;
  double set = place.z();
  if (axis < 2) {
    set = place[axis] - 50 * sign;
    place[axis] = set - 12 * sign;
  }
  const Task task = anyTask(dice);
  return above(place, part.nominal.z() + 15) + fmt::format("G0 Z={:.6f}\n", part.nominal.z() + (axis == 2 ? 8 : -10)) +
         sinumerikCall("CYCLE978", with(with(always, task.words), {{"S_MVAR", task.variant()},
                                                                   {"S_SETV", set},
                                                                   {"S_FA", 4},
                                                                   {"S_TSA", 6},
                                                                   {"S_MA", axis + 1},
                                                                   {"S_MD", sign > 0 ? 1 : 2}}));
}

inline std::string edge998(Dice& dice, PlantedPart& part, int axis, int along) {
  const bool corrects = axis < 2 && dice.coin();
  if (corrects) {  // cycle 400 counts its points from unturned axes
    part.bench.setup.beliefs.presets.front().rotation.setZero();
    part.machineFromPreset = pose(part.machineFromPreset.translation());
    part.machineFromPart = part.machineFromPreset * pose(part.nominal + dice.within(1), {0, 0, part.skew});
  }
  if (axis == 2)
    part.machineFromPart = part.machineFromPart * pose(Vector3::Zero(), {dice.between(-2, 2), dice.between(-2, 2), 0});
  layBlock(part);
  const int sign = axis < 2 && dice.coin() ? 1 : -1;
  Vector3 place = part.nominal;
  if (axis < 2) place[axis] -= sign * (50 + 12);
  place[along] -= 30;
  return above(place, part.nominal.z() + 15) + down(part.nominal.z() + (axis == 2 ? 8 : -10)) +
         sinumerikCall("CYCLE998", with(always, {{"S_MVAR", (dice.coin() ? 100005 : 5) + (corrects ? 100 : 0)},
                                                 {"S_KNUM", corrects ? 10001 : 0},
                                                 {"S_RA", 0},
                                                 {"S_STA1", corrects ? 0 : written(dice.between(-1, 1))},
                                                 {"S_FA", 10},
                                                 {"S_TSA", 5},
                                                 {"S_MA", (along + 1) * 100 + axis + 1},
                                                 {"S_MD", sign > 0 ? 1 : 2},
                                                 {"S_ID", written(dice.between(20, 60))}}));
}

inline std::string plane998(Dice& dice, PlantedPart& part, bool corrects) {
  part.machineFromPart = part.machineFromPart * pose(Vector3::Zero(), {dice.between(-2, 2), dice.between(-2, 2), 0});
  layBlock(part);
  const Vector3 first = part.nominal + Vector3(written(dice.between(-40, -20)), written(dice.between(-40, -20)), 0);
  const bool level = corrects || dice.coin();
  return above(first, part.nominal.z() + 15) + down(part.nominal.z() + 8) +
         sinumerikCall("CYCLE998", with(always, {{"S_MVAR", (dice.coin() ? 100006 : 6) + (corrects ? 100 : 0)},
                                                 {"S_KNUM", corrects ? (dice.coin() ? 19000 : 10001) : 0},
                                                 {"S_RA", 0},
                                                 {"S_STA1", level ? 0 : written(dice.between(-1, 1))},
                                                 {"S_INCA", level ? 0 : written(dice.between(-1, 1))},
                                                 {"S_FA", 8},
                                                 {"S_TSA", 10},
                                                 {"S_SETV0", written(dice.between(30, 60))},
                                                 {"S_SETV2", written(dice.between(0, 40))},
                                                 {"S_SETV3", written(dice.between(30, 60))}}));
}

inline std::string corner961(Dice& dice, PlantedPart& part, bool outside, bool corrects, bool threePoints = false) {
  // The corner is the part's origin; the material or the pocket lies in one quarter.
  const double x = dice.coin() ? 1 : -1, y = dice.coin() ? 1 : -1;
  const auto box = [&](double x1, double x2, double y1, double y2) {
    part.bench.part(simulation::Box({std::min(x1, x2), std::min(y1, y2), -40}, {std::max(x1, x2), std::max(y1, y2), 0}),
                    part.machineFromPart);
  };
  if (outside) {
    box(0, 100 * x, 0, 100 * y);
  } else {
    box(-30 * x, 100 * x, 0, -30 * y);
    box(0, -30 * x, 0, 100 * y);
  }
  const Vector3& n = part.nominal;
  const double away = outside ? -12 : 12;
  const Vector3 pole(n.x() + away * x, n.y() + away * y, n.z());
  // The first edge runs in the positive direction of the main axis, whichever corner it is.
  double l1 = 30 * x, l2 = 70 * x, l3 = 35 * y, l4 = 60 * y;
  if (l1 > l2) std::swap(l1, l2);
  const bool zone = outside && dice.coin();
  Named words = with(always, {{"S_FA", 20}, {"S_TSA", 10}});
  const int variant = (outside ? 8 : 7) - (threePoints ? 2 : 0) + (corrects ? 100 : 0) + (zone ? 1000 : 0);
  words = with(words, {{"S_KNUM", corrects ? (dice.coin() ? 10001 : 19000) : 0},
                       {"S_SETV8", dice.coin() ? n.x() : written(dice.between(-50, 50))},
                       {"S_SETV9", dice.coin() ? n.y() : written(dice.between(-50, 50))}});
  if (zone) words = with(words, {{"S_ID", dice.coin() ? -25 : 25}});
  if (dice.coin()) {
    words = with(words, {{"S_MVAR", variant + 10},
                         {"S_SETV0", pole.x() + l1},
                         {"S_SETV1", pole.y()},
                         {"S_SETV2", pole.x() + l2},
                         {"S_SETV3", pole.y()},
                         {"S_SETV4", pole.x()},
                         {"S_SETV5", pole.y() + l3},
                         {"S_SETV6", pole.x()},
                         {"S_SETV7", pole.y() + l4}});
  } else {
    words = with(words, {{"S_MVAR", variant},
                         {"S_SETV0", l1},
                         {"S_SETV1", l2},
                         {"S_SETV2", l3},
                         {"S_SETV3", l4},
                         {"S_SETV4", pole.x()},
                         {"S_SETV5", pole.y()},
                         {"S_STA1", 0},
                         {"S_INCA", 90}});
  }
  return above(pole, n.z() + 15) + (zone ? "" : down(n.z() - 10)) + sinumerikCall("CYCLE961", words);
}

/// A probe that the control knows a little wrong is calibrated; what is measured with it afterwards is right.
inline std::string calibration976(Dice& dice, PlantedPart& part, int body) {
  const Vector3& n = part.nominal;
  part.bench.believedProbe().length += written(dice.between(-0.5, 0.5));
  if (body == 0) {
    layBlock(part);
    return above(n, n.z() + 4) +
           sinumerikCall(
               "CYCLE976",
               with(always,
                    {{"S_MVAR", 1000000}, {"S_SETV", n.z()}, {"S_MA", 3}, {"S_MD", 1}, {"S_FA", 4}, {"S_TSA", 4}})) +
           above(n + Vector3(10, 5, 0), n.z() + 8) +
           sinumerikCall(
               "CYCLE978",
               with(always, {{"S_MVAR", 0}, {"S_SETV", n.z()}, {"S_FA", 8}, {"S_TSA", 6}, {"S_MA", 3}, {"S_MD", 2}}));
  }
  part.bench.believedProbe().radius += written(dice.between(-0.1, 0.1));
  const double angle = dice.coin() ? 0 : written(dice.between(0, 90));
  const int atAngle = angle == 0 ? 0 : 100000;
  const Named words = with(always, {{"S_STA1", angle}, {"S_FA", 4}, {"S_TSA", 4}});
  if (body == 2) {
    const double diameter = written(dice.between(30, 80));
    layRound(part, true, diameter);
    return above(n, n.z() + 15) + down(n.z() - 8) +
           sinumerikCall("CYCLE976", with(words, {{"S_MVAR", 2 + atAngle}, {"S_SETV", diameter}})) +
           sinumerikCall("CYCLE977", with(always, {{"S_MVAR", 1}, {"S_SETV", diameter}, {"S_FA", 5}, {"S_TSA", 8}}));
  }
  const double radius = written(dice.between(10, 20)), height = written(radius + dice.between(20, 30));
  part.bench.part(simulation::SolidSphere(Vector3::Zero(), radius), part.machineFromPart * pose({0, 0, height}));
  const double top = n.z() + height + radius;
  return above(n, top + 4) +
         sinumerikCall("CYCLE976", with(words, {{"S_MVAR", 1000003 + atAngle},
                                                {"S_SETV", 2 * radius},
                                                {"S_SETV0", part.truth().z() + height + radius}})) +
         above(n, top + 5) +
         sinumerikCall("CYCLE978",
                       with(always, {{"S_SETV", top}, {"S_FA", 5}, {"S_TSA", 6}, {"S_MA", 3}, {"S_MD", 2}})) +
         "R9=_OVR[4]\n" + above(n - Vector3(radius + 10, 0, 0), top + 30) + down(top - radius) +
         sinumerikCall(
             "CYCLE978",
             with(always, {{"S_SETV", n.x() - radius}, {"S_FA", 5}, {"S_TSA", 6}, {"S_MA", 1}, {"S_MD", 1}})) +
         "G0 Z=R9+50\n";
}

inline std::vector<Case> cases() {
  std::vector<Case> all;
  for (const bool hole : {true, false}) {
    all.push_back({hole ? "Cycle977Hole" : "Cycle977Spigot",
                   [=](Dice& dice, PlantedPart& part) { return round977(dice, part, hole); },
                   circleResults,
                   {5, 18, 16},
                   1,
                   180});
    all.push_back({hole ? "Cycle979Hole" : "Cycle979Spigot",
                   [=](Dice& dice, PlantedPart& part) { return segment979(dice, part, hole); },
                   circleResults,
                   {5, 18, 4},
                   1,
                   180});
    all.push_back({hole ? "Cycle977Pocket" : "Cycle977RectangularSpigot",
                   [=](Dice& dice, PlantedPart& part) { return rectangle977(dice, part, hole); },
                   {{"Q151", "_OVR[6]"}, {"Q152", "_OVR[7]"}, {"Q154", "_OVR[4]"}, {"Q155", "_OVR[5]"}},
                   {6, 19, 5},
                   1,
                   0});
    for (const int axis : {0, 1})
      all.push_back({fmt::format("Cycle977{}Axis{}", hole ? "Groove" : "Rib", axis + 1),
                     [=](Dice& dice, PlantedPart& part) { return width977(dice, part, hole, axis); },
                     {{"Q157", fmt::format("_OVR[{}]", 5 + axis)}},
                     {5 + axis, 17 + axis, 4},
                     1,
                     2});
    all.push_back({hole ? "Cycle961Inside" : "Cycle961Outside",
                   [=](Dice& dice, PlantedPart& part) { return corner961(dice, part, !hole, true); },
                   {{"Q151", "_OVR[5]"}, {"Q152", "_OVR[6]"}},
                   {5, 6},
                   1,
                   2});
    all.push_back({hole ? "Cycle961InsideMeasured" : "Cycle961OutsideMeasured",
                   [=](Dice& dice, PlantedPart& part) { return corner961(dice, part, !hole, false); },
                   {},
                   {5, 6, 4},
                   1,
                   2});
    all.push_back({hole ? "Cycle961RightAngledInside" : "Cycle961RightAngledOutside",
                   [=](Dice& dice, PlantedPart& part) { return corner961(dice, part, !hole, false, true); },
                   {},
                   {5, 6, 4},
                   1,
                   2});
    all.push_back({hole ? "Cycle998PlaneAligned" : "Cycle998Plane",
                   [=](Dice& dice, PlantedPart& part) { return plane998(dice, part, hole); },
                   {{hole ? "Q962" : "Q159", "_OVR[5]"}},
                   {4, 5},
                   0.5,
                   0});
  }
  for (const int axis : {0, 1, 2})
    all.push_back({fmt::format("Cycle978Axis{}", axis + 1),
                   [=](Dice& dice, PlantedPart& part) { return surface978(dice, part, axis); },
                   {},
                   {4, 16},
                   1,
                   0});
  for (const auto& [axis, along] : {std::pair(0, 1), std::pair(1, 0), std::pair(2, 0), std::pair(2, 1)})
    all.push_back(
        {fmt::format("Cycle998Axis{}Along{}", axis + 1, along + 1),
         [axis = axis, along = along](Dice& dice, PlantedPart& part) { return edge998(dice, part, axis, along); },
         {},
         {4, 16},
         0.5,
         axis == 2 ? 0.0 : 2.0});
  all.push_back({"Cycle976Length",
                 [](Dice& dice, PlantedPart& part) { return calibration976(dice, part, 0); },
                 {{"Q160", "_OVR[4]"}},
                 {4},
                 0,
                 0});
  all.push_back({"Cycle976Ring",
                 [](Dice& dice, PlantedPart& part) { return calibration976(dice, part, 2); },
                 circleResults,
                 {5, 6, 4},
                 0.3,
                 0});
  all.push_back({"Cycle976Sphere",
                 [](Dice& dice, PlantedPart& part) { return calibration976(dice, part, 3); },
                 {{"Q160", "_OVR[4]"}},
                 {4},
                 0.3,
                 0});
  return all;
}

}  // namespace probewright::testing_support::sinumerik_programs

#pragma once

#include <functional>

#include "conversion/twins.hpp"

/// Klartext programs with one touch probe cycle, in random worlds.
namespace probewright::testing_support::heidenhain {

/// A cycle in a world: lays the part and gives the block.
struct Case {
  std::string name;
  std::function<std::string(Dice&, PlantedPart&)> block;
  std::vector<Counterpart> results;
  std::vector<std::string> reads;  ///< Q parameters that the program drives to, so that they must be carried over
  double misplaced = 1;
  double skewed = 0;
  bool inspects = false;  ///< leaves a status and may correct a tool
};

inline void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

/// What nearly all cycles take.
inline Words heights(Dice& dice, const PlantedPart& part) {
  return {{261, part.nominal.z() - written(dice.between(5, 12))},
          {320, dice.coin() ? 0 : written(dice.between(0, 3))},
          {260, part.nominal.z() + 20}};
}

inline Words target(Dice& dice) { return {{305, dice.whole(0, 1)}, {303, 1}}; }

/// The coordinate that a preset is to give the feature: the one it is expected at, or another.
inline double wish(Dice& dice, double expected) { return dice.coin() ? expected : written(dice.between(-50, 50)); }

/// Drives to what was measured: X and Y to the first two values, Z above the part by the third.
inline std::string driveTo(const std::vector<std::string>& parameters) {
  std::string text = "L Z+100 R0 FMAX\n";
  if (parameters.size() > 2) text += fmt::format("Q50 = 100 + {}\nL Z+Q50 FMAX\n", parameters[2]);
  text += fmt::format("L X+{} Y+{} FMAX\n", parameters.empty() ? "0" : parameters[0],
                      parameters.size() > 1 ? parameters[1] : "0");
  return text;
}

/// Tool 5 made the part, or nobody asks.
inline Words inspection(Dice& dice) { return {{281, 0}, {309, 0}, {330, dice.coin() ? 5 : 0}}; }

/// No limits, or some about the nominal value, even or not. The cycle's parameters `maximum` and the next.
inline Words limits(Dice& dice, int maximum, double nominal) {
  if (dice.coin()) return {{maximum, 0}, {maximum + 1, 0}};
  const double above = written(dice.between(0.1, 0.8)), below = dice.coin() ? above : written(dice.between(0.1, 0.8));
  return {{maximum, nominal + above}, {maximum + 1, nominal - below}};
}

/// Drives by the status: 1, 2 or 4 mm up.
inline const std::string driveByStatus = "Q62 = Q180 + 2 * Q181 + 4 * Q182\nL IZ+Q62 R0 FMAX\n";

inline double ballOf(const PlantedPart& part) { return part.bench.setup.beliefs.tools.front().radius; }

inline std::vector<Counterpart> circleResults() {
  return {{"Q151", "_OVR[5]"}, {"Q152", "_OVR[6]"}, {"Q153", "_OVR[4]"}};
}
inline std::vector<Counterpart> rectangleResults() {
  return {{"Q151", "_OVR[6]"}, {"Q152", "_OVR[7]"}, {"Q154", "_OVR[4]"}, {"Q155", "_OVR[5]"}};
}

/// A hole or spigot; `cycle` 412, 413, 421 or 422.
inline std::string circle(Dice& dice, PlantedPart& part, int cycle, bool square) {
  const bool inside = cycle == 412 || cycle == 421, presets = cycle < 420;
  const double diameter = inside ? dice.between(2 * ballOf(part) + 6, 90) : dice.between(5, 90);
  if (inside) {
    part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), part.machineFromPart);
  } else {
    part.bench.part(simulation::RoundBar(diameter / 2, -40, 0), part.machineFromPart);
  }
  const int points = square ? 4 : dice.whole(3, 4);
  Words words = with(heights(dice, part),
                     {{presets ? 321 : 273, part.nominal.x()},
                      {presets ? 322 : 274, part.nominal.y()},
                      {262, written(diameter + dice.between(-0.5, 0.5))},
                      {325, written(dice.between(-360, 360))},
                      {247, (dice.coin() ? 1 : -1) * (square ? 90 : written(dice.between(30, 360.0 / points)))},
                      {301, square ? dice.whole(0, 1) : 0},
                      {423, points},
                      {365, 1}});
  if (presets) {
    words = with(with(words, target(dice)), {{331, wish(dice, part.nominal.x())}, {332, wish(dice, part.nominal.y())}});
  } else {
    const double nominal =
        std::find_if(words.begin(), words.end(), [](const auto& w) { return w.first == 262; })->second;
    words = with(with(with(words, inspection(dice)), limits(dice, inside ? 275 : 277, nominal)), {{279, 0}, {280, 0}});
  }
  return probe(cycle, words);
}

inline std::string rectangle(Dice& dice, PlantedPart& part, int cycle) {
  const bool inside = cycle == 410 || cycle == 423, presets = cycle < 420;
  const double least = inside ? 2 * ballOf(part) + 8 : 10;
  const Vector2 length(dice.between(least, 90), dice.between(least, 90));
  if (inside) {
    layPocket(part, length);
  } else {
    part.bench.part(simulation::Box({-length.x() / 2, -length.y() / 2, -40}, {length.x() / 2, length.y() / 2, 0}),
                    part.machineFromPart);
  }
  const double first = written(length.x() + dice.between(-0.5, 0.5)),
               second = written(length.y() + dice.between(-0.5, 0.5));
  Words words = with(heights(dice, part), {{presets ? 321 : 273, part.nominal.x()},
                                           {presets ? 322 : 274, part.nominal.y()},
                                           {presets ? 323 : 282, first},
                                           {presets ? 324 : 283, second},
                                           {301, inside ? dice.whole(0, 1) : 1}});
  words = presets ? with(with(words, target(dice)),
                         {{331, wish(dice, part.nominal.x())}, {332, wish(dice, part.nominal.y())}})
                  : with(with(with(with(words, inspection(dice)), limits(dice, 284, first)), limits(dice, 286, second)),
                         {{279, written(dice.between(0, 1))}, {280, 0}});
  return probe(cycle, words);
}

inline std::string width(Dice& dice, PlantedPart& part, int cycle, int axis) {
  const bool inside = cycle == 408 || cycle == 425;
  const double size = dice.between(inside ? 2 * ballOf(part) + 8 : 10, 80);
  Vector3 low(-60, -60, -40), high(60, 60, 0);
  if (inside) {
    high[axis] = -size / 2;
    part.bench.part(simulation::Box(low, high), part.machineFromPart);
    low[axis] = size / 2;
    high[axis] = 60;
    part.bench.part(simulation::Box(low, high), part.machineFromPart);
  } else {
    low[axis] = -size / 2;
    high[axis] = size / 2;
    part.bench.part(simulation::Box(low, high), part.machineFromPart);
  }
  const double nominal = written(size + dice.between(-0.5, 0.5));
  Words words = with(heights(dice, part), {{311, nominal}, {272, axis + 1}});
  if (cycle == 408) words = with(words, {{301, dice.whole(0, 1)}});
  if (cycle < 420) {
    words = with(with(words, target(dice)),
                 {{321, part.nominal.x()}, {322, part.nominal.y()}, {405, wish(dice, part.nominal[axis])}});
  } else if (cycle == 425) {
    words = with(with(with(words, inspection(dice)), limits(dice, 288, nominal)),
                 {{328, part.nominal.x()}, {329, part.nominal.y()}, {310, 0}});
  } else {
    Vector3 upper = part.nominal, lower = part.nominal;
    upper[axis] += nominal / 2;
    lower[axis] -= nominal / 2;
    words = with(with(with(words, inspection(dice)), limits(dice, 288, nominal)),
                 {{263, upper.x()}, {264, upper.y()}, {265, lower.x()}, {266, lower.y()}});
  }
  return probe(cycle, words);
}

inline void layBlock(PlantedPart& part) {
  part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), part.machineFromPart);
}

inline std::string surface(Dice& dice, PlantedPart& part, int cycle, int axis) {
  layBlock(part);
  const int sign = axis == 2 ? -1 : dice.coin() ? 1 : -1;
  Words words = with(heights(dice, part), {{263, part.nominal.x() + written(dice.between(-30, 30))},
                                           {264, part.nominal.y() + written(dice.between(-30, 30))}});
  if (axis == 2 && cycle != 417) words = with(words, {{261, part.nominal.z()}});
  if (cycle == 417) {
    std::erase_if(words, [](const auto& word) { return word.first == 261; });
    words = with(words, {{294, part.nominal.z()}});
  }
  if (axis < 2) words = with(words, {{263 + axis, part.nominal[axis] - sign * 50}});
  if (cycle != 417) words = with(words, {{272, axis + 1}, {267, sign}});
  const double expected = axis == 2 ? part.nominal.z() : part.nominal[axis] - sign * 50;
  if (cycle == 427) {
    words = with(with(words, inspection(dice)), limits(dice, 288, expected));
  } else {
    words = with(with(words, target(dice)), {{333, axis == 2 ? expected : wish(dice, expected)}});
  }
  return probe(cycle, words);
}

inline std::string edge(Dice& dice, PlantedPart& part, int cycle, int axis) {
  if (cycle == 400) {  // its points count from the unturned axes
    part.machineFromPreset = pose(part.machineFromPreset.translation());
    part.machineFromPart = part.machineFromPreset * pose(part.nominal + dice.within(1), {0, 0, part.skew});
  }
  layBlock(part);
  const int sign = axis == 2 ? -1 : dice.coin() ? 1 : -1;
  Vector3 first = part.nominal, second = part.nominal;
  const int along = axis == 2 ? dice.whole(0, 1) : 1 - axis;
  first[along] += written(dice.between(-40, -10));
  second[along] += written(dice.between(10, 40));
  if (axis < 2) first[axis] = second[axis] = part.nominal[axis] - sign * 50;
  if (dice.coin()) std::swap(first, second);
  Words words = with(heights(dice, part), {{263, first.x()},
                                           {264, first.y()},
                                           {265, second.x()},
                                           {266, second.y()},
                                           {272, axis + 1},
                                           {267, sign},
                                           {301, 0}});
  // A skewed edge comes nearer on the way to the second point.
  words = with(words, {{320, 3}});
  if (axis == 2) words = with(words, {{261, part.nominal.z()}});
  if (cycle == 1410) {
    return probe(cycle, {{1100, first.x()},
                         {1101, first.y()},
                         {1102, part.nominal.z() - 8},
                         {1103, second.x()},
                         {1104, second.y()},
                         {1105, part.nominal.z() - 8},
                         {372, sign * (axis + 1)},
                         {320, 2},
                         {260, part.nominal.z() + 20},
                         {1125, 0},
                         {309, 0},
                         {1126, 0},
                         {1120, 0},
                         {1121, 1}});
  }
  if (cycle == 400) {
    words = with(words, {{307, axis == 0 ? 90 : 0}, {305, dice.whole(0, 1)}});
  } else {
    words = with(words, {{281, 0}});
  }
  return probe(cycle, words);
}

inline std::string corner(Dice& dice, PlantedPart& part, int cycle, bool turns) {
  // The corner is the part's origin; the material or the pocket lies in one quarter.
  const int quarter = dice.whole(1, 4);
  const double x = quarter == 1 || quarter == 4 ? 1 : -1, y = quarter <= 2 ? 1 : -1;
  const auto box = [&](double x1, double x2, double y1, double y2) {
    part.bench.part(simulation::Box({std::min(x1, x2), std::min(y1, y2), -40}, {std::max(x1, x2), std::max(y1, y2), 0}),
                    part.machineFromPart);
  };
  const Vector3& n = part.nominal;
  Words words =
      with(with(heights(dice, part), target(dice)),
           {{331, wish(dice, n.x())}, {332, wish(dice, n.y())}, {301, dice.whole(0, 1)}, {304, turns ? 1 : 0}});
  words = with(words, {{305, 1}, {320, 3}});
  if (cycle == 414) {
    box(0, 100 * x, 0, 100 * y);
    const double near = 15, far = written(dice.between(20, 40));
    words = with(words, {{263, n.x() + (x > 0 ? near : -near - far)},
                         {264, n.y()},
                         {326, far},
                         {296, n.x()},
                         {297, n.y() + (y > 0 ? near : -near - far)},
                         {327, far}});
  } else {
    box(-30 * x, 100 * x, 0, -30 * y);
    box(0, -30 * x, 0, 100 * y);
    words = with(words, {{263, n.x()},
                         {264, n.y()},
                         {326, written(dice.between(30, 60))},
                         {327, written(dice.between(30, 60))},
                         {308, quarter}});
  }
  return "CYCL DEF 247 PRESETTING ~\n  Q339=+1 ;NUMBER\n" + probe(cycle, words);
}

inline std::string plane(Dice& dice, PlantedPart& part, int cycle, bool anywhere = false) {
  part.machineFromPart = part.machineFromPart * pose(Vector3::Zero(), {dice.between(-2, 2), dice.between(-2, 2), 0});
  layBlock(part);
  const double x1 = written(dice.between(-40, -20)), y1 = written(dice.between(-40, -20));
  if (cycle == 1420) {
    return probe(1420, {{1100, part.nominal.x() + x1},
                        {1101, part.nominal.y() + y1},
                        {1102, part.nominal.z()},
                        {1103, part.nominal.x() + x1 + written(dice.between(30, 60))},
                        {1104, part.nominal.y() + y1},
                        {1105, part.nominal.z()},
                        {1106, part.nominal.x() + written(dice.between(-20, 20))},
                        {1107, part.nominal.y() + y1 + written(dice.between(30, 60))},
                        {1108, part.nominal.z()},
                        {372, -3},
                        {320, 2},
                        {260, part.nominal.z() + 20},
                        {1125, 2},
                        {309, 0},
                        {1126, 0},
                        {1120, 0},
                        {1121, 1}});
  }
  // CYCLE998 wants the second point along the main axis; the twin touches three times if it lies elsewhere.
  return probe(431, {{263, part.nominal.x() + x1},
                     {264, part.nominal.y() + y1},
                     {294, part.nominal.z()},
                     {265, part.nominal.x() + x1 + written(dice.between(30, 60))},
                     {266, part.nominal.y() + y1 + (anywhere ? written(dice.between(1, 10)) : 0)},
                     {295, part.nominal.z()},
                     {296, part.nominal.x() + written(dice.between(-20, 20))},
                     {297, part.nominal.y() + y1 + written(dice.between(30, 60))},
                     {298, part.nominal.z()},
                     {320, 2},
                     {260, part.nominal.z() + 20},
                     {281, 0}});
}

/// A probe that the control knows a little wrong is calibrated; what is measured with it afterwards is right.
inline std::string calibration(Dice& dice, PlantedPart& part, int cycle) {
  const Vector3& n = part.nominal;
  part.bench.believedProbe().length += written(dice.between(-0.5, 0.5));
  const std::string above = fmt::format("L X{:+.6f} Y{:+.6f} R0 FMAX\n", n.x(), n.y());
  if (cycle == 461) {
    layBlock(part);
    const Words words = {{263, n.x() + 5},  {264, n.y() + 5}, {261, n.z()}, {320, 2}, {272, 3}, {267, -1},
                         {260, n.z() + 20}, {281, 0},         {288, 0},     {289, 0}, {309, 0}, {330, 0}};
    return above + fmt::format("L Z{:+.6f} FMAX\n", n.z() + 4) + probe(461, {{434, n.z()}}) +
           fmt::format("L Z{:+.6f} FMAX\n", n.z() + 30) + probe(427, words);
  }
  part.bench.believedProbe().radius += written(dice.between(-0.1, 0.1));
  if (cycle == 460) {
    // Behind the calibration the probe touches the sphere from above and beside it: length and radius must be right.
    const double radius = written(dice.between(10, 20)), height = written(radius + dice.between(20, 30));
    const Pose sphere = part.machineFromPart * pose({0, 0, height});
    part.bench.part(simulation::SolidSphere(Vector3::Zero(), radius), sphere);
    const double top = n.z() + height + radius;
    const Vector3 found = part.truth() + Vector3(0, 0, height);
    const Words words = {{263, n.x()},    {264, n.y()}, {261, top}, {320, 1}, {272, 3}, {267, -1},
                         {260, top + 20}, {281, 0},     {288, 0},   {289, 0}, {309, 0}, {330, 0}};
    return above + fmt::format("L Z{:+.6f} FMAX\n", top + 4) +
           probe(460, {{407, radius},
                       {320, 2},
                       {301, 1},
                       {423, 4},
                       {380, dice.coin() ? 0 : written(dice.between(0, 90))},
                       {433, 1},
                       {434, found.z()},
                       {455, 0}}) +
           fmt::format("L Z{:+.6f} FMAX\n", top + 30) + probe(427, words) + "Q60 = Q160\n" +
           probe(427, with(words, {{263, n.x() - radius}, {261, top - radius}, {272, 1}, {267, 1}}));
  }
  const double radius = written(dice.between(12, 40));
  part.bench.part(simulation::Ring(radius, radius + 30, -40), part.machineFromPart);
  const Words words = {{273, n.x()}, {274, n.y()},      {262, 2 * radius}, {325, 0}, {247, 90}, {261, n.z() - 10},
                       {320, 1},     {260, n.z() + 20}, {301, 0},          {275, 0}, {276, 0},  {279, 0},
                       {280, 0},     {281, 0},          {309, 0},          {330, 0}, {423, 4},  {365, 1}};
  return above + fmt::format("L Z{:+.6f} FMAX\n", n.z() - 10) +
         probe(462, {{407, radius}, {320, 1}, {423, 4}, {380, 0}}) + fmt::format("L Z{:+.6f} FMAX\n", n.z() + 30) +
         probe(421, words);
}

inline std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&all](std::string name, std::function<std::string(Dice&, PlantedPart&)> block,
                          std::vector<Counterpart> results, std::vector<std::string> reads, double misplaced = 1,
                          double skewed = 0) {
    const bool inspects = name.starts_with("Cycle42") && !name.starts_with("Cycle420");
    all.push_back(
        {std::move(name), std::move(block), std::move(results), std::move(reads), misplaced, skewed, inspects});
  };
  for (const int cycle : {412, 413, 421, 422}) {
    for (const bool square : {true, false}) {
      add(
          fmt::format("Cycle{}{}", cycle, square ? "" : "AtAnyAngles"),
          [=](Dice& dice, PlantedPart& part) { return circle(dice, part, cycle, square); }, circleResults(),
          {"Q151", "Q152", "Q153"}, 1, 180);
    }
  }
  for (const int cycle : {410, 411, 423, 424})
    add(fmt::format("Cycle{}", cycle), [=](Dice& dice, PlantedPart& part) { return rectangle(dice, part, cycle); },
        rectangleResults(), {"Q151", "Q155", "Q154"});
  for (const int cycle : {408, 409, 425, 426}) {
    const std::string size = cycle < 420 ? "Q166" : "Q156";
    for (const int axis : {0, 1})
      add(
          fmt::format("Cycle{}Axis{}", cycle, axis + 1),
          [=](Dice& dice, PlantedPart& part) { return width(dice, part, cycle, axis); },
          {{"Q157", fmt::format("_OVR[{}]", 5 + axis)}, {size, "_OVR[4]"}}, {"Q157", size}, 1, 2);
  }
  for (const auto& [cycle, axis] : {std::pair(417, 2), std::pair(419, 0), std::pair(419, 1), std::pair(419, 2),
                                    std::pair(427, 0), std::pair(427, 1), std::pair(427, 2)}) {
    std::vector<Counterpart> results;
    std::vector<std::string> reads;
    if (cycle != 419) {
      results.push_back({"Q160", "_OVR[4]"});
      reads = {"Q160"};
    }
    add(
        fmt::format("Cycle{}Axis{}", cycle, axis + 1),
        [cycle = cycle, axis = axis](Dice& dice, PlantedPart& part) { return surface(dice, part, cycle, axis); },
        results, reads, 1, axis == 2 ? 180.0 : 2.0);
  }
  for (const auto& [cycle, axis] : {std::pair(400, 0), std::pair(400, 1), std::pair(420, 0), std::pair(420, 1),
                                    std::pair(420, 2), std::pair(1410, 0), std::pair(1410, 1)}) {
    std::vector<Counterpart> results;
    if (cycle == 420 && axis > 0) results.push_back({"Q150", "_OVR[4]"});
    if (cycle == 1410) results.push_back({"Q994", "_OVR[16]"});
    std::vector<std::string> reads;
    if (cycle == 420) reads = {"Q150"};
    if (cycle == 1410) reads = {"Q964", "Q994"};
    add(
        fmt::format("Cycle{}Axis{}", cycle, axis + 1),
        [cycle = cycle, axis = axis](Dice& dice, PlantedPart& part) { return edge(dice, part, cycle, axis); }, results,
        reads, 1, 2);
  }
  for (const int cycle : {414, 415}) {
    for (const bool turns : {true, false})
      add(
          fmt::format("Cycle{}{}", cycle, turns ? "" : "WithoutRotation"),
          [=](Dice& dice, PlantedPart& part) { return corner(dice, part, cycle, turns); },
          {{"Q151", "_OVR[5]"}, {"Q152", "_OVR[6]"}}, {"Q151", "Q152"}, 1, 2);
  }
  add(
      "Cycle431", [](Dice& dice, PlantedPart& part) { return plane(dice, part, 431); }, {{"Q159", "_OVR[5]"}},
      {"Q158", "Q159"}, 0.5);
  add(
      "Cycle431AnyPoints", [](Dice& dice, PlantedPart& part) { return plane(dice, part, 431, true); }, {},
      {"Q158", "Q159", "Q173"}, 0.5);
  add(
      "Cycle1420", [](Dice& dice, PlantedPart& part) { return plane(dice, part, 1420); }, {{"Q962", "_OVR[5]"}},
      {"Q961", "Q962"}, 0.5);
  for (const int cycle : {460, 461})
    add(
        fmt::format("Cycle{}", cycle), [=](Dice& dice, PlantedPart& part) { return calibration(dice, part, cycle); },
        {{"Q160", "_OVR[4]"}}, {"Q160", cycle == 460 ? "Q60" : "Q160"}, cycle == 460 ? 0.3 : 0);
  add(
      "Cycle462", [](Dice& dice, PlantedPart& part) { return calibration(dice, part, 462); }, circleResults(),
      {"Q151", "Q152", "Q153"}, 0.3);
  return all;
}

}  // namespace probewright::testing_support::heidenhain

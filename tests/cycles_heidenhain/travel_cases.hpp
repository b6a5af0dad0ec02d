#pragma once

#include "cycles_heidenhain/worlds.hpp"

/// Ideal parts for cycles 400 to 405 and 408 to 419, the cycles that measure them, and from where they touch. Every
/// value follows from the cycle's parameters by hand.
namespace probewright::testing_support::travel {

inline constexpr double clearance = 20, ball = 2;
/// Ball radius 2, SET_UP 2 and Q320 = 1 lie between a surface and the ball's centre in front of it.
inline constexpr double standOff = 5;

struct Stroke {
  Vector3 start, direction;
};

enum class Way { Straight, AlongAxes, Arc };

struct Case {
  int cycle;
  Words words;
  std::function<void(Bench&)> lay;
  std::vector<Stroke> strokes;
  std::size_t perObject =
      0;                    ///< strokes of one object; between objects the probe always goes up; 0: there is one object
  Way way = Way::Straight;  ///< between strokes at the measuring height
  bool ordered = true;      ///< the manual tells the order of the strokes
  bool newerOnly = false;
};

inline const Vector3 right = Vector3::UnitX(), back = Vector3::UnitY(), up = Vector3::UnitZ();

inline void block(Bench& bench) { bench.part(simulation::Box({0, 0, -40}, {100, 80, 0}), pose({0, 0, -400})); }
inline void hole(Bench& bench, double x, double y, double radius) {
  bench.part(simulation::Ring(radius, radius + 8, -40), pose({x, y, -400}));
}
inline void stud(Bench& bench, double x, double y, double radius) {
  bench.part(simulation::RoundBar(radius, -40, 0), pose({x, y, -400}));
}
inline void walls(Bench& bench, const Vector2& centre, const Vector2& room) {
  const double x = room.x() / 2, y = room.y() / 2;
  const Pose at = pose({centre.x(), centre.y(), -400});
  bench.part(simulation::Box({x, -y - 20, -40}, {x + 20, y + 20, 0}), at);
  bench.part(simulation::Box({-x - 20, -y - 20, -40}, {-x, y + 20, 0}), at);
  bench.part(simulation::Box({-x, y, -40}, {x, y + 20, 0}), at);
  bench.part(simulation::Box({-x, -y - 20, -40}, {x, -y, 0}), at);
}

/// Four strokes from the middle of a hole outwards, along the main axis first.
inline std::vector<Stroke> fromMiddle(const std::vector<Vector2>& centres) {
  std::vector<Stroke> strokes;
  for (const Vector2& centre : centres) {
    for (const Vector3& direction : {right, Vector3(-right), back, Vector3(-back)})
      strokes.push_back({{centre.x(), centre.y(), -8}, direction});
  }
  return strokes;
}

/// Strokes on a circle at `angles`, from `radius`, outwards (1) or inwards (-1).
inline std::vector<Stroke> onCircle(const Vector2& centre, double radius, double height,
                                    const std::vector<double>& angles, double sense) {
  std::vector<Stroke> strokes;
  for (const double angle : angles) {
    const Vector3 radial(std::cos(radians(angle)), std::sin(radians(angle)), 0);
    strokes.push_back({Vector3(centre.x(), centre.y(), height) + radius * radial, sense * radial});
  }
  return strokes;
}

inline std::vector<Stroke> joined(std::vector<Stroke> first, const std::vector<Stroke>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

inline std::vector<Case> cases() {
  const Words heights = {{261, -8}, {260, clearance}, {320, 1}};
  const Words holeHeights = {{261, -8}, {260, clearance}};
  const Words target = {{305, 1}, {303, 1}, {331, 0}, {332, 0}};
  const Words edge = with(heights, {{263, 20}, {264, 0}, {265, 70}, {266, 0}, {272, 2}, {267, 1}});
  const Words rectangle = with(heights, with(target, {{321, 0}, {322, 0}, {323, 100}, {324, 60}}));
  const Words circle = with(heights, with(target, {{321, 0}, {322, 0}, {262, 40}, {325, 30}, {247, -60}}));
  const Words width = with(heights, {{321, 50}, {322, 40}, {311, 40}, {305, 1}, {303, 1}, {405, 0}});
  const std::vector<double> clockwise = {30, -30, -90, -150}, quarters = {0, 90, 180, 270};
  const auto two = [](const auto& lay) {
    return [lay](Bench& bench) {
      lay(bench, 0, 0, 10);
      lay(bench, 60, 0, 10);
    };
  };
  const Words pair = {{268, 0}, {269, 0}, {270, 60}, {271, 0}, {307, 0}, {305, 1}};
  return {
      {.cycle = 400,
       .words = with(edge, {{307, 0}, {305, 1}}),
       .lay = block,
       .strokes = {{{20, -5, -8}, back}, {{70, -5, -8}, back}}},
      {.cycle = 401,
       .words = with(holeHeights, pair),
       .lay = two(hole),
       .strokes = fromMiddle({{0, 0}, {60, 0}}),
       .perObject = 4},
      {.cycle = 402,
       .words = with(heights, with(pair, {{313, 20}, {314, 20}, {315, -12}})),
       .lay = two(stud),
       .strokes = joined(onCircle({0, 0}, 15, -8, quarters, -1), onCircle({60, 0}, 15, -12, quarters, -1)),
       .perObject = 4,
       .way = Way::Arc},
      {.cycle = 403,
       .words = with(edge, {{312, 6}}),
       .lay = block,
       .strokes = {{{20, -5, -8}, back}, {{70, -5, -8}, back}}},
      {.cycle = 405,
       .words = with(heights, {{321, 0}, {322, 60}, {262, 30}, {325, 0}, {247, 90}, {337, 0}}),
       .lay = [](Bench& bench) { hole(bench, 0, 60, 15); },
       .strokes = onCircle({0, 60}, 10, -8, quarters, 1),
       .way = Way::Arc},
      {.cycle = 408,
       .words = with(width, {{272, 2}}),
       .lay =
           [](Bench& bench) {
             walls(bench, {50, 40}, {200, 40});
           },
       .strokes = {{{50, 55, -8}, back}, {{50, 25, -8}, -back}},
       .ordered = false},
      {.cycle = 409,
       .words = with(width, {{272, 1}}),
       .lay =
           [](Bench& bench) {
             bench.part(simulation::Box({30, -40, -40}, {70, 120, 0}), pose({0, 0, -400}));
           },
       .strokes = {{{75, 40, -8}, -right}, {{25, 40, -8}, right}},
       .perObject = 1,
       .ordered = false},
      {.cycle = 410,
       .words = rectangle,
       .lay =
           [](Bench& bench) {
             walls(bench, {0, 0}, {100, 60});
           },
       .strokes = {{{45, 0, -8}, right}, {{0, 25, -8}, back}, {{-45, 0, -8}, -right}, {{0, -25, -8}, -back}},
       .way = Way::AlongAxes,
       .ordered = false},
      {.cycle = 411,
       .words = rectangle,
       .lay =
           [](Bench& bench) {
             bench.part(simulation::Box({-50, -30, -40}, {50, 30, 0}), pose({0, 0, -400}));
           },
       .strokes = {{{55, 0, -8}, -right}, {{0, 35, -8}, -back}, {{-55, 0, -8}, right}, {{0, -35, -8}, back}},
       .way = Way::AlongAxes,
       .ordered = false},
      {.cycle = 412,
       .words = circle,
       .lay = [](Bench& bench) { hole(bench, 0, 0, 20); },
       .strokes = onCircle({0, 0}, 20 - standOff, -8, clockwise, 1),
       .way = Way::Arc},
      {.cycle = 413,
       .words = circle,
       .lay = [](Bench& bench) { stud(bench, 0, 0, 20); },
       .strokes = onCircle({0, 0}, 20 + standOff, -8, clockwise, -1),
       .way = Way::Arc},
      {.cycle = 414,
       .words = with(heights, with(target, {{263, 30}, {264, 0}, {326, 40}, {296, 0}, {297, 20}, {327, 30}, {304, 0}})),
       .lay = block,
       .strokes = {{{30, -5, -8}, back}, {{70, -5, -8}, back}, {{-5, 20, -8}, right}, {{-5, 50, -8}, right}}},
      // From the corner the first and third place lie the clearances away in both axes.
      {.cycle = 415,
       .words = with(heights, with(target, {{263, 0}, {264, 0}, {326, 30}, {327, 40}, {308, 1}, {304, 0}})),
       .lay =
           [](Bench& bench) {
             bench.part(simulation::Box({-40, -40, -40}, {0, 80, 0}), pose({0, 0, -400}));
             bench.part(simulation::Box({0, -40, -40}, {80, 0, 0}), pose({0, 0, -400}));
           },
       .strokes = {{{5, 5, -8}, -back}, {{30, 5, -8}, -back}, {{5, 5, -8}, -right}, {{5, 40, -8}, -right}},
       .newerOnly = true},
      {.cycle = 416,
       .words = with(holeHeights, with(target, {{273, 0}, {274, 0}, {262, 80}, {291, 0}, {292, 90}, {293, 180}})),
       .lay =
           [](Bench& bench) {
             for (const Vector2& at : {Vector2(40, 0), Vector2(0, 40), Vector2(-40, 0)})
               hole(bench, at.x(), at.y(), 10);
           },
       .strokes = fromMiddle({{40, 0}, {0, 40}, {-40, 0}}),
       .perObject = 4},
      {.cycle = 417,
       .words = {{263, 20}, {264, 30}, {294, 0}, {320, 1}, {260, clearance}, {305, 1}, {333, 0}, {303, 1}},
       .lay = block,
       .strokes = {{{20, 30, 5}, -up}}},
      {.cycle = 418,
       .words =
           with(holeHeights,
                with(target, {{268, 0}, {269, 0}, {270, 60}, {271, 0}, {316, 60}, {317, 50}, {318, 0}, {319, 50}})),
       .lay =
           [](Bench& bench) {
             for (const Vector2& at : {Vector2(0, 0), Vector2(60, 0), Vector2(60, 50), Vector2(0, 50)})
               hole(bench, at.x(), at.y(), 10);
           },
       .strokes = fromMiddle({{0, 0}, {60, 0}, {60, 50}, {0, 50}}),
       .perObject = 4},
      {.cycle = 419,
       .words = with(heights, {{263, 0}, {264, 40}, {272, 1}, {267, 1}, {305, 1}, {333, 0}, {303, 1}}),
       .lay = block,
       .strokes = {{{-5, 40, -8}, right}}},
      {.cycle = 419,
       .words = with(heights, {{263, 30}, {264, 40}, {261, 0}, {272, 3}, {267, -1}, {305, 1}, {333, 0}, {303, 1}}),
       .lay = block,
       .strokes = {{{30, 40, 5}, -up}}},
  };
}

}  // namespace probewright::testing_support::travel

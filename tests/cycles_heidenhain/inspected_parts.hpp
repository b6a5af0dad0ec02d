#pragma once

#include <vector>

#include "support/heidenhain_bench.hpp"

namespace probewright::testing_support {

/// A part for each inspection cycle with tolerances, 0.3 mm too large, laid out about the origin of `at` (machine
/// coordinates), its top at z = 0. With `side` -1 they are mirrored along the main axis.
struct InspectedPart {
  int cycle = 0;
  Bench bench;
  Words words;
};

inline std::vector<InspectedPart> inspectedParts(const Bench& bench, const Pose& at, int side = 1) {
  const bool newer = bench.control == ControlKind::TNC640;
  const Words common = {{261, -8}, {320, 1}, {260, 20}, {281, 0}, {309, 0}, {330, 0}};
  const Words circle = with(common, {{273, 0}, {274, 0}, {262, 30}, {325, 0}, {247, 90}, {301, 1}, {279, 0}, {280, 0}});
  const Words rectangle = with(
      common,
      {{273, 0}, {274, 0}, {282, 40}, {283, 30}, {301, 1}, {284, 0}, {285, 0}, {286, 0}, {287, 0}, {279, 0}, {280, 0}});
  std::vector<InspectedPart> all(8, InspectedPart{0, bench, {}});
  for (InspectedPart& one : all)
    one.bench.believedProbe().maximumTravel = 30;
  const auto walls = [&](Bench& world, double x, double y) {
    world.part(simulation::Box({x, -40, -30}, {x + 20, 40, 0}), at);
    world.part(simulation::Box({-x - 20, -40, -30}, {-x, 40, 0}), at);
    world.part(simulation::Box({-60, y, -30}, {60, y + 20, 0}), at);
    world.part(simulation::Box({-60, -y - 20, -30}, {60, -y, 0}), at);
  };
  all[0].cycle = 421;
  all[0].bench.part(simulation::Ring(15.15, 40, -30), at);
  all[0].words = with(circle, {{275, 30.1}, {276, 29.9}});
  all[1].cycle = 422;
  all[1].bench.part(simulation::RoundBar(15.15, -30, 0), at);
  all[1].words = with(circle, {{277, 30.1}, {278, 29.9}});
  all[2].cycle = 423;
  walls(all[2].bench, 20.15, 15.15);
  all[2].words = with(rectangle, {{284, 40.1}, {285, 39.9}, {286, 30.1}, {287, 29.9}});
  all[3].cycle = 424;
  all[3].bench.part(simulation::Box({-20.15, -15.15, -30}, {20.15, 15.15, 0}), at);
  all[3].words = with(rectangle, {{284, 40.1}, {285, 39.9}, {286, 30.1}, {287, 29.9}});
  all[4].cycle = 425;
  walls(all[4].bench, 20.15, 30);
  all[4].words = with(common, {{328, 0}, {329, 0}, {310, 0}, {272, 1}, {311, 40}, {288, 40.1}, {289, 39.9}, {301, 0}});
  all[5].cycle = 426;
  all[5].bench.part(simulation::Box({-20.15, -15, -30}, {20.15, 15, 0}), at);
  all[5].words =
      with(common, {{263, 20}, {264, 0}, {265, -20}, {266, 0}, {272, 1}, {311, 40}, {288, 40.1}, {289, 39.9}});
  all[6].cycle = 427;
  all[6].bench.part(
      side > 0 ? simulation::Box({-20, -15, -30}, {20.3, 15, 0}) : simulation::Box({-20.3, -15, -30}, {20, 15, 0}), at);
  all[6].words = with(common, {{263, 20}, {264, 0}, {272, 1}, {267, -1}, {288, 20.1}, {289, 19.9}});
  all[7].cycle = 430;
  for (const double angle : {0.0, 120.0, 240.0}) {
    all[7].bench.part(simulation::Ring(6, 12, -30),
                      at * pose({side * 30.15 * std::cos(radians(angle)), 30.15 * std::sin(radians(angle)), 0}));
  }
  all[7].words = with(
      common,
      {{273, 0}, {274, 0}, {262, 60}, {291, 0}, {292, 120}, {293, 240}, {288, 60.1}, {289, 59.9}, {279, 0}, {280, 0}});
  std::erase_if(all[7].words, [](const auto& word) { return word.first == 320; });
  if (!newer) {
    std::erase_if(all[4].words, [](const auto& word) { return word.first == 320 || word.first == 301; });
  }
  return all;
}

}  // namespace probewright::testing_support

#pragma once

#include "cycles_heidenhain/worlds.hpp"

/// A probe that is not as the control believes: its tip lies beside the spindle axis and its signal comes late.
namespace probewright::testing_support {

/// A block of 80 x 60 mm, and beside it a pocket, a hole and a stud; all lie where the programmer thinks.
struct WrongProbe {
  explicit WrongProbe(Dice& dice, const std::string& machine = "mill3", ControlKind kind = ControlKind::TNC640)
      : bench(kind, machine) {
    bench.preset(1, origin);
    offset = {dice.between(-0.2, 0.2), dice.between(-0.2, 0.2)};
    late = dice.between(0, 0.03);
    lateAlong = dice.between(0, 0.02);
    bench.trueProbe().tipOffset = offset;
    bench.believedProbe().tipOffset = Vector2::Zero();
    bench.trueProbe().pretravel = late;
    bench.trueProbe().axialPretravel = lateAlong;
  }
  /// A block whose lower left corner is the preset.
  void layBlock() { bench.part(simulation::Box({0, 0, -40}, {80, 60, 0}), pose(origin)); }
  Ran run(int cycle, const Words& words) const {
    Ran ran = bench.run(probe(cycle, words));
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran;
  }
  /// Where the new preset lies in the old one.
  Vector3 moved(const Ran& ran) const { return ran.preset().translation() - origin; }

  Vector3 origin = {-10, 5, -400};
  Bench bench;
  Vector2 offset;
  double late = 0, lateAlong = 0;
};

inline const Words height = {{261, -8}, {320, 0}, {260, 20}};
inline const Words heights = with(height, {{301, 0}});
inline const Words intoPreset = {{305, 1}, {303, 1}, {331, 0}, {332, 0}};
inline const Words unmonitored = {{279, 0}, {280, 0}, {281, 0}, {309, 0}, {330, 0}};

}  // namespace probewright::testing_support

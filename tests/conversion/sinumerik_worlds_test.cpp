#include "conversion/twins.hpp"

/// SINUMERIK programs as people write them, and their Klartext twins, in random worlds.
namespace probewright::testing_support {
namespace {

constexpr int worlds = 200;

/// From the tool change to above a place.
std::string above(const Vector3& place, double height) {
  return fmt::format("G17 G90 G710\nT1\nM6 D1\nG54\nG0 Z{:.6f}\nG0 X{:.6f} Y{:.6f}\n", height, place.x(), place.y());
}

std::vector<Counterpart> circleResults() { return {{"Q151", "_OVR[5]"}, {"Q152", "_OVR[6]"}, {"Q153", "_OVR[4]"}}; }

TEST(ConvertSinumerik, FindsHolesAndSpigots) {
  Dice dice(9770);
  for (int world = 0; world < worlds; ++world) {
    PlantedPart part = plant(dice, ControlKind::TNC640, 1, 180);
    const bool hole = dice.coin();
    const double diameter = dice.between(20, 80);
    if (hole) {
      part.bench.part(simulation::Ring(diameter / 2, diameter / 2 + 40, -40), part.machineFromPart);
    } else {
      part.bench.part(simulation::RoundBar(diameter / 2, -40, 0), part.machineFromPart);
    }
    const bool zone = dice.coin();
    const double clear = part.nominal.z() + 15;
    std::string text = above(part.nominal, clear);
    if (hole && !zone) text += fmt::format("G1 Z{:.6f} F1000\n", part.nominal.z() - 8);
    const int corrects = dice.whole(0, 1), frame = dice.coin() ? 19000 : dice.coin() ? 10001 : 2;
    text += fmt::format("CYCLE977({},{},,1,{:.3f},,,5,8,{:.3f},{},,,,1,,,,,,,,,,,1)\n",
                        (hole ? 1 : 2) + (hole && zone ? 1000 : 0) + 100 * corrects, corrects == 1 ? frame : 0,
                        diameter, dice.between(-90, 90), hole && !zone ? "" : "-25");
    text += fmt::format("R1=_OVR[4]\nR2=_OVR[17]\nG0 Z{:.6f}\nG0 X=R1 Y=R2\nM30\n", clear + 20);
    SCOPED_TRACE(fmt::format("world {}", world));
    expectTwinOfSinumerik(text, part, circleResults());
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ConvertSinumerik, FindsSurfaces) {
  Dice dice(9780);
  for (int world = 0; world < worlds; ++world) {
    PlantedPart part = plant(dice, ControlKind::TNC640, 1, 0);
    part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), part.machineFromPart);
    const int axis = dice.whole(0, 2), sign = axis == 2 || dice.coin() ? -1 : 1;
    Vector3 place = part.nominal;
    double set = place.z();
    if (axis < 2) {
      set = place[axis] - 50 * sign;
      place[axis] = set - 12 * sign;
    }
    std::string text = above(place, part.nominal.z() + 15);
    text += fmt::format("G0 Z={:.6f}\n", part.nominal.z() + (axis == 2 ? 8 : -10));
    const int corrects = dice.whole(0, 1);
    text += fmt::format("CYCLE978({},10001,,1,{:.6f},4,6,{},{},1,,,,,,,,,,,1)\n", 100 * corrects, set, axis + 1,
                        sign > 0 ? 1 : 2);
    text += "G0 Z=120\nM30\n";
    SCOPED_TRACE(fmt::format("world {}", world));
    std::vector<Counterpart> results;
    if (corrects == 0 || axis == 2) results = {{"Q160", "_OVR[4]"}};
    expectTwinOfSinumerik(text, part, results);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ConvertSinumerik, AlignsEdges) {
  Dice dice(9980);
  for (int world = 0; world < worlds; ++world) {
    PlantedPart part = plant(dice, ControlKind::TNC640, 1, 2);
    // Cycle 400 counts its points from unturned axes.
    part.bench.setup.presets.front().rotation.setZero();
    part.machineFromPreset = pose(part.machineFromPreset.translation());
    part.machineFromPart = part.machineFromPreset * pose(part.nominal + dice.within(1), {0, 0, part.skew});
    part.bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), part.machineFromPart);
    const int axis = dice.whole(0, 1), sign = dice.coin() ? 1 : -1, along = 1 - axis;
    Vector3 place = part.nominal;
    place[axis] -= sign * (50 + 12);
    place[along] -= 30;
    std::string text = above(place, part.nominal.z() + 15);
    const bool corrects = dice.coin(), beside = dice.coin();
    text += fmt::format("G1 Z{:.6f} F1000\n", part.nominal.z() - 10);
    text += fmt::format("CYCLE998({},{},0,1,,0,,10,5,{},{},{:.3f},,,,,1,,1)\n",
                        (beside ? 100005 : 5) + (corrects ? 100 : 0), corrects ? 10001 : 0,
                        (along + 1) * 100 + axis + 1, sign > 0 ? 1 : 2, dice.between(20, 60));
    text += "G0 Z=120\nM30\n";
    SCOPED_TRACE(fmt::format("world {}", world));
    std::vector<Counterpart> results;
    if (!corrects && axis == 1) results = {{"Q150", "_OVR[4]"}};
    expectTwinOfSinumerik(text, part, results);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(ConvertSinumerik, FindsCorners) {
  Dice dice(9610);
  for (int world = 0; world < worlds; ++world) {
    PlantedPart part = plant(dice, ControlKind::TNC640, 1, 2);
    const bool outside = dice.coin(), coordinates = dice.coin();
    if (outside) {
      part.bench.part(simulation::Box({0, 0, -40}, {100, 100, 0}), part.machineFromPart);
    } else {
      part.bench.part(simulation::Box({-30, -30, -40}, {100, 0, 0}), part.machineFromPart);
      part.bench.part(simulation::Box({-30, 0, -40}, {0, 100, 0}), part.machineFromPart);
    }
    const double away = outside ? -12 : 12;
    const Vector3& n = part.nominal;
    const Vector3 pole(n.x() + away, n.y() + away, n.z());
    std::string text = above(pole, n.z() + 15) + fmt::format("G1 Z{:.6f} F1000\n", n.z() - 10);
    const int variant = (outside ? 8 : 7) + 100 + (coordinates ? 10 : 0);
    const double l1 = 30, l2 = 70, l3 = 35, l4 = 60;
    text += coordinates ? fmt::format("CYCLE961({},10001,1,{},{},{},{},{},{},{},{},{},{},,,,20,10,1,,1)\n", variant,
                                      pole.x() + l1, pole.y(), pole.x() + l2, pole.y(), pole.x(), pole.y() + l3,
                                      pole.x(), pole.y() + l4, n.x(), n.y())
                        : fmt::format("CYCLE961({},10001,1,{},{},{},{},{},{},,,{},{},0,90,,20,10,1,,1)\n", variant, l1,
                                      l2, l3, l4, pole.x(), pole.y(), n.x(), n.y());
    text += "G0 Z=120\nM30\n";
    SCOPED_TRACE(fmt::format("world {}", world));
    expectTwinOfSinumerik(text, part, {{"Q151", "_OVR[5]"}, {"Q152", "_OVR[6]"}});
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace probewright::testing_support

#include "cycles_heidenhain/worlds.hpp"
#include "machine/description.hpp"

/// Calibrations and single touches on machines with five axes: standards that lie in a tilted plane, with a stylus
/// whose tip offset belongs to the spindle whatever the rotary axes do.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

struct Tilted {
  Bench bench;
  Pose plane = Pose::Identity();  ///< machine from the tilted plane, at its origin
  std::string tilt;
  double length = 0, ball = 0;
  Vector2 tip = Vector2::Zero();

  Tilted(Dice& dice, ControlKind control, const std::string& machine) : bench(control, machine) {
    const Vector3 origin(written(dice.between(-20, 20)), written(dice.between(-20, 20)), -430);
    const double rotation = written(dice.between(-20, 20));
    const Vector3 angles(written(dice.between(-15, 15)), written(dice.between(-15, 15)),
                         written(dice.between(-40, 40)));
    bench.preset(1, origin, rotation);
    plane = pose(origin, {0, 0, rotation}) * pose(Vector3::Zero(), angles);
    tilt = fmt::format("L Z-1 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC{:+.3f} TURN FMAX\nL Z+100 R0 FMAX\n",
                       angles.x(), angles.y(), angles.z());
    length = written(dice.between(90, 130), 4);
    ball = written(dice.between(1.5, 3), 4);
    tip = {written(dice.between(-0.15, 0.15), 4), written(dice.between(-0.15, 0.15), 4)};
    bench.probeOf(length, ball);
    bench.trueProbe().tipOffset = tip;
    bench.believedProbe().maximumTravel = 40;
  }
  void knowLittle(Dice& dice) {
    bench.believedProbe().radius = written(ball + dice.between(-0.2, 0.2), 4);
    bench.believedProbe().length = written(length + dice.between(-0.5, 0.5), 4);
  }
  template <class SolidType>
  void part(SolidType solid, const Vector3& place) {
    bench.part(std::move(solid), plane * pose(place));
  }
  Ran run(const std::string& blocks) const {
    Ran ran = bench.run(tilt + blocks);
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran;
  }
  void expectCalibrated(const Ran& ran, bool withLength) const {
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), ball, exact);
    const bool newer = bench.control == ControlKind::TNC640;
    const char* table = newer ? "TCHPROBE.TP" : "TOOL.T";
    EXPECT_NEAR(ran.cell(table, "1", newer ? "CAL_OF1" : "CAL-OF1"), tip.x(), exact);
    EXPECT_NEAR(ran.cell(table, "1", newer ? "CAL_OF2" : "CAL-OF2"), tip.y(), exact);
    if (withLength) {
      EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), length, exact);
    }
  }
};

std::string startAt(double x, double y, double z) {
  return fmt::format("L Z+100 R0 FMAX\nL X{:+.4f} Y{:+.4f} R0 FMAX\nL Z{:+.4f} R0 FMAX\n", x, y, z);
}

constexpr const char* machines[] = {"mill5-table-table", "mill5-head-table", "mill5-head-head"};

TEST(TiltedPlane, CalibratesOnEveryStandard) {
  Dice dice(4620);
  for (int at = 0; at < 36; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Tilted world(dice, controlOf(at / 3), machines[at % 3]);
    world.knowLittle(dice);
    const Vector3 beside(dice.between(-0.4, 0.4), dice.between(-0.4, 0.4), 0);
    const double start = written(dice.between(0, 360));
    world.part(simulation::SolidSphere(Vector3::Zero(), 12.5), beside);
    world.expectCalibrated(world.run(startAt(0, 0, 12.5 + 4) + probe(460, {{407, 12.5},
                                                                           {320, 1},
                                                                           {301, dice.whole(0, 1)},
                                                                           {423, dice.whole(3, 4)},
                                                                           {380, start},
                                                                           {433, 1},
                                                                           {434, 0}})),
                           true);
    if (world.bench.control == ControlKind::iTNC530) continue;
    world.part(simulation::Ring(18, 30, -30), Vector3(0, 90, 0) + beside);
    world.expectCalibrated(
        world.run(startAt(0, 90, -9) + probe(462, {{407, 18}, {320, 0}, {423, dice.whole(3, 8)}, {380, start}})),
        false);
    world.part(simulation::RoundBar(8, -30, 0), Vector3(0, -90, 0) + beside);
    world.expectCalibrated(
        world.run(startAt(0, -90, 4) +
                  probe(463, {{407, 8}, {320, 3}, {301, dice.whole(0, 1)}, {423, dice.whole(3, 8)}, {380, start}})),
        false);
    world.part(simulation::Box({-15, -15, -20}, {15, 15, 0}), Vector3(90, 0, 0.25));
    EXPECT_NEAR(world.run(startAt(90, 0, 4) + probe(461, {{434, 0.25}})).cell("TOOL.T", "1", "L"), world.length, exact);
  }
}

/// Cycle 4 corrects by the tip offset on the TNC 640, cycle 3 never does; 444 finds the surface.
TEST(TiltedPlane, TouchesSinglePoints) {
  Dice dice(4440);
  for (int at = 0; at < 36; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Tilted world(dice, controlOf(at / 3), machines[at % 3]);
    const bool newer = world.bench.control == ControlKind::TNC640;
    world.bench.believedProbe().tipOffset = world.tip;
    const double face = dice.between(-0.3, 0.3);
    world.part(simulation::Box({0, -20, -30}, {30, 20, 0}), {face, 0, 0});
    const Ran three = world.run(startAt(-10, 0, -8) +
                                "TCH PROBE 3.0 M\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 X ANGLE: +0\n"
                                "TCH PROBE 3.3 DIST +15 F100 MB5 REFERENCE SYSTEM: 0\n");
    const Ran four = world.run(startAt(-10, 0, -8) +
                               "TCH PROBE 4.0 M\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IX+1\n"
                               "TCH PROBE 4.3 ABST+15 F100 MB5 REFERENCE SYSTEM:0\n");
    EXPECT_EQ(three.q(13), 1);
    EXPECT_EQ(four.q(13), 1);
    EXPECT_NEAR(three.q(11), 0, exact);
    const Vector3 offset(four.q(10) - three.q(10), four.q(11) - three.q(11), four.q(12) - three.q(12));
    EXPECT_NEAR(offset.norm(), newer ? world.tip.norm() : 0, exact);
    EXPECT_NEAR(offset.z(), 0, exact);
    if (newer) {
      EXPECT_NEAR(four.q(10), face - world.ball, exact) << "the ball lies against the face";
    }
    EXPECT_LE(std::abs(three.q(10) - face + world.ball), world.tip.norm() + exact);
    // In the machine's system: the ball below the spindle nose, wherever table and head stand. A hole, because the
    // direction may be any.
    world.part(simulation::Ring(20, 35, -40), {0, 90, 0});
    const Ran machine = world.run(startAt(0, 90, -18) +
                                  "TCH PROBE 3.0 M\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 X ANGLE: +0\n"
                                  "TCH PROBE 3.3 DIST +30 F100 MB50 REFERENCE SYSTEM: 1\n");
    EXPECT_EQ(machine.q(13), 1);
    const auto& description = world.bench.setup.world.truth.machine;
    const auto& touch = machine.cycle().touches.back();
    machine::AxisPositions turned = touch.latched;
    for (std::size_t i = 0; i < description.axes.size(); ++i) {
      if (description.axes[i].kind != machine::AxisKind::Rotary) turned[i] = 0;
    }
    const Vector3 below =
        machine::baseFromTable(description, turned) * machine::baseFromTable(description, touch.latched).inverse() *
        machine::baseFromSpindle(description, touch.latched) * Vector3(0, 0, -(world.length - world.ball));
    EXPECT_LT((Vector3(machine.q(10), machine.q(11), machine.q(12)) - below).norm(), exact);
    if (newer) {
      // There the direction is one of the machine's axes, too: on a table the part is turned against it.
      const Matrix3 inMachine = machine::baseFromTable(description, turned).linear() * world.plane.linear();
      EXPECT_LT((inMachine * touch.direction - Vector3::UnitX()).norm(), exact);
    }
    if (!newer) continue;
    const Ran ran = world.run(
        probe(444, {{263, 0}, {264, 0}, {294, -8}, {581, -1}, {582, 0}, {583, 0}, {320, 1}, {260, 50}, {309, 0}},
              " ~\n  QS400=\" \" ;T"));
    EXPECT_NEAR(ran.q(151), face, exact);
    EXPECT_NEAR(ran.q(164), -face, exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support

#include "control/heidenhain/probe_table.hpp"
#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"
#include "geometry/decompositions.hpp"

/// STYLUS = L-TYPE: a ball at the end of an arm, which the spindle turns to every surface.
namespace probewright::testing_support {
namespace {

namespace hh = control::heidenhain;

/// R, CAL_OF1 and CAL_OF2 have four decimals.
constexpr double fromTables = 2e-4;
constexpr double height = -400;  ///< machine z of the preset

/// The control knows ball and arm of the stylus within half a millimetre. The standard lies at X0 Y0.
struct Bent {
  Bench bench{ControlKind::TNC640};
  TableFolder folder{bench};
  hh::TypedTable table = hh::defaultProbeTable(ControlKind::TNC640);
  double ball = 0;
  Vector2 arm = Vector2::Zero();  ///< at CAL_ANG
  Vector2 beside = Vector2::Zero();

  explicit Bent(Dice& dice) {
    bench.preset(1, {0, 0, height});
    bench.probeOf(written(dice.between(90, 140), 4), written(dice.between(1.5, 2.5), 4));
    ball = bench.trueProbe().ballRadius;
    const double angle = written(dice.between(-180, 180), 4);
    bench.trueProbe().tipOffset = pose({0, 0, 0}, {0, 0, dice.between(-180, 180)}).linear().topLeftCorner<2, 2>() *
                                  Vector2(dice.between(9, 12), 0);
    arm = Eigen::Rotation2Dd(radians(angle)) * bench.trueProbe().tipOffset;
    bench.believedProbe().radius = written(ball + dice.between(-0.4, 0.4), 4);
    bench.believedProbe().maximumTravel = 30;
    beside = {dice.between(-0.3, 0.3), dice.between(-0.3, 0.3)};
    number("DIST", 30);
    number("CAL_ANG", angle);
    number("CAL_OF1", written(arm.x() + dice.between(-0.4, 0.4), 4));
    number("CAL_OF2", written(arm.y() + dice.between(-0.4, 0.4), 4));
    text("STYLUS", "L-TYPE");
    text("TRACK", "ON");
  }
  void number(control::heidenhain::NumberColumn column, double value) {
    EXPECT_TRUE(table.setNumber("1", column, value));
    folder.put("TCHPROBE.TP", table);
  }
  void text(control::heidenhain::Column column, const char* value) {
    EXPECT_TRUE(table.setText("1", column, value));
    folder.put("TCHPROBE.TP", table);
  }
  Pose at(double x, double y, double z = 0) const { return pose({x, y, height + z}); }

  void expectCalibrated(const Ran& ran) const {
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), ball, fromTables);
    EXPECT_NEAR(ran.cell("TCHPROBE.TP", "1", "CAL_OF1"), arm.x(), fromTables);
    EXPECT_NEAR(ran.cell("TCHPROBE.TP", "1", "CAL_OF2"), arm.y(), fromTables);
  }
};

std::string above(double z) { return fmt::format("L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z{:+.4f} R0 FMAX\n", z); }
constexpr const char* away = "L Z+60 R0 FMAX\n";

/// A slanting face at X150, a hole at Y150, a pillar of 8 mm at Y-150.
struct Measured {
  Vector3 normal;
  Vector2 hole;
  double diameter, deviation, top;
  std::string cycles;
};

Measured layPart(Dice& dice, Bent& world) {
  Measured part;
  const double slope = radians(dice.between(20, 70)), turn = radians(dice.between(100, 260));
  part.normal = Vector3(std::cos(slope) * std::cos(turn), std::cos(slope) * std::sin(turn), std::sin(slope))
                    .unaryExpr([](double v) { return written(v, 6); });
  part.deviation = dice.between(-0.3, 0.3);
  part.hole = {dice.between(-0.4, 0.4), 150 + dice.between(-0.4, 0.4)};
  part.diameter = dice.between(45, 60);
  part.top = dice.between(-0.4, 0.4);
  Pose face = pose({150, 0, height});
  face.linear() = shortestTurn(Vector3::UnitZ(), part.normal).toRotationMatrix();
  world.bench.part(simulation::Box({-12, -12, -15}, {12, 12, 0}), face);
  world.bench.part(simulation::Ring(part.diameter / 2, 60, -30), world.at(part.hole.x(), part.hole.y()));
  world.bench.part(simulation::RoundBar(4, -30, 0), world.at(0, -150, part.top));
  const Vector3 nominal = Vector3(150, 0, 0) - part.normal.normalized() * part.deviation;
  part.cycles = probe(444,
                      {{263, nominal.x()},
                       {264, nominal.y()},
                       {294, nominal.z()},
                       {581, part.normal.x()},
                       {582, part.normal.y()},
                       {583, part.normal.z()},
                       {320, 1},
                       {260, 60},
                       {309, 0}},
                      " ~\n  QS400=\" \" ;TOLERANCE") +
                "Q30 = Q164\n" +
                probe(421, {{273, 0},
                            {274, 150},
                            {262, written(part.diameter)},
                            {325, written(dice.between(0, 360))},
                            {247, 90},
                            {261, -8},
                            {320, 0},
                            {260, 40},
                            {301, dice.whole(0, 1)},
                            {275, 0},
                            {276, 0},
                            {279, 0},
                            {280, 0},
                            {281, 0},
                            {309, 0},
                            {330, 0},
                            {423, 4},
                            {365, 1}}) +
                probe(427, {{263, 0},
                            {264, -150},
                            {261, 0},
                            {320, 0},
                            {272, 3},
                            {267, -1},
                            {260, 40},
                            {281, 0},
                            {288, 0},
                            {289, 0},
                            {309, 0},
                            {330, 0}});
  return part;
}

void expectMeasured(const Ran& ran, const Measured& part, double near = fromTables) {
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(30), part.deviation, near);
  EXPECT_NEAR(ran.q(151), part.hole.x(), near);
  EXPECT_NEAR(ran.q(152), part.hole.y(), near);
  EXPECT_NEAR(ran.q(153), part.diameter, 2 * near);
  EXPECT_NEAR(ran.q(160), part.top, near);
  // The ball itself is at the measuring height.
  for (const auto& touch : ran.outcome.journal.cycles[ran.outcome.journal.cycles.size() - 2].touches)
    EXPECT_NEAR(touch.ballCentre.z(), -8, near);
}

TEST(BentStylus, IsCalibratedInARingAndMeasuresSlantingFaces) {
  Dice dice(4621);
  for (int at = 0; at < 30; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Bent world(dice);
    const double radius = written(dice.between(22, 30), 4);
    world.bench.part(simulation::Ring(radius, radius + 15, -30), world.at(world.beside.x(), world.beside.y()));
    const Measured part = layPart(dice, world);
    const Ran ran = world.bench.run(
        above(-10) +
        probe(462, {{407, radius}, {320, 0}, {423, dice.whole(3, 8)}, {380, written(dice.between(0, 360))}}) + away +
        part.cycles);
    world.expectCalibrated(ran);
    expectMeasured(ran, part);
  }
}

/// The circle is measured by as many touches as the cycle is told; only the first search for its centre takes four.
TEST(BentStylus, IsCalibratedByAsManyTouchesAsTheCycleSays) {
  Dice dice(4233);
  Bent world(dice);
  world.bench.part(simulation::Ring(25, 40, -30), world.at(world.beside.x(), world.beside.y()));
  const Ran ran = world.bench.run(above(-10) + probe(462, {{407, 25}, {320, 0}, {423, 7}, {380, 20}}) + away);
  world.expectCalibrated(ran);
  const auto& touches = ran.outcome.journal.cycles.front().touches;
  int sevenths = 0;
  for (std::size_t i = 1; i < touches.size(); ++i) {
    const Vector3 &before = touches[i - 1].direction, &after = touches[i].direction;
    const double turn = degrees(std::atan2(before.cross(after).z(), before.dot(after)));
    sevenths += std::abs(std::abs(turn) - 360.0 / 7) < 1e-3 ? 1 : 0;
  }
  EXPECT_GT(sevenths, 6) << "more than one circle";
  EXPECT_EQ(sevenths % 6, 0) << "whole circles";
}

TEST(BentStylus, IsCalibratedOnAStud) {
  Dice dice(4631);
  for (int at = 0; at < 30; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Bent world(dice);
    const double radius = written(dice.between(5, 20), 4);
    world.bench.part(simulation::RoundBar(radius, -40, 0), world.at(world.beside.x(), world.beside.y()));
    const Measured part = layPart(dice, world);
    const Ran ran = world.bench.run(above(4) +
                                    probe(463, {{407, radius},
                                                {320, 3},
                                                {301, dice.whole(0, 1)},
                                                {423, dice.whole(3, 8)},
                                                {380, written(dice.between(0, 360))}}) +
                                    away + part.cycles);
    world.expectCalibrated(ran);
    expectMeasured(ran, part);
  }
}

TEST(BentStylus, IsCalibratedOnASphereWithItsLength) {
  Dice dice(4601);
  for (int at = 0; at < 30; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Bent world(dice);
    const double radius = written(dice.between(10, 15), 4), length = world.bench.believedProbe().length;
    world.bench.believedProbe().length = written(length + dice.between(-0.5, 0.5), 4);
    world.bench.part(simulation::SolidSphere(Vector3::Zero(), radius), world.at(world.beside.x(), world.beside.y()));
    const Measured part = layPart(dice, world);
    const Words words = {
        {407, radius}, {320, 1}, {301, dice.whole(0, 1)}, {423, dice.whole(3, 8)}, {380, written(dice.between(0, 360))},
        {433, 1},      {434, 0}};
    const Ran ran = world.bench.run(above(radius + 4) + probe(460, words) + away + part.cycles);
    world.expectCalibrated(ran);
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), length, fromTables);
    expectMeasured(ran, part);
    EXPECT_EQ(world.bench.run(above(radius + 4) + probe(460, with(words, {{455, 5}}))).alarm(),
              "Calibration not possible");
  }
}

/// What the control does not know of the stylus is what it measures wrongly.
TEST(BentStylus, MeasuresWronglyUncalibrated) {
  Dice dice(4603);
  Bent world(dice);
  const Measured part = layPart(dice, world);
  world.bench.believedProbe().radius = world.ball;
  const Vector2 longer = world.arm * (1 + 0.25 / world.arm.norm());
  world.number("CAL_OF1", longer.x());
  world.number("CAL_OF2", longer.y());
  const Ran ran = world.bench.run(part.cycles);
  ASSERT_TRUE(ran.finished()) << ran.why();
  // The ball seems to reach 0.25 mm further towards the face and into the wall of the hole.
  const double level = std::hypot(part.normal.x(), part.normal.y());
  EXPECT_NEAR(ran.q(30), part.deviation - 0.25 * level, 1e-3);
  EXPECT_NEAR(ran.q(153), part.diameter + 0.5, 1e-3);
}

TEST(BentStylus, NeedsATurningSpindleAndAnArm) {
  Dice dice(4604);
  Bent world(dice);
  world.bench.part(simulation::RoundBar(10, -40, 0), world.at(0, 0));
  const std::string stud = above(4) + probe(463, {{407, 10}, {320, 3}, {301, 1}, {423, 4}, {380, 0}});
  EXPECT_TRUE(world.bench.run(stud).finished());
  world.number("CAL_OF1", 0);
  world.number("CAL_OF2", 0);
  const Ran unknown = world.bench.run(stud);
  EXPECT_EQ(unknown.alarm(), "Touch probe not calibrated");
  EXPECT_NE(unknown.why().find("CAL_OF1"), std::string::npos) << unknown.why();
  world.text("TRACK", "OFF");
  EXPECT_EQ(world.bench.run(stud).alarm(), "Spindle orientation required");
  // In a ring that the ball on its arm does not fit into there is nothing to calibrate.
  world.text("TRACK", "ON");
  world.number("CAL_OF1", world.arm.x());
  world.number("CAL_OF2", world.arm.y());
  const Ran narrow = world.bench.run(above(4) + probe(462, {{407, 8}, {320, 0}, {423, 4}, {380, 0}}));
  EXPECT_FALSE(narrow.finished());
}

/// Cycles 0 and 1 start with the spindle axis where the block says, turn the ball to the surface, and leave the spindle
/// position in Q115 and Q116. Cycles 3 and 4 do not turn it: 3 leaves the spindle axis, 4 the ball.
TEST(BentStylus, SingleTouchesPlaceTheSpindleAxis) {
  Dice dice(4605);
  for (int at = 0; at < 30; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Bent world(dice);
    world.bench.believedProbe().radius = world.ball;
    world.number("CAL_OF1", world.arm.x());
    world.number("CAL_OF2", world.arm.y());
    const bool square = at % 2 == 0;
    const double angle = square ? 90.0 * dice.whole(-1, 2) : written(dice.between(-179, 179));
    const double wall = 80 + dice.between(-0.5, 0.5), reach = world.ball + world.arm.norm();
    const Vector3 towards = pose(Vector3::Zero(), {0, 0, angle}).linear().col(0);
    const Vector3 across = pose(Vector3::Zero(), {0, 0, angle}).linear().col(1);
    Pose lying = pose({0, 0, height}, {0, 0, angle});
    world.bench.part(simulation::Box({wall, -60, -40}, {wall + 30, 60, 0}), lying);
    const Vector3 start = (towards * (80 - reach - 4) + across * 7).unaryExpr([](double v) { return written(v, 4); });
    std::string blocks = fmt::format(
        "TCH PROBE 1.0 POLAR\nTCH PROBE 1.1 X ANGLE: {0:+.4f}\nTCH PROBE 1.2 X{1:+.4f} Y{2:+.4f} Z-8\n"
        "Q40 = Q115\nQ41 = Q116\n"
        "TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q50\nTCH PROBE 3.2 X ANGLE: {0:+.4f}\n"
        "TCH PROBE 3.3 DIST +10 F100 MB10 REFERENCE SYSTEM: 0\n"
        "TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q60\nTCH PROBE 4.2 IX{3:+.6f} IY{4:+.6f} IZ+0\n"
        "TCH PROBE 4.3 ABST+10 F100 MB10 REFERENCE SYSTEM:0\n",
        angle, start.x(), start.y(), towards.x(), towards.y());
    const bool alongX = std::abs(towards.x()) > 0.5;
    const bool positive = (alongX ? towards.x() : towards.y()) > 0;
    if (square) {
      blocks += fmt::format("TCH PROBE 0.0 REF. PLANE Q5 {}{}\nTCH PROBE 0.1 X{:+.4f} Y{:+.4f} Z-8\n",
                            alongX ? 'X' : 'Y', positive ? '+' : '-', start.x(), start.y());
    }
    const Ran ran = world.bench.run(blocks);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto place = [&](int number) { return Vector3(ran.q(number), ran.q(number + 1), 0); };
    EXPECT_NEAR(place(40).dot(towards), wall - reach, fromTables);
    EXPECT_NEAR(place(40).dot(across), start.dot(across), fromTables);
    EXPECT_NEAR(place(50).dot(towards), wall - reach, fromTables);
    EXPECT_EQ(ran.q(53), 1);
    EXPECT_NEAR(place(60).dot(towards), wall - world.ball, fromTables);
    EXPECT_NEAR(place(60).dot(across), start.dot(across), fromTables);
    EXPECT_EQ(ran.q(63), 1);
    if (square) {
      EXPECT_NEAR(ran.q(5), positive ? wall : -wall, fromTables);
    }
  }
}

/// 461 holds the ball at CAL_ANG: the surface must lie below the ball, beside the spindle axis.
TEST(BentStylus, IsCalibratedInItsLengthBesideTheSpindleAxis) {
  Dice dice(4606);
  for (int at = 0; at < 20; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Bent world(dice);
    const double length = world.bench.believedProbe().length;
    world.bench.believedProbe().length = written(length + dice.between(-0.5, 0.5), 4);
    const double top = written(dice.between(-3, 3), 4);
    const Vector2 ball(world.arm);
    world.bench.part(simulation::RoundBar(3, -30, 0), world.at(ball.x(), ball.y(), top));
    const Ran ran = world.bench.run(above(top + 6) + probe(461, {{434, top}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), length, fromTables);
    EXPECT_EQ(ran.touches(), 1U);
  }
}

}  // namespace
}  // namespace probewright::testing_support

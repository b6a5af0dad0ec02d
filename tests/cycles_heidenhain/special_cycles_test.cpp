#include <gmock/gmock.h>

#include "cycles_heidenhain/walls.hpp"

/// Cycles 3, 4 and 444: single points in any direction.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

constexpr int worlds = 100;
constexpr double exact = 1e-6;

TEST(Cycle444, FindsTheDeviationAlongAnyNormal) {
  Dice dice(444);
  int states[3] = {0, 0, 0};
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Wall world = wall(dice, ControlKind::TNC640, anyNormal(dice));
    const double deviation = dice.between(-0.8, 0.8);
    const Vector3 onWall = world.point + world.normal.cross(Vector3(1, 2, 3)) * dice.between(-2, 2);
    const Vector3 nominal = (onWall - world.normal * deviation).unaryExpr([](double v) { return written(v, 6); });
    const double scale = dice.between(0.1, 5);
    const int reaction = dice.whole(0, 2);
    const Words words = {{263, nominal.x()},
                         {264, nominal.y()},
                         {294, nominal.z()},
                         {581, world.normal.x() * scale},
                         {582, world.normal.y() * scale},
                         {583, world.normal.z() * scale},
                         {320, dice.coin() ? 0 : 2},
                         {260, 60},
                         {309, reaction}};
    const Ran ran = world.bench.run(probe(444, words, " ~\n  QS400=\"0,3-0.2\" ;TOLERANCE"));
    ASSERT_TRUE(ran.finished()) << ran.why();
    // The normal of the block has six decimals.
    EXPECT_NEAR(ran.q(164), deviation, 2e-5);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(ran.q(161 + axis), ran.q(151 + axis) - nominal[axis], exact);
    }
    const Vector3 found(ran.q(151), ran.q(152), ran.q(153));
    EXPECT_NEAR((found - world.point).dot(world.normal), 0, 2e-5);
    const int state = deviation > 0.3 ? 1 : deviation < -0.2 ? 2 : 0;
    ++states[state];
    EXPECT_EQ(ran.q(183), state);
    const auto stops =
        std::ranges::count(ran.outcome.journal.events, control::EventKind::Stop, &control::EventRecord::kind);
    EXPECT_EQ(stops, (reaction == 1 && state > 0) || (reaction == 2 && state == 2) ? 1 : 0);
    const std::string log = ran.log("TCHPR444.html");
    static constexpr const char* colours[] = {"color:green", "color:orange", "color:red"};
    EXPECT_NE(log.find(colours[state]), std::string::npos);
  }
  for (const int count : states)
    EXPECT_GT(count, 10);
}

TEST(Cycle444, ReadsEveryFormOfTheTolerance) {
  const auto status = [](const std::string& tolerance, double deviation) {
    Bench bench;
    bench.preset(1, {0, 0, -400}, 0);
    bench.part(simulation::HalfSpace({Vector3(0, 0, -400 + deviation), Vector3::UnitZ()}));
    const Words words = {{263, 0}, {264, 0}, {294, 0}, {581, 0}, {582, 0}, {583, 1}, {320, 0}, {260, 60}, {309, 0}};
    const Ran ran = bench.run(probe(444, words, fmt::format(" ~\n  QS400=\"{}\" ;T", tolerance)));
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran.q(183);
  };
  EXPECT_EQ(status("0.4-0.1", 0.39), 0);
  EXPECT_EQ(status("0.4-0.1", 0.41), 1);
  EXPECT_EQ(status("0.4-0.1", -0.11), 2);
  EXPECT_EQ(status("0.4", 0.39), 0);
  EXPECT_EQ(status("0.4", -0.01), 2);
  EXPECT_EQ(status("-0.1", 0.01), 1);
  EXPECT_EQ(status("-0.1", -0.09), 0);
  EXPECT_EQ(status("1-1", -0.9), 0);
  for (const char* none : {" ", "0", "0.1+0.1", "0.1+0.2"})
    EXPECT_EQ(status(none, 1), -1) << none;
}

/// The limits of a coordinate, the smaller one first, also where the normal points down its axis.
TEST(Cycle444, WritesTheLowerLimitOfEachAxisFirst) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  const Vector3 normal(-0.6, 0, 0.8);
  bench.part(simulation::HalfSpace({Vector3(10, 0, -395) + 0.2 * normal, normal}));
  const Words words = {{263, 10}, {264, 0}, {294, 5}, {581, -6}, {582, 0}, {583, 8}, {320, 0}, {260, 60}, {309, 0}};
  const Ran ran = bench.run(probe(444, words, " ~\n  QS400=\"0.4-0.1\" ;T"));
  ASSERT_TRUE(ran.finished()) << ran.why();
  const std::string log = ran.log("TCHPR444.html");
  EXPECT_THAT(log, HasSubstr("<td>10.0000</td><td>9.7600</td><td>10.0600</td><td>9.8800</td><td>-0.1200</td>"));
  EXPECT_THAT(log, HasSubstr("<td>5.0000</td><td>4.9200</td><td>5.3200</td><td>5.1600</td><td>0.1600</td>"));
}

/// Every number of the log, in mm and in inches; a row for each axis and one along the normal.
TEST(Cycle444, WritesDownWhatItMeasured) {
  for (const bool inch : {false, true}) {
    SCOPED_TRACE(inch);
    const double unit = inch ? 25.4 : 1;
    Bench bench;
    bench.preset(1, {0, 0, -400}, 0);
    bench.believedProbe().maximumTravel = 25.4;
    bench.program = "TNC:\\FORM\\P1.H";
    bench.part(simulation::HalfSpace({Vector3(0, 0, -400 + 0.254), Vector3::UnitZ()}));
    const Words words = {{263, 25.4 / unit}, {264, -12.7 / unit}, {294, 0}, {581, 0}, {582, 0}, {583, 2},
                         {320, 0},           {260, 50.8 / unit},  {309, 1}};
    const std::string tolerance = fmt::format(" ~\n  QS400=\"{}-{}\" ;T", 0.127 / unit, 0.0508 / unit);
    const Ran ran = bench.run(probe(444, words, tolerance), inch ? "INCH" : "MM");
    ASSERT_TRUE(ran.finished()) << ran.why();
    const std::string log = ran.log("TCHPR444.html");
    const auto row = [&](const std::string& name, const std::vector<double>& values, const std::string& state = "") {
      std::string text = "<tr><td>" + name + "</td>";
      for (const double value : values)
        text += fmt::format("<td>{:.{}f}</td>", value / unit, inch ? 5 : 4);
      return text + (state.empty() ? "<td></td></tr>" : state + "</tr>");
    };
    EXPECT_NE(log.find(", TNC:\\FORM\\P1.H, tool 1 PROBE, touch probe 1</p>"), std::string::npos) << log;
    // Direction of the stroke with the length of DIST, nominal, limits, actual, deviation.
    EXPECT_NE(log.find(row("Main axis", {0, 25.4, 25.4, 25.4, 25.4, 0})), std::string::npos) << log;
    EXPECT_NE(log.find(row("Minor axis", {0, -12.7, -12.7, -12.7, -12.7, 0})), std::string::npos) << log;
    EXPECT_NE(log.find(row("Tool axis", {-25.4, 0, -0.0508, 0.127, 0.254, 0.254})), std::string::npos) << log;
    EXPECT_NE(log.find(row("Along the normal", {25.4, 0, -0.0508, 0.127, 0.254, 0.254},
                           "<td style=\"color:orange\">rework</td>")),
              std::string::npos)
        << log;
    ASSERT_EQ(ran.screens().size(), 1U);
    EXPECT_NE(ran.screens().front().find(inch ? "+0.01000" : "+0.2540"), std::string::npos) << ran.screens().front();
  }
}

TEST(Cycle444, Refusals) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  bench.part(simulation::HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
  const Words words = {{263, 0}, {264, 0}, {294, 0}, {581, 0}, {582, 0}, {583, 1}, {320, 0}, {260, 60}, {309, 0}};
  const std::string tolerance = " ~\n  QS400=\"1-1\" ;T";
  EXPECT_TRUE(bench.run(probe(444, words, tolerance)).finished());
  EXPECT_EQ(bench.run(probe(444, with(words, {{583, 0}}), tolerance)).alarm(), "Surface normal wrong");
  EXPECT_EQ(bench.run(probe(444, words, " ~\n  QS400=\"wide\" ;T")).alarm(), "Tolerance wrong");
  EXPECT_EQ(bench.run(probe(444, with(words, {{294, 40}}), tolerance)).alarm(), "Touch point inaccessible");
  EXPECT_EQ(bench.run("CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n" + probe(444, words, tolerance)).alarm(),
            "Coordinate transformation not permitted");
  EXPECT_EQ(bench.run("CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 1.1\n" + probe(444, words, tolerance)).alarm(),
            "Coordinate transformation not permitted");
  EXPECT_EQ(bench.run("FUNCTION MODE TURN\n" + probe(444, words, tolerance)).alarm(), "Function not permitted");
}

/// The ball centre that a move from `start` along `direction` ends with, `offset` away from the spindle axis.
Vector3 metBy(const Vector3& start, const Vector3& direction, const Wall& world) {
  const Vector3 ball = start + world.tip;
  const double travel = (world.ball - (ball - world.point).dot(world.normal)) / direction.dot(world.normal);
  return start + direction * travel;
}

std::string startAt(const Vector3& tipPosition) {
  return fmt::format("L Z+150 R0 FMAX\nL X{:+.6f} Y{:+.6f} R0 FMAX\nL Z{:+.6f} R0 FMAX\n", tipPosition.x(),
                     tipPosition.y(), tipPosition.z());
}

TEST(Cycle4, MeasuresAlongAnyVector) {
  Dice dice(4);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const Vector3 normal = anyNormal(dice);
    Wall world = wall(dice, controlOf(at), normal);
    const Vector3 vector = (-world.normal * 2 + dice.within(0.3)).unaryExpr([](double v) { return written(v); });
    const Vector3 ball =
        (world.point + world.normal * (world.ball + 12)).unaryExpr([](double v) { return written(v, 6); });
    const Vector3 tip = ball - Vector3(0, 0, world.ball);
    const bool inMachine = dice.coin();
    const double back = written(dice.between(0, 30));
    const int first = dice.whole(1, 90);
    const Ran ran =
        world.bench.run(startAt(tip) + fmt::format("TCH PROBE 4.0 MEASURING IN 3-D\nTCH PROBE 4.1 Q{}\n"
                                                   "TCH PROBE 4.2 IX{:+.3f} IY{:+.3f} IZ{:+.3f}\n"
                                                   "TCH PROBE 4.3 DIST+45 F100 MB{:.3f} REFERENCE SYSTEM:{}\n",
                                                   first, vector.x(), vector.y(), vector.z(), back, inMachine ? 1 : 0));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Vector3 direction = vector.normalized();
    const Vector3 met = metBy(ball, direction, world);
    Vector3 expected = met;
    if (world.bench.control == ControlKind::TNC640) expected += world.tip;
    if (inMachine) expected = world.machineFromPreset * expected;
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(ran.q(first + axis), expected[axis], exact);
    EXPECT_EQ(ran.q(first + 3), 1);
    // Back by MB, at most to the start.
    const double stays = std::max(0.0, (met - ball).norm() - back);
    const auto axes = ran.machine->position();
    const Vector3 nose(axes[0], axes[1], axes[2]);
    const Vector3 spindle = world.machineFromPreset * (ball + direction * stays) +
                            Vector3(0, 0, world.bench.believedProbe().length - world.ball);
    EXPECT_LT((nose - spindle).norm(), 1e-3);
  }
}

TEST(Cycle3, MeasuresAtAnyAngleOfAnyPlane) {
  Dice dice(3);
  for (int at = 0; at < worlds; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    const int axis = dice.whole(0, 2);
    double angle = written(dice.between(-180, 180));
    Vector3 direction = Vector3::Zero();
    direction[axis] = std::cos(radians(angle));
    direction[(axis + 1) % 3] = std::sin(radians(angle));
    if (direction.z() > -0.05 && axis != 0) {
      // Upwards there is nothing to touch for a stylus that hangs down.
      angle = axis == 2 ? 180 - written(dice.between(-80, 80)) : -written(dice.between(10, 170));
      angle = std::remainder(angle, 360);
      direction.setZero();
      direction[axis] = std::cos(radians(angle));
      direction[(axis + 1) % 3] = std::sin(radians(angle));
    }
    const ControlKind control = controlOf(at);
    const bool inMachine = dice.coin();
    Wall world = wall(dice, control, -direction);
    const Vector3 moves = inMachine && control == ControlKind::TNC640
                              ? Vector3(world.machineFromPreset.linear().transpose() * direction)
                              : direction;
    layWall(world, -moves);
    const Vector3 ball = (world.point - moves * (world.ball + 12)).unaryExpr([](double v) { return written(v, 6); });
    const bool backwards = dice.coin();
    if (backwards) angle = std::remainder(angle + 180, 360);
    const std::string mode = dice.coin() ? "TCH PROBE 3.4 ERRORMODE1\n" : "";
    const Ran ran =
        world.bench.run(startAt(ball - Vector3(0, 0, world.ball)) +
                        fmt::format("TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 {} ANGLE: {:+.3f}\n"
                                    "TCH PROBE 3.3 DIST {} F100 MB1 REFERENCE SYSTEM: {}\n{}",
                                    "XYZ"[axis], angle, backwards ? "-40" : "+40", inMachine ? 1 : 0, mode));
    ASSERT_TRUE(ran.finished()) << ran.why();
    Vector3 expected = metBy(ball, moves, world);
    if (inMachine) expected = world.machineFromPreset * expected;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(ran.q(10 + i), expected[i], 2e-5);
    EXPECT_EQ(ran.q(13), 1);
    ASSERT_EQ(ran.touches(), 1U);
    EXPECT_LT((ran.cycle().touches[0].target - (ball + 40 * moves)).norm(), 1e-3) << "the ball at the end of the way";
  }
}

std::string cycle3(const std::string& last = {}) {
  return "TCH PROBE 3.0 MEASURING\nTCH PROBE 3.1 Q10\nTCH PROBE 3.2 Z ANGLE: +180\n"
         "TCH PROBE 3.3 DIST +10 F100 MB1 REFERENCE SYSTEM: 0\n" +
         last;
}

TEST(Cycle3, GoesOnWithoutATouch) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench(control);
    bench.preset(1, {0, 0, -400}, 0);
    const Ran ran = bench.run("L Z+50 R0 FMAX\n" + cycle3() + "Q20 = 7\n");
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.q(13), -1);
    EXPECT_EQ(ran.q(20), 7);
    const Ran vector = bench.run(
        "L Z+50 R0 FMAX\nTCH PROBE 4.0 M\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IZ-1\n"
        "TCH PROBE 4.3 ABST+5 F100 MB50 REFERENCE SYSTEM:0\n");
    ASSERT_TRUE(vector.finished()) << vector.why();
    EXPECT_EQ(vector.q(13), -1);
  }
}

TEST(Cycle3, JudgesADeflectedStylus) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench(control);
    bench.preset(1, {0, 0, -400}, 0);
    bench.part(simulation::HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
    // Cycle 4 without retraction leaves the stylus in contact.
    const std::string start = "L Z+5 R0 FMAX\n" + cycle3() +
                              "TCH PROBE 4.0 M\nTCH PROBE 4.1 Q30\nTCH PROBE 4.2 IZ-1\n"
                              "TCH PROBE 4.3 ABST+9 F100 MB0 REFERENCE SYSTEM:0\n";
    const Ran refused = bench.run(start + cycle3());
    const Ran goesOn = bench.run(start + cycle3("TCH PROBE 3.4 ERRORMODE1\n"));
    EXPECT_EQ(refused.alarm(), "Stylus already in contact");
    ASSERT_TRUE(goesOn.finished()) << goesOn.why();
    EXPECT_EQ(goesOn.q(13), control == ControlKind::TNC640 ? -1 : 2);
  }
}

/// A stylus that stands against the part stops the program, unless M141 takes it away: in its own block only.
TEST(M141, LeadsADeflectedStylusAwayInItsBlock) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    Bench bench(control);
    bench.preset(1, {0, 0, -400}, 0);
    bench.part(simulation::HalfSpace({Vector3(0, 0, -400), Vector3::UnitZ()}));
    const std::string touched =
        "L Z+5 R0 FMAX\nTCH PROBE 4.0 M\nTCH PROBE 4.1 Q30\nTCH PROBE 4.2 IZ-1\n"
        "TCH PROBE 4.3 ABST+9 F100 MB0 REFERENCE SYSTEM:0\n";
    EXPECT_EQ(bench.run(touched + "L IZ+2 F500\n").alarm(), "Touch probe deflected");
    const Ran away = bench.run(touched + "L IZ+2 F500 M141\nL IX+1 F500\nFN 18: SYSREAD Q40 = ID270 NR1 IDX3\n");
    ASSERT_TRUE(away.finished()) << away.why();
    EXPECT_NEAR(away.q(40), 2, 0.01);
    EXPECT_EQ(bench.run("L Z+5 R0 FMAX\nL Z+4 F500 M141\nL Z-4 F500\n").alarm(), "Touch probe deflected");
  }
}

TEST(Cycle4, NeedsADirection) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  const Ran ran = bench.run(
      "TCH PROBE 4.0 M\nTCH PROBE 4.1 Q10\nTCH PROBE 4.2 IX+0\nTCH PROBE 4.3 ABST+5 F100 MB1 REFERENCE SYSTEM:0\n");
  EXPECT_EQ(ran.alarm(), "Probing direction not defined");
}

TEST(Cycle3, RunsInTurningMode) {
  Bench bench;
  bench.preset(1, {0, 0, -400}, 0);
  const Ran ran = bench.run("L Z+50 R0 FMAX\nFUNCTION MODE TURN\n" + cycle3());
  EXPECT_TRUE(ran.finished()) << ran.why();
}

}  // namespace
}  // namespace probewright::testing_support

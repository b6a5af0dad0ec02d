#include <algorithm>

#include "support/sinumerik_bench.hpp"

/// Which kind of probe measures what, and how each is led.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

simulation::Truth hole() {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Ring(20, 45, -60), translation({0, 0, table}));
  return truth;
}

TEST(ProbeKinds, EachCycleTakesTheKindsThatCanDoItsWork) {
  const struct {
    const char* name;
    NamedNumbers call;
    std::vector<int> types;
  } cases[] = {
      {"CYCLE977", {{"S_MVAR", 1}, {"S_SETV", 40}}, {710, 712, 714, 580}},
      {"CYCLE977", {{"S_MVAR", 3}, {"S_SETV", 40}, {"S_MA", 1}}, {710, 712, 580}},
      {"CYCLE978", {{"S_SETV", 20}, {"S_MA", 1}, {"S_MD", 1}}, {710, 712, 713, 580}},
      {"CYCLE979", {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_INCA", 90}}, {710, 712, 580}},
      {"CYCLE976", {{"S_MVAR", 1001}, {"S_SETV", 40}, {"S_MA", 1}, {"S_MD", 0}}, {710, 712, 713, 714, 580}},
      {"CYCLE998", {{"S_MVAR", 100005}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 2}, {"S_SETV", 20}}, {710, 712, 580}},
      {"CYCLE961", {{"S_MVAR", 5}, {"S_SETV1", 9}, {"S_SETV2", 5}}, {710, 712, 580}},
      {"CYCLE961", {{"S_MVAR", 7}, {"S_SETV1", 9}, {"S_SETV2", 5}, {"S_SETV3", 9}, {"S_INCA", 90}}, {710, 580}},
      {"CYCLE997", {{"S_MVAR", 9}, {"S_SETV", 20}}, {710, 580}},
      {"CYCLE995", {{"S_MVAR", 102015}, {"S_SETV", 20}, {"S_DZ", 9}}, {710, 580}},
      {"CYCLE976", {{"S_MVAR", 0}, {"S_MA", 3}, {"S_MD", 1}}, {710, 712, 713, 580}},
      {"CYCLE976", {{"S_MVAR", 3}, {"S_SETV", 20}}, {710, 712, 714, 580}},
      {"CYCLE976", {{"S_MVAR", 1004}, {"S_SETV", 20}, {"S_MA", 1}}, {710, 712, 580}},
  };
  for (const auto& [name, call, types] : cases) {
    for (const int type : {710, 712, 713, 714, 580, 120, 725}) {
      SinumerikBench bench(hole());
      plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
      bench.set("$TC_DP1", {1, 1}, type);
      bench.set("$TC_DP2", {1, 1}, 7);
      bench.start({0, 0, -10});
      const bool refused = bench.alarmOf(name, with({{"S_FA", 5}, {"S_TSA", 30}}, call)) == "61309";
      EXPECT_EQ(refused, std::ranges::find(types, type) == types.end()) << name << " with type " << type;
    }
  }
}

TEST(ProbeKinds, AMonodirectionalProbeTurnsIntoEachTouch) {
  // Its ball lies off the axis towards the side that switches; wherever it is turned, that side meets the surface.
  Planter plant(712);
  for (int world = 0; world < 24; ++world) {
    const double angle = plant.number(0, 359.9), aside = plant.number(0.05, 0.4);
    simulation::Truth truth = perfectWorld();
    truth.tools[0].probe.tipOffset = {aside * std::cos(radiansFromDegrees(-angle)),
                                      aside * std::sin(radiansFromDegrees(-angle))};
    const Vector3 error(plant.number(-1, 1), plant.number(-1, 1), 0);
    const double turn = plant.number(-40, 40);
    const Pose part = translation({0, 0, table}) * rotation(Vector3::UnitZ(), turn) * translation(error);
    const bool edge = world % 2 == 0;
    if (edge) {
      place(truth, simulation::Box({0, 0, -60}, {80, 80, 0}), part);
    } else {
      place(truth, simulation::RoundBar(22, -60, 0), part);
    }
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table}, {0, 0, turn});
    bench.set("$TC_DP1", {1, 1}, 712);
    bench.set("$TC_DP10", {1, 1}, angle);
    for (const char* trigger : {"$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", "$SNS_MEA_WP_TRIG_PLUS_DIR_AX2"})
      bench.set(trigger, {0}, 2 + aside);
    for (const char* trigger : {"$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", "$SNS_MEA_WP_TRIG_MINUS_DIR_AX2"})
      bench.set(trigger, {0}, -2 - aside);
    bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 4 + 2 * aside);
    if (edge) {
      const int axis = world % 4 / 2;
      bench.start(axis == 0 ? Vector3(-12, 20, -10) : Vector3(20, -12, -10));
      bench.run("CYCLE978",
                {{"S_MVAR", 100}, {"S_KNUM", 1}, {"S_FA", 7}, {"S_TSA", 3}, {"S_MA", axis + 1.0}, {"S_MD", 1}});
      EXPECT_NEAR(bench.ovr(4), error[axis], 1e-9) << world;
    } else {
      bench.start({0, 0, 10});
      bench.run("CYCLE977",
                {{"S_MVAR", 102}, {"S_KNUM", 1}, {"S_SETV", 44.2}, {"S_FA", 5}, {"S_TSA", 3}, {"S_ID", -20}});
      EXPECT_NEAR(bench.ovr(4), 44, 1e-7) << world;
      EXPECT_NEAR(inWorkpiece(bench, part.translation()).head<2>().norm(), 0, 1e-7) << world;
    }
  }
}

TEST(ProbeKinds, AnLShapedProbePullsAgainstAnOverhang) {
  // A plate 20 mm thick over the probe's ball, which sits at the end of an arm of 30 mm.
  Planter plant(713);
  for (int world = 0; world < 10; ++world) {
    const double under = plant.number(-41, -39), reference = plant.number(-41, -39);
    simulation::Truth truth = perfectWorld();
    simulation::TrueTool& tool = truth.tools[0];
    tool.length = 150;
    tool.probe.stylusLength = 90;
    tool.probe.tipOffset = {30, 0};
    tool.probe.axialPretravel = plant.number(0, 0.02);
    place(truth, simulation::Box({10, -30, under}, {60, 30, -20}), translation({0, 0, table}));
    place(truth, simulation::Box({110, -30, reference}, {160, 30, -20}), translation({0, 0, table}));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    bench.set("$TC_DP1", {1, 1}, 713);
    bench.set("$TC_DP3", {1, 1}, 148);  // to the equator of the ball
    bench.set("$TC_DP6", {1, 1}, 30);
    bench.set("$TC_DP7", {1, 1}, 2);
    // Calibrated in the plane, it reaches 32 mm: along the tool the ball of the tool data counts.
    if (world % 2 == 1) bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 64);
    // The ball goes below the plate from the side: the arm reaches 30 mm in X.
    const auto below = [](double x) { return fmt::format("G0 Y-80\nSUPA G0 Z0 D0\nD1\nG0 X{} Y-80\nZ-60\nY0\n", x); };
    bench.run("CYCLE976",
              {{"S_MVAR", 1000}, {"S_SETV", reference}, {"S_MA", 3}, {"S_MD", 0}, {"S_FA", 8}, {"S_TSA", 4}}, {},
              below(100));
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_PLUS_DIR_AX3", {0}), 2 - tool.probe.axialPretravel, 1e-7);
    bench.run("CYCLE978",
              {{"S_MVAR", 100}, {"S_KNUM", 1}, {"S_SETV", -40}, {"S_FA", 8}, {"S_TSA", 4}, {"S_MA", 3}, {"S_MD", 1}},
              {}, below(0));
    EXPECT_NEAR(bench.ovr(4), under, 1e-7) << world;
    EXPECT_NEAR(inWorkpiece(bench, {30, 0, table + under}).z(), -40, 1e-7);
  }
}

/// A star: four balls of radius 1.5, their centres 10 from the middle.
void makeStar(simulation::Truth& truth) {
  simulation::TrueTool& tool = truth.tools[0];
  tool.probe.ballRadius = 1.5;
  tool.probe.starArm = 10;
  tool.probe.stylusRadius = 1;
  tool.length = 101.5;
}
void believeInStar(SinumerikBench& bench) {
  bench.set("$TC_DP1", {1, 1}, 714);
  bench.set("$TC_DP3", {1, 1}, 100);  // to the equator
  bench.set("$TC_DP6", {1, 1}, 11.5);
  bench.set("$TC_DP7", {1, 1}, 1.5);
}

TEST(ProbeKinds, AStarShapedProbeMeasuresAHoleAlongTheAxes) {
  Planter plant(714);
  for (int world = 0; world < 20; ++world) {
    const Vector3 error(plant.number(-0.5, 0.5), plant.number(-0.5, 0.5), 0);
    const double radius = plant.number(24, 27);
    simulation::Truth truth = perfectWorld();
    makeStar(truth);
    // Its middle runs out; each of its balls shows that in its own direction.
    const Vector2 aside(plant.number(-0.05, 0.05), plant.number(-0.05, 0.05));
    if (world % 2 == 1) truth.tools[0].probe.tipOffset = aside;
    const Vector3 ring(plant.number(-0.3, 0.3), plant.number(-0.3, 0.3), 0);
    place(truth, simulation::Ring(20, 45, -60), translation(Vector3(0, 0, table) + ring), "ring");
    place(truth, simulation::Ring(radius, 50, -60), translation(Vector3(150, 0, table) + error));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    believeInStar(bench);
    bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 0);
    bench.start({0, 0, -20});
    bench.run("CYCLE976", {{"S_MVAR", 2}, {"S_SETV", 40}, {"S_FA", 4}, {"S_TSA", 15}});
    EXPECT_NEAR(bench.ovr(6), ring.x(), 1e-6);
    EXPECT_NEAR(bench.ovr(7), ring.y(), 1e-6);
    EXPECT_NEAR(bench.data("$SNS_MEA_WP_BALL_DIAM", {0}), 23, 1e-6);
    if (world % 2 == 1) {
      EXPECT_NEAR(bench.data("$SNS_MEA_WP_POS_DEV_AX1", {0}), aside.x(), 1e-6);
    }
    bench.start({150, 0, -20});
    const std::size_t before = bench.machine.path().touches.size();
    bench.run("CYCLE977", {{"S_MVAR", 101}, {"S_KNUM", 1}, {"S_SETV", 2 * radius}, {"S_FA", 4}, {"S_TSA", 2}});
    // The record names the ball that touched, not the middle of the star. Where that runs out, so do its balls.
    const auto& touches = bench.control.journal.cycles.back().touches;
    ASSERT_EQ(touches.size(), bench.machine.path().touches.size() - before);
    for (std::size_t i = 0; i < touches.size(); ++i) {
      const Vector3 ball = bench.machine.path().touches[before + i].ballCentre - Vector3(0, 0, table);
      EXPECT_NEAR((touches[i].ballCentre - ball).dot(touches[i].direction), 0, 1e-6) << world << " " << i;
    }
    EXPECT_NEAR(bench.ovr(4), 2 * radius, 1e-6) << world;
    EXPECT_NEAR(bench.ovr(17), error.x(), 1e-6);
    EXPECT_NEAR(bench.ovr(18), error.y(), 1e-6);
  }
}

TEST(ProbeKinds, AStarHasNoBallForThePoleOfACalibrationBall) {
  simulation::Truth truth = perfectWorld();
  makeStar(truth);
  place(truth, simulation::SolidSphere(Vector3::Zero(), 15), translation({0, 0, table - 15}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  believeInStar(bench);
  bench.start({0, 0, 8});
  const execution::RunResult result =
      bench.tryRun("CYCLE976", {{"S_MVAR", 1000003}, {"S_SETV", 30}, {"S_SETV0", 0}, {"S_FA", 5}, {"S_TSA", 3}});
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_EQ(result.diagnostics.front().code, "61302") << format(result.diagnostics.front());
  EXPECT_NE(result.diagnostics.front().message.find("stylus"), std::string::npos) << result.diagnostics.front().message;
  EXPECT_EQ(bench.control.data.number("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}), 0) << "nothing is stored";
}

TEST(ProbeKinds, TheArmOfAnLGoesToPlusOfTheFirstAxis) {
  // The arm is mounted at any angle, which the correction angle tells; the workpiece system is turned, the spindle
  // stands anywhere.
  Planter plant(7131);
  for (int world = 0; world < 12; ++world) {
    const double mounted = plant.number(0, 359.9), turn = plant.number(-90, 90), error = plant.number(-1, 1);
    simulation::Truth truth = perfectWorld();
    simulation::TrueTool& tool = truth.tools[0];
    tool.length = 150;
    tool.probe.stylusLength = 90;
    tool.probe.tipOffset = (30 * probing::directionAt(-mounted)).inPlane();
    const Pose part = translation({0, 0, table}) * rotation(Vector3::UnitZ(), turn);
    place(truth, simulation::Box({60 + error, -40, -60}, {90, 40, 0}), part);
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table}, {0, 0, turn});
    bench.set("$TC_DP1", {1, 1}, 713);
    bench.set("$TC_DP3", {1, 1}, 148);
    bench.set("$TC_DP6", {1, 1}, 30);
    bench.set("$TC_DP7", {1, 1}, 2);
    bench.set("$TC_DP10", {1, 1}, mounted);
    bench.set("$SNS_MEA_WP_TRIG_PLUS_DIR_AX1", {0}, 32);
    bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {0}, 0);
    bench.start({0, 0, -10});
    const NamedNumbers call = {{"S_MVAR", 100}, {"S_KNUM", 1}, {"S_SETV", 60}, {"S_FA", 6}, {"S_TSA", 2}, {"S_MA", 1}};
    bench.run("CYCLE978", with(call, {{"S_MD", 1}}), {}, fmt::format("SPOS={:.3f}\n", plant.number(0, 359)));
    EXPECT_NEAR(bench.ovr(4), 60 + error, 1e-7) << world;
    const control::TouchRecord& record = bench.control.journal.cycles.back().touches.back();
    const Vector3 ball = part.inverse() * bench.machine.path().touches.back().ballCentre;
    EXPECT_NEAR((record.ballCentre - ball).norm(), 0, 1e-6) << "the ball is at the end of the arm";
    EXPECT_NEAR(inWorkpiece(bench, part * Vector3(60 + error, 0, 0)).x(), 60, 1e-7);
    EXPECT_EQ(bench.alarmOf("CYCLE978", with(call, {{"S_MD", 2}})), "61341") << "the arm is not calibrated that way";
  }
}

TEST(ProbeKinds, AStarPassesBetweenWhatOneWideBallWouldMeet) {
  // Four pins at 45 degrees stand in the hole where no arm of the star goes. Turned there, two balls at once meet the
  // wall beside the middle.
  for (const double angle : {0.0, 45.0}) {
    simulation::Truth truth = perfectWorld();
    makeStar(truth);
    place(truth, simulation::Ring(20, 45, -60), translation({0, 0, table}));
    for (int i = 0; i < 4; ++i)
      place(truth, simulation::RoundBar(1, -60, 0),
            translation(Vector3(0, 0, table) + 15.5 * probing::directionAt(45 + 90 * i).vector()), "pin");
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    believeInStar(bench);
    bench.set("$SNS_MEA_WP_BALL_DIAM", {0}, 23);
    for (const char* axis : {"1", "2"}) {
      bench.set((std::string("$SNS_MEA_WP_TRIG_PLUS_DIR_AX") + axis).c_str(), {0}, 11.5);
      bench.set((std::string("$SNS_MEA_WP_TRIG_MINUS_DIR_AX") + axis).c_str(), {0}, -11.5);
    }
    const execution::RunResult result =
        bench.tryRun("CYCLE977", {{"S_MVAR", 1}, {"S_SETV", 40}, {"S_FA", 4}, {"S_TSA", 2}}, {},
                     fmt::format("SPOS={}\nG0 X0 Y0\nZ-20\n", angle));
    if (angle == 0) {
      ASSERT_TRUE(result.diagnostics.empty()) << format(result.diagnostics.front());
      EXPECT_NEAR(bench.ovr(4), 40, 1e-7);
    } else {
      ASSERT_FALSE(result.diagnostics.empty());
      EXPECT_EQ(result.diagnostics.front().code, "61303");
    }
  }
}

TEST(ProbeKinds, ReversalNeedsNoCalibrationButTheBallOfTheToolData) {
  // Data set 5 is empty. The ball stands 0.3 beside the axis, and only the tool data know how large it is.
  Planter plant(716);
  const struct {
    const char* cycle;
    NamedNumbers call;
    Vector3 start;
  } cases[] = {
      {"CYCLE978", {{"S_MVAR", 10000}, {"S_MA", 1}, {"S_MD", 1}}, {188, 0, -10}},
      {"CYCLE977", {{"S_MVAR", 10001}, {"S_SETV", 40}}, {0, 0, -10}},
      {"CYCLE977", {{"S_MVAR", 10004}, {"S_SETV", 60}, {"S_MA", 1}, {"S_ID", -20}}, {230, 0, 10}},
      {"CYCLE979", {{"S_MVAR", 11001}, {"S_SETV", 40}, {"S_INCA", 90}}, {8, 0, -10}},
      {"CYCLE998", {{"S_MVAR", 110005}, {"S_MA", 201}, {"S_MD", 1}, {"S_ID", 30}}, {188, -15, -10}},
  };
  for (const auto& [cycle, call, start] : cases) {
    SCOPED_TRACE(fmt::format("{} {}", cycle, call.front().second));
    simulation::Truth truth = perfectWorld();
    truth.tools[0].probe.tipOffset = {0.02, -0.03};
    const double error = plant.number(-0.5, 0.5);
    place(truth, simulation::Ring(20, 45, -60), translation({error, 0, table}));
    place(truth, simulation::Box({200, -50, -60}, {260, 50, 0}), translation({error, 0, table}));
    SinumerikBench bench(truth);
    plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
    const NamedNumbers full = with({{"S_FA", 8}, {"S_TSA", 3}, {"S_PRNUM", 5}, {"S_SETV", 200}}, call);
    bench.start(start);
    bench.run(cycle, full);
    const bool edge = std::string_view(cycle) == "CYCLE978", angle = std::string_view(cycle) == "CYCLE998";
    const double size = edge ? 200 + error : angle ? 0 : call.front().second == 10004 ? 60 : 40;
    EXPECT_NEAR(bench.ovr(4), size, std::string_view(cycle) == "CYCLE979" ? 2e-3 : 3e-4);
    if (!edge && !angle) {
      EXPECT_NEAR(bench.ovr(5), call.front().second == 10004 ? 230 + error : error, 3e-4);
    }
    NamedNumbers standard = full;
    for (auto& [name, value] : standard)
      if (name == "S_MVAR") value -= 10000;
    bench.start(start);
    EXPECT_EQ(bench.alarmOf(cycle, standard), "61341");
    bench.set("$TC_DP6", {1, 1}, 0);
    bench.start(start);
    EXPECT_EQ(bench.alarmOf(cycle, full), "61351");
  }
}

TEST(ProbeKinds, ATurningProbeOnAMillKnowsItsBallByItsCentre) {
  simulation::Truth truth = perfectWorld();
  place(truth, simulation::Box({0, 0, -60}, {80, 80, 0}), translation({0.25, 0, table + 0.5}));
  SinumerikBench bench(truth);
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.set("$TC_DP1", {1, 1}, 580);
  bench.set("$TC_DP2", {1, 1}, 7);
  bench.set("$TC_DP3", {1, 1}, 98);
  bench.set("$SC_TOOL_LENGTH_TYPE", {}, 0);
  bench.set("$SNS_MEA_WP_TRIG_MINUS_DIR_AX3", {0}, -2);
  // Length 1 of a turning probe acts in the 2nd axis of the plane: of G19 that is Z.
  bench.plane = "G19";
  bench.start({30, 30, 20});
  bench.run("CYCLE978", {{"S_FA", 7}, {"S_TSA", 3}, {"S_MA", 2}, {"S_MD", 2}});
  EXPECT_NEAR(bench.ovr(4), 0.5, 1e-9);
}

}  // namespace
}  // namespace probewright

#include "cycles_heidenhain/across.hpp"
#include "machine/description.hpp"

/// Cycles 401, 402, 403 and 405 with other rotary axes than C and other touch probe axes than Z.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;

/// How the table has turned its workpiece in the course of the run.
Matrix3 tableTurn(const Bench& bench, const Ran& ran) {
  const auto& truth = bench.setup.world.truth;
  return machine::baseFromTable(truth.machine, ran.machine->position()).linear() *
         machine::baseFromTable(truth.machine, truth.start).linear().transpose();
}

const Words alongToolAxis = {{263, 0}, {264, -30}, {265, 0}, {266, 30}, {272, 3}, {267, -1}, {261, 0},
                             {320, 6}, {260, 20},  {301, 1}, {337, 0},  {305, 0}, {303, 1},  {380, 0}};

/// A block on the table of the five-axis machine, tilted by `lies` degrees about X.
Bench tiltedBlock(ControlKind kind, double lies) {
  Bench bench(kind, "mill5-table-table");
  bench.preset(1, {0, 0, -400});
  bench.believedProbe().maximumTravel = 40;
  bench.part(simulation::HalfSpace({Vector3(0, 0, -400), pose(Vector3::Zero(), {lies, 0, 0}).linear().col(2)}));
  return bench;
}

TEST(Cycle403, LevelsAFaceWithTheAAxis) {
  Dice dice(4031);
  for (int world = 0; world < 20; ++world) {
    SCOPED_TRACE(world);
    const ControlKind kind = controlOf(world);
    const double lies = dice.between(-8, 8);
    const bool swapped = dice.coin(), zero = dice.coin();
    const Bench bench = tiltedBlock(kind, lies);
    Words words = with(alongToolAxis, {{312, 4}, {337, zero ? 1 : 0}, {305, 6}});
    if (swapped) words = with(words, {{264, 30}, {266, -30}});
    const Ran ran = bench.run(probe(403, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(150), lies, exact);
    const Vector3 normal = tableTurn(bench, ran) * pose(Vector3::Zero(), {lies, 0, 0}).linear().col(2);
    EXPECT_NEAR(normal.y(), 0, 1e-8);
    EXPECT_NEAR(normal.z(), 1, 1e-8);
    if (!zero) continue;
    const bool newer = kind == ControlKind::TNC640;
    EXPECT_NEAR(ran.cell("PRESET.PR", newer ? "1" : "6", newer ? "A_OFFS" : "A"), ran.machine->position()[3], 6e-5);
  }
}

void expectRefused(const Ran& ran, const std::string& code, const std::string& part) {
  EXPECT_EQ(ran.alarm(), code) << ran.why();
  EXPECT_NE(ran.why().find(part), std::string::npos) << ran.why();
}

TEST(Cycle403, RefusesAxesThatDoNotFit) {
  const Bench newer = tiltedBlock(ControlKind::TNC640, 2), older = tiltedBlock(ControlKind::iTNC530, 2);
  // Found by the cycle: the first axis of the table from the workpiece, here C, which cannot level a face.
  expectRefused(newer.run(probe(403, with(alongToolAxis, {{312, 0}}))), "Rotary axis not permitted", "Axis C");
  expectRefused(older.run(probe(403, with(alongToolAxis, {{312, 0}}))), "Cycle parameter wrong", "Q312 = 0");
  for (const Bench& bench : {newer, older}) {
    expectRefused(bench.run(probe(403, with(alongToolAxis, {{312, 6}}))), "Rotary axis not permitted", "Axis C");
    expectRefused(bench.run(probe(403, with(alongToolAxis, {{312, 5}}))), "Rotary axis not available", "about Y");
    const Words alongX = with(alongToolAxis, {{263, -30}, {264, 0}, {265, 30}, {266, 0}});
    expectRefused(bench.run(probe(403, with(alongX, {{312, 4}}))), "Angle not determined", "A turns about");
    expectRefused(bench.run(probe(403, with(alongX, {{312, 5}}))), "Rotary axis not available", "about Y");
  }
  Bench plain;
  plain.preset(1, {0, 0, -400});
  expectRefused(plain.run(probe(403, with(alongToolAxis, {{312, 0}, {272, 1}}))), "Rotary axis not available",
                "no rotary table");
}

/// A horizontal probe along X: edges, holes and studs of the side face are aligned by the A axis.
TEST(ToolAxis, AlignsTheTableByTheAAxis) {
  Dice dice(4032);
  for (int at = 0; at < 24; ++at) {
    SCOPED_TRACE(at);
    Across world(controlOf(at), 'X', "mill5-table-table");
    const double skew = dice.between(-3, 3);
    const int cycle = 401 + at % 3;
    const bool upright = dice.coin();
    Words words = {{261, -9}, {260, 20}, {337, 0}, {305, 0}};
    if (cycle == 403) {
      world.part(simulation::Box({-40, -40, -30}, {40, 40, 0}), pose(Vector3::Zero(), {0, 0, skew}));
      words = with(words, {{320, 3}, {301, 1}, {272, upright ? 1 : 2}, {267, 1}, {312, 4}, {303, 1}, {380, 0}});
      words = with(words, upright ? Words{{263, -40}, {264, -30}, {265, -40}, {266, 30}}
                                  : Words{{263, -30}, {264, -40}, {265, 30}, {266, -40}});
    } else {
      for (const double side : {-40.0, 40.0}) {
        const Pose lying = pose(Vector3::Zero(), {0, 0, skew}) * pose({side, 0, 0});
        if (cycle == 401) {
          world.part(simulation::Ring(8, 14, -30), lying);
        } else {
          world.part(simulation::RoundBar(8, -30, 0), lying);
        }
      }
      words = with(words, {{268, -40}, {269, 0}, {270, 40}, {271, 0}, {307, 0}, {402, 1}});
      if (cycle == 402) words = with(words, {{313, 16.5}, {314, 16.5}, {315, -10}, {320, 1}, {301, 1}});
    }
    const Ran ran = world.run(probe(cycle, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Matrix3 axes = world.machineFromPlane().linear();
    const Matrix3 now =
        axes.transpose() * tableTurn(world.bench, ran) * axes * pose(Vector3::Zero(), {0, 0, skew}).linear();
    EXPECT_LT((now - Matrix3::Identity()).norm(), 1e-8);
    if (cycle == 403) {
      EXPECT_NEAR(ran.q(150), upright ? (skew > 0 ? skew - 90 : skew + 90) : skew, exact);
    }
  }
}

/// A horizontal hole felt along Y: the C axis brings the measured place to the positive Y axis, or to the direction of
/// the nominal place.
TEST(Cycle405, TurnsCUnderAHorizontalProbe) {
  Dice dice(4051);
  for (int at = 0; at < 20; ++at) {
    SCOPED_TRACE(at);
    Across world(controlOf(at), 'Y', "mill5-table-table");
    // The face lies 100 mm from the axis of C, which goes through the preset; the hole a little beside the Y axis.
    world.origin = {0, 0, -300};
    world.bench.setup.beliefs.presets.front().origin = world.origin;
    const double aside = dice.between(-3, 3), up = dice.between(-0.3, 0.3), drawn = dice.coin() ? 0 : 5;
    const Vector3 centre(up, drawn + aside, 100);
    world.part(simulation::Ring(12, 20, -30), pose(centre));
    const Ran ran = world.run(probe(
        405,
        {{321, 0}, {322, drawn}, {262, 14}, {325, 0}, {247, 90}, {261, 92}, {320, 0}, {260, 130}, {301, 0}, {337, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto direction = [](double x) { return degrees(std::atan2(92, x)); };
    const double offset = direction(drawn + aside) - (drawn == 0 ? 90 : direction(drawn));
    EXPECT_NEAR(ran.q(150), offset, exact);
    const Vector3 place = tableTurn(world.bench, ran) * Vector3(drawn + aside, 92, 0);
    EXPECT_NEAR(degrees(std::atan2(place.y(), place.x())), drawn == 0 ? 90 : direction(drawn), exact);
  }
}

}  // namespace
}  // namespace probewright::testing_support

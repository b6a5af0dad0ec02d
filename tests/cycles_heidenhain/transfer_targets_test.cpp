#include "cycles_heidenhain/table_folder.hpp"
#include "cycles_heidenhain/worlds.hpp"

/// Where presetting cycles leave their result, and in which coordinates the feature then reads what was wished.
namespace probewright::testing_support {
namespace {

constexpr double exact = 1e-6;
const Words hole = {{321, 0}, {322, 0},  {262, 40}, {325, 0}, {247, 90}, {261, -8},
                    {320, 0}, {260, 30}, {301, 1},  {331, 3}, {332, 1},  {381, 0}};

/// Row 0 is the preset set at once, whatever Q303 says and whether a datum table is selected.
TEST(Transfer, OfRow0SetsThePreset) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const bool selected : {false, true}) {
      Bench bench(kind);
      bench.preset(1, {10, 20, -400});
      bench.part(simulation::Ring(20, 35, -40), pose({10.5, 19.25, -400}));
      const TableFolder folder(bench);
      folder.put("ZERO.D", control::heidenhain::defaultDatumTable(kind, "ZERO.D"));
      const Ran ran =
          bench.run((selected ? "SEL TABLE \"ZERO.D\"\n" : "") + probe(412, with(hole, {{305, 0}, {303, 0}})));
      ASSERT_TRUE(ran.finished()) << ran.why();
      EXPECT_LT((ran.seen({10.5, 19.25, -400}) - Vector3(3, 1, 0)).norm(), exact);
      EXPECT_FALSE(ran.table("ZERO.D").hasRow("0") && ran.table("ZERO.D").numberOr("0", "X", 0) != 0);
    }
  }
}

/// Shift, mirror image and scaling that go on: the feature reads the wish in them.
TEST(Transfer, IntoTheActiveRowCountsInTransformedCoordinates) {
  struct Case {
    std::string before;
    Eigen::Affine3d preset;  ///< from the program's coordinates
  };
  Eigen::Affine3d shifted = Eigen::Affine3d::Identity(), mirrored = shifted, scaled = shifted;
  shifted.translation() = Vector3(5, -2, 0);
  mirrored.linear() = Vector3(-1, 1, 1).asDiagonal();
  scaled.linear() *= 0.8;
  for (const Case& one : {Case{"CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 X+5\nCYCL DEF 7.2 Y-2\n", shifted},
                          Case{"CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\n", mirrored},
                          Case{"CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0.8\n", scaled}}) {
    SCOPED_TRACE(one.before);
    Bench bench(ControlKind::iTNC530);
    const Pose preset = pose({10, 20, -400}, {0, 0, 15});
    bench.preset(1, {10, 20, -400}, 15);
    const Vector3 centre = preset * (one.preset * Vector3(0.4, -0.3, 0));
    bench.part(simulation::Ring(20 * one.preset.linear().col(1).norm(), 45, -40), pose(centre));
    const Ran ran = bench.run(one.before + probe(412, with(hole, {{305, 1}, {303, 1}})));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const Vector3 read = one.preset.inverse() * ran.seen(centre);
    EXPECT_NEAR(read.x(), 3, exact);
    EXPECT_NEAR(read.y(), 1, exact);
  }
}

/// A part turned about Z lies straight in the tilted plane after Q304 = 1: 420 then finds no angle.
TEST(Transfer, OfTheBasicRotationTurnsTheTiltedPlane) {
  Dice dice(4140);
  for (int at = 0; at < 12; ++at) {
    SCOPED_TRACE(fmt::format("world {}", at));
    Bench bench(ControlKind::TNC640, "mill5-head-table");
    bench.preset(1, {0, 0, -500}, written(dice.between(-20, 20)));
    bench.believedProbe().maximumTravel = 40;
    bench.believedProbe().setUpClearance = 8;
    const double a = written(dice.between(-20, 20)), b = written(dice.between(-20, 20));
    const double rotation = bench.setup.beliefs.presets.front().rotation.z();
    const Pose input = pose({0, 0, -500}, {0, 0, rotation}) * pose(Vector3::Zero(), {a, b, 0});
    const double skew = dice.between(-4, 4);
    bench.part(simulation::Box({-50, -40, -30}, {50, 40, 0}), input * pose(Vector3::Zero(), {0, 0, skew}));
    const std::string tilt =
        fmt::format("L Z+0 R0 FMAX M91\nPLANE SPATIAL SPA{:+.3f} SPB{:+.3f} SPC+0 TURN FMAX\n", a, b);
    const int row = dice.coin() ? 0 : 1;
    const Ran ran = bench.run(tilt +
                              probe(414, {{263, -30},
                                          {264, -40},
                                          {326, 50},
                                          {296, -50},
                                          {297, -20},
                                          {327, 40},
                                          {261, -8},
                                          {320, 1},
                                          {260, 30},
                                          {301, 1},
                                          {304, 1},
                                          {305, row},
                                          {331, -50},
                                          {332, -40},
                                          {303, 1},
                                          {381, 0}}) +
                              tilt +
                              probe(420, {{263, -30},
                                          {264, -40},
                                          {265, 30},
                                          {266, -40},
                                          {272, 2},
                                          {267, 1},
                                          {261, -8},
                                          {320, 1},
                                          {260, 30},
                                          {301, 1},
                                          {281, 0}}));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.q(150), 0, exact);
    const Matrix3 expected = input.linear() * pose(Vector3::Zero(), {0, 0, skew}).linear() *
                             pose(Vector3::Zero(), {a, b, 0}).linear().transpose();
    EXPECT_TRUE(ran.preset().linear().isApprox(expected, 1e-8));
  }
}

/// Values of GLOBAL DEF count in the unit of the program that they stand in.
TEST(GlobalDefinitions, KeepTheirUnitInOtherPrograms) {
  for (const bool inchMain : {false, true}) {
    Bench bench(ControlKind::TNC640);
    bench.preset(1, {0, 0, -400});
    bench.part(simulation::Box({-30, -30, -40}, {30, 30, 0}), pose({0, 0, -400}));
    const TableFolder folder(bench);
    bench.program = (bench.setup.beliefs.tables / "MAIN.H").string();
    const std::string unit = inchMain ? "MM" : "INCH";
    folder.put("SUB.H", "BEGIN PGM SUB " + unit +
                            "\nTCH PROBE 417 PRESET ~\n  Q263=+0 ~\n  Q264=+0 ~\n  Q294=+0 ~\n  Q320=PREDEF ~\n"
                            "  Q260=PREDEF ~\n  Q305=1 ~\n  Q333=+0 ~\n  Q303=1\nEND PGM SUB " +
                            unit + "\n");
    const double perUnit = inchMain ? 25.4 : 1;
    const Ran ran =
        bench.run(fmt::format("L Z+{:.6f} R0 FMAX\nGLOBAL DEF 120 PROBING ~\n  Q320={:+.8f} ~\n  Q260={:+.8f} ~\n"
                              "  Q301=1\nCALL PGM SUB.H\n",
                              10 / perUnit, 2.54 / perUnit, 50.8 / perUnit),
                  inchMain ? "INCH" : "MM");
    ASSERT_TRUE(ran.finished()) << ran.why();
    // The probe ends at the clearance height and touched from SET_UP + Q320 above.
    EXPECT_NEAR(ran.machine->position()[2], -400 + 50.8 + bench.setup.beliefs.tools.front().length, 1e-5);
  }
}

}  // namespace
}  // namespace probewright::testing_support

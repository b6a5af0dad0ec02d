#include "support/lathe_bench.hpp"

/// Calls of the turning cycles whose parameters are global user data.
namespace probewright {
namespace {

using namespace testing_support;

TEST(TurningOldForm, MeasuresFaceAndDiametersAsTheCallWithArguments) {
  Planter plant(611);
  for (int world = 0; world < 24; ++world) {
    const int feature = world % 3;  // face, inside, outside
    LatheProbe probe;
    probe.position = feature == 2 ? 8 : 7;
    if (feature == 1) probe.mount = {-50, 0, 0};
    setup::Setup setup = latheSetup(probe);
    const double face = 150, error = plant.number(-0.8, 0.8), radius = 40 + plant.number(-0.5, 0.5);
    if (feature == 1) {
      place(setup.world.truth, simulation::Ring(radius, radius + 15, -face), translation({0, 0, face}));
    } else {
      place(setup.world.truth, simulation::RoundBar(radius, -face, 0), translation({0, 0, face}));
    }
    const std::string way = feature == 0   ? "G0 X40\nG0 Z8\n"
                            : feature == 1 ? "G0 X60\nG0 Z20\nG0 Z-12\n"
                                           : "G0 X100\nG0 Z-12\n";
    const double set = feature == 0 ? error + plant.number(-1, 1) : 80;
    const int axis = feature == 0 ? 1 : 2;
    const auto measured = [&](const std::string& call) {
      LatheBench bench(setup);
      plantFrame(bench, "$P_UIFR", 1, 0, face - error);
      bench.run("DIAMON\n" + way + call);
      return std::pair(bench.ovr(4), bench.data("$P_UIFR", {1, "Z", "FI"}));
    };
    const int zero = feature == 0 ? 100 : 0;
    const auto today = measured(fmt::format("CYCLE974({},1,,1,{:.12f},{},7,4)", zero + feature, set, axis));
    const auto before = measured(fmt::format("_MVAR={} _KNUM={} _SETVAL={:.12f} _MA={} _FA=7 _TSA=4\nCYCLE974", zero,
                                             feature == 0 ? 1 : 0, set, axis));
    EXPECT_EQ(today, before) << world;
    EXPECT_NEAR(before.first, feature == 0 ? error : 2 * radius, 1e-7) << world;
  }
}

TEST(TurningOldForm, CalibratesOnASurface) {
  LatheProbe probe;
  probe.position = 7;
  probe.axialPretravel = 0.012;
  setup::Setup setup = latheSetup(probe);
  place(setup.world.truth, simulation::RoundBar(30, -100, 0), translation({0, 0, 200}));
  LatheBench bench(setup);
  plantFrame(bench, "$P_UIFR", 1, 0, 190);
  bench.run("G0 X20\nG0 Z20\n_MVAR=0 _PRNUM=2 _SETVAL=10 _MA=1 _MD=1 _FA=5 _TSA=4\nCYCLE973");
  EXPECT_NEAR(bench.data("$SNS_MEA_WP_TRIG_MINUS_DIR_AX1", {1}), -(probe.ballRadius - 0.012), 1e-8);
}

TEST(TurningOldForm, MeasuresADiameterByTwoPoints) {
  Planter plant(612);
  for (int world = 0; world < 48; ++world) {
    SCOPED_TRACE(world);
    const bool outside = world % 2 == 0, diameters = world % 3 != 0, core = !outside && world % 4 == 1;
    LatheProbe probe;
    probe.position = 7;
    probe.mount = {-80, 0, 0};
    setup::Setup setup = latheSetup(probe);
    const double radius = (outside ? 20 : 33) + plant.number(-0.5, 0.5), face = 200, depth = plant.number(3, 12);
    if (outside) {
      place(setup.world.truth, simulation::RoundBar(radius, -100, 0), translation({0, 0, face}));
    } else {
      place(setup.world.truth, simulation::Ring(radius, 50, -100), translation({0, 0, face}));
      // The core ends a little beyond the face: straight through the centre the stylus would meet it.
      if (core) place(setup.world.truth, simulation::RoundBar(10, -100, 4), translation({0, 0, face}), "core");
    }
    const double count = diameters ? 2 : 1, set = count * (outside ? 20 : 33), start = count * (outside ? 40 : 23);
    LatheBench bench(setup);
    plantFrame(bench, "$P_UIFR", 1, 0, face);
    // X is measured, so X has the zone, and Z the way past it.
    bench.run(
        fmt::format("{}\nG0 X{}\nG0 Z20\nG0 Z{}\n_MVAR={} _SETVAL={} _MA=2 _SZA={} _SZO={} _FA=3 _TSA=2\nCYCLE994",
                    diameters ? "DIAMON" : "DIAMOF", start, -depth, core || world % 5 == 0 ? 1 : 2, set,
                    outside || core ? depth + 8 : 0,
                    outside ? count * 34
                    : core  ? count * 13
                            : 0));
    EXPECT_NEAR(bench.ovr(4), count * radius, 1e-8);
    EXPECT_NEAR(bench.ovr(16), count * radius - set, 1e-8);
    EXPECT_EQ(bench.ovi(2), 994);
    EXPECT_EQ(bench.ovi(3), (outside ? 2 : 1) + (outside || core ? 1000 : 0));
  }
}

TEST(TurningOldForm, CalibratesInAGroove) {
  Planter plant(613);
  for (int world = 0; world < 24; ++world) {
    SCOPED_TRACE(world);
    LatheProbe probe;
    probe.position = 8;  // reaches down into a groove that is open to +X, between walls along Z
    probe.pretravel = plant.number(0, 0.02);
    probe.axialPretravel = plant.number(0, 0.02);
    setup::Setup setup = latheSetup(probe);
    const double base = plant.number(80, 120), upper = base + 12, minus = plant.number(250, 350), plus = minus + 20;
    place(setup.world.truth, simulation::Box({base - 10, -20, minus - 10}, {base, 20, plus + 10}));
    place(setup.world.truth, simulation::Box({base, -20, minus - 10}, {upper, 20, minus}));
    place(setup.world.truth, simulation::Box({base, -20, plus}, {upper, 20, plus + 10}));
    const double radius = probe.ballRadius - probe.pretravel;
    enum { Base, PlusWall, MinusWall, Walls, WallsWithDeviation };
    for (const int task : {Base, PlusWall, MinusWall, Walls, WallsWithDeviation}) {
      LatheBench bench(setup);
      plantFrame(bench, "$P_UIFR", 1, 0, 60);
      bench.set("$SNS_MEA_CAL_EDGE_BASE_AX2", {1}, base);
      bench.set("$SNS_MEA_CAL_EDGE_UPPER_AX2", {1}, upper);
      bench.set("$SNS_MEA_CAL_EDGE_PLUS_DIR_AX1", {1}, plus);
      bench.set("$SNS_MEA_CAL_EDGE_MINUS_DIR_AX1", {1}, minus);
      // What the tool data are wrong by across the stylus is the ball's deviation to the cycle.
      const double wrong = task >= Walls ? plant.number(-0.3, 0.3) : 0;
      bench.set("$TC_DP4", {1, 1}, bench.data("$TC_DP4", {1, 1}) + wrong);
      constexpr const char* variants[] = {"_MVAR=13 _MA=2 _MD=1", "_MVAR=1013 _MA=1 _MD=0", "_MVAR=13 _MA=1 _MD=1",
                                          "_MVAR=2013 _MA=1", "_MVAR=12013 _MA=1"};
      bench.run(fmt::format("DIAMON\nG0 X{:.6f} Z{:.6f}\n{} _CALNUM=2 _PRNUM=3 _FA=3 _TSA=4\nCYCLE973",
                            2 * (upper + 20), (plus + minus) / 2 + 2 - 60, variants[task]));
      const auto trigger = [&](const char* way, int axis) {
        return bench.data(fmt::format("$SNS_MEA_WP_TRIG_{}_DIR_AX{}", way, axis), {2});
      };
      const double skew = task == WallsWithDeviation ? wrong : 0;
      EXPECT_NEAR(trigger("MINUS", 2), task == Base ? -(probe.ballRadius - probe.axialPretravel) : 0, 1e-8);
      EXPECT_NEAR(trigger("PLUS", 1), task == Base || task == MinusWall ? 0 : radius + skew, 1e-8);
      EXPECT_NEAR(trigger("MINUS", 1), task == Base || task == PlusWall ? 0 : -radius + skew, 1e-8);
      EXPECT_NEAR(bench.data("$SNS_MEA_WP_POS_DEV_AX1", {2}), skew, 1e-8);
    }
  }
}

}  // namespace
}  // namespace probewright

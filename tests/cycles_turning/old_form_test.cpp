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

}  // namespace
}  // namespace probewright

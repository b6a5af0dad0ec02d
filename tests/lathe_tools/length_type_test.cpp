#include "simulation/analytic_solids.hpp"
#include "support/sinumerik_bench.hpp"

/// SD 42950 $SC_TOOL_LENGTH_TYPE = 2: the lengths of mills and probes act as
/// those of turning tools, length 3 in the 3rd axis of the plane. Corrections
/// go to the length that acts where was measured.
namespace probewright {
namespace {

using namespace testing_support;

constexpr double table = -350;

simulation::Truth aboveASurface(double probeLength) {
  simulation::Truth truth = perfectWorld();
  truth.tools[0].length = probeLength;
  place(truth, simulation::Box({-50, -50, -40}, {50, 50, 0}), translation({0, 0, table}));
  return truth;
}

/// The probe has its length where it acts.
void actAsTurningTools(SinumerikBench& bench) {
  plantFrame(bench, "$P_UIFR", 1, {0, 0, table});
  bench.set("$SC_TOOL_LENGTH_TYPE", {}, 2);
  bench.set("$TC_DP3", {1, 1}, 0);
  bench.set("$TC_DP5", {1, 1}, 100);
}

TEST(LengthType, ACalibratedProbeIsCorrectedInTheLengthThatActsAlongIt) {
  SinumerikBench bench(aboveASurface(100.35));
  actAsTurningTools(bench);
  bench.start({0, 0, 12});
  bench.run("CYCLE976", {{"S_MVAR", 1001000}, {"S_SETV", 0}, {"S_MA", 3}, {"S_MD", 1}, {"S_FA", 10}, {"S_TSA", 3}});
  EXPECT_NEAR(bench.data("$TC_DP5", {1, 1}), 100.35, 1e-9);
  EXPECT_EQ(bench.data("$TC_DP3", {1, 1}), 0);
}

TEST(LengthType, AMillIsCorrectedInTheLengthThatActsAcrossTheSurface) {
  SinumerikBench bench(aboveASurface(100));
  actAsTurningTools(bench);
  bench.set("$TC_TP2", {7}, 0);
  bench.control.data.set("$TC_TP2", {7}, std::string("MILL"));
  bench.set("$TC_DP1", {7, 1}, 120);
  bench.set("$TC_DP5", {7, 1}, 70);
  bench.set("$TC_DP6", {7, 1}, 5);
  bench.start({0, 0, 12});
  // The surface lies 0.2 above its set value: the mill that made it is shorter
  // than its data say.
  bench.run("CYCLE978",
            {{"S_MVAR", 200},
             {"S_KNUM1", 1},
             {"S_SETV", -0.2},
             {"S_FA", 10},
             {"S_TSA", 1},
             {"S_TDIF", 0.5},
             {"S_MA", 3},
             {"S_MD", 2}},
            {{"S_TNAME", "MILL"}});
  EXPECT_NEAR(bench.data("$TC_DP14", {7, 1}), -0.2, 1e-9);
  EXPECT_EQ(bench.data("$TC_DP12", {7, 1}), 0);
}

}  // namespace
}  // namespace probewright

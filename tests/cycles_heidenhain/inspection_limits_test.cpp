#include <regex>

#include "cycles_heidenhain/worlds.hpp"

/// Limits of which one is left at 0, and angles in logs of inch programs.
namespace probewright::testing_support {
namespace {

constexpr ControlKind kinds[] = {ControlKind::TNC640, ControlKind::iTNC530};

TEST(InspectionLimits, OfZeroDoNotMonitorTheirSide) {
  struct Case {
    double largest, smallest;
    int status;  ///< 180 good, 181 rework, 182 scrap
  };
  for (const ControlKind kind : kinds) {
    Bench bench(kind);
    bench.preset(1, {0, 0, -400});
    bench.part(simulation::Ring(20.015, 35, -40), pose({0, 0, -400}));
    for (const Case& one : {Case{0, 40, 180}, Case{0, 40.1, 181}, Case{40.1, 0, 180}, Case{40, 0, 182}, Case{0, 0, 180},
                            Case{40.05, 40, 180}}) {
      SCOPED_TRACE(fmt::format("{}: {} to {}", control::name(kind), one.smallest, one.largest));
      const Ran ran = bench.run(probe(421, {{273, 0},
                                            {274, 0},
                                            {262, 40},
                                            {325, 0},
                                            {247, 90},
                                            {261, -8},
                                            {320, 0},
                                            {260, 20},
                                            {301, 0},
                                            {275, one.largest},
                                            {276, one.smallest},
                                            {279, 0},
                                            {280, 0},
                                            {281, 1},
                                            {309, 0},
                                            {330, 0}}));
      ASSERT_TRUE(ran.finished()) << ran.why();
      for (const int status : {180, 181, 182})
        EXPECT_EQ(ran.q(status), status == one.status ? 1 : 0) << status;
      const std::string log = ran.log("TCHPR421.TXT");
      EXPECT_EQ(log.find("Maximum dimension") != std::string::npos, one.largest != 0) << log;
      EXPECT_EQ(log.find("Minimum dimension") != std::string::npos, one.smallest != 0) << log;
    }
  }
}

/// A coordinate may be limited by 0: only two zeros switch 427 off.
TEST(InspectionLimits, OfACoordinateMayBeZero) {
  Bench bench;
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::Box({-30, -30, -40}, {30, 30, 0.02}), pose({0, 0, -400}));
  const Words words = {{263, 0},  {264, 0}, {261, 0},    {320, 0}, {272, 3}, {267, -1},
                       {260, 20}, {281, 0}, {289, -0.1}, {309, 0}, {330, 0}};
  const Ran limited = bench.run(probe(427, with(words, {{288, 0}})));
  ASSERT_TRUE(limited.finished()) << limited.why();
  EXPECT_EQ(limited.q(181), 1) << "0.02 lies above 0";
  const Ran off = bench.run(probe(427, with(words, {{288, 0}, {289, 0}})));
  EXPECT_EQ(off.q(180), 1);
}

TEST(InspectionLimits, AnglesOfInchLogsHaveFourDecimals) {
  for (const ControlKind kind : kinds) {
    Bench bench(kind);
    bench.preset(1, {0, 0, -400});
    bench.part(simulation::Box({-60, 0, -40}, {60, 40, 0}), pose({0, 0, -400}, {0, 0, 1.23456}));
    const Ran ran = bench.run(probe(420, {{263, -1},
                                          {264, 0},
                                          {265, 1},
                                          {266, 0},
                                          {272, 2},
                                          {267, 1},
                                          {261, -0.3},
                                          {320, 0.1},
                                          {260, 1},
                                          {301, 1},
                                          {281, 1}}),
                              "INCH");
    ASSERT_TRUE(ran.finished()) << ran.why();
    const std::string log = ran.log("TCHPR420.TXT");
    EXPECT_TRUE(std::regex_search(log, std::regex("Measured angle: +1\\.2346\n"))) << log;
    EXPECT_TRUE(std::regex_search(log, std::regex("Measuring height: +-0\\.30000\n"))) << log;
  }
}

}  // namespace
}  // namespace probewright::testing_support

#include <gmock/gmock.h>

#include "cycles_heidenhain/worlds.hpp"

/// What cycles 1410, 1411 and 1420 write into TCHPRAUTO.html and show where a tolerance is exceeded. The limits of fits
/// and general tolerances are those of ISO 286-2 and ISO 2768-1.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double exact = 1e-6;

/// A hole of 20.03 mm at X-30 and a stud of 20.005 mm at X30.004.
Bench holeAndStud() {
  Bench bench;
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::Ring(10.015, 16, -40), pose({-30, 0, -400}));
  bench.part(simulation::RoundBar(10.0025, -40, 0), pose({30.004, 0, -400}));
  return bench;
}

/// 1411 on both; the diameters as texts.
std::string circles(const std::string& first, const std::string& second, int reaction = 0) {
  return probe(1411,
               {{1100, -30},
                {1101, 0},
                {1102, -8},
                {1103, 30},
                {1104, 0},
                {1105, -8},
                {1115, 2},
                {423, 4},
                {325, 0},
                {1119, 360},
                {320, 0},
                {260, 20},
                {1125, 1},
                {309, reaction},
                {1126, 0},
                {1120, 0},
                {1121, 0}},
               " ~\n  QS1116=\"" + first + "\" ;D ~\n  QS1117=\"" + second + "\" ;D");
}

TEST(RotationLogs, ShowEveryValueWithItsLimits) {
  const Ran ran = holeAndStud().run(circles("20H7", "20h6"));
  ASSERT_TRUE(ran.finished()) << ran.why();
  const std::string log = ran.log("TCHPRAUTO.html");
  for (const char* row :
       {"<h2>1411 PROBING TWO CIRCLES</h2>",
        "<th>Nominal</th><th>Lower limit</th><th>Upper limit</th><th>Actual</th><th>Deviation</th><th>Status</th>",
        "<td>Position 1, main axis</td><td>-30.0000</td><td></td><td></td><td>-30.0000</td><td>0.0000</td><td></td>",
        "<td>Position 2, main axis</td><td>30.0000</td><td></td><td></td><td>30.0040</td><td>0.0040</td><td></td>",
        // H7: 0 to +21 micrometres, h6: -13 to 0; deviations count from the middle.
        "<td>Diameter 1</td><td>20.0000</td><td>20.0000</td><td>20.0210</td><td>20.0300</td><td>0.0195</td>"
        "<td style=\"color:red\">scrap</td>",
        "<td>Diameter 2</td><td>20.0000</td><td>19.9870</td><td>20.0000</td><td>20.0050</td><td>0.0115</td>"
        "<td style=\"color:orange\">rework</td>",
        "<td>Measured angle</td>", "<td>Deviation of the angle</td>"}) {
    EXPECT_THAT(log, HasSubstr(row));
  }
  EXPECT_NEAR(ran.q(996), 20.03 - 20.0105, exact);
  EXPECT_NEAR(ran.q(997), 20.005 - 19.9935, exact);
  EXPECT_EQ(ran.q(183), 2);
}

TEST(RotationLogs, KnowGeneralTolerancesAndGoodParts) {
  // Medium: 0.2 mm for sizes above 6 up to 30 mm; fine: 0.1 mm.
  const Ran ran = holeAndStud().run(circles("20m", "20.05f"));
  ASSERT_TRUE(ran.finished()) << ran.why();
  const std::string log = ran.log("TCHPRAUTO.html");
  EXPECT_THAT(log, HasSubstr("<td>20.0000</td><td>19.8000</td><td>20.2000</td><td>20.0300</td><td>0.0300</td>"
                             "<td style=\"color:green\">good</td>"));
  EXPECT_THAT(log, HasSubstr("<td>20.0500</td><td>19.9500</td><td>20.1500</td><td>20.0050</td><td>-0.0450</td>"
                             "<td style=\"color:green\">good</td>"));
  EXPECT_EQ(ran.q(183), 0);
}

TEST(RotationLogs, GrowByASectionACallInTheLanguageOfTheControl) {
  Bench bench = holeAndStud();
  bench.language = control::DialogLanguage::Swedish;
  const std::string block = circles("20H7", "20h6");
  const Ran ran = bench.run(block + block);
  ASSERT_TRUE(ran.finished()) << ran.why();
  const std::string log = ran.log("TCHPRAUTO.html");
  const std::string heading = "<h2>1411 AVKAENNING TVAA CIRKLAR</h2>";
  ASSERT_THAT(log, HasSubstr(heading));
  EXPECT_NE(log.find(heading, log.find(heading) + 1), std::string::npos);
  EXPECT_EQ(log.find("</html>"), log.rfind("</html>"));
  EXPECT_THAT(log, HasSubstr("<td style=\"color:red\">skrot</td>"));
  EXPECT_THAT(log, HasSubstr("Position 2, huvudaxel"));
  EXPECT_THAT(log, Not(HasSubstr("scrap")));
}

TEST(RotationLogs, HaveTheAnglesOfEdgesAndPlanes) {
  Bench bench;
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::Box({-50, -50, -40}, {50, 50, 0}), pose({0, 0, -400}, {0, 0, 1.5}));
  const Words common = {{320, 4}, {260, 20}, {1125, 1}, {309, 0}, {1126, 0}, {1120, 0}, {1121, 0}};
  const Ran edge = bench.run(
      probe(1410, with(common, {{1100, -30}, {1101, -50}, {1102, -8}, {1103, 30}, {1104, -50}, {1105, -8}, {372, 2}})));
  ASSERT_TRUE(edge.finished()) << edge.why();
  for (const char* row : {"<td>Measured angle</td><td></td><td></td><td></td><td>1.5000</td>",
                          "<td>Measured angle of the rotary table</td><td></td><td></td><td></td><td>1.5000</td>",
                          "<td>Deviation of the angle</td><td></td><td></td><td></td><td>1.5000</td>"}) {
    EXPECT_THAT(edge.log("TCHPRAUTO.html"), HasSubstr(row));
  }
  const Ran plane = bench.run(probe(1420, with(common, {{1100, -30},
                                                        {1101, -30},
                                                        {1102, 0},
                                                        {1103, 30},
                                                        {1104, -30},
                                                        {1105, 0},
                                                        {1106, 0},
                                                        {1107, 30},
                                                        {1108, 0},
                                                        {372, -3}})));
  ASSERT_TRUE(plane.finished()) << plane.why();
  for (const char* name : {"SPA", "SPB", "SPC"}) {
    EXPECT_THAT(
        plane.log("TCHPRAUTO.html"),
        HasSubstr(fmt::format("<td>Measured space angle {}</td><td></td><td></td><td></td><td>0.0000</td>", name)));
  }
}

/// Q309 = 1 stops at rework and scrap, 2 at scrap only; the dialog shows all dimensions with their nominal values.
TEST(RotationLogs, ShowAllDimensionsWhereAToleranceIsExceeded) {
  struct Row {
    const char* first;
    const char* second;
    int reaction;
    const char* shown;  ///< empty: nothing
  };
  const Row rows[] = {{"20H7", "20h6", 1, "Tolerance exceeded: scrap"},
                      {"20H7", "20h6", 2, "Tolerance exceeded: scrap"},
                      {"20H7", "20h6", 0, ""},
                      {"20m", "20h6", 1, "Tolerance exceeded: rework"},
                      {"20m", "20h6", 2, ""},
                      {"20m", "20m", 1, ""}};
  for (const Row& row : rows) {
    SCOPED_TRACE(fmt::format("{}, {}, Q309 {}", row.first, row.second, row.reaction));
    const Ran ran = holeAndStud().run(circles(row.first, row.second, row.reaction));
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto screens = ran.screens();
    ASSERT_EQ(screens.size(), *row.shown == 0 ? 0U : 1U);
    if (screens.empty()) continue;
    EXPECT_THAT(screens.front(), HasSubstr(row.shown));
    EXPECT_THAT(screens.front(), HasSubstr("Position 1, main axis: nominal -30.0000, actual -30.0000"));
    EXPECT_THAT(screens.front(), HasSubstr("Position 2, main axis: nominal 30.0000, actual 30.0040"));
    EXPECT_THAT(screens.front(), HasSubstr("Diameter 1: nominal 20.0000, actual 20.0300"));
    EXPECT_THAT(screens.front(), HasSubstr("Diameter 2: nominal 20.0000, actual 20.0050, rework"));
  }
}

}  // namespace
}  // namespace probewright::testing_support

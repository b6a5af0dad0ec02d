#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/number_text.hpp"
#include "klartext/expectations.hpp"
#include "klartext/host_world.hpp"

namespace probewright::language::klartext::testing {
namespace {

using ::testing::HasSubstr;

TEST(Host, FormulasFollowTheirArithmetic) {
  World world;
  expectFinished(
      world.run("Q1 = 5 * 3 + 2 * 10\nQ2 = SQ 10 - 3^3\nQ3 = SIN 30 + COS (60) * 2\nQ4 = 400 % 360\n"
                "Q5 = (Q1 + Q2) / -4\nQ6 = SQRT 2 * SQRT 2\nQ7 = NEG Q1 + ABS -3 + INT 2.7 + FRAC 2.25\n"
                "FN 13: Q8 = +25 ANG +50\nFN 13: Q9 = -1 ANG -1\nFN 8: Q10 = +3 LEN +4\nQ11 = PI\n"
                "Q12 = -2 ^ 2\nQ16 = 2 ^ 3 ^ 2\nQ20 = 3\nQ17 = -Q20 ^ 2 * 2\nQ18 = 2 ^ -1 - 3 ^ 2\nQ13 = LN EXP 2\nQ14 "
                "= SGN -5\nQL1 = 7\nQR1 = QL1 * 2\nQ15 = QR1"));
  EXPECT_DOUBLE_EQ(world.q(1), 35);
  EXPECT_DOUBLE_EQ(world.q(2), 73);
  EXPECT_DOUBLE_EQ(world.q(3), 1.5);
  EXPECT_DOUBLE_EQ(world.q(4), 40);
  EXPECT_DOUBLE_EQ(world.q(5), -27);
  EXPECT_DOUBLE_EQ(world.q(6), std::sqrt(2.0) * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(world.q(7), -35 + 3 + 2 + 0.25);
  EXPECT_NEAR(world.q(8), 26.565051177078, 1e-12);
  EXPECT_DOUBLE_EQ(world.q(9), 225);
  EXPECT_DOUBLE_EQ(world.q(10), 5);
  EXPECT_DOUBLE_EQ(world.q(11), std::numbers::pi);
  EXPECT_DOUBLE_EQ(world.q(12), 4);
  EXPECT_DOUBLE_EQ(world.q(16), 512);
  EXPECT_DOUBLE_EQ(world.q(17), 18);
  EXPECT_DOUBLE_EQ(world.q(18), -8.5);
  EXPECT_DOUBLE_EQ(world.q(13), 2);
  EXPECT_DOUBLE_EQ(world.q(14), -1);
  EXPECT_DOUBLE_EQ(world.q(15), 14);
}

/// Random formulas, written and computed side by side.
struct RandomFormula {
  std::mt19937_64 random{7};
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); }
  std::pair<std::string, double> number() {
    const double value = std::round(std::uniform_real_distribution<double>(0.1, 9)(random) * 100) / 100;
    return {formatFixed(value, 2), value};
  }
  std::pair<std::string, double> sum(int depth) {
    auto [text, value] = product(depth);
    for (int i = pick(3); i > 0; --i) {
      const auto [t, v] = product(depth);
      const bool plus = pick(2) == 0;
      text += (plus ? " + " : "-") + t;
      value = plus ? value + v : value - v;
    }
    return {text, value};
  }
  std::pair<std::string, double> product(int depth) {
    auto [text, value] = primary(depth);
    for (int i = pick(3); i > 0; --i) {
      const auto [t, v] = primary(depth);
      const bool times = pick(2) == 0 || v == 0;
      text += (times ? "*" : " / ") + t;
      value = times ? value * v : value / v;
    }
    return {text, value};
  }
  std::pair<std::string, double> primary(int depth) {
    const int kind = depth <= 0 ? 0 : pick(5);
    if (kind == 0) return number();
    const auto [text, value] = sum(depth - 1);
    const std::string inner = "( " + text + " )";
    switch (kind) {
      case 1:
        return {inner, value};
      case 2:
        return {"SQ " + inner, value * value};
      case 3:
        return {"ABS" + inner, std::abs(value)};
      default:
        return {"SQRT ABS " + inner, std::sqrt(std::abs(value))};
    }
  }
};

TEST(Host, RandomFormulasEqualTheirCppArithmetic) {
  World world;
  RandomFormula formulas;
  for (int i = 0; i < 500; ++i) {
    const auto [text, expected] = formulas.sum(4);
    expectFinished(world.run("Q1 = " + text));
    EXPECT_NEAR(world.q(1), expected, 1e-12 * std::max(1.0, std::abs(expected))) << text;
  }
}

TEST(Host, StringFunctions) {
  World world;
  expectFinished(
      world.run("QS1 = \"PART-\" || \"17.5 MM\"\nQ1 = STRLEN( SRC_QS1 )\nQS2 = SUBSTR( SRC_QS1 BEG5 LEN4 )\n"
                "Q2 = TONUMB( SRC_QS2 )\nQ3 = INSTR( SRC_QS1 SEA_QS2 BEG0 )\nQS3 = TOCHAR( DAT+Q2 DECIMALS3 )\n"
                "Q4 = STRCOMP( SRC_QS2 SEA_QS3 )\nFN 10: IF Q2 NE +17.5 GOTO LBL 9\nQ5 = 1\nLBL 9"));
  EXPECT_EQ(world.q(1), 12);
  EXPECT_EQ(world.control->q.qs(2), "17.5");
  EXPECT_EQ(world.q(2), 17.5);
  EXPECT_EQ(world.q(3), 5);
  EXPECT_EQ(world.control->q.qs(3), "17.500");
  EXPECT_EQ(world.q(4), -1);
  EXPECT_EQ(world.q(5), 1);
}

TEST(Host, JumpsSubprogramsAndRepeats) {
  World world;
  world.library.texts["SUB.H"] = "0 BEGIN PGM SUB MM\n1 Q3 = Q3 + 100\n2 QL1 = 5\n3 END PGM SUB MM\n";
  expectFinished(
      world.run("QL1 = 1\nLBL 1\nQ1 = Q1 + 1\nCALL LBL 1 REP4\nCALL LBL \"S\"\nCALL PGM SUB.H\nQ4 = QL1\n"
                "SEL PGM \"SUB.H\"\nCALL SELECTED PGM\nSTOP\nM30\nLBL \"S\"\nQ2 = 7\nLBL 0\n"));
  EXPECT_EQ(world.q(1), 5);
  EXPECT_EQ(world.q(2), 7);
  EXPECT_EQ(world.q(3), 200);
  EXPECT_EQ(world.q(4), 1);
}

TEST(Host, StraightMovesWithToolLengthAndPreset) {
  World world;
  ASSERT_TRUE(world.control->tables.presets.setNumber("1", "X", 10));
  ASSERT_TRUE(world.control->tables.presets.setNumber("1", "Z", -200));
  expectFinished(
      world.run("CYCL DEF 247 PRESET ~\n Q339=1\nTOOL CALL 1 Z DL+0.5\nL X+5 Y+6 Z+7 F500\nL IX-1 FMAX\n"
                "CYCL DEF 7.0 SHIFT\nCYCL DEF 7.1 X+100\nL X+0\nL Z+0 FMAX M91"));
  const auto& steps = world.machine->steps;
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_NEAR(steps[0].axes[0], 15, 1e-12);
  EXPECT_NEAR(steps[0].axes[1], 6, 1e-12);
  EXPECT_NEAR(steps[0].axes[2], -200 + 7 + 100.5, 1e-12);
  EXPECT_EQ(steps[0].feed.perMinute, 500);
  EXPECT_NEAR(steps[1].axes[0], 14, 1e-12);
  EXPECT_TRUE(steps[1].feed.rapid);
  EXPECT_NEAR(steps[2].axes[0], 110, 1e-12);
  EXPECT_EQ(steps[2].feed.perMinute, 500);
  EXPECT_NEAR(steps[3].axes[2], 0, 1e-12);
}

TEST(Host, InchProgramsMoveInInches) {
  World world;
  expectFinished(world.run("0 BEGIN PGM A INCH\nL X+1 Y-2 F10\nQ5 = 3\nL XQ5\n"));
  expectPath(world, {{25.4, -50.8, 0}, {76.2, -50.8, 0}});
  EXPECT_EQ(world.q(113), 1);
  // Feeds count in tenths of an inch a minute.
  EXPECT_DOUBLE_EQ(world.machine->steps[0].feed.perMinute, 25.4);
}

/// F of TOOL CALL is the feed of the path until a block names another one; without F the feed stays.
TEST(Host, TheFeedOfToolCallIsThatOfThePath) {
  for (const bool inches : {false, true}) {
    World world;
    expectFinished(
        world.run(fmt::format("0 BEGIN PGM A {}\nTOOL CALL 1 Z S1000 F300\nL X+1\nL X+2 F600\nTOOL CALL S50\nL X+3\n"
                              "TOOL CALL F500\nL X+4\nL X+5 F200\nL X+6 FAUTO\nTOOL CALL 1 Z\nL X+7\nL X+8 FMAX\n"
                              "FN 18: SYSREAD Q1 = ID20 NR9\n",
                              inches ? "INCH" : "MM")));
    const double unit = inches ? 2.54 : 1;
    const std::vector<double> feeds = {300, 600, 600, 500, 200, 500, 500};
    ASSERT_EQ(world.machine->steps.size(), feeds.size() + 1);
    for (std::size_t i = 0; i < feeds.size(); ++i)
      EXPECT_DOUBLE_EQ(world.machine->steps[i].feed.perMinute, feeds[i] * unit) << i;
    EXPECT_TRUE(world.machine->steps.back().feed.rapid);
    EXPECT_DOUBLE_EQ(world.q(1), 500 * unit);
  }
}

/// Angles are degrees whatever the unit, and M126 leads an axis that turns without end the short way.
TEST(Host, RotaryAxesTurnByDegreesInInchProgramsToo) {
  World world("mill5-table-table");
  const std::size_t a = *world.machine->description().axisIndex("A"), c = *world.machine->description().axisIndex("C");
  expectFinished(world.run("0 BEGIN PGM A INCH\nL A+10 C+350 F100\nL IA+5\nM126\nL A-10 C+10\nM127\nL C+20\n"));
  const auto& steps = world.machine->steps;
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_EQ(steps[0].axes[a], 10);
  EXPECT_EQ(steps[0].axes[c], 350);
  EXPECT_EQ(steps[1].axes[a], 15);
  EXPECT_EQ(steps[2].axes[a], -10);
  EXPECT_EQ(steps[2].axes[c], 370);
  EXPECT_EQ(steps[3].axes[c], 20);
}

/// With DR+ from left to right the lower half of the circle; a radius in inches or rounded may be a little too small.
TEST(Host, ARadiusOfHalfTheDistanceIsHalfACircle) {
  for (const char* radius : {"+10", "-10", "+9.99"}) {
    World world;
    expectFinished(world.run(fmt::format("L X+0 Y+0 R0 F100\nCR X+20 Y+0 R{} DR+", radius)));
    const auto path = world.path();
    ASSERT_FALSE(path.empty()) << radius;
    EXPECT_TRUE(near(path.back(), {20, 0, 0})) << radius;
    double lowest = 0;
    for (const auto& place : path) {
      lowest = std::min(lowest, place.y());
      EXPECT_NEAR(std::hypot(place.x() - 10, place.y()), 10, 0.02) << radius;
    }
    EXPECT_NEAR(lowest, -10, 0.02) << radius;
  }
}

TEST(Host, PolarCoordinatesAndArcs) {
  World world;
  expectFinished(world.run("L X+10 Y+0 R0 F100\nCC X+0 Y+0\nLP PR+20 PA+90\nCP PA+180 DR+\nCR X+0 Y+20 R+20 DR-"));
  const auto path = world.path();
  EXPECT_TRUE(near(path[1], {0, 20, -0.0}));
  // Every point of the arcs lies on its circle about the pole; the chords' sagitta stays within the path tolerance.
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_NEAR(path[i].norm(), 20, 1e-9);
    if (i > 1) {
      EXPECT_GT(((path[i] + path[i - 1]) / 2).norm(), 20 - 1.001e-3);
    }
  }
  EXPECT_TRUE(near(path.back(), {0, 20, 0}));
}

TEST(Host, TangentialArcEndsWhereAskedAndBeginsInDirection) {
  World world;
  expectFinished(world.run("L X+0 Y+0 F100\nL X+10\nCT X+20 Y+10"));
  const auto path = world.path();
  for (std::size_t i = 2; i < path.size(); ++i)
    EXPECT_NEAR((path[i] - Vector3(10, 10, 0)).norm(), 10, 1e-9);
  EXPECT_TRUE(near(path.back(), {20, 10, 0}));
}

TEST(Host, RoundingAndChamferBetweenLines) {
  World world;
  expectFinished(world.run("L X-1 Y+0 F100\nL X+10\nRND R2\nL Y+10\nCHF 3\nL X+0"));
  const auto path = world.path();
  EXPECT_TRUE(near(path[1], {8, 0, 0}));
  EXPECT_TRUE(near(path[path.size() - 3], {10, 7, 0}));
  EXPECT_TRUE(near(path[path.size() - 2], {7, 10, 0}));
  EXPECT_TRUE(near(path.back(), {0, 10, 0}));
  for (std::size_t i = 2; i + 3 < path.size(); ++i)
    EXPECT_NEAR((path[i] - Vector3(8, 2, 0)).norm(), 2, 1e-9);
  EXPECT_THAT(world.run("L X+0 Y+0 F100\nL X+1\nRND R5\nL Y+1").diagnostics.front().message, HasSubstr("larger"));
}

TEST(Host, RadiusCompensationRunsBesideASquare) {
  World world;
  expectFinished(
      world.run("TOOL CALL 5 Z\nL X-20 Y-20 Z+0 R0 F100\nL X+0 Y+0 RL\nL Y+50\nL X+50\nL Y+0\nL X+0\nL X-20 Y-20 R0"));
  const auto path = world.path();
  // Left of the contour, clockwise around the square: 5 mm outside, with arcs about its corners.
  EXPECT_TRUE(near(path[0], {-20, -20, 0}));
  EXPECT_TRUE(near(path[1], {-5, 0, 0}));
  EXPECT_TRUE(near(path[2], {-5, 50, 0}));
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Vector3& p = path[i];
    const double dx = std::max({-p.x(), p.x() - 50, 0.0});
    const double dy = std::max({-p.y(), p.y() - 50, 0.0});
    EXPECT_NEAR(std::hypot(dx, dy), 5, 1e-9);
  }
  EXPECT_TRUE(near(path[path.size() - 2], {0, -5, 0}));
  EXPECT_TRUE(near(path.back(), {-20, -20, 0}));
}

TEST(Host, RadiusCompensationMeetsInsideCorners) {
  World world;
  expectFinished(world.run("TOOL CALL 5 Z\nL X+25 Y+25 Z+0 R0 F100\nL X+0 Y+25 RR\nL Y+50\nL X+50\nL Y+0\nL X+25 R0"));
  expectPath(world, {{25, 25, 0}, {5, 25, 0}, {5, 45, 0}, {45, 45, 0}, {45, 0, 0}, {25, 0, 0}});
}

TEST(Host, CompensatedArcsKeepTheirDistance) {
  World world;
  expectFinished(
      world.run("TOOL CALL 5 Z\nL X+40 Y-10 Z+0 R0 F100\nL X+30 Y+0 RR\nCC X+0 Y+0\nC X+30 Y+0 DR+\nL X+40 R0"));
  const auto path = world.path();
  for (std::size_t i = 1; i + 1 < path.size(); ++i)
    EXPECT_NEAR(path[i].norm(), 35, 1e-9);
  EXPECT_EQ(world.run("TOOL CALL 5 Z\nL X+4 Y-10 Z+0 R0 F100\nL X+3 Y+0 RL\nCC X+0 Y+0\nC X+3 Y+0 DR+\nL X+4 R0").end,
            RunEnd::Alarm);
}

/// An arc that begins it is entered beside its start.
TEST(Host, RadiusCompensationBeginsWithAnArc) {
  for (const auto& [side, radius] : {std::pair("RR", 35.0), {"RL", 25.0}}) {
    World world;
    expectFinished(world.run(
        fmt::format("TOOL CALL 5 Z\nL X+30 Y+0 Z+0 R0 F100\nCC X+0 Y+0\nC X+0 Y+30 DR+ {}\nL X-20\nL Y+60 R0", side)));
    const auto path = world.path();
    EXPECT_TRUE(near(path[0], {30, 0, 0}));
    EXPECT_TRUE(near(path[1], {radius, 0, 0}));
    const auto end = std::ranges::find_if(path, [&](const Vector3& p) { return near(p, {0, radius, 0}); });
    ASSERT_NE(end, path.end());
    ASSERT_GT(end - path.begin(), 10);
    for (auto at = path.begin() + 1; at != end; ++at)
      EXPECT_NEAR(at->norm(), radius, 1e-9);
    EXPECT_TRUE(near(path[path.size() - 2], {-20, radius, 0}));
  }
}

/// An arc that ends the compensation runs on the circle of its block, in both directions and on both sides.
TEST(Host, ArcsWithoutRadiusCompensationRunOnTheirCircle) {
  for (const char* side : {"RL", "RR"}) {
    for (const double sense : {1.0, -1.0}) {
      World world;
      expectFinished(
          world.run(fmt::format("TOOL CALL 5 Z\nL X-20 Y+0 Z+0 R0 F100\nL X+0 {}\nL X+30\nCC X+30 Y{:+}\n"
                                "C X+50 Y{:+} DR{} R0",
                                side, 20 * sense, 20 * sense, sense > 0 ? "+" : "-")));
      const auto path = world.path();
      const double beside = side == std::string_view("RL") ? 5 : -5;
      const auto end = std::ranges::find_if(path, [&](const Vector3& p) { return near(p, {30, beside, 0}); });
      ASSERT_NE(end, path.end()) << "the compensated line";
      ASSERT_GT(path.end() - end, 10);
      for (auto at = end + 1; at != path.end(); ++at)
        EXPECT_NEAR((*at - Vector3(30, 20 * sense, 0)).norm(), 20, 1e-9) << side << sense;
      EXPECT_TRUE(near(path.back(), {50, 20 * sense, 0}));
    }
  }
}

TEST(Host, ApproachAndDepartureAreTangential) {
  World world;
  expectFinished(
      world.run("TOOL CALL 5 Z\nL X-40 Y-40 Z+0 R0 F100\nAPPR LT X+0 Y+0 LEN15 RL F100\nL Y+30\nDEP LN LEN+10 F100"));
  expectPath(world, {{-40, -40, 0}, {-5, -15, 0}, {-5, 0, 0}, {-5, 30, 0}, {-15, 30, 0}});
  World arcs;
  expectFinished(
      arcs.run("TOOL CALL 5 Z\nL X-40 Y+0 Z+0 R0 F100\nAPPR CT X+0 Y+0 CCA90 R+10 RL F100\nL Y+30\nDEP CT CCA90 R+8"));
  const auto path = arcs.path();
  EXPECT_TRUE(near(path[1], {-15, -10, 0}));  // centre (-15, 0), a quarter before (-5, 0)
  EXPECT_TRUE(near(path.back(), {-13, 38, 0}));
  World tangent;
  expectFinished(
      tangent.run("TOOL CALL 5 Z\nL X-40 Y-30 Z+0 R0 F100\nAPPR LCT X+0 Y+0 R10 RL F100\nL Y+30\n"
                  "DEP LCT X-40 Y+60 R8"));
  const auto way = tangent.path();
  const Vector3 centre(-15, 0, 0);
  EXPECT_NEAR((way[1] - centre).norm(), 10, 1e-9);
  EXPECT_NEAR((way[1] - way[0]).dot(way[1] - centre), 0, 1e-9);
  // It stays on the arc until it is at the contour, piece by piece, and goes on along it.
  std::size_t at = 1;
  for (; at + 1 < way.size() && !near(way[at], {-5, 0, 0}); ++at) {
    EXPECT_NEAR((way[at] - centre).norm(), 10, 1e-9) << at;
    EXPECT_LT((way[at + 1] - way[at]).norm(), 2) << at;
  }
  ASSERT_LT(at + 1, way.size());
  EXPECT_TRUE(near(way[at + 1], {-5, 30, 0}));
  EXPECT_TRUE(near(way.back(), {-40, 60, 0}));
}

TEST(Host, TransformationsTurnMirrorAndScale) {
  World world;
  expectFinished(
      world.run("CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\nL X+10 Y+0 F100\nCYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+0\n"
                "CYCL DEF 8.0 M\nCYCL DEF 8.1 X\nL X+10 Y+5\nCYCL DEF 8.0 M\nCYCL DEF 8.1\n"
                "CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL 2\nL X+10 Y+5\nCYCL DEF 11.0 S\nCYCL DEF 11.1 SCL 1\n"
                "TRANS DATUM AXIS X+1 Y+2\nL X+0 Y+0\nTRANS DATUM RESET\nL X+0 Y+0"));
  expectPath(world, {{0, 10, 0}, {-10, 5, 0}, {20, 10, 0}, {1, 2, 0}, {0, 0, 0}});
}

TEST(Host, RetractionGoesToTheLimit) {
  World world;
  expectFinished(world.run("TOOL CALL 1 Z\nL X+0 Y+0 Z-200 FMAX\nM140 MB+50\nM140 MB MAX"));
  const auto path = world.path();
  EXPECT_TRUE(near(path[1], {0, 0, -150}));
  const auto& description = world.machine->description();
  EXPECT_NEAR(world.machine->position()[2], description.axes[2].maximum, 1e-5);
}

TEST(Host, ProtocolsSpeakTheLanguageOfTheControl) {
  World world;
  world.files["M.A"] =
      "\"1\";\nL_ENGLISH\n\"READY\";\nL_SWEDISH\n\"KLAR\";\nL_GERMAN\n\"FERTIG\";\nL_ALL\n\"2\";\nM_CLOSE\n";
  expectFinished(world.run("FN 16: F-PRINT M.A / EN.TXT\n"));
  EXPECT_EQ(world.control->panel.files().at("EN.TXT"), "1\nREADY\n2\n");
  world.control->panel.language = control::DialogLanguage::Swedish;
  expectFinished(world.run("FN 16: F-PRINT M.A / SV.TXT\n"));
  EXPECT_EQ(world.control->panel.files().at("SV.TXT"), "1\nKLAR\n2\n");
}

TEST(Host, FreeTablesAreReadAndWritten) {
  World world;
  world.files["T.TAB"] = "BEGIN T.TAB MM\nNR   X          Y          DOC\n0    +1.500     +2.250     first\n[END]\n";
  expectFinished(
      world.run("FN 26: TABOPEN TNC:\\DIR\\T.TAB\nFN 28: TABREAD Q10 = 0/\"X,Y\"\n"
                "FN 28: TABREAD QS1 = 0/\"DOC\"\nQ20 = Q10 * 2\nQ21 = -1\n"
                "FN 27: TABWRITE 1/\"X,Y\" = Q20\n"));
  EXPECT_EQ(world.q(10), 1.5);
  EXPECT_EQ(world.q(11), 2.25);
  EXPECT_EQ(world.control->q.qs(1), "first");
  const std::string& file = world.control->panel.files().at("T.TAB");
  EXPECT_THAT(file, HasSubstr("0    +1.500     +2.250     first"));
  EXPECT_THAT(file, HasSubstr("1    +3.000     -1.000"));
  EXPECT_THAT(world.run("FN 26: TABOPEN NONE.TAB\n").diagnostics.front().message, HasSubstr("NONE.TAB"));
}

/// Columns of numbers without decimal places take whole numbers as they are, in as few characters as they have.
TEST(Host, FreeTablesKeepWholeNumbers) {
  World world;
  world.files["T.TAB"] = "BEGIN T.TAB MM\nNR   D     N     E        DOC\n0    +3    4              first\n[END]\n";
  expectFinished(
      world.run("FN 26: TABOPEN T.TAB\nQ20 = 7\nQ21 = -12\nQ22 = 5\nFN 27: TABWRITE 0/\"D,N,E\" = Q20\n"
                "Q20 = 18 / 3\nFN 27: TABWRITE 1/\"D\" = Q20\nFN 28: TABREAD Q30 = 0/\"D,N,E\"\n"));
  const std::string& file = world.control->panel.files().at("T.TAB");
  EXPECT_THAT(file, HasSubstr("0    +7    -12   +5       first"));
  EXPECT_THAT(file, HasSubstr("1    +6  "));
  EXPECT_EQ(world.q(30), 7);
  EXPECT_EQ(world.q(31), -12);
  EXPECT_EQ(world.q(32), 5);
}

TEST(Host, CirclesThroughPoints) {
  World world;
  expectFinished(world.run("Q30=13\nQ31=4\nQ32=3\nQ33=14\nQ34=-7\nQ35=4\nFN 23: Q20 = CDATA Q30\n"));
  EXPECT_NEAR(world.q(20), 3, 1e-12);
  EXPECT_NEAR(world.q(21), 4, 1e-12);
  EXPECT_NEAR(world.q(22), 10, 1e-12);
}

TEST(Host, AlarmsNameTheReason) {
  World world;
  const auto message = [&](const std::string& text) {
    const RunResult result = world.run(text);
    EXPECT_EQ(result.end, RunEnd::Alarm) << text;
    return result.diagnostics.empty() ? std::string() : result.diagnostics.front().message;
  };
  EXPECT_THAT(message("L X+1\n"), HasSubstr("feed rate"));
  EXPECT_THAT(message("TOOL CALL 99 Z\n"), HasSubstr("no tool 99"));
  EXPECT_THAT(message("L C+5 FMAX\n"), HasSubstr("no axis C"));
  EXPECT_THAT(message("FN 14: ERROR = 12\n"), HasSubstr("12"));
  EXPECT_THAT(message("ERROR = L X+\n"), HasSubstr("ERROR ="));
  EXPECT_THAT(message("TCH PROBE 470 X ~\n Q1=1\n"), HasSubstr("cycle 470 is not available"));
  EXPECT_THAT(message("L X+0 Y+0 FMAX\nCC X+10 Y+0\nC X+5 Y+5 DR+\n"), HasSubstr("beside the circle"));
  EXPECT_THAT(message("L X+0 Y+0 FMAX\nCR X+10 Y+0 R3 DR+\n"), HasSubstr("at least 5"));
  EXPECT_THAT(message("L X+0 Y+0 FMAX\nCR X+10 Y+0 R4.98 DR+\n"), HasSubstr("at least 5"));
  EXPECT_THAT(message("L X+0 Y+0 FMAX\nCR X+10 Y+0 R-3 DR+\n"), HasSubstr("at least 5"));
  EXPECT_THAT(message("CYCL DEF 7.0 X\nCYCL DEF 7.1 #3\n"), HasSubstr("datum table"));
  EXPECT_THAT(message("L X+0 Y+0 FMAX\nAPPR LCT X+0 Y+0 R+0 RL F100\nL Y+5\n"), HasSubstr("its own arc"));
  EXPECT_THAT(message("M128\n"), HasSubstr("rotary axes"));
  EXPECT_THAT(message("PLANE SPATIAL SPA10 SPB0 SPC0 STAY\n"), HasSubstr("cannot reach"));
}

}  // namespace
}  // namespace probewright::language::klartext::testing

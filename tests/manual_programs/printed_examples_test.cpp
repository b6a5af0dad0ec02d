#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "machine/description.hpp"
#include "manual_programs/part.hpp"
#include "manual_programs/printed_blocks.hpp"
#include "session/check.hpp"
#include "session/source.hpp"

/// The examples that the manuals print with the cycles: each is read, and each that is a whole measurement runs on a
/// part made for it, whose features lie a little beside the values of the program.
namespace probewright::testing_support {
namespace {

using printed::Block;
using ::testing::HasSubstr;

constexpr double exact = 1e-6, digit = 6e-5;

Diagnostics mistakesOf(ControlKind control, const std::string& block) {
  const std::string text = "0 BEGIN PGM PRINTED MM\n1 TOOL CALL 1 Z\n" + block + "99 END PGM PRINTED MM\n";
  const auto program = session::programOf("PRINTED.H", text, session::ProgramLanguage::Klartext);
  Diagnostics mistakes = session::checkProgram(*program, control);
  coverage::noteRead(control, text, mistakes, "TCH PROBE");
  return mistakes;
}

TEST(PrintedBlocks, AreRead) {
  for (const ControlKind control : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const Block& block : printed::blocks) {
      if (!block.controls.contains(control)) continue;
      for (const Diagnostic& mistake : mistakesOf(control, block.text))
        ADD_FAILURE() << control::name(control) << ": " << format(mistake) << "\n" << block.text;
    }
  }
}

/// One edition prints the parameters of a rectangle in the examples of the circles, and those of the outside corner in
/// that of the inside corner.
TEST(PrintedBlocks, MisprintsAreNamed) {
  const Diagnostics corner = mistakesOf(ControlKind::iTNC530, probe(415, printed::cycle414));
  ASSERT_FALSE(corner.empty());
  EXPECT_THAT(format(corner.front()), HasSubstr("cycle 415"));
  EXPECT_THAT(format(corner.front()), ::testing::AnyOf(HasSubstr("Q296"), HasSubstr("Q308")));
  for (const int cycle : {412, 413}) {
    const Diagnostics mistakes = mistakesOf(ControlKind::iTNC530, probe(cycle, printed::cycle410));
    ASSERT_FALSE(mistakes.empty());
    EXPECT_THAT(format(mistakes.front()), HasSubstr(fmt::format("cycle {}", cycle)));
    EXPECT_THAT(format(mistakes.front()), ::testing::AnyOf(HasSubstr("Q323"), HasSubstr("Q262")));
  }
}

/// Origin of the workpiece system at the end, from the first preset's.
Vector3 origin(const Ran& ran) { return ran.preset().translation() - Vector3(0, 0, tableHeight); }

void expectRow(const Ran& ran, const std::string& row, const Vector3& expected) {
  EXPECT_NEAR(ran.cell("PRESET.PR", row, "X"), expected.x(), digit);
  EXPECT_NEAR(ran.cell("PRESET.PR", row, "Y"), expected.y(), digit);
  EXPECT_NEAR(ran.cell("PRESET.PR", row, "Z"), expected.z() + tableHeight, digit);
}

class Printed : public ::testing::TestWithParam<ControlKind> {
protected:
  Part part{GetParam()};
  bool isTNC640() const { return GetParam() == ControlKind::TNC640; }
};

TEST_P(Printed, Cycle400FindsTheSlopeOfTheEdge) {
  const double drawn = degrees(std::atan2(2 - 3.5, 25 - 10)), lies = drawn + 0.4;
  part.wall({10, 3.5}, lies);
  const Ran ran = part.run(400, printed::cycle400);
  EXPECT_NEAR(degrees(std::atan2(ran.preset().linear()(1, 0), ran.preset().linear()(0, 0))), lies, 1e-7);
}

TEST_P(Printed, Cycle401TurnsByTheLineThroughTwoHoles) {
  part.hole({-37.2, 12.1}, 14);
  part.hole({75.1, 20.3}, 14);
  const Ran ran = part.run(401, printed::cycle401);
  const double expected = degrees(std::atan2(20.3 - 12.1, 75.1 + 37.2));
  EXPECT_NEAR(degrees(std::atan2(ran.preset().linear()(1, 0), ran.preset().linear()(0, 0))), expected, 1e-7);
}

TEST_P(Printed, Cycle402TurnsByTheLineThroughTwoStuds) {
  part.stud({-37.2, 12.1}, 60);
  part.stud({75.1, 20.3}, 60);
  const Ran ran = part.run(402, printed::cycle402);
  const double expected = degrees(std::atan2(20.3 - 12.1, 75.1 + 37.2));
  EXPECT_NEAR(degrees(std::atan2(ran.preset().linear()(1, 0), ran.preset().linear()(0, 0))), expected, 1e-7);
}

/// Where a machine place that was fixed to the table at the start of the run is at its end.
Vector3 afterTurning(const Part& part, const Ran& ran, const Vector3& place) {
  const auto& truth = part.bench.setup.world.truth;
  return machine::baseFromTable(truth.machine, ran.machine->position()) *
         (machine::baseFromTable(truth.machine, truth.start).inverse() * place);
}
double directionOf(const Vector3& place) { return degrees(std::atan2(place.y(), place.x())); }

TEST_P(Printed, Cycle403TurnsTheEdgeParallelToY) {
  Part turning(GetParam(), "mill5-table-table");
  const double lies = degrees(std::atan2(30, 20)) + 0.3;
  turning.wall({0, 0}, lies);
  // The older control does not find the axis itself: its edition prints Q312=6.
  const Words words = isTNC640() ? printed::cycle403 : with(printed::cycle403, {{312, 6}});
  const Ran ran = turning.run(403, words);
  EXPECT_NEAR(ran.q(150), lies, 1e-7);
  const Vector3 along(std::cos(radians(lies)), std::sin(radians(lies)), 0);
  EXPECT_NEAR(directionOf(afterTurning(turning, ran, along) - afterTurning(turning, ran, Vector3::Zero())), 90, 1e-7);
  EXPECT_TRUE(ran.cycle().writes.empty()) << "Q337 = 0 enters nothing";
}

TEST_P(Printed, Cycle404TakesTheBasicRotationBack) {
  part.bench.setup.beliefs.presets.front().rotation = {0, 0, 3.5};
  const Ran ran = part.run(404, isTNC640() ? Words{{307, 0}, {305, -1}} : Words{{307, 0}});
  EXPECT_TRUE(ran.preset().isApprox(pose({0, 0, tableHeight}), 1e-12));
  EXPECT_EQ(ran.cell("PRESET.PR", "1", isTNC640() ? "SPC" : "ROT"), 0);
}

TEST_P(Printed, Cycle405BringsTheHoleToItsDirection) {
  Part turning(GetParam(), "mill5-table-table");
  const Vector2 centre(50.4, 49.7);
  turning.hole(centre, 11);
  const Ran ran = turning.run(405, printed::cycle405);
  const Vector3 found(centre.x(), centre.y(), tableHeight);
  EXPECT_NEAR(ran.q(150), directionOf(found) - 45, 1e-7);
  EXPECT_NEAR(directionOf(afterTurning(turning, ran, found)), 45, 1e-7);
  EXPECT_NEAR(ran.cell("PRESET.PR", "1", isTNC640() ? "C_OFFS" : "C"), ran.machine->position()[4], digit);
}

TEST_P(Printed, Cycle408CentresTheSlotAndSetsTheTop) {
  const double middle = 50.12, width = 25.3, top = 0.07;
  part.box({middle + width / 2, 0, -40}, {130, 100, top});
  part.box({-30, 0, -40}, {middle - width / 2, 100, top});
  expectRow(part.run(408, printed::cycle408), "10", {middle, 0, top - 1});
}

TEST_P(Printed, Cycle409CentresTheRidgeAndSetsTheGround) {
  const double middle = 49.85, width = 24.9, ground = -14.2;
  part.box({middle - width / 2, 0, -40}, {middle + width / 2, 100, 0});
  part.box({middle + width / 2, 0, -60}, {130, 100, ground});
  expectRow(part.run(409, printed::cycle409), "10", {middle, 0, ground - 1});
}

TEST_P(Printed, Cycle410CentresThePocket) {
  part.pocket({50.2, 49.9}, {60.1, 20.05});
  expectRow(part.run(410, printed::cycle410), "10", {50.2, 49.9, -1});
}

TEST_P(Printed, Cycle411CentresTheStud) {
  part.block({50.2, 49.9}, {60.1, 20.05});
  part.box({81, 0, -60}, {130, 100, -14.2});
  const Vector3 found = origin(part.run(411, printed::cycle411));
  EXPECT_TRUE(found.isApprox(Vector3(50.2, 49.9, -15.2), exact)) << found.transpose();
}

/// The example of a circle as far as the control knows its parameters.
Words circleWords(const Words& printedWords, bool newer) {
  Words words = printedWords;
  if (!newer) words.resize(words.size() - 2);
  return words;
}

TEST_P(Printed, Cycle412CentresTheHoleAndSetsItsFloor) {
  part.hole({50.2, 49.9}, 75.3);
  part.box({20, 20, -60}, {90, 80, -14.2});
  const Ran ran = part.run(412, circleWords(printed::cycle412, isTNC640()));
  EXPECT_NEAR(ran.q(153), 75.3, exact);
  expectRow(ran, "12", {50.2, 49.9, -15.2});
}

TEST_P(Printed, Cycle413CentresTheStudAndSetsItsTop) {
  part.stud({50.2, 49.9}, 74.6, 0.3);
  const Ran ran = part.run(413, circleWords(printed::cycle413, isTNC640()));
  EXPECT_NEAR(ran.q(153), 74.6, exact);
  expectRow(ran, "15", {50.2, 49.9, 0.3 - 1});
}

TEST_P(Printed, Cycle414FindsTheCorner) {
  part.box({-40, 7.3, -40}, {95.2, 120, 0.1});
  expectRow(part.run(414, printed::cycle414), "7", {95.2, 7.3, 0.1 - 1});
}

/// Q263 and Q264 are the corner in one edition and the first point in the other: both find the same corner.
TEST_P(Printed, Cycle415FindsTheInsideCorner) {
  part.box({0, -40, -40}, {37.3, 120, 0});
  part.box({0, -40, -40}, {140, 7.2, 0});
  part.box({75, 40, -60}, {95, 60, -14.2});
  for (const double first : {37.0, 46.0}) {
    const Ran ran = part.run(415, with(printed::cycle415, {{263, first}}));
    EXPECT_NEAR(ran.q(151), 37.3, exact);
    EXPECT_NEAR(ran.q(152), 7.2, exact);
    expectRow(ran, "7", {37.3, 7.2, -15.2});
  }
}

TEST_P(Printed, Cycle416CentresTheBoltHoleCircle) {
  const Vector2 middle(50.15, 49.9);
  for (const double angle : {34, 70, 210})
    part.hole(middle + 44.95 * Vector2(std::cos(radians(angle)), std::sin(radians(angle))), 12);
  part.block({85, 50}, {8, 8});
  expectRow(part.run(416, printed::cycle416), "12", {middle.x(), middle.y(), -1});
}

TEST_P(Printed, Cycle417SetsTheProbeAxis) {
  part.box({0, 0, 0}, {50, 50, 25.34});
  EXPECT_TRUE(origin(part.run(417, printed::cycle417)).isApprox(Vector3(0, 0, 25.34), exact));
}

TEST_P(Printed, Cycle418CrossesTheDiagonals) {
  const std::array<Vector2, 4> centres = {Vector2(20.2, 25.1), Vector2(149.9, 25), Vector2(150.2, 84.8),
                                          Vector2(22.1, 80.2)};
  for (const Vector2& centre : centres)
    part.hole(centre, 16);
  part.block({85, 50}, {8, 8});
  // Where the line from the first to the third meets the line from the second to the fourth.
  const Vector2 d = centres[2] - centres[0], e = centres[3] - centres[1], f = centres[1] - centres[0];
  const double share = (f.x() * e.y() - f.y() * e.x()) / (d.x() * e.y() - d.y() * e.x());
  const Vector2 cross = centres[0] + share * d;
  expectRow(part.run(418, printed::cycle418), "12", {cross.x(), cross.y(), 0});
}

TEST_P(Printed, Cycle419SetsOneAxis) {
  part.box({25.4, 0, 0}, {80, 50, 30});
  EXPECT_TRUE(origin(part.run(419, printed::cycle419)).isApprox(Vector3(25.4, 0, 0), exact));
}

TEST_P(Printed, Cycle420MeasuresTheAngle) {
  const double lies = degrees(std::atan2(95 - 10, 15 - 10)) - 0.3;
  // Probed against X: the material lies on the left of the direction of the line.
  part.wall({10, 10}, lies);
  const Ran ran = part.run(420, printed::cycle420);
  EXPECT_NEAR(ran.q(150), lies, 1e-7);
  EXPECT_THAT(ran.log("TCHPR420.TXT"), HasSubstr(fmt::format("{:.4f}", lies)));
}

TEST_P(Printed, Cycle421MeasuresTheHole) {
  part.hole({50.05, 49.97}, 75.03);
  const Ran ran = part.run(421, printed::cycle421);
  EXPECT_NEAR(ran.q(151), 50.05, exact);
  EXPECT_NEAR(ran.q(152), 49.97, exact);
  EXPECT_NEAR(ran.q(153), 75.03, exact);
  EXPECT_NEAR(ran.q(163), 0.03, exact);
  EXPECT_EQ(ran.q(180), 1);
}

TEST_P(Printed, Cycle422MeasuresTheStud) {
  part.stud({50.06, 50}, 35.2);
  const Ran ran = part.run(422, printed::cycle422);
  EXPECT_NEAR(ran.q(153), 35.2, exact);
  EXPECT_NEAR(ran.q(161), 0.06, exact);
  EXPECT_EQ(ran.q(182), 1) << "the position is out of its tolerance of 0.05";
}

TEST_P(Printed, Cycle423MeasuresThePocket) {
  part.pocket({50.2, 49.9}, {80.1, 60.05});
  const Ran ran = part.run(423, printed::cycle423);
  EXPECT_NEAR(ran.q(154), 80.1, exact);
  EXPECT_NEAR(ran.q(155), 60.05, exact);
  EXPECT_EQ(ran.q(180), 1) << "nothing has a tolerance";
}

TEST_P(Printed, Cycle424MeasuresTheStud) {
  part.block({50, 50}, {75.05, 34.9});
  const Ran ran = part.run(424, printed::cycle424);
  EXPECT_NEAR(ran.q(164), 0.05, exact);
  EXPECT_NEAR(ran.q(165), -0.1, exact);
  EXPECT_EQ(ran.q(182), 1) << "34.9 is less than 34.95";
}

TEST_P(Printed, Cycle425MeasuresTheSlot) {
  const double middle = 75.02, width = 25.03;
  part.box({middle + width / 2, -60, -40}, {130, 60, 0});
  part.box({20, -60, -40}, {middle - width / 2, 60, 0});
  Words words = printed::cycle425;
  if (!isTNC640()) words.resize(words.size() - 2);  // the older edition has neither Q320 nor Q301
  const Ran ran = part.run(425, words);
  EXPECT_NEAR(ran.q(156), width, exact);
  EXPECT_NEAR(ran.q(157), middle, exact);
  EXPECT_NEAR(ran.q(166), 0.03, exact);
  EXPECT_EQ(ran.q(180), 1);
}

TEST_P(Printed, Cycle426MeasuresTheRidge) {
  // The points stand 60 mm apart, the nominal length is 45: the touches come later than the points say.
  part.box({0, 32.4, -40}, {100, 77.36, 0});
  const Ran ran = part.run(426, printed::cycle426);
  EXPECT_NEAR(ran.q(156), 44.96, exact);
  EXPECT_NEAR(ran.q(166), -0.04, exact);
  EXPECT_EQ(ran.q(180), 1);
}

TEST_P(Printed, Cycle427MeasuresTheHeight) {
  part.box({0, 0, 0}, {80, 80, 5.02});
  const Ran ran = part.run(427, printed::cycle427);
  EXPECT_NEAR(ran.q(160), 5.02, exact);
  EXPECT_EQ(ran.q(180), 1);
}

TEST_P(Printed, Cycle430MeasuresTheBoltHoleCircle) {
  for (const double angle : {0, 90, 180})
    part.hole(Vector2(50.1, 49.95) + 40.02 * Vector2(std::cos(radians(angle)), std::sin(radians(angle))), 12);
  const Ran ran = part.run(430, printed::cycle430);
  EXPECT_NEAR(ran.q(151), 50.1, exact);
  EXPECT_NEAR(ran.q(152), 49.95, exact);
  EXPECT_NEAR(ran.q(153), 80.04, exact);
  EXPECT_EQ(ran.q(180), 1);
  EXPECT_THAT(ran.log("TCHPR430.TXT"), HasSubstr("Diameter:                                   80.0400"));
}

TEST_P(Printed, Cycle441MakesTheControlShowEveryResult) {
  part.hole({50.05, 49.97}, 75.03);
  const std::string block = "TCH PROBE 441 FAST ~\nQ396=3000 ;FEED ~\nQ397=0 ;RAPID ~\nQ399=1 ;TRACK ~\nQ400=1 ;STOP\n";
  const Ran ran = part.bench.run(block + probe(421, with(printed::cycle421, {{281, 0}})));
  ASSERT_TRUE(ran.finished()) << ran.why();
  ASSERT_EQ(ran.screens().size(), 1U);
  EXPECT_THAT(ran.screens().front(), HasSubstr("75.0300"));
}

/// All that touches the part refuses to begin without a tool, and stops where nothing is to be touched.
TEST_P(Printed, NoCycleRunsWithoutProbeOrPart) {
  const Words circle = {{321, 50}, {322, 50}, {262, 20}, {325, 0}, {247, 90}, {261, -5}, {320, 0}, {260, 20}, {301, 0},
                        {305, 0},  {331, 0},  {332, 0},  {303, 1}, {381, 0},  {382, 0},  {383, 0}, {384, 0},  {333, 0}};
  Words slot = printed::cycle425;
  if (!isTNC640()) slot.resize(slot.size() - 2);
  const std::vector<std::pair<int, Words>> all = {{400, printed::cycle400},
                                                  {401, printed::cycle401},
                                                  {402, printed::cycle402},
                                                  {403, printed::cycle403},
                                                  {405, printed::cycle405},
                                                  {408, printed::cycle408},
                                                  {409, printed::cycle409},
                                                  {410, printed::cycle410},
                                                  {411, printed::cycle411},
                                                  {412, circle},
                                                  {413, circle},
                                                  {414, printed::cycle414},
                                                  {415, printed::cycle415},
                                                  {416, printed::cycle416},
                                                  {417, printed::cycle417},
                                                  {418, printed::cycle418},
                                                  {419, printed::cycle419},
                                                  {420, printed::cycle420},
                                                  {421, printed::cycle421},
                                                  {422, printed::cycle422},
                                                  {423, printed::cycle423},
                                                  {424, printed::cycle424},
                                                  {425, slot},
                                                  {426, printed::cycle426},
                                                  {427, printed::cycle427},
                                                  {430, printed::cycle430},
                                                  {431, printed::cycle431}};
  for (const auto& [cycle, words] : all) {
    SCOPED_TRACE(fmt::format("cycle {}", cycle));
    const Words here = cycle == 403 && !isTNC640() ? with(words, {{312, 6}}) : words;
    const bool turnsTable = cycle == 403 || cycle == 405;
    const Part empty(GetParam(), turnsTable ? "mill5-table-table" : "mill3");
    EXPECT_EQ(empty.bench.runBare(probe(cycle, here)).alarm(), "Touch probe axis not defined");
    EXPECT_EQ(empty.bench.run(probe(cycle, here)).alarm(), "Touch point inaccessible");
  }
}

INSTANTIATE_TEST_SUITE_P(Controls, Printed, ::testing::Values(ControlKind::TNC640, ControlKind::iTNC530),
                         [](const auto& tested) { return std::string(control::name(tested.param)); });

}  // namespace
}  // namespace probewright::testing_support

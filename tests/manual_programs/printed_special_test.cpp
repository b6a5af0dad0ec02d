#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "geometry/decompositions.hpp"
#include "manual_programs/part.hpp"
#include "manual_programs/printed_blocks.hpp"

/// The printed examples of single touches, planes, axis shifts and calibrations, each on a part or standard made for
/// it.
namespace probewright::testing_support {
namespace {

using ::testing::HasSubstr;

constexpr double exact = 1e-6, digit = 6e-5;

class PrintedSpecial : public ::testing::TestWithParam<ControlKind> {
protected:
  Part part{GetParam()};
  bool isTNC640() const { return GetParam() == ControlKind::TNC640; }
  Ran runs(const std::string& blocks) const {
    Ran ran = part.bench.run(blocks);
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran;
  }
};

TEST_P(PrintedSpecial, Cycle0MeasuresTheFaceBeside) {
  part.box({-40, -30, -40}, {2.34, 30, 0});
  const Ran ran = runs("67 TCH PROBE 0.0 REF. PLANE Q5 X-\n68 TCH PROBE 0.1 X+5 Y+0 Z-5\n");
  EXPECT_NEAR(ran.q(5), 2.34, exact);
  EXPECT_NEAR(ran.q(115), 2.34 + 2, exact) << "the ball's radius is not taken into account";
  EXPECT_NEAR(ran.q(116), 0, exact);
  EXPECT_NEAR(ran.q(117), -5 + 110, exact) << "nor is the length";
}

/// A cycle of no touch probe, which the journal does not record: the test notes itself what it has seen.
TEST_P(PrintedSpecial, Cycle13IsWhereM19TurnsTheSpindleTo) {
  for (const std::string printed : {"93 CYCL DEF 13.0 ORIENT.OSTAN.SPIND\n94 CYCL DEF 13.1 UGOL 180\n",
                                    "93 CYCL DEF 13.0 ORIENTERING\n94 CYCL DEF 13.1 VINKEL 180\n"}) {
    const Ran still = runs("L Z+50 R0 FMAX\n" + printed), turned = runs("L Z+50 R0 FMAX\n" + printed + "95 M19\n");
    EXPECT_EQ(still.machine->spindle().angle, 0) << "it only says where to";
    EXPECT_EQ(turned.machine->spindle().angle, 180);
    const Ran refused = part.bench.run("Q1 = 361\nCYCL DEF 13.0 ORIENTATION\nCYCL DEF 13.1 ANGLE Q1\n");
    EXPECT_EQ(refused.outcome.result.end, execution::RunEnd::Alarm) << refused.why();
  }
  for (const char* seen : {"parsed", "runs", "refusals"})
    coverage::note(GetParam(), "13", seen);
}

TEST_P(PrintedSpecial, Cycle1ProbesAtAnAngle) {
  part.box({9.1, -30, -40}, {40, 30, 0});
  const Ran ran = runs("67 TCH PROBE 1.0 POLAR\n68 TCH PROBE 1.1 X ANGLE: +30\n69 TCH PROBE 1.2 X+5 Y+0 Z-5\n");
  EXPECT_NEAR(ran.q(115), 9.1 - 2, exact);
  EXPECT_NEAR(ran.q(116), (9.1 - 2 - 5) * std::tan(radians(30)), exact);
  EXPECT_NEAR(ran.q(117), -5 + 110, exact);
}

TEST_P(PrintedSpecial, Cycle3StopsAtTheWall) {
  part.box({8.2, -30, -40}, {40, 30, 0});
  const std::string measure =
      "4 TCH PROBE 3.0 MEASURE\n5 TCH PROBE 3.1 Q1\n6 TCH PROBE 3.2 X ANGLE: +15\n"
      "7 TCH PROBE 3.3 DIST +10 F100 MB1 REFERENCE SYSTEM: 0\n8 TCH PROBE 3.4 ERRORMODE1\n";
  const Ran ran = runs("L Z+50 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z-5 R0 FMAX\n" + measure);
  EXPECT_NEAR(ran.q(1), 8.2 - 2, exact);
  EXPECT_NEAR(ran.q(2), (8.2 - 2) * std::tan(radians(15)), exact);
  EXPECT_NEAR(ran.q(3), -5 + 2, exact);
  EXPECT_EQ(ran.q(4), 1);
  const Ran missed = runs("L Z+50 R0 FMAX\nL X-40 Y+0 R0 FMAX\nL Z-5 R0 FMAX\n" + measure);
  EXPECT_EQ(missed.q(4), -1);
}

TEST_P(PrintedSpecial, Cycle4GoesAlongItsVector) {
  part.box({-60, -60, -20}, {60, 60, 0.4});
  const Ran ran = runs(
      "L Z+25 R0 FMAX\nL X+20 Y+30 R0 FMAX\n4 TCH PROBE 4.0 MEASURE\n5 TCH PROBE 4.1 Q1\n"
      "6 TCH PROBE 4.2 IX-0.5 IY-1 IZ-1\n7 TCH PROBE 4.3 ABST+45 F100 MB50 REFERENCE SYSTEM:0\n");
  const double deep = 25 - 0.4;
  EXPECT_NEAR(ran.q(1), 20 - deep / 2, exact);
  EXPECT_NEAR(ran.q(2), 30 - deep, exact);
  EXPECT_NEAR(ran.q(3), 0.4 + 2, exact);
  EXPECT_EQ(ran.q(4), 1);
  // The retraction of 50 mm ends where the stroke began.
  EXPECT_NEAR(ran.machine->position()[0], 20, exact);
  EXPECT_NEAR(ran.machine->position()[2], 25 + 110 + tableHeight, exact);
}

/// Printed is a clearance height of 5 mm, below the third point at 12 mm: on the plane of the example the probe runs
/// into it.
TEST_P(PrintedSpecial, Cycle431MeasuresThePlane) {
  const Vector3 first(20, 20, -10), second(50, 80, 0), third(90, 35, 12);
  const Vector3 drawn = -(second - first).cross(third - first).normalized();
  const Vector3 n = (drawn + Vector3(0.002, -0.003, 0)).normalized();
  Pose face = pose(first + Vector3(0, 0, tableHeight));
  face.linear() = shortestTurn(Vector3::UnitZ(), n).toRotationMatrix();
  part.bench.part(simulation::Box({-60, -60, -20}, {120, 120, 0}), face);
  EXPECT_EQ(part.bench.run(probe(431, printed::cycle431)).alarm(), "Touch probe deflected");

  const Ran ran = runs(probe(431, with(printed::cycle431, {{260, 40}})));
  EXPECT_NEAR(ran.q(158), degrees(std::atan2(-n.y(), n.z())), exact);
  EXPECT_NEAR(ran.q(159), degrees(std::atan2(n.x(), n.z())), exact);
  const Matrix3 turned = pose(Vector3::Zero(), {ran.q(170), ran.q(171), ran.q(172)}).linear();
  EXPECT_LT((turned.col(2) - n).norm(), 1e-8);
  const auto heightAt = [&](const Vector3& place) {
    return first.z() - (n.x() * (place.x() - first.x()) + n.y() * (place.y() - first.y())) / n.z();
  };
  const Vector3 along(30, 60, heightAt(second) - heightAt(first));
  EXPECT_LT((turned.col(0) - along.normalized()).norm(), 1e-8);
  const std::string log = ran.log("TCHPR431.TXT");
  int number = 173;
  for (const Vector3& place : {first, second, third}) {
    const double measured = heightAt(place) + 2 / n.z() - 2;
    if (number == 173 || isTNC640()) {
      EXPECT_NEAR(ran.q(number), measured, exact);
    }
    ++number;
    EXPECT_THAT(log, HasSubstr(fmt::format("{:.4f}", measured)));
  }
  // The third point stands on the other side than the manual advises.
  EXPECT_TRUE(std::ranges::any_of(ran.outcome.journal.events, [](const control::EventRecord& event) {
    return event.kind == control::EventKind::Warning && event.text.find("third point") != std::string::npos;
  }));
}

TEST_P(PrintedSpecial, Cycle426TakesThePointsInEitherOrder) {
  part.box({0, 32.4, -40}, {100, 77.36, 0});
  for (const Words& words : {printed::cycle426, with(printed::cycle426, {{264, 85}, {266, 25}})}) {
    const Ran ran = runs(probe(426, words));
    EXPECT_NEAR(ran.q(156), 77.36 - 32.4, exact);
    EXPECT_EQ(ran.cycle().touches.front().direction.y(), -1);
    EXPECT_EQ(std::ranges::count(ran.outcome.journal.events, control::EventKind::Warning, &control::EventRecord::kind),
              0);
  }
}

TEST_P(PrintedSpecial, Cycle444MeasuresAPointOfAFace) {
  if (!isTNC640()) return;  // the older control has no cycle 444
  part.box({-40, -30, -40}, {0.23, 30, 30});
  const std::string block =
      probe(444, {{263, 0}, {264, 0}, {294, 0}, {581, 1}, {582, 0}, {583, 0}, {320, 0}, {260, 100}, {309, 0}},
            " ~\n  QS400=\"1-1\";TOLERANCE");
  const Ran ran = runs(block);
  EXPECT_NEAR(ran.q(151), 0.23, exact);
  EXPECT_NEAR(ran.q(164), 0.23, exact);
  EXPECT_EQ(ran.q(183), 0);
  EXPECT_THAT(ran.log("TCHPR444.html"), HasSubstr("0.2300"));
}

TEST_P(PrintedSpecial, Cycle440MeasuresTheShiftThatCalibratingDidNotSee) {
  if (isTNC640()) return;  // the newer control has no cycle 440
  simulation::TrueTool pin = idealProbe(70, 6);
  pin.number = 9;
  pin.name = "PIN";
  pin.kind = simulation::ToolKind::Cutter;
  pin.radius = 6;
  part.bench.setup.world.truth.tools.push_back(pin);
  part.bench.knows(9, "PIN", 70, 6);
  placeToolProbe(part.bench.setup.world.truth, simulation::Box({-20, -20, -10}, {20, 20, 0}), pose({100, 50, -460}));
  for (const auto& [name, value] :
       {std::pair("MP6580.0", 100.0), std::pair("MP6580.1", 50.0), std::pair("MP6580.2", -460.0)})
    part.bench.setup.beliefs.parameters[name] = {value, {}};
  const Words words = {{363, 1}, {364, 0}, {320, 2}, {260, 50}};
  const std::string tool = "TOOL CALL 9 Z\n";
  EXPECT_EQ(part.bench.runBare(tool + probe(440, words)).alarm(), "Axis shift not calibrated");
  const Ran ran = part.bench.runBare(tool + probe(440, with(words, {{363, 0}})) + probe(440, words));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(185), 0, exact);
  EXPECT_NEAR(ran.q(186), 0, exact);
  EXPECT_NEAR(ran.q(187), 0, exact);
}

/// A probe whose length, radius and tip offset the control does not know well.
class PrintedCalibration : public PrintedSpecial {
protected:
  void SetUp() override {
    auto& believed = part.bench.believedProbe();
    believed.length = 110.3;
    believed.radius = 2.1;
    part.bench.trueProbe().tipOffset = {0.07, -0.04};
    if (!isTNC640()) believed.tipOffset = {0.07, -0.04};
    believed.maximumTravel = 40;
  }
  /// `length` in the table is the effective one.
  void expect(const Ran& ran, bool radius, bool length) const {
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), radius ? 2 : 2.1, digit);
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), length ? 110 : 110.3, digit);
    if (!radius || !isTNC640()) return;
    EXPECT_NEAR(ran.cell("TCHPROBE.TP", "1", "CAL_OF1"), 0.07, digit);
    EXPECT_NEAR(ran.cell("TCHPROBE.TP", "1", "CAL_OF2"), -0.04, digit);
  }
};

TEST_P(PrintedCalibration, Cycle460OnASphereOf25Millimetres) {
  part.bench.part(simulation::SolidSphere(Vector3::Zero(), 12.5), pose({0.2, -0.1, tableHeight - 2.5}));
  Words words = {{407, 12.5}, {320, 0}, {301, 1}, {423, 4}, {380, 0}, {433, 0}, {434, -2.5}};
  if (isTNC640()) words = with(words, {{455, 15}});
  const std::string before = "L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z+12.3 R0 FMAX\n";
  const Ran ran = runs(before + probe(460, words));
  expect(ran, true, false);
  EXPECT_EQ(ran.outcome.files.contains("T1.3DTC"), isTNC640());
  EXPECT_EQ(ran.log("TCHPRAUTO.html").find("2.0000") != std::string::npos, isTNC640());
  expect(runs(before + probe(460, with(words, {{433, 1}}))), true, true);
  // The older control knows three and four touches.
  const Ran more = part.bench.run(before + probe(460, with(words, {{423, 5}})));
  EXPECT_EQ(more.finished(), isTNC640()) << more.why();
  if (!isTNC640()) {
    EXPECT_THAT(more.why(), HasSubstr("Q423"));
  }
}

TEST_P(PrintedCalibration, Cycles461To463) {
  if (!isTNC640()) return;  // the older control calibrates with cycles 2 and 9
  part.box({-20, 40, -40}, {20, 80, 5});
  expect(runs("L Z+60 R0 FMAX\nL X+0 Y+60 R0 FMAX\nL Z+9 R0 FMAX\n" + probe(461, {{434, 5}})), false, true);
  part.hole({0.05, -0.05}, 10);
  expect(
      runs("L Z+60 R0 FMAX\nL X+0 Y+0 R0 FMAX\nL Z-6 R0 FMAX\n" + probe(462, {{407, 5}, {320, 0}, {423, 8}, {380, 0}})),
      true, false);
  part.stud({80.05, -0.05}, 10);
  expect(runs("L Z+60 R0 FMAX\nL X+80 Y+0 R0 FMAX\nL Z+2 R0 FMAX\n" +
              probe(463, {{407, 5}, {320, 0}, {301, 1}, {423, 8}, {380, 0}})),
         true, false);
}

TEST_P(PrintedCalibration, Cycles2And9) {
  if (isTNC640()) return;  // the newer control calibrates with cycles 461 to 463
  part.hole({60.1, 19.9}, 2 * 25.003);
  for (const auto& [name, value] :
       {std::pair("MP6180.0", 60.0), std::pair("MP6180.1", 20.0), std::pair("MP6180.2", tableHeight)})
    part.bench.setup.beliefs.parameters[name] = {value, {}};
  expect(runs("5 TCH PROBE 2.0 CALIBRATE TS\n6 TCH PROBE 2.1 HEIGHT: +50 R +25.003 DIRECTION: 0\n"), true, false);
  // Printed is Y+356, beyond the travel of the machine here.
  part.box({-260, 180, 0}, {-210, 280, 50});
  expect(runs("L Z+80 R0 FMAX\n5 L X-235 Y+256 R0 FMAX\nL Z+55 R0 FMAX\n6 TCH PROBE 9.0 CALIBRATE TS LENGTH\n"
              "7 TCH PROBE 9.1 DATUM +50 REFERENCE SYSTEM 0\n"),
         false, true);
}

/// Around the standard at the measuring height, or over it: the same result, another way.
TEST_P(PrintedCalibration, Q301LeadsAroundTheStandardOrOverIt) {
  part.stud({0.05, -0.05}, 10);
  part.bench.part(simulation::SolidSphere(Vector3::Zero(), 12.5), pose({80.2, -0.1, tableHeight}));
  const auto seconds = [](const Ran& ran) { return ran.cycle().endSeconds - ran.cycle().startSeconds; };
  const auto on = [&](int cycle, double x, double z, const Words& words, int between) {
    const Ran ran = runs(fmt::format("L Z+60 R0 FMAX\nL X{:+.3f} Y+0 R0 FMAX\nL Z{:+.3f} R0 FMAX\n", x, z) +
                         probe(cycle, with(words, {{301, between}})));
    expect(ran, true, false);
    return seconds(ran);
  };
  const Words sphere = {{407, 12.5}, {320, 0}, {423, 4}, {380, 0}, {433, 0}, {434, 0}};
  EXPECT_LT(on(460, 80, 15, sphere, 0), on(460, 80, 15, sphere, 1) - 1);
  if (!isTNC640()) return;
  const Words stud = {{407, 5}, {320, 0}, {423, 8}, {380, 0}};
  EXPECT_LT(on(463, 0, 2, stud, 0), on(463, 0, 2, stud, 1) - 1);
}

INSTANTIATE_TEST_SUITE_P(Controls, PrintedSpecial, ::testing::Values(ControlKind::TNC640, ControlKind::iTNC530),
                         [](const auto& tested) { return std::string(control::name(tested.param)); });
INSTANTIATE_TEST_SUITE_P(Controls, PrintedCalibration, ::testing::Values(ControlKind::TNC640, ControlKind::iTNC530),
                         [](const auto& tested) { return std::string(control::name(tested.param)); });

}  // namespace
}  // namespace probewright::testing_support

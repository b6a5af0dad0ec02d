#include <gmock/gmock.h>

#include "cycles_heidenhain/worlds.hpp"

/// What the calibration cycles write down of their measurements, and the order in which they touch.
namespace probewright::testing_support {
namespace {

using control::DialogLanguage;
using ::testing::HasSubstr;

/// Length, ball and tip offset of the probe are 100, 2 and (0.04, -0.03); the tables say otherwise. A sphere at X0, a
/// ring at X80 and a stud at X-80, each (0.2, -0.1) beside where the program goes, a block at Y80 whose top is Z5.
Bench standards(ControlKind kind = ControlKind::TNC640) {
  Bench bench(kind);
  bench.preset(1, {0, 0, -400});
  bench.trueProbe().tipOffset = {0.04, -0.03};
  bench.believedProbe().length = 100.2;
  bench.believedProbe().radius = 2.05;
  bench.believedProbe().tipOffset = {0.1, 0.1};
  bench.believedProbe().maximumTravel = 40;
  bench.part(simulation::SolidSphere(Vector3::Zero(), 12.5), pose({0.2, -0.1, -402.5}));
  bench.part(simulation::Ring(20, 30, -30), pose({80.2, -0.1, -400}));
  bench.part(simulation::RoundBar(10, -30, 0), pose({-79.8, -0.1, -400}));
  bench.part(simulation::Box({-15, -15, -20}, {15, 15, 5}), pose({0, 80, -400}));
  bench.program = "TNC:\\CAL\\ALL.H";
  bench.wallClock = 1120114504;  // 30 June 2005, 6:55:04
  return bench;
}

std::string above(double x, double y, double z) {
  return fmt::format("L Z+60 R0 FMAX\nL X{:+} Y{:+} R0 FMAX\nL Z{:+} R0 FMAX\n", x, y, z);
}

const Words sphere = {{407, 12.5}, {320, 1}, {301, 1}, {423, 5}, {380, 0}, {433, 1}, {434, -2.5}};
const std::string length = above(0, 80, 9) + probe(461, {{434, 5}}),
                  ring = above(80, 0, -8) + probe(462, {{407, 20}, {320, 0}, {423, 6}, {380, 30}}),
                  stud = above(-80, 0, 4) + probe(463, {{407, 10}, {320, 1}, {301, 0}, {423, 7}, {380, 10}}),
                  ball = above(0, 0, 14) + probe(460, sphere, " ~\n  Q455=2 ;POINTS");

/// The log of one call after the other.
std::vector<std::string> sections(const std::string& log) {
  std::vector<std::string> found;
  std::size_t at = log.find("<h2>");
  while (at != std::string::npos) {
    const std::size_t next = log.find("<h2>", at + 1);
    found.push_back(log.substr(at, next == std::string::npos ? next : next - at));
    at = next;
  }
  return found;
}

std::string cells(const std::vector<std::string>& texts) {
  std::string row = "<tr>";
  for (const std::string& text : texts)
    row += "<td>" + text + "</td>";
  return row + "</tr>";
}

TEST(CalibrationProtocol, KeepsEveryCalibrationOfAProgram) {
  const Ran ran = standards().run(length + ring + stud + ball);
  ASSERT_TRUE(ran.finished()) << ran.why();
  const std::string log = ran.log("TCHPRAUTO.html");
  const auto calls = sections(log);
  ASSERT_EQ(calls.size(), 4U) << log;
  const char* titles[] = {"461 TS CALIBRATION OF TOOL LENGTH", "462 CALIBRATION OF A TS IN A RING",
                          "463 TS CALIBRATION ON STUD", "460 CALIBRATION OF TS ON A SPHERE"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_THAT(calls[i], HasSubstr(fmt::format("<h2>{}</h2>\n<p>30-06-2005 6:5", titles[i])));
    EXPECT_THAT(calls[i], HasSubstr(", TNC:\\CAL\\ALL.H, tool 1 PROBE, touch probe 1</p>"));
  }
  // 461: the length.
  EXPECT_THAT(calls[0], HasSubstr(cells({"Reference point for length", "5.0000"})));
  EXPECT_THAT(calls[0], HasSubstr("<th></th><th>Before</th><th>After</th>"));
  EXPECT_THAT(calls[0], HasSubstr(cells({"L", "100.2000", "100.0000"})));
  // 462: seen from the spindle axis, the ring lies off by the tip offset; turned by 180 degrees on the other side.
  EXPECT_THAT(calls[1], HasSubstr(cells({"Radius of the standard", "20.0000"})));
  EXPECT_THAT(calls[1], HasSubstr(cells({"Coarse measurement", "4", "80.1600", "-0.0700", "2.0000"})));
  EXPECT_THAT(calls[1], HasSubstr(cells({"Fine measurement", "6", "80.1600", "-0.0700", "2.0000"})));
  EXPECT_THAT(calls[1], HasSubstr(cells({"Reversal measurement", "6", "80.2400", "-0.1300", "2.0000"})));
  EXPECT_THAT(calls[1], HasSubstr(cells({"R", "2.0500", "2.0000"})));
  EXPECT_THAT(calls[1], HasSubstr(cells({"CAL_OF1", "0.1000", "0.0400"})));
  EXPECT_THAT(calls[1], HasSubstr(cells({"CAL_OF2", "0.1000", "-0.0300"})));
  // 463: what 462 has found stands under "before".
  EXPECT_THAT(calls[2], HasSubstr(cells({"Radius of the standard", "10.0000"})));
  EXPECT_THAT(calls[2], HasSubstr(cells({"Fine measurement", "7", "-79.8400", "-0.0700", "2.0000"})));
  EXPECT_THAT(calls[2], HasSubstr(cells({"R", "2.0000", "2.0000"})));
  EXPECT_THAT(calls[2], HasSubstr(cells({"CAL_OF1", "0.0400", "0.0400"})));
  // 460: radius, length and 3-D data in one section.
  EXPECT_THAT(calls[3], HasSubstr(cells({"Radius of the standard", "12.5000"})));
  EXPECT_THAT(calls[3], HasSubstr(cells({"Reversal measurement", "5", "0.2400", "-0.1300", "2.0000"})));
  EXPECT_THAT(calls[3], HasSubstr(cells({"Reference point for length", "-2.5000"})));
  EXPECT_THAT(calls[3], HasSubstr(cells({"L", "100.0000", "100.0000"})));
  EXPECT_THAT(calls[3], HasSubstr(cells({"T1.3DTC", "11", "0.0000"})));
}

TEST(CalibrationProtocol, SpeaksTheLanguageOfTheControl) {
  const auto log = [](DialogLanguage language) {
    Bench bench = standards();
    bench.language = language;
    const Ran ran = bench.run(length + ring + ball);
    EXPECT_TRUE(ran.finished()) << ran.why();
    return ran.log("TCHPRAUTO.html");
  };
  const std::string russian = log(DialogLanguage::Russian), swedish = log(DialogLanguage::Swedish);
  for (const char* text :
       {"<html lang=\"ru\">", "30.06.2005 6:5", "инструмент 1 PROBE, контактный щуп 1", "<th>До</th><th>После</th>",
        "<td>Точка привязки для длины</td>", "<td>Радиус калибра</td>", "<td>Грубое измерение</td>",
        "<td>Точное измерение</td>", "<td>Измерение с поворотом на 180°</td>", "<th>Количество касаний</th>",
        "<th>3D-калибровка</th>", "<th>Наибольшее отклонение</th>"})
    EXPECT_THAT(russian, HasSubstr(text));
  for (const char* text : {"<html lang=\"sv\">", "30-06-2005 6:5", "verktyg 1 PROBE, avkännarsystem 1",
                           "<th>Före</th><th>Efter</th>", "<td>Utgångspunkt för längd</td>", "<td>Normalens radie</td>",
                           "<td>Grovmätning</td>", "<td>Finmätning</td>", "<td>Omslagsmätning</td>",
                           "<th>Antal avkänningar</th>", "<th>3D-kalibrering</th>", "<th>Största avvikelse</th>"})
    EXPECT_THAT(swedish, HasSubstr(text));
  for (const std::string& text : {russian, swedish}) {
    for (const char* left : {"Before", "measurement", "standard", "touch", "Nominal", "Main axis"})
      EXPECT_EQ(text.find(left), std::string::npos) << left;
  }
}

/// With tracking the radius is that of the side which always leads.
TEST(CalibrationProtocol, NamesThePassThatTurnsTheProbe) {
  Bench bench = standards();
  bench.believedProbe().orient = true;
  const Ran ran = bench.run(ring);
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_THAT(ran.log("TCHPRAUTO.html"),
              HasSubstr(cells({"Measurement with angle tracking", "6", "80.2000", "-0.1000", "2.0000"})));
}

/// A spindle that cannot be oriented: coarse and fine measurement only, no centre offset.
TEST(Calibrations, FindNoCentreOffsetWithoutAReversal) {
  for (const std::string& cycle : {ring, stud, ball}) {
    Bench bench = standards();
    bench.believedProbe().tipOffset = {0, 0};
    bench.believedProbe().calibrationAngle = 30;
    bench.setup.world.truth.machine.spindleOrients = false;
    const Ran ran = bench.run(cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), 2, 1e-6);
    EXPECT_EQ(ran.cell("TCHPROBE.TP", "1", "CAL_OF1"), 0);
    const std::string log = ran.log("TCHPRAUTO.html");
    EXPECT_THAT(log, HasSubstr("Fine measurement"));
    EXPECT_EQ(log.find("Reversal"), std::string::npos);
    EXPECT_EQ(log.find("CAL_OF1"), std::string::npos);
  }
}

/// Cycles that measure leave such a spindle as it stands, whatever angle the probe was calibrated at.
TEST(Calibrations, LetSpindlesStandThatCannotBeOriented) {
  Bench bench = standards();
  bench.trueProbe().tipOffset = bench.believedProbe().tipOffset = {0, 0};
  bench.believedProbe().calibrationAngle = 30;
  bench.believedProbe().radius = 2;
  bench.setup.world.truth.machine.spindleOrients = false;
  const Ran ran = bench.run(probe(421, {{273, 80},
                                        {274, 0},
                                        {262, 40},
                                        {325, 0},
                                        {247, 90},
                                        {261, -8},
                                        {320, 2},
                                        {260, 40},
                                        {301, 0},
                                        {275, 0},
                                        {276, 0},
                                        {279, 0},
                                        {280, 0},
                                        {281, 0},
                                        {309, 0},
                                        {330, 0},
                                        {423, 4},
                                        {365, 1}}));
  ASSERT_TRUE(ran.finished()) << ran.why();
  EXPECT_NEAR(ran.q(151), 80.2, 1e-4);
  EXPECT_NEAR(ran.q(152), -0.1, 1e-4);
}

/// Coarse measurement by four touches, fine and reversed measurement by Q423 touches each, beginning at Q380.
TEST(Calibrations, TouchInTheOrderOfThePage) {
  for (const auto& [cycle, count, begin, inwards] : {std::tuple(ring, 6, 30.0, 1.0), std::tuple(stud, 7, 10.0, -1.0)}) {
    const Ran ran = standards().run(cycle);
    ASSERT_TRUE(ran.finished()) << ran.why();
    const auto& touches = ran.cycle().touches;
    ASSERT_EQ(touches.size(), 4U + 2 * static_cast<std::size_t>(count));
    const auto expectPass = [&](std::size_t first, int number) {
      for (int i = 0; i < number; ++i) {
        const double angle = radians(begin + 360.0 * i / number);
        const Vector3 direction = inwards * Vector3(std::cos(angle), std::sin(angle), 0);
        EXPECT_LT((touches[first + static_cast<std::size_t>(i)].direction - direction).norm(), 1e-9);
      }
    };
    expectPass(0, 4);
    expectPass(4, count);
    expectPass(4 + static_cast<std::size_t>(count), count);
  }
}

/// The newer control looks for the equator from the side of Q380 and comes to the pole for the length only; the older
/// one begins at the pole.
TEST(Cycle460, SearchesTheEquatorAsItsControlDoes) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const double reference : {0.0, 130.0, 350.0}) {
      for (const bool withLength : {false, true}) {
        SCOPED_TRACE(fmt::format("{} Q380 = {} Q433 = {}", control::name(kind), reference, withLength));
        const Words words = with(sphere, {{423, 4}, {380, reference}, {433, withLength ? 1 : 0}});
        const Ran ran = standards(kind).run(above(0, 0, 14) + probe(460, words));
        ASSERT_TRUE(ran.finished()) << ran.why();
        const auto& touches = ran.cycle().touches;
        const Vector3 towards(-std::cos(radians(reference)), -std::sin(radians(reference)), 0);
        const auto downwards =
            std::ranges::count_if(touches, [](const auto& each) { return each.direction.z() < -0.5; });
        if (kind == ControlKind::TNC640) {
          EXPECT_LT((touches.front().direction - towards).norm(), 1e-9);
          EXPECT_EQ(downwards, withLength ? 1 : 0);
          EXPECT_EQ(touches.back().direction.z() < -0.5, withLength);
          EXPECT_EQ(touches.size(), 3U + 4 + 4 + 4 + (withLength ? 1 : 0));
        } else {
          EXPECT_LT((touches.front().direction + Vector3::UnitZ()).norm(), 1e-9);
        }
        EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), 2, 1e-6);
        EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), withLength ? 100 : 100.2, 1e-6);
        // The ball is back where the program brought it with the wrong length.
        EXPECT_LT((ran.machine->tipOnTable() - Vector3(0.04, -0.03, -400 + 14 + 0.2 + 2)).norm(), 1e-6);
      }
    }
  }
}

/// The worse the pre-positioning, the more touches the search takes; what it finds is the same.
TEST(Cycle460, FindsTheEquatorFromAPoorPrePosition) {
  Dice dice(46001);
  std::size_t most = 0;
  for (int at = 0; at < 60; ++at) {
    const double height = 10 + 0.5 + dice.between(0, 11), x = dice.between(-2, 2), y = dice.between(-2, 2);
    SCOPED_TRACE(fmt::format("world {}, height {}", at, height));
    const Words words =
        with(sphere, {{423, dice.whole(3, 8)}, {320, 3}, {301, at % 2}, {380, written(dice.between(0, 360))}});
    const Ran ran = standards().run(above(written(x), written(y), written(height)) + probe(460, words));
    ASSERT_TRUE(ran.finished()) << ran.why();
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "R"), 2, 2e-6);
    EXPECT_NEAR(ran.cell("TOOL.T", "1", "L"), 100, 2e-6);
    EXPECT_NEAR(ran.cell("TCHPROBE.TP", "1", "CAL_OF1"), 0.04, 2e-6);
    most = std::max(most, ran.touches());
  }
  EXPECT_GT(most, 4U + 2 * 8 + 3 + 1);
}

}  // namespace
}  // namespace probewright::testing_support

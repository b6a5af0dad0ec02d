#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "machine/machine_file.hpp"
#include "records/results.hpp"
#include "reports/summary.hpp"
#include "truth/told.hpp"

/// What is said of an alarm, against what was planted.
namespace probewright::truth::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string everything(const Told& told) {
  std::string text;
  for (const records::Diagnosis& known : told.truth().diagnoses)
    for (const std::string& sentence : known.texts)
      text += sentence + "\n";
  return text;
}

/// The front side of the plate, which is at Y-30, expected at Y-45.
const std::string front427 =
    "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 427 COORDINATE ~\nQ263=+0 ~\nQ264=-45 ~\nQ261=-8 ~\nQ320=+2 ~\nQ272=+2 "
    "~\n"
    "Q267=+1 ~\nQ260=+20 ~\nQ281=+0 ~\nQ288=+99 ~\nQ289=-99 ~\nQ309=+0 ~\nQ330=+0\n";

TEST(Diagnosis, OfAMissTellsHowFarTheFaceIs) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  const Told told = run(world, front427);
  ASSERT_FALSE(told.finished());
  ASSERT_EQ(told.truth().diagnoses.size(), 1U);
  // From 4 mm (Q320 and SET_UP) before Y-45 the ball of radius 3 goes 10 mm (DIST), to Y-42; it would touch at Y-33.
  EXPECT_THAT(everything(told),
              HasSubstr("the face of \"plate\" is 9.000 mm further in +Y, at X+0.000 Y-30.000 Z-8.000 of "
                        "the active workpiece system (X+0.000 Y-30.000 Z-488.000 on the table)"));
  EXPECT_THAT(everything(told), HasSubstr("with DIST 20 mm the touch would reach it"));
  const records::Diagnosis& known = told.truth().diagnoses.front();
  ASSERT_TRUE(known.expected && known.found);
  EXPECT_LT((known.expected->at - Vector3(0, -45, -488)).norm(), 1e-6);
  EXPECT_LT((known.found->at - Vector3(0, -30, -488)).norm(), 1e-3);
  EXPECT_EQ(known.cycle, 0U);
  EXPECT_THAT(reports::summaryText(told.outcome.journal, told.outcome.info),
              HasSubstr("  truth  the face of \"plate\""));
  // And so it is.
  world.probe = "maximum_travel = 20\n";
  EXPECT_TRUE(run(world, front427).finished());
}

/// The same in a program that counts in inches: places in the unit of the program, DIST as the probe table has it.
TEST(Diagnosis, CountsPlacesInTheUnitOfTheProgram) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  world.unit = "INCH";
  // Y-45, Z-8 and 2 mm, and the clearance height 20.
  const std::string program =
      "TOOL CALL 1 Z\nL Z+2 R0 FMAX\nTCH PROBE 427 COORDINATE ~\nQ263=+0 ~\nQ264=-1.771654 ~\nQ261=-0.314961 ~\n"
      "Q320=+0.07874 ~\nQ272=+2 ~\nQ267=+1 ~\nQ260=+0.8 ~\nQ281=+0 ~\nQ288=+9 ~\nQ289=-9 ~\nQ309=+0 ~\nQ330=+0\n";
  const Told told = run(world, program);
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(everything(told), HasSubstr("at X+0.0000 Y-1.1811 Z-0.3150 inch of the active workpiece system "
                                          "(X+0.000 Y-30.000 Z-488.000 on the table); with DIST 20 mm the touch"));
  world.probe = "maximum_travel = 20\n";
  EXPECT_TRUE(run(world, program).finished());
}

/// 9 mm further than 6 mm (0.2362 inch) before and behind the set value: S_FA is to be what the advice says.
TEST(Diagnosis, AdvisesArgumentsInTheUnitOfTheProgram) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  const auto program = [](const std::string& path) {
    return "G70\nT1 D1\nM6\nG54 G17 G0 X0 Y-2.244094 Z0.8\nG1 Z-0.314961 F200\nCYCLE978(0,,,1,-1.771654," + path +
           ",9,2,1,1,,,,,,1)\n";
  };
  const Told told = run(world, program("0.2362"));
  ASSERT_FALSE(told.finished());
  // The ball ends at Y-45 + 6 - 3 and would touch at Y-33.
  EXPECT_THAT(everything(told), HasSubstr("mm further in +Y")) << told.why();
  EXPECT_THAT(everything(told), HasSubstr("with S_FA 0.62 inch the touch would reach it"));
  const Told advised = run(world, program("0.62"));
  EXPECT_TRUE(advised.finished()) << advised.why();
}

/// What a cycle looks for is where its arguments say, whatever unit they count in.
TEST(Diagnosis, FindsTheHoleOfAnInchProgram) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ x = 5, y = 4, z = -480, c = 30 }");
  world.unit = "INCH";
  const Told told = run(world,
                        "TOOL CALL 1 Z\nL Z+2 R0 FMAX\nTCH PROBE 412 PRESET ~\nQ321=-0.393701 ~\nQ322=-0.15748 ~\n"
                        "Q262=+1.181102 ~\nQ325=+0 ~\nQ247=+90 ~\nQ261=-0.19685 ~\nQ320=+0.08 ~\nQ260=+0.8 ~\n"
                        "Q301=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\n"
                        "Q384=+0 ~\nQ333=+0\n");
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(everything(told), HasSubstr("the hole of 30.010 mm has its centre at X+0.1969 Y+0.1575 Z-0.1969 inch of "
                                          "the active workpiece system (X+5.000 Y+4.000 Z-485.000 on the table), "
                                          "17.000 mm from Q321/Q322"));
  ASSERT_TRUE(told.truth().diagnoses.back().expected);
  EXPECT_NEAR(told.truth().diagnoses.back().expected->diameter, 30, 1e-4);
}

TEST(Diagnosis, OfAHoleTellsWhereItIs) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ x = 5, y = 4, z = -480, c = 30 }");
  const Told told = run(world,
                        "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 412 PRESET ~\nQ321=-10 ~\nQ322=-4 ~\nQ262=+30 ~\n"
                        "Q325=+0 ~\nQ247=+90 ~\nQ261=-5 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ305=+1 ~\nQ331=+0 ~\n"
                        "Q332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(everything(told),
              HasSubstr("the hole of 30.010 mm has its centre at X+5.000 Y+4.000 Z-5.000 of the active "
                        "workpiece system (X+5.000 Y+4.000 Z-485.000 on the table), 17.000 mm from "
                        "Q321/Q322"));
  ASSERT_FALSE(told.truth().diagnoses.empty());
  const records::Diagnosis& known = told.truth().diagnoses.back();
  ASSERT_TRUE(known.expected && known.found);
  EXPECT_EQ(known.expected->shape, "circle");
  EXPECT_NEAR(known.expected->diameter, 30, 1e-9);
  EXPECT_NEAR(known.found->diameter, 30.01, 1e-9);
}

TEST(Diagnosis, CountsFromTheStartOnASinumerik) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  // 9 mm beside the middle of the hole the ball meets its wall on the way to where it is to begin.
  const Told told = run(world, "T1 D1\nM6\nG54 G17 G0 X9 Y0 Z20\nG1 Z-5 F2000\nCYCLE977(1,,,1,30,,,2,1,,,,,,1)\n");
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(everything(told), HasSubstr("the hole of 30.010 mm has its centre at X+0.000 Y+0.000 Z"));
  EXPECT_THAT(everything(told), HasSubstr(" 9.000 mm from the start position"));
}

TEST(Diagnosis, OfABodyTellsHowMuchTooWideItIs) {
  World world;
  world.origin = {0, 0, -480};
  world.probe = "body_radius = 30\nbody_length = 90\nstylus_length = 50\n";
  world.part =
      "[part]\nname = \"box\"\npose = { z = -480 }\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -100]\n"
      "size = [120, 100, 100]\n[[part.feature]]\nshape = \"pocket\"\nsize = [80, 80]\ndepth = 90\ncorner_radius = 3\n";
  const std::string program =
      "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 423 POCKET ~\nQ273=+0 ~\nQ274=+0 ~\nQ282=+80 ~\nQ283=+80 ~\n"
      "Q261=-60 ~\nQ320=+2 ~\nQ260=+20 ~\nQ301=+0 ~\nQ284=+81 ~\nQ285=+79 ~\nQ286=+81 ~\nQ287=+79 ~\nQ279=+1 ~\n"
      "Q280=+1 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n";
  const Told told = run(world, program);
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(everything(told), HasSubstr("the body met \"box\" at "));
  // The ball is to stand 4 mm (Q320 and SET_UP) from the wall, its centre 7: there a body of 14 mm has room.
  EXPECT_THAT(everything(told), HasSubstr("the body of the probe, 60.000 mm in diameter, is 46.0 mm too wide"));
  // Its face is to stand 10 mm below the top.
  EXPECT_THAT(everything(told), HasSubstr("a stylus that is 10.0 mm longer would keep the body clear"));
  // In the touch itself the ball's centre is 3 mm from the wall: there a body of 6 mm has room, and no more.
  world.probe = "body_radius = 6.9\nbody_length = 90\nstylus_length = 50\n";
  const Told nearer = run(world, program);
  ASSERT_FALSE(nearer.finished());
  EXPECT_THAT(everything(nearer), HasSubstr("the body of the probe, 13.800 mm in diameter, is 7.8 mm too wide"));
  EXPECT_THAT(everything(nearer), HasSubstr("a stylus that is 10.0 mm longer would keep the body clear"));
  world.probe = "body_radius = 2.99\nbody_length = 90\nstylus_length = 50\n";
  const Told narrow = run(world, program);
  EXPECT_TRUE(narrow.finished()) << narrow.why();
}

/// A box with its top at Z0, and something in or on it, at a pose.
std::string boxWith(const std::string& feature, const std::string& pose) {
  return "[part]\nname = \"box\"\npose = " + pose +
         "\n[[part.feature]]\nshape = \"box\"\ncentre = [0, 0, -40]\nsize = [160, 140, 40]\n[[part.feature]]\n" +
         feature;
}

TEST(Diagnosis, OfAPocketTellsWhereItIs) {
  World world;
  world.origin = {0, 0, -480};
  world.part =
      boxWith("shape = \"pocket\"\nsize = [40, 30]\ndepth = 20\ncorner_radius = 3\n", "{ x = 6, y = -4, z = -480 }");
  const Told told = run(world,
                        "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 423 POCKET ~\nQ273=+0 ~\nQ274=+0 ~\nQ282=+40 ~\n"
                        "Q283=+30 ~\nQ261=-8 ~\nQ320=+0 ~\nQ260=+20 ~\nQ301=+0 ~\nQ284=+41 ~\nQ285=+39 ~\n"
                        "Q286=+31 ~\nQ287=+29 ~\nQ279=+1 ~\nQ280=+1 ~\nQ281=+0 ~\nQ309=+0 ~\nQ330=+0\n");
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(everything(told),
              HasSubstr("the pocket of 40.000 x 30.000 mm has its centre at X+6.000 Y-4.000 Z-8.000 of the active"));
  EXPECT_THAT(everything(told), HasSubstr(", 7.211 mm from Q273/Q274"));
}

TEST(Diagnosis, OfASlotAndARidgeTellsWhereTheyAre) {
  World world;
  world.origin = {0, 0, -480};
  const auto program = [](int cycle, int height) {
    return fmt::format(
        "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE {} CENTRE ~\nQ321=+0 ~\nQ322=+0 ~\nQ311=+14 ~\nQ272=+2 ~\n"
        "Q261={:+} ~\nQ320=+0 ~\nQ260=+40 ~\n{}Q305=+0 ~\nQ405=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\n"
        "Q384=+0 ~\nQ333=+0\n",
        cycle, height, cycle == 408 ? "Q301=+0 ~\n" : "");
  };
  world.part = boxWith("shape = \"pocket\"\nsize = [100, 14]\ndepth = 20\ncorner_radius = 2\n", "{ y = 6, z = -480 }");
  const Told slot = run(world, program(408, -8));
  ASSERT_FALSE(slot.finished());
  EXPECT_THAT(everything(slot), HasSubstr("the slot of 14.000 mm has its centre at X+0.000 Y+6.000 Z-8.000 of the"));
  EXPECT_THAT(everything(slot), HasSubstr(", 6.000 mm from Q321/Q322"));
  // A ridge 12 mm beside its place: the probe comes down on it.
  world.part = boxWith("shape = \"box\"\ncentre = [0, 0, 0]\nsize = [100, 14, 20]\n", "{ y = 12, z = -480 }");
  const Told ridge = run(world, program(409, 8));
  ASSERT_FALSE(ridge.finished());
  EXPECT_THAT(everything(ridge), HasSubstr("the ridge of 14.000 mm has its centre at X+0.000 Y+12.000 Z+8.000 of the"));
}

TEST(Diagnosis, OfAGrooveCountsFromTheStartOnASinumerik) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.part = boxWith("shape = \"pocket\"\nsize = [14, 100]\ndepth = 20\ncorner_radius = 2\n", "{ x = 3, z = -480 }");
  const Told told = run(world, "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z20\nG1 Z-8 F2000\nCYCLE977(3,,,1,14,,,2,1,,,,,1,1)\n");
  ASSERT_FALSE(told.finished());
  // The ball's centre is 3 mm above the programmed height of its lowest point.
  EXPECT_THAT(everything(told), HasSubstr("the slot of 14.000 mm has its centre at X+3.000 Y+0.000 Z-5.000 of the"));
  EXPECT_THAT(everything(told), HasSubstr(", 3.000 mm from the start position"));
}

TEST(Diagnosis, OfFeaturesAtAnAngleTellsWhereTheyAreOnASinumerik) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  const std::string begin = "T1 D1\nM6\nG54 G17 G0 X0 Y0 Z20\nG1 Z-8 F2000\n";
  // A slot across 30 degrees from X, 4 mm beside its place in this direction.
  const Vector3 across(std::cos(radiansFromDegrees(30.0)), std::sin(radiansFromDegrees(30.0)), 0);
  world.part = boxWith("shape = \"pocket\"\nsize = [14, 100]\ndepth = 20\ncorner_radius = 2\n",
                       fmt::format("{{ x = {}, y = {}, z = -480, c = 30 }}", 4 * across.x(), 4 * across.y()));
  const Told slot = run(world, begin + "CYCLE977(3,,,1,14,,,2,1,30,,,,1,1)\n");
  ASSERT_FALSE(slot.finished());
  EXPECT_THAT(everything(slot), HasSubstr("the slot of 14.000 mm has its centre at X+3.464 Y+2.000 Z-5.000 of the"));
  EXPECT_THAT(everything(slot), HasSubstr(", 4.000 mm from the start position"));
  // What is drawn lies at the angle, too: opposite corners of the outline are as far apart as the slot is wide.
  const records::Diagnosis& known = slot.truth().diagnoses.back();
  ASSERT_TRUE(known.expected && known.found);
  ASSERT_EQ(known.found->outline.size(), 5U);
  EXPECT_LT((known.found->outline[0] - known.found->outline[1] - 14 * across).norm(), 1e-3);
  EXPECT_LT((known.expected->at - Vector3(0, 0, -485)).norm(), 1e-6);

  world.part = boxWith("shape = \"pocket\"\nsize = [40, 30]\ndepth = 20\ncorner_radius = 3\n",
                       fmt::format("{{ x = {}, y = {}, z = -480, c = 30 }}", 13 * across.x(), 13 * across.y()));
  const Told pocket = run(world, begin + "CYCLE977(5,,,1,,40,30,2,1,30,,,,1,1)\n");
  ASSERT_FALSE(pocket.finished());
  EXPECT_THAT(everything(pocket), HasSubstr("the pocket of 40.000 x 30.000 mm has its centre at X+11.258 Y+6.500 Z-5"));
  EXPECT_THAT(everything(pocket), HasSubstr(", 13.000 mm from the start position"));
}

TEST(Diagnosis, OfAnEdgeTellsByWhichAngleItIsTurned) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480, c = 3.2 }");
  const Told told = run(world, front427);
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(everything(told), HasSubstr("that face is turned by +3.200 deg about Z"));
  // The front side passes 30 / cos below the origin.
  EXPECT_THAT(everything(told), HasSubstr(" of the active workpiece system (X"));
  const records::Diagnosis& known = told.truth().diagnoses.front();
  ASSERT_TRUE(known.expected && known.found);
  EXPECT_EQ(known.expected->shape, "plane");
  EXPECT_EQ(known.found->shape, "plane");
  const double turned = radiansFromDegrees(3.2);
  EXPECT_LT((known.found->normal - Vector3(std::sin(turned), -std::cos(turned), 0)).norm(), 1e-6);
  EXPECT_NEAR(Vector3(std::sin(turned), -std::cos(turned), 0).dot(known.found->at), 30, 1e-3);
}

TEST(Diagnosis, OfACornerTellsWhereItIs) {
  World world;
  world.origin = {0, 0, -480};
  // The corner at X-40 Y-30 of the plate; the probe expects it 20 mm further out.
  world.part = plate("{ z = -480, c = 2 }");
  const auto corner = [](double x, double y) {
    const double turned = radiansFromDegrees(2.0);
    return Vector2(x * std::cos(turned) - y * std::sin(turned), x * std::sin(turned) + y * std::cos(turned));
  };
  const Told outside =
      run(world,
          "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 414 PRESET OUTSIDE CORNER ~\nQ263=-40 ~\nQ264=-50 ~\nQ326=+30 ~\n"
          "Q296=-60 ~\nQ297=-25 ~\nQ327=+30 ~\nQ261=-8 ~\nQ320=+0 ~\nQ260=+20 ~\nQ301=+0 ~\n"
          "Q304=+0 ~\nQ305=+1 ~\nQ331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\n"
          "Q384=+0 ~\nQ333=+0\n");
  ASSERT_FALSE(outside.finished());
  const Vector2 at = corner(-40, -30);
  EXPECT_THAT(everything(outside),
              HasSubstr(fmt::format("the corner is at X{:+.3f} Y{:+.3f} Z-8.000 of the active", at.x(), at.y())));
  EXPECT_THAT(everything(outside), HasSubstr(fmt::format("{:.3f} mm from Q296/Q264", (at - Vector2(-60, -50)).norm())));
  EXPECT_THAT(everything(outside), HasSubstr("its first side is turned by +2.000 deg"));
  const records::Diagnosis& known = outside.truth().diagnoses.back();
  ASSERT_TRUE(known.expected && known.found);
  ASSERT_EQ(known.found->outline.size(), 3U);
  EXPECT_LT((known.found->outline[1].head<2>() - at).norm(), 1e-3);
  EXPECT_LT((known.expected->outline[1] - Vector3(-60, -50, -488)).norm(), 1e-6);

  // Inside: the corner of a pocket of 60 x 50, expected 15 mm within it.
  world.part = boxWith("shape = \"pocket\"\nsize = [60, 50]\ndepth = 20\ncorner_radius = 2\n", "{ z = -480 }");
  const Told inside =
      run(world,
          "TOOL CALL 1 Z\nL Z+50 R0 FMAX\nTCH PROBE 415 PRESET INSIDE CORNER ~\nQ263=-15 ~\nQ264=-10 ~\nQ326=+15 ~\n"
          "Q327=+12 ~\nQ308=+1 ~\nQ261=-8 ~\nQ320=+0 ~\nQ260=+20 ~\nQ301=+0 ~\nQ304=+0 ~\nQ305=+1 ~\n"
          "Q331=+0 ~\nQ332=+0 ~\nQ303=+1 ~\nQ381=+0 ~\nQ382=+0 ~\nQ383=+0 ~\nQ384=+0 ~\nQ333=+0\n");
  ASSERT_FALSE(inside.finished());
  EXPECT_THAT(everything(inside), HasSubstr("the corner is at X-30.000 Y-25.000 Z-8.000 of the active"));
  EXPECT_THAT(everything(inside), HasSubstr(", 21.213 mm from Q263/Q264"));
  EXPECT_THAT(everything(inside), Not(HasSubstr("is turned by")));
}

TEST(Diagnosis, OfACornerCountsFromThePoleOnASinumerik) {
  World world;
  world.control = "840Dsl";
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  // An outside corner, 20 mm from a pole outside of the plate; S_FA 3 is too short for the 15 mm left to its faces.
  const Told told = run(world,
                        "T1 D1\nM6\nG54 G17 G0 X-60 Y-50 Z20\nG1 Z-8 F2000\n"
                        "CYCLE961(6,,1,30,60,25,,-60,-50,,,,,0,,0,3,2,1,,1,)\n");
  ASSERT_FALSE(told.finished());
  EXPECT_THAT(everything(told), HasSubstr("the corner is at X-40.000 Y-30.000 Z-5.000 of the active"));
  EXPECT_THAT(everything(told), HasSubstr(", 28.284 mm from the pole"));
}

TEST(Diagnosis, IsNotToldToTheBlindNorWithoutAnAlarm) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  setup::MachineOptions blind;
  blind.blind = true;
  const Told hidden = run(world, front427, blind);
  EXPECT_THAT(records::resultsText(hidden.outcome.journal, hidden.outcome.info), Not(HasSubstr("diagnoses")));
  EXPECT_THAT(reports::summaryText(hidden.outcome.journal, hidden.outcome.info), Not(HasSubstr("further")));
  world.probe = "maximum_travel = 20\n";
  EXPECT_THAT(run(world, front427).truth().diagnoses, IsEmpty());
}

TEST(Clearance, IsTheLeastDistanceOfEachMove) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  const std::string program =
      "TOOL CALL 1 Z\nL Z+60 R0 FMAX\nL X-80 Y+20 FMAX\nL Z+5 FMAX\nL X+80 F2000\nL Z+60 FMAX\n";
  setup::MachineOptions asked;
  asked.clearance = true;
  const Told told = run(world, program, asked);
  ASSERT_TRUE(told.finished()) << told.why();
  ASSERT_TRUE(told.truth().clearance);
  const auto& spans = told.truth().clearance->spans;
  const auto least = std::ranges::min_element(spans, {}, &records::ClearanceSpan::distance);
  ASSERT_NE(least, spans.end());
  // The tip, which is the lowest point of the ball, passes 5 mm above the plate.
  EXPECT_NEAR(least->distance, 5, 0.06);
  EXPECT_EQ(least->part, "ball");
  EXPECT_EQ(least->solid, "plate");
  EXPECT_TRUE(spans.front().orMore);
  EXPECT_FALSE(run(world, program).truth().clearance) << "only who asks pays for it";

  // A limit of the setup asks for it, too, and warns of the block.
  world.more = "[machine]\nclearance = 6\n";
  const Told limited = run(world, program);
  EXPECT_THAT(reports::summaryText(limited.outcome.journal, limited.outcome.info),
              HasSubstr("  warning  clearance: the ball came within "));
  world.more = "[machine]\nclearance = 4\n";
  const Told free = run(world, program);
  EXPECT_THAT(reports::summaryText(free.outcome.journal, free.outcome.info), Not(HasSubstr("clearance")));
}

TEST(Clearance, CountsTheBodiesOfTheMachine) {
  setup::MachineOptions asked;
  asked.clearance = true;
  const auto least = [&](const World& world, const std::string& program) {
    const Told told = run(world, program, asked);
    EXPECT_TRUE(told.finished()) << told.why();
    const auto& spans = told.truth().clearance->spans;
    return *std::ranges::min_element(spans, {}, &records::ClearanceSpan::distance);
  };
  // A hose on the head ends 10 mm above the ball's lowest point; below it stands a post, 2.5 mm higher than the ball
  // comes: 7.5 mm are left.
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  world.more =
      "[machine]\n[[machine.body]]\nname = \"hose\"\nlink = \"head\"\n[[machine.body.feature]]\nshape = \"box\"\n"
      "centre = [0, -150, -140]\nsize = [20, 20, 140]\n[[fixture]]\nname = \"post\"\npose = { y = -150, z = -557.5 }\n"
      "[[fixture.feature]]\nshape = \"box\"\nsize = [30, 30, 100]\n";
  const std::string down = "TOOL CALL 1 Z\nL X+0 Y+0 R0 FMAX\nL Z+20 FMAX\nL Z+60 FMAX\n";
  const records::ClearanceSpan hose = least(world, down);
  EXPECT_NEAR(hose.distance, 7.5, 0.15);
  EXPECT_LE(hose.distance, 7.5);
  EXPECT_EQ(hose.part, "hose");
  EXPECT_EQ(hose.solid, "post");

  // The tool passes 6 mm above a guard that the table carries.
  world.more =
      "[machine]\n[[machine.body]]\nname = \"guard\"\nlink = \"table\"\n[[machine.body.feature]]\nshape = \"box\"\n"
      "centre = [120, 0, -500]\nsize = [40, 40, 34]\n";
  const records::ClearanceSpan guard =
      least(world, "TOOL CALL 1 Z\nL Z+60 R0 FMAX\nL X+80 Y+0 FMAX\nL Z+20 FMAX\nL X+160 F2000\nL Z+60 FMAX\n");
  EXPECT_NEAR(guard.distance, 6, 0.15);
  EXPECT_EQ(guard.part, "tool");
  EXPECT_EQ(guard.solid, "guard");
}

TEST(Clearance, DoesNotCountWhatIsMeantToTouch) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  world.probe = "maximum_travel = 20\nstylus_length = 50\nbody_radius = 25\nbody_length = 90\n";
  setup::MachineOptions asked;
  asked.clearance = true;
  const Told told = run(world, front427, asked);
  ASSERT_TRUE(told.finished()) << told.why();
  for (const records::ClearanceSpan& span : told.truth().clearance->spans)
    EXPECT_GT(span.distance, 1) << span.part << " at " << span.from << " s";
}

TEST(Travel, WarnsOfBlocksThatComeNearAnEnd) {
  const auto machine = machine::readMachine("mill3");
  ASSERT_TRUE(machine);
  const double last = machine->axes[0].maximum;
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  world.more = "[machine]\nclearance = 6\n";
  const std::string program = fmt::format(
      "TOOL CALL 1 Z\nL Z+60 R0 FMAX\nL X{:+.3f} FMAX\nL X+0 FMAX\nL X{:+.3f} FMAX\n", last - 2.5, last - 7);
  const Told told = run(world, program);
  ASSERT_TRUE(told.finished()) << told.why();
  ASSERT_EQ(told.truth().nearEnds.size(), 1U);
  const records::TravelMargin& near = told.truth().nearEnds.front();
  EXPECT_EQ(near.axis, "X");
  EXPECT_NEAR(near.margin, 2.5, 1e-6);
  EXPECT_NEAR(near.position, last - 2.5, 1e-6);
  EXPECT_THAT(reports::summaryText(told.outcome.journal, told.outcome.info),
              HasSubstr("  warning  travel: axis X came within 2.5 mm of an end of its travel, at +"));
  // Each block has its own: of an arc it is the place that comes nearest, 2.5 mm, on the way from 22.5 mm before the
  // end and back; the axis that stands still does not count.
  session::RunOptions traced;
  traced.trace = true;
  const Told blocks = run(world,
                          fmt::format("TOOL CALL 1 Z\nL Z+60 R0 FMAX\nL X{0:+.3f} Y-20 FMAX\nCC X{0:+.3f} Y+0\n"
                                      "C X{0:+.3f} Y+20 DR+ F5000\nL X{1:+.3f} FMAX\nL Y+0\nL X{2:+.3f} FMAX\nL X+0\n",
                                      last - 22.5, last - 1, last - 4),
                          {}, traced);
  ASSERT_TRUE(blocks.finished()) << blocks.why();
  const auto& ends = blocks.truth().nearEnds;
  ASSERT_EQ(ends.size(), 3U);
  for (const auto& [i, line, margin] : {std::tuple(0U, 6U, 2.5), {1U, 7U, 1.0}, {2U, 9U, 4.0}}) {
    ASSERT_TRUE(ends[i].place);
    EXPECT_EQ(ends[i].place->line, line);
    EXPECT_NEAR(ends[i].margin, margin, 0.01);
  }
  world.more = "";
  EXPECT_THAT(run(world, program).truth().nearEnds, IsEmpty()) << "no limit, no warnings";
}

/// C of the table turns endlessly: it has no ends to come near to.
TEST(Travel, TellsNothingOfAxesWithoutEnds) {
  World world;
  world.origin = {0, 0, -400};
  world.part = plate("{ z = -400 }");
  world.more = "[machine]\nname = \"mill5-table-table\"\nclearance = 12\n";
  const Told told = run(world, "TOOL CALL 1 Z\nL Z-20 R0 FMAX M91\nL A+110 FMAX\nL A+0 C+350 FMAX\nL C-10 FMAX\n");
  ASSERT_TRUE(told.finished()) << told.why();
  std::vector<std::string> axes;
  for (const records::TravelMargin& each : told.truth().travel)
    axes.push_back(each.axis);
  EXPECT_THAT(axes, ::testing::UnorderedElementsAre("X", "Y", "Z", "A"));
  EXPECT_FALSE(told.truth().nearEnds.empty()) << "A ends at 120 degrees";
  for (const records::TravelMargin& each : told.truth().nearEnds)
    EXPECT_EQ(each.axis, "A");
}

TEST(Travel, TellsHowNearAnAxisCameToItsEnd) {
  World world;
  world.origin = {0, 0, -480};
  world.part = plate("{ z = -480 }");
  const Told told = run(world, "TOOL CALL 1 Z\nL Z+60 R0 FMAX\nL X-80 Y+20 FMAX\n");
  ASSERT_TRUE(told.finished()) << told.why();
  const auto machine = machine::readMachine("mill3");
  ASSERT_TRUE(machine);
  const machine::Axis& axis = machine->axes[0];
  const auto marginOf = [&](double x) { return std::min(x - axis.minimum, axis.maximum - x); };
  const auto x = std::ranges::find(told.truth().travel, "X", &records::TravelMargin::axis);
  ASSERT_NE(x, told.truth().travel.end());
  EXPECT_NEAR(x->margin, std::min(marginOf(machine->toolChange[0]), marginOf(-80)), 1e-9);
}

}  // namespace
}  // namespace probewright::truth::testing
